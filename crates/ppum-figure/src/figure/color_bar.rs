//! The colour bar of a figure.

use ppum::vec2::{Vec2, vec2};

use super::sheet::{BAR_GAP, GAP, LABEL_GAP, LABEL_TEXT, Sheet, TICK, outline, rect, snapped};
use super::{INK, PAGE};
use crate::canvas::{Canvas, Item, Path, Pen};
use crate::text::CAP_HEIGHT;
use ppum_render::image::{Image, Rgba};

/// Width of the bar.
pub(super) const BAR: f64 = 18.0;
/// Height of the triangles for values below and above.
pub(super) const ARROW: f64 = 14.0;
const MINOR_TICK: f64 = 3.0;

impl Sheet<'_> {
    /// Left edge, and lower and upper end of the bar's evenly coloured part.
    fn bar_place(&self) -> (f64, [f64; 2]) {
        let arrow = |shown: bool| if shown { (ARROW * self.scale).round() } else { 0.0 };
        let left = (self.plot_max[0] + BAR_GAP * self.scale).round();
        let low = self.plot_max[1] - arrow(self.picture.has_below);
        let high = self.plot_min[1] + arrow(self.picture.has_above);
        (left, [low, high])
    }

    fn bar_width(&self) -> f64 {
        (BAR * self.scale).round()
    }

    /// The colours of the bar and its arrows.
    pub(super) fn paint_bar(&self, page: &mut Canvas) {
        let (left, [low, high]) = self.bar_place();
        let map = &self.picture.colormap;
        let rows = (low - high) as u32;
        let size = [self.bar_width() as u32, rows];
        let mut colors = Image::filled(size, PAGE);
        let rows_of_pixels = colors.rgba.chunks_exact_mut(4 * size[0] as usize);
        for (row, pixels) in (0..rows).zip(rows_of_pixels) {
            let t = 1.0 - (f64::from(row) + 0.5) / f64::from(rows);
            pixels.as_chunks_mut().0.fill(map.color(t));
        }
        page.items.push(Item::Picture { image: colors, corner: [left as u32, high as u32] });
        for (corners, color) in self.arrows() {
            let outline = Path::through(corners.to_vec());
            page.items.push(Item::Fill { outline, color });
        }
    }

    /// The triangles at the bar's ends: base, tip, base, and colour.
    fn arrows(&self) -> Vec<([Vec2; 3], Rgba)> {
        let (left, [low, high]) = self.bar_place();
        let width = self.bar_width();
        let triangle = |base: f64, tip: f64| {
            [vec2(left, base), vec2(left + 0.5 * width, tip), vec2(left + width, base)]
        };
        let picture = self.picture;
        let mut arrows = Vec::new();
        if picture.has_below {
            arrows.push((triangle(low, self.plot_max[1]), picture.colormap.below));
        }
        if picture.has_above {
            arrows.push((triangle(high, self.plot_min[1]), picture.colormap.above));
        }
        arrows
    }

    pub(super) fn draw_bar(&self, page: &mut Canvas) {
        let Self { scale, stroke, .. } = *self;
        let (left, [low, high]) = self.bar_place();
        let right = left + self.bar_width();
        outline(page, vec2(left, high), vec2(right, low), stroke);
        for ([a, tip, b], _) in self.arrows() {
            let path = Path::through(vec![a, tip, b]);
            page.items.push(Item::Line { path, pen: Pen::new(INK, stroke) });
        }
        let middle = 0.5 * (low + high);
        let mut mark = |position: f64, length: f64| {
            let at = low + position * (high - low);
            let top = snapped(at, stroke, middle);
            let from = right + stroke;
            rect(page, vec2(from, top), vec2(from + (length * scale).round(), top + stroke));
            at
        };
        for &position in &self.bar.ticks.minor {
            mark(position, MINOR_TICK);
        }
        let heights: Vec<f64> = self.bar.ticks.major.iter().map(|t| mark(t.at, TICK)).collect();
        let start = right + stroke + (TICK + GAP) * scale;
        for (tick, height) in self.bar.ticks.major.iter().zip(heights) {
            self.at_height(page, &tick.label, vec2(start, height));
        }
        self.upwards(page, &self.bar, self.bar_label_base());
    }

    /// Base line of the bar's label.
    pub(super) fn bar_label_base(&self) -> f64 {
        let ticks_end = self.bar_place().0 + self.bar_width() + self.stroke + self.bar.widest;
        ticks_end + (TICK + GAP + LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * self.scale
    }
}
