//! Parts of a field add up to the whole, and each is what its name says.

use crate::support::{assert_close, compiled, entries, inside};
use ppum::crack::{CrackEnd, Side};
use ppum::dataset::Dataset;
use ppum::decompose::{FieldPart, KINDS, PartError};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe, crack};

/// The dataset with a part of its field in the field's place.
fn part(whole: &Dataset, part: FieldPart) -> Dataset {
    let mut dataset = whole.clone();
    let step = &mut dataset.steps[0];
    step.fields[0] = step.fields[0].part(part, &step.functions).expect("a part that there is");
    assert_eq!(dataset.check(), Ok(()));
    dataset
}

/// Random points of the domain, and points on the cracks.
fn points(dataset: &Dataset, count: usize) -> Vec<Vec2> {
    let mut random = Random(5);
    let cracks = dataset.steps[0].cracks.iter();
    let middles = cracks.map(|crack| crack.points[0] + (crack.points[1] - crack.points[0]) * 0.5);
    let anywhere = (0..count).map(|_| random.point(&dataset.domain.bounds));
    anywhere.chain(middles).collect()
}

/// Value, gradient and Hessian of all components at the points, on a side.
fn values(dataset: &Dataset, points: &[Vec2], side: Side) -> Vec<Jet<f64>> {
    let field = compiled(dataset);
    points.iter().flat_map(|&at| inside::<2>(&mut field.at(at), Vec2::ZERO, side)).collect()
}

/// The parts add up to the whole but for rounding, which is relative to the sum of their sizes.
#[track_caller]
fn assert_sum(whole: &Dataset, parts: &[FieldPart], count: usize) {
    let points = points(whole, count);
    for side in [Side::Above, Side::Below] {
        let expected = values(whole, &points, side);
        let mut sums = vec![(Jet::constant(0.0), [0.0; 6]); expected.len()];
        for &which in parts {
            for ((sum, size), value) in
                sums.iter_mut().zip(values(&part(whole, which), &points, side))
            {
                *sum = sum.plus::<2>(value);
                for (size, entry) in size.iter_mut().zip(entries(&value)) {
                    *size += entry.abs();
                }
            }
        }
        for ((sum, size), whole) in sums.iter().zip(&expected) {
            for ((sum, whole), size) in entries(sum).into_iter().zip(entries(whole)).zip(size) {
                // some hundred operations with the largest of many patches' polynomials
                assert!((sum - whole).abs() <= 1e-11 * size, "{sum} {whole}, parts of {size}");
            }
        }
    }
}

#[test]
fn kinds_add_up_to_the_whole() {
    for seed in 1..4 {
        assert_sum(&Recipe::random(seed).dataset(), &KINDS, 40);
    }
    let meeting = Recipe { coefficients: Coefficients::Random, ..Recipe::meeting() };
    assert_sum(&meeting.dataset(), &[FieldPart::Smooth, FieldPart::Jump, FieldPart::Tip], 40);
}

/// Functions of components are jumps: without them the rest is the same on both faces of an arm of
/// a star.
#[test]
fn components_are_jumps() {
    let recipe = Recipe::meeting();
    let dataset = recipe.dataset();
    let arm = &recipe.cracks[1].points;
    let (place, normal) = (arm[0] + (arm[1] - arm[0]) * 0.1, (arm[1] - arm[0]).unit().left());
    let apart = |which: FieldPart| {
        let part = part(&dataset, which);
        let [above, below] =
            [1e-9, -1e-9].map(|step| values(&part, &[place + normal * step], Side::Above));
        (above[0].v - below[0].v).abs()
    };
    assert!(apart(FieldPart::Smooth) < 1e-6 && apart(FieldPart::Jump) > 0.02);
}

#[test]
fn patches_add_up_to_the_whole() {
    let dataset = Recipe { level: 0, random_rounds: 1, points: 0, ..Recipe::random(2) }.dataset();
    let count = dataset.steps[0].partition.len() as u32;
    let patches: Vec<_> = (0..count).map(FieldPart::Patch).collect();
    assert_sum(&dataset, &patches, 10);
}

/// φ_i v_i vanishes outside the patch, and is the whole where the patch is alone, φ_i = 1.
#[test]
fn a_patch_ends_with_its_support() {
    let dataset = Recipe { overlap: 1.2, ..Recipe::default() }.dataset();
    let partition = dataset.steps[0].partition.boxes();
    for patch in [0, 17, partition.len() - 1] {
        let alone = part(&dataset, FieldPart::Patch(patch as u32));
        let center = [partition.center[patch]];
        assert_eq!(values(&alone, &center, Side::Above), values(&dataset, &center, Side::Above));
        let support = partition.support(patch);
        let outside: Vec<_> =
            points(&dataset, 50).into_iter().filter(|&p| !support.contains(p)).collect();
        let zero = values(&alone, &outside, Side::Above);
        assert!(zero.iter().all(|jet| entries(jet) == [0.0; 6]));
    }
}

/// With one crack the smooth part is the same on both sides, the jump part changes its sign, and
/// only the whole and the tip part have no gradient at a tip.
#[test]
fn only_the_jump_jumps() {
    // along an axis, so that there are points on it
    let cracks = vec![crack(&[[0.6, 0.1], [1.2, 0.1]], [CrackEnd::Tip; 2])];
    let dataset = Recipe { cracks, ..Recipe::default() }.dataset();
    let on = [vec2(0.9, 0.1)];
    let sides = |which| {
        let part = part(&dataset, which);
        [Side::Above, Side::Below].map(|side| values(&part, &on, side))
    };
    let [above, below] = sides(FieldPart::Smooth);
    assert_eq!(above, below);
    assert!(above[0].v != 0.0);
    let [above, below] = sides(FieldPart::Jump);
    for (above, below) in above.iter().zip(&below) {
        assert!(above.v != 0.0);
        assert_close(&above.plus::<2>(*below), &Jet::constant(0.0), 1e-14, above.v.abs(), 1e-2);
    }
    let tip = [vec2(0.6, 0.1)];
    let gradient = |dataset: &Dataset| values(dataset, &tip, Side::Above)[0].x;
    assert!(gradient(&part(&dataset, FieldPart::Smooth)).is_finite());
    assert!(
        !gradient(&part(&dataset, FieldPart::Tip)).is_finite() && !gradient(&dataset).is_finite()
    );
}

#[test]
fn what_there_is_not_is_told() {
    let dataset = Recipe { cracks: Vec::new(), extra: Vec::new(), ..Recipe::default() }.dataset();
    let step = &dataset.steps[0];
    let fail = |part| step.fields[0].part(part, &step.functions).unwrap_err();
    assert_eq!(
        fail(FieldPart::Jump).to_string(),
        "field `displacement` has no block of the part `jump`; the kinds that it has are smooth"
    );
    let count = step.partition.len();
    let patch = count as u32;
    assert_eq!(fail(FieldPart::Patch(patch)), PartError::NoPatch { patch, count });
}

#[test]
fn words() {
    for part in KINDS.into_iter().chain([FieldPart::Patch(0), FieldPart::Patch(u32::MAX)]) {
        assert_eq!(part.to_string().parse(), Ok(part));
    }
    for wrong in ["", "Jump", "patch", "patch:", "patch:-1", "patch:4294967296", "patch:x"] {
        let error = wrong.parse::<FieldPart>().unwrap_err().to_string();
        assert!(error.contains(wrong) && error.contains("patch:N"), "{error}");
    }
}
