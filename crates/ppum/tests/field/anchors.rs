//! `anchor + offset` is the same point wherever the anchor is.

use crate::support::{assert_close, compiled, distance_to_cracks, evaluate, inside, patch_size};
use ppum::crack::Side;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::extended::{DoubleDouble, ExtendedField, point};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// Anchors in and around the domain; at points away from cracks, where rounding p does not matter.
#[test]
fn anchored_equals_absolute() {
    for seed in 0..8 {
        let dataset = Recipe { extra: Vec::new(), ..Recipe::random(seed) }.dataset();
        let field = compiled(&dataset);
        let (mut absolute, mut random) = (field.at(Vec2::ZERO), Random(seed));
        let around = Rect::around(dataset.domain.bounds.center(), vec2(2.0, 2.0));
        for _ in 0..20 {
            let anchor = random.point(&around);
            let mut local = field.at(anchor);
            for _ in 0..20 {
                let p = random.point(&dataset.domain.bounds);
                let (size, r) = (patch_size(field.step, p), distance_to_cracks(field.step, p));
                if r < 1e-3 * size || near_border(dataset.steps[0].partition.boxes(), p) {
                    continue;
                }
                let a = inside::<2>(&mut absolute, p, Side::Above);
                let b = inside::<2>(&mut local, p - anchor, Side::Above);
                for (a, b) in a.iter().zip(&b) {
                    assert_close(a, b, 1e-11, 10.0, size.min(r));
                }
            }
        }
    }
}

/// True where rounding could choose another patch or piece of a weight.
fn near_border(partition: &ppum::dataset::BoxPartition, p: Vec2) -> bool {
    (0..partition.len()).any(|i| {
        let (d, half) = (p - partition.center[i], partition.half[i]);
        let near = |s: f64| [0.0, 1.0 / 3.0, 1.0].iter().any(|t| (s.abs() - t).abs() < 1e-12);
        near(d.x / half.x) || near(d.y / half.y)
    })
}

/// Every part of the field at once — weights, degrees 0 to 8, own frames, sides and tips of kinked
/// cracks, components — against 31 digits.
#[test]
fn values_and_gradients_against_extended_precision() {
    for seed in 0..20 {
        let recipe = if seed < 16 { Recipe::random(seed) } else { Recipe::meeting() };
        let dataset = Recipe { extra: Vec::new(), ..recipe }.dataset();
        let (field, extended) = (compiled(&dataset), ExtendedField::new(&dataset, 0));
        let mut random = Random(seed);
        for _ in 0..20 {
            let anchor = random.point(&dataset.domain.bounds);
            let mut local = field.at(anchor);
            for _ in 0..10 {
                let offset = random.point(&dataset.domain.bounds) - anchor;
                let p = anchor + offset;
                let Some(u) = evaluate::<1>(&mut local, offset, Side::Above) else { continue };
                if near_border(dataset.steps[0].partition.boxes(), p) {
                    continue;
                }
                let length = patch_size(field.step, p).min(distance_to_cracks(field.step, p));
                let exact = extended.evaluate(point(anchor, offset));
                for (u, exact) in u.iter().zip(exact) {
                    let [v, x, y] = [exact.v, exact.x, exact.y].map(DoubleDouble::to_f64);
                    let exact = ppum::jet::Jet { v, x, y, ..ppum::jet::Jet::constant(0.0) };
                    assert_close(u, &exact, 1e-13, 10.0, length);
                }
            }
        }
    }
}
