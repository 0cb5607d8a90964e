//! The renderers: table 1 of Üffinger et al. 2011, and further.
//!
//! A frame is displacement, gradient, von Mises stress and colours. Every frame has a view of its own, so that
//! none is better aligned with the cells than another; all rows and methods take turns, so that a machine
//! that grows busy slows all of them down.

mod table;

use std::hint::black_box;
use std::time::Instant;

use cpu_time::ProcessTime;
use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher, unwatched};
use ppum::quantity::Quantity;
use ppum::vec2::vec2;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Range;
use ppum_render::raster::Sample;
use ppum_render::scatter::render;
use ppum_render::view::View;
use serde::Serialize;

use super::synthetic::{self, DOMAIN};
use crate::graphics::{Card, Cards, Method};
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

#[derive(Debug, Serialize)]
struct Adapter {
    name: String,
    kind: &'static str,
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

#[derive(Clone, Copy, Debug, Serialize)]
struct Summary {
    median: f64,
    least: f64,
}

/// Table 1: patches, milliseconds.
const PAPER: [(usize, f64); 6] =
    [(16, 2.33), (64, 2.38), (256, 2.48), (1024, 2.89), (4096, 4.76), (16384, 11.76)];

/// Uniform covers, by level, and graded ones, by the levels far from the tips and at them.
const UNIFORM: [u8; 9] = [2, 3, 4, 5, 6, 7, 8, 9, 10];
const GRADED: [[u8; 2]; 4] = [[3, 10], [4, 14], [5, 14], [6, 14]];

/// Most patches that are splatted: the paper's.
const MOST_SPLATTED: usize = 16384;

/// The stress far from the crack is 1.
const RANGE: Range = Range::Fixed(0.0, 4.0);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Splat,
    Gather,
    CpuF64,
    CpuF32,
}

const WAYS: [Way; 4] = [Way::Splat, Way::Gather, Way::CpuF64, Way::CpuF32];

impl Way {
    fn name(self) -> &'static str {
        match self {
            Self::Splat => "splat",
            Self::Gather => "gather",
            Self::CpuF64 => "cpu f64",
            Self::CpuF32 => "cpu f32",
        }
    }
}

/// A cover with all that draws it, and the seconds of its frames, wall and processor.
struct Subject<'d> {
    cover: &'static str,
    field: &'d Field<'d>,
    card: Option<Card<'d>>,
    seconds: [Vec<[f64; 2]>; 4],
}

impl Report {
    /// Measures; `quick` takes small pictures of few patches.
    pub(super) fn new(quick: bool, frames: u32) -> anyhow::Result<Self> {
        let pixels = if quick { [256, 192] } else { [1024, 768] };
        let (mut cards, missing) = match Cards::open() {
            Ok(cards) => (Some(cards), None),
            Err(reason) => (None, Some(reason)),
        };
        let covers = covers(quick);
        let datasets =
            covers.iter().map(|&(_, [level, tip_level])| synthetic::dataset(level, tip_level));
        let datasets = datasets.collect::<anyhow::Result<Vec<_>>>()?;
        let fields =
            datasets.iter().map(|dataset| Field::new(dataset, 0)).collect::<Result<Vec<_>, _>>()?;
        let look = Style { range: RANGE, ..Style::default() };
        let named = covers.iter().map(|&(cover, _)| cover).zip(&fields);
        let subjects =
            named.map(|(cover, field)| Subject::new(cover, field, cards.as_mut(), &look));
        let mut subjects = subjects.collect::<anyhow::Result<Vec<_>>>()?;
        // the first frames are not counted: they find nothing prepared
        let (bar, total) = (Bar::new(), (frames as usize + 1) * subjects.len());
        let watcher: &dyn Watcher = &bar;
        for frame in 0..=frames {
            let view = view(frame, pixels)?;
            for (k, subject) in subjects.iter_mut().enumerate() {
                let done = frame as usize * covers.len() + k;
                watcher.report(Progress::new(Phase::Evaluation, done, total))?;
                subject.draw_all((&view, &look), cards.as_mut(), frame > 0)?;
            }
        }
        let has_core = cards.as_ref().is_none_or(Cards::is_software);
        let mut rows: Vec<_> = subjects.iter().map(|subject| subject.row(has_core)).collect();
        if !quick {
            rows.iter_mut().for_each(Row::compare);
        }
        let adapter =
            cards.as_ref().map(|cards| Adapter { name: cards.name(), kind: cards.kind() });
        let gather_growth = growth(&rows);
        Ok(Self { pixels, frames, adapter, missing, rows, gather_growth })
    }
}

/// Name, level and level at the tips.
fn covers(quick: bool) -> Vec<(&'static str, [u8; 2])> {
    let (uniform, graded) =
        if quick { (&UNIFORM[..3], &[[2, 5]][..]) } else { (&UNIFORM[..], &GRADED[..]) };
    let uniform = uniform.iter().map(|&level| ("uniform", [level; 2]));
    uniform.chain(graded.iter().map(|&levels| ("graded", levels))).collect()
}

/// A view of all of the plate but for a part of a cell, another one each time: offsets by the golden
/// ratio and its like are commensurate with no cells.
fn view(frame: u32, pixels: [u32; 2]) -> anyhow::Result<View> {
    let part = |ratio: f64| 0.004 * ((f64::from(frame) * ratio).fract() - 0.5);
    let center = DOMAIN.center() + vec2(part(0.618_033_988_75), part(0.754_877_666_25));
    Ok(View::new(center, 0.9973 * DOMAIN.size().x, pixels)?)
}

impl<'d> Subject<'d> {
    fn new(
        cover: &'static str,
        field: &'d Field<'d>,
        cards: Option<&mut Cards>,
        look: &Style,
    ) -> anyhow::Result<Self> {
        let may_splat = field.step.partition.len() <= MOST_SPLATTED;
        let card = cards.map(|cards| Card::new(cards, field, look, may_splat)).transpose()?;
        Ok(Self { cover, field, card, seconds: Default::default() })
    }

    fn draw_all(
        &mut self,
        (view, look): (&View, &Style),
        mut cards: Option<&mut Cards>,
        counts: bool,
    ) -> anyhow::Result<()> {
        for (k, way) in WAYS.into_iter().enumerate() {
            let (wall, core) = (Instant::now(), ProcessTime::now());
            let drawn = self.draw(way, (view, look), cards.as_deref_mut())?;
            if drawn && counts {
                self.seconds[k]
                    .push([wall.elapsed(), core.elapsed()].map(|time| time.as_secs_f64()));
            }
        }
        Ok(())
    }

    /// False if this way is not gone.
    fn draw(
        &mut self,
        way: Way,
        (view, look): (&View, &Style),
        cards: Option<&mut Cards>,
    ) -> anyhow::Result<bool> {
        match (way, &mut self.card, cards) {
            (Way::CpuF64, ..) => on_cpu::<f64>(self.field, view, look)?,
            (Way::CpuF32, ..) => on_cpu::<f32>(self.field, view, look)?,
            (Way::Splat, Some(card), Some(cards)) => return card.draw(cards, Method::Splat, view),
            (Way::Gather, Some(card), Some(cards)) => {
                return card.draw(cards, Method::Gather, view);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn row(&self, has_core: bool) -> Row {
        let patches = self.field.step.partition.len();
        let timed = WAYS.into_iter().zip(&self.seconds).filter(|(_, seconds)| !seconds.is_empty());
        let methods: Vec<_> = timed
            .map(|(way, seconds)| {
                let on_cpu = matches!(way, Way::CpuF64 | Way::CpuF32);
                let core_ms = (on_cpu || has_core).then(|| Summary::new(seconds, 1));
                Timed { method: way.name(), wall_ms: Summary::new(seconds, 0), core_ms }
            })
            .collect();
        let time = |way: Way| cost(&methods, way);
        let splat_over_gather = time(Way::Splat).zip(time(Way::Gather)).map(|(a, b)| a / b);
        Row { cover: self.cover, patches, paper_ms: None, methods, splat_over_gather }
    }
}

/// Draws and colours in `T`.
fn on_cpu<T: Sample>(field: &Field<'_>, view: &View, look: &Style) -> anyhow::Result<()> {
    let raster = render::<T>(field, view, &Quantity::VonMises, unwatched())?;
    black_box(Picture::bare(&raster, view, look)?);
    Ok(())
}

impl Summary {
    /// Of seconds, wall (0) or processor (1).
    fn new(seconds: &[[f64; 2]], which: usize) -> Self {
        let mut ms: Vec<_> = seconds.iter().map(|pair| 1e3 * pair[which]).collect();
        ms.sort_by(f64::total_cmp);
        let (lower, upper) = (ms[(ms.len() - 1) / 2], ms[ms.len() / 2]);
        Self { median: 0.5 * (lower + upper), least: ms[0] }
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
        let row = PAPER.iter().find(|row| self.cover == "uniform" && row.0 == self.patches);
        self.paper_ms = row.map(|row| row.1);
    }
}
