//! Cracks where meshes would have a hard time: short ones, ones that nearly touch a border or each
//! other, sharp kinks; very long plates.

use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::solve::solve;
use ppum_problem::{BaseCells, Discretization, DomainEdge, ProblemData};
use ppum_solve::space::discretise;
use ppum_testkit::exact::{CrackInPlane, ExactField};

use crate::studies::exact_fields::{MATERIAL, SQUARE, TipProblem, held};
use crate::studies::plates::{pulled, traction};
use crate::studies::support::{checked, solved};
use crate::support::{apart, factors_of};

/// Width of a cell when an edge of [−1, 1]² has twelve.
const CELL: f64 = 1.0 / 6.0;

fn twelve() -> Discretization {
    Discretization::new(BaseCells::Grid([12, 12]))
}

/// The largest error of the factors that a solution has; it must have some.
fn error_of_k(name: &str, dataset: &Dataset, exact: [f64; 2]) -> f64 {
    let tips = &dataset.steps[0].intensities;
    assert!(!tips.is_empty(), "{name}: no factors");
    let worst = tips.iter().map(|tip| apart(factors_of(tip), exact)).fold(0.0, f64::max);
    let cells = dataset.steps[0].partition.len();
    println!("{name}: K of {} tips off by {worst:.1e}, {cells} cells", tips.len());
    worst
}

/// A crack in the plane under tension and shear, its displacement given on the border of a box.
fn in_plane(domain: Rect, set: Discretization, a: Vec2, b: Vec2) -> (ProblemData, [f64; 2]) {
    let (centre, half) = ((a + b) * 0.5, 0.5 * (b - a).length());
    let field = CrackInPlane::biaxial(MATERIAL, centre, b - a, half, 1.0);
    let field = field.with_remote([0.5, 1.0, 0.4]);
    let plate = ProblemData::elasticity(domain, MATERIAL, set).with_crack(&[a.into(), b.into()]);
    (held(plate, field.formulas()), field.intensities())
}

/// Loads scale solutions exactly, as long as energies are numbers; beyond it is said what to do.
#[test]
fn loads_of_any_size() {
    let of = |load: f64| {
        let plate = ProblemData::elasticity(SQUARE, MATERIAL, twelve())
            .with_crack(&[[-0.3, 0.0], [0.2, 0.1]])
            .with_boundary(DomainEdge::Bottom, traction(0.0.into(), (-load).into()))
            .with_boundary(DomainEdge::Top, traction(0.0.into(), load.into()));
        solve(&checked(&plate), unwatched())
    };
    let unit = of(1.0).expect("a solution");
    let size = 2.0_f64.powi(400);
    let large = of(size).expect("a solution");
    for (a, b) in unit.steps[0].intensities.iter().zip(&large.steps[0].intensities) {
        assert_eq!((a.k1 * size, a.k2 * size), (b.k1, b.k2));
    }
    let error = of(1e160).expect_err("too large an energy").to_string();
    assert!(error.contains("in other units"), "{error}");
}

/// Down to a distance of nothing, where the tip is a mouth.
#[test]
fn a_tip_near_the_border() {
    for part in [1e-4, 0.0] {
        let (a, b) = (vec2(0.1, 0.03), vec2(1.0 - part * CELL, 0.06));
        let (problem, exact) = in_plane(SQUARE, twelve(), a, b);
        let error = error_of_k(&format!("{part} cells"), &solved(&problem), exact);
        assert!(error < 1e-3, "{part} cells from the border: {error}");
    }
}

fn assert_short_crack(length: f64, cells: u32) {
    let (a, b) = (vec2(0.1, 0.03), vec2(0.1 + length, 0.03 + 0.3 * length));
    let set = Discretization::new(BaseCells::Grid([cells; 2]));
    let (problem, exact) = in_plane(SQUARE, set, a, b);
    let error = error_of_k(&format!("length {length}"), &solved(&problem), exact);
    assert!(error < 2e-3, "length {length}: {error}");
}

/// A 480th of a cell long.
#[test]
fn a_short_crack() {
    assert_short_crack(0.001, 4);
}

/// A twelfth of a cell long.
#[test]
#[ignore = "slow: small cells at two tips"]
fn a_crack_within_a_cell() {
    assert_short_crack(0.02, 8);
}

fn assert_flat_angle(degrees: f64) {
    let angle = degrees.to_radians();
    let tip = vec2(0.1, -1.0 + angle.tan());
    let field = TipProblem { domain: SQUARE, tip, angle }.field().with_intensities(1.0, 0.5);
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, twelve());
    let plate = plate.with_crack(&[[-0.9, -1.0], tip.into()]);
    let dataset = solved(&held(plate, field.formulas()));
    let error = error_of_k(&format!("{degrees} degrees"), &dataset, [1.0, 0.5]);
    assert!(error < 1e-3, "{degrees} degrees: {error}");
}

/// The wedge between crack and border is a hundredth of a cell high in the middle of its
/// first cell.
#[test]
fn a_crack_that_leaves_at_a_flat_angle() {
    assert_flat_angle(1.0);
}

#[test]
#[ignore = "slow: small cells at a tip"]
fn a_crack_that_leaves_at_five_degrees() {
    assert_flat_angle(5.0);
}

/// Asserts that cells of a long plate are nearly square, and factors in it.
fn assert_long_plate(half: Vec2) {
    let domain = Rect::around(Vec2::ZERO, half);
    let set = Discretization::new(BaseCells::Level(4));
    let (problem, exact) = in_plane(domain, set, vec2(-0.31, 0.03), vec2(0.3, 0.05));
    let uncracked = problem.clone().with_lines([]);
    let cells = discretise(&checked(&uncracked), unwatched())
        .expect("a cover")
        .partition
        .boxes()
        .cell
        .clone();
    let aspect = |cell: &Rect| (cell.size().x / cell.size().y).log2().abs();
    assert!(cells.len() == 256 && cells.iter().all(|c| aspect(c) <= 1.0), "{half:?}");
    let error = error_of_k(&format!("{half:?}"), &solved(&problem), exact);
    assert!(error < 2e-3, "{half:?}: {error}");
}

/// A plate 200 times as long as wide.
#[test]
fn a_long_plate() {
    assert_long_plate(vec2(1.0, 200.0));
}

#[test]
#[ignore = "slow: small cells at two tips"]
fn a_long_plate_that_lies() {
    assert_long_plate(vec2(50.0, 1.0));
}

/// Asserts that a crack beside another, longer one, a thousandth of a cell away, does not matter.
///
/// K_I / (σ √(πa)) = 1.333712 of the longer crack alone, in the middle; beside the middle it is
/// larger by less than 0.2 %.
fn assert_strip_does_not_matter(y: f64) {
    let alone = 1.333712 * (0.5 * std::f64::consts::PI).sqrt();
    let beside = y + 1e-3 * CELL;
    let cracks: [&[[f64; 2]]; 2] = [&[[-0.5, y], [0.5, y]], &[[-0.4, beside], [0.4, beside]]];
    let dataset = solved(&pulled(SQUARE, [12, 12], &cracks));
    let longer = &dataset.steps[0].intensities[..2];
    for tip in longer {
        println!("y = {y}: K_I {:.6}, alone {alone:.6}", tip.k1);
        assert!((tip.k1 / alone - 1.0).abs() < 4e-3, "{tip:?}");
    }
    let [left, right] = [longer[0].k1, longer[1].k1];
    assert!((left / right - 1.0).abs() < 1e-6, "symmetry: {left} {right}");
}

/// On a line of cells both lie in the overlap of two rows of patches, whose functions are dependent
/// on the strip.
#[test]
fn a_strip_between_cracks() {
    assert_strip_does_not_matter(0.0);
}

#[test]
#[ignore = "slow: small cells at four tips"]
fn a_strip_within_cells() {
    assert_strip_does_not_matter(0.07);
}

/// Asserts that K does not depend on the cells one starts from, but for what is glued together
/// within a 128th of the crack's length around its kinks: patches that a crack crosses twice
/// are refined.
fn assert_independent_of_cells(crack: &[[f64; 2]]) {
    let solution = |cells| solved(&pulled(SQUARE, [cells, cells], &[crack]));
    let [coarse, fine] = [4, 9].map(solution);
    let tips = coarse.steps[0].intensities.iter().zip(&fine.steps[0].intensities);
    for (a, b) in tips {
        let difference = apart(factors_of(a), factors_of(b));
        println!("K {:.4} {:.4}, differing by {difference:.1e}", b.k1, b.k2);
        assert!(difference < 2e-2, "{a:?} {b:?}");
    }
}

/// A V of five degrees. Without refinement its K is off by its own size on 24 × 24 cells.
#[test]
fn sharp_kinks() {
    assert_independent_of_cells(&[[-0.02, 0.4], [0.02, -0.5], [0.06, 0.41]]);
}

#[test]
#[ignore = "slow: small cells around the two kinks of a Z"]
fn two_sharp_kinks() {
    assert_independent_of_cells(&[[-0.5, 0.3], [0.3, 0.21], [-0.31, 0.02], [0.5, -0.1]]);
}
