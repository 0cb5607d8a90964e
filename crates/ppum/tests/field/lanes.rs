//! Many points at once equal one point at a time, and points outside are told.

use crate::support::{assert_close, compiled, distance_to_cracks, evaluate, patch_size};
use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

fn compare<const D: usize>(field: &Field<'_>, anchor: Vec2, points: &[Vec2], side: Side) {
    let mut local = field.at(anchor);
    let components = field.components();
    let mut many = vec![Jet::constant(7.0); points.len() * components];
    local.evaluate_into::<D>(points, side, &mut many);
    for (&offset, many) in points.iter().zip(many.chunks(components)) {
        let p = anchor + offset;
        match evaluate::<D>(&mut local, offset, side) {
            None => assert!(many.iter().all(|jet| jet.v.is_nan() && jet.x.is_nan())),
            Some(one) => {
                let r = distance_to_cracks(field.step, p);
                let length = patch_size(field.step, p).min(r).max(1e-6);
                for (one, many) in one.iter().zip(many) {
                    assert_close(one, many, 1e-12, 10.0, length);
                }
            }
        }
    }
}

/// Points anywhere, a third of them outside, in chunks of mixed origin, and a rest that fills
/// no vector.
#[test]
fn lanes_equal_single_points() {
    for seed in 0..13 {
        let recipe = match seed {
            12 => Recipe::meeting(),
            seed if seed % 2 == 1 => Recipe::random(seed).with_arcs(),
            seed => Recipe::random(seed),
        };
        let dataset = recipe.dataset();
        let field = compiled(&dataset);
        let mut random = Random(seed);
        let around =
            Rect::around(dataset.domain.bounds.center(), dataset.domain.bounds.size() * 0.6);
        let anchor = random.point(&around);
        let points: Vec<_> = (0..1003).map(|_| random.point(&around) - anchor).collect();
        for side in [Side::Above, Side::Below] {
            compare::<0>(&field, anchor, &points, side);
            compare::<1>(&field, anchor, &points, side);
            compare::<2>(&field, anchor, &points, side);
        }
        compare::<1>(&field, anchor, &points[..3], Side::Above);
        compare::<1>(&field, anchor, &[], Side::Above);
    }
}

/// Neighbouring points in one vector, across borders, cracks and tips.
#[test]
fn lanes_along_lines_through_tips() {
    let recipe = Recipe::random(3);
    let dataset = recipe.dataset();
    let field = compiled(&dataset);
    let mut random = Random(3);
    for tip in recipe.tips().map(|tip| recipe.position(tip)) {
        for width in [1e-6, 1e-3, 0.3] {
            let direction = random.direction() * width;
            let line = |k: i32| direction * (f64::from(k) / 100.0);
            let points: Vec<_> = (-97..100).filter(|&k| k != 0).map(line).collect();
            compare::<2>(&field, tip, &points, Side::Above);
        }
    }
}

/// A function without a value far from the patches that use it spoils no lane.
#[test]
fn functions_of_other_patches_do_no_harm() {
    use ppum::function::{Frame, FunctionKind};
    let text = "1/max(0, 0.9 - x)".to_owned();
    let extra = vec![FunctionKind::formula(&text, Frame::World)];
    let mut dataset = Recipe { extra, ..Recipe::default() }.dataset();
    // take the function from the patches that reach beyond x = 0.85
    let step = &mut dataset.steps[0];
    let last = step.functions.len() as u32 - 1;
    for patch in 0..step.partition.len() {
        if step.partition.boxes().support(patch).max.x > 0.85 {
            for block in step.fields[0].blocks(patch) {
                let function = &mut step.fields[0].block_function[block];
                *function = if *function == last { 0 } else { *function };
            }
        }
    }
    let field = compiled(&dataset);
    let mut random = Random(5);
    let points: Vec<_> = (0..400).map(|_| random.point(&dataset.domain.bounds)).collect();
    compare::<2>(&field, Vec2::ZERO, &points, Side::Above);
}

#[test]
fn outside_there_is_nothing() {
    let dataset = Recipe::default().dataset();
    let field = compiled(&dataset);
    let mut local = field.at(Vec2::ZERO);
    let (min, max) = (dataset.domain.bounds.min, dataset.domain.bounds.max);
    let mises = Quantity::parse("von-mises", &field).unwrap();
    let up = |x: f64| x + x.abs() * f64::EPSILON;
    for (p, inside) in [
        (min, true),
        (max, true),
        (vec2(min.x, max.y), true),
        (vec2(max.x, 0.1), true),
        (vec2(up(max.x), 0.1), false),
        (vec2(0.5, up(max.y)), false),
        (vec2(0.5, -up(-min.y)), false),
        (vec2(f64::NAN, 0.1), false),
        (vec2(f64::INFINITY, 0.1), false),
    ] {
        let mut out = [Jet::constant(5.0); 2];
        assert_eq!(local.evaluate::<1>(p, Side::Above, &mut out), inside, "{p:?}");
        assert_eq!(mises.at(&mut local, p, Side::Above).is_nan(), !inside, "{p:?}");
        if !inside {
            assert_eq!(out, [Jet::constant(5.0); 2]);
        }
        local.evaluate_into::<1>(&[p], Side::Above, &mut out);
        assert_eq!(out[0].v.is_nan(), !inside, "{p:?}");
    }
    assert!(field.at(max).contains(Vec2::ZERO));
    assert!(!field.at(max).contains(vec2(1e-300, 0.0)), "the sum would round to the border");
}
