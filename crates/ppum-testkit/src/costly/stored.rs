//! The text of the problem that a dataset keeps.

use super::{CostlyCase, middle, plate};
use ppum::dataset::Dataset;

pub(super) const ALL: &[CostlyCase] = &[
    ("problem-keys", None, problem_keys),
    ("problem-boundaries", None, problem_boundaries),
    ("problem-mistakes", None, problem_mistakes),
    ("problem-loads", None, problem_loads),
    ("problem-polygon", None, problem_polygon),
];

/// The problem whose crack is that of the plate, with more tables.
fn problem(more: &str) -> Dataset {
    let mut dataset = plate(16, 1, middle());
    let text = "title = \"costly\"\n[domain]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\n\
                [material]\nyoung = 1.0\npoisson = 0.3\nstate = \"plane-strain\"\n\
                [discretization]\nlevel = 4\n[[crack]]\npoints = [[0.25, 0.4375], [0.75, 0.4375]]\n";
    dataset.problem = Some(format!("{text}{more}"));
    dataset
}

/// Keys that mean nothing.
fn problem_keys() -> Dataset {
    let keys: String = (0..11_000).map(|k| format!("k{k} = {k}\n")).collect();
    problem(&format!("[nothing]\n{keys}"))
}

/// Parts of the border, each with ends at which the field is singular.
fn problem_boundaries() -> Dataset {
    let part = |k: u32| {
        let at = |j: u32| f64::from(2 * k + j) / 4096.0;
        let on = format!("{{ edge = \"top\", from = {}, to = {} }}", at(0), at(1));
        format!("[[boundary]]\non = {on}\ntraction = [0, 1]\n")
    };
    let parts: String = (0..2048).map(part).collect();
    problem(&format!("[[boundary]]\non = \"bottom\"\ndisplacement = [0.0, 0.0]\n{parts}"))
}

/// Conditions that are all given at the same place, so that each pair of them is a mistake.
fn problem_mistakes() -> Dataset {
    let twice = "[[boundary]]\non = \"top\"\ntraction = [0, 1]\n";
    problem(&twice.repeat(3000))
}

/// Loads that vary everywhere around the tips.
fn problem_loads() -> Dataset {
    problem(
        "[body_force]\nvalue = [\"sin(1e6*x)*sin(1e6*y)\", \"if(sin(1e5*x*y) > 0, 1, -1)\"]\n\
         [[boundary]]\non = \"bottom\"\ndisplacement = [0.0, 0.0]\n\
         [[boundary]]\non = { crack = 0 }\ntraction = [\"sin(1e7*x)\", \"if(sin(1e6*x) > 0, 1, 0)\"]\n",
    )
}

/// A hole with many corners.
fn problem_polygon() -> Dataset {
    let corner = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 3700.0;
        let r = 0.02 + 0.02 * f64::from(k % 2);
        format!("[{}, {}],", 0.5 + r * angle.cos(), 0.8 + r * angle.sin())
    };
    let corners: String = (0..3700).map(corner).collect();
    problem(&format!(
        "[[boundary]]\non = \"bottom\"\ndisplacement = [0.0, 0.0]\n[[hole]]\npoints = [{corners}]\n"
    ))
}
