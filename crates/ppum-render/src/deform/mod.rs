//! The deformed plate: every point X drawn where its displacement, magnified, brings it.
//!
//! ```text
//! x = X + s u(X)        F = ∂x/∂X = I + s ∇u
//! ```
//!
//! A [`Deformation`] is a displacement with its factor s. A [`DeformedView`] shows part of the
//! deformed plane on pixels; [`DeformedView::points`] finds for each pixel's centre the points of
//! the plate that lie there, to [`TOLERANCE`] of a pixel: none outside the plate and in opened
//! cracks and holes, one in the plate, several where faces that have closed lie over each other or
//! the plate folds. Each is known with the side of the crack that it belongs to.
//! [`DeformedPoints::raster`] evaluates any quantity there; [`DeformedView::path`] and its like
//! carry lines over.
//!
//! Pieces of the plate on one side of each crack (module [`pieces`](crate::pieces)) are halved
//! until their images are nearly affine; a pixel in the image of a piece starts from the affine
//! inverse and is found by Newton's method on the field itself, which does not leave the piece. So
//! displacements like √r at a tip are as good as any others.
//!
//! Points are offsets from a material anchor A, images offsets from the view's centre c:
//!
//! ```text
//! image(O) = (A + s u(A) − c) + O + s (u(A + O) − u(A))
//! ```
//!
//! The first bracket is formed once, and is zero if the view is made
//! [`around`](Deformation::around) a material point: a tip can be looked at in a view 10⁻⁹ of the
//! domain wide, where the plate that is seen lies within 10⁻¹⁶ of the tip.

mod automatic;
mod inverse;
mod leaf;
mod map;
mod material;
mod path;
mod points;
#[cfg(test)]
mod tests;

use ppum::crack::{Crack, Side, tips};
use ppum::field::Field;
use ppum::progress::Cancelled;
use ppum::quantity::QuantityError;
use ppum::vec2::{Rect, Vec2};
use ppum_raster::view::{View, ViewError};

pub use automatic::{AutomaticFactor, automatic_factor};
use map::DeformationMap;
pub use path::Paths;
pub use points::{DeformedPoints, DeformedRaster, MaterialPoint};

/// Largest distance of a found point's image from the pixel's centre, in pixels; what displacements
/// are rounded by where that is more, as in views 10⁻¹² of the domain wide.
pub const TOLERANCE: f64 = 0.005;

/// Largest factor: squares of what it magnifies must stay finite. From 10⁶ on pictures hardly
/// change with it.
pub const LARGEST_FACTOR: f64 = 1e100;

/// The reason why a plate is not drawn deformed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeformError {
    /// The field is no displacement.
    #[error("the field `{0}` is no displacement of the plane: nothing deforms")]
    NoDisplacement(String),
    /// The patches are the elements of a mesh.
    #[error(
        "fields on meshes are drawn where their points are, not where they move to; leave the deformation out"
    )]
    Mesh,
    /// The factor is not finite, or larger than [`LARGEST_FACTOR`].
    #[error(
        "the displacement's factor is {0:?}; give a number of at most {LARGEST_FACTOR:?} in size"
    )]
    Factor(f64),
    /// The plate folds too often for the picture.
    #[error(
        "magnified {0} times the plate lies over itself too often to be drawn; choose a smaller factor"
    )]
    TooFolded(f64),
    /// Pixels are smaller than the rounding of the places to which points move.
    #[error(
        "a view {0:?} wide is finer than double precision knows places of the deformed plate; widen it, or choose one \
         around a crack tip"
    )]
    TooFine(f64),
    /// There is no such view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A displacement with the factor by which it is magnified.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<'f> {
    field: &'f Field<'f>,
    factor: f64,
}

impl<'f> Deformation<'f> {
    /// The plate with `factor` times its displacement; a negative one turns it round.
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

    /// What a view of the deformed plane shows. The anchor is a tip that is seen, else the point of
    /// the plate that is seen in the middle.
    #[must_use]
    pub fn seen(&self, view: &View) -> DeformedView<'f> {
        let tip = self.nearest_tip(view);
        let found = tip.unwrap_or_else(|| self.material(view.center));
        let [x, y] = self.displacement(found);
        let shift = (found - view.center) + Vec2 { x, y } * self.factor;
        let (deformation, reference, is_exact) = (*self, [x, y], false);
        DeformedView { deformation, view: *view, anchor: found, shift, reference, is_exact }
    }

    /// The view of a width around the place to which a point of the plate moves.
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

    /// The place to which a point of the plate moves, above if it lies on a crack.
    #[must_use]
    pub fn place(&self, point: Vec2) -> Vec2 {
        self.place_by(&mut DeformationMap::new(self.field, point), point, point)
    }

    /// The same by a map that is anchored elsewhere.
    fn place_by(&self, map: &mut DeformationMap<'_>, anchor: Vec2, point: Vec2) -> Vec2 {
        point + Vec2::from(finite(map.displacement(point - anchor, Side::Above))) * self.factor
    }

    /// The displacement at a point; zero far outside the plate.
    fn displacement(&self, point: Vec2) -> [f64; 2] {
        finite(DeformationMap::new(self.field, point).displacement(Vec2::ZERO, Side::Above))
    }

    /// The tip that is seen nearest to the middle, if one is seen or lies just beside the picture.
    fn nearest_tip(&self, view: &View) -> Option<Vec2> {
        let (cracks, mut map) =
            (&self.field.step.cracks, DeformationMap::new(self.field, view.center));
        let all = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
        let near = all
            .map(|tip| ((self.place_by(&mut map, view.center, tip) - view.center).length(), tip))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        near.filter(|(distance, _)| *distance <= 2.0 * view.half().length()).map(|(_, tip)| tip)
    }

    /// A point of the plate near the one that moves to a place: by steps against what is missed.
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

/// Refuses fields that are no displacements of the plane.
fn check(field: &Field<'_>) -> Result<(), DeformError> {
    if field.step.partition.mesh().is_some() {
        return Err(DeformError::Mesh);
    }
    if field.equation.elastic().is_none() || field.components() != 2 {
        return Err(DeformError::NoDisplacement(field.data.name.clone()));
    }
    Ok(())
}

/// A displacement, or none where it is not known.
fn finite(displacement: Option<[f64; 2]>) -> [f64; 2] {
    displacement.filter(|u| u.iter().all(|c| c.is_finite())).unwrap_or([0.0; 2])
}

/// Most steps to the anchor, which need not be near.
const STEPS: usize = 60;

/// A view of the deformed plane.
#[derive(Clone, Copy, Debug)]
pub struct DeformedView<'f> {
    deformation: Deformation<'f>,
    /// The part of the deformed plane that is shown.
    pub view: View,
    /// The material anchor A.
    pub anchor: Vec2,
    /// A + s u(A) minus the view's centre.
    shift: Vec2,
    /// u(A)
    reference: [f64; 2],
    /// True if the view is made around A + s u(A), whatever that is rounded to.
    is_exact: bool,
}

impl<'f> DeformedView<'f> {
    /// The field.
    #[must_use]
    pub fn field(&self) -> &'f Field<'f> {
        self.deformation.field
    }

    /// The factor s.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.deformation.factor
    }

    /// True if pixels are larger than what places are rounded by.
    fn is_known(&self) -> bool {
        self.view.pixel_size() > 4.0 * self.rounding()
    }

    /// What a place may be off by rounding: of s u, and of A + s u(A) unless the view is made
    /// around that, whatever it is rounded to.
    fn rounding(&self) -> f64 {
        let anchor = if self.is_exact { 0.0 } else { self.anchor.length() };
        let moved = Vec2::from(self.reference).length() * self.factor().abs();
        2.0 * f64::EPSILON * (anchor + moved)
    }

    /// The cracks with their vertices where they have moved to, those of the side above.
    #[must_use]
    pub fn moved_cracks(&self) -> Vec<Crack> {
        let mut cracks = self.field().step.cracks.clone();
        let mut map = DeformationMap::new(self.field(), self.anchor);
        for point in cracks.iter_mut().flat_map(|crack| &mut crack.points) {
            *point = self.deformation.place_by(&mut map, self.anchor, *point);
        }
        cracks
    }

    /// A rectangle of offsets from the anchor that holds the plate, symmetric about the anchor.
    fn root(&self) -> Rect {
        let Rect { min, max } = self.field().domain.bounds;
        let reach = [
            self.anchor.x - min.x,
            max.x - self.anchor.x,
            self.anchor.y - min.y,
            max.y - self.anchor.y,
        ];
        let reach = reach.into_iter().fold(0.0, f64::max);
        let half = Vec2 { x: reach, y: reach };
        Rect::new(-half, half)
    }
}
