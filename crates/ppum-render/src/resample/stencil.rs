//! The weights of interpolation along one axis.

use super::Interpolation;

/// Points of a row and their weights: at most four that follow each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stencil {
    first: u32,
    weights: [f64; 4],
}

impl Stencil {
    /// The weights at a position `t`, counted in spacings from the first of `count` points, in 0
    /// ..= count − 1.
    pub(super) fn new(interpolation: Interpolation, t: f64, count: u32) -> Self {
        let cell = (t as u32).min(count - 2);
        let s = t - f64::from(cell);
        match interpolation {
            Interpolation::Nearest => {
                let first = cell + u32::from(s >= 0.5);
                Self { first, weights: [1.0, 0.0, 0.0, 0.0] }
            }
            Interpolation::Bilinear => Self { first: cell, weights: [1.0 - s, s, 0.0, 0.0] },
            Interpolation::Bicubic => Self::cubic(cell, s, count),
        }
    }

    /// Weights of the points cell − 1 … cell + 2. Those that the row does not have are
    /// extrapolated: by u₋₁ = 3 u₀ − 3 u₁ + u₂, which is exact for quadratic polynomials (Keys
    /// 1981), and of two points by u₋₁ = 2 u₀ − u₁.
    fn cubic(cell: u32, s: f64, count: u32) -> Self {
        let [mut a, mut b, mut c, mut d] = catmull_rom(s);
        if count == 2 {
            return Self { first: 0, weights: [b + 2.0 * a - d, c + 2.0 * d - a, 0.0, 0.0] };
        }
        if cell == 0 {
            (b, c, d) = (b + 3.0 * a, c - 3.0 * a, d + a);
        }
        if cell + 2 == count {
            (a, b, c) = (a + d, b - 3.0 * d, c + 3.0 * d);
        }
        match (cell == 0, cell + 2 == count) {
            (true, _) => Self { first: 0, weights: [b, c, d, 0.0] },
            (false, true) => Self { first: cell - 1, weights: [a, b, c, 0.0] },
            (false, false) => Self { first: cell - 1, weights: [a, b, c, d] },
        }
    }

    /// Σ w u over the points that count; a point of weight zero need not have a value.
    pub(super) fn sum(&self, mut value: impl FnMut(u32) -> f64) -> f64 {
        self.points().map(|(point, weight)| weight * value(point)).sum()
    }

    /// Indices and weights of the points that count.
    pub(super) fn points(&self) -> impl Iterator<Item = (u32, f64)> {
        let Self { first, weights } = *self;
        (first..).zip(weights).filter(|(_, weight)| *weight != 0.0)
    }
}

/// Weights of the points at −1, 0, 1, 2 for a value at `s` in \[0, 1\].
fn catmull_rom(s: f64) -> [f64; 4] {
    [
        0.5 * s * ((2.0 - s) * s - 1.0),
        0.5 * (s * s * (3.0 * s - 5.0) + 2.0),
        0.5 * s * ((4.0 - 3.0 * s) * s + 1.0),
        0.5 * s * s * (s - 1.0),
    ]
}
