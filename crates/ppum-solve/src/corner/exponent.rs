//! The exponents of wedges.
//!
//! Elasticity: with Kolosov's formulas and φ = A z^λ, ψ = B z^λ the displacement and the resultant
//! force of the tractions along a ray are r^λ times
//!
//! ```text
//! 2μ (u_x + i u_y) ~ κ A e^{iλθ} − λ Ā e^{i(2−λ)θ} − B̄ e^{−iλθ}
//! i (F_x + i F_y)  ~   A e^{iλθ} + λ Ā e^{i(2−λ)θ} + B̄ e^{−iλθ}
//! ```
//!
//! Two conditions on each of the two rays make a determinant of order four, an entire function of λ
//! (real and imaginary parts of A and B are its unknowns); its zeros are the exponents (Williams
//! 1952). The smallest is found by counting zeros in rectangles with the argument principle, so
//! that complex ones are not missed. For free sides it is the first zero of sin λω + λ sin ω, which
//! is real and changes the sign. Laplace: λ = π/ω with the same condition on both rays, π/(2ω)
//! otherwise.

use super::sectors::Sector;
use faer::c64;
use ppum::dataset::Equation;
use ppum::vec2::Vec2;
use std::f64::consts::PI;

/// Smallest and largest exponents that are looked for. At 2π a wedge that is held on one ray
/// has 1/4.
const LEAST: f64 = 0.1;
const LARGEST: f64 = 0.99;

/// Half the height of the rectangles: exponents have imaginary parts below 0.5.
const HEIGHT: f64 = 1.0;

/// Steps along a rectangle's side of length one: the determinant turns by at most 8π along it.
const STEPS: usize = 64;

/// Accuracy of an exponent.
const ACCURACY: f64 = 1e-4;

/// The part of the equation that the exponents depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Constants {
    /// Kolosov's κ.
    Elastic(f64),
    Poisson,
}

impl Constants {
    pub(super) fn at(equation: &Equation, p: Vec2) -> Self {
        equation.elastic().map_or(Self::Poisson, |elastic| Self::Elastic(elastic.at(p).kolosov()))
    }
}

/// The smallest Re λ in (0, 1) of a sector, 1 if there is none.
pub(super) fn smallest(sector: &Sector, constants: Constants) -> f64 {
    match constants {
        Constants::Elastic(kappa) => elastic(sector, kappa),
        Constants::Poisson => {
            let alike = sector.held[0][0] == sector.held[1][0];
            let exponent = PI / sector.opening * if alike { 1.0 } else { 0.5 };
            if exponent < LARGEST { exponent } else { 1.0 }
        }
    }
}

fn elastic(sector: &Sector, kappa: f64) -> f64 {
    if sector.opening <= PI && sector.held == [[false; 2]; 2] {
        return 1.0;
    }
    let opening = sector.opening;
    let has_zeros = |right: f64| match sector.held {
        [[false, false], [false, false]] => (right * opening).sin() + right * opening.sin() < 0.0,
        _ => zeros(sector, kappa, right) > 0,
    };
    let (mut none, mut some) = (LEAST, LARGEST);
    if !has_zeros(some) {
        return 1.0;
    }
    while some - none > ACCURACY {
        let middle = 0.5 * (none + some);
        *if has_zeros(middle) { &mut some } else { &mut none } = middle;
    }
    0.5 * (none + some)
}

/// Number of zeros with LEAST < Re λ < `right`: the turns of the determinant around the rectangle.
/// It is real on the real axis, so the upper half of the way says all.
fn zeros(sector: &Sector, kappa: f64, right: f64) -> usize {
    let corners = [(LEAST, 0.0), (LEAST, HEIGHT), (right, HEIGHT), (right, 0.0)];
    let mut turned = 0.0;
    let mut last = determinant(sector, kappa, c64::new(right, 0.0));
    for side in corners.windows(2).rev() {
        let (from, to) = (side[1], side[0]);
        for k in 1..=STEPS {
            let t = k as f64 / STEPS as f64;
            let at = c64::new(from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t);
            let next = determinant(sector, kappa, at);
            turned += (next / last).arg();
            last = next;
        }
    }
    (turned / PI).round().max(0.0) as usize
}

/// Rows: two conditions on each ray; columns: Re A, Im A, Re B, Im B.
fn determinant(sector: &Sector, kappa: f64, lambda: c64) -> c64 {
    let angles = [sector.from, sector.from + sector.opening];
    let rows =
        [0, 1].map(|k| conditions((sector.held[k], sector.axes[k]), kappa, lambda, angles[k]));
    let minor = |rows: &[[c64; 4]; 2], a: usize, b: usize| {
        rows[0][a] * rows[1][b] - rows[0][b] * rows[1][a]
    };
    // Laplace's expansion by pairs of rows
    let pairs = [(0, 1, 2, 3, 1.0), (0, 2, 1, 3, -1.0), (0, 3, 1, 2, 1.0)];
    let both = |&(a, b, c, d, sign): &(usize, usize, usize, usize, f64)| {
        let ways = minor(&rows[0], a, b) * minor(&rows[1], c, d)
            + minor(&rows[0], c, d) * minor(&rows[1], a, b);
        ways * sign
    };
    pairs.iter().map(both).fold(c64::new(0.0, 0.0), |sum, part| sum + part)
}

/// The two conditions on a ray: of each component the displacement where it is held, else the
/// traction, that of −i F.
fn conditions(
    (held, axes): ([bool; 2], [Vec2; 2]),
    kappa: f64,
    lambda: c64,
    angle: f64,
) -> [[c64; 4]; 2] {
    let displacement = fields(lambda, angle, c64::new(kappa, 0.0), -1.0);
    let force = fields(lambda, angle, c64::new(1.0, 0.0), 1.0);
    let sum = |[a, b]: &[[c64; 4]; 2], x: f64, y: f64| std::array::from_fn(|j| a[j] * x + b[j] * y);
    [0, 1].map(|i| match held[i] {
        true => sum(&displacement, axes[i].x, axes[i].y),
        false => sum(&force, -axes[i].y, axes[i].x),
    })
}

/// Real and imaginary part of s A e^{iλθ} + t (λ Ā e^{i(2−λ)θ} + B̄ e^{−iλθ}), continued to
/// complex λ.
fn fields(lambda: c64, angle: f64, s: c64, t: f64) -> [[c64; 4]; 2] {
    let (sin, cos) = ((lambda * angle).sin(), (lambda * angle).cos());
    let other = (c64::new(2.0, 0.0) - lambda) * angle;
    let (os, oc) = (lambda * other.sin() * t, lambda * other.cos() * t);
    let real = [s * cos + oc, -s * sin + os, cos * t, -sin * t];
    let imaginary = [s * sin + os, s * cos - oc, -sin * t, -cos * t];
    [real, imaginary]
}
