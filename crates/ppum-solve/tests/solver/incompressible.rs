//! Plates that hardly change their volume.

use std::path::Path;

use ppum::dataset::{Dataset, Material, StressState};
use ppum::vec2::{Vec2, vec2};
use ppum_solve::diagnostics::kind;
use ppum_solve::problem::{Cells, Order, Problem};

use crate::studies::exact_fields::{SQUARE, discretization, expressions, held};
use crate::studies::support::{Errors, errors, solved};

/// The plate of `examples/centre-crack-tension.toml`.
fn cracked(material: &str, discretization: &str) -> Problem {
    let text = format!(
        "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 1\n{material}\n[[crack]]\n\
         points = [[-0.5, 0.0], [0.5, 0.0]]\n[[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n\
         [[boundary]]\non = \"top\"\ntraction = [0, 1]\n[discretization]\n{discretization}\n"
    );
    Problem::parse(&text, "plate.toml", Path::new("")).expect("a problem")
}

fn strain(poisson: &str) -> String {
    format!("poisson = {poisson}\nstate = \"plane-strain\"")
}

#[test]
fn the_order_follows_the_material_where_none_is_given() {
    let order = |material: &str, order: &str| {
        cracked(material, &format!("level = 3\n{order}")).discretization.order
    };
    assert_eq!(order(&strain("0.3"), ""), Order::Uniform(2));
    assert_eq!(order(&strain("0.47"), ""), Order::Uniform(2));
    assert_eq!(order(&strain("0.48"), ""), Order::Uniform(4));
    assert_eq!(order(&strain("\"if(x > 0.9, 0.499, 0.3)\""), ""), Order::Uniform(4));
    assert_eq!(order(&strain("0.499"), "order = 1"), Order::Uniform(1));
    assert_eq!(order("poisson = 0.5\nstate = \"plane-stress\"", ""), Order::Uniform(2));
}

/// K_I of both tips is 1.67156 for any ν (hpfem of order 10, ν = 0.499 and 0.4999: 1.671560 and the same to 1e-7); with
/// order 2 it was off by 2e-3 … 1e-2.
#[test]
fn k_is_right_by_default() {
    let dataset = solved(&cracked(&strain("0.4999"), "level = 2"));
    for tip in &dataset.steps[0].intensities {
        let error = (tip.k1 / K - 1.0).hypot(tip.k2 / K);
        println!("K off by {error:.1e}");
        assert!(error < 2e-4, "{error}");
    }
    assert!(dataset.steps[0].warnings.is_empty(), "{:?}", dataset.steps[0].warnings);
}

/// K_I of the centre crack.
const K: f64 = 1.671_560_3;

fn locking(dataset: &Dataset) -> f64 {
    let found = dataset.steps[0].warnings.iter().find(|w| w.kind == kind::LOCKING);
    found.map_or(0.0, |warning| warning.value)
}

/// The error of the energy that is warned of is right within a factor of three: energies of hpfem, order 10,
/// right to 1e-6.
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
    let problem = Problem::parse(&text, "plate.toml", Path::new("")).expect("a problem");
    let dataset = solved(&problem);
    assert!(dataset.steps[0].warnings.is_empty(), "{:?}", dataset.steps[0].warnings);
}

/// Error of u = (∂ψ/∂y, −∂ψ/∂x) + (x², 0)/λ, ψ = sin(2x + 0.3) cos(1.5y), given on the border.
fn manufactured(level: u32, order: usize) -> Errors {
    let material = Material { young: 1.0, poisson: 0.4999, state: StressState::PlaneStrain };
    let (lambda, mu) = (material.lambda(), material.mu());
    let [u, v] = ["-1.5*sin(2*x + 0.3)*sin(1.5*y)", "-2*cos(2*x + 0.3)*cos(1.5*y)"];
    let set = discretization(Cells::Level(level), order);
    let exact = [format!("{u} + x^2/{lambda:?}"), v.to_owned()];
    let mut problem = held(Problem::elasticity(SQUARE, material, set), exact);
    let (force, push) = (6.25 * mu, 2.0 * (lambda + 2.0 * mu) / lambda);
    problem.source =
        expressions([format!("{force:?}*({u}) - {push:?}"), format!("{force:?}*({v})")]);
    errors(&solved(&problem), &|p: Vec2| {
        let (a, b) = (2.0 * p.x + 0.3, 1.5 * p.y);
        let u = -1.5 * a.sin() * b.sin() + p.x * p.x / lambda;
        let v = -2.0 * a.cos() * b.cos();
        let du = vec2(-3.0 * a.cos() * b.sin() + 2.0 * p.x / lambda, -2.25 * a.sin() * b.cos());
        let dv = vec2(4.0 * a.sin() * b.cos(), 3.0 * a.cos() * b.sin());
        ([u, v], [du, dv])
    })
}

/// Order 4 keeps its rate at ν = 0.4999, where the energy of the error of order 1 is a multiple of that of the field.
#[test]
fn the_default_order_keeps_its_rate() {
    let found = [1, 2, 3].map(|level| manufactured(level, 4).energy);
    let rates = found.windows(2).map(|e| (e[0] / e[1]).log2());
    println!("errors {found:?}, rates {:.2?}", rates.clone().collect::<Vec<_>>());
    assert!(rates.min_by(f64::total_cmp) > Some(3.8) && found[2] < 1e-3);
    assert!(manufactured(3, 1).energy > 1.0);
}

/// Energies of the cracked plate.
const ENERGIES: [(&str, f64); 3] =
    [("0.49", 2.3406798), ("0.499", 2.3132625), ("0.4999", 2.3104932)];
