//! The share of each pixel that shapes cover.
//!
//! Shapes of one mask join by maximum, so a polyline's corners and crossing lines are no darker
//! than its segments.

use ab_glyph_rasterizer::{Point, Rasterizer, point};
use ppum::segment::{self, sides};
use ppum::vec2::{Vec2, vec2};
use ppum_render::image::{Image, Rgba};

use crate::text::{GlyphCurve, curve_bounds};

/// A part of a page: columns from `min[0]` to `max[0]` and rows from `min[1]` to `max[1]`, the last
/// ones not included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelWindow {
    pub(super) min: [u32; 2],
    pub(super) max: [u32; 2],
}

impl PixelWindow {
    pub(super) fn intersection(self, other: Self) -> Self {
        let min = [self.min[0].max(other.min[0]), self.min[1].max(other.min[1])];
        let max = [self.max[0].min(other.max[0]), self.max[1].min(other.max[1])];
        Self { min, max: [max[0].max(min[0]), max[1].max(min[1])] }
    }

    /// The part that lies within two points, whole pixels.
    pub(super) fn around(self, [lo, hi]: [Vec2; 2]) -> Self {
        let clamp = |x: f64, k: usize| x.clamp(f64::from(self.min[k]), f64::from(self.max[k]));
        let min = [clamp(lo.x.floor(), 0) as u32, clamp(lo.y.floor(), 1) as u32];
        let max = [clamp(hi.x.ceil(), 0) as u32, clamp(hi.y.ceil(), 1) as u32];
        self.intersection(Self { min, max })
    }

    fn columns(&self) -> usize {
        (self.max[0] - self.min[0]) as usize
    }

    fn rows(&self) -> usize {
        (self.max[1] - self.min[1]) as usize
    }
}

/// Covered shares in a window.
#[derive(Clone, Debug)]
pub(super) struct CoverageMask {
    window: PixelWindow,
    coverage: Vec<f32>,
}

impl CoverageMask {
    /// An empty mask.
    pub(super) fn new(window: PixelWindow) -> Self {
        Self { window, coverage: vec![0.0; window.columns() * window.rows()] }
    }

    /// The covered share of a pixel, 0 outside.
    #[cfg(test)]
    pub(super) fn coverage(&self, column: u32, row: u32) -> f32 {
        let PixelWindow { min, max } = self.window;
        let inside = (min[0]..max[0]).contains(&column) && (min[1]..max[1]).contains(&row);
        let at = || (row - min[1]) as usize * self.window.columns() + (column - min[0]) as usize;
        if inside { self.coverage[at()] } else { 0.0 }
    }

    /// Adds to a pixel by maximum; nothing happens outside.
    fn cover(&mut self, column: i64, row: i64, share: f32) {
        let PixelWindow { min, max } = self.window;
        let (i, j) = (column - i64::from(min[0]), row - i64::from(min[1]));
        if i >= 0 && j >= 0 && column < i64::from(max[0]) && row < i64::from(max[1]) {
            let pixel = &mut self.coverage[j as usize * self.window.columns() + i as usize];
            *pixel = pixel.max(share.clamp(0.0, 1.0));
        }
    }

    /// A straight line of some width with round ends, wherever these lie; one thinner than a pixel
    /// is paler.
    pub(super) fn line(&mut self, a: Vec2, b: Vec2, width: f64) {
        let along = b - a;
        let reach = 0.5 * width + 0.5;
        let most = width.min(1.0);
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
                self.cover(column, row, (reach - distance).min(most) as f32);
            }
        }
    }

    /// Covers all of the window.
    pub(super) fn fill(&mut self) {
        self.coverage.fill(1.0);
    }

    /// Straight lines through points; a disc at a single one.
    pub(super) fn stroke(&mut self, points: &[Vec2], width: f64) {
        if let [point] = points {
            self.line(*point, *point, width);
        }
        points.windows(2).for_each(|ends| self.line(ends[0], ends[1], width));
    }

    /// The inside of a closed polygon, with exact shares at its edges; an axis-parallel box
    /// among them.
    pub(super) fn polygon(&mut self, corners: &[Vec2]) {
        let sides: Vec<_> = sides(corners).map(|side| GlyphCurve(side.to_vec())).collect();
        self.outline(&sides);
    }

    /// The inside of closed curves.
    pub(super) fn outline(&mut self, curves: &[GlyphCurve]) {
        let window = self.window.around(curve_bounds(curves));
        let (columns, rows) = (window.columns(), window.rows());
        if columns == 0 || rows == 0 {
            return;
        }
        let corner = vec2(f64::from(window.min[0]), f64::from(window.min[1]));
        let mut rasterizer = Rasterizer::new(columns, rows);
        for curve in curves {
            draw(&mut rasterizer, curve, corner);
        }
        let [left, top] = window.min.map(i64::from);
        rasterizer.for_each_pixel_2d(|i, j, share| {
            self.cover(left + i64::from(i), top + i64::from(j), share.abs());
        });
    }

    /// Lays `color` over an image where the mask covers it.
    pub(super) fn paint(&self, image: &mut Image, color: Rgba) {
        let (columns, width) = (self.window.columns(), image.size[0] as usize);
        let pixels = image.rgba.as_chunks_mut().0;
        for (row, shares) in
            (self.window.min[1] as usize..).zip(self.coverage.chunks(columns.max(1)))
        {
            let start = row * width + self.window.min[0] as usize;
            for (pixel, &share) in pixels[start..start + columns].iter_mut().zip(shares) {
                if share > 0.0 {
                    *pixel = over(color, share, *pixel);
                }
            }
        }
    }

    fn rows(&self, from: f64, to: f64) -> std::ops::Range<i64> {
        within(from, to, self.window.min[1], self.window.max[1])
    }

    fn columns(&self, from: f64, to: f64) -> std::ops::Range<i64> {
        within(from, to, self.window.min[0], self.window.max[0])
    }
}

/// `top` at a share of its opacity over `bottom`.
/// T. Porter and T. Duff, Compositing digital images, SIGGRAPH 1984.
pub(super) fn over(top: Rgba, share: f32, bottom: Rgba) -> Rgba {
    let top_alpha = share * f32::from(top[3]) / 255.0;
    let bottom_alpha = (1.0 - top_alpha) * f32::from(bottom[3]) / 255.0;
    let alpha = top_alpha + bottom_alpha;
    if alpha == 0.0 {
        return bottom;
    }
    let mix =
        |k: usize| (top_alpha * f32::from(top[k]) + bottom_alpha * f32::from(bottom[k])) / alpha;
    [mix(0), mix(1), mix(2), 255.0 * alpha].map(|c| c.round() as u8)
}

/// The pixels between `min` and `max` that the interval meets.
fn within(from: f64, to: f64, min: u32, max: u32) -> std::ops::Range<i64> {
    let (min, max) = (f64::from(min), f64::from(max));
    from.floor().clamp(min, max) as i64..to.ceil().clamp(min, max) as i64
}

/// Draws a curve into a rasterizer whose upper left corner lies at `corner`. Curves are cut off by
/// nobody: what leaves the rasterizer at its left counts there, elsewhere it covers nothing.
fn draw(rasterizer: &mut Rasterizer, curve: &GlyphCurve, corner: Vec2) {
    let (columns, rows) = rasterizer.dimensions();
    let most = vec2(columns as f64, rows as f64);
    let at = |p: Vec2| -> Point {
        let p = (p - corner).max(Vec2::ZERO).min(most);
        point(p.x as f32, p.y as f32)
    };
    match curve.0[..] {
        [a, b] => {
            for [a, b] in clipped(a - corner, b - corner, most) {
                rasterizer.draw_line(point(a.x as f32, a.y as f32), point(b.x as f32, b.y as f32));
            }
        }
        [a, b, c] => rasterizer.draw_quad(at(a), at(b), at(c)),
        [a, b, c, d] => rasterizer.draw_cubic(at(a), at(b), at(c), at(d)),
        _ => {}
    }
}

/// A line as its parts within 0 … `most`: what lies outside is moved onto the nearest border, so
/// that a closed polygon stays closed and covers the same pixels.
fn clipped(a: Vec2, b: Vec2, most: Vec2) -> Vec<[Vec2; 2]> {
    let mut cuts = vec![0.0, 1.0];
    for (from, to, most) in [(a.x, b.x, most.x), (a.y, b.y, most.y)] {
        let crossings = [0.0, most].map(|border| (border - from) / (to - from));
        cuts.extend(crossings.into_iter().filter(|t| *t > 0.0 && *t < 1.0));
    }
    cuts.sort_by(f64::total_cmp);
    let at = |t: f64| (a * (1.0 - t) + b * t).max(Vec2::ZERO).min(most);
    cuts.windows(2).map(|t| [at(t[0]), at(t[1])]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(columns: u32, rows: u32) -> CoverageMask {
        CoverageMask::new(PixelWindow { min: [0, 0], max: [columns, rows] })
    }

    fn rect(mask: &mut CoverageMask, a: Vec2, b: Vec2) {
        mask.polygon(&[a, vec2(b.x, a.y), b, vec2(a.x, b.y), a]);
    }

    fn area(mask: &CoverageMask) -> f64 {
        mask.coverage.iter().map(|&c| f64::from(c)).sum()
    }

    #[test]
    fn shapes_cover_their_area() {
        let mut box_ = mask(100, 80);
        rect(&mut box_, vec2(10.25, 20.5), vec2(30.75, 21.25));
        assert!((area(&box_) - 20.5 * 0.75).abs() < 1e-4);
        let mut thin = mask(100, 80);
        rect(&mut thin, vec2(3.0, 7.2), vec2(93.0, 7.3));
        assert!((area(&thin) - 9.0).abs() < 1e-4, "{}", area(&thin));
        let mut disc = mask(100, 80);
        disc.stroke(&[vec2(50.3, 40.2)], 40.0);
        assert!((area(&disc) / (std::f64::consts::PI * 400.0) - 1.0).abs() < 2e-3);
        for end in [vec2(80.0, 70.0), vec2(90.0, 10.1), vec2(12.0, 75.0)] {
            let mut line = mask(100, 80);
            line.line(vec2(10.0, 10.0), end, 3.0);
            let exact = 3.0 * (end - vec2(10.0, 10.0)).length() + std::f64::consts::PI * 2.25;
            assert!((area(&line) / exact - 1.0).abs() < 0.02, "{} {exact}", area(&line));
        }
        for corners in [[0, 1, 2], [2, 1, 0]] {
            let all = [vec2(10.0, 10.0), vec2(10.0, 60.0), vec2(80.0, 35.0)];
            let mut triangle = mask(100, 80);
            triangle.polygon(&corners.map(|k| all[k]));
            assert!((area(&triangle) - 1750.0).abs() < 1e-2);
        }
    }

    /// A polygon that leaves the page covers what it covers on a larger page.
    #[test]
    fn polygons_are_cut_off_at_the_border() {
        let corners = [vec2(-30.0, -20.0), vec2(90.0, 15.0), vec2(35.0, 300.0), vec2(-1e6, 20.0)];
        let (mut small, mut large) = (mask(60, 40), mask(400, 400));
        small.polygon(&corners);
        large.polygon(&corners);
        for (i, j) in (0..60).flat_map(|i| (0..40).map(move |j| (i, j))) {
            let apart = (small.coverage(i, j) - large.coverage(i, j)).abs();
            assert!(apart < 2e-3, "{i} {j} {apart}");
        }
    }

    #[test]
    fn a_line_from_far_outside_crosses_where_it_should() {
        let mut mask = mask(40, 40);
        mask.line(vec2(-1e6, -1e6), vec2(1e6, 1e6), 2.0);
        for k in 0..40 {
            assert_eq!(mask.coverage(k, k), 1.0);
            assert_eq!(mask.coverage((k + 20) % 40, k), 0.0);
        }
    }

    #[test]
    fn crossing_lines_are_no_darker() {
        let mut mask = mask(9, 9);
        rect(&mut mask, vec2(4.25, 0.0), vec2(4.75, 9.0));
        rect(&mut mask, vec2(0.0, 4.25), vec2(9.0, 4.75));
        assert_eq!((mask.coverage(4, 0), mask.coverage(4, 4)), (0.5, 0.5));
    }

    #[test]
    fn painting_keeps_transparency_right() {
        assert_eq!(over([200, 100, 50, 255], 0.5, [0; 4]), [200, 100, 50, 128]);
        assert_eq!(over([0; 4], 1.0, [0; 4]), [0; 4]);
        assert_eq!(over([200, 100, 50, 128], 1.0, [255; 4]), [227, 177, 152, 255]);
    }
}
