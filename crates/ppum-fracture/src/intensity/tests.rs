//! K, T and J of the exact field of an arc, by rules that know where it is: what the integrals give
//! for a field without any error.

use super::auxiliary::TipMaterialBody;
use super::block::PointBlock;
use super::integral::Interaction;
use super::loads::TipLoads;
use super::sums::{Integrals, RINGS};
use ppum::crack::{Crack, CrackEnd, End, LocalTip, Side, TipId};
use ppum::dataset::{Dataset, Elasticity, Equation, Material, StressState};
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_solve::law::Law;
use ppum_solve::quadrature::gauss;
use ppum_solve::space::TrialSpace;
use ppum_testkit::exact::{ArcCrack, ExactField as _};
use ppum_testkit::synthetic::Recipe;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const MATERIAL: Material = Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStrain };

/// A pressure on both faces of an edge, or nothing where it is zero.
struct FacePressure(f64, Edge);

impl TipLoads for FacePressure {
    fn traction(&self, _: u32, side: Side, x: Vec2) -> Option<[f64; 2]> {
        let normal = self.1.tangent_towards(x).left();
        let into = if side == Side::Above { normal } else { -normal };
        (self.0 != 0.0).then(|| (into * self.0).into())
    }
}

/// A dataset that has an edge as its crack, in the material; its field does not matter.
fn dataset(edge: &Edge) -> Dataset {
    let crack = Crack {
        points: vec![edge.from, edge.to],
        bulges: vec![edge.bulge],
        ends: [CrackEnd::Tip; 2],
    };
    let mut dataset = Recipe { cracks: vec![crack], ..Recipe::default() }.dataset();
    let [young, poisson] = [MATERIAL.young, MATERIAL.poisson].map(Into::into);
    let state = MATERIAL.state;
    let body = Elasticity { young, poisson, state, eigenstrain: None, anisotropy: None };
    dataset.equation = Equation::Elasticity(body);
    dataset
}

fn jets(exact: &ArcCrack, at: Vec2) -> [Jet<f64>; 2] {
    exact.evaluate(at).map(|u| Jet { x: u.gradient.x, y: u.gradient.y, ..Jet::constant(u.value) })
}

/// The integrals over the body: circles are divided by the crack, whose points have the angle at
/// which the side changes.
fn over_body(tip: &Interaction<'_>, exact: &ArcCrack) -> Integrals {
    let local: LocalTip = tip.path.at(tip.center);
    let q = tip.path.curvature();
    let (mut offsets, mut weights) = (Vec::new(), Vec::new());
    for (s, ds) in gauss(40).on(0.0, tip.largest().sqrt()) {
        let r = s * s;
        // the chord of the arc behind the tip is turned by half of what the arc turns
        let top = PI - (0.5 * q * r).asin();
        // auxiliary fields are singular at the centre, half as far away again: in four panels
        let panel = |k: u32| {
            let from = top - TAU + FRAC_PI_2 * f64::from(k);
            gauss(40).on(from, from + FRAC_PI_2)
        };
        for (angle, weight) in (0..4).flat_map(panel) {
            let [x, y] = [r * angle.cos(), r * angle.sin()];
            offsets.push(local.axis * x + local.axis.left() * y);
            weights.push(weight * r * 2.0 * s * ds);
        }
    }
    let all = offsets.iter().flat_map(|offset| jets(exact, tip.center + *offset));
    PointBlock::new(tip, tip.center, &offsets).integrals(&weights, &all.collect::<Vec<_>>())
}

/// The integrals over both faces with the field there.
fn over_faces(tip: &Interaction<'_>, exact: &ArcCrack) -> Integrals {
    let mut sums = Integrals::default();
    for part in tip.path.parts() {
        for edge in tip.path.pieces(&part, &tip.radii) {
            for side in [Side::Above, Side::Below] {
                let rule = tip.face_rule(&edge, part.segment, side);
                let points = rule.offsets.iter().zip(&rule.normals);
                let beside = points.map(|(offset, normal)| tip.center + *offset - *normal * 1e-13);
                let all: Vec<_> = beside.flat_map(|at| jets(exact, at)).collect();
                sums = sums.plus(tip.on_face(&part, &rule, &all, &[]));
            }
        }
    }
    sums
}

/// Errors of K, T and J relative to K, by auxiliary fields of a part of the arc's curvature, with
/// the faces or without them.
fn errors(
    exact: &ArcCrack,
    pressure: f64,
    (end, is_reversed): (End, bool),
    (part, has_faces): (f64, bool),
) -> [f64; 3] {
    let edge = if is_reversed { exact.edge().reversed() } else { exact.edge() };
    let dataset = dataset(&edge);
    let field = Field::new(&dataset, 0).expect("a field");
    let space = TrialSpace::new(field.step, field.domain, field.equation, field.tables);
    let (space, law) = (space.expect("a space"), Law::new(&dataset.equation));
    let loads = FacePressure(pressure, edge);
    let radii = [0.12, 0.16, 0.2];
    let tip = TipId { crack: 0, end };
    let mut tip = Interaction::new(&field, &space, &law, tip, radii, &loads).expect("elastic");
    tip.body = TipMaterialBody::new(&MATERIAL, part * tip.body.curvature);
    tip.set_origin(exact.evaluate(tip.center).map(|u| u.value));
    let mut sums = tip.start().plus(over_body(&tip, exact));
    if has_faces {
        sums = sums.plus(over_faces(&tip, exact));
    }
    let found = tip.integrals(&sums);
    let of_arc = if (end == End::Last) == is_reversed { End::Start } else { End::Last };
    let ([k1, k2], t) = (exact.intensities(of_arc), exact.t_stress(of_arc));
    let size = k1.hypot(k2);
    let ring = &found.rings[RINGS - 1];
    let k = (ring.k1 - k1).hypot(ring.k2 - k2) / size;
    let j = found.j.expect("J") * MATERIAL.effective_young() / (size * size) - 1.0;
    [k, (found.t_stress.expect("T") - t).abs() / size, j.abs()]
}

fn arc(half_angle: f64, radius: f64) -> ArcCrack {
    let direction = vec2(0.28, 0.96);
    let center = vec2(0.87, 0.2) - direction * (0.8 * radius);
    ArcCrack::new(MATERIAL, center, radius, direction, half_angle).with_remote([0.7, 1.0, 0.6])
}

const ARCS: [(f64, f64); 4] = [(0.4, 0.7), (0.8, 0.4), (1.4, 0.3), (2.2, 0.3)];

/// Without loads on its faces, K, T and J of an arc come from the body alone.
#[test]
fn free_arcs() {
    for (half, radius) in ARCS {
        for at in [End::Start, End::Last].into_iter().flat_map(|end| [(end, false), (end, true)]) {
            let [k, t, j] = errors(&arc(half, radius), 0.0, at, (1.0, false));
            println!("{half} {at:?}: K {k:.1e}, T {t:.1e}, J {j:.1e}");
            // of the displacement at the tip, which T needs, rounding leaves half of the digits
            assert!(k < 1e-13 && t < 1e-6 && j < 1e-13, "{half} {at:?}: {k} {t} {j}");
        }
    }
}

/// With auxiliary fields of half the curvature, and with those of a straight crack, the faces of
/// the arc have their part, which leaves K, T and J as they are.
#[test]
fn faces_of_other_curvatures() {
    for (half, radius) in ARCS {
        for at in [(End::Start, false), (End::Last, false), (End::Last, true)] {
            for part in [0.5, 0.0] {
                let [k, t, j] = errors(&arc(half, radius), 0.0, at, (part, true));
                println!("{half} {at:?} {part}: K {k:.1e}, T {t:.1e}, J {j:.1e}");
                // of T the integrand on faces grows like one over the root of the distance, which
                // points of Gauss miss a part of that is small like the root of the first piece
                assert!(k < 1e-6 && t < 2e-2 && j < 1e-6, "{half} {at:?}: {k} {t} {j}");
            }
        }
    }
}

/// Under a pressure the faces have the work of the loads.
#[test]
fn pressed_arcs() {
    for (half, radius) in ARCS {
        let exact = arc(half, radius).with_pressure(0.4);
        for at in [(End::Start, false), (End::Last, false), (End::Last, true)] {
            let [k, t, j] = errors(&exact, 0.4, at, (1.0, true));
            println!("{half} {at:?} pressed: K {k:.1e}, T {t:.1e}, J {j:.1e}");
            // so does that of J under a load
            assert!(k < 1e-13 && t < 1e-6 && j < 2e-2, "{half} {at:?}: {k} {t} {j}");
        }
    }
}
