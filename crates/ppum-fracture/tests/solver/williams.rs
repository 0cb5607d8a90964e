//! Williams' series at tips: which fields are in the space, and how fast errors fall.

use crate::studies::exact_fields::{SQUARE, TipProblem, discretization, held};
use crate::studies::plates::pulled;
use crate::studies::support::{Both, both, errors, solved};
use ppum::dataset::{Equation, Material, StressState, TipIntensity};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{
    BaseCells, Discretization, Enrichment, Expression, PolynomialOrder, ProblemData,
};
use ppum_solve::report::strip_timings;
use ppum_testkit::exact::{ExactField as _, Williams};
use ppum_testkit::random::Random;

/// Every patch has the terms of one tip beside linear polynomials.
fn everywhere(level: u32, terms: usize) -> Discretization {
    let mut set = discretization(BaseCells::Level(level), 1);
    (set.enrichment_radius, set.tip_terms) = (Some(10.0), Some(terms));
    set
}

fn random_tip(random: &mut Random) -> (TipProblem, Material) {
    let mut between = |a, b| random.between(a, b);
    let tip = vec2(between(-0.4, 0.4), between(-0.3, 0.3));
    let crack = TipProblem { domain: SQUARE, tip, angle: between(-0.6, 0.6) };
    let (young, poisson) = (between(0.5, 3.0), between(0.0, 0.45));
    let state =
        if between(0.0, 1.0) < 0.5 { StressState::PlaneStrain } else { StressState::PlaneStress };
    (crack, Material { young, poisson, state })
}

fn field(crack: &TipProblem, material: Material) -> Williams {
    Williams::new(material, crack.tip, vec2(crack.angle.cos(), crack.angle.sin()))
}

/// Asserts that each of the fields r^(n/2) is in the space as soon as there are enough terms,
/// whatever the crack's place and direction and the material, with two unknowns a term; with one
/// term less it is not.
fn assert_in_the_space(fields: &[(usize, u32)]) {
    let mut random = Random(16);
    for &(order, n) in fields {
        let (crack, material) = random_tip(&mut random);
        let amplitudes = [0, 1].map(|_| random.between(-1.0, 1.0));
        let exact = field(&crack, material).with_term(n, amplitudes[0], amplitudes[1]);
        let relative = |terms: usize| {
            let dataset = solved(&crack.problem_of(material, &exact, everywhere(2, terms)));
            errors(&dataset, &|p| both(exact.evaluate(p))).energy
        };
        let (enough, fewer) = (relative(order), relative(order.max(2) - 1));
        println!("r^({n}/2): {enough:.1e}, with one term less {fewer:.1e}");
        assert!(enough < 2e-7, "r^({n}/2): {enough:e}");
        assert!(order == 1 || fewer > 1e-3, "r^({n}/2): {fewer:e}");
    }
}

#[test]
fn the_terms_are_in_the_space() {
    assert_in_the_space(&[(1, 1), (3, 5)]);
}

#[test]
#[ignore = "slow: up to six terms"]
fn many_terms_are_in_the_space() {
    assert_in_the_space(&[(2, 3), (4, 7), (6, 11)]);
}

/// Where the material varies there is no series: the step is that of the first term alone, with
/// free components.
#[test]
fn a_varying_material_has_the_first_term() {
    let (crack, material) = random_tip(&mut Random(5));
    let exact = field(&crack, material).with_intensities(1.0, 0.3);
    let mut problem = crack.problem_of(material, &exact, discretization(BaseCells::Level(2), 2));
    let Equation::Elasticity(body) = &mut problem.equation else { panic!("elasticity") };
    body.young = Expression::parse("1 + x/9").expect("a formula");
    let step = |enrichment: Enrichment| {
        problem.discretization.enrichment = enrichment;
        let mut step = solved(&problem).steps.remove(0);
        strip_timings(&mut step);
        step
    };
    let [series, first] = [Enrichment::Williams, Enrichment::Zone].map(step);
    assert_eq!(series, first);
}

/// The plate whose K_I two independent methods give to twelve digits (references.md, section 2).
const K_OF_PLATE: f64 = 1.488_480_439_59;

/// Relative error of K_I of the plate and its unknowns.
fn plate([nx, ny]: [u32; 2], order: usize) -> (f64, usize) {
    let domain = Rect::new(vec2(-1.0, -2.0), vec2(1.0, 2.0));
    let mut problem = pulled(domain, [nx, ny], &[&[[-0.5, 0.0], [0.5, 0.0]]]);
    let set = &mut problem.discretization;
    (set.order, set.refine, set.enrichment_radius) =
        (PolynomialOrder::Uniform(order), false, Some(0.4));
    let dataset = solved(&problem);
    let step = &dataset.steps[0];
    let error = |tip: &TipIntensity| (tip.k1 / K_OF_PLATE - 1.0).abs();
    (step.intensities.iter().map(error).fold(0.0, f64::max), step.unknowns())
}

fn assert_digits(cells: [u32; 2], order: usize, most: usize, bound: f64) {
    let (error, unknowns) = plate(cells, order);
    println!("order {order}, {unknowns} unknowns: {error:.1e}");
    assert!(error < bound && unknowns < most, "{unknowns} unknowns: {error:e}");
}

/// Six digits, with few unknowns.
#[test]
fn digits_of_k() {
    assert_digits([5, 10], 6, 4_000, 1e-6);
}

#[test]
#[ignore = "slow: order 7 on 162 cells"]
fn nine_digits_of_k() {
    assert_digits([9, 18], 7, 25_000, 1e-9);
}

/// Asserts the rate of the energy norm's error between a level and the next, with the series in a
/// disc, of a field that has Williams' terms to the eighth.
fn assert_rate(order: usize, level: u32, least: f64) {
    let crack = TipProblem { domain: SQUARE, tip: vec2(0.03, 0.041), angle: 0.2 };
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let own = field(&crack, material).with_intensities(1.0, 0.5);
    let exact = (3..=8).fold(own, |field, n| field.with_term(n, 0.4, -0.3));
    let error = |level: u32| {
        let mut set = discretization(BaseCells::Level(level), order);
        set.enrichment_radius = Some(0.6);
        crack.errors(&exact, set).energy
    };
    // from coarse covers on also patches beyond the disc have the series: fewer of them as
    // cells shrink
    let [coarse, fine] = [error(level), error(level + 1)];
    let rate = (coarse / fine).log2();
    println!("order {order}: {coarse:.2e}, {fine:.2e}: rate {rate:.2}");
    assert!(rate > least, "order {order}: rate {rate}");
}

/// With the series the error of the energy norm falls with the order of the polynomials although
/// the field has all of Williams' terms: rates of √r functions alone end at 3/2.
#[test]
fn rates_are_those_of_the_polynomials() {
    assert_rate(2, 3, 1.9);
}

/// At order 4 what the stable basis cuts off, 1e-7, is seen from level 4 on.
#[test]
#[ignore = "slow: level 4 at the orders 3 and 4"]
fn rates_of_higher_orders() {
    assert_rate(3, 3, 2.8);
    assert_rate(4, 3, 3.4);
}

/// Value and gradient of r^λ sin λθ around the tip of the test below.
fn antisymmetric(power: f64, p: Vec2) -> Both {
    let d = p - vec2(0.03, 0.041);
    let (r, theta) = (d.length(), d.y.atan2(d.x));
    let [own, slope] = [power, power - 1.0].map(|power| (r.powf(power), power * theta));
    let gradient = vec2(slope.1.sin(), slope.1.cos()) * (power * slope.0);
    ([own.0 * own.1.sin(), 0.0], [gradient, Vec2::ZERO])
}

/// Of Poisson's equation a term is one function, r^(n − ½) sin (n − ½)θ.
#[test]
fn the_terms_of_laplace_are_in_the_space() {
    let distance = "hypot(x - 0.03, y - 0.041)";
    let angle = "atan2(y - 0.041, x - 0.03)";
    for (terms, power) in [(1, 0.5), (2, 1.5), (3, 2.5)] {
        let relative = |terms: usize| {
            let plate = ProblemData::poisson(SQUARE, 1.0, everywhere(2, terms));
            let exact = [format!("{distance}^{power}*sin({power}*{angle})")];
            let dataset = solved(&held(plate.with_crack(&[[-1.0, 0.041], [0.03, 0.041]]), exact));
            errors(&dataset, &|p| antisymmetric(power, p)).energy
        };
        let enough = relative(terms);
        assert!(enough < 1e-7, "r^{power}: {enough:e}");
        assert!(terms == 1 || relative(terms - 1) > 1e-4, "r^{power}");
    }
}
