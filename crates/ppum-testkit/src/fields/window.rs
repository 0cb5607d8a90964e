//! Windows of the plane.

use ppum::vec2::{Vec2, vec2};

/// A window of the plane on square pixels, row 0 at the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Its middle.
    pub center: Vec2,
    /// Its width.
    pub width: f64,
    /// Columns and rows.
    pub pixels: [u32; 2],
}

impl Window {
    /// A pixel's side.
    #[must_use]
    pub fn pixel_size(&self) -> f64 {
        self.width / f64::from(self.pixels[0])
    }

    /// The centre of a pixel relative to the window's.
    #[must_use]
    pub fn offset(&self, column: u32, row: u32) -> Vec2 {
        let from_middle = |k: u32, n: u32| f64::from(k) + 0.5 - 0.5 * f64::from(n);
        let [x, y] = [from_middle(column, self.pixels[0]), -from_middle(row, self.pixels[1])];
        vec2(x * self.pixel_size(), y * self.pixel_size())
    }

    /// The offsets of all pixels, row by row.
    pub fn offsets(&self) -> impl Iterator<Item = Vec2> + '_ {
        let [columns, rows] = self.pixels;
        (0..rows).flat_map(move |j| (0..columns).map(move |i| self.offset(i, j)))
    }
}
