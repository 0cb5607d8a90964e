//! Values of points that come from anywhere depend on their places alone.

use crate::support::compiled;
use ppum::crack::{Side, tips};
use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::sample::{AnchorMap, SampledQuantity, SidedPoint, evaluate_each};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// Points all over the plate and beyond it, on its border, on cracks, and about tips down to 1e-12.
fn places(field: &Field<'_>, random: &mut Random) -> Vec<SidedPoint> {
    let (seats, bounds, cracks) = (AnchorMap::new(field), field.domain.bounds, &field.step.cracks);
    let mut points: Vec<Vec2> = (0..600).map(|_| random.point(&bounds)).collect();
    points.extend([bounds.min, bounds.max, bounds.max + vec2(1.0, 0.0), vec2(f64::NAN, 0.0)]);
    for tip in tips(cracks) {
        let at = cracks[tip.crack as usize].end_point(tip.end);
        let near = (0..40).map(|k| random.direction() * 0.5f64.powi(k));
        points.extend(near.map(|offset| at + offset));
    }
    for crack in cracks {
        let [a, b] = [crack.points[0], crack.points[1]];
        points.extend((0..20).map(|_| a + (b - a) * random.unit()));
    }
    let side = |k: usize| if k.is_multiple_of(3) { Side::Below } else { Side::Above };
    points.iter().enumerate().map(|(k, &point)| seats.at(point, side(k))).collect()
}

fn bits(rows: &[f64]) -> Vec<u64> {
    rows.iter().map(|value| value.to_bits()).collect()
}

/// Alone, in any order, in any company: the same bits.
fn assert_alone_as_together(field: &Field<'_>, wanted: SampledQuantity<'_>, random: &mut Random) {
    let (places, width) = (places(field, random), wanted.width());
    let together = evaluate_each(field, wanted, &places);
    let mut order: Vec<usize> = (0..places.len()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, random.below(k + 1));
    }
    order.truncate(places.len() / 2);
    let some: Vec<SidedPoint> = order.iter().map(|&k| places[k]).collect();
    let shuffled = evaluate_each(field, wanted, &some);
    for (&k, row) in order.iter().zip(shuffled.chunks(width)) {
        let expected = bits(&together[k * width..][..width]);
        assert_eq!(bits(row), expected, "{:?}", places[k]);
        assert_eq!(bits(&evaluate_each(field, wanted, &places[k..=k])), expected);
    }
}

#[test]
fn values_depend_on_their_places_alone() {
    for seed in 0..24 {
        let recipe = Recipe::random(seed);
        let recipe = if seed % 2 == 1 { recipe.with_arcs() } else { recipe };
        let dataset = recipe.dataset();
        let (field, mut random) = (compiled(&dataset), Random(seed));
        let names = ["ux", "von-mises", "sxx + 2*uy", "phi:0", "overlap"];
        let parse = |name| Quantity::parse(name, &field).expect("a quantity of elasticity");
        let quantities = names.map(parse);
        assert_alone_as_together(&field, SampledQuantity::Values(&quantities), &mut random);
        assert_alone_as_together(&field, SampledQuantity::Values(&quantities[..1]), &mut random);
        let slope = |quantity: &Quantity| QuantityGradient::new(quantity, &field).expect("one");
        let slopes = quantities.each_ref().map(slope);
        assert_alone_as_together(&field, SampledQuantity::Slopes(&slopes), &mut random);
    }
}

/// The scalar evaluation about the same anchor, to rounding; and about the point itself, where no
/// tip is near.
#[test]
fn values_are_those_of_the_field() {
    for seed in 0..24 {
        let dataset = Recipe::random(seed).dataset();
        let (field, mut random) = (compiled(&dataset), Random(seed));
        let names = ["ux", "uy", "von-mises"];
        let quantities = names.map(|name| Quantity::parse(name, &field).expect("a quantity"));
        let slopes =
            quantities.each_ref().map(|q| QuantityGradient::new(q, &field).expect("a gradient"));
        let places = places(&field, &mut random);
        let rows = evaluate_each(&field, SampledQuantity::Values(&quantities), &places);
        let sloped = evaluate_each(&field, SampledQuantity::Slopes(&slopes), &places);
        for (k, place) in places.iter().enumerate() {
            let mut local = place.seen(&field);
            for (q, quantity) in quantities.iter().enumerate() {
                let expected = quantity.at(&mut local, place.offset, place.side);
                // rounding of sums that cancel, some ten of them
                let near = |found: f64, expected: f64| {
                    (found - expected).abs() <= 1e-12 * expected.abs().max(1.0)
                        || found.to_bits() == expected.to_bits()
                        || found == expected
                        || found.is_nan() && expected.is_nan()
                };
                assert!(near(rows[3 * k + q], expected), "{seed} {place:?}: {expected}");
                let slope = slopes[q].at(&mut local, place.offset, place.side);
                let [value, x, y] = [0, 1, 2].map(|n| sloped[9 * k + 3 * q + n]);
                let scale = slope.gradient.length().max(1.0);
                assert!(near(value, slope.value), "{seed} {place:?}");
                assert!(near(x / scale, slope.gradient.x / scale), "{seed} {place:?}");
                assert!(near(y / scale, slope.gradient.y / scale), "{seed} {place:?}");
            }
        }
    }
}

/// Offsets from anchors lose nothing: `anchor + offset` is the point, to the last bit.
#[test]
fn seats_lose_no_digit() {
    for seed in 0..24 {
        let dataset = Recipe::random(seed).dataset();
        let (field, mut random) = (compiled(&dataset), Random(100 + seed));
        let seats = AnchorMap::new(&field);
        let tips = tips(&field.step.cracks);
        let mut centers: Vec<Vec2> =
            tips.map(|tip| field.step.cracks[tip.crack as usize].end_point(tip.end)).collect();
        centers.push(Vec2::ZERO);
        for k in 0..500 {
            let tiny = 0.5f64.powi(k as i32 % 60);
            let point = centers[k % centers.len()] + random.point(&field.domain.bounds) * tiny;
            let place = seats.at(point, Side::Above);
            let is_exact = |p: f64, a: f64, d: f64| p - a == d && a + d == p;
            if place.on.is_none() && field.domain.at(Vec2::ZERO).contains(point) {
                assert!(is_exact(point.x, place.anchor.x, place.offset.x), "{place:?}");
                assert!(is_exact(point.y, place.anchor.y, place.offset.y), "{place:?}");
            }
        }
    }
}
