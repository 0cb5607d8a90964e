//! Points and vectors of the plane, in f64.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A point or a vector of the plane. Positions have the unit length of the dataset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec2 {
    /// Horizontal component.
    pub x: f64,
    /// Vertical component.
    pub y: f64,
}

/// Shorthand for [`Vec2`] from its components.
#[must_use]
pub const fn vec2(x: f64, y: f64) -> Vec2 {
    Vec2 { x, y }
}

impl Vec2 {
    /// The origin.
    pub const ZERO: Self = vec2(0.0, 0.0);

    /// Scalar product a · b.
    #[must_use]
    pub fn dot(self, b: Self) -> f64 {
        self.x * b.x + self.y * b.y
    }

    /// Signed area a × b = a_x b_y − a_y b_x; positive when `b` lies left of `a`.
    #[must_use]
    pub fn cross(self, b: Self) -> f64 {
        self.x * b.y - self.y * b.x
    }

    /// Euclidean length, free of overflow.
    #[must_use]
    pub fn length(self) -> f64 {
        self.x.hypot(self.y)
    }

    /// The vector turned by +90°: the left normal of a direction.
    #[must_use]
    pub fn left(self) -> Self {
        vec2(-self.y, self.x)
    }

    /// The vector scaled to length one; not finite for the zero vector.
    #[must_use]
    pub fn unit(self) -> Self {
        self / self.length()
    }

    /// Componentwise minimum.
    #[must_use]
    pub fn min(self, b: Self) -> Self {
        vec2(self.x.min(b.x), self.y.min(b.y))
    }

    /// Componentwise maximum.
    #[must_use]
    pub fn max(self, b: Self) -> Self {
        vec2(self.x.max(b.x), self.y.max(b.y))
    }

    /// The maximum norm, max(|x|, |y|).
    #[must_use]
    pub fn max_norm(self) -> f64 {
        self.x.abs().max(self.y.abs())
    }

    /// True if both components are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl From<[f64; 2]> for Vec2 {
    fn from([x, y]: [f64; 2]) -> Self {
        vec2(x, y)
    }
}

impl From<Vec2> for [f64; 2] {
    fn from(v: Vec2) -> Self {
        [v.x, v.y]
    }
}

impl Add for Vec2 {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        vec2(self.x + b.x, self.y + b.y)
    }
}

impl Sub for Vec2 {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        vec2(self.x - b.x, self.y - b.y)
    }
}

impl Neg for Vec2 {
    type Output = Self;
    fn neg(self) -> Self {
        vec2(-self.x, -self.y)
    }
}

impl Mul<f64> for Vec2 {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        vec2(self.x * s, self.y * s)
    }
}

impl Div<f64> for Vec2 {
    type Output = Self;
    fn div(self, s: f64) -> Self {
        vec2(self.x / s, self.y / s)
    }
}

/// An axis-parallel box, closed. Empty when a component of `min` exceeds that of `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Lower left corner.
    pub min: Vec2,
    /// Upper right corner.
    pub max: Vec2,
}

impl Rect {
    /// The box that holds nothing: its union with another one is that one.
    pub const EMPTY: Self =
        Self::new(vec2(f64::INFINITY, f64::INFINITY), vec2(f64::NEG_INFINITY, f64::NEG_INFINITY));

    /// The box with the given corners.
    #[must_use]
    pub const fn new(min: Vec2, max: Vec2) -> Self {
        Self { min, max }
    }

    /// The box `center ± half`.
    #[must_use]
    pub fn around(center: Vec2, half: Vec2) -> Self {
        Self::new(center - half, center + half)
    }

    /// Centre of the box.
    #[must_use]
    pub fn center(&self) -> Vec2 {
        (self.min + self.max) * 0.5
    }

    /// Width and height.
    #[must_use]
    pub fn size(&self) -> Vec2 {
        self.max - self.min
    }

    /// The largest magnitude of a corner's coordinates.
    #[must_use]
    pub fn max_norm(&self) -> f64 {
        self.min.max_norm().max(self.max.max_norm())
    }

    /// Corners, counter-clockwise from the lower left one.
    #[must_use]
    pub fn corners(&self) -> [Vec2; 4] {
        [self.min, vec2(self.max.x, self.min.y), self.max, vec2(self.min.x, self.max.y)]
    }

    /// Sides, from each corner to the next.
    #[must_use]
    pub fn sides(&self) -> [[Vec2; 2]; 4] {
        let [a, b, c, d] = self.corners();
        [[a, b], [b, c], [c, d], [d, a]]
    }

    /// True if `p` lies in the closed box.
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        p.x >= self.min.x && p.x <= self.max.x && p.y >= self.min.y && p.y <= self.max.y
    }

    /// True if the open interiors meet.
    #[must_use]
    pub fn overlaps(&self, b: &Self) -> bool {
        self.min.x < b.max.x && b.min.x < self.max.x && self.min.y < b.max.y && b.min.y < self.max.y
    }

    /// The common part; empty (and then not to be used as a box) if there is none.
    #[must_use]
    pub fn intersection(&self, b: &Self) -> Self {
        Self::new(self.min.max(b.min), self.max.min(b.max))
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, b: &Self) -> Self {
        Self::new(self.min.min(b.min), self.max.max(b.max))
    }

    /// Distance of `p` to the closed box, zero inside.
    #[must_use]
    pub fn distance(&self, p: Vec2) -> f64 {
        (p - p.max(self.min).min(self.max)).length()
    }
}
