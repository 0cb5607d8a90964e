//! What the solver found in each step of a series.

use anyhow::{bail, ensure};
use clap::ValueEnum;
use ppum::crack::{Crack, TipId};
use ppum::dataset::{Dataset, Step};
use ppum_figure::plot::{Curve, Look, Plot, PlotAxis};

use super::{Named, label};
use crate::given::parts;

/// What steps are drawn over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Over {
    /// Their numbers
    #[default]
    Step,
    /// Their load factors or times
    Load,
    /// The length of all cracks
    Length,
}

/// A number of a step, or of each of its tips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    K1,
    K2,
    Load,
    Length,
}

/// Their names in options.
const NAMES: [(&str, Number); 4] =
    [("k1", Number::K1), ("k2", Number::K2), ("load", Number::Load), ("length", Number::Length)];

/// A curve for each number of each dataset, of stress intensity factors for each tip.
pub(super) fn plot(datasets: &[Named], wanted: &[String], over: Over) -> anyhow::Result<Plot> {
    let numbers = asked(wanted)?;
    let mut plot = Plot { x: axis(over), y: value_axis(&numbers), ..Plot::default() };
    for named in datasets {
        ensure!(
            named.dataset.steps.len() > 1,
            "{}: --series draws over steps, but there is one alone",
            named.name
        );
        for &number in &numbers {
            for (name, points) in curves(&named.dataset, number, over) {
                let curve = Curve::new(label(datasets, named, &name), points);
                plot.curves.push(curve.with_look(Look::Dotted));
            }
        }
        plot.title.clone_from(&named.dataset.title);
    }
    ensure!(!plot.curves.is_empty(), "the steps hold no stress intensity factors");
    if datasets.iter().any(|named| named.dataset.title != plot.title) {
        plot.title.clear();
    }
    Ok(plot)
}

/// The numbers that are asked for, by default K_I and K_II.
fn asked(wanted: &[String]) -> anyhow::Result<Vec<Number>> {
    if wanted.is_empty() {
        return Ok(vec![Number::K1, Number::K2]);
    }
    let mut numbers = Vec::new();
    for name in wanted.iter().flat_map(|list| parts(list)) {
        let Some((_, number)) = NAMES.iter().find(|(known, _)| *known == name) else {
            bail!("--series draws k1, k2, load and length, not `{name}`");
        };
        numbers.push(*number);
    }
    Ok(numbers)
}

fn axis(over: Over) -> PlotAxis {
    match over {
        Over::Step => PlotAxis::new("step", ""),
        Over::Load => PlotAxis::new("load", ""),
        Over::Length => PlotAxis::new("crack length", ""),
    }
}

/// The axis of values, with a name if they are all of one kind.
fn value_axis(numbers: &[Number]) -> PlotAxis {
    let name = |number: &Number| match number {
        Number::K1 | Number::K2 => "stress intensity factor",
        Number::Load => "load",
        Number::Length => "crack length",
    };
    let first = numbers.first().map_or("", name);
    let is_one = numbers.iter().all(|number| name(number) == first);
    PlotAxis::new(if is_one { first } else { "" }, "")
}

fn length(step: &Step) -> f64 {
    step.cracks.iter().map(Crack::length).sum()
}

/// The curves of a number with their names.
fn curves(dataset: &Dataset, number: Number, over: Over) -> Vec<(String, Vec<[f64; 2]>)> {
    let place = |(k, step): (usize, &Step)| match over {
        Over::Step => k as f64,
        Over::Load => step.load,
        Over::Length => length(step),
    };
    let steps = || dataset.steps.iter().enumerate();
    let of_steps = |value: fn(&Step) -> f64| {
        steps().map(|(k, step)| [place((k, step)), value(step)]).collect::<Vec<_>>()
    };
    let symbol = match number {
        Number::K1 => "K_{I}",
        Number::K2 => "K_{II}",
        Number::Load => return vec![("load".into(), of_steps(|step| step.load))],
        Number::Length => return vec![("crack length".into(), of_steps(length))],
    };
    let tips = tips(dataset);
    let of_tip = |(which, tip): (usize, &TipId)| {
        let value = |step: &Step| {
            let found = step.intensities.iter().find(|found| found.tip == *tip)?;
            Some(if number == Number::K1 { found.k1 } else { found.k2 })
        };
        let points = steps().filter_map(|(k, step)| Some([place((k, step)), value(step)?]));
        let name = if tips.len() > 1 { format!("{symbol} of tip {which}") } else { symbol.into() };
        (name, points.collect())
    };
    tips.iter().enumerate().map(of_tip).collect()
}

/// The tips that have factors in any step, in the order in which they come up.
fn tips(dataset: &Dataset) -> Vec<TipId> {
    let mut tips = Vec::new();
    for found in dataset.steps.iter().flat_map(|step| &step.intensities) {
        if !tips.contains(&found.tip) {
            tips.push(found.tip);
        }
    }
    tips
}
