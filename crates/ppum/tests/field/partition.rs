//! The partition of unity on random graded covers.

use crate::support::{ORDERS, compiled, entries, patch_size};
use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// Every weight on several covers.
fn datasets() -> impl Iterator<Item = Dataset> {
    WeightFunction::ALL.into_iter().flat_map(|weight| {
        (0..8).map(move |seed| Recipe { weight: weight.clone(), ..Recipe::random(seed) }.dataset())
    })
}

/// The patches whose half-open support holds a point, by looking at all.
fn covering(field: &Field<'_>, p: Vec2) -> Vec<usize> {
    let holds = |b: Rect| b.min.x <= p.x && p.x < b.max.x && b.min.y <= p.y && p.y < b.max.y;
    let partition = field.step.partition.boxes();
    (0..partition.len()).filter(|&i| holds(partition.support(i))).collect()
}

#[test]
fn functions_sum_to_one_and_their_derivatives_to_zero() {
    for dataset in datasets() {
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(7));
        for _ in 0..200 {
            let p = random.point(&dataset.domain.bounds);
            let mut sum = Jet::constant(0.0);
            // Where one patch is alone, all terms are zero but for rounding.
            let length = patch_size(field.step, p);
            let mut sizes = ORDERS.map(|order| length.powi(-order));
            for patch in covering(&field, p) {
                let phi = local.partition_function::<2>(patch, p).unwrap();
                assert!(phi.v >= 0.0);
                sum = sum.plus::<2>(phi);
                for (size, entry) in sizes.iter_mut().zip(entries(&phi)) {
                    *size += entry.abs();
                }
            }
            let rest = entries(&sum.minus::<2>(Jet::constant(1.0)));
            for (rest, size) in rest.into_iter().zip(sizes) {
                assert!(rest.abs() <= 1e-13 * size, "{rest:e} of {size:e} at {p:?}");
            }
        }
    }
}

/// Also at the corners of patches and cells, where the right and upper one counts.
#[test]
fn the_patches_found_are_those_that_cover() {
    for dataset in datasets() {
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(8));
        let partition = field.step.partition.boxes();
        let corner = |patch: usize| {
            let (support, cell) = (partition.support(patch), partition.cell[patch]);
            [support.min, support.max, cell.min, cell.max, partition.center[patch]]
        };
        let mut points: Vec<_> = (0..partition.len()).flat_map(corner).collect();
        points.retain(|&p| dataset.domain.contains(p));
        points.extend((0..200).map(|_| random.point(&dataset.domain.bounds)));
        for p in points {
            let (mut found, expected) = (Vec::new(), covering(&field, p));
            field.tree.query_point(p, &mut found);
            assert!(found.iter().map(|&i| i as usize).eq(expected.iter().copied()), "{p:?}");
            let covering = local.covering::<0>(p).unwrap();
            assert_eq!(covering.overlap, expected.len());
            assert!(covering.weight_sum.v > 0.0, "no weight at {p:?}");
        }
    }
}

#[test]
fn quantities_of_the_partition() {
    for dataset in datasets() {
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(dataset.domain.bounds.min), Random(9));
        let named = |name: &str| Quantity::parse(name, &field).unwrap();
        for _ in 0..50 {
            let p = random.point(&dataset.domain.bounds);
            let offset = p - dataset.domain.bounds.min;
            let patches = covering(&field, p);
            let weights = patches.iter().map(|&i| {
                let xi = p - field.step.partition.boxes().center[i];
                let half = field.step.partition.boxes().half[i];
                let w = |t: f64| field.step.partition.boxes().weight.spline(t)[0];
                w(xi.x / half.x) * w(xi.y / half.y)
            });
            let expected: f64 = weights.sum();
            let mut at = |name: &str| named(name).at(&mut local, offset, Side::Above);
            assert!((at("weight-sum") - expected).abs() < 1e-13 * expected);
            assert_eq!(at("overlap"), patches.len() as f64);
            let sum: f64 = patches.iter().map(|i| at(&format!("phi:{i}"))).sum();
            assert!((sum - 1.0).abs() < 1e-14);
            let other = (0..field.step.partition.len()).find(|i| !patches.contains(i)).unwrap();
            assert_eq!(at(&format!("phi:{other}")), 0.0);
        }
        for name in ["weight-sum", "overlap", "phi:0"] {
            let outside = Vec2 { x: -1e-9, y: 0.1 };
            assert!(named(name).at(&mut local, outside, Side::Above).is_nan(), "{name}");
        }
    }
}
