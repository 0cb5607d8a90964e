//! Reference shapes: which ξ lie in them, by how much, and points to sample them at.

use ppum_formula::real::Real;

/// A reference shape, closed, with its centroid at ξ = 0 and |ξ|, |η| ≤ 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The triangle with the corners (−½, −½), (1, −½), (−½, 1).
    Triangle,
    /// The square [−1, 1]².
    Square,
}

/// An edge as the half-plane a + b ξ + c η ≥ 0 that holds the shape.
pub(super) type ShapeEdge = [f64; 3];

const TRIANGLE: &[ShapeEdge] = &[[0.5, 1.0, 0.0], [0.5, 0.0, 1.0], [0.5, -1.0, -1.0]];
const SQUARE: &[ShapeEdge] =
    &[[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];

impl Shape {
    /// The edges.
    #[must_use]
    pub fn edges(self) -> &'static [ShapeEdge] {
        match self {
            Self::Triangle => TRIANGLE,
            Self::Square => SQUARE,
        }
    }

    /// The corners, counter-clockwise.
    #[must_use]
    pub fn corners(self) -> &'static [[f64; 2]] {
        match self {
            Self::Triangle => &[[-0.5, -0.5], [1.0, -0.5], [-0.5, 1.0]],
            Self::Square => &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        }
    }

    /// How far ξ = at + δ lies inside: min(ξ + ½, η + ½, ½ − ξ − η) of a triangle, 1 −
    /// max(|ξ|, |η|) of a square. The part of `at` is formed first, so that tiny δ beside an edge
    /// keep their digits.
    #[must_use]
    #[inline(always)]
    pub fn margin<R: Real>(self, at: [f64; 2], delta: [R; 2]) -> R {
        let [x, y] = delta;
        let mut margin = x.broadcast(f64::INFINITY);
        for &[a, b, c] in self.edges() {
            let constant = x.broadcast(sum(a, b * at[0], c * at[1]));
            margin = margin.min(constant + (x.broadcast(b) * x + y.broadcast(c) * y));
        }
        margin
    }

    /// Points of the closed shape: its centroid, and a lattice with `n` intervals an edge.
    pub fn samples(self, n: u8) -> impl Iterator<Item = [f64; 2]> {
        let (step, size) = (f64::from(n).recip(), self);
        let lattice = (0..=n).flat_map(move |j| (0..=n).map(move |i| [i, j]));
        let lattice = lattice.filter(move |[i, j]| size == Self::Square || i + j <= n);
        let place = move |[i, j]: [u8; 2]| {
            let (s, t) = (step * f64::from(i), step * f64::from(j));
            match size {
                Self::Triangle => [1.5 * s - 0.5, 1.5 * t - 0.5],
                Self::Square => [2.0 * s - 1.0, 2.0 * t - 1.0],
            }
        };
        std::iter::once([0.0; 2]).chain(lattice.map(place))
    }
}

/// a + b + c for |a|, |b|, |c| ≤ 2, with the rounding error of the first sum.
#[inline(always)]
fn sum(a: f64, b: f64, c: f64) -> f64 {
    let high = a + b;
    let part = high - a;
    let low = (a - (high - part)) + (b - part);
    (high + c) + low
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each corner lies on two edges, the centroid inside, and the shape in |ξ|, |η| ≤ 1.
    #[test]
    fn corners_and_margins() {
        for (shape, inner, count) in [(Shape::Triangle, 0.5, 16), (Shape::Square, 1.0, 26)] {
            assert_eq!(shape.margin([0.0; 2], [0.0; 2]), inner);
            for &corner in shape.corners() {
                assert_eq!(shape.margin(corner, [0.0; 2]), 0.0);
                let on = |[a, b, c]: &&ShapeEdge| a + b * corner[0] + c * corner[1] == 0.0;
                assert_eq!(shape.edges().iter().filter(on).count(), 2);
            }
            assert_eq!(shape.samples(4).count(), count);
            assert!(shape.samples(4).all(|p| shape.margin(p, [0.0; 2]) >= 0.0));
        }
        // beside an edge far below the rounding of ξ
        let at = [0.3, 0.5 - 0.3];
        let beyond =
            |h: f64| Shape::Triangle.margin(at, [h, 0.0]) - Shape::Triangle.margin(at, [0.0; 2]);
        assert!((beyond(1e-20) + 1e-20).abs() < 1e-33);
    }
}
