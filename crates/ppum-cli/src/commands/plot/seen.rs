//! Whether a plot shows what was asked for.

use anyhow::bail;
use ppum_figure::plot::{Curve, Plot};
use ppum_render::scale::Scale;

use super::plain;
use crate::output::tell;

/// Refuses a plot that shows nothing, and warns of curves that miss points which have a value.
///
/// # Errors
/// If no curve has a point that can be seen.
pub(super) fn check(plot: &Plot) -> anyhow::Result<()> {
    let logs = [&plot.x, &plot.y].map(|axis| axis.scale == Scale::Log);
    if plot.curves.iter().all(|curve| counts(curve, logs).seen == 0) {
        bail!("the plot would show nothing: {}", why(&plot.curves, logs));
    }
    for curve in &plot.curves {
        let Counts { seen, finite } = counts(curve, logs);
        let name = plain(&curve.label);
        if seen == 0 {
            tell(&format!("warning: `{name}` shows nothing: {}", why([curve], logs)));
        } else if seen < finite {
            let lost = finite - seen;
            tell(&format!(
                "warning: `{name}` is not positive at {lost} of {finite} points, which a logarithmic axis leaves out"
            ));
        }
    }
    Ok(())
}

/// Points of a curve: those whose coordinates are finite, and those that the axes have a place for.
struct Counts {
    seen: usize,
    finite: usize,
}

fn counts(curve: &Curve, logs: [bool; 2]) -> Counts {
    let finite = || curve.points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
    let has_place = |p: &&[f64; 2]| p.iter().zip(logs).all(|(v, is_log)| !is_log || *v > 0.0);
    Counts { seen: finite().filter(has_place).count(), finite: finite().count() }
}

/// Why curves show nothing.
fn why<'c>(curves: impl IntoIterator<Item = &'c Curve>, logs: [bool; 2]) -> &'static str {
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
