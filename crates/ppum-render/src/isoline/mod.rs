//! Isolines: where a quantity has given values, followed through the picture on the exact field.
//!
//! The squares between the pixel centres, and a rim of half squares that reaches the picture's
//! border, are marched through (marching squares; Lorensen, Cline 1987). The raster of any renderer
//! says which squares to look at; all that a line consists of is then evaluated exactly, in
//! double precision:
//!
//! - crossings of the sides of squares by Newton's method inside a bracket, with the
//!   quantity's [gradient](QuantityGradient);
//! - of four crossings of a square those belong together that the value in its middle says;
//! - between two crossings points are pulled onto the curve until chords are within [`CHORD`]
//!   pixels of it.
//!
//! So lines do not depend on the precision of the raster. Squares that a crack, a rim or an
//! interface cuts are marched [piece](crate::pieces) by piece: no line runs along these jumps, and
//! lines end on faces. Where derivatives jump at a border of patches, as with the linear weight, a
//! line goes along the border to where its value is met again. Values at tips may be infinite:
//! lines pass between what is finite around. A loop inside one square, and a line that enters and
//! leaves a square by one side, are not seen.

mod join;
mod lattice;
mod march;
mod root;

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityGradient, Source};
use ppum::vec2::Vec2;
use ppum_raster::RenderError;
use ppum_raster::parts::Parts;
use ppum_raster::raster::{Raster, Sample};
use ppum_raster::view::View;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::pieces::Pieces;
use lattice::{Cell, Lattice};
use march::{Marcher, Segment};

/// Distance of chords from the curve up to which no point is put between, pixels.
pub const CHORD: f64 = 0.02;

/// Most points of all lines of a picture. A picture of 8000 × 6000 pixels with thirty lines across
/// has a third as many.
pub const MOST_POINTS: usize = 1 << 21;

/// Squares that one task marches through.
const TASK: usize = 64;

/// A connected line on which a quantity has one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoline {
    /// The value.
    pub level: f64,
    /// Offsets from the view's centre; larger values are on the left. The first is not repeated at
    /// the end of a closed line.
    pub points: Vec<Vec2>,
    /// True of loops. Other lines end at the picture's border, at cracks, rims and interfaces.
    pub closed: bool,
}

impl Isoline {
    /// Its points, of a closed line the first again at the end.
    #[must_use]
    pub fn polyline(&self) -> Vec<Vec2> {
        let first = self.points.first().filter(|_| self.closed);
        self.points.iter().chain(first).copied().collect()
    }
}

/// The lines on which a quantity has one of some values in a view, level by level; in an order that
/// depends on nothing but the field.
///
/// `raster` holds the quantity at the view's pixel centres, by any renderer, in f64 or f32. Each
/// point of a line is within a tenth of a pixel of the exact curve. Levels that are not finite have
/// no lines.
///
/// Costs some ten evaluations of the [gradient](QuantityGradient::at) for each pixel that a
/// line passes.
///
/// # Errors
/// The quantity has no meaning for the field; more than [`MOST_POINTS`] points; the watcher stops
/// the call.
///
/// # Panics
/// If the raster has not the view's pixels.
pub fn isolines<T: Sample>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    levels: &[f64],
    raster: &Raster<T>,
    watcher: &dyn Watcher,
) -> Result<Vec<Isoline>, RenderError> {
    assert_eq!(raster.size, view.pixels, "a raster of the view");
    let pieces = match (quantity, quantity.source()) {
        (Quantity::Formula(_), _) | (_, Source::Gradient) => Pieces::new(field, view.center),
        _ => Pieces::of_values(field, view.center),
    };
    let slope = QuantityGradient::new(quantity, field)?;
    let lattice = Lattice::new(view);
    let search =
        Search { field, view, slope, levels, pieces, lattice, points: AtomicUsize::new(0) };
    let segments = search.segments(raster, watcher)?;
    Ok(join::lines(segments, levels, view.pixel_size()))
}

/// What squares are marched with.
struct Search<'a, 'f> {
    field: &'a Field<'f>,
    view: &'a View,
    slope: QuantityGradient,
    levels: &'a [f64],
    pieces: Pieces<'f>,
    lattice: Lattice,
    /// How many there are so far.
    points: AtomicUsize,
}

impl Search<'_, '_> {
    /// All segments of all lines, in the order of their squares.
    fn segments<T: Sample>(
        &self,
        raster: &Raster<T>,
        watcher: &dyn Watcher,
    ) -> Result<Vec<Segment>, RenderError> {
        let mut new: Vec<Cell> = self.lattice.candidates(raster, self.levels, &self.pieces);
        let mut known: BTreeSet<Cell> = new.iter().copied().collect();
        let mut all: BTreeMap<Cell, Vec<Segment>> = BTreeMap::new();
        while !new.is_empty() {
            let parts = Parts::start(watcher, new.len().div_ceil(TASK))?;
            let marched: Result<Vec<_>, RenderError> =
                new.par_chunks(TASK).map(|cells| self.march(cells, &parts)).collect();
            all.extend(new.iter().copied().zip(marched?.into_iter().flatten()));
            // lines lead on to squares that the raster did not show
            let ends = new.iter().flat_map(|cell| &all[cell]).flat_map(|segment| &segment.ends);
            let next: BTreeSet<Cell> = ends.filter_map(|end| end.neighbour).collect();
            new = next.into_iter().filter(|&cell| known.insert(cell)).collect();
        }
        Ok(all.into_values().flatten().collect())
    }

    fn march(&self, cells: &[Cell], parts: &Parts<'_>) -> Result<Vec<Vec<Segment>>, RenderError> {
        let local = self.field.at(self.view.center);
        let mut marcher = Marcher::new(&self.slope, local, self.view.pixel_size(), &self.lattice);
        let found: Vec<Vec<Segment>> =
            cells.iter().map(|&cell| marcher.segments(cell, self.levels, &self.pieces)).collect();
        parts.finish_one()?;
        let points = found.iter().flatten().map(|segment| segment.points.len()).sum();
        let before = self.points.fetch_add(points, Ordering::Relaxed);
        let is_too_many = before + points > MOST_POINTS;
        if is_too_many { Err(RenderError::TooManyLines(MOST_POINTS)) } else { Ok(found) }
    }
}

#[cfg(test)]
mod tests;
