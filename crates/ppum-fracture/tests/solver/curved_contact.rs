//! Curved faces that touch: what is not seen, and Michell's series for a disc in a ring.

use crate::studies::support::{parsed, quantity, record, solved};
use crate::support::{square, stressed};
use ppum::crack::Crack;
use ppum::dataset::{Dataset, Material, StressState};
use ppum::edge::Edge;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{BaseCells, Discretization, DomainEdge, PolynomialOrder, ProblemData};
use ppum_testkit::random::Random;
use std::f64::consts::PI;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// A free plate under pressure from all sides with cracks whose faces touch.
fn pressed(cracks: &[Vec<Edge>], friction: f64) -> ProblemData {
    let mut set = Discretization::new(BaseCells::Grid([9, 9]));
    set.order = PolynomialOrder::Uniform(2);
    let mut problem = ProblemData::elasticity(square(1.0), MATERIAL, set);
    for (k, edges) in (0..).zip(cracks) {
        problem = problem.with_crack_along(Crack::along(edges)).with_contact(k, friction);
    }
    stressed(problem, [-1.0, -1.0, 0.0], &DomainEdge::ALL)
}

/// Two halves of a circle, in so many arcs each.
fn circle(center: Vec2, radius: f64, count: usize) -> Vec<Vec<Edge>> {
    let half = |k: usize| {
        let start = 0.4 + PI * k as f64;
        let arc = Edge::around(center, radius, [start, start + PI]);
        let at = |k: usize| k as f64 / count as f64;
        (0..count).map(|k| arc.part([at(k), at(k + 1)])).collect()
    };
    vec![half(0), half(1)]
}

/// Under pressure from all sides curved faces that touch transmit what the whole body does: arcs,
/// chains of them, mouths, and a whole circle, whose disc nothing but its faces holds.
#[test]
fn pressed_curves_are_not_seen() {
    let arc = Edge { from: vec2(-0.52, -0.13), to: vec2(0.31, -0.22), bulge: 0.4 };
    let on = Edge::leaving(arc.to, arc.end_tangents()[1], -1.7, 0.5);
    let mouth = Edge { from: vec2(-1.0, 0.13), to: vec2(0.1, 0.3), bulge: -0.3 };
    let cases = [
        vec![vec![arc]],
        vec![vec![arc.part([0.0, 0.3]), arc.part([0.3, 1.0]), on]],
        vec![vec![mouth]],
        circle(vec2(0.07, -0.04), 0.53, 1),
        circle(vec2(0.07, -0.04), 0.53, 10),
    ];
    for (k, cracks) in cases.iter().enumerate() {
        for friction in [0.0, 0.4] {
            let dataset = solved(&pressed(cracks, friction));
            let mut random = Random(3);
            for _ in 0..20 {
                let at = vec2(random.between(-0.9, 0.9), random.between(-0.9, 0.9));
                let [xx, yy, xy] = ["sxx", "syy", "sxy"].map(|name| quantity(&dataset, name, at));
                let off = (xx + 1.0).abs().max((yy + 1.0).abs()).max(xy.abs());
                assert!(off < 1e-7, "{k} {friction}: {off:e} at {at:?}");
            }
            let step = &dataset.steps[0];
            // ½ σ:ε on an area of 4, with ε = (1 + ν)(1 − 2ν) σ/E
            assert!((record(step, "energy") / 2.08 - 1.0).abs() < 1e-9, "{k} {friction}");
            assert!((record(step, "closed faces") - 1.0).abs() < 1e-9, "{k} {friction}");
            assert!(record(step, "overlap of faces") < 1e-9, "{k} {friction}");
            for tip in &step.intensities {
                assert!(tip.k1.hypot(tip.k2) < 1e-7, "{k} {friction}: {tip:?}");
            }
        }
    }
}

/// Quarter of a disc of radius 0.6 in a ring of outer radius 1, without friction, under the
/// pressure 1 + 0.3 cos 2θ. Michell's stress functions are (A r² + B r⁴) cos 2θ in the disc and
/// (A r² + B r⁴ + C r⁻² + D) cos 2θ in the ring; six conditions on both circles give these numbers:
/// a contact pressure of 1 + P cos 2θ, and what else is measured.
const P: f64 = 0.443_778_801_843_318;
const RIM_AT_0: f64 = -0.922_580_645_161_290;
const RIM_AT_90: f64 = -0.117_419_354_838_710;
const SLIDING_AT_45: f64 = 0.235_887_096_774_193_5;

fn disc_in_ring(arcs: &str, level: u32, order: u32) -> Dataset {
    let text = format!(
        "[domain]\nmin = [0, 0]\nmax = [1.2, 1.2]\n\
         outline = {{ ellipse = {{ center = [0, 0], axes = [1, 1] }} }}\n\
         [material]\nyoung = 1\npoisson = 0.3\nstate = \"plane-strain\"\n\
         {arcs}\
         [[boundary]]\non = \"left\"\nsymmetry = true\n\
         [[boundary]]\non = \"bottom\"\nsymmetry = true\n\
         [[boundary]]\non = \"outline\"\npressure = \"1 + 0.3*cos(2*atan2(y, x))\"\n\
         [discretization]\nlevel = {level}\norder = {order}\n"
    );
    solved(&parsed(&text))
}

/// The largest error of the contact pressure on both sides of the faces, at places off the ends.
fn pressure_error(dataset: &Dataset) -> f64 {
    let at = |k: u32| PI / 2.0 * (f64::from(k) + 0.5) / 32.0;
    let pressure = |angle: f64, radius: f64| {
        let way = vec2(angle.cos(), angle.sin());
        let of = |name| quantity(dataset, name, way * radius);
        let [xx, yy, xy] = ["sxx", "syy", "sxy"].map(of);
        -(xx * way.x * way.x + yy * way.y * way.y + 2.0 * xy * way.x * way.y)
    };
    let errors = (1..31).map(at).flat_map(|angle| {
        let exact = 1.0 + P * (2.0 * angle).cos();
        [0.6 - 1e-9, 0.6 + 1e-9].map(|radius| (pressure(angle, radius) - exact).abs())
    });
    errors.fold(0.0, f64::max)
}

/// The jump of u along the circle at 45°, outside minus inside.
fn sliding(dataset: &Dataset) -> f64 {
    let way = vec2(1.0, 1.0).unit();
    let along = |radius: f64| {
        let [x, y] = ["ux", "uy"].map(|name| quantity(dataset, name, way * radius));
        way.left().dot(vec2(x, y))
    };
    along(0.6 + 1e-9) - along(0.6 - 1e-9)
}

const ONE_ARC: &str = "[[crack]]\narc = { center = [0, 0], radius = 0.6, from = 0, to = 90 }\n\
                       contact = true\n";

#[test]
fn a_disc_in_a_ring() {
    let dataset = disc_in_ring(ONE_ARC, 4, 3);
    let step = &dataset.steps[0];
    assert!((record(step, "closed faces") - 1.0).abs() < 1e-9);
    let error = pressure_error(&dataset);
    // of order h³ of the cells, 0.075 across
    assert!(error < 5e-3, "{error:e}");
    let off = (sliding(&dataset) - SLIDING_AT_45).abs();
    assert!(off < 1e-4, "{off:e}");
    let rim = [
        quantity(&dataset, "ux", vec2(1.0 - 1e-12, 0.0)),
        quantity(&dataset, "uy", vec2(0.0, 1.0 - 1e-12)),
    ];
    for (found, exact) in rim.into_iter().zip([RIM_AT_0, RIM_AT_90]) {
        assert!((found - exact).abs() < 1e-4, "{found} instead of {exact}");
    }
}

#[test]
#[ignore = "slow: contact of order 6 on a curve"]
fn a_disc_in_a_ring_to_many_digits() {
    let dataset = disc_in_ring(ONE_ARC, 3, 6);
    let error = pressure_error(&dataset);
    assert!(error < 1e-4, "{error:e}");
    assert!((sliding(&dataset) - SLIDING_AT_45).abs() < 1e-7);
}
