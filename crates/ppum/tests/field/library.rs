//! The library's formulas and the kernels that stand in for them are the same functions.

use ppum::equation::{Elasticity, Equation, Material, Moduli, StressState};
use ppum::expression::Expression;
use ppum::formula::{Formula, Scope};
use ppum::jet::Jet;
use ppum::library::{
    Definition, EIGENSTRAIN, ELASTICITY, HEAT, PLANE_STRAIN, PLANE_STRESS, POISSON, WEIGHTS,
};
use ppum::quantity::{Quantity, QuantityFormula, Sample, Vocabulary, names};
use ppum::vec2::Vec2;
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;

/// Random places, the ends, the knots, and their neighbours.
fn places() -> Vec<f64> {
    let mut random = Random(3);
    let mut all: Vec<_> = (0..400).map(|_| random.between(-1.2, 1.2)).collect();
    for knot in [0.0f64, 1.0 / 3.0, 0.5, 1.0] {
        for t in [knot, knot.next_up(), knot.next_down(), knot + 1e-9, knot - 1e-9, 1e-300] {
            all.extend([t, -t]);
        }
    }
    all
}

#[test]
fn splines_and_their_formulas() {
    let scope = Scope::new(&["t"]).expect("a name");
    for (kernel, entry) in WeightFunction::ALL.iter().zip(&WEIGHTS) {
        assert_eq!(kernel.name(), entry.name);
        let formula = WeightFunction::formula(entry.texts[0], &scope).expect("a weight");
        assert_eq!(kernel.breakpoints(), formula.breakpoints(), "{}", entry.name);
        for xi in places() {
            // on a knot the two may take the derivative of either side
            let knot =
                kernel.breakpoints().iter().any(|&t| t > 0.0 && (xi.abs() - t).abs() < 1e-15);
            let (a, b) = (kernel.spline(xi), formula.spline(xi));
            let orders = if knot { 2 } else { 3 };
            for k in 0..orders {
                let near = (a[k] - b[k]).abs() <= 1e-14 * (1.0 + a[k].abs());
                assert!(near, "{} at {xi:e}: {a:?} {b:?}", entry.name);
            }
        }
    }
}

/// Gradients of every size and kind: random, uniaxial, hydrostatic, zero, huge, tiny.
fn gradients() -> Vec<[Jet<f64>; 2]> {
    let mut random = Random(5);
    let mut all = Vec::new();
    for scale in [1.0, 1e-100, 1e100] {
        for k in 0..200 {
            let mut number = || scale * random.between(-1.0, 1.0);
            let mut jet = || Jet { v: number(), x: number(), y: number(), ..Jet::constant(0.0) };
            let mut u = [jet(), jet()];
            match k % 5 {
                1 => (u[0].y, u[1].x, u[1].y) = (0.0, 0.0, 0.0),
                2 => (u[0].y, u[1].x, u[1].y) = (0.0, 0.0, u[0].x),
                3 => (u[0].x, u[1].y) = (0.0, 0.0),
                _ => {}
            }
            all.push(u);
        }
    }
    all.push([Jet::constant(1.0), Jet::constant(-1.0)]);
    all
}

/// `given` is the size of given strains.
fn compare(equation: &Equation, components: &[&str], definitions: &[Definition], given: f64) {
    let components: Vec<_> = components.iter().map(|&c| c.to_owned()).collect();
    let vocabulary = Vocabulary { equation, components: &components, tables: &[], named: &[] };
    let known = names(equation, &components);
    for (name, _) in definitions {
        let formula = QuantityFormula::new(name, &vocabulary).expect("a quantity of the library");
        let formula = Quantity::Formula(formula.into());
        let native = known.iter().find(|(known, _)| known.replace('-', "_") == *name);
        let (_, native) = native.expect("a kernel stands in for every formula");
        for jets in gradients() {
            let temperature = Jet { x: 0.5, y: -2.0, ..Jet::constant(0.75) };
            let jets = &[jets[0], jets[1], temperature][..components.len()];
            let (anchor, offset) = (Vec2::ZERO, [0.25, -0.5]);
            let moduli = equation.moduli(anchor, offset);
            let at = Sample { anchor, offset, moduli, jets, exact: &[] };
            let (a, b) = (native.of_field(&at), formula.of_field(&at));
            // differences of stresses cancel to rounding of the largest
            let size = jets.iter().flat_map(|j| [j.v, j.x, j.y]).fold(given, |a, b| b.abs().max(a));
            let size = if *name == "energy" { size * size } else { size };
            let size = if *name == "direction" { 1e3 } else { size };
            assert!((a - b).abs() <= 2e-14 * size, "{name} of {jets:?}: {a:e} {b:e}");
        }
    }
}

/// λ, μ and σ_zz / (σ_xx + σ_yy) as formulas of E and ν.
#[test]
fn moduli_and_their_formulas() {
    for (state, definitions) in
        [(StressState::PlaneStrain, PLANE_STRAIN), (StressState::PlaneStress, PLANE_STRESS)]
    {
        for (young, poisson) in [(2.0, 0.3), (7e10, -0.7), (1.0, 0.49), (3.0, 0.0)] {
            let scope = Scope::new(&["young", "poisson"]).expect("names");
            let moduli = Moduli::new(young, poisson, state);
            for ((name, text), expected) in
                definitions.iter().zip([moduli.mu, moduli.lambda, moduli.out_of_plane])
            {
                let formula = Formula::parse(text, &scope).expect("a formula");
                let found = formula.evaluate(&[young, poisson]);
                assert!((found - expected).abs() <= 1e-15 * expected.abs(), "{name} {state:?}");
            }
        }
    }
}

fn expression(text: &str) -> Expression {
    text.parse().expect("a formula")
}

#[test]
fn quantities_and_their_formulas() {
    for state in [StressState::PlaneStrain, StressState::PlaneStress] {
        let material = Material { young: 2.0, poisson: 0.3, state };
        compare(&Equation::elasticity(material), &["ux", "uy"], &ELASTICITY, 0.0);
        let strains = ["0.3 + x", "-0.2", "y/4", "0.1*x"].map(expression);
        let eigenstrain = Some(Box::new(strains.into()));
        let mut body = Elasticity { eigenstrain, ..material.into() };
        compare(&Equation::Elasticity(body.clone()), &["ux", "uy"], &EIGENSTRAIN[3..], 1.0);
        if let Some(given) = &mut body.eigenstrain {
            given.expansion = Some(expression("0.5 - y"));
        }
        let heated = Equation::Elasticity(body);
        compare(&heated, heated.component_names(), &EIGENSTRAIN[3..], 1.0);
    }
    // those of heat are formulas alone
    compare(&Equation::poisson(1.5), &["u"], &POISSON[..POISSON.len() - HEAT], 0.0);
}

/// No kernel of elasticity or Poisson without a formula: what is left has no gradient in it.
#[test]
fn every_kernel_has_a_formula() {
    let material = Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStrain };
    let components = ["ux".to_owned(), "uy".to_owned()];
    for (name, _) in names(&Equation::elasticity(material), &components) {
        let word = name.replace('-', "_");
        let is_input = word.contains("ux") || word.contains("uy");
        let is_special = ["error", "weight_sum", "overlap"].contains(&word.as_str());
        let is_defined = ELASTICITY.iter().any(|(known, _)| *known == word);
        assert!(is_input || is_special || is_defined, "{name}");
    }
}
