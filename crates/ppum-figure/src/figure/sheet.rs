//! The page of a figure: the place of everything on it, frame, axes and title.

use ppum::crack::Crack;
use ppum::vec2::{Vec2, vec2};

use super::Labels;
use super::axis::{Axis, TICK_DISTANCE, axes, bar};
use super::color_bar::BAR;
use super::{INK, bare, hatched};
use crate::canvas::{Align, Canvas, Item, Lettering, Path};
use crate::overlay::line_scale;
use crate::text::{self, CAP_HEIGHT};
use ppum_render::picture::Picture;

// Lengths in pixels of a figure of 1024 × 768; others are scaled.
pub(super) const TICK_TEXT: f64 = 13.0;
pub(super) const LABEL_TEXT: f64 = 14.0;
pub(super) const TITLE_TEXT: f64 = 17.0;
pub(super) const TICK: f64 = 5.0;
/// Between a tick and its label.
pub(super) const GAP: f64 = 5.0;
/// Between tick labels and the label of the axis.
pub(super) const LABEL_GAP: f64 = 10.0;
pub(super) const TITLE_GAP: f64 = 14.0;
pub(super) const BAR_GAP: f64 = 24.0;

/// The place of everything on the page; pixels of the plot are whole pixels of the page.
pub(super) struct Sheet<'a> {
    pub(super) picture: &'a Picture,
    pub(super) size: [u32; 2],
    pub(super) scale: f64,
    /// Width of frame and tick lines, whole pixels.
    pub(super) stroke: f64,
    pub(super) plot_min: [f64; 2],
    pub(super) plot_max: [f64; 2],
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) bar: Axis,
}

impl<'a> Sheet<'a> {
    pub(super) fn new(
        picture: &'a Picture,
        labels: &Labels,
        cracks: &[Crack],
        size: [u32; 2],
    ) -> Self {
        let scale = line_scale(size);
        let [columns, rows] = picture.image.size.map(f64::from);
        let [x, y] = axes(picture, labels, cracks, scale);
        let most = (rows / (TICK_DISTANCE[1] * scale)) as usize;
        let bar = bar(picture, labels, most.max(2), scale);

        // The group of picture, labels and bar is centred on the page as one.
        let title_height =
            |label: &str| if label.is_empty() { 0.0 } else { LABEL_GAP + LABEL_TEXT };
        let left = scale * (TICK + GAP + title_height(&y.label)) + y.widest;
        let right = scale * (BAR_GAP + BAR + TICK + GAP + title_height(&bar.label)) + bar.widest;
        let top = if labels.title.is_empty() { 0.0 } else { TITLE_GAP + TITLE_TEXT * CAP_HEIGHT };
        let bottom = TICK + GAP + TICK_TEXT * CAP_HEIGHT + title_height(&x.label);
        let start = |total: u32, before: f64, length: f64, after: f64| {
            (0.5 * (f64::from(total) - before - length - after) + before).round()
        };
        let plot_min = [
            start(size[0], left, columns, right),
            start(size[1], top * scale, rows, bottom * scale),
        ];
        let plot_max = [plot_min[0] + columns, plot_min[1] + rows];
        Self { picture, size, scale, stroke: scale.round().max(1.0), plot_min, plot_max, x, y, bar }
    }

    /// The picture on its hatched ground, under the layers.
    pub(super) fn plot(&self, layers: Vec<Item>) -> Item {
        let mut canvas = bare(self.picture, layers);
        let (corner, ground) = ([0, 0], hatched(canvas.size));
        canvas.items.insert(0, Item::Picture { image: ground, corner });
        Item::Inset { corner: self.plot_min.map(|c| c as u32), canvas }
    }

    /// A frame around the plot, just outside its pixels.
    pub(super) fn draw_frame(&self, page: &mut Canvas) {
        outline(page, self.plot_min.into(), self.plot_max.into(), self.stroke);
    }

    pub(super) fn draw_x_axis(&self, page: &mut Canvas) {
        let Self { scale, stroke, .. } = *self;
        let top = self.plot_max[1] + stroke;
        let base = top + (TICK + GAP + TICK_TEXT * CAP_HEIGHT) * scale;
        let middle = 0.5 * (self.plot_min[0] + self.plot_max[0]);
        for tick in &self.x.ticks.major {
            let at = self.plot_min[0] + self.picture.view.pixel_of_offset(vec2(tick.at, 0.0)).x;
            let left = snapped(at, stroke, middle);
            rect(page, vec2(left, top), vec2(left + stroke, top + (TICK * scale).round()));
            centred(page, &tick.label, TICK_TEXT * scale, vec2(at, base));
        }
        let room = self.plot_max[0] - self.plot_min[0];
        let label = self.x.fitted(LABEL_TEXT * scale, room);
        let at = vec2(middle, base + (LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * scale);
        centred(page, &label, LABEL_TEXT * scale, at);
    }

    pub(super) fn draw_y_axis(&self, page: &mut Canvas) {
        let Self { scale, stroke, .. } = *self;
        let right = self.plot_min[0] - stroke;
        let end = right - (TICK + GAP) * scale;
        let middle = 0.5 * (self.plot_min[1] + self.plot_max[1]);
        for tick in &self.y.ticks.major {
            let at = self.plot_min[1] + self.picture.view.pixel_of_offset(vec2(0.0, tick.at)).y;
            let top = snapped(at, stroke, middle);
            rect(page, vec2(right - (TICK * scale).round(), top), vec2(right, top + stroke));
            let length = text::width(&tick.label, TICK_TEXT * scale);
            self.at_height(page, &tick.label, vec2(end - length, at));
        }
        let base = end - self.y.widest - LABEL_GAP * scale;
        self.upwards(page, &self.y, base);
    }

    /// The title, cut where the bar's label could reach up to it.
    pub(super) fn draw_title(&self, page: &mut Canvas, title: &str) {
        let size = TITLE_TEXT * self.scale;
        let start = vec2(self.plot_min[0], self.plot_min[1] - TITLE_GAP * self.scale);
        let end = self.bar_label_base() - (LABEL_TEXT + GAP) * self.scale;
        let title = text::fitted(title, size, end - start.x);
        page.items.push(Item::Text(Lettering::new(title, size, start, INK)));
    }

    /// A tick's label whose digits are centred on a height, starting at `at.x`.
    pub(super) fn at_height(&self, page: &mut Canvas, line: &str, at: Vec2) {
        let size = TICK_TEXT * self.scale;
        let at = vec2(at.x, (at.y + 0.5 * CAP_HEIGHT * size).round());
        page.items.push(Item::Text(Lettering::new(line, size, at, INK)));
    }

    /// An axis' label that reads upwards beside the plot.
    pub(super) fn upwards(&self, page: &mut Canvas, axis: &Axis, base: f64) {
        let size = LABEL_TEXT * self.scale;
        let label = axis.fitted(size, f64::from(self.size[1]) - 2.0 * GAP);
        let half = 0.5 * text::width(&label, size);
        // A label longer than the picture stays on the page.
        let (least, most) = (half + GAP, f64::from(self.size[1]) - half - GAP);
        let middle = (0.5 * (self.plot_min[1] + self.plot_max[1])).min(most).max(least);
        let line = Lettering::new(label, size, vec2(base, middle), INK);
        page.items.push(Item::Text(line.aligned(Align::Middle).upwards()));
    }
}

/// Text centred on a point of its base line.
fn centred(page: &mut Canvas, line: &str, size: f64, at: Vec2) {
    let line = Lettering::new(line, size, vec2(at.x, at.y.round()), INK);
    page.items.push(Item::Text(line.aligned(Align::Middle)));
}

/// A box filled with ink.
pub(super) fn rect(page: &mut Canvas, a: Vec2, b: Vec2) {
    let mut outline = Path::default();
    outline.rect(a, b);
    page.items.push(Item::Fill { outline, color: INK });
}

/// A box's outline of some width, outside of it.
pub(super) fn outline(page: &mut Canvas, min: Vec2, max: Vec2, stroke: f64) {
    let out = vec2(stroke, stroke);
    let (min_out, max_out) = (min - out, max + out);
    let mut outline = Path::default();
    outline.rect(min_out, vec2(max_out.x, min.y));
    outline.rect(vec2(min_out.x, max.y), max_out);
    outline.rect(min_out, vec2(min.x, max_out.y));
    outline.rect(vec2(max.x, min_out.y), max_out);
    page.items.push(Item::Fill { outline, color: INK });
}

/// The start of a line of whole pixels around `at`; halves are rounded away from the middle, so that
/// ticks at both ends of an axis continue the frame's lines.
pub(super) fn snapped(at: f64, stroke: f64, middle: f64) -> f64 {
    let start = at - 0.5 * stroke;
    if at < middle { (start - 0.5).ceil() } else { (start + 0.5).floor() }
}
