//! Plates that hardly change their volume.

use ppum::crack::Side;
use ppum::dataset::{Dataset, Material, StressState, WarningKind};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{BaseCells, PolynomialOrder, ProblemData};
use ppum_testkit::random::Random;

use crate::studies::exact_fields::{SQUARE, discretization, expressions, held};
use crate::studies::support::{Errors, errors, parsed, solved};

/// The plate of `examples/centre-crack-tension.toml`.
fn cracked(material: &str, discretization: &str) -> ProblemData {
    let text = format!(
        "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 1\n{material}\n[[crack]]\n\
         points = [[-0.5, 0.0], [0.5, 0.0]]\n[[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n\
         [[boundary]]\non = \"top\"\ntraction = [0, 1]\n[discretization]\n{discretization}\n"
    );
    parsed(&text)
}

fn strain(poisson: &str) -> String {
    format!("poisson = {poisson}\nstate = \"plane-strain\"")
}

#[test]
fn the_order_follows_the_material_where_none_is_given() {
    let order = |material: &str, order: &str| {
        cracked(material, &format!("level = 3\n{order}")).discretization.order
    };
    assert_eq!(order(&strain("0.3"), ""), PolynomialOrder::Uniform(2));
    assert_eq!(order(&strain("0.47"), ""), PolynomialOrder::Uniform(2));
    assert_eq!(order(&strain("0.48"), ""), PolynomialOrder::Uniform(4));
    assert_eq!(order(&strain("\"if(x > 0.9, 0.499, 0.3)\""), ""), PolynomialOrder::Uniform(4));
    assert_eq!(order(&strain("0.499"), "order = 1"), PolynomialOrder::Uniform(1));
    assert_eq!(order("poisson = 0.5\nstate = \"plane-stress\"", ""), PolynomialOrder::Uniform(2));
}

/// K_I of both tips is 1.67156 for any ν (hpfem of order 10, ν = 0.499 and 0.4999: 1.671560 and the
/// same to 1e-7); with order 2 it was off by 2e-3 … 1e-2.
#[test]
fn k_is_right_by_default() {
    let dataset = solved(&cracked(&strain("0.4999"), "level = 2"));
    for tip in &dataset.steps[0].intensities {
        let error = (tip.k1 / K - 1.0).hypot(tip.k2 / K);
        println!("K off by {error:.1e}");
        assert!(error < 2e-4, "{error}");
    }
    // stresses are off by a per cent there
    let kinds: Vec<_> = dataset.steps[0].warnings.iter().map(|warning| &warning.kind).collect();
    assert_eq!(kinds, [&WarningKind::Pressure]);
}

/// K_I of the centre crack.
const K: f64 = 1.671_560_3;

fn locking(dataset: &Dataset) -> f64 {
    let found = dataset.steps[0].warnings.iter().find(|w| w.kind == WarningKind::Locking);
    found.map_or(0.0, |warning| warning.value)
}

/// The error of the energy that is warned of is right within a factor of three: energies of hpfem,
/// order 10, right to 1e-6.
#[test]
fn an_order_that_locks_is_warned_of_with_a_number() {
    for (poisson, exact) in ENERGIES {
        let dataset = solved(&cracked(&strain(poisson), "level = 3\norder = 1"));
        let energy = dataset.steps[0].history.iter().find(|r| r.name == "energy").expect("it");
        let (error, warned) = (1.0 - energy.value / exact, locking(&dataset));
        println!("ν = {poisson}: energy off by {error:.3}, warned of {warned:.3}");
        assert!(warned > error / 3.0 && warned < 3.0 * error, "ν = {poisson}: {error}, {warned}");
    }
    assert_eq!(locking(&solved(&cracked(&strain("0.3"), "level = 2\norder = 1"))), 0.0);
}

/// A smooth pressure is no locking, however much of the energy it stores.
#[test]
fn all_round_pressure_is_not_warned_of() {
    let text = "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 1\npoisson = 0.4999\n\
                state = \"plane-strain\"\n[discretization]\nlevel = 2\norder = 1\n"
        .to_owned();
    let side = |on: &str| format!("[[boundary]]\non = \"{on}\"\npressure = 1\n");
    let text = ["left", "right", "bottom", "top"].map(side).concat() + &text;
    let problem = parsed(&text);
    let dataset = solved(&problem);
    assert!(dataset.steps[0].warnings.is_empty(), "{:?}", dataset.steps[0].warnings);
}

/// A plate whose displacement is u = (∂ψ/∂y, −∂ψ/∂x) + (x², 0)/λ, ψ = sin(2x + 0.3) cos(1.5y),
/// given on the border; λ div u is 2x.
fn manufactured(poisson: f64, level: u32, order: usize) -> (Material, Dataset) {
    let material = Material { young: 1.0, poisson, state: StressState::PlaneStrain };
    let (lambda, mu) = (material.lambda(), material.mu());
    let [u, v] = ["-1.5*sin(2*x + 0.3)*sin(1.5*y)", "-2*cos(2*x + 0.3)*cos(1.5*y)"];
    let set = discretization(BaseCells::Level(level), order);
    let exact = [format!("{u} + x^2/{lambda:?}"), v.to_owned()];
    let mut problem = held(ProblemData::elasticity(SQUARE, material, set), exact);
    let (force, push) = (6.25 * mu, 2.0 * (lambda + 2.0 * mu) / lambda);
    problem.source =
        expressions([format!("{force:?}*({u}) - {push:?}"), format!("{force:?}*({v})")]);
    (material, solved(&problem))
}

fn manufactured_errors(level: u32, order: usize) -> Errors {
    let (material, dataset) = manufactured(0.4999, level, order);
    let lambda = material.lambda();
    errors(&dataset, &|p: Vec2| {
        let (a, b) = (2.0 * p.x + 0.3, 1.5 * p.y);
        let u = -1.5 * a.sin() * b.sin() + p.x * p.x / lambda;
        let v = -2.0 * a.cos() * b.cos();
        let du = vec2(-3.0 * a.cos() * b.sin() + 2.0 * p.x / lambda, -2.25 * a.sin() * b.cos());
        let dv = vec2(4.0 * a.sin() * b.cos(), 3.0 * a.cos() * b.sin());
        ([u, v], [du, dv])
    })
}

/// Order 4 keeps its rate at ν = 0.4999, where the energy of the error of order 1 is a multiple of
/// that of the field.
#[test]
fn the_default_order_keeps_its_rate() {
    let found = [1, 2, 3].map(|level| manufactured_errors(level, 4).energy);
    let rates = found.windows(2).map(|e| (e[0] / e[1]).log2());
    println!("errors {found:?}, rates {:.2?}", rates.clone().collect::<Vec<_>>());
    assert!(rates.min_by(f64::total_cmp) > Some(3.8) && found[2] < 1e-3);
    assert!(manufactured_errors(3, 1).energy > 1.0);
}

/// The error of the stresses that is warned of is right within a factor of two, whatever ν and
/// order are, and what is not warned of is small.
#[test]
fn pressure_that_oscillates_is_warned_of_with_a_number() {
    let mut told = 0;
    for (poisson, orders) in [(0.48, 2..=4), (0.499, 2..=5), (0.4999, 3..=6)] {
        for order in orders {
            let (material, dataset) = manufactured(poisson, 3, order);
            let error = error_of_pressure(&dataset, &material);
            let found = dataset.steps[0].warnings.iter().find(|w| w.kind == WarningKind::Pressure);
            println!(
                "ν = {poisson}, order {order}: {error:.2e}, warned of {:?}",
                found.map(|w| w.value)
            );
            told += usize::from(found.is_some());
            match found {
                Some(warning) => {
                    assert!(warning.value > error / 2.0 && warning.value < 2.0 * error)
                }
                None => assert!(error < 4e-3, "{error}"),
            }
        }
    }
    assert!((4..=10).contains(&told), "{told} of 11 are warned of");
}

/// The root mean square of the error of λ div u at random points of the inner plate, in parts of
/// that of the stresses.
fn error_of_pressure(dataset: &Dataset, material: &Material) -> f64 {
    let (field, mut random) = (Field::new(dataset, 0).expect("a field"), Random(7));
    let (lambda, mu) = (material.lambda(), material.mu());
    let mut at_random = || {
        let p = random.point(&SQUARE) * 0.75;
        let mut u = [Jet::constant(0.0); 2];
        assert!(field.at(p).evaluate::<1>(Vec2::ZERO, Side::Above, &mut u));
        let pressure = lambda * (u[0].x + u[1].y);
        let [xx, yy, xy] =
            [pressure + 2.0 * mu * u[0].x, pressure + 2.0 * mu * u[1].y, mu * (u[0].y + u[1].x)];
        ((pressure - 2.0 * p.x).powi(2), xx * xx + yy * yy + 2.0 * xy * xy)
    };
    let (errors, squares): (Vec<f64>, Vec<f64>) = (0..2000).map(|_| at_random()).unzip();
    (errors.iter().sum::<f64>() / squares.iter().sum::<f64>()).sqrt()
}

/// Energies of the cracked plate.
const ENERGIES: [(&str, f64); 3] =
    [("0.49", 2.3406798), ("0.499", 2.3132625), ("0.4999", 2.3104932)];
