//! Isolines: curves on which a quantity has given values, followed on the exact field.
//!
//! Marching squares (Lorensen, Cline 1987) covers the squares between the pixel centres, and a rim
//! of half squares up to the border of the image. The raster of any renderer selects the squares
//! that a line crosses; the line itself is then evaluated exactly, in double precision:
//!
//! - crossings of the sides of squares by Newton's method inside a bracket, with the
//!   quantity's [gradient](QuantityGradient);
//! - if a square has four crossings, the value at its centre decides which are connected;
//! - between two crossings, points are pulled onto the curve until chords are within [`CHORD`]
//!   pixels of it.
//!
//! So lines do not depend on the precision of the raster. Squares that a crack, a rim or an
//! interface cuts are processed [piece](crate::pieces) by piece: no line runs along these jumps,
//! and lines end on faces. Where a quantity jumps at a border of patches, as stresses do with the
//! linear weight, a line follows the border until its value occurs again. Values at tips may be
//! infinite: lines pass between the finite values around. A loop inside one square, and a line that
//! enters and leaves a square through one side, are not found.

mod join;
mod lattice;
mod march;
mod root;

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityGradient, Source};
use ppum::vec2::Vec2;
use ppum_raster::RasterError;
use ppum_raster::parts::Parts;
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::view::View;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::pieces::Pieces;
use lattice::{Cell, SampleLattice};
pub use march::CHORD;
use march::{LineSegment, Marcher};

/// Most points of all lines of an image. An image of 8000 × 6000 pixels with thirty lines across
/// has a third as many.
pub const MOST_POINTS: usize = 1 << 21;

/// Squares that one task marches through.
const TASK: usize = 64;

/// A connected line on which a quantity has one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoline {
    /// The value.
    pub level: f64,
    /// Offsets from the view's centre; larger values lie on the left. A closed line does not repeat
    /// its first point.
    pub points: Vec<Vec2>,
    /// True for loops. Other lines end at the border of the image, at cracks, rims and interfaces.
    pub closed: bool,
}

impl Isoline {
    /// The points; a closed line repeats the first one at the end.
    #[must_use]
    pub fn polyline(&self) -> Vec<Vec2> {
        let first = self.points.first().filter(|_| self.closed);
        self.points.iter().chain(first).copied().collect()
    }
}

/// The lines in a view on which a quantity has one of the given values, level by level, in an order
/// that depends only on the field.
///
/// `raster` holds the quantity at the view's pixel centres, by any renderer, in f64 or f32. Each
/// point of a line is within a tenth of a pixel of the exact curve. Levels that are not finite have
/// no lines.
///
/// Costs some ten evaluations of the [gradient](QuantityGradient::at) for each pixel that a
/// line passes.
///
/// # Errors
/// The field does not have the quantity; there are more than [`MOST_POINTS`] points; the watcher
/// stops the call.
///
/// # Panics
/// If the raster and the view differ in size.
pub fn isolines<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    levels: &[f64],
    raster: &Raster<T>,
    watcher: &dyn Watcher,
) -> Result<Vec<Isoline>, RasterError> {
    assert_eq!(raster.size, view.pixels, "a raster of the view");
    let pieces = match (quantity, quantity.source()) {
        (Quantity::Formula(_), _) | (_, Source::Gradient) => Pieces::new(field, view.center),
        _ => Pieces::of_values(field, view.center),
    };
    let slope = QuantityGradient::new(quantity, field)?;
    let lattice = SampleLattice::new(view);
    let search =
        MarchingData { field, view, slope, levels, pieces, lattice, points: AtomicUsize::new(0) };
    let segments = search.segments(raster, watcher)?;
    Ok(join::lines(segments, levels, view.pixel_size()))
}

/// The data of marching squares.
struct MarchingData<'a, 'f> {
    field: &'a Field<'f>,
    view: &'a View,
    slope: QuantityGradient,
    levels: &'a [f64],
    pieces: Pieces<'f>,
    lattice: SampleLattice,
    /// The number of points so far.
    points: AtomicUsize,
}

impl MarchingData<'_, '_> {
    /// All segments of all lines, in the order of their squares.
    fn segments<T: RasterValue>(
        &self,
        raster: &Raster<T>,
        watcher: &dyn Watcher,
    ) -> Result<Vec<LineSegment>, RasterError> {
        let mut new: Vec<Cell> = self.lattice.candidates(raster, self.levels, &self.pieces);
        let mut known: BTreeSet<Cell> = new.iter().copied().collect();
        let mut all: BTreeMap<Cell, Vec<LineSegment>> = BTreeMap::new();
        while !new.is_empty() {
            let parts = Parts::start(watcher, new.len().div_ceil(TASK))?;
            let marched: Result<Vec<_>, RasterError> =
                new.par_chunks(TASK).map(|cells| self.march(cells, &parts)).collect();
            all.extend(new.iter().copied().zip(marched?.into_iter().flatten()));
            // lines continue into squares that the raster did not select
            let ends = new.iter().flat_map(|cell| &all[cell]).flat_map(|segment| &segment.ends);
            let next: BTreeSet<Cell> = ends.filter_map(|end| end.neighbour).collect();
            new = next.into_iter().filter(|&cell| known.insert(cell)).collect();
        }
        Ok(all.into_values().flatten().collect())
    }

    fn march(
        &self,
        cells: &[Cell],
        parts: &Parts<'_>,
    ) -> Result<Vec<Vec<LineSegment>>, RasterError> {
        let local = self.field.at(self.view.center);
        let mut marcher = Marcher::new(&self.slope, local, self.view.pixel_size(), &self.lattice);
        let found: Vec<Vec<LineSegment>> =
            cells.iter().map(|&cell| marcher.segments(cell, self.levels, &self.pieces)).collect();
        parts.finish_one()?;
        let points = found.iter().flatten().map(|segment| segment.points.len()).sum();
        let before = self.points.fetch_add(points, Ordering::Relaxed);
        let is_too_many = before + points > MOST_POINTS;
        if is_too_many { Err(RasterError::TooManyLines(MOST_POINTS)) } else { Ok(found) }
    }
}

#[cfg(test)]
mod tests;
