//! The solver's results in each step of a series.

use std::str::FromStr;

use ppum::crack::{Crack, TipId};
use ppum::dataset::{Dataset, Step};
use ppum_figure::plot::{CurveStyle, Plot, PlotAxis, PlotCurve};

use super::{NamedDataset, PlotError, label, title};

/// The horizontal axis of a plot of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[derive(serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeriesAxis {
    /// Their numbers
    #[default]
    Step,
    /// Their load factors or times
    Load,
    /// The length of all cracks
    Length,
    /// The growth of the tip since the first step, of load and length that of all tips
    Extension,
    /// Load cycles
    Cycles,
}

/// A number of a step, or of each of its tips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesNumber {
    /// K_I of each tip.
    K1,
    /// K_II of each tip.
    K2,
    /// The load factor or time.
    Load,
    /// The length of all cracks.
    Length,
    /// The growth of each tip since the first step.
    Extension,
}

/// Their words.
const NAMES: [(&str, SeriesNumber); 5] = [
    ("k1", SeriesNumber::K1),
    ("k2", SeriesNumber::K2),
    ("load", SeriesNumber::Load),
    ("length", SeriesNumber::Length),
    ("extension", SeriesNumber::Extension),
];

impl FromStr for SeriesNumber {
    type Err = PlotError;

    fn from_str(text: &str) -> Result<Self, PlotError> {
        let found = NAMES.iter().find(|(known, _)| *known == text).map(|(_, number)| *number);
        found.ok_or_else(|| {
            let known = NAMES.map(|(name, _)| name);
            let [others @ .., last] = &known;
            let known = format!("{} and {last}", others.join(", "));
            PlotError::UnknownNumber { name: text.to_owned(), known }
        })
    }
}

/// A curve for each number of each dataset, of stress intensity factors for each tip.
///
/// # Errors
/// A dataset of one step, or one that does not know the number.
pub fn series(
    datasets: &[NamedDataset<'_>],
    numbers: &[SeriesNumber],
    over: SeriesAxis,
) -> Result<Plot, PlotError> {
    let mut plot = Plot { x: axis(over), y: value_axis(numbers), ..Plot::default() };
    for named in datasets {
        if named.dataset.steps.len() < 2 {
            return Err(PlotError::OneStep(named.name.to_owned()));
        }
        needs(named, numbers, over)?;
        for &number in numbers {
            for (name, points) in curves(named.dataset, number, over) {
                let curve = PlotCurve::new(label(datasets.len() > 1, named.name, &name), points);
                plot.curves.push(curve.with_look(CurveStyle::Dotted));
            }
        }
    }
    if plot.curves.is_empty() {
        return Err(PlotError::NoIntensities);
    }
    plot.title = title(datasets.iter().map(|named| named.dataset.title.as_str()));
    Ok(plot)
}

fn axis(over: SeriesAxis) -> PlotAxis {
    match over {
        SeriesAxis::Step => PlotAxis::new("step", ""),
        SeriesAxis::Load => PlotAxis::new("load", ""),
        SeriesAxis::Length => PlotAxis::new("crack length", ""),
        SeriesAxis::Extension => PlotAxis::new("crack extension", ""),
        SeriesAxis::Cycles => PlotAxis::new("load cycles", ""),
    }
}

/// The axis of values, with a name if they are all of one kind.
fn value_axis(numbers: &[SeriesNumber]) -> PlotAxis {
    let name = |number: &SeriesNumber| match number {
        SeriesNumber::K1 | SeriesNumber::K2 => "stress intensity factor",
        SeriesNumber::Load => "load",
        SeriesNumber::Length => "crack length",
        SeriesNumber::Extension => "crack extension",
    };
    let first = numbers.first().map_or("", name);
    let is_one = numbers.iter().all(|number| name(number) == first);
    PlotAxis::new(if is_one { first } else { "" }, "")
}

fn length(step: &Step) -> f64 {
    step.cracks.iter().map(Crack::length).sum()
}

/// Refuses what a dataset does not know: extensions and cycles are those of cracks that grow.
fn needs(
    named: &NamedDataset<'_>,
    numbers: &[SeriesNumber],
    over: SeriesAxis,
) -> Result<(), PlotError> {
    let growth = || named.dataset.steps.iter().filter_map(|step| step.growth.as_ref());
    let needs_growth = over == SeriesAxis::Extension || numbers.contains(&SeriesNumber::Extension);
    if needs_growth && growth().next().is_none() {
        return Err(PlotError::NoGrowth(named.name.to_owned()));
    }
    if over == SeriesAxis::Cycles && !growth().any(|growth| growth.cycles.is_some()) {
        return Err(PlotError::NoCycles(named.name.to_owned()));
    }
    Ok(())
}

/// The curves of a number with their names.
fn curves(
    dataset: &Dataset,
    number: SeriesNumber,
    over: SeriesAxis,
) -> Vec<(String, Vec<[f64; 2]>)> {
    let extensions = Extensions::new(dataset);
    let place = |k: usize, tip: Option<TipId>| {
        let step = &dataset.steps[k];
        match (over, tip) {
            (SeriesAxis::Step, _) => Some(k as f64),
            (SeriesAxis::Load, _) => Some(step.load),
            (SeriesAxis::Length, _) => Some(length(step)),
            (SeriesAxis::Extension, Some(tip)) => extensions.of(k, tip),
            (SeriesAxis::Extension, None) => Some(extensions.of_all(k)),
            (SeriesAxis::Cycles, _) => step.growth.as_ref()?.cycles,
        }
    };
    let points = |tip: Option<TipId>, value: &dyn Fn(usize, &Step) -> Option<f64>| {
        let point = |(k, step): (usize, &Step)| Some([place(k, tip)?, value(k, step)?]);
        dataset.steps.iter().enumerate().filter_map(point).collect::<Vec<_>>()
    };
    let symbol = match number {
        SeriesNumber::K1 => "K_{I}",
        SeriesNumber::K2 => "K_{II}",
        SeriesNumber::Load => {
            return vec![("load".into(), points(None, &|_, step| Some(step.load)))];
        }
        SeriesNumber::Length => {
            return vec![("crack length".into(), points(None, &|_, step| Some(length(step))))];
        }
        SeriesNumber::Extension => "extension",
    };
    let tips = tips(dataset);
    let of_tip = |(which, &tip): (usize, &TipId)| {
        let factors = |step: &Step| {
            let found = step.intensities.iter().find(|found| found.tip == tip)?;
            Some(if number == SeriesNumber::K1 { found.k1 } else { found.k2 })
        };
        let value = |k: usize, step: &Step| match number {
            SeriesNumber::Extension => extensions.of(k, tip),
            _ => factors(step),
        };
        let name = if tips.len() > 1 { format!("{symbol} of tip {which}") } else { symbol.into() };
        (name, points(Some(tip), &value))
    };
    tips.iter().enumerate().map(of_tip).collect()
}

/// The extensions of the tips up to each step. A tip that has met something has grown no more
/// since.
struct Extensions {
    steps: Vec<Vec<(TipId, f64)>>,
}

impl Extensions {
    fn new(dataset: &Dataset) -> Self {
        let (mut known, mut steps) = (Vec::<(TipId, f64)>::new(), Vec::new());
        for step in &dataset.steps {
            let rows = step.growth.iter().flat_map(|growth| &growth.tips);
            let mut grown: Vec<_> = rows.clone().map(|row| (row.tip, row.extension)).collect();
            let is_new = |(tip, _): &&(TipId, f64)| rows.clone().all(|row| row.tip != *tip);
            grown.extend(known.iter().filter(is_new).copied().collect::<Vec<_>>());
            steps.push(grown.clone());
            // what the tips have in the next step if they are none any more
            for row in rows {
                let found = grown.iter_mut().find(|(tip, _)| *tip == row.tip);
                found.into_iter().for_each(|(_, extension)| *extension += row.length);
            }
            known = grown;
        }
        Self { steps }
    }

    fn of(&self, step: usize, tip: TipId) -> Option<f64> {
        let found = self.steps[step].iter().find(|(known, _)| *known == tip);
        found.map(|(_, extension)| *extension)
    }

    fn of_all(&self, step: usize) -> f64 {
        self.steps[step].iter().map(|(_, extension)| extension).sum()
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::End;
    use ppum::dataset::{Growth, TipIncrement, TipIntensity, TipStatus};
    use ppum_testkit::synthetic::growing;

    /// Two tips: one grows by ½ in steps 0 and 1 and meets the border in the second, the other by ¼
    /// in step 1 alone.
    #[test]
    fn extensions_stay_when_tips_have_ended() {
        let mut dataset = growing(4);
        let [a, b] = [End::Start, End::Last].map(|end| TipId { crack: 0, end });
        for (k, step) in dataset.steps.iter_mut().enumerate() {
            let row = |tip, length: f64, extension: f64| {
                let fate = if length > 0.0 { TipStatus::Grows } else { TipStatus::Held };
                TipIncrement { length, extension, ..TipIncrement::staying(tip, fate) }
            };
            let mut growth = Growth::default();
            if k < 2 {
                growth.tips.push(row(a, 0.5, 0.5 * k as f64));
            }
            let quarter = |is_so: bool| if is_so { 0.25 } else { 0.0 };
            growth.tips.push(row(b, quarter(k == 1), quarter(k > 1)));
            growth.cycles = Some(10.0 * k as f64);
            step.growth = Some(growth);
            step.intensities = vec![TipIntensity::new(b, 1.0 + k as f64, 0.0)];
        }
        let extensions = Extensions::new(&dataset);
        let of = |tip| (0..4).map(|k| extensions.of(k, tip)).collect::<Vec<_>>();
        assert_eq!(of(a), [0.0, 0.5, 1.0, 1.0].map(Some));
        assert_eq!(of(b), [0.0, 0.0, 0.25, 0.25].map(Some));
        assert_eq!([0, 1, 2, 3].map(|k| extensions.of_all(k)), [0.0, 0.5, 1.25, 1.25]);
        // what is drawn over them
        let found = curves(&dataset, SeriesNumber::K1, SeriesAxis::Extension);
        assert_eq!(found[0].1, [[0.0, 1.0], [0.0, 2.0], [0.25, 3.0], [0.25, 4.0]]);
        let found = curves(&dataset, SeriesNumber::Extension, SeriesAxis::Cycles);
        assert_eq!(found[0].1, [[0.0, 0.0], [10.0, 0.0], [20.0, 0.25], [30.0, 0.25]]);
        let found = curves(&dataset, SeriesNumber::Load, SeriesAxis::Extension);
        assert!(
            (found[0].1[2][0] - 1.25).abs() < 1e-15 && found[0].1[2][1] == dataset.steps[2].load
        );
    }
}
