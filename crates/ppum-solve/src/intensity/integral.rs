//! The interaction integral over the cells of a space.

use super::{FaceLoad, Loads};
use crate::law::{Law, LawAt};
use crate::quadrature::{Rule, gauss};
use crate::space::Space;
use ppum::crack::{End, LocalTip, Side, TipId, TipPoint};
use ppum::dataset::{Material, Ring};
use ppum::field::{Field, LocalField};
use ppum::function::westergaard;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use rayon::prelude::*;

/// Exponent of the cut-off q = (1 − r²/R²)^m. It is smooth enough for plain Gauss rules across r = R:
/// with m = 4 their error is seen at 1e-7, with more at 1e-10.
const CUT_OFF_POWER: i32 = 6;

/// Gauss points in each direction of cells that are large in the disc, where the cut-off bends.
const ORDER: usize = 12;

/// Part of the radius below which a cell is small and the order of the assembly is enough.
const SMALL: f64 = 0.2;

/// Discs for each tip.
pub(super) const RINGS: usize = 3;

/// Panels of a loaded face in a disc, and Gauss points of each: loads may bend, or begin somewhere.
const FACE_PANELS: u32 = 8;
const FACE_ORDER: usize = 8;

/// Integrals of both modes over each disc.
type Integrals = [[f64; 2]; RINGS];

/// The interaction integrals around one tip.
pub(super) struct Interaction<'a> {
    field: &'a Field<'a>,
    space: &'a Space<'a>,
    law: LawAt,
    material: Material,
    tip: TipId,
    center: Vec2,
    /// Radii of the discs, ascending.
    radii: [f64; RINGS],
    loads: Loads<'a>,
}

impl<'a> Interaction<'a> {
    /// Prepares the integrals over discs of the given radii, which ascend; the auxiliary fields are
    /// those of the material at the tip. None unless the field is a displacement.
    pub(super) fn new(
        field: &'a Field<'a>,
        space: &'a Space<'a>,
        tip: TipId,
        radii: [f64; RINGS],
        loads: Loads<'a>,
    ) -> Option<Self> {
        let center = field.step.cracks[tip.crack as usize].end_point(tip.end);
        let law = Law::new(field.equation).at(center);
        let material = field.equation.elastic()?.at(center);
        Some(Self { field, space, law, material, tip, center, radii, loads })
    }

    fn largest(&self) -> f64 {
        self.radii[RINGS - 1]
    }

    /// The cells that meet the largest disc.
    fn cells(&self) -> impl Iterator<Item = usize> {
        let cells = &self.space.partition.cell;
        (0..cells.len()).filter(|&c| cells[c].distance(self.center) < self.largest())
    }

    fn cell(&self, c: usize) -> Integrals {
        let cell = &self.space.partition.cell[c];
        let small = cell.size().length() < SMALL * self.radii[0];
        let order = if small { self.space.degree() + 4 } else { ORDER };
        let quadrature = self.space.quadrature(0);
        let coverers = &self.space.coverers[c];
        let rules = quadrature.disc(cell, coverers, self.center, self.largest(), order);
        rules.iter().map(|rule| self.rule(rule)).fold(Integrals::default(), sum)
    }

    /// The part of a rule's points inside the largest disc.
    fn rule(&self, rule: &Rule) -> Integrals {
        let crack = &self.field.step.cracks[self.tip.crack as usize];
        let tip = LocalTip::new(crack, self.tip.end, rule.anchor);
        let point = |offset: Vec2| tip.point([offset.x, offset.y], Side::Above);
        let all = rule.offsets.iter().zip(&rule.weights);
        let near = all.filter(|(o, _)| square(&point(**o)) < self.largest() * self.largest());
        let (offsets, weights): (Vec<Vec2>, Vec<f64>) = near.unzip();
        let mut jets = vec![Jet::constant(0.0); 2 * offsets.len()];
        let local: LocalField<'_> = self.field.at(rule.anchor);
        local.evaluate_over::<1>(&offsets, Side::Above, &rule.patches, &mut jets);
        let mut integrals = Integrals::default();
        for ((&offset, &weight), u) in offsets.iter().zip(&weights).zip(jets.chunks_exact(2)) {
            let force = self.loads.force.map_or([0.0; 2], |force| force(rule.anchor + offset));
            let part = self.at(&point(offset), &in_frame(u, tip.axis), turned(tip.axis, force));
            integrals = sum(integrals, part.map(|modes| modes.map(|m| weight * m)));
        }
        integrals
    }

    /// The integrands at a point: gradient and force in the tip's frame.
    ///
    /// With q,_j = q′/r x_j the parts without q are the same for all discs.
    fn at(&self, point: &TipPoint<f64>, u: &[Vec2; 2], force: Vec2) -> Integrals {
        let auxiliary = auxiliary(&self.material, &westergaard::<f64, 1>(point));
        let along = vec2(point.x, point.y);
        let parts =
            auxiliary.map(|a| (self.flow(u, &a).dot(along), force.x * a[0].x + force.y * a[1].x));
        self.radii.map(|radius| {
            let (q, slope) = cut_off(square(point), radius);
            parts.map(|(flow, work)| slope * flow - q * work)
        })
    }

    /// σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 − σ_ik εᵃ_ik δ_1j, a vector over j.
    fn flow(&self, u: &[Vec2; 2], aux: &[Vec2; 2]) -> Vec2 {
        let (s, sa) = (self.law.flux(u), self.law.flux(aux));
        let work = s[0][0] * aux[0].x + s[0][1] * (aux[0].y + aux[1].x) + s[1][1] * aux[1].y;
        let flow = |j: usize| (0..2).map(|i| s[i][j] * aux[i].x + sa[i][j] * u[i].x).sum::<f64>();
        vec2(flow(0) - work, flow(1))
    }

    /// −∫ t_i uᵃ_i,1 q ds over both faces: what does not come from the cells.
    fn start(&self) -> Integrals {
        let Some(load) = self.loads.faces else { return Integrals::default() };
        sum(self.face(load, Side::Above), self.face(load, Side::Below))
    }

    /// K = E′/2 M
    fn factors(&self, integrals: &Integrals) -> [Ring; RINGS] {
        let factor = 0.5 * self.material.effective_young();
        std::array::from_fn(|k| {
            let [k1, k2] = integrals[k].map(|m| factor * m);
            Ring { r1: 0.0, r2: self.radii[k], k1, k2 }
        })
    }

    /// One face. With r = R s² the integrand has no singularity.
    fn face(&self, load: FaceLoad<'_>, side: Side) -> Integrals {
        let crack = &self.field.step.cracks[self.tip.crack as usize];
        let axis = crack.growth_direction(self.tip.end);
        let mut integrals = Integrals::default();
        for (s, ds) in (0..FACE_PANELS).flat_map(panel) {
            let (r, dr) = (self.largest() * s * s, 2.0 * self.largest() * s * ds);
            let point = on_face(r, self.tip.end, side);
            let traction = load(self.tip.crack, side, self.center - axis * r);
            let t = turned(axis, traction);
            let auxiliary = auxiliary(&self.material, &westergaard::<f64, 1>(&point));
            let part = self.radii.map(|radius| {
                let (q, _) = cut_off(r * r, radius);
                auxiliary.map(|a| -dr * q * (t.x * a[0].x + t.y * a[1].x))
            });
            integrals = sum(integrals, part);
        }
        integrals
    }
}

/// Nodes and weights on a panel of the unit interval.
fn panel(k: u32) -> impl Iterator<Item = (f64, f64)> {
    let at = |k: u32| f64::from(k) / f64::from(FACE_PANELS);
    gauss(FACE_ORDER).on(at(k), at(k + 1))
}

/// The point of a face at the distance `r` behind the tip. *Above* is the tip's left at the last
/// vertex and its right at the first.
fn on_face(r: f64, end: End, side: Side) -> TipPoint<f64> {
    let left = (end == End::Last) == (side == Side::Above);
    TipPoint { x: -r, y: 0.0, sign: if left { 1.0 } else { -1.0 }, branch: 1.0 }
}

/// The integrals around all tips, each over its discs: tips × cells in parallel, sums in order.
pub(super) fn rings(tips: &[Interaction<'_>]) -> Vec<[Ring; RINGS]> {
    let pairs = |k: usize| tips[k].cells().map(move |c| (k, c));
    let work: Vec<_> = (0..tips.len()).flat_map(pairs).collect();
    let parts: Vec<_> = work.par_iter().map(|&(k, c)| tips[k].cell(c)).collect();
    let mut integrals: Vec<_> = tips.iter().map(Interaction::start).collect();
    for ((k, _), part) in work.into_iter().zip(parts) {
        integrals[k] = sum(integrals[k], part);
    }
    tips.iter().zip(integrals).map(|(tip, sums)| tip.factors(&sums)).collect()
}

fn sum(a: Integrals, b: Integrals) -> Integrals {
    std::array::from_fn(|k| [a[k][0] + b[k][0], a[k][1] + b[k][1]])
}

/// r² of a point in the tip's frame.
fn square(point: &TipPoint<f64>) -> f64 {
    point.x * point.x + point.y * point.y
}

/// q and q′(r)/r for r² = `square`; zero outside the disc.
fn cut_off(square: f64, radius: f64) -> (f64, f64) {
    let base = (1.0 - square / (radius * radius)).max(0.0);
    let slope = -2.0 * f64::from(CUT_OFF_POWER) / (radius * radius);
    (base.powi(CUT_OFF_POWER), slope * base.powi(CUT_OFF_POWER - 1))
}

/// A vector in a frame with the given x axis.
fn turned(axis: Vec2, vector: [f64; 2]) -> Vec2 {
    let vector = Vec2::from(vector);
    vec2(axis.dot(vector), axis.cross(vector))
}

/// The displacement gradient in a frame with the given x axis.
fn in_frame(u: &[Jet<f64>], axis: Vec2) -> [Vec2; 2] {
    let (gx, gy) = (turned(axis, [u[0].x, u[0].y]), turned(axis, [u[1].x, u[1].y]));
    [gx * axis.x + gy * axis.y, gy * axis.x - gx * axis.y]
}

/// Displacement gradients of the Williams fields with K_I = 1 and with K_II = 1, in the tip's frame.
///
/// With the Westergaard functions F₁…F₄ and κ of Kolosov, 2μ√(2π) u is
/// ((κ−1)F₁ + F₃, (κ+1)F₂ − F₄) and ((κ+1)F₂ + F₄, −(κ−1)F₁ + F₃).
fn auxiliary(material: &Material, f: &[Jet<f64>; 4]) -> [[Vec2; 2]; 2] {
    let kappa = material.kolosov();
    let scale = 1.0 / (2.0 * material.mu() * std::f64::consts::TAU.sqrt());
    let [f1, f2, f3, f4] = f.map(|jet| vec2(jet.x, jet.y) * scale);
    let (less, more) = (kappa - 1.0, kappa + 1.0);
    [[f1 * less + f3, f2 * more - f4], [f2 * more + f4, f3 - f1 * less]]
}
