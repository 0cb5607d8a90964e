//! All weights of the library.

use ppum::cover::OVERLAP;
use ppum::library::WEIGHTS;
use ppum::vec2::vec2;
use ppum::weight::WeightFunction;
use ppum_problem::{BaseCells, Discretization, PolynomialOrder, ProblemData};

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization, held};
use crate::studies::support::{errors, solved};
use crate::support::pulled;

/// Error of the displacement (0.3 (x² − c y²) + x − y/2, 0.7 x + y), which with c = (λ + 2μ)/μ
/// needs no body force and is in the space: only quadrature is in the way.
fn patch_test(weight: WeightFunction, level: u32) -> f64 {
    let mut set = discretization(BaseCells::Level(level), 2);
    set.weight = weight;
    let c = (MATERIAL.lambda() + 2.0 * MATERIAL.mu()) / MATERIAL.mu();
    let exact = [format!("0.3*x*x - {:?}*y*y + x - 0.5*y", 0.3 * c), "0.7*x + y".to_owned()];
    let solution = solved(&held(ProblemData::elasticity(SQUARE, MATERIAL, set), exact));
    let exact = |p: ppum::vec2::Vec2| {
        let u = 0.3 * p.x * p.x - 0.3 * c * p.y * p.y + p.x - 0.5 * p.y;
        let gradient = [vec2(0.6 * p.x + 1.0, -0.6 * c * p.y - 0.5), vec2(0.7, 1.0)];
        ([u, 0.7 * p.x + p.y], gradient)
    };
    errors(&solution, &exact).energy
}

/// Rules made for linear weights leave 1.5e-7 with quadratic, 7.6e-6 with cubic ones.
#[test]
fn every_weight_of_the_library_passes_the_patch_test() {
    for entry in &WEIGHTS {
        let weight = WeightFunction::from_library(entry.name).expect("of the library");
        let error = patch_test(weight, 2);
        println!("{}: {error:.1e}", entry.name);
        assert!(error < 5e-8, "{}: {error}", entry.name);
    }
}

/// K_I of the centre crack at the bounds of the overlap, on cells graded to the tips: 1.6715603
/// (hpfem of order 10, and the series solution to 1e-7). α = 1.3 leaves 5e-6; 1 + 1e-12 gave K = 0.
#[test]
fn k_is_right_at_the_bounds_of_the_overlap() {
    for alpha in [*OVERLAP.start(), *OVERLAP.end()] {
        let mut set = Discretization::new(BaseCells::Level(2));
        (set.order, set.overlap) = (PolynomialOrder::Uniform(4), alpha);
        let crack = [[-0.5, 0.0], [0.5, 0.0]];
        let problem = ProblemData::elasticity(SQUARE, MATERIAL, set).with_crack(&crack);
        for tip in &solved(&pulled(problem)).steps[0].intensities {
            let error = (tip.k1 / 1.671_560_3 - 1.0).hypot(tip.k2);
            println!("α = {alpha}: K off by {error:.1e}");
            assert!(error < 2e-5, "α = {alpha}: {error}");
        }
    }
}
