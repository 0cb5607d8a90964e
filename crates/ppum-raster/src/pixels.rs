//! The pixels that a box covers.

use std::ops::Range;

use ppum::vec2::{Rect, Vec2, vec2};

use crate::view::View;

/// Finds the pixels that lie in a box.
#[derive(Clone, Copy, Debug)]
pub struct Pixels<'v> {
    view: &'v View,
    /// Pixels a length.
    density: f64,
    /// Pixels by which a rounded position may be wrong; weights decide exactly.
    margin: f64,
}

impl<'v> Pixels<'v> {
    /// The pixels of a view.
    #[must_use]
    pub fn new(view: &'v View) -> Self {
        let density = 1.0 / view.pixel_size();
        let far = view.center.x.abs().max(view.center.y.abs()) + view.width + view.height();
        let margin = 1e-3 + 4.0 * f64::EPSILON * far * density;
        Self { view, density, margin }
    }

    /// The view in the world, enlarged by the margin.
    #[must_use]
    pub fn window(&self) -> Rect {
        let margin = self.margin / self.density;
        Rect::around(self.view.center, self.view.half() + Vec2 { x: margin, y: margin })
    }

    /// Some columns and rows of the view in the world, enlarged by the margin; there is one of each
    /// at least.
    #[must_use]
    pub(crate) fn window_of(&self, [columns, rows]: [Range<usize>; 2]) -> Rect {
        let margin = (0.5 + self.margin) / self.density;
        let around = vec2(margin, margin);
        let [first, last] = [columns.start, columns.end - 1];
        let lower = self.view.offset(first as u32, (rows.end - 1) as u32) - around;
        let upper = self.view.offset(last as u32, rows.start as u32) + around;
        Rect::new(self.view.center + lower, self.view.center + upper)
    }

    /// The columns and rows whose pixels may lie in a box given relative to the view's centre.
    #[must_use]
    pub fn covered(&self, b: &Rect) -> [Range<u32>; 2] {
        let [nx, ny] = self.view.pixels;
        [self.range(b.min.x, b.max.x, nx), self.range(-b.max.y, -b.min.y, ny)]
    }

    /// The pixels of `count` whose offsets may lie between two. Rounding down and up goes through
    /// integers, which saturate.
    fn range(&self, lo: f64, hi: f64, count: u32) -> Range<u32> {
        let middle = 0.5 * (f64::from(count) - 1.0);
        let first = middle + lo * self.density - self.margin;
        let last = middle + hi * self.density + self.margin;
        let start = if first > 0.0 { (first as u32).saturating_add(1) } else { 0 };
        let end = if last >= 0.0 { (last as u32).saturating_add(1) } else { 0 };
        start.min(count)..end.min(count).max(start.min(count))
    }
}
