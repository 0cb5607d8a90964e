//! Pictures of colours, and shapes painted on them with smooth edges.
//!
//! A [`Mask`] collects how much of each pixel a set of shapes covers; [`Image::paint`] then lays one
//! colour over the picture through it. Shapes of one mask join by maximum, so a polyline's corners
//! and crossing lines are no darker than its segments. Positions are continuous pixel coordinates:
//! the origin is the upper left corner, the centre of pixel (i, j) is (i + 1/2, j + 1/2).

use ppum::segment;
use ppum::vec2::{Vec2, vec2};

/// Red, green, blue (sRGB) and opacity, each 0 to 255; opacity is not multiplied in.
pub type Rgba = [u8; 4];

/// A picture of [`Rgba`] pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Columns and rows.
    pub size: [u32; 2],
    /// The pixels, four bytes each.
    pub rgba: Vec<u8>,
}

impl Image {
    /// A picture of one colour.
    #[must_use]
    pub fn filled(size: [u32; 2], color: Rgba) -> Self {
        Self { size, rgba: color.repeat(size[0] as usize * size[1] as usize) }
    }

    /// The colour of a pixel.
    #[must_use]
    pub fn pixel(&self, column: u32, row: u32) -> Rgba {
        let at = 4 * (row as usize * self.size[0] as usize + column as usize);
        [self.rgba[at], self.rgba[at + 1], self.rgba[at + 2], self.rgba[at + 3]]
    }

    /// Lays `color` over the picture where the mask covers it.
    ///
    /// # Panics
    /// If the mask has another size.
    pub fn paint(&mut self, mask: &Mask, color: Rgba) {
        self.paint_with(mask, |_| color);
    }

    /// Lays over the picture what `color` makes of each covered pixel's own colour.
    ///
    /// # Panics
    /// If the mask has another size.
    pub fn paint_with(&mut self, mask: &Mask, color: impl Fn(Rgba) -> Rgba) {
        assert_eq!(mask.size, self.size, "a mask belongs to a picture of its size");
        for (pixel, &coverage) in self.rgba.as_chunks_mut().0.iter_mut().zip(&mask.coverage) {
            if coverage > 0.0 {
                *pixel = over(color(*pixel), coverage, *pixel);
            }
        }
    }

    /// Lays another picture over this one, its upper left corner at `at`; what does not fit is lost.
    pub fn paste(&mut self, other: &Self, at: [u32; 2]) {
        let columns = other.size[0].min(self.size[0].saturating_sub(at[0]));
        for row in 0..other.size[1].min(self.size[1].saturating_sub(at[1])) {
            for column in 0..columns {
                let start = (at[1] + row) as usize * self.size[0] as usize;
                let here = 4 * (start + (at[0] + column) as usize);
                let color =
                    over(other.pixel(column, row), 1.0, self.pixel(at[0] + column, at[1] + row));
                self.rgba[here..here + 4].copy_from_slice(&color);
            }
        }
    }
}

/// `top` at a share of its opacity over `bottom`.
/// T. Porter and T. Duff, Compositing digital images, SIGGRAPH 1984.
fn over(top: Rgba, coverage: f32, bottom: Rgba) -> Rgba {
    let top_alpha = coverage * f32::from(top[3]) / 255.0;
    let bottom_alpha = (1.0 - top_alpha) * f32::from(bottom[3]) / 255.0;
    let alpha = top_alpha + bottom_alpha;
    if alpha == 0.0 {
        return bottom;
    }
    let mix =
        |k: usize| (top_alpha * f32::from(top[k]) + bottom_alpha * f32::from(bottom[k])) / alpha;
    [mix(0), mix(1), mix(2), 255.0 * alpha].map(|c| c.round() as u8)
}

/// The share of each pixel that shapes cover.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// Columns and rows.
    pub size: [u32; 2],
    coverage: Vec<f32>,
}

impl Mask {
    /// An empty mask.
    #[must_use]
    pub fn new(size: [u32; 2]) -> Self {
        Self { size, coverage: vec![0.0; size[0] as usize * size[1] as usize] }
    }

    /// The covered share of a pixel, 0 outside.
    #[must_use]
    pub fn coverage(&self, column: u32, row: u32) -> f32 {
        if column >= self.size[0] || row >= self.size[1] {
            return 0.0;
        }
        self.coverage[row as usize * self.size[0] as usize + column as usize]
    }

    /// Adds to a pixel by maximum; nothing happens outside.
    pub fn cover(&mut self, column: i64, row: i64, share: f32) {
        let [columns, rows] = self.size.map(i64::from);
        if (0..columns).contains(&column) && (0..rows).contains(&row) {
            let pixel = &mut self.coverage[(row * columns + column) as usize];
            *pixel = pixel.max(share.clamp(0.0, 1.0));
        }
    }

    /// A straight line of some width with round ends, wherever its ends lie.
    pub fn line(&mut self, a: Vec2, b: Vec2, width: f64) {
        let along = b - a;
        let reach = 0.5 * width + 0.5;
        for row in self.rows(a.y.min(b.y) - reach, a.y.max(b.y) + reach) {
            let y = row as f64 + 0.5;
            // The columns where the row's pixels can be that near the infinite line.
            let (mut left, mut right) = (a.x.min(b.x) - reach, a.x.max(b.x) + reach);
            if along.y.abs() > 1e-3 * along.x.abs() {
                let middle = a.x + (y - a.y) * along.x / along.y;
                let half = reach * along.length() / along.y.abs();
                (left, right) = (left.max(middle - half), right.min(middle + half));
            }
            for column in self.columns(left, right) {
                let distance =
                    segment::distance([Vec2::ZERO, along], vec2(column as f64 + 0.5, y) - a);
                self.cover(column, row, (reach - distance) as f32);
            }
        }
    }

    /// A disc.
    pub fn disc(&mut self, center: Vec2, radius: f64) {
        self.line(center, center, 2.0 * radius);
    }

    /// An axis-parallel box with exact shares at its edges.
    pub fn rect(&mut self, a: Vec2, b: Vec2) {
        let (min, max) = (a.min(b), a.max(b));
        for row in self.rows(min.y, max.y) {
            let tall = overlap(min.y, max.y, row);
            for column in self.columns(min.x, max.x) {
                self.cover(column, row, (tall * overlap(min.x, max.x, column)) as f32);
            }
        }
    }

    /// A triangle.
    pub fn triangle(&mut self, corners: [Vec2; 3]) {
        let [mut a, mut b, c] = corners;
        if (b - a).cross(c - a) < 0.0 {
            (a, b) = (b, a);
        }
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        for row in self.rows(min.y - 1.0, max.y + 1.0) {
            for column in self.columns(min.x - 1.0, max.x + 1.0) {
                let p = vec2(column as f64 + 0.5, row as f64 + 0.5);
                let inside = |from: Vec2, to: Vec2| (to - from).unit().cross(p - from) + 0.5;
                self.cover(column, row, inside(a, b).min(inside(b, c)).min(inside(c, a)) as f32);
            }
        }
    }

    /// The mask turned a quarter to the left: what read to the right reads upwards.
    #[must_use]
    pub fn turned_left(&self) -> Self {
        let [columns, rows] = self.size;
        let mut turned = Self::new([rows, columns]);
        for row in 0..rows {
            for column in 0..columns {
                let share = self.coverage(column, row);
                turned.cover(i64::from(row), i64::from(columns - 1 - column), share);
            }
        }
        turned
    }

    /// Adds another mask, its upper left corner at `at`.
    pub fn add(&mut self, other: &Self, at: [i64; 2]) {
        for row in 0..other.size[1] {
            for column in 0..other.size[0] {
                let share = other.coverage(column, row);
                self.cover(at[0] + i64::from(column), at[1] + i64::from(row), share);
            }
        }
    }

    fn rows(&self, from: f64, to: f64) -> std::ops::Range<i64> {
        within(from, to, self.size[1])
    }

    fn columns(&self, from: f64, to: f64) -> std::ops::Range<i64> {
        within(from, to, self.size[0])
    }
}

/// The pixels of `0..count` that the interval meets.
fn within(from: f64, to: f64, count: u32) -> std::ops::Range<i64> {
    let count = f64::from(count);
    from.floor().clamp(0.0, count) as i64..to.ceil().clamp(0.0, count) as i64
}

/// Length of the part of an interval in pixel `index`.
fn overlap(from: f64, to: f64, index: i64) -> f64 {
    (to.min(index as f64 + 1.0) - from.max(index as f64)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(mask: &Mask) -> f64 {
        mask.coverage.iter().map(|&c| f64::from(c)).sum()
    }

    #[test]
    fn shapes_cover_their_area() {
        let size = [100, 80];
        let mut rect = Mask::new(size);
        rect.rect(vec2(10.25, 20.5), vec2(30.75, 21.25));
        assert!((area(&rect) - 20.5 * 0.75).abs() < 1e-5);
        let mut disc = Mask::new(size);
        disc.disc(vec2(50.3, 40.2), 20.0);
        assert!((area(&disc) / (std::f64::consts::PI * 400.0) - 1.0).abs() < 2e-3);
        for end in [vec2(80.0, 70.0), vec2(90.0, 10.1), vec2(12.0, 75.0)] {
            let mut line = Mask::new(size);
            line.line(vec2(10.0, 10.0), end, 3.0);
            let exact = 3.0 * (end - vec2(10.0, 10.0)).length() + std::f64::consts::PI * 2.25;
            assert!((area(&line) / exact - 1.0).abs() < 0.02, "{} {exact}", area(&line));
        }
        let mut triangle = Mask::new(size);
        triangle.triangle([vec2(10.0, 10.0), vec2(10.0, 60.0), vec2(80.0, 35.0)]);
        assert!((area(&triangle) / 1750.0 - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_line_from_far_outside_crosses_where_it_should() {
        let mut mask = Mask::new([40, 40]);
        mask.line(vec2(-1e6, -1e6), vec2(1e6, 1e6), 2.0);
        for k in 0..40 {
            assert_eq!(mask.coverage(k, k), 1.0);
            assert_eq!(mask.coverage((k + 20) % 40, k), 0.0);
        }
    }

    #[test]
    fn crossing_lines_are_no_darker() {
        let mut mask = Mask::new([9, 9]);
        mask.rect(vec2(4.25, 0.0), vec2(4.75, 9.0));
        mask.rect(vec2(0.0, 4.25), vec2(9.0, 4.75));
        assert_eq!((mask.coverage(4, 0), mask.coverage(4, 4)), (0.5, 0.5));
    }

    #[test]
    fn painting_keeps_transparency_right() {
        let mut image = Image::filled([2, 1], [0, 0, 0, 0]);
        let mut mask = Mask::new([2, 1]);
        mask.cover(0, 0, 0.5);
        image.paint(&mask, [200, 100, 50, 255]);
        assert_eq!(image.pixel(0, 0), [200, 100, 50, 128]);
        assert_eq!(image.pixel(1, 0), [0, 0, 0, 0]);
        let mut page = Image::filled([3, 2], [255, 255, 255, 255]);
        page.paste(&image, [2, 1]);
        assert_eq!(page.pixel(2, 1), [227, 177, 152, 255]);
        assert_eq!(page.pixel(1, 1), [255; 4]);
    }

    #[test]
    fn a_quarter_turn_makes_text_read_upwards() {
        let mut mask = Mask::new([3, 2]);
        mask.cover(0, 1, 0.25);
        mask.cover(2, 0, 1.0);
        let turned = mask.turned_left();
        assert_eq!(turned.size, [2, 3]);
        assert_eq!((turned.coverage(1, 2), turned.coverage(0, 0)), (0.25, 1.0));
    }
}
