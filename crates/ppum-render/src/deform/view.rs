//! A displacement with its factor, and a view of the deformed plane.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_raster::view::View;

/// Largest distance of a found point's image from the pixel's centre, in pixels; what displacements
/// are rounded by where that is more, as in views 10⁻¹² of the domain wide.
pub const TOLERANCE: f64 = 0.005;

/// A displacement with the factor by which it is magnified.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<'f> {
    pub(super) field: &'f Field<'f>,
    pub(super) factor: f64,
}

/// A view of the deformed plane.
#[derive(Clone, Copy, Debug)]
pub struct DeformedView<'f> {
    pub(super) deformation: Deformation<'f>,
    /// The part of the deformed plane that is shown.
    pub view: View,
    /// The material anchor A.
    pub anchor: Vec2,
    /// A + s u(A) minus the view's centre.
    pub(super) shift: Vec2,
    /// u(A)
    pub(super) reference: [f64; 2],
    /// True if the view is made around A + s u(A), whatever that is rounded to.
    pub(super) is_exact: bool,
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
    pub(super) fn is_known(&self) -> bool {
        self.view.pixel_size() > 4.0 * self.rounding()
    }

    /// The possible rounding error of a place: of s u, and of A + s u(A) unless the view is made
    /// around that, whatever it is rounded to.
    pub(super) fn rounding(&self) -> f64 {
        let anchor = if self.is_exact { 0.0 } else { self.anchor.length() };
        let moved = Vec2::from(self.reference).length() * self.factor().abs();
        2.0 * f64::EPSILON * (anchor + moved)
    }

    /// A rectangle of offsets from the anchor that holds the body, symmetric about the anchor.
    pub(super) fn root(&self) -> Rect {
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
