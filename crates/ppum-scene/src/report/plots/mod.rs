//! Plots of datasets: values along curves, what was found in the steps of a series, errors against
//! unknowns, the solver's work.

mod convergence;
mod error;
mod history;
mod named;
mod profiles;
mod series;

use ppum_figure::plot::{Plot, PlotCurve};
use ppum_render::png::TextChunk;
use ppum_render::scale::Scale;

pub use convergence::{adaptation, convergence};
pub use error::PlotError;
pub use history::{SolverWork, history};
pub use named::{NamedDataset, plain};
use named::{label, title};
pub use profiles::{Profiles, usual};
pub use series::{SeriesAxis, SeriesNumber, series};

/// Returns the metadata of a plot's file; `names` are those of the datasets.
#[must_use]
pub fn texts(names: &[&str], plot: &Plot) -> Vec<TextChunk> {
    let summary = format!("{} of {}, evaluated exactly", curves(plot), names.join(", "));
    [
        ("Title", plot.title.clone()),
        ("Software", concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Description", summary),
    ]
    .map(|(key, text)| (key.to_owned(), text))
    .into()
}

/// The names of the curves.
#[must_use]
pub fn curves(plot: &Plot) -> String {
    plot.curves.iter().map(|curve| plain(&curve.label)).collect::<Vec<_>>().join(", ")
}

/// Refuses a plot that shows nothing, and warns of curves that miss points which have a value.
///
/// # Errors
/// If no curve has a point that can be seen.
pub fn check(plot: &Plot) -> Result<Vec<String>, PlotError> {
    let logs = [&plot.x, &plot.y].map(|axis| axis.scale == Scale::Log);
    if plot.curves.iter().all(|curve| counts(curve, logs).seen == 0) {
        return Err(PlotError::Nothing(why(&plot.curves, logs)));
    }
    Ok(plot.curves.iter().filter_map(|curve| missed(curve, logs)).collect())
}

/// Returns a message about the values that a curve does not show.
fn missed(curve: &PlotCurve, logs: [bool; 2]) -> Option<String> {
    let (name, Counts { seen, finite }) = (plain(&curve.label), counts(curve, logs));
    if seen == 0 {
        return Some(format!("`{name}` shows nothing: {}", why([curve], logs)));
    }
    let lost = finite - seen;
    (lost > 0).then(|| {
        format!("`{name}` is not positive at {lost} of {finite} points, which a logarithmic axis leaves out")
    })
}

/// Points of a curve: those whose coordinates are finite, and those that the axes have a place for.
struct Counts {
    seen: usize,
    finite: usize,
}

fn counts(curve: &PlotCurve, logs: [bool; 2]) -> Counts {
    let finite = || curve.points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
    let has_place = |p: &&[f64; 2]| p.iter().zip(logs).all(|(v, is_log)| !is_log || *v > 0.0);
    Counts { seen: finite().filter(has_place).count(), finite: finite().count() }
}

/// Why curves show nothing.
fn why<'c>(curves: impl IntoIterator<Item = &'c PlotCurve>, logs: [bool; 2]) -> &'static str {
    let mut is_infinite = false;
    for curve in curves {
        if counts(curve, logs).finite > 0 {
            return "no value is positive, which a logarithmic axis needs";
        }
        is_infinite |= curve.points.iter().any(|p| p[1].is_infinite());
    }
    if is_infinite {
        "all values are infinite"
    } else {
        "there is no value at any point; does the curve run through the plate?"
    }
}
