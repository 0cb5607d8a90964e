//! The map of one element: x = M(ξ), its derivatives, its inverse.
//!
//! Inversion is by Newton's method from the linear part. Where that does not find a ξ of the shape,
//! the shape is halved again and again. On a part with the centre c and the half-width s let J be
//! DM(c) and N the terms of higher degree in u = (ξ − c)/s, each c_k times J⁻¹:
//!
//! ```text
//! κ = Σ |J⁻¹ c_k|     |u − J⁻¹ (t − M(c))| ≤ κ for every solution u of the part          (nothing here: leave it)
//! L = Σ k |J⁻¹ c_k|   L < 1: u ← u − J⁻¹ (M(u) − t), put back into the part, contracts     (one solution or none)
//! Q = Σ k (k − 1) |J⁻¹ c_k|   L ≤ ½: an error e becomes at most Q e² by a step of Newton's method
//! ```

use super::shape::Shape;
use super::taylor::DensePolynomial;
use crate::compensated::{SumWithError, difference, exact_product};
use crate::jet::Jet;
use crate::polynomial::{PolynomialSpace, polynomial_in};
use ppum_formula::real::Real;

/// Most coefficients: those of Q_8.
const MOST: usize = 81;

/// A point owns a patch if its ξ lies no farther outside the shape than this, and no other patch
/// holds it.
pub(super) const TOLERANCE: f64 = 1e-11;

/// Largest contraction L that is iterated.
const CONTRACTION: f64 = 0.75;

/// Largest δ of the form that is seen from ξ(anchor).
pub(super) const NEAR: f64 = 0.25;

/// Relative error that is rounding, and most steps of Newton's method on lanes.
const ROUNDING: f64 = 1e-16;
const MOST_STEPS: u32 = 6;

/// Most parts that are looked at.
const MOST_PARTS: usize = 1 << 6;

/// The polynomials of a map in ξ, or in δ = ξ − at; the constants are 0.
#[derive(Clone, Debug)]
pub(super) struct PolynomialMap {
    degree: usize,
    space: PolynomialSpace,
    x: [f64; MOST],
    y: [f64; MOST],
}

impl PolynomialMap {
    /// The map of coefficients without their constants.
    pub(super) fn new(space: PolynomialSpace, degree: u8, [x, y]: [&[f64]; 2]) -> Self {
        let mut map = Self { degree: degree.into(), space, x: [0.0; MOST], y: [0.0; MOST] };
        map.x[1..=x.len()].copy_from_slice(x);
        map.y[1..=y.len()].copy_from_slice(y);
        map
    }

    #[inline(always)]
    pub(super) fn at<R: Real, const D: usize>(&self, xi: [R; 2]) -> [Jet<R>; 2] {
        let Self { space, degree, x, y } = self;
        [
            polynomial_in::<R, D>(*space, x, *degree, xi),
            polynomial_in::<R, D>(*space, y, *degree, xi),
        ]
    }

    /// True of a linear map: that of a straight triangle, or of a parallelogram.
    pub(super) fn is_affine(&self) -> bool {
        self.degree == 1 && self.x[3] == 0.0 && self.y[3] == 0.0
    }

    /// The highest total degree of the monomials.
    fn highest(&self) -> i32 {
        let factor = if self.space == PolynomialSpace::Tensor { 2 } else { 1 };
        factor * self.degree as i32
    }

    /// The columns of ∂M/∂ξ and ∂M/∂η at ξ = 0.
    fn linear(&self) -> Matrix {
        let eta = if self.space == PolynomialSpace::Tensor { self.degree + 1 } else { 2 };
        Matrix([[self.x[1], self.x[eta]], [self.y[1], self.y[eta]]])
    }

    /// The coefficients of the map seen from `at`, and the constant M(at).
    pub(super) fn shifted(&self, at: [f64; 2]) -> (Self, [SumWithError; 2]) {
        let mut out = self.clone();
        let constants = [(&self.x, &mut out.x), (&self.y, &mut out.y)].map(|(from, to)| {
            let mut dense = DensePolynomial::new(self.space, self.degree, from);
            dense.shift(at);
            let constant = dense.constant();
            dense.store(self.space, self.degree, to);
            to[0] = 0.0;
            constant
        });
        (out, constants)
    }

    /// The map in u of ξ = s u.
    fn scaled(mut self, s: f64) -> Self {
        for (k, (a, b)) in self.space.exponents(self.degree).enumerate() {
            let power = s.powi(a + b);
            self.x[k] *= power;
            self.y[k] *= power;
        }
        self
    }

    fn bounds(&self) -> Option<MapBounds> {
        let inverse = self.linear().inverse()?;
        let mut bounds = MapBounds { inverse, kappa: 0.0, lipschitz: 0.0, curvature: 0.0 };
        if self.degree == 1 && self.space == PolynomialSpace::Total {
            return Some(bounds);
        }
        for (k, (a, b)) in self.space.exponents(self.degree).enumerate() {
            let (part, power) = (largest(inverse.times([self.x[k], self.y[k]])), f64::from(a + b));
            if a + b > 1 {
                bounds.kappa += part;
                bounds.lipschitz += part * power;
                bounds.curvature += part * power * (power - 1.0);
            }
        }
        Some(bounds)
    }

    /// The solution of a linear map with the rounding errors of t and of the products.
    #[inline(always)]
    fn refined<R: Real>(&self, inverse: &Matrix, xi: [R; 2], t: [(R, R); 2]) -> [R; 2] {
        let Matrix([first, second]) = self.linear();
        let step = inverse.times([residual(first, xi, t[0]), residual(second, xi, t[1])]);
        [xi[0] + step[0], xi[1] + step[1]]
    }

    /// Newton's method; `None` if it does not arrive.
    fn newton(&self, mut xi: [f64; 2], t: [f64; 2]) -> Option<[f64; 2]> {
        for _ in 0..16 {
            let [x, y] = self.at::<f64, 1>(xi);
            let inverse = Matrix([[x.x, x.y], [y.x, y.y]]).inverse()?;
            let step = inverse.times([x.v - t[0], y.v - t[1]]);
            xi = [xi[0] - step[0], xi[1] - step[1]];
            if largest(xi) >= 4.0 || (xi[0] + xi[1]).is_nan() {
                return None;
            }
            // the next step is about the square of this one
            if largest(step) <= 1e-9 * largest(xi) || largest(step) <= 1e-15 {
                return Some(xi);
            }
        }
        None
    }

    /// A solution in the shape by halving, sure where Newton's method is not.
    #[cold]
    fn search(&self, shape: Shape, t: [f64; 2]) -> Option<[f64; 2]> {
        let mut parts = vec![([0.0; 2], 1.0)];
        for _ in 0..MOST_PARTS {
            let (at, size) = parts.pop()?;
            if shape.margin(at, [0.0; 2]) < -2.0 * size {
                continue;
            }
            match self.search_part(shape, (at, size), t) {
                SearchOutcome::Solution(xi) => return Some(xi),
                SearchOutcome::Nothing => {}
                SearchOutcome::Unknown if size < 1e-6 => {}
                SearchOutcome::Unknown => {
                    let h = 0.5 * size;
                    let quarter = |[i, j]: [f64; 2]| ([at[0] + i * h, at[1] + j * h], h);
                    parts.extend([[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(quarter));
                }
            }
        }
        None
    }

    fn search_part(&self, shape: Shape, (at, size): ([f64; 2], f64), t: [f64; 2]) -> SearchOutcome {
        let (map, constant) = self.shifted(at);
        let map = map.scaled(size);
        let t = [t[0] - constant[0].0 - constant[0].1, t[1] - constant[1].0 - constant[1].1];
        let Some(bounds) = map.bounds() else { return SearchOutcome::Unknown };
        if largest(bounds.inverse.times(t)) > 1.0 + bounds.kappa + 1e-9 {
            return SearchOutcome::Nothing;
        }
        if bounds.lipschitz > CONTRACTION {
            return SearchOutcome::Unknown;
        }
        match map.contracted(&bounds.inverse, t) {
            Some(u) => {
                let xi = [at[0] + size * u[0], at[1] + size * u[1]];
                let is_here = shape.margin([0.0; 2], xi) >= -TOLERANCE;
                if is_here { SearchOutcome::Solution(xi) } else { SearchOutcome::Nothing }
            }
            None => SearchOutcome::Nothing,
        }
    }

    /// The solution in the square of u, by the contraction.
    fn contracted(&self, inverse: &Matrix, t: [f64; 2]) -> Option<[f64; 2]> {
        let mut u = [0.0; 2];
        for _ in 0..120 {
            let [x, y] = self.at::<f64, 0>(u);
            let step = inverse.times([x.v - t[0], y.v - t[1]]);
            let next = [0, 1].map(|k| (u[k] - step[k]).clamp(-1.0, 1.0));
            let moved = largest([next[0] - u[0], next[1] - u[1]]);
            u = next;
            if moved < 1e-13 {
                break;
            }
        }
        // boundaries of parts are those of their neighbours, except for rounding
        self.newton(u, t).filter(|u| largest(*u) <= 1.0 + 1e-6)
    }
}

/// J⁻¹, κ, L and Q in the square.
#[derive(Clone, Copy, Debug)]
struct MapBounds {
    inverse: Matrix,
    kappa: f64,
    lipschitz: f64,
    curvature: f64,
}

/// A map, ready to be inverted.
#[derive(Clone, Debug)]
pub(super) struct MapInverse {
    pub(super) map: PolynomialMap,
    bounds: MapBounds,
}

impl MapInverse {
    /// `None` if the map is singular at ξ = 0.
    pub(super) fn new(map: PolynomialMap) -> Option<Self> {
        let bounds = map.bounds()?;
        Some(Self { map, bounds })
    }

    /// A ξ of the shape, or beside it, with M(ξ) = t, for t and its rounding error. Newton's method
    /// begins at `start`, if that is known.
    #[inline]
    pub(super) fn at(
        &self,
        shape: Shape,
        t: [SumWithError; 2],
        start: Option<[f64; 2]>,
    ) -> Option<[f64; 2]> {
        let target = t.map(|t| t.0 + t.1);
        let guess = self.bounds.inverse.times(target);
        if shape.margin([0.0; 2], guess) < -self.beyond() {
            return None;
        }
        if self.map.is_affine() {
            return Some(self.map.refined(&self.bounds.inverse, guess, t));
        }
        let start = start.unwrap_or_else(|| guess.map(|g| g.clamp(-1.0, 1.0)));
        match self.map.newton(start, target) {
            Some(xi) if self.decides(shape, xi) => Some(xi),
            _ => self.map.search(shape, target),
        }
    }

    /// How far the linear part's ξ may lie outside the shape for a solution in it: margins change
    /// by no more than twice as much as ξ.
    #[inline]
    pub(super) fn beyond(&self) -> f64 {
        2.0 * self.bounds.kappa + 1e-6
    }

    /// The slopes in x and y of a function of ξ with slopes in ξ and η, for the linear part.
    #[inline]
    pub(super) fn slopes(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Matrix([[a, b], [c, d]]) = self.bounds.inverse;
        [x * a + y * c, x * b + y * d]
    }

    /// True if a solution lies in the shape, or no other does: in the square of the half-width r ≥
    /// 1 that holds both, u ← u − J⁻¹ (M(u) − t) changes distances by a factor of at most
    /// L r^(k − 1), k the highest degree, and there is one solution where that is below 1.
    #[inline]
    pub(super) fn decides(&self, shape: Shape, xi: [f64; 2]) -> bool {
        shape.margin([0.0; 2], xi) >= -TOLERANCE || self.uniqueness(xi) > 0.0
    }

    /// On lanes, the ξ with M(ξ) = t, and by how much that is sure: where the second number is
    /// negative, Newton's method needs more steps or does not arrive. Linear maps are solved.
    #[inline(always)]
    pub(super) fn solve<R: Real>(&self, t: [(R, R); 2]) -> ([R; 2], R) {
        let target = [t[0].0 + t[0].1, t[1].0 + t[1].1];
        let guess = self.bounds.inverse.times(target);
        match self.map.is_affine() {
            true => (self.map.refined(&self.bounds.inverse, guess, t), target[0].broadcast(1.0)),
            false => self.newton_on(guess, target),
        }
    }

    /// Newton's method from a place put into the square. The error that the last step leaves, Q
    /// times its square, must be rounding.
    #[inline(always)]
    fn newton_on<R: Real>(&self, guess: [R; 2], t: [R; 2]) -> ([R; 2], R) {
        let (one, (curvature, mut left)) = (t[0].broadcast(1.0), self.lane_steps());
        let mut xi = [guess[0].min(one).max(-one), guess[1].min(one).max(-one)];
        let mut size = one;
        while left > 0 {
            left -= 1;
            let [x, y] = self.map.at::<R, 1>(xi);
            let inverse = one / (x.x * y.y - x.y * y.x);
            let (dx, dy) = (x.v - t[0], y.v - t[1]);
            let step = [(y.y * dx - x.y * dy) * inverse, (x.x * dy - y.x * dx) * inverse];
            xi = [xi[0] - step[0], xi[1] - step[1]];
            size = largest(step);
        }
        (xi, largest(xi) * one.broadcast(ROUNDING) - size * size * one.broadcast(curvature))
    }

    /// Q and the steps of Newton's method on lanes: errors are at most κ at first. Where DM turns
    /// too far for the bound (L > ½), Q is taken to be 100, and points that need more steps are
    /// looked at one by one.
    fn lane_steps(&self) -> (f64, u32) {
        let MapBounds { kappa, lipschitz, curvature, .. } = self.bounds;
        let q = if lipschitz <= 0.5 { curvature } else { curvature.max(100.0) };
        let (mut error, mut steps) = (q * kappa * kappa, 1);
        while error > ROUNDING && steps < MOST_STEPS {
            error = q * error * error;
            steps += 1;
        }
        (q, steps)
    }

    /// How far below 1 the contraction is in the square that holds ξ and the shape: no
    /// other solution lies there where this is positive.
    #[inline(always)]
    pub(super) fn uniqueness<R: Real>(&self, xi: [R; 2]) -> R {
        let one = xi[0].broadcast(1.0);
        let (size, mut contraction) = (largest(xi).max(one), one.broadcast(self.bounds.lipschitz));
        for _ in 1..self.map.highest() {
            contraction = contraction * size;
        }
        one - contraction
    }

    /// The ξ with M(ξ) = t if it lies within a quarter of 0.
    pub(super) fn near(&self, t: [SumWithError; 2]) -> Option<[f64; 2]> {
        let guess = self.bounds.inverse.times(t.map(|t| t.0));
        let found = match self.map.is_affine() {
            true => Some(self.map.refined(&self.bounds.inverse, guess, t)),
            false => self.map.newton(guess, t.map(|t| t.0 + t.1)),
        };
        found.filter(|xi| largest(*xi) <= NEAR)
    }

    /// The ξ with M(ξ) = t in the shape, or one that lies beside it.
    pub(super) fn beside(&self, shape: Shape, t: [SumWithError; 2]) -> Option<[f64; 2]> {
        let newton = || {
            let target = t.map(|t| t.0 + t.1);
            let guess = self.bounds.inverse.times(target);
            self.map.newton(guess.map(|g| g.clamp(-1.0, 1.0)), target)
        };
        let found = self.at(shape, t, None).or_else(newton);
        found.filter(|&xi| shape.margin([0.0; 2], xi) >= -0.25)
    }
}

/// The result of the search for a solution in a box.
enum SearchOutcome {
    Solution([f64; 2]),
    Nothing,
    Unknown,
}

/// t − (a ξ + b η) with the rounding errors of t and of the products.
#[inline(always)]
fn residual<R: Real>([a, b]: [f64; 2], [x, y]: [R; 2], t: (R, R)) -> R {
    let (p, q) = (exact_product(x.broadcast(a), x), exact_product(y.broadcast(b), y));
    let first = difference(t.0, p.0);
    let second = difference(first.0, q.0);
    second.0 + (first.1 + second.1 + t.1 - (p.1 + q.1))
}

#[inline(always)]
pub(super) fn largest<R: Real>([a, b]: [R; 2]) -> R {
    a.abs().max(b.abs())
}

/// A matrix in rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matrix(pub(super) [[f64; 2]; 2]);

impl Matrix {
    /// `None` if the determinant is zero, or not finite.
    #[inline]
    pub(super) fn inverse(&self) -> Option<Self> {
        let [[a, b], [c, d]] = self.0;
        let inverse = 1.0 / (a * d - b * c);
        inverse
            .is_finite()
            .then(|| Self([[d * inverse, -b * inverse], [-c * inverse, a * inverse]]))
    }

    #[inline(always)]
    pub(super) fn times<R: Real>(&self, [x, y]: [R; 2]) -> [R; 2] {
        let Self([[a, b], [c, d]]) = *self;
        [x.broadcast(a) * x + y.broadcast(b) * y, x.broadcast(c) * x + y.broadcast(d) * y]
    }
}
