//! Lines and letters in a figure's colour and size.

use ppum::vec2::{Vec2, vec2};

use super::style::FigureStyle;
use crate::canvas::{Align, CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::text::CAP_HEIGHT;
use ppum_render::image::Rgba;

pub(super) const TICK_TEXT: f64 = 13.0;
pub(super) const TITLE_TEXT: f64 = 17.0;
const STROKE: f64 = 1.0;
/// From one line of a title to the next one, in parts of the size.
pub(super) const LINE: f64 = 1.3;

/// Draws onto a list of items.
pub(crate) struct Ink {
    pub(crate) color: Rgba,
    /// Lengths in units of their length in a figure of 1024 × 768 pixels.
    pub(crate) scale: f64,
    /// Width of frame and tick lines.
    pub(crate) stroke: f64,
    pub(crate) items: Vec<CanvasItem>,
}

impl Ink {
    pub(super) fn new(style: &FigureStyle) -> Self {
        let scale = style.scale();
        Self { color: style.ink(), scale, stroke: STROKE * scale, items: Vec::new() }
    }

    /// A filled box.
    pub(super) fn rect(&mut self, a: Vec2, b: Vec2) {
        let mut outline = CanvasPath::default();
        outline.rect(a, b);
        self.items.push(CanvasItem::Fill { outline, color: self.color });
    }

    /// A box's outline, just outside of it.
    pub(super) fn outline(&mut self, min: Vec2, max: Vec2) {
        let out = vec2(self.stroke, self.stroke);
        let (min_out, max_out) = (min - out, max + out);
        let mut outline = CanvasPath::default();
        outline.rect(min_out, vec2(max_out.x, min.y));
        outline.rect(vec2(min_out.x, max.y), max_out);
        outline.rect(min_out, vec2(min.x, max_out.y));
        outline.rect(vec2(max.x, min_out.y), max_out);
        self.items.push(CanvasItem::Fill { outline, color: self.color });
    }

    pub(super) fn line(&mut self, points: Vec<Vec2>) {
        let pen = StrokeStyle::new(self.color, self.stroke);
        self.items.push(CanvasItem::Line { path: CanvasPath::through(points), pen });
    }

    /// Text of some size, given for a figure of 1024 × 768, whose part `align` lies at a point of
    /// its base line.
    pub(crate) fn text(&mut self, line: &str, size: f64, at: Vec2, align: Align) {
        if !line.is_empty() {
            let at = vec2(at.x, at.y.round());
            let line = TextItem::new(line, size * self.scale, at, self.color).aligned(align);
            self.items.push(CanvasItem::Text(line));
        }
    }

    /// Text centred on a point of its base line that reads upwards.
    pub(crate) fn upwards(&mut self, line: &str, size: f64, at: Vec2) {
        if !line.is_empty() {
            let line = TextItem::new(line, size * self.scale, at, self.color);
            self.items.push(CanvasItem::Text(line.aligned(Align::Middle).upwards()));
        }
    }

    /// A tick's label whose digits are centred on a height.
    pub(super) fn at_height(&mut self, line: &str, at: Vec2, align: Align) {
        let lowered = 0.5 * CAP_HEIGHT * TICK_TEXT * self.scale;
        self.text(line, TICK_TEXT, vec2(at.x, at.y + lowered), align);
    }

    /// Lines of text under one another, the last one's base line at a height.
    pub(super) fn lines(&mut self, lines: &[String], size: f64, last: Vec2) {
        for (line, above) in lines.iter().rev().zip(0u32..) {
            let at = last - vec2(0.0, f64::from(above) * LINE * size * self.scale);
            self.text(line, size, at, Align::Start);
        }
    }
}

/// The start, at a whole pixel, of a line around `at`; halves are rounded away from the middle, so
/// that ticks at both ends of an axis continue the frame's lines.
pub(super) fn snapped(at: f64, stroke: f64, middle: f64) -> f64 {
    let start = at - 0.5 * stroke.round().max(1.0);
    if at < middle { (start - 0.5).ceil() } else { (start + 0.5).floor() }
}

/// The box around items: least and largest coordinates; of nothing, the least are +∞.
pub(super) fn bounds(items: &[CanvasItem]) -> [Vec2; 2] {
    let none = [vec2(f64::INFINITY, f64::INFINITY), vec2(f64::NEG_INFINITY, f64::NEG_INFINITY)];
    items.iter().map(CanvasItem::bounds).fold(none, |[lo, hi], [a, b]| [lo.min(a), hi.max(b)])
}
