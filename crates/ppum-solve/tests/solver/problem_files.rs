//! Problems defined wholly in problem files, with functions nobody has compiled: errors against their
//! exact solutions, rates of convergence with these functions, and what is lost without them.

use std::path::{Path, PathBuf};

use ppum::formula::Formula;
use ppum::vec2::{Vec2, vec2};
use ppum_solve::problem::{Cells, Problem};

use crate::studies::support::{Both, errors, solved};

/// A problem file of the examples at a level, with its enrichments or without any, at interfaces neither.
fn example(name: &str, level: u32, enriched: bool) -> Problem {
    let folder: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut problem = Problem::read(&folder.join(name)).expect("an example");
    problem.discretization.cells = Cells::Level(level);
    if !enriched {
        problem.enrichments.clear();
        problem.discretization.interfaces = false;
    }
    problem
}

/// Relative error in the energy norm.
fn error(problem: &Problem) -> f64 {
    let formulas: Vec<[Formula; 3]> = problem
        .exact
        .iter()
        .map(|exact| {
            let f = exact.formula();
            [f.clone(), f.derivative("x").expect("smooth"), f.derivative("y").expect("smooth")]
        })
        .collect();
    let exact = |p: Vec2| -> Both {
        let (mut values, mut gradients) = ([0.0; 2], [Vec2::ZERO; 2]);
        for (k, formulas) in formulas.iter().enumerate() {
            let [v, x, y] = formulas.each_ref().map(|f| f.evaluate(&[p.x, p.y]));
            (values[k], gradients[k]) = (v, vec2(x, y));
        }
        (values, gradients)
    };
    errors(&solved(problem), &exact).energy
}

/// The errors at two levels, and the rate.
fn study(name: &str, levels: [u32; 2], enriched: bool) -> ([f64; 2], f64) {
    let found = levels.map(|level| error(&example(name, level, enriched)));
    let rate = (found[0] / found[1]).log2() / f64::from(levels[1] - levels[0]);
    println!("{name} {levels:?} enriched {enriched}: {found:?}, rate {rate:.2}");
    (found, rate)
}

/// |d| across an interface that lies on no line of cells: order 2 with it, 1/2 without.
#[test]
fn two_materials() {
    let (found, rate) = study("bimaterial-plate.toml", [3, 4], true);
    assert!(rate > 1.8 && found[1] < 1e-2, "{found:?} {rate}");
    let (lost, rate) = study("bimaterial-plate.toml", [3, 4], false);
    assert!(rate < 0.9 && lost[1] > 10.0 * found[1], "{lost:?} {rate}");
}

/// A layer of a hundredth of a cell under a weight no spline library has: without its function
/// nothing of it is seen.
#[test]
fn boundary_layer() {
    let (found, rate) = study("boundary-layer.toml", [1, 2], true);
    assert!(rate > 1.7 && found[1] < 1e-2, "{found:?} {rate}");
    let (lost, _) = study("boundary-layer.toml", [1, 2], false);
    assert!(lost[1] > 0.5, "{lost:?}");
}

/// r^λ at a corner of two conductivities, λ = 0.704: the rate without it is λ.
#[test]
fn interface_corner() {
    let (found, rate) = study("interface-corner.toml", [2, 3], true);
    let (lost, slow) = study("interface-corner.toml", [2, 3], false);
    assert!(rate > 1.0 && slow < 0.9, "{rate} {slow}");
    assert!(lost[1] > 5.0 * found[1], "{lost:?} {found:?}");
}

/// A function that is known from a table of a file only.
#[test]
fn tabulated_profile() {
    let (found, rate) = study("tabulated-profile.toml", [1, 2], true);
    assert!(rate > 1.7 && found[1] < 1e-2, "{found:?} {rate}");
    let (lost, _) = study("tabulated-profile.toml", [1, 2], false);
    assert!(lost[1] > 10.0 * found[1], "{lost:?}");
}
