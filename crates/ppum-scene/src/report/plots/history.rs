//! The solver's work: what its phases take, and how its iteration goes.

use ppum::dataset::{Record, Step};
use ppum_figure::plot::{CurveStyle, Plot, PlotAxis, PlotCurve};
use ppum_solve::report::{SolverReport, is_of_phase};

use super::{NamedDataset, PlotError, label};

/// The measure of the solver's work that is plotted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[derive(serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverWork {
    /// Seconds of the phases; for a series, their sums
    #[default]
    Seconds,
    /// Megabytes that the phases allocate and keep; for a series, the maximum
    Bytes,
    /// Residuals after each iteration of the multilevel solver; for one file, also on each level
    Residuals,
    /// Patches, unknowns and values of the matrix on each level of the multilevel solver
    Levels,
}

/// A plot of the work of one step, by default the last; of seconds and bytes that of all steps.
///
/// # Errors
/// No such step; a history that does not tell it.
pub fn history(
    datasets: &[NamedDataset<'_>],
    what: SolverWork,
    step: Option<usize>,
) -> Result<Plot, PlotError> {
    let mut plot = match what {
        SolverWork::Seconds => phases(datasets, step, ("s", PlotAxis::new("time", "s"), 1.0))?,
        SolverWork::Bytes => phases(datasets, step, ("B", PlotAxis::new("memory", "MB"), 1e-6))?,
        SolverWork::Residuals => residuals(datasets, step)?,
        SolverWork::Levels => levels(datasets, step)?,
    };
    plot.title = datasets.first().map_or_else(String::new, |first| first.dataset.title.clone());
    Ok(plot)
}

/// Bars phase by phase, a colour for each dataset: of seconds the sum over the steps, of bytes
/// the most.
fn phases(
    datasets: &[NamedDataset<'_>],
    step: Option<usize>,
    (unit, axis, scale): (&str, PlotAxis, f64),
) -> Result<Plot, PlotError> {
    let mut names: Vec<String> = Vec::new();
    let mut curves = Vec::new();
    for &NamedDataset { name, dataset } in datasets {
        let last = step.unwrap_or(0);
        if last >= dataset.steps.len() {
            return Err(PlotError::Step { name: name.to_owned(), step: last });
        }
        let wanted = |k: usize| step.is_none_or(|step| step == k);
        let steps = dataset.steps.iter().enumerate().filter(|(k, _)| wanted(*k));
        let mut points: Vec<[f64; 2]> = Vec::new();
        let is_told = |r: &&Record| r.unit == unit && (unit == "s" || is_of_phase(r));
        for record in steps.flat_map(|(_, step)| &step.history).filter(is_told) {
            let known = names.iter().position(|phase| *phase == record.name);
            let place = known.unwrap_or(names.len());
            if known.is_none() {
                names.push(record.name.clone());
            }
            let value = scale * record.value;
            match points.iter_mut().find(|p| p[0] == place as f64) {
                Some(point) if unit == "s" => point[1] += value,
                Some(point) => point[1] = point[1].max(value),
                None => points.push([place as f64, value]),
            }
        }
        let word = if unit == "s" { "seconds" } else { "bytes of phases" };
        if points.is_empty() {
            return Err(PlotError::NoRecords { name: name.to_owned(), what: word });
        }
        curves.push(PlotCurve::new(name, points).with_look(CurveStyle::Bars));
    }
    let x = PlotAxis { names, ..PlotAxis::default() };
    Ok(Plot { x, y: axis, curves, ..Plot::default() })
}

/// The report of a step, by default of the last one.
fn report(named: &NamedDataset<'_>, step: Option<usize>) -> Result<SolverReport, PlotError> {
    let steps = &named.dataset.steps;
    let found: Option<&Step> = step.map_or(steps.last(), |step| steps.get(step));
    let none = || PlotError::Step { name: named.name.to_owned(), step: step.unwrap_or(0) };
    found.map(|step| SolverReport::of(&step.history)).ok_or_else(none)
}

fn not_iterated(named: &NamedDataset<'_>, what: &'static str) -> PlotError {
    PlotError::NotIterated { name: named.name.to_owned(), what }
}

/// The residual after each iteration as a part of the first one, on a logarithmic axis; of one
/// dataset also what of it reaches each level, as a part of what did at first.
fn residuals(datasets: &[NamedDataset<'_>], step: Option<usize>) -> Result<Plot, PlotError> {
    let mut curves = Vec::new();
    for named in datasets {
        let report = report(named, step)?;
        if report.residuals.len() < 2 {
            return Err(not_iterated(named, "iterations"));
        }
        let name = label(datasets.len() > 1, named.name, "residual");
        curves
            .push(PlotCurve::new(name, numbered(&report.residuals)).with_look(CurveStyle::Dotted));
        if datasets.len() == 1 {
            curves.extend(on_levels(&report));
        }
    }
    let (x, y) = (PlotAxis::new("iteration", ""), PlotAxis::new("relative residual", ""));
    Ok(Plot { x, y: y.logarithmic(), curves, ..Plot::default() })
}

fn on_levels(report: &SolverReport) -> impl Iterator<Item = PlotCurve> + '_ {
    let count = report.level_residuals.iter().map(Vec::len).max().unwrap_or(0);
    let values = |level: usize| {
        let first = report.level_residuals.first().and_then(|of| of.get(level)).copied();
        let part =
            move |of: &Vec<f64>| of.get(level).map_or(f64::NAN, |r| r / first.unwrap_or(1.0));
        report.level_residuals.iter().map(part).collect::<Vec<_>>()
    };
    let last = count.saturating_sub(1);
    let name = move |level: usize| match level {
        0 => "on level 0, the finest".to_owned(),
        level if level == last => format!("on level {level}, the coarsest"),
        level => format!("on level {level}"),
    };
    let levels = if count > 1 { 0..count } else { 0..0 };
    levels.map(move |level| {
        PlotCurve::new(name(level), numbered(&values(level))).with_look(CurveStyle::Dashed)
    })
}

fn numbered(values: &[f64]) -> Vec<[f64; 2]> {
    values.iter().enumerate().map(|(k, value)| [k as f64, *value]).collect()
}

/// Plots the residuals of the levels, the finest being level 0, on a logarithmic axis.
fn levels(datasets: &[NamedDataset<'_>], step: Option<usize>) -> Result<Plot, PlotError> {
    let mut curves = Vec::new();
    let mut most = 0;
    for named in datasets {
        let report = report(named, step)?;
        if report.levels.is_empty() {
            return Err(not_iterated(named, "levels"));
        }
        most = most.max(report.levels.len());
        let values = |number: fn(&ppum_solve::report::LevelSize) -> f64| {
            numbered(&report.levels.iter().map(number).collect::<Vec<_>>())
        };
        let curve = |name: &str, points| {
            PlotCurve::new(label(datasets.len() > 1, named.name, name), points)
                .with_look(CurveStyle::Dotted)
        };
        curves.push(curve("values of the matrix", values(|level| level.values)));
        curves.push(curve("unknowns", values(|level| level.unknowns)));
        curves.push(curve("patches", values(|level| level.patches)));
    }
    let mut x = PlotAxis::new("level, 0 the finest", "");
    x.marks = (0..most).map(|level| level as f64).collect();
    let y = PlotAxis::new("number", "").logarithmic();
    Ok(Plot { x, y, curves, ..Plot::default() })
}
