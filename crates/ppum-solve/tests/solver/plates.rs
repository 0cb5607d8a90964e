//! Stress intensity factors of finite plates against independently computed reference values
//! (complex-potential least squares, cross-checked with handbooks): F = K/(σ√(πa)).

use crate::support::solved;
use ppum::dataset::{Dataset, Material, StressState};
use ppum::vec2::{Rect, vec2};
use ppum_solve::problem::{Cells, Condition, Discretization, Edge, Expression, Problem};
use std::f64::consts::PI;

fn material(young: f64, poisson: f64) -> Material {
    Material { young, poisson, state: StressState::PlaneStrain }
}

fn traction(x: f64, y: f64) -> Vec<Condition> {
    vec![Condition::Neumann(Expression::constant(x)), Condition::Neumann(Expression::constant(y))]
}

fn unknowns(dataset: &Dataset) -> usize {
    dataset.steps[0].fields[0].coefficients.iter().map(Vec::len).sum()
}

/// A plate of half-width 1 and half-height `height` under unit end traction, order 2.
fn pulled(height: f64, cells: [u32; 2], crack: &[[f64; 2]]) -> Dataset {
    let domain = Rect::new(vec2(-1.0, -height), vec2(1.0, height));
    let set = Discretization::new(Cells::Grid(cells));
    let problem = Problem::elasticity(domain, material(1.0, 0.3), set)
        .with_crack(crack)
        .with_boundary(Edge::Bottom, traction(0.0, -1.0))
        .with_boundary(Edge::Top, traction(0.0, 1.0));
    solved(&problem)
}

/// (F_I, F_II) at every tip.
fn factors(dataset: &Dataset, a: f64) -> Vec<[f64; 2]> {
    let scale = 1.0 / (PI * a).sqrt();
    dataset.steps[0].intensities.iter().map(|i| [i.k1 * scale, i.k2 * scale]).collect()
}

fn near(found: f64, expected: f64, tolerance: f64, what: &str) {
    println!("{what}: {found:.6}, reference {expected}, off by {:.1e}", found / expected - 1.0);
    assert!((found / expected - 1.0).abs() < tolerance, "{what}: {found} instead of {expected}");
}

#[test]
fn centre_crack_in_a_square_plate() {
    let plate = pulled(1.0, [16, 16], &[[-0.5, 0.0], [0.5, 0.0]]);
    assert!(unknowns(&plate) <= 10_000);
    for [f1, f2] in factors(&plate, 0.5) {
        near(f1, 1.3337121601, 1e-3, "centre crack, H/W = 1");
        assert!(f2.abs() < 1e-8);
    }
}

#[test]
fn centre_cracks_of_the_table() {
    for (a, height, cells, expected) in [
        (0.3, 1.0, [16, 16], 1.123191),
        (0.7, 1.0, [16, 16], 1.677138),
        (0.5, 0.5, [16, 8], 1.967084),
        (0.5, 2.0, [16, 32], 1.1876355618),
        (0.5, 3.0, [16, 48], 1.186671),
    ] {
        let plate = pulled(height, cells, &[[-a, 0.0], [a, 0.0]]);
        near(factors(&plate, a)[0][0], expected, 1e-3, &format!("a/W = {a}, H/W = {height}"));
    }
}

#[test]
fn slanted_cracks() {
    for (degrees, expected) in [(15.0f64, [1.112747, 0.261865]), (45.0, [0.611836, 0.545855])] {
        let (s, c) = degrees.to_radians().sin_cos();
        let plate = pulled(2.0, [16, 32], &[[-0.5 * c, -0.5 * s], [0.5 * c, 0.5 * s]]);
        for found in factors(&plate, 0.5) {
            near(found[0], expected[0], 2e-3, &format!("{degrees} degrees, mode I"));
            near(found[1], expected[1], 2e-3, &format!("{degrees} degrees, mode II"));
        }
    }
}

/// Edge cracks of length a in a plate of width W = 1, ends free to rotate.
#[test]
fn single_edge_cracks() {
    for (a, height, cells, expected) in [
        (0.3, 1.0, [16, 32], 1.661122),
        (0.5, 0.5, [16, 16], 3.008759),
        (0.5, 1.0, [16, 32], 2.825465),
        (0.5, 1.5, [16, 48], 2.824587),
    ] {
        let domain = Rect::new(vec2(0.0, -height), vec2(1.0, height));
        let set = Discretization::new(Cells::Grid(cells));
        let problem = Problem::elasticity(domain, material(1.0, 0.3), set)
            .with_crack(&[[0.0, 0.0], [a, 0.0]])
            .with_boundary(Edge::Bottom, traction(0.0, -1.0))
            .with_boundary(Edge::Top, traction(0.0, 1.0));
        let plate = solved(&problem);
        near(factors(&plate, a)[0][0], expected, 2e-3, &format!("a/W = {a}, H/W = {height}"));
    }
}

/// W = 7, L = 16, a = 3.5, bottom clamped, unit shear on top. K for ν = 0.25.
#[test]
fn edge_crack_under_end_shear() {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(7.0, 16.0));
    let set = Discretization::new(Cells::Grid([14, 32]));
    let clamp = || Condition::Dirichlet(Expression::constant(0.0));
    let problem = Problem::elasticity(domain, material(3e7, 0.25), set)
        .with_crack(&[[0.0, 8.0], [3.5, 8.0]])
        .with_boundary(Edge::Bottom, vec![clamp(), clamp()])
        .with_boundary(Edge::Top, traction(1.0, 0.0));
    let plate = solved(&problem);
    let tip = &plate.steps[0].intensities[0];
    println!("{:?}", tip.rings);
    near(tip.k1, 34.0425413592, 1e-3, "end shear, K_I");
    near(tip.k2, 4.5369400294, 1e-3, "end shear, K_II");
}

/// The same bits with one and with two threads.
#[test]
fn the_number_of_threads_does_not_matter() {
    let solve_with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let mut plate = pool.install(|| pulled(1.0, [8, 8], &[[-0.5, 0.1], [0.4, -0.03]]));
        plate.steps[0].history.retain(|record| record.unit != "s");
        plate
    };
    assert_eq!(solve_with(1), solve_with(2));
}
