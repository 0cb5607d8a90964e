//! The frame of a plot: its place on the page, ticks, grid and words.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::scale::Normalization;

use super::curves::{Plot, PlotAxis, has_place, scale_of};
use crate::canvas::{Align, CanvasItem, CanvasPath, StrokeStyle};
use crate::figure::axis_label;
use crate::figure::ink::Ink;
use crate::overlay::line_scale;
use crate::text::{self, CAP_HEIGHT};
use crate::ticks::{self, Tick, Ticks};

pub(super) const PAPER: Rgba = [255, 255, 255, 255];
const INK: Rgba = [38, 38, 42, 255];
const GRID: Rgba = [226, 226, 230, 255];
// Lengths in pixels of a plot of 1024 × 768; others are scaled.
const TICK_TEXT: f64 = 13.0;
const LABEL_TEXT: f64 = 14.0;
const TITLE_TEXT: f64 = 17.0;
const TICK: f64 = 5.0;
const MINOR_TICK: f64 = 3.0;
const GAP: f64 = 6.0;
const MARGIN: f64 = 16.0;
/// Length of a line's sample in the row of names, and the height of that row.
const SAMPLE: f64 = 26.0;
const NAMES: f64 = 18.0;
/// Marks in so many intervals have labels at round numbers of them.
const FEW: usize = 11;
/// Least distances of labelled ticks, across and along the direction of reading.
const DISTANCE: [f64; 2] = [90.0, 48.0];

/// The least size of a plot.
pub const LEAST: [u32; 2] = [240, 180];

/// The positions of a plot's axes, ticks and labels.
pub(super) struct PlotFrame {
    /// Columns and rows of the page.
    pub(super) size: [u32; 2],
    pub(super) scale: f64,
    /// Upper left and lower right corner of the curves' page, whole pixels.
    min: [f64; 2],
    max: [f64; 2],
    pub(super) norms: [Normalization; 2],
    ticks: [Ticks; 2],
    /// Longest label of the vertical axis.
    widest: f64,
}

impl PlotFrame {
    pub(super) fn new(plot: &Plot, size: [u32; 2]) -> Self {
        let size = [0, 1].map(|k| size[k].max(LEAST[k]));
        let norms = [0, 1].map(|k| scale_of(plot, k));
        let scale = line_scale(size);
        let most = |k: usize| (f64::from(size[k]) / (DISTANCE[k] * scale)) as usize;
        let ticks = [(&plot.x, 0), (&plot.y, 1)].map(|(axis, k)| match () {
            () if !axis.names.is_empty() => named(&axis.names, &norms[k]),
            () if !axis.marks.is_empty() => marked(&axis.marks, &norms[k], most(k).clamp(2, 10)),
            () => ticks::bar(&norms[k], most(k).clamp(2, 10)),
        });
        let widths = ticks[1].major.iter().map(|t| text::width(&t.label, TICK_TEXT * scale));
        let widest = widths.fold(0.0, f64::max);
        let below = TICK + GAP + TICK_TEXT + GAP + 1.3 * LABEL_TEXT + MARGIN;
        let above = if plot.title.is_empty() { MARGIN } else { TITLE_TEXT + 2.0 * MARGIN };
        let above = if plot.has_names_above { above + NAMES } else { above };
        let left = MARGIN + 1.3 * LABEL_TEXT + 2.0 * GAP + TICK;
        let min = [(left * scale + widest).round(), (above * scale).round()];
        let [columns, rows] = size.map(f64::from);
        let max = [
            (columns - 2.0 * MARGIN * scale).round().max(min[0] + 8.0),
            (rows - below * scale).round().max(min[1] + 8.0),
        ];
        Self { size, scale, min, max, norms, ticks, widest }
    }

    /// Columns and rows of the curves' page.
    pub(super) fn pixels(&self) -> [u32; 2] {
        [0, 1].map(|k| (self.max[k] - self.min[k]) as u32)
    }

    /// The corner of the curves' page.
    pub(super) fn corner(&self) -> [u32; 2] {
        self.min.map(|c| c as u32)
    }

    /// True if the axes have a place for a point.
    pub(super) fn has_place(&self, point: [f64; 2]) -> bool {
        self.norms.iter().zip(point).all(|(norm, v)| has_place(norm.scale(), v))
    }

    /// The position of a point on the curves' page; far outside of it, but not too far to be drawn,
    /// where the point is.
    pub(super) fn position(&self, point: [f64; 2]) -> Vec2 {
        let [columns, rows] = self.pixels().map(f64::from);
        let [x, y] = [0, 1].map(|k| self.norms[k].position(point[k]).clamp(-100.0, 100.0));
        vec2(x * columns, (1.0 - y) * rows)
    }

    /// Column of the page for a place along the horizontal axis.
    fn across(&self, at: f64) -> f64 {
        self.min[0] + at * (self.max[0] - self.min[0])
    }

    /// Row of the page for a place along the vertical axis.
    fn down(&self, at: f64) -> f64 {
        self.max[1] - at * (self.max[1] - self.min[1])
    }

    /// Thin lines at the labelled ticks.
    pub(super) fn grid(&self) -> Vec<CanvasItem> {
        let mut path = CanvasPath::default();
        for tick in &self.ticks[0].major {
            let x = self.across(tick.at).round() - 0.5;
            path.line(vec2(x, self.min[1]), vec2(x, self.max[1]));
        }
        for tick in &self.ticks[1].major {
            let y = self.down(tick.at).round() - 0.5;
            path.line(vec2(self.min[0], y), vec2(self.max[0], y));
        }
        vec![CanvasItem::Line { path, pen: StrokeStyle::new(GRID, self.scale) }]
    }

    /// The frame and its ticks.
    pub(super) fn lines(&self) -> Vec<CanvasItem> {
        let mut path = CanvasPath::default();
        let ([left, top], [right, bottom]) = (self.min.map(|c| c - 0.5), self.max.map(|c| c + 0.5));
        path.rect(vec2(left, top), vec2(right, bottom));
        let [x, y] = &self.ticks;
        for (at, length) in marks(x) {
            let column = self.across(at).round() - 0.5;
            path.line(vec2(column, bottom), vec2(column, bottom + length * self.scale));
        }
        for (at, length) in marks(y) {
            let row = self.down(at).round() - 0.5;
            path.line(vec2(left, row), vec2(left - length * self.scale, row));
        }
        vec![CanvasItem::Line { path, pen: StrokeStyle::new(INK, self.scale) }]
    }

    /// Labels of ticks and axes, and the title.
    pub(super) fn texts(&self, plot: &Plot) -> Vec<CanvasItem> {
        let scale = self.scale;
        let mut ink = Ink { color: INK, scale, stroke: scale, items: Vec::new() };
        let (cap, start) = (CAP_HEIGHT * TICK_TEXT * scale, (TICK + GAP) * scale);
        for tick in &self.ticks[0].major {
            let at = vec2(self.across(tick.at), self.max[1] + start + cap);
            ink.text(&tick.label, TICK_TEXT, at, Align::Middle);
        }
        for tick in &self.ticks[1].major {
            let at = vec2(self.min[0] - start, self.down(tick.at) + 0.5 * cap);
            ink.text(&tick.label, TICK_TEXT, at, Align::End);
        }
        let [wide, high] = [0, 1].map(|k| self.max[k] - self.min[k]);
        let label = |axis: &PlotAxis, k: usize, room: f64| {
            let label = axis_label(&axis.label, &self.ticks[k], &axis.unit);
            text::fitted(&label, LABEL_TEXT * scale, room)
        };
        let middle = [0, 1].map(|k| 0.5 * (self.min[k] + self.max[k]));
        let below = self.max[1] + (TICK + 2.0 * GAP + TICK_TEXT + 0.8 * LABEL_TEXT) * scale;
        let beside = self.min[0] - self.widest - (TICK + 2.0 * GAP + 0.3 * LABEL_TEXT) * scale;
        let (x, y) = (label(&plot.x, 0, wide), label(&plot.y, 1, high));
        ink.text(&x, LABEL_TEXT, vec2(middle[0], below), Align::Middle);
        ink.upwards(&y, LABEL_TEXT, vec2(beside.round(), middle[1]));
        let title = text::fitted(&plot.title, TITLE_TEXT * scale, wide);
        let names = if plot.has_names_above { NAMES } else { 0.0 };
        let above = self.min[1] - (0.6 * MARGIN + names) * scale;
        ink.text(&title, TITLE_TEXT, vec2(self.min[0], above), Align::Start);
        ink.items
    }

    /// The names of curves with samples of their lines in a row above the frame, as many as it has
    /// room for.
    pub(super) fn names(&self, curves: &[(StrokeStyle, &str)]) -> Vec<CanvasItem> {
        let scale = self.scale;
        let mut ink = Ink { color: INK, scale, stroke: scale, items: Vec::new() };
        let (mut x, y) = (self.min[0], self.min[1] - 0.75 * NAMES * scale);
        for &(pen, name) in curves {
            let at = x + (SAMPLE + GAP) * scale;
            let end = at + text::width(name, TICK_TEXT * scale);
            if end > self.max[0] {
                break;
            }
            let sample = vec![vec2(x, y), vec2(x + SAMPLE * scale, y)];
            ink.items.push(CanvasItem::Line { path: CanvasPath::of_pieces(vec![sample]), pen });
            let base = y + 0.5 * CAP_HEIGHT * TICK_TEXT * scale;
            ink.text(name, TICK_TEXT, vec2(at, base), Align::Start);
            x = end + 3.0 * GAP * scale;
        }
        ink.items
    }
}

/// Ticks at 0, 1, 2, … with names.
fn named(names: &[String], norm: &Normalization) -> Ticks {
    let tick =
        |(k, name): (usize, &String)| Tick { at: norm.position(k as f64), label: name.clone() };
    Ticks { major: names.iter().enumerate().map(tick).collect(), ..Ticks::default() }
}

/// Ticks at values, a label at every one or, where there is no room for so many, at every second,
/// third, …; of more than [`FEW`] at every 2nd, 5th, 10th, 20th, …
fn marked(values: &[f64], norm: &Normalization, most: usize) -> Ticks {
    let intervals = values.len() - 1;
    let round = (0..).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_usize.pow(power)));
    let step = match intervals {
        FEW.. => round.take(40).find(|step| intervals / step < most),
        _ => (1..=intervals).find(|k| intervals.is_multiple_of(*k) && intervals / k < most),
    };
    let (mut ticks, step) = (Ticks::default(), step.unwrap_or(1));
    for (k, &value) in values.iter().enumerate() {
        let at = norm.position(value);
        if k.is_multiple_of(step) {
            ticks.major.push(Tick { at, label: value.to_string().replace('-', "−") });
        } else {
            ticks.minor.push(at);
        }
    }
    ticks
}

/// Places and lengths of ticks.
fn marks(ticks: &Ticks) -> impl Iterator<Item = (f64, f64)> {
    let major = ticks.major.iter().map(|tick| (tick.at, TICK));
    major.chain(ticks.minor.iter().map(|&at| (at, MINOR_TICK)))
}
