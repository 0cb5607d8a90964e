//! The frame of a plot: its place on the page, ticks, grid and words.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::scale::Normalization;

use super::{Plot, PlotAxis, has_place};
use crate::canvas::{Align, CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::overlay::line_scale;
use crate::text::{self, CAP_HEIGHT};
use crate::ticks::{self, Tick, Ticks, power_of_ten};

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
/// Least distances of labelled ticks, across and along the direction of reading.
const DISTANCE: [f64; 2] = [90.0, 48.0];

/// The positions of a plot's axes, ticks and labels.
pub(super) struct PlotFrame {
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
    pub(super) fn new(plot: &Plot, norms: [Normalization; 2], size: [u32; 2]) -> Self {
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
        let left = MARGIN + 1.3 * LABEL_TEXT + 2.0 * GAP + TICK;
        let min = [(left * scale + widest).round(), (above * scale).round()];
        let [columns, rows] = size.map(f64::from);
        let max = [
            (columns - 2.0 * MARGIN * scale).round().max(min[0] + 8.0),
            (rows - below * scale).round().max(min[1] + 8.0),
        ];
        Self { scale, min, max, norms, ticks, widest }
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
    pub(super) fn words(&self, plot: &Plot) -> Vec<CanvasItem> {
        let mut words = Vec::new();
        let (size, cap) = (TICK_TEXT * self.scale, CAP_HEIGHT * TICK_TEXT * self.scale);
        let start = (TICK + GAP) * self.scale;
        for tick in &self.ticks[0].major {
            let at = vec2(self.across(tick.at), (self.max[1] + start + cap).round());
            words.push(TextItem::new(&tick.label, size, at, INK).aligned(Align::Middle));
        }
        for tick in &self.ticks[1].major {
            let at = vec2(self.min[0] - start, (self.down(tick.at) + 0.5 * cap).round());
            words.push(TextItem::new(&tick.label, size, at, INK).aligned(Align::End));
        }
        words.extend(self.labels(plot));
        words.into_iter().map(CanvasItem::Text).collect()
    }

    fn labels(&self, plot: &Plot) -> Vec<TextItem> {
        let (size, scale) = (LABEL_TEXT * self.scale, self.scale);
        let [wide, high] = [0, 1].map(|k| self.max[k] - self.min[k]);
        let fitted = |axis: &PlotAxis, k: usize, room: f64| {
            text::fitted(&label(axis, &self.ticks[k]), size, room)
        };
        let middle = [0, 1].map(|k| 0.5 * (self.min[k] + self.max[k]));
        let below = self.max[1] + (TICK + 2.0 * GAP + TICK_TEXT + 0.8 * LABEL_TEXT) * scale;
        let beside = self.min[0] - self.widest - (TICK + 2.0 * GAP + 0.3 * LABEL_TEXT) * scale;
        let title = text::fitted(&plot.title, TITLE_TEXT * scale, wide);
        let above = self.min[1] - 0.6 * MARGIN * scale;
        vec![
            TextItem::new(fitted(&plot.x, 0, wide), size, vec2(middle[0], below.round()), INK)
                .aligned(Align::Middle),
            TextItem::new(fitted(&plot.y, 1, high), size, vec2(beside.round(), middle[1]), INK)
                .aligned(Align::Middle)
                .upwards(),
            TextItem::new(title, TITLE_TEXT * scale, vec2(self.min[0], above.round()), INK),
        ]
    }
}

/// Ticks at 0, 1, 2, … with names.
fn named(names: &[String], norm: &Normalization) -> Ticks {
    let tick =
        |(k, name): (usize, &String)| Tick { at: norm.position(k as f64), label: name.clone() };
    Ticks { major: names.iter().enumerate().map(tick).collect(), ..Ticks::default() }
}

/// Ticks at values, a label at every one or, where there is no room for so many, at every second,
/// third, …
fn marked(values: &[f64], norm: &Normalization, most: usize) -> Ticks {
    let intervals = values.len() - 1;
    let step =
        (1..=intervals).find(|step| intervals.is_multiple_of(*step) && intervals / step < most);
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

/// Returns the text along an axis: name, number that the labels count from, power of ten, unit.
fn label(axis: &PlotAxis, ticks: &Ticks) -> String {
    let reference = match ticks.reference {
        0.0 => String::new(),
        r if r > 0.0 => format!(" − {r}"),
        r => format!(" + {}", -r),
    };
    let power = if ticks.exponent == 0 { String::new() } else { power_of_ten(ticks.exponent) };
    let unit = [power, axis.unit.clone()].into_iter().filter(|part| !part.is_empty());
    let unit = unit.collect::<Vec<_>>().join(" ");
    let unit = if unit.is_empty() { unit } else { format!(" [{unit}]") };
    format!("{}{reference}{unit}", axis.label)
}
