//! Polynomials and rigid motions: patches that agree give the common field back.

use crate::support::{assert_close, compiled, inside, patch_size};
use ppum::crack::Side;
use ppum::dataset::monomials;
use ppum::jet::Jet;
use ppum::polynomial::exponents;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

/// Σ c x^a y^b with derivatives, by powers.
fn powers(coefficients: &[f64], degree: usize, p: Vec2) -> Jet<f64> {
    let power = |x: f64, a: i32, d: i32| -> f64 {
        let factor: f64 = (0..d).map(|k| f64::from(a - k)).product();
        if a < d { 0.0 } else { factor * x.powi(a - d) }
    };
    let mut sum = Jet::constant(0.0);
    for ((a, b), c) in exponents(degree).zip(coefficients) {
        let m = |dx: i32, dy: i32| c * power(p.x, a, dx) * power(p.y, b, dy);
        let jet = Jet { v: m(0, 0), x: m(1, 0), y: m(0, 1), xx: m(2, 0), xy: m(1, 1), yy: m(0, 2) };
        sum = sum.plus::<2>(jet);
    }
    sum
}

/// Of degree 0 to 8 for every weight, with blocks of higher degrees, sides and tip
/// functions around.
#[test]
fn polynomials_of_every_degree() {
    for (degree, weight) in (0..=8).flat_map(|d| WeightFunction::ALL.map(|w| (d, w))) {
        let mut random = Random(degree as u64);
        let coefficients: Vec<Vec<f64>> = (0..2)
            .map(|_| (0..monomials(degree)).map(|_| random.between(-1.0, 1.0)).collect())
            .collect();
        let recipe = Recipe {
            weight,
            degrees: (degree as u8..=8).collect(),
            coefficients: Coefficients::Polynomial(coefficients.clone()),
            ..Recipe::random(degree as u64)
        };
        let dataset = recipe.dataset();
        let field = compiled(&dataset);
        let mut local = field.at(dataset.domain.bounds.center());
        for _ in 0..200 {
            let p = random.point(&dataset.domain.bounds);
            let offset = p - dataset.domain.bounds.center();
            let u = inside::<2>(&mut local, offset, Side::Above);
            for (u, coefficients) in u.iter().zip(&coefficients) {
                let expected = powers(coefficients, degree, offset);
                assert_close(u, &expected, 1e-12, 1.0, patch_size(field.step, p));
            }
        }
    }
}

#[test]
fn rigid_motions_have_no_strain_and_no_stress() {
    for seed in 0..12 {
        // u = (0.7 − 0.4 y, −0.3 + 0.4 x) about the domain's centre
        let motion = vec![vec![0.7, 0.0, -0.4], vec![-0.3, 0.4, 0.0]];
        let dataset = Recipe {
            degrees: (1..=8).collect(),
            coefficients: Coefficients::Polynomial(motion),
            ..Recipe::random(seed)
        }
        .dataset();
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(seed));
        for _ in 0..100 {
            let p = random.point(&dataset.domain.bounds);
            let tolerance = 1e-14 / patch_size(field.step, p);
            for (name, expected) in [
                ("exx", 0.0),
                ("eyy", 0.0),
                ("exy", 0.0),
                ("sxx", 0.0),
                ("syy", 0.0),
                ("sxy", 0.0),
                ("von-mises", 0.0),
                ("divergence", 0.0),
                ("curl", 0.8),
            ] {
                let q = Quantity::parse(name, &field).unwrap();
                let value = q.at(&mut local, p, Side::Above);
                assert!((value - expected).abs() < 4.0 * tolerance, "{name} {value:e} at {p:?}");
            }
        }
    }
}
