//! Bodies and measures that several tests share.

use ppum::dataset::{Dataset, TipIntensity};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{Condition, DomainEdge, ProblemData};

use crate::studies::support::record;

/// The boundary conditions of a body that is pulled upwards at its top and downwards at its bottom,
/// in a problem file.
pub(crate) const TENSION: &str = "[[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n\
     [[boundary]]\non = \"top\"\ntraction = [0, 1]\n";

/// The square [−half, half]².
pub(crate) fn square(half: f64) -> Rect {
    Rect::around(Vec2::ZERO, vec2(half, half))
}

pub(crate) fn traction(t: [f64; 2]) -> Vec<Condition> {
    t.map(|t| Condition::Neumann(t.into())).to_vec()
}

/// The body with the tractions of a uniform stress (σ_xx, σ_yy, σ_xy) on some edges.
pub(crate) fn stressed(
    problem: ProblemData,
    [xx, yy, xy]: [f64; 3],
    edges: &[DomainEdge],
) -> ProblemData {
    edges.iter().fold(problem, |problem, &edge| {
        let n = edge.normal();
        problem.with_boundary(edge, traction([xx * n.x + xy * n.y, xy * n.x + yy * n.y]))
    })
}

/// The body in tension along y, by tractions at its bottom and its top.
pub(crate) fn pulled(problem: ProblemData) -> ProblemData {
    stressed(problem, [0.0, 1.0, 0.0], &[DomainEdge::Bottom, DomainEdge::Top])
}

/// (K_I, K_II) of a tip.
pub(crate) fn factors_of(tip: &TipIntensity) -> [f64; 2] {
    [tip.k1, tip.k2]
}

/// (K_I, K_II) of all tips of the first step.
pub(crate) fn factors(dataset: &Dataset) -> Vec<[f64; 2]> {
    dataset.steps[0].intensities.iter().map(factors_of).collect()
}

/// The distance of two pairs of factors, as a part of the size of the second.
pub(crate) fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]) / b[0].hypot(b[1])
}

/// The energy that the solver reports for the first step.
pub(crate) fn energy(dataset: &Dataset) -> f64 {
    record(&dataset.steps[0], "energy")
}
