//! The deformed body: every point X drawn where its displacement, magnified, brings it.
//!
//! ```text
//! x = X + s u(X)        F = ∂x/∂X = I + s ∇u
//! ```
//!
//! A [`Deformation`] is a displacement with its factor s. A [`DeformedView`] shows part of the
//! deformed plane on pixels; [`DeformedView::points`] finds for each pixel's centre the points of
//! the body that lie there, to [`TOLERANCE`] of a pixel: none outside the body and in opened
//! cracks and holes, one in the body, several where faces that have closed lie over each other or
//! the body folds. Each is known with the side of the crack that it belongs to.
//! [`DeformedPoints::raster`] evaluates any quantity there; [`DeformedView::paths`] and its like
//! carry lines over.
//!
//! Pieces of the body on one side of each crack (module [`pieces`](crate::pieces)) are halved
//! until their images are nearly affine; a pixel in the image of a piece starts from the affine
//! inverse and is found by Newton's method on the field itself, which does not leave the piece. So
//! displacements like √r at a tip are as good as any others.
//!
//! For a mesh, the pieces are parts of the elements' reference shapes, cut by the level fields that
//! cut the elements, and Newton's method stays on the polynomials of one element (module `chart`).
//! So curved edges are exact, and elements that come apart leave gaps.
//!
//! Points are offsets from a material anchor A, images offsets from the view's centre c:
//!
//! ```text
//! image(O) = (A + s u(A) − c) + O + s (u(A + O) − u(A))
//! ```
//!
//! The first bracket is formed once, and is zero if the view is made
//! [`around`](Deformation::around) a material point: a tip can be looked at in a view 10⁻⁹ of the
//! domain wide, where the body that is seen lies within 10⁻¹⁶ of the tip.

mod automatic;
mod chart;
mod cutter;
mod edges;
mod error;
mod inverse;
mod leaf;
mod map;
mod material;
mod path;
mod points;
#[cfg(test)]
mod tests;
mod view;

use ppum::crack::{Crack, Side, tips};
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_raster::view::{View, ViewError};

pub use automatic::{AutomaticFactor, automatic_factor};
use error::check;
pub use error::{DeformError, LARGEST_FACTOR};
use map::{DeformationMap, followed};
pub use path::Paths;
pub use points::{DeformedPoints, DeformedRaster, MaterialPoint};
pub use view::{Deformation, DeformedView, TOLERANCE};

impl<'f> Deformation<'f> {
    /// The body with `factor` times its displacement; a negative one turns it round.
    ///
    /// # Errors
    /// A field of an equation without displacements; a factor that is not finite, or larger
    /// than [`LARGEST_FACTOR`].
    pub fn new(field: &'f Field<'f>, factor: f64) -> Result<Self, DeformError> {
        check(field)?;
        if factor.is_nan() || factor.abs() > LARGEST_FACTOR {
            return Err(DeformError::Factor(factor));
        }
        Ok(Self { field, factor })
    }

    /// The factor s.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Returns the visible part of the deformed plane in a view. The anchor is a tip that is seen,
    /// else the point of the body that is seen in the middle.
    #[must_use]
    pub fn seen(&self, view: &View) -> DeformedView<'f> {
        let tip = self.nearest_tip(view);
        let found = tip.unwrap_or_else(|| self.material(view.center));
        let [x, y] = self.displacement(found);
        let shift = (found - view.center) + Vec2 { x, y } * self.factor;
        let (deformation, reference, is_exact) = (*self, [x, y], false);
        DeformedView { deformation, view: *view, anchor: found, shift, reference, is_exact }
    }

    /// The view of a width around the place to which a point of the body moves.
    ///
    /// # Errors
    /// As [`View::new`].
    pub fn around(
        &self,
        point: Vec2,
        width: f64,
        pixels: [u32; 2],
    ) -> Result<DeformedView<'f>, ViewError> {
        let [x, y] = self.displacement(point);
        let view = View::new(point + Vec2 { x, y } * self.factor, width, pixels)?;
        let (deformation, reference, shift) = (*self, [x, y], Vec2::ZERO);
        Ok(DeformedView { deformation, view, anchor: point, shift, reference, is_exact: true })
    }

    /// The place to which a point of the body moves, above if it lies on a crack.
    #[must_use]
    pub fn place(&self, point: Vec2) -> Vec2 {
        self.place_by(&mut DeformationMap::new(self.field, point), point, point)
    }

    /// Returns the deformed point by a map that is anchored elsewhere.
    fn place_by(&self, map: &mut DeformationMap<'_>, anchor: Vec2, point: Vec2) -> Vec2 {
        point + Vec2::from(finite(map.displacement(point - anchor, Side::Above))) * self.factor
    }

    /// The displacement at a point; zero far outside the body.
    fn displacement(&self, point: Vec2) -> [f64; 2] {
        finite(DeformationMap::new(self.field, point).displacement(Vec2::ZERO, Side::Above))
    }

    /// The tip that is seen nearest to the middle, if one is seen or lies just beside the image.
    fn nearest_tip(&self, view: &View) -> Option<Vec2> {
        let (cracks, mut map) =
            (&self.field.step.cracks, DeformationMap::new(self.field, view.center));
        let all = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
        let near = all
            .map(|tip| ((self.place_by(&mut map, view.center, tip) - view.center).length(), tip))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        near.filter(|(distance, _)| *distance <= 2.0 * view.half().length()).map(|(_, tip)| tip)
    }

    /// A point of the body near the one that moves to a place: by steps against what is missed.
    fn material(&self, place: Vec2) -> Vec2 {
        let bounds = &self.field.domain.bounds;
        let within = |p: Vec2| p.max(bounds.min).min(bounds.max);
        let mut map = DeformationMap::new(self.field, place);
        let mut missed = |p: Vec2| place - self.place_by(&mut map, place, p);
        let mut point = within(place);
        let (mut miss, mut step) = (missed(point), 1.0);
        for _ in 0..STEPS {
            let next = within(point + miss * step);
            let after = missed(next);
            if after.length() < miss.length() {
                (point, miss) = (next, after);
            } else {
                step *= 0.5;
            }
        }
        point
    }
}

/// A displacement, or none where it is not known.
fn finite(displacement: Option<[f64; 2]>) -> [f64; 2] {
    displacement.filter(|u| u.iter().all(|c| c.is_finite())).unwrap_or([0.0; 2])
}

/// Most steps to the anchor, which need not be near.
const STEPS: usize = 60;

impl DeformedView<'_> {
    /// The cracks as polylines with their vertices where they have moved to, those of the side
    /// above, and with points between those of arcs.
    #[must_use]
    pub fn moved_cracks(&self) -> Vec<Crack> {
        let mut map = DeformationMap::new(self.field(), self.anchor);
        let mut moved = |crack: &Crack| {
            let place = |p| self.deformation.place_by(&mut map, self.anchor, p);
            Crack::polyline(followed(crack).map(place).collect(), crack.ends)
        };
        self.field().step.cracks.iter().map(&mut moved).collect()
    }
}
