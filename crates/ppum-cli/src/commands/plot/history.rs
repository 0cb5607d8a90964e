//! The solver's work: seconds of its phases.

use anyhow::ensure;
use ppum_figure::plot::{Curve, Look, Plot, PlotAxis};

use super::Named;

/// Bars of seconds, phase by phase, a colour for each dataset. Of a series, the sum over its steps unless one is
/// asked for.
pub(super) fn plot(datasets: &[Named], step: Option<usize>) -> anyhow::Result<Plot> {
    let mut phases: Vec<String> = Vec::new();
    let mut curves = Vec::new();
    for Named { name, dataset } in datasets {
        let wanted = |k: usize| step.is_none_or(|step| step == k);
        let steps = dataset.steps.iter().enumerate().filter(|(k, _)| wanted(*k));
        let mut points: Vec<[f64; 2]> = Vec::new();
        for record in steps.flat_map(|(_, step)| &step.history).filter(|r| r.unit == "s") {
            let known = phases.iter().position(|phase| *phase == record.name);
            let place = known.unwrap_or(phases.len());
            if known.is_none() {
                phases.push(record.name.clone());
            }
            match points.iter_mut().find(|p| p[0] == place as f64) {
                Some(point) => point[1] += record.value,
                None => points.push([place as f64, record.value]),
            }
        }
        ensure!(!points.is_empty(), "{name}: its history has no seconds");
        curves.push(Curve::new(name.clone(), points).with_look(Look::Bars));
    }
    let x = PlotAxis { names: phases, ..PlotAxis::default() };
    let mut plot = Plot { x, y: PlotAxis::new("time", "s"), curves, ..Plot::default() };
    plot.title.clone_from(&datasets[0].dataset.title);
    Ok(plot)
}
