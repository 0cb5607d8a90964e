//! Affine maps of the plane: transforms of SVG, inserted blocks of DXF, ends moved together.

use ppum::vec2::{Vec2, vec2};

/// The map p ↦ x p_x + y p_y + shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlaneMap {
    /// Image of the first unit vector.
    pub(crate) x: Vec2,
    /// Image of the second one.
    pub(crate) y: Vec2,
    /// Image of the origin.
    pub(crate) shift: Vec2,
}

impl PlaneMap {
    pub(crate) const IDENTITY: Self = Self::scaling(1.0, 1.0);

    pub(crate) const fn scaling(x: f64, y: f64) -> Self {
        Self { x: vec2(x, 0.0), y: vec2(0.0, y), shift: Vec2::ZERO }
    }

    pub(crate) const fn shifting(shift: Vec2) -> Self {
        Self { x: vec2(1.0, 0.0), y: vec2(0.0, 1.0), shift }
    }

    /// A turn about the origin by an angle in degrees.
    pub(crate) fn turning(degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Self { x: vec2(cos, sin), y: vec2(-sin, cos), shift: Vec2::ZERO }
    }

    /// The turn, scaling and shift that take the ends of one segment to those of another.
    pub(crate) fn between(from: [Vec2; 2], to: [Vec2; 2]) -> Self {
        let (a, b) = (from[1] - from[0], to[1] - to[0]);
        let square = a.dot(a);
        let x = vec2(a.dot(b), a.cross(b)) / square;
        let map = Self { x, y: x.left(), shift: Vec2::ZERO };
        Self { shift: to[0] - map.vector(from[0]), ..map }
    }

    /// The image of a vector, which has no place.
    pub(crate) fn vector(&self, v: Vec2) -> Vec2 {
        self.x * v.x + self.y * v.y
    }

    /// The image of a point.
    pub(crate) fn point(&self, p: Vec2) -> Vec2 {
        self.vector(p) + self.shift
    }

    /// This map after another one.
    pub(crate) fn after(&self, first: &Self) -> Self {
        Self { x: self.vector(first.x), y: self.vector(first.y), shift: self.point(first.shift) }
    }
}
