//! Complex numbers on lanes.

use ppum_formula::elementary::{Atan2, Log};
use ppum_formula::real::Real;

/// A complex number: its real and imaginary part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<R>(pub R, pub R);

impl Complex<f64> {
    /// The number on all lanes.
    #[inline(always)]
    #[must_use]
    pub fn broadcast<R: Real>(self, like: R) -> Complex<R> {
        Complex(like.broadcast(self.0), like.broadcast(self.1))
    }
}

impl<R: Real> Complex<R> {
    /// The product.
    #[inline(always)]
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self(self.0 * other.0 - self.1 * other.1, self.0 * other.1 + self.1 * other.0)
    }

    /// The sum.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }

    /// The difference.
    #[inline(always)]
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }

    /// A real multiple.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let factor = self.0.broadcast(factor);
        Self(self.0 * factor, self.1 * factor)
    }

    /// The conjugate.
    #[inline(always)]
    #[must_use]
    pub fn conjugate(self) -> Self {
        Self(self.0, -self.1)
    }

    /// i times the number.
    #[inline(always)]
    #[must_use]
    pub fn turned(self) -> Self {
        Self(-self.1, self.0)
    }

    /// One over the number.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        let square = self.0 * self.0 + self.1 * self.1;
        Self(self.0 / square, -(self.1 / square))
    }

    /// The root of a number with a positive real part.
    #[inline(always)]
    #[must_use]
    pub fn root(self) -> Self {
        let half = self.0.broadcast(0.5);
        let size = (self.0 * self.0 + self.1 * self.1).sqrt();
        let real = ((size + self.0) * half).sqrt();
        Self(real, half * self.1 / real)
    }

    /// The angle, from −π to π.
    #[inline(always)]
    pub fn angle(self) -> R {
        R::via_f64([self.1, self.0], Atan2)
    }

    /// ln of a number with this angle.
    #[inline(always)]
    #[must_use]
    pub fn logarithm(self, angle: R) -> Self {
        let square = self.0 * self.0 + self.1 * self.1;
        Self(R::via_f64([square], Log) * angle.broadcast(0.5), angle)
    }
}
