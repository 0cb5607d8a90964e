//! The renderers: table 1 of Üffinger et al. 2011, and further.
//!
//! A frame is displacement, gradient, von Mises stress and colours. Every frame has a view of its own, so that
//! none is better aligned with the cells than another; all rows and methods take turns, so that a machine
//! that grows busy slows all of them down.

mod table;

use std::path::Path;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher};
use ppum::quantity::Quantity;
use ppum_render::view::View;
use ppum_scene::scene::default_quantity;
use serde::Serialize;

use super::frames::{Adapter, Subject, Summary, Times, WAYS, Way, moved, style};
use super::paper::published;
use super::synthetic::Recipe;
use crate::dataset;
use crate::graphics::Cards;
use crate::progress::Bar;

/// The report of `ppum bench` on the renderers.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pixels: [u32; 2],
    frames: u32,
    /// The graphics adapter.
    adapter: Option<Adapter>,
    /// The reason why there is none.
    missing: Option<String>,
    rows: Vec<Row>,
    /// Time of gathering the most patches over that of 16, uniform covers.
    gather_growth: Option<f64>,
}

/// A cover.
#[derive(Debug, Serialize)]
struct Row {
    cover: &'static str,
    patches: usize,
    /// The paper's time, milliseconds on a GeForce GTX 470.
    paper_ms: Option<f64>,
    methods: Vec<Timed>,
    splat_over_gather: Option<f64>,
}

/// The frames of a cover and method.
#[derive(Debug, Serialize)]
struct Timed {
    method: &'static str,
    /// Time that passes.
    wall_ms: Summary,
    /// Processor time of all threads; not of hardware, which has other processors.
    core_ms: Option<Summary>,
}

/// Uniform covers, by level, and graded ones, by the levels far from the tips and at them.
const UNIFORM: [u8; 9] = [2, 3, 4, 5, 6, 7, 8, 9, 10];
const GRADED: [[u8; 2]; 4] = [[3, 10], [4, 14], [5, 14], [6, 14]];

/// A cover with all that draws it, and what its frames take.
struct Measured<'d> {
    cover: &'static str,
    subject: Subject<'d>,
    times: [Times; 4],
}

impl Report {
    /// Measures the dataset of a file, or if there is none a crack on many covers; `quick` takes small pictures of few patches.
    pub(super) fn new(quick: bool, frames: u32, file: Option<&Path>) -> anyhow::Result<Self> {
        let pixels = if quick { [256, 192] } else { [1024, 768] };
        let (mut cards, missing) = match Cards::open() {
            Ok(cards) => (Some(cards), None),
            Err(reason) => (None, Some(reason)),
        };
        let datasets = match file {
            Some(path) => vec![("file", dataset::open_step(path, None)?)],
            None => synthetic(quick)?,
        };
        let fields = datasets.iter().map(|(_, dataset)| dataset::field(dataset, None));
        let fields = fields.collect::<anyhow::Result<Vec<_>>>()?;
        let named = datasets.iter().map(|(cover, _)| *cover).zip(&fields);
        let all = named.map(|(cover, field)| Measured::new(cover, field, cards.as_mut()));
        let mut all = all.collect::<anyhow::Result<Vec<_>>>()?;
        // the first frames are not counted: they find nothing prepared
        let (bar, total) = (Bar::new(), (frames as usize + 1) * all.len());
        let watcher: &dyn Watcher = &bar;
        for frame in 0..=frames {
            for (k, measured) in all.iter_mut().enumerate() {
                let done = frame as usize * fields.len() + k;
                watcher.report(Progress::new(Phase::Evaluation, done, total))?;
                let bounds = measured.subject.field.domain.bounds;
                let view = moved(View::fit(bounds, pixels)?, frame)?;
                measured.draw_all(&view, cards.as_mut(), frame > 0)?;
            }
        }
        let has_core = cards.as_ref().is_none_or(Cards::is_software);
        let mut rows: Vec<_> = all.iter().map(|measured| measured.row(has_core)).collect();
        if !quick {
            rows.iter_mut().for_each(Row::compare);
        }
        let adapter = cards.as_ref().map(Adapter::of);
        let gather_growth = growth(&rows);
        Ok(Self { pixels, frames, adapter, missing, rows, gather_growth })
    }
}

/// Names of covers, and the crack on them.
fn synthetic(quick: bool) -> anyhow::Result<Vec<(&'static str, Dataset)>> {
    let (uniform, graded) =
        if quick { (&UNIFORM[..3], &[[2, 5]][..]) } else { (&UNIFORM[..], &GRADED[..]) };
    let uniform = uniform.iter().map(|&level| ("uniform", [level; 2]));
    let all = uniform.chain(graded.iter().map(|&levels| ("graded", levels)));
    all.map(|(cover, [level, tip])| Ok((cover, Recipe::new(level, tip).dataset()?))).collect()
}

impl<'d> Measured<'d> {
    fn new(
        cover: &'static str,
        field: &'d Field<'d>,
        cards: Option<&mut Cards>,
    ) -> anyhow::Result<Self> {
        let quantity = Quantity::parse(default_quantity(field), field)?;
        let subject = Subject::new(field, (quantity, style(1.0)), cards, true)?;
        Ok(Self { cover, subject, times: Default::default() })
    }

    fn draw_all(
        &mut self,
        view: &View,
        mut cards: Option<&mut Cards>,
        counts: bool,
    ) -> anyhow::Result<()> {
        let mut ways = WAYS.into_iter().zip(&mut self.times);
        ways.try_for_each(|(way, times)| {
            times.take(counts, || self.subject.draw(way, view, cards.as_deref_mut()))
        })
    }

    fn row(&self, has_core: bool) -> Row {
        let patches = self.subject.field.step.partition.len();
        let timed = WAYS.into_iter().zip(&self.times).filter(|(_, times)| !times.is_empty());
        let methods: Vec<_> = timed
            .map(|(way, times)| {
                let core_ms = (way.is_on_cpu() || has_core).then(|| times.core());
                Timed { method: way.name(), wall_ms: times.wall(), core_ms }
            })
            .collect();
        let time = |way: Way| cost(&methods, way);
        let splat_over_gather = time(Way::Splat).zip(time(Way::Gather)).map(|(a, b)| a / b);
        Row { cover: self.cover, patches, paper_ms: None, methods, splat_over_gather }
    }
}

/// The time that ratios are made of: processor time where there is one, else wall time.
fn cost(methods: &[Timed], way: Way) -> Option<f64> {
    let timed = methods.iter().find(|timed| timed.method == way.name())?;
    Some(timed.core_ms.unwrap_or(timed.wall_ms).median)
}

/// Time of gathering the most patches over that of the fewest, uniform covers.
fn growth(rows: &[Row]) -> Option<f64> {
    let mut uniform = rows.iter().filter(|row| row.cover == "uniform");
    let first = cost(&uniform.next()?.methods, Way::Gather)?;
    Some(cost(&uniform.next_back()?.methods, Way::Gather)? / first)
}

impl Row {
    /// Puts the paper's number beside those that were measured.
    fn compare(&mut self) {
        self.paper_ms = published(self.patches).filter(|_| self.cover == "uniform");
    }
}
