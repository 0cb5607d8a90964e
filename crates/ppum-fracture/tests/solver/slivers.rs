//! Cracks that cut slivers off patches, and what the numbers of the dataset are worth then.

use ppum::crack::Side;
use ppum::dataset::{Dataset, WarningKind};
use ppum::field::Field;
use ppum::function::FunctionKind;
use ppum::jet::Jet;
use ppum::library::WEIGHTS;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_fracture::diagnostics::{FEW_DIGITS, recompute, rounding};
use ppum_problem::{BaseCells, ProblemData};
use ppum_testkit::extended::{ExtendedField, point};
use ppum_testkit::random::Random;

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization};
use crate::studies::support::solved;
use crate::support::pulled;

/// Cells along an edge of [−1, 1]², and the half-size of a patch.
const CELLS: u32 = 8;
const HALF: f64 = 1.3 / CELLS as f64;

/// Centre of the patch whose corner is cut off, in cells.
const CUT: [f64; 2] = [3.5, 3.5];

fn centre() -> Vec2 {
    vec2(-1.0, -1.0) + vec2(CUT[0], CUT[1]) * (2.0 / f64::from(CELLS))
}

/// A plate under tension with a crack.
fn cracked(weight: &str, order: usize, crack: &[[f64; 2]]) -> ProblemData {
    let mut set = discretization(BaseCells::Grid([CELLS; 2]), order);
    set.weight = WeightFunction::from_library(weight).expect("of the library");
    pulled(ProblemData::elasticity(SQUARE, MATERIAL, set).with_crack(crack))
}

/// One whose crack leaves `part` of the patch beyond it, in its upper right corner.
fn plate(weight: &str, order: usize, part: f64, angle: f64) -> ProblemData {
    let normal = vec2(angle.cos(), angle.sin());
    let distance = (8.0 * part * normal.x * normal.y).sqrt() * HALF;
    let at = centre() + vec2(HALF, HALF) - normal * distance;
    let [a, b] = [-0.47, 0.41].map(|s| at + normal.left() * s);
    cracked(weight, order, &[a.into(), b.into()])
}

/// Largest relative difference of ∇u as evaluated and in extended precision, around the patch.
fn measured(dataset: &Dataset, random: &mut Random) -> f64 {
    let field = Field::new(dataset, 0).expect("a field");
    let extended = ExtendedField::new(dataset, 0);
    let mut error = || {
        let at = [(); 2].map(|()| random.between(-1.2, 1.2) * HALF);
        let p = centre() + Vec2::from(at);
        let mut u = [Jet::constant(0.0); 2];
        assert!(field.at(p).evaluate::<1>(Vec2::ZERO, Side::Above, &mut u));
        let exact = extended.evaluate(point(p, Vec2::ZERO));
        let found = u.iter().flat_map(|u| [u.x, u.y]);
        let exact = exact.iter().flat_map(|u| [u.x, u.y]).map(|v| v.to_f64());
        let pairs: Vec<_> = found.zip(exact).collect();
        let largest = |of: &dyn Fn(f64, f64) -> f64| {
            pairs.iter().map(|&(a, b)| of(a, b).abs()).fold(0.0, f64::max)
        };
        largest(&|a, b| a - b) / largest(&|_, b| b)
    };
    (0..150).map(|_| error()).fold(0.0, f64::max)
}

/// Asserts that stresses of the file are right to 1e-12 of their local size, wherever the crack is;
/// they were to 1e-6 … 3 with smooth weights while sliver functions had coefficients up to 1e20.
/// What is reported is of that size.
fn assert_twelve_digits<'a>(cases: impl Iterator<Item = (&'a str, usize)>) {
    let mut random = Random(11);
    for (weight, order) in cases {
        let part = 10.0_f64.powf(random.between(-8.0, -1.0));
        let angle = random.between(0.3, 1.27);
        let dataset = solved(&plate(weight, order, part, angle));
        let error = measured(&dataset, &mut random);
        let reported =
            rounding(&Field::new(&dataset, 0).expect("a field")).expect("a field").largest;
        println!("{weight} {order} {part:.0e}: {error:.1e}, reported {reported:.1e}");
        assert!(error < 1e-12, "{weight} {order} {part:e}: {error:e}");
        assert!(error < 10.0 * reported.max(1e-13), "{error:e}, reported {reported:e}");
    }
}

/// Parts of stresses are of the size of the field wherever a crack is, straight or bent: single
/// precision has three digits of them.
#[test]
fn parts_are_of_the_size_of_the_field() {
    let mut random = Random(13);
    for (k, weight) in WEIGHTS.iter().map(|entry| entry.name).enumerate() {
        let (order, mut angle) = (2 + k % 2, random.between(-0.5, 0.5));
        let mut points = vec![vec2(-0.4, random.between(-0.4, 0.4))];
        for _ in 0..=k % 3 {
            points.push(points[points.len() - 1] + vec2(angle.cos(), angle.sin()) * 0.3);
            angle += random.between(-0.9, 0.9);
        }
        let points: Vec<[f64; 2]> = points.into_iter().map(Into::into).collect();
        let dataset = solved(&cracked(weight, order, &points));
        let double = rounding(&Field::new(&dataset, 0).expect("a field")).expect("a field").largest;
        let single = double * f64::from(f32::EPSILON) / f64::EPSILON;
        println!("{weight} {order}, {} segments: {single:.1e}", points.len() - 1);
        assert!(single < 1e-3, "{weight} {order} {points:?}: {single:e}");
    }
}

#[test]
fn coefficients_bear_twelve_digits_wherever_a_crack_is() {
    assert_twelve_digits(WEIGHTS.iter().enumerate().map(|(k, entry)| (entry.name, 1 + k % 3)));
}

#[test]
#[ignore = "slow: order 4"]
fn coefficients_of_order_four_bear_twelve_digits() {
    assert_twelve_digits([("cubic", 4), ("bump", 4)].into_iter());
}

/// Asserts that K of a crack does not depend on how little of a patch it leaves: it is that of
/// larger patches, where the crack leaves more, up to the error of the discretisation, 1e-3.
fn assert_slivers_do_not_change_k(cases: [(&str, f64); 2]) {
    let mut random = Random(12);
    for (weight, part) in cases {
        let problem = plate(weight, 2, part, random.between(0.3, 1.27));
        let mut other = problem.clone();
        other.discretization.overlap = 1.5;
        let [a, b] = [problem, other].map(|p| solved(&p).steps.remove(0).intensities);
        for (a, b) in a.iter().zip(&b) {
            let change = (a.k1 - b.k1).hypot(a.k2 - b.k2) / b.k1.hypot(b.k2);
            println!("{weight} {part:e}: K changes by {change:.1e}");
            assert!(change < 2e-3, "{weight} {part:e}: {change}");
        }
    }
}

#[test]
fn slivers_of_smooth_weights_do_not_change_k() {
    assert_slivers_do_not_change_k([("cubic", 1e-4), ("bump", 1e-7)]);
}

#[test]
#[ignore = "slow: four more solutions"]
fn slivers_of_other_smooth_weights_do_not_change_k() {
    assert_slivers_do_not_change_k([("quadratic", 1e-7), ("wendland", 1e-4)]);
}

/// A ξ (1 − side) is nothing on the large part of the patch, but takes log10(A) digits there.
#[test]
fn coefficients_that_cancel_are_reported_with_their_place() {
    let mut dataset = solved(&plate("linear", 2, 1e-4, 0.7));
    let before = rounding(&Field::new(&dataset, 0).expect("a field")).expect("a field").largest;
    assert!(before < 1e-10, "{before}");
    let step = &mut dataset.steps[0];
    let patch = step.partition.boxes().center.iter().position(|c| (*c - centre()).length() < 1e-9);
    let patch = patch.expect("the patch");
    let data = &mut step.fields[0];
    let is_sliver = |&b: &usize| {
        let function = &step.functions[data.block_function[b] as usize];
        matches!(function.kind, FunctionKind::Component { .. })
    };
    let jump = data.blocks(patch).find(is_sliver).expect("a jump");
    // the side of the crack, the first after the function 1, in place of the sliver's indicator: as
    // older files have it; what is on the sliver alone goes
    data.block_function[jump] = 1;
    let [smooth, jump] = [data.blocks(patch).start, jump].map(|b| data.block_offset[b] as usize);
    data.coefficients.iter_mut().for_each(|row| row[jump..jump + 6].fill(0.0));
    // the large part is on the left of the crack, where the side is 1
    for (block, amplitude) in [(smooth, 1e9), (jump, -1e9)] {
        data.coefficients[0][block + 1] += amplitude;
    }
    let (_, warnings) = recompute(&dataset, 0, None, unwatched()).expect("a step");
    let digits: Vec<_> = warnings.iter().filter(|w| w.kind == WarningKind::Digits).collect();
    assert_eq!(digits.len(), 1, "{warnings:?}");
    let at = digits[0].at.expect("a place");
    println!("{}", digits[0].message);
    assert!(
        (at - centre()).length() < 2.0 * HALF && digits[0].value > FEW_DIGITS,
        "{:?}",
        digits[0]
    );
    let error = measured(&dataset, &mut Random(3));
    assert!(digits[0].value < 100.0 * error && error < 100.0 * digits[0].value, "{error}");
}
