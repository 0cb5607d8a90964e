//! Quantities of fields that are known beyond lines of symmetry.

use std::f64::consts::{FRAC_PI_2, PI};

use ppum::dataset::{Dataset, NamedQuantity};
use ppum::equation::{Eigenstrain, Elasticity, Equation, StressState};
use ppum::expression::Expression;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::{Quantity, Reflection, Sample, Source, ValueChange, available};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// −1 of coordinates that are reflected.
fn axes(at: &Reflection) -> [f64; 2] {
    at.lines.map(|line| if line.is_some() { -1.0 } else { 1.0 })
}

/// An expression of the coordinates X and Y of the point Sx, times a sign.
fn expression(text: &str, at: &Reflection, sign: f64) -> Expression {
    let coordinate = |name: &str, line: Option<f64>| match line {
        Some(line) => format!("(2*({line:?}) - {name})"),
        None => name.to_owned(),
    };
    let [x, y] = at.lines;
    let text = text.replace('X', &coordinate("x", x)).replace('Y', &coordinate("y", y));
    Expression::parse(&format!("({sign:?})*({text})")).expect("an expression")
}

/// The equation of the reflected body: its constants and given strains at x are those at Sx.
fn elastic(has_strains: bool, is_heated: bool, at: &Reflection) -> Equation {
    let ([x, y], sign) = (axes(at), at.sign());
    let texts = [("0.01*X", 1.0), ("0.02*Y - 0.1", 1.0), ("0.03 + X*Y", x * y), ("X", 1.0)];
    let strains = texts.map(|(text, s)| expression(text, at, s * sign));
    let expansion = is_heated.then(|| expression("0.4 + 0.1*X", at, 1.0));
    Equation::Elasticity(Elasticity {
        young: expression("1.7 + 0.2*X", at, 1.0),
        poisson: expression("0.3 - 0.1*Y", at, 1.0),
        state: StressState::PlaneStrain,
        eigenstrain: has_strains.then(|| Box::new(Eigenstrain { strains, expansion })),
        anisotropy: None,
    })
}

fn dataset(equation: Equation, components: usize) -> Dataset {
    let mut dataset = Recipe { components, ..Recipe::random(3) }.dataset();
    dataset.equation = equation;
    if components == 3 {
        dataset.steps[0].fields[0].components =
            ["ux", "uy", "temperature"].map(String::from).into();
    }
    let named = |name: &str, text: &str| NamedQuantity {
        name: name.to_owned(),
        text: text.to_owned(),
        unit: String::new(),
    };
    let first = if components > 1 { "ux*x - duy_dx" } else { "u*x - du_dx" };
    dataset.quantities = vec![named("mine", first), named("both", "mine*y + 3*mine^2")];
    dataset
}

fn all_reflections(random: &mut Random) -> Vec<Reflection> {
    let (a, b) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    let lines = [[Some(a), None], [None, Some(b)], [Some(a), Some(b)], [None, Some(0.0)]];
    let both = |lines| [false, true].map(|is_odd| Reflection { lines, is_odd });
    lines.into_iter().flat_map(both).collect()
}

/// Values and slopes of the field at Sx as those of the reflected field at x, by its
/// definition.
fn continued(at: &Reflection, jets: &[Jet<f64>]) -> Vec<Jet<f64>> {
    let ([x, y], sign) = (axes(at), at.sign());
    let of = |(c, u): (usize, &Jet<f64>)| {
        let s = if jets.len() > 1 && c < 2 { sign * [x, y][c] } else { sign };
        Jet { v: s * u.v, x: s * x * u.x, y: s * y * u.y, ..Jet::constant(0.0) }
    };
    jets.iter().enumerate().map(of).collect()
}

fn value(text: &str, dataset: &Dataset, p: Vec2, jets: &[Jet<f64>]) -> f64 {
    let field = Field::new(dataset, 0).expect("a field");
    let quantity = Quantity::parse(text, &field).expect("a quantity");
    of(&quantity, dataset, p, jets)
}

fn of(quantity: &Quantity, dataset: &Dataset, anchor: Vec2, jets: &[Jet<f64>]) -> f64 {
    let (offset, moduli) = ([0.0; 2], dataset.equation.moduli(anchor, [0.0; 2]));
    quantity.of_field(&Sample { anchor, offset, moduli, jets, exact: &[] })
}

/// Every quantity of the field and many formulas, of random values and slopes, in a body whose
/// constants and given strains change from place to place: what is reflected is what the
/// reflected body has. A direction has no sense, so that angles may differ by π.
#[test]
fn quantities_are_those_of_the_reflected_body() {
    let mut random = Random(0x3b11_70c5_9e4d_2a86);
    let elastic_texts =
        ["von_mises + x*sxy*y", "s1 - 2*s2*x", "exx*x^2 + curl", "max(ux, y) # of x", "mine*x"];
    for (case, count) in [2, 2, 1, 3].into_iter().enumerate() {
        let equation = |at: &Reflection| match case {
            2 => Equation::poisson(2.5),
            _ => elastic(case > 0, case == 3, at),
        };
        let more: &[&str] = match case {
            0 => &elastic_texts,
            1 => &["eigenstrain_xy*x + sxy", "sxx - y*tresca + both", "elastic_xy*ux"],
            3 => &["temperature*x + sxx", "expansion*temperature - exx", "dtemperature_dx*uy"],
            _ => &["u*x + du_dy*y", "energy*x", "both - mine*y"],
        };
        let body = dataset(equation(&Reflection::NONE), count);
        let field = Field::new(&body, 0).expect("a field");
        let names = available(&field).into_iter().filter(|name| name != "phi:N");
        for name in names.chain(more.iter().map(|&text| text.to_owned())) {
            let quantity = Quantity::parse(&name, &field).expect("a quantity");
            if matches!(quantity.source(), Source::Partition | Source::Exact) {
                continue;
            }
            for at in all_reflections(&mut random) {
                let mut number = || random.between(-1.0, 1.0);
                let x = vec2(number(), number());
                let mut jet =
                    || Jet { v: number(), x: number(), y: number(), ..Jet::constant(0.0) };
                let jets: Vec<_> = (0..count).map(|_| jet()).collect();
                let found = quantity.reflected(&at, &field).expect("a quantity");
                let there = of(&found.quantity, &body, at.point(x), &jets);
                let value_here = found.change.apply(there);
                let reflected = dataset(equation(&at), count);
                let expected = value(&name, &reflected, x, &continued(&at, &jets));
                let mut apart = (value_here - expected).abs();
                if name == "direction" {
                    apart = apart.min((PI - apart).abs());
                    assert!(value_here > -FRAC_PI_2 && value_here <= FRAC_PI_2);
                }
                // some roundings of terms up to 100
                assert!(apart < 1e-12, "{name} {at:?}: {value_here}, not {expected}");
                let again = found.change.apply(value_here);
                assert!((again - there).abs() < 1e-15, "{again} is not {there}");
            }
        }
    }
}

/// Where there is no gradient there is none of the reflected field.
#[test]
fn singular_values_stay() {
    let turned = ValueChange::Turned { is_reversed: true, is_quarter: true };
    for change in [ValueChange::Same, ValueChange::Negated, turned] {
        assert_eq!(change.apply(f64::INFINITY), f64::INFINITY);
        assert!(change.apply(f64::NAN).is_nan());
    }
}
