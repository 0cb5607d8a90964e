//! Plots of datasets: values along curves, what was found in the steps of a series, errors against
//! unknowns, the solver's work.

mod convergence;
mod error;
mod history;
mod named;
mod profiles;
mod seen;
mod series;

use ppum_figure::plot::Plot;
use ppum_render::png::TextChunk;

pub use convergence::{adaptation, convergence};
pub use error::PlotError;
pub use history::{SolverWork, history};
pub use named::{NamedDataset, plain};
use named::{label, title};
pub use profiles::{Profiles, usual};
pub use seen::check;
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
