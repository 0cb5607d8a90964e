//! The colour bar of a figure, upright or lying.
//!
//! Where a range that was found leaves out values, the bar's pointed ends say how far these go:
//! beside the points, in the column of the marks' labels of an upright bar, and before and behind a
//! lying one, which is shorter by them.

use ppum::vec2::{Vec2, vec2};

use super::axis::{FigureAxis, label_places};
use super::color_key::ColorKey;
use super::end_labels::end_labels;
use super::ink::{Ink, LINE, TICK_TEXT, snapped};
use super::metrics::{BETWEEN_ROWS, GAP, LABEL_GAP, TICK};
use super::style::{FigureStyle, LABEL_TEXT, Labels};
use crate::canvas::{Align, CanvasItem, CanvasPath};
use crate::text::{self, CAP_HEIGHT};
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::ColoredRaster;

/// Width of the bar.
pub(super) const BAR: f64 = 18.0;
/// Height of the triangles for values below and above.
pub(super) const ARROW: f64 = 14.0;
const MINOR_TICK: f64 = 3.0;
/// Least lengths of an upright bar and of a lying one: three labels and the triangles.
pub(super) const LEAST_BAR: [f64; 2] = [140.0, 220.0];
/// Least distance of labelled marks of an upright bar.
const UPRIGHT_DISTANCE: f64 = 44.0;
/// The distance of marks in the middle of bands.
const CLASS_DISTANCE: f64 = 18.0;
/// Between neighbouring labels of a lying bar.
const BETWEEN: f64 = 14.0;

/// A colour bar of some length.
pub(super) struct ColorBar {
    key: ColorKey,
    pub(super) axis: FigureAxis,
    /// The texts at the lower and the upper end.
    end_labels: [Option<String>; 2],
    pub(super) is_upright: bool,
    /// Length with the triangles, and of a lying bar with the words.
    pub(super) length: f64,
    scale: f64,
}

/// A colour bar that stands by itself, upright, for programs that let people change its range.
#[derive(Clone, Debug)]
pub struct StandaloneColorBar {
    /// The drawn items, in pixels; the bar's upper left corner is the origin.
    pub items: Vec<CanvasItem>,
    /// How far below the origin the lower and the upper end of the range lie.
    pub ends: [f64; 2],
    /// Width of what is coloured.
    pub width: f64,
}

impl StandaloneColorBar {
    /// The bar of an image, of some length with the triangles at its ends.
    #[must_use]
    pub fn new(picture: &ColoredRaster, labels: &Labels, style: &FigureStyle, length: f64) -> Self {
        let mut ink = Ink::new(style);
        let bar = ColorBar::upright(ColorKey::new(picture, labels), style, length.round());
        let start = vec2(0.0, bar.length);
        bar.draw(&mut ink, start, bar.length);
        let ends = bar.ends().map(|along| bar.length - along);
        Self { items: ink.items, ends, width: bar.width() }
    }

    /// The box around it: upper left and lower right corner.
    #[must_use]
    pub fn bounds(&self) -> [Vec2; 2] {
        super::ink::bounds(&self.items)
    }
}

/// A bar at its place: `start` is its lower end's corner nearest to the image.
struct ColorBarLayout<'b> {
    bar: &'b ColorBar,
    start: Vec2,
}

impl ColorBar {
    pub(super) fn upright(key: ColorKey, style: &FigureStyle, length: f64) -> Self {
        let scale = style.scale();
        let (apart, least) =
            if key.has_classes() { (CLASS_DISTANCE, 1) } else { (UPRIGHT_DISTANCE, 2) };
        let most = (length / (apart * scale)) as usize;
        Self::new(key, style, length, (most.max(least), true))
    }

    /// A lying bar; it has as many labels as do not touch.
    pub(super) fn lying(key: ColorKey, style: &FigureStyle, length: f64) -> Self {
        let scale = style.scale();
        let of = |most| Self::new(key.clone(), style, length, (most, false));
        let is_apart = |bar: &Self| {
            let ([low, high], ticks) = (bar.ends(), &bar.axis.ticks.major);
            let places = ticks.windows(2).map(|pair| (pair[1].at - pair[0].at) * (high - low));
            places.fold(f64::INFINITY, f64::min) > bar.axis.widest + BETWEEN * scale
        };
        let most = (2..=(length / (30.0 * scale)) as usize).rev().take(40);
        most.map(of).find(is_apart).unwrap_or_else(|| of(2))
    }

    /// A bar with about so many labels.
    fn new(
        key: ColorKey,
        style: &FigureStyle,
        length: f64,
        (most, is_upright): (usize, bool),
    ) -> Self {
        let scale = style.scale();
        let axis = key.axis(&style.bar_ticks, most, scale);
        Self {
            end_labels: end_labels(&key, &axis.ticks, scale),
            key,
            axis,
            is_upright,
            length,
            scale,
        }
    }

    /// Returns the margins of a horizontal bar for words before its lower and behind its upper end.
    fn margins(&self) -> [f64; 2] {
        let scale = self.scale;
        let margin = |k: usize| match &self.end_labels[k] {
            Some(word) if !self.is_upright => {
                (text::width(word, TICK_TEXT * scale) + GAP * scale).ceil()
            }
            _ => 0.0,
        };
        [margin(0), margin(1)]
    }

    /// Lower and upper end of the evenly coloured part.
    fn ends(&self) -> [f64; 2] {
        let arrow = |shown: bool| if shown { (ARROW * self.scale).round() } else { 0.0 };
        let [before, behind] = self.margins();
        let ColorKey { has_below, has_above, .. } = self.key;
        [before + arrow(has_below), self.length - behind - arrow(has_above)]
    }

    /// The points of the triangles.
    fn points(&self) -> [f64; 2] {
        let [before, behind] = self.margins();
        [before, self.length - behind]
    }

    fn width(&self) -> f64 {
        (BAR * self.scale).round()
    }

    /// Draws the bar with its lower end's corner at a place; the label is no longer than `room`.
    pub(super) fn draw(&self, ink: &mut Ink, start: Vec2, room: f64) {
        let placed = ColorBarLayout { bar: self, start };
        placed.colors(ink);
        placed.frame(ink);
        let end = placed.marks(ink);
        placed.label(ink, end, room);
    }
}

impl ColorBarLayout<'_> {
    /// The point so far along the bar and so far away from the image.
    fn point(&self, along: f64, across: f64) -> Vec2 {
        match self.bar.is_upright {
            true => self.start + vec2(across, -along),
            false => self.start + vec2(along, across),
        }
    }

    /// Two opposite corners, the upper left one first, of a part of the bar.
    fn corners(&self, [low, high]: [f64; 2]) -> [Vec2; 2] {
        let (a, b) = (self.point(low, 0.0), self.point(high, self.bar.width()));
        [a.min(b), a.max(b)]
    }

    fn colors(&self, ink: &mut Ink) {
        let [low, high] = self.bar.ends();
        let count = (high - low) as u32;
        let at = |k: u32| self.bar.key.color((f64::from(k) + 0.5) / f64::from(count.max(1)));
        let width = self.bar.width() as u32;
        let size = if self.bar.is_upright { [width, count] } else { [count, width] };
        let mut image = Image::filled(size, [0; 4]);
        for (k, pixel) in (0u32..).zip(image.rgba.as_chunks_mut::<4>().0) {
            let (column, row) = (k % size[0], k / size[0]);
            *pixel = at(if self.bar.is_upright { count - 1 - row } else { column });
        }
        let corner = self.corners([low, high])[0];
        ink.items.push(CanvasItem::Picture { image, corner: [corner.x as u32, corner.y as u32] });
        for (corners, color) in self.arrows() {
            ink.items
                .push(CanvasItem::Fill { outline: CanvasPath::through(corners.to_vec()), color });
        }
    }

    /// The triangles at the bar's ends: base, tip, base, and colour.
    fn arrows(&self) -> Vec<([Vec2; 3], Rgba)> {
        let ([low, high], [first, last]) = (self.bar.ends(), self.bar.points());
        let (width, key) = (self.bar.width(), &self.bar.key);
        let triangle = |base: f64, tip: f64| {
            [self.point(base, 0.0), self.point(tip, 0.5 * width), self.point(base, width)]
        };
        let below = key.has_below.then(|| (triangle(low, first), key.colormap.below));
        let above = key.has_above.then(|| (triangle(high, last), key.colormap.above));
        below.into_iter().chain(above).collect()
    }

    fn frame(&self, ink: &mut Ink) {
        let [min, max] = self.corners(self.bar.ends());
        ink.outline(min, max);
        for (corners, _) in self.arrows() {
            ink.line(corners.to_vec());
        }
    }

    /// The marks and their labels; returns how far from the image they end.
    fn marks(&self, ink: &mut Ink) -> f64 {
        let ticks = &self.bar.axis.ticks;
        for &position in &ticks.minor {
            self.mark(ink, position, MINOR_TICK);
        }
        let base = self.bar.width() + ink.stroke + (TICK + GAP) * ink.scale;
        for (tick, along) in ticks.major.iter().zip(self.label_places()) {
            self.mark(ink, tick.at, TICK);
            if self.bar.is_upright {
                ink.at_height(&tick.label, self.point(along, base), Align::Start);
            } else {
                let base = base + CAP_HEIGHT * TICK_TEXT * ink.scale;
                ink.text(&tick.label, TICK_TEXT, self.point(along, base), Align::Middle);
            }
        }
        let widest = self.draw_end_labels(ink, base);
        base + if self.bar.is_upright {
            self.bar.axis.widest.max(widest)
        } else {
            CAP_HEIGHT * TICK_TEXT * ink.scale
        }
    }

    /// The words at the ends; returns the width of the widest one. Beside an upright bar they keep
    /// away from the labels of marks, which begin at `base`.
    fn draw_end_labels(&self, ink: &mut Ink, base: f64) -> f64 {
        let line = LINE * TICK_TEXT * self.bar.scale;
        let labels = self.label_places().into_iter();
        let [first, last] =
            labels.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], at| [a.min(at), b.max(at)]);
        let [lower, upper] = self.bar.points();
        let half = 0.5 * ARROW * self.bar.scale;
        let beside = [(lower + half).min(first - line), (upper - half).max(last + line)];
        let away = [lower - GAP * self.bar.scale, upper + GAP * self.bar.scale];
        let mut widest: f64 = 0.0;
        for (k, word) in self.bar.end_labels.iter().enumerate() {
            let Some(word) = word else { continue };
            if self.bar.is_upright {
                ink.at_height(word, self.point(beside[k], base), Align::Start);
            } else {
                let align = [Align::End, Align::Start][k];
                ink.at_height(word, self.point(away[k], 0.5 * self.bar.width()), align);
            }
            widest = widest.max(text::width(word, TICK_TEXT * self.bar.scale));
        }
        widest
    }

    /// How far along the bar the labels of its marks stand.
    fn label_places(&self) -> Vec<f64> {
        let ([low, high], size) = (self.bar.ends(), TICK_TEXT * self.bar.scale);
        let ticks = &self.bar.axis.ticks.major;
        let at: Vec<f64> = ticks.iter().map(|tick| low + tick.at * (high - low)).collect();
        if self.bar.is_upright {
            let heights = vec![CAP_HEIGHT * size; ticks.len()];
            return label_places(&at, &heights, BETWEEN_ROWS * self.bar.scale);
        }
        let widths: Vec<f64> = ticks.iter().map(|tick| text::width(&tick.label, size)).collect();
        label_places(&at, &widths, BETWEEN * self.bar.scale)
    }

    /// A mark at a position from 0 to 1.
    fn mark(&self, ink: &mut Ink, position: f64, length: f64) {
        let [low, high] = self.bar.ends();
        let along = low + position * (high - low);
        let length = length * ink.scale;
        let (from, at) = (self.bar.width() + ink.stroke, self.point(along, 0.0));
        let middle = self.point(0.5 * (low + high), 0.0);
        if self.bar.is_upright {
            let top = snapped(at.y, ink.stroke, middle.y);
            let left = self.start.x + from;
            ink.rect(vec2(left, top), vec2(left + length, top + ink.stroke));
        } else {
            let left = snapped(at.x, ink.stroke, middle.x);
            let top = self.start.y + from;
            ink.rect(vec2(left, top), vec2(left + ink.stroke, top + length));
        }
    }

    fn label(&self, ink: &mut Ink, end: f64, room: f64) {
        let (label, size) = self.bar.axis.fitted(LABEL_TEXT, room / ink.scale);
        let base = end + (LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * ink.scale;
        let at = self.point(0.5 * self.bar.length, base);
        if self.bar.is_upright {
            ink.upwards(&label, size, at);
        } else {
            ink.text(&label, size, at, Align::Middle);
        }
    }
}
