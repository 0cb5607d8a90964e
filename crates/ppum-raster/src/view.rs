//! The view of an image: a window of the plane on a grid of square pixels.
//!
//! Positions are formed as `center + offset`, never as absolute coordinates, so a view 1e-12 of the
//! domain wide is as good as any. Row 0 is at the *top* of the image while y points up:
//!
//! ```text
//! offset of the centre of pixel (i, j) = ((i + 1/2 − nx/2) s, (ny/2 − j − 1/2) s),   s = width / nx
//! ```
//!
//! *Continuous* pixel coordinates have their origin at the image's upper left corner, y down;
//! the centre of pixel (i, j) is at (i + 1/2, j + 1/2).

use std::ops::Range;

use ppum::text::exact;
use ppum::vec2::{Rect, Vec2, vec2};

/// A window of the plane with square pixels; its height follows from the width and the pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The middle of the image, in world coordinates.
    pub center: Vec2,
    /// Width of the image \[length\], positive and finite.
    pub width: f64,
    /// Columns and rows, both positive.
    pub pixels: [u32; 2],
}

/// Most pixels of one image: a raster of f64 values then takes 2 GiB.
pub const MAX_PIXELS: u64 = 1 << 28;

/// The reason why there is no such view.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// No pixels, or too many.
    #[error("a picture of {0}x{1} pixels; give at least 1x1 and at most {MAX_PIXELS} in all")]
    Pixels(u32, u32),
    /// Width not positive or not finite.
    #[error("the view's width is {}; give a positive length", exact(*.0))]
    Width(f64),
    /// Centre not finite.
    #[error("the view's centre is ({}, {}); give two finite numbers", exact(.0.x), exact(.0.y))]
    Center(Vec2),
    /// A window without area.
    #[error("the window from ({}, {}) to ({}, {}) has no area; give two opposite corners",
        exact(.0.min.x), exact(.0.min.y), exact(.0.max.x), exact(.0.max.y))]
    EmptyWindow(Rect),
    /// The pixels are finer than f64 can tell apart around the centre, or their size is no
    /// normal number.
    #[error("a view {width:e} wide at ({}, {}) is finer than double precision; widen it",
        exact(.center.x), exact(.center.y))]
    TooDeep {
        /// Centre asked for.
        center: Vec2,
        /// Width asked for.
        width: f64,
    },
}

impl View {
    /// The view of `width` around `center`.
    ///
    /// # Errors
    /// No pixels or more than [`MAX_PIXELS`]; a width that is not positive; numbers that are not
    /// finite; a width below the spacing of f64 at the centre, or pixels below the least
    /// normal number.
    pub fn new(center: Vec2, width: f64, pixels: [u32; 2]) -> Result<Self, ViewError> {
        let [nx, ny] = pixels;
        if nx == 0 || ny == 0 || u64::from(nx) * u64::from(ny) > MAX_PIXELS {
            return Err(ViewError::Pixels(nx, ny));
        }
        if !center.is_finite() {
            return Err(ViewError::Center(center));
        }
        let view = Self { center, width, pixels };
        if !(width > 0.0 && width.is_finite() && view.height().is_finite()) {
            return Err(ViewError::Width(width));
        }
        let is_blurred = width < f64::EPSILON * center.x.abs().max(center.y.abs());
        if is_blurred || !view.pixel_size().is_normal() {
            return Err(ViewError::TooDeep { center, width });
        }
        Ok(view)
    }

    /// The smallest view of exactly `pixels` that shows all of `rect`, in the middle.
    ///
    /// # Errors
    /// As [`View::new`]; a box without area.
    pub fn fit(rect: Rect, pixels: [u32; 2]) -> Result<Self, ViewError> {
        let size = rect.size();
        if !(size.x > 0.0 && size.y > 0.0 && size.is_finite()) {
            return Err(ViewError::EmptyWindow(rect));
        }
        let aspect = f64::from(pixels[0]) / f64::from(pixels[1].max(1));
        Self::new(rect.center(), size.x.max(size.y * aspect), pixels)
    }

    /// The largest view of the shape of `rect` with at most `pixels`: nothing but the box is seen,
    /// up to a part of a pixel.
    ///
    /// # Errors
    /// As [`View::fit`].
    pub fn hug(rect: Rect, pixels: [u32; 2]) -> Result<Self, ViewError> {
        let whole = Self::fit(rect, pixels)?;
        let size = rect.size() / whole.pixel_size();
        let within = |length: f64, most: u32| (length.round() as u32).clamp(1, most);
        Self::fit(rect, [within(size.x, pixels[0]), within(size.y, pixels[1])])
    }

    /// The view of exactly `pixels` that shows the window with the opposite corners `(x0, y0)` and
    /// `(x1, y1)`; where the shapes differ it shows more on both sides.
    ///
    /// # Errors
    /// As [`View::fit`].
    pub fn window(x0: f64, y0: f64, x1: f64, y1: f64, pixels: [u32; 2]) -> Result<Self, ViewError> {
        let (a, b) = (vec2(x0, y0), vec2(x1, y1));
        Self::fit(Rect::new(a.min(b), a.max(b)), pixels)
    }

    /// The view that shows what this one shows beyond lines x = a and y = b: pixel (i, j) has the
    /// reflection of the centre of pixel (nx − 1 − i, j), (i, ny − 1 − j) or both. Offsets are
    /// reflected exactly; the view's centre is rounded, but next to the lines, where 2a − x is a
    /// number.
    #[must_use]
    pub fn reflected(&self, [x, y]: [Option<f64>; 2]) -> Self {
        let beyond = |line: Option<f64>, at: f64| line.map_or(at, |line| 2.0 * line - at);
        Self { center: vec2(beyond(x, self.center.x), beyond(y, self.center.y)), ..*self }
    }

    /// Returns the view magnified `factor` times around its centre.
    ///
    /// # Errors
    /// As [`View::new`].
    pub fn zoom(&self, factor: f64) -> Result<Self, ViewError> {
        Self::new(self.center, self.width / factor, self.pixels)
    }

    /// Returns the window with `n` × `n` pixels in place of each: the centre of pixel (n i + a, n
    /// j + b) lies at ((a + 1/2)/n, (b + 1/2)/n) of pixel (i, j), as exactly as centres lie
    /// anywhere. It may have more than [`MAX_PIXELS`], and is then drawn in batches
    /// ([`render_batches`](crate::scatter::render_batches)).
    ///
    /// # Errors
    /// More columns or rows than can be counted, pixels finer than f64 has normal numbers for.
    pub fn finer(&self, n: u32) -> Result<Self, ViewError> {
        let [nx, ny] = self.pixels;
        let too_many = ViewError::Pixels(nx.saturating_mul(n), ny.saturating_mul(n));
        let (Some(columns), Some(rows)) = (nx.checked_mul(n), ny.checked_mul(n)) else {
            return Err(too_many);
        };
        let finer = Self { pixels: [columns, rows], ..*self };
        match finer.pixel_size().is_normal() {
            true => Ok(finer),
            false if n == 0 => Err(too_many),
            false => Err(ViewError::TooDeep { center: self.center, width: self.width }),
        }
    }

    /// Height of the image \[length\].
    #[must_use]
    pub fn height(&self) -> f64 {
        self.pixel_size() * f64::from(self.pixels[1])
    }

    /// Side of a pixel \[length\].
    #[must_use]
    pub fn pixel_size(&self) -> f64 {
        self.width / f64::from(self.pixels[0])
    }

    /// Half of width and height.
    #[must_use]
    pub fn half(&self) -> Vec2 {
        vec2(self.width, self.height()) * 0.5
    }

    /// The window in world coordinates, rounded to f64: for reports and coarse tests only.
    #[must_use]
    pub fn rect(&self) -> Rect {
        Rect::around(self.center, self.half())
    }

    /// x offset of the centres of a column from the view's centre.
    #[must_use]
    pub fn column_offset(&self, column: u32) -> f64 {
        let twice = 2.0 * f64::from(column) + 1.0 - f64::from(self.pixels[0]);
        0.5 * twice * self.pixel_size()
    }

    /// y offset of the centres of a row from the view's centre; row 0 is the top.
    #[must_use]
    pub fn row_offset(&self, row: u32) -> f64 {
        let twice = f64::from(self.pixels[1]) - 1.0 - 2.0 * f64::from(row);
        0.5 * twice * self.pixel_size()
    }

    /// Offset of a pixel's centre from the view's centre.
    #[must_use]
    pub fn offset(&self, column: u32, row: u32) -> Vec2 {
        vec2(self.column_offset(column), self.row_offset(row))
    }

    /// The columns and rows whose centres lie in a closed box, by the test that single points pass.
    #[must_use]
    pub fn inside(&self, bounds: &Rect) -> [Range<usize>; 2] {
        let (lo, hi) = (bounds.min - self.center, bounds.max - self.center);
        let [nx, ny] = self.pixels;
        let columns = first(nx, |i| self.column_offset(i) >= lo.x)..first(nx, |i| {
            self.column_offset(i) > hi.x
        });
        let rows =
            first(ny, |j| self.row_offset(j) <= hi.y)..first(ny, |j| self.row_offset(j) < lo.y);
        [columns, rows]
    }

    /// Offset from the view's centre of a continuous pixel position.
    #[must_use]
    pub fn offset_at(&self, pixel: Vec2) -> Vec2 {
        let [nx, ny] = self.pixels.map(f64::from);
        vec2(pixel.x - 0.5 * nx, 0.5 * ny - pixel.y) * self.pixel_size()
    }

    /// Continuous pixel position of an offset from the view's centre.
    #[must_use]
    pub fn pixel_of_offset(&self, offset: Vec2) -> Vec2 {
        let [nx, ny] = self.pixels.map(f64::from);
        let in_pixels = offset / self.pixel_size();
        vec2(0.5 * nx + in_pixels.x, 0.5 * ny - in_pixels.y)
    }

    /// Continuous pixel position of a world point, through its offset from the centre.
    #[must_use]
    pub fn pixel(&self, world: Vec2) -> Vec2 {
        self.pixel_of_offset(world - self.center)
    }
}

/// The first of `count` indices that passes a test all later ones pass too.
fn first(count: u32, test: impl Fn(u32) -> bool) -> usize {
    let (mut lo, mut hi) = (0, count);
    while lo < hi {
        let middle = lo + (hi - lo) / 2;
        if test(middle) {
            hi = middle;
        } else {
            lo = middle + 1;
        }
    }
    lo as usize
}
