//! von Mises' stress far below the resolution of f64 coordinates, against 31 digits.

use crate::support::compiled;
use ppum::crack::{CrackEnd, Side};
use ppum::dataset::{Dataset, Elasticity};
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::segment::polyline_distance;
use ppum::vec2::{Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::extended::{ExtendedField, point, von_mises};
use ppum_testkit::synthetic::{Recipe, crack};

/// Directions and radii around an anchor.
const DIRECTIONS: u32 = 40;

/// Largest relative error of von Mises' stress at offsets of 1e-13 to 1 from an anchor.
fn largest_error(dataset: &Dataset, anchor: Vec2) -> f64 {
    let (field, extended) = (compiled(dataset), ExtendedField::new(dataset, 0));
    let material = dataset.equation.elastic().and_then(Elasticity::uniform).expect("elasticity");
    let mut local = field.at(anchor);
    let (mut largest, mut count) = (0.0f64, 0);
    for (n, k) in (0..53).flat_map(|n| (0..DIRECTIONS).map(move |k| (n, k))) {
        let radius = 10f64.powf(-13.0 + 0.25 * f64::from(n));
        let angle = (f64::from(k) + 0.37) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
        let offset = vec2(angle.cos(), angle.sin()) * radius;
        if !local.contains(offset) || on_crack(&field, anchor, offset) {
            continue;
        }
        let found = Quantity::VonMises.at(&mut local, offset, Side::Above);
        let exact = von_mises(&material, &extended.evaluate(point(anchor, offset))).to_f64();
        largest = largest.max((found / exact - 1.0).abs());
        count += 1;
    }
    assert!(count > 1500, "{count} points");
    largest
}

/// True if rounding hides on which side of a crack the point is.
fn on_crack(field: &Field<'_>, anchor: Vec2, offset: Vec2) -> bool {
    let r = offset.length();
    r > 1e-6
        && field
            .step
            .cracks
            .iter()
            .any(|c| polyline_distance(&c.points, anchor + offset) < 1e-9 * r)
}

fn assert_exact(name: &str, dataset: &Dataset, anchor: Vec2) {
    let error = largest_error(dataset, anchor);
    println!("{name}: {error:.1e}");
    assert!(error <= 1e-12, "{name}: {error:.1e}");
}

#[test]
fn around_tips_off_the_origin() {
    for weight in WeightFunction::ALL {
        let recipe = Recipe { weight: weight.clone(), tip_degree: 1, ..Recipe::default() };
        let dataset = recipe.dataset();
        for tip in recipe.tips() {
            assert_exact(&format!("tip, {weight:?}"), &dataset, recipe.position(tip));
        }
    }
}

/// With the jump alone, and with the functions of both tips as well.
#[test]
fn in_the_middle_of_an_oblique_crack() {
    let cracks = vec![crack(&[[0.5713, 0.0931], [1.1831, 0.3973]], [CrackEnd::Tip; 2])];
    let middle = (cracks[0].points[0] + cracks[0].points[1]) * 0.5;
    for zone in [0.1, 0.5] {
        let recipe = Recipe { zone, cracks: cracks.clone(), ..Recipe::default() };
        assert_exact("middle of an oblique crack", &recipe.dataset(), middle);
        let beside = middle + vec2(3e-10, -1e-10);
        assert_exact("beside an oblique crack", &recipe.dataset(), beside);
    }
}

/// A blunt and a sharp kink, with the jump alone, and where the angle of both tips changes branch.
#[test]
fn around_kinks() {
    let blunt = [[0.5713, 0.0931], [0.8642, 0.2817], [1.1831, 0.1973]];
    let sharp = [[0.7713, 0.4931], [0.8642, 0.0817], [1.0831, 0.4973]];
    for (points, zone) in [(blunt, 0.1), (blunt, 0.5), (sharp, 0.1), (sharp, 0.6)] {
        let cracks = vec![crack(&points, [CrackEnd::Tip; 2])];
        let recipe = Recipe { zone, cracks, ..Recipe::default() };
        assert_exact("kink", &recipe.dataset(), points[1].into());
    }
}

/// Where cracks meet, and beside: every sector has its own field.
#[test]
fn around_junctions() {
    let recipe = Recipe::meeting();
    let dataset = recipe.dataset();
    for place in &recipe.junctions {
        assert_exact("junction", &dataset, place.center);
        assert_exact("beside a junction", &dataset, place.center + vec2(-2e-10, 3e-10));
    }
}

/// Rounding errors of ∇u = Σ ∇φ_i v_i + … are of the size 10⁻¹⁶ |u| / h: they grow as
/// patches shrink.
#[test]
fn on_a_fine_cover() {
    let cracks = vec![crack(&[[0.5713, 0.0931], [1.1831, 0.3973]], [CrackEnd::Tip; 2])];
    let (tip, middle) = (cracks[0].points[0], (cracks[0].points[0] + cracks[0].points[1]) * 0.5);
    let dataset =
        Recipe { zone: 0.1, level: 4, tip_level: 8, cracks, ..Recipe::default() }.dataset();
    assert!(dataset.steps[0].partition.len() > 3000);
    assert_exact("middle, fine cover", &dataset, middle);
    assert_exact("tip, fine cover", &dataset, tip);
}
