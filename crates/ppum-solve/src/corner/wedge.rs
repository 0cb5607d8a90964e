//! The fields of wedges with free sides.
//!
//! With the opening ω > π, θ from the bisector and Kolosov's potentials φ = A z^λ, ψ = B z^λ:
//!
//! ```text
//! symmetric       sin λω = −λ sin ω      A = 1   B = −cos λω − λ cos ω
//! antisymmetric   sin λω = +λ sin ω      A = i   B = i (cos λω − λ cos ω)
//! ```
//!
//! have tractions r^λ times zero on both sides (Williams 1952). For Laplace's equation, r^λ sin λθ
//! with λ = π/ω and r^λ cos λθ with λ = 2π/ω have no flux there.

use super::exponent::Constants;
use crate::quadrature::zero;
use ppum_problem::Symmetry;
use std::f64::consts::PI;

/// Exponents that are taken: between 1 and 2 gradients are finite and polynomials still see the
/// fields badly. Complex ones, from 1.5 on, are left out.
const TAKEN: [f64; 2] = [0.49, 1.95];

/// Exponents nearer to one than this are those of polynomials.
const LINEAR: f64 = 0.01;

/// Steps in which roots are looked for.
const STEPS: usize = 1000;

/// Exponents are rounded to multiples of this, so that those of equal wedges are equal.
const ROUNDED: f64 = 1e-13;

/// A field of a wedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WedgeTerm {
    /// λ
    pub(crate) exponent: f64,
    /// Symmetry to the bisector.
    pub(crate) symmetry: Symmetry,
    /// B of a symmetric field, i B of an antisymmetric one: of the tip of a crack 1 − λ and 1 + λ.
    pub(crate) factor: f64,
}

/// The fields of a wedge of an opening, by their exponents.
pub(super) fn terms(opening: f64, constants: Constants) -> Vec<WedgeTerm> {
    match constants {
        Constants::Elastic(_) => elastic(opening),
        Constants::Poisson => harmonic(opening),
    }
}

fn elastic(opening: f64) -> Vec<WedgeTerm> {
    let both = [(Symmetry::Symmetric, 1.0), (Symmetry::Antisymmetric, -1.0)];
    let of = |(symmetry, sign): (Symmetry, f64)| {
        let term = move |exponent: f64| {
            let factor = -(exponent * opening).cos() - sign * exponent * opening.cos();
            WedgeTerm { exponent, symmetry, factor }
        };
        exponents(opening, sign).into_iter().map(term)
    };
    let mut all: Vec<WedgeTerm> = both.into_iter().flat_map(of).collect();
    all.sort_by(|a, b| a.exponent.total_cmp(&b.exponent));
    all
}

/// The simple roots of sin λω + s λ sin ω; that of s = −1 at 1, the rotation, is divided out.
fn exponents(opening: f64, s: f64) -> Vec<f64> {
    let f = |lambda: f64| (lambda * opening).sin() + s * lambda * opening.sin();
    let divided = |lambda: f64| if s < 0.0 { f(lambda) / (1.0 - lambda) } else { f(lambda) };
    let [first, last] = TAKEN;
    let at = |k: usize| first + (last - first) * k as f64 / STEPS as f64;
    let root = |k: usize| {
        let ends = [at(k), at(k + 1)];
        let [low, high] = ends.map(|end| [end, divided(end)]);
        (low[1] * high[1] < 0.0).then(|| rounded(zero(&divided, low, high)))
    };
    (0..STEPS).filter_map(root).filter(|root| (root - 1.0).abs() > LINEAR).collect()
}

fn rounded(exponent: f64) -> f64 {
    (exponent / ROUNDED).round() * ROUNDED
}

fn harmonic(opening: f64) -> Vec<WedgeTerm> {
    let term = |k: u8| {
        let symmetry =
            if k.is_multiple_of(2) { Symmetry::Symmetric } else { Symmetry::Antisymmetric };
        WedgeTerm { exponent: rounded(f64::from(k) * PI / opening), symmetry, factor: 0.0 }
    };
    (1..=4).map(term).filter(|term| term.exponent < TAKEN[1]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// The resultant force of the tractions along a ray, r^λ times A e^{iλθ} + λ Ā e^{i(2−λ)θ} +
    /// B̄ e^{−iλθ}.
    fn force(term: &WedgeTerm, theta: f64) -> [f64; 2] {
        let lambda = term.exponent;
        let way = |angle: f64| [angle.cos(), angle.sin()];
        let times_i = |[re, im]: [f64; 2]| [-im, re];
        let parts = [way(lambda * theta), way((2.0 - lambda) * theta), way(-lambda * theta)];
        let (parts, signs) = match term.symmetry {
            Symmetry::Symmetric => (parts, [1.0, lambda, term.factor]),
            // A = i, Ā = −i, and B̄ = i b for B = −i b
            Symmetry::Antisymmetric => (parts.map(times_i), [1.0, -lambda, term.factor]),
        };
        [0, 1].map(|i| parts.iter().zip(signs).map(|(part, sign)| sign * part[i]).sum())
    }

    #[test]
    fn sides_are_free() {
        let mut random = Random(4);
        for _ in 0..200 {
            let opening = random.between(1.01 * PI, 2.0 * PI);
            let all = elastic(opening);
            assert!(all[0].symmetry == Symmetry::Symmetric && all[0].exponent < 1.0, "{opening}");
            for term in all {
                for theta in [-0.5 * opening, 0.5 * opening] {
                    let size = force(&term, theta).iter().fold(0.0f64, |m, f| m.max(f.abs()));
                    assert!(size < 1e-11, "{opening} {term:?} {theta}: {size}");
                }
            }
        }
    }

    /// Exponents of Williams 1952, and the opening from which on the second one is below one.
    #[test]
    fn known_exponents() {
        let exponents = |opening: f64| -> Vec<f64> {
            elastic(opening).iter().map(|term| term.exponent).collect()
        };
        let right_angle = exponents(1.5 * PI);
        assert_eq!(right_angle.len(), 2);
        assert!((right_angle[0] - 0.544_483_736_782_464).abs() < 1e-12);
        assert!((right_angle[1] - 0.908_529_189_846_099).abs() < 1e-12);
        // the fields of a crack, without the uniform stress
        let crack = elastic(2.0 * PI);
        let factors = [(0.5, 0.5), (0.5, 1.5), (1.5, -0.5), (1.5, 2.5)];
        assert_eq!(crack.len(), factors.len());
        for (term, (exponent, factor)) in crack.iter().zip(factors) {
            assert!((term.exponent - exponent).abs() < 1e-12, "{term:?}");
            assert!((term.factor - factor).abs() < 1e-11, "{term:?}");
        }
        let second = |degrees: f64| exponents(degrees.to_radians())[1];
        assert!(second(256.0) > 1.0 && second(259.0) < 1.0);
    }
}
