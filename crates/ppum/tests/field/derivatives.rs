//! Gradients and Hessians of whole fields against differences.

use crate::support::{
    compiled, distance_to_cracks, distance_to_kinks, entries, inside, patch_size,
};
use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::vec2::{Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// Derivatives of all entries of a component's jet along `direction`: central differences with
/// steps h, h/2 and h/4, extrapolated twice (error of order h⁶).
fn difference(
    local: &mut LocalField<'_>,
    offset: Vec2,
    direction: Vec2,
    h: f64,
    component: usize,
) -> [f64; 6] {
    let mut at =
        |t: f64| entries(&inside::<2>(local, offset + direction * t, Side::Above)[component]);
    let mut central = |h: f64| {
        let (plus, minus) = (at(h), at(-h));
        std::array::from_fn(|k| (plus[k] - minus[k]) / (2.0 * h))
    };
    let steps: [[f64; 6]; 3] = [central(h), central(h / 2.0), central(h / 4.0)];
    std::array::from_fn(|k| {
        let first = (4.0 * steps[1][k] - steps[0][k]) / 3.0;
        let second = (4.0 * steps[2][k] - steps[1][k]) / 3.0;
        (16.0 * second - first) / 15.0
    })
}

/// A point where the field is smooth all around, and the radius in which it is.
pub(crate) fn smooth_place(field: &Field<'_>, random: &mut Random) -> (Vec2, f64) {
    loop {
        let p = random.point(&field.domain.bounds);
        let border = (p - field.domain.bounds.min).min(field.domain.bounds.max - p);
        let kinks = distance_to_kinks(field.step, p).min(border.x).min(border.y);
        let size = patch_size(field.step, p);
        let cracks = distance_to_cracks(field.step, p);
        let h = (4e-3 * size).min(0.02 * cracks);
        if kinks > 2.0 * h && h > 5e-4 * size {
            return (p, h);
        }
    }
}

/// With random coefficients of degrees 0 to 8, sides, tip functions and formulas, for every weight.
#[test]
fn gradients_and_hessians_against_differences() {
    for (seed, weight) in (0..4).flat_map(|s| WeightFunction::ALL.map(|w| (s, w))) {
        let dataset = Recipe { weight: weight.clone(), ..Recipe::random(seed) }.dataset();
        let field = compiled(&dataset);
        let mut random = Random(seed);
        for _ in 0..60 {
            let (p, h) = smooth_place(&field, &mut random);
            let (mut local, size) = (field.at(p), patch_size(field.step, p));
            let u = inside::<2>(&mut local, Vec2::ZERO, Side::Above);
            for (component, u) in u.iter().enumerate() {
                let dx = difference(&mut local, Vec2::ZERO, vec2(1.0, 0.0), h, component);
                let dy = difference(&mut local, Vec2::ZERO, vec2(0.0, 1.0), h, component);
                for (name, exact, difference, order) in [
                    ("x", u.x, dx[0], 1),
                    ("y", u.y, dy[0], 1),
                    ("xx", u.xx, dx[1], 2),
                    ("xy", u.xy, dx[2], 2),
                    ("yx", u.xy, dy[1], 2),
                    ("yy", u.yy, dy[2], 2),
                ] {
                    let scale = 100.0 * size.powi(-order);
                    let error = (exact - difference).abs();
                    assert!(
                        error < 1e-8 * scale.max(exact.abs()),
                        "{weight:?} {seed} {name} at {p:?}: {exact} {difference} ({error:.1e})"
                    );
                }
            }
        }
    }
}

/// A field evaluated with fewer derivatives is the same field.
#[test]
fn fewer_derivatives_agree() {
    for seed in 0..4 {
        let dataset = Recipe::random(seed).dataset();
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(seed));
        for _ in 0..100 {
            let p = random.point(&dataset.domain.bounds);
            let two = inside::<2>(&mut local, p, Side::Above);
            let one = inside::<1>(&mut local, p, Side::Above);
            let zero = inside::<0>(&mut local, p, Side::Above);
            for ((a, b), c) in two.iter().zip(&one).zip(&zero) {
                assert_eq!([a.v, a.x, a.y], [b.v, b.x, b.y]);
                assert_eq!(b.v, c.v);
                assert_eq!([b.xx, b.xy, b.yy, c.x, c.y], [0.0; 5]);
            }
        }
    }
}
