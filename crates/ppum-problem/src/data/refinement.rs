//! Cells divided by hand.

use ppum::crack::Crack;
use ppum::domain::Domain;
use ppum::expression::Expression;
use ppum::vec2::{Rect, Vec2, vec2};

use crate::geometry;

/// Divisions of a base cell after which a problem counts as unresolvable.
pub const DEEPEST: usize = 16;

/// Cells of a part of the body that are divided until they have a size: `[[refine]]` in problem
/// files.
///
/// A cell that meets the place, or is nearer to it than `distance`, has no side longer than `size`.
/// A formula counts with its smallest value at nine points of the intersection of the cell with the
/// box around the place: corners, centre and middles of the sides.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalRefinement {
    /// Where.
    pub place: RefinementRegion,
    /// Cells nearer than this to the place are divided as well.
    pub distance: f64,
    /// The longest side of a cell, of x and y.
    pub size: Expression,
}

/// The part of the domain that is refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RefinementRegion {
    /// All of it.
    Plate,
    /// A box.
    Box(Rect),
    /// A disc.
    Disc {
        /// Its centre.
        center: Vec2,
        /// Its radius.
        radius: f64,
    },
    /// The rim of a hole.
    Hole(usize),
    /// A crack.
    Crack(usize),
}

impl LocalRefinement {
    /// Cells of at most a size where they meet a place.
    #[must_use]
    pub fn new(place: RefinementRegion, size: impl Into<Expression>) -> Self {
        Self { place, distance: 0.0, size: size.into() }
    }

    /// The size at a point if it is one.
    ///
    /// # Errors
    /// The value, if it is not positive and finite.
    pub fn size_at(&self, p: Vec2) -> Result<f64, f64> {
        let size = self.size.value(p);
        if size > 0.0 && size.is_finite() { Ok(size) } else { Err(size) }
    }

    /// The box around all cells that are divided; that of the body if these are everywhere.
    pub fn bounds(&self, domain: &Domain, cracks: &[Crack]) -> Rect {
        let around = match self.place {
            RefinementRegion::Plate => return domain.bounds,
            RefinementRegion::Box(rect) => rect,
            RefinementRegion::Disc { center, radius } => Rect::around(center, vec2(radius, radius)),
            RefinementRegion::Hole(hole) => domain.holes[hole].rim_bounds(),
            RefinementRegion::Crack(crack) => cracks[crack].bounds(),
        };
        geometry::wider(&around, self.distance)
    }
}

/// Nine places of a box: centre, corners, middles of the sides.
pub fn nine(rect: &Rect) -> impl Iterator<Item = Vec2> + use<> {
    let (min, half) = (rect.min, rect.size() * 0.5);
    (0..9u32).map(move |k| min + vec2(half.x * f64::from(k % 3), half.y * f64::from(k / 3)))
}
