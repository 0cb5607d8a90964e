//! Covers that are improved by their own solutions, on problems whose errors are known.

use super::exact_fields::SQUARE;
use super::plates::pulled;
use super::support::{Both, errors, parsed, record};
use ppum::dataset::{Dataset, Step};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{AdaptKind, Adaptivity, BaseCells, PolynomialOrder, ProblemData, StepsKept};
use std::f64::consts::PI;

/// Strain energies by finite elements of order 10 and 12 on meshes graded towards the singular
/// points (NGSolve 6.2.2608): of a plate with a crack, good to 1e-9, and of one with a square hole,
/// good to 2e-8.
pub(crate) const CRACK: f64 = 2.428_931_916;
/// See [`CRACK`].
pub(crate) const SQUARE_HOLE: f64 = 2.512_525_532;

/// Settings that keep all steps.
pub(crate) fn set(kind: AdaptKind, steps: usize, max_unknowns: usize) -> Adaptivity {
    let mut set = Adaptivity::new(kind);
    (set.steps, set.max_unknowns, set.keep) = (steps, max_unknowns, StepsKept::All);
    set
}

/// A problem on coarse cells that adapt.
pub(crate) fn on(mut problem: ProblemData, order: usize, set: Adaptivity) -> ProblemData {
    problem.discretization.cells = BaseCells::Level(2);
    problem.discretization.order = PolynomialOrder::Uniform(order);
    problem.with_adaptivity(set)
}

/// A crack in a plate.
pub(crate) fn crack() -> ProblemData {
    pulled(SQUARE, [1, 1], &[&[[-0.4, -0.3], [0.4, 0.3]]])
}

/// A square hole in a plate.
pub(crate) fn square_hole() -> ProblemData {
    let points = [(-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)];
    let points = points.map(|(x, y)| vec2(x, y)).into();
    let domain = Domain { bounds: SQUARE, holes: vec![Hole::polygon(points)] };
    pulled(SQUARE, [1, 1], &[]).with_domain(domain)
}

/// u = r^⅔ sin(⅔ θ) around a corner of 270°, given on the outer border.
pub(crate) fn corner() -> ProblemData {
    let edge = |name: &str| format!("[[boundary]]\non = \"{name}\"\nvalue = \"exact\"\n");
    let border: String = ["left", "right", "bottom", "top"].map(edge).concat();
    let text = format!(
        "[domain]\nmin = [-1.0, -1.0]\nmax = [1.0, 1.0]\n[equation]\nkind = \"poisson\"\n\
         [[hole]]\npoints = [[0.0, 0.0], [0.0, -1.5], [1.5, -1.5], [1.5, 0.0]]\n\
         [exact]\nvalue = \"let t = atan2(y, x); let s = if(t < -1e-12, t + 2*pi, t); \
         hypot(x, y)^(2/3)*sin(2/3*s)\"\n{border}\
         [[boundary]]\non = {{ hole = 0 }}\nvalue = 0.0\n[discretization]\nlevel = 2\n"
    );
    parsed(&text)
}

fn at_corner(x: Vec2) -> Both {
    let (r, t) = (x.length(), x.y.atan2(x.x));
    let (s, c) = ((if t < -1e-12 { t + 2.0 * PI } else { t }) * 2.0 / 3.0).sin_cos();
    let (radial, slope) = (x.unit(), 2.0 / 3.0 * r.powf(-1.0 / 3.0));
    let gradient = radial * (slope * s) + radial.left() * (slope * c);
    ([r.powf(2.0 / 3.0) * s, 0.0], [gradient, Vec2::ZERO])
}

/// Unknowns, relative error and estimated error of each step: from the energy under loads alone, or
/// of [`corner`] from the field.
pub(crate) fn course(dataset: &Dataset, energy: Option<f64>) -> Vec<[f64; 3]> {
    let error = |step: &Step| match energy {
        Some(energy) => (1.0 - record(step, "energy") / energy).abs().sqrt(),
        None => {
            let mut one = dataset.clone();
            one.steps = vec![step.clone()];
            errors(&one, &at_corner).energy
        }
    };
    let of = |step: &Step| [record(step, "unknowns"), error(step), record(step, "estimated error")];
    dataset.steps.iter().map(of).collect()
}

/// Slope and correlation of the line nearest to points.
pub(crate) fn line(points: &[[f64; 2]]) -> [f64; 2] {
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let product = |a: usize, b: usize| -> f64 {
        points.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum()
    };
    let [xx, xy, yy] = [product(0, 0), product(0, 1), product(1, 1)];
    [xy / xx, xy / (xx * yy).sqrt()]
}
