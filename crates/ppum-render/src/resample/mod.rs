//! The methods of other programs: sampling a field on a grid, and interpolating the samples at the
//! pixels.
//!
//! It is here to be compared with. A [`SampleGrid`] of nx × ny points over a rectangle is given the
//! exact values of a quantity at its points, without any care for cracks between them, as tools
//! that draw grids do; a point on a crack has the value above it, points in holes have none.
//! [`GridSamples::raster`] finds the values at an image's pixels by one of three
//! [`Interpolation`]s, [`cells`] takes one value for each cell of the cover. [`norms`](mod@norms)
//! tells how far they are from the field, and [`need`] which grid would be near enough.
//!
//! ```text
//! u_h(x, y) = Σ_i Σ_j w_i(x) w_j(y) u(x_i, y_j)
//! ```

mod interpolation;
pub mod need;
pub mod norms;
mod stencil;
#[cfg(test)]
mod tests;

use ppum::box_tree::BoxTree;
use ppum::crack::Side;
use ppum::field::Field;
use ppum::function::FunctionKind;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::RasterError;
use ppum_raster::parts::Parts;
use ppum_raster::raster::Raster;
use ppum_raster::view::View;
use rayon::prelude::*;

use crate::cells::{exist, of_owners};
pub use interpolation::{Interpolation, UnknownInterpolation};
use stencil::Stencil;

/// Most points of a grid: their values then take 2 GiB.
pub const MAX_POINTS: u64 = 1 << 28;

/// The reason why there is no such grid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// Too few points, or too many.
    #[error("a grid of {0}x{1} points; give at least 2x2 and at most {MAX_POINTS} in all")]
    Points(u32, u32),
    /// A rectangle without area.
    #[error("the grid's rectangle from ({}, {}) to ({}, {}) has no area",
        .0.min.x, .0.min.y, .0.max.x, .0.max.y)]
    Empty(Rect),
}

/// nx × ny points at equal distances, the border of their rectangle included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleGrid {
    /// Points are `anchor + offset`.
    pub anchor: Vec2,
    /// The rectangle, as offsets from the anchor.
    pub bounds: Rect,
    /// Columns and rows, each 2 at least.
    pub size: [u32; 2],
}

impl SampleGrid {
    /// The grid of `size` over a rectangle.
    ///
    /// # Errors
    /// Fewer than 2 × 2 points or more than [`MAX_POINTS`]; a rectangle without area.
    pub fn new(anchor: Vec2, bounds: Rect, size: [u32; 2]) -> Result<Self, GridError> {
        let [nx, ny] = size;
        if nx < 2 || ny < 2 || u64::from(nx) * u64::from(ny) > MAX_POINTS {
            return Err(GridError::Points(nx, ny));
        }
        let extent = bounds.size();
        if !(extent.x > 0.0 && extent.y > 0.0 && extent.is_finite()) {
            return Err(GridError::Empty(Rect::new(anchor + bounds.min, anchor + bounds.max)));
        }
        Ok(Self { anchor, bounds, size })
    }

    /// The grid over the box of a field's domain.
    ///
    /// # Errors
    /// As [`SampleGrid::new`].
    pub fn over_domain(field: &Field<'_>, size: [u32; 2]) -> Result<Self, GridError> {
        let (anchor, half) = (field.domain.bounds.center(), field.domain.bounds.size() * 0.5);
        Self::new(anchor, Rect::new(-half, half), size)
    }

    /// The grid over what a view shows.
    ///
    /// # Errors
    /// As [`SampleGrid::new`].
    pub fn over_view(view: &View, size: [u32; 2]) -> Result<Self, GridError> {
        Self::new(view.center, Rect::new(-view.half(), view.half()), size)
    }

    /// Returns the rectangle with other points.
    ///
    /// # Errors
    /// As [`SampleGrid::new`].
    pub fn with_size(&self, size: [u32; 2]) -> Result<Self, GridError> {
        Self::new(self.anchor, self.bounds, size)
    }

    /// Distances of neighbouring points.
    #[must_use]
    pub fn spacing(&self) -> Vec2 {
        let ([nx, ny], extent) = (self.size.map(|n| f64::from(n - 1)), self.bounds.size());
        vec2(extent.x / nx, extent.y / ny)
    }

    /// Offset of a point from the anchor; row 0 is the lowest.
    #[must_use]
    pub fn offset(&self, column: u32, row: u32) -> Vec2 {
        let between = |a: f64, b: f64, k: u32, n: u32| {
            let t = f64::from(k) / f64::from(n - 1);
            a * (1.0 - t) + b * t
        };
        let (Rect { min, max }, [nx, ny]) = (self.bounds, self.size);
        vec2(between(min.x, max.x, column, nx), between(min.y, max.y, row, ny))
    }

    /// Memory of the samples of one quantity in double precision \[bytes\]: 8 nx ny.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        8 * u64::from(self.size[0]) * u64::from(self.size[1])
    }

    /// The exact values of a quantity at the points. Rows are spread over the threads of the pool
    /// that calls; the watcher hears of each.
    ///
    /// # Errors
    /// As for [`render`](ppum_raster::scatter::render).
    pub fn sample(
        self,
        field: &Field<'_>,
        quantity: &Quantity,
        watcher: &dyn Watcher,
    ) -> Result<GridSamples, RasterError> {
        quantity.check(field)?;
        let [columns, rows] = self.size;
        let parts = Parts::start(watcher, rows as usize)?;
        let mut values = vec![0.0; columns as usize * rows as usize];
        let lines = values.par_chunks_mut(columns as usize).enumerate();
        lines.try_for_each(|(row, line)| {
            let offsets: Vec<_> = (0..columns).map(|i| self.offset(i, row as u32)).collect();
            line.copy_from_slice(&at_offsets(field, quantity, self.anchor, &offsets));
            parts.finish_one()
        })?;
        Ok(GridSamples { grid: self, values })
    }

    /// The weights of columns and rows at `anchor + offset`; none outside the rectangle.
    fn stencils(&self, interpolation: Interpolation, offset: Vec2) -> Option<[Stencil; 2]> {
        if !self.bounds.contains(offset) {
            return None;
        }
        let from = offset - self.bounds.min;
        let (spacing, [nx, ny]) = (self.spacing(), self.size);
        let x = Stencil::new(interpolation, from.x / spacing.x, nx);
        Some([x, Stencil::new(interpolation, from.y / spacing.y, ny)])
    }
}

/// A quantity at points `anchor + offset`, above on cracks.
fn at_offsets(field: &Field<'_>, quantity: &Quantity, anchor: Vec2, offsets: &[Vec2]) -> Vec<f64> {
    Quantity::at_many(std::slice::from_ref(quantity), &mut field.at(anchor), offsets, Side::Above)
}

/// Values of a quantity at the points of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct GridSamples {
    /// The points.
    pub grid: SampleGrid,
    /// Row by row, the lowest first; NaN where nothing is defined.
    pub values: Vec<f64>,
}

impl GridSamples {
    /// The interpolated value at `grid.anchor + offset`: NaN outside the grid's rectangle, and
    /// where a value that counts is none.
    #[must_use]
    pub fn at(&self, interpolation: Interpolation, offset: Vec2) -> f64 {
        let Some([x, y]) = self.grid.stencils(interpolation, offset) else { return f64::NAN };
        let columns = self.grid.size[0] as usize;
        y.sum(|j| x.sum(|i| self.values[j as usize * columns + i as usize]))
    }

    /// The interpolated values at the pixel centres of a view: the image that the grid would give.
    #[must_use]
    pub fn raster(&self, interpolation: Interpolation, view: &View) -> Raster {
        let shift = view.center - self.grid.anchor;
        let value = |i, j| self.at(interpolation, shift + view.offset(i, j));
        Raster::from_fn(view.pixels, value)
    }
}

/// The image of one value per cell of the cover, that at the cell's centre; NaN outside the
/// cells, and in cells with their centre in a hole. It is made of 8 bytes per cell.
///
/// # Errors
/// A cover without cells; else as for [`render`](ppum_raster::scatter::render).
pub fn cells(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    watcher: &dyn Watcher,
) -> Result<Raster, RasterError> {
    quantity.check(field)?;
    if !exist(field) {
        return Err(RasterError::NoCells);
    }
    let (partition, cells) = (&field.step.partition, &field.step.partition.boxes().cell);
    let parts = Parts::start(watcher, partition.len())?;
    let center = |patch: usize| match partition.mesh() {
        Some(mesh) => mesh.origin[patch],
        None => cells[patch].center(),
    };
    let values = (0..partition.len()).into_par_iter().map(|patch| {
        let value = quantity.at(&mut field.at(center(patch)), Vec2::ZERO, Side::Above);
        parts.finish_one().map(|()| value)
    });
    let values = values.collect::<Result<Vec<_>, _>>()?;
    if partition.mesh().is_some() {
        return Ok(of_owners(field, &values, view));
    }
    let tree = BoxTree::new(cells);
    let corner = field.domain.bounds.max;
    let last = vec2(corner.x.next_down(), corner.y.next_down());
    let value = |i, j| {
        let point = view.center + view.offset(i, j);
        let inside = if field.domain.bounds.contains(point) { point.min(last) } else { point };
        let mut found = Vec::new();
        tree.query_point(inside, &mut found);
        found.first().map_or(f64::NAN, |&cell| values[cell as usize])
    };
    Ok(Raster::from_fn(view.pixels, value))
}

/// Memory of what a field is evaluated from \[bytes\]: supports and frames of the patches (four
/// points each), blocks (function, degree, place of the coefficients; one entry per patch to find
/// them), coefficients, vertices and bulges of the cracks and texts of the functions.
#[must_use]
pub fn representation_bytes(field: &Field<'_>) -> u64 {
    const POINT: usize = 16;
    let (step, data) = (field.step, field.data);
    let vertices: usize = step.cracks.iter().map(|crack| crack.points.len()).sum();
    let bulges: usize = step.cracks.iter().map(|crack| crack.bulges.len()).sum();
    let coefficients: usize = data.coefficients.iter().map(Vec::len).sum();
    let text = |kind: &FunctionKind| match kind {
        FunctionKind::Formula { text, .. } => text.len(),
        _ => 0,
    };
    let texts: usize = step.functions.iter().map(|function| text(&function.kind)).sum();
    let bytes = 4 * POINT * step.partition.len()
        + 4 * data.patch_blocks.len()
        + (4 + 1 + 8) * data.block_function.len()
        + 8 * coefficients
        + POINT * vertices
        + 8 * bulges
        + texts;
    bytes as u64
}
