//! The interaction integral over the cells of a space.

use super::Loads;
use super::auxiliary::{Auxiliary, Gradients, auxiliary};
use super::faces::Faces;
use crate::law::{Law, LawAt};
use crate::quadrature::{Doubt, Quadrature, Rule};
use crate::space::Space;
use crate::watched::Stage;
use ppum::crack::{LocalTip, Side, TipId, TipPoint};
use ppum::dataset::{Material, Ring};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::progress::{Cancelled, Phase, Watcher};
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

/// Integrals of both modes over each disc.
pub(super) type Modes = [[f64; 2]; RINGS];

/// Integrals around a tip.
#[derive(Clone, Copy, Default)]
struct Integrals {
    modes: Modes,
    /// Twice the strain energy in the largest disc.
    energy: f64,
    /// Errors that the rules leave.
    doubt: Doubt,
}

/// The findings at a tip.
pub(super) struct Found {
    pub(super) rings: [Ring; RINGS],
    /// See [`Outcome::strength`](super::Outcome::strength).
    pub(super) strength: f64,
    /// Errors that quadrature leaves in the discs.
    pub(super) doubt: Doubt,
}

/// The interaction integrals around one tip.
pub(super) struct Interaction<'a> {
    field: &'a Field<'a>,
    space: &'a Space<'a>,
    law: Law<'a>,
    /// The law and the material at the tip, those of the auxiliary fields.
    law_at_tip: LawAt,
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
        let law = Law::new(field.equation);
        let law_at_tip = law.at(center);
        let material = field.equation.elastic()?.at(center);
        Some(Self { field, space, law, law_at_tip, material, tip, center, radii, loads })
    }

    fn largest(&self) -> f64 {
        self.radii[RINGS - 1]
    }

    /// The cells that meet the largest disc.
    fn cells(&self) -> impl Iterator<Item = usize> {
        let cells = &self.space.partition().cell;
        (0..cells.len()).filter(|&c| cells[c].distance(self.center) < self.largest())
    }

    fn cell(&self, quadrature: &Quadrature<'_>, c: usize) -> Integrals {
        let cell = &self.space.partition().cell[c];
        let small = cell.size().length() < SMALL * self.radii[0];
        let order = if small { self.space.degree() + 4 } else { ORDER };
        let coverers = &self.space.coverers[c];
        let rules = quadrature.disc(cell, coverers, self.center, self.largest(), order);
        let mut sums = rules.iter().map(|rule| self.rule(rule)).fold(Integrals::default(), sum);
        rules.iter().for_each(|rule| sums.doubt.add(&rule.doubt));
        sums
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
            let place = Place {
                point: point(offset),
                world: rule.anchor + offset,
                u: in_frame(u, tip.axis),
                force: self.force(rule.anchor + offset, tip.axis),
            };
            integrals = sum(integrals, self.at(&place).times(weight));
        }
        integrals
    }

    /// The body force in the tip's frame.
    fn force(&self, at: Vec2, axis: Vec2) -> Vec2 {
        self.loads.force.map_or(Vec2::ZERO, |force| turned(axis, force(at)))
    }

    /// The integrands at a point.
    ///
    /// With q,_j = q′/r x_j the parts without q are the same for all discs.
    fn at(&self, place: &Place) -> Integrals {
        let Place { point, u, .. } = place;
        let along = vec2(point.x, point.y);
        let stresses = self.stresses(place);
        let stress = &stresses.own;
        let energy = (0..2).map(|i| stress[i][0] * u[i].x + stress[i][1] * u[i].y).sum();
        let parts = self.auxiliary(point).map(|a| {
            let flow = self.flow(&stresses, u, &a.gradient);
            (flow.dot(along), divergence(&stresses, place.force, &a))
        });
        let modes = self.radii.map(|radius| {
            let (q, slope) = cut_off(square(point), radius);
            parts.map(|(flow, source)| slope * flow + q * source)
        });
        Integrals { modes, energy, doubt: Doubt::default() }
    }

    fn stresses(&self, place: &Place) -> Stresses {
        let at_tip = self.law_at_tip.flux(&place.u);
        let uniform = self.law.is_uniform();
        let own = if uniform { at_tip } else { self.law.at(place.world).flux(&place.u) };
        Stresses { own, at_tip }
    }

    fn auxiliary(&self, point: &TipPoint<f64>) -> [Auxiliary; 2] {
        let of_order = if self.law.is_uniform() { auxiliary::<1> } else { auxiliary::<2> };
        of_order(&self.material, point)
    }

    /// P_j = σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 − σᵃ_ik ε_ik δ_1j, a vector over j; σᵃ_ik ε_ik is the stress that
    /// the tip's material would have, on εᵃ.
    fn flow(&self, stresses: &Stresses, u: &Gradients, aux: &Gradients) -> Vec2 {
        let (s, sa) = (&stresses.own, self.law_at_tip.flux(aux));
        let work = work(&stresses.at_tip, aux);
        let flow = |j: usize| (0..2).map(|i| s[i][j] * aux[i].x + sa[i][j] * u[i].x).sum::<f64>();
        vec2(flow(0) - work, flow(1))
    }

    /// The part that does not come from the cells: the loads on the faces.
    fn start(&self) -> Integrals {
        let Self { tip, material, radii, .. } = self;
        let crack = &self.field.step.cracks[tip.crack as usize];
        let faces = self.loads.faces.map(|load| Faces { crack, tip: *tip, material, radii, load });
        let modes = faces.map_or_else(Modes::default, |faces| faces.integrals());
        Integrals { modes, energy: 0.0, doubt: Doubt::default() }
    }

    /// K = E′/2 M
    fn found(&self, integrals: &Integrals) -> Found {
        let modulus = self.material.effective_young();
        let rings = std::array::from_fn(|k| {
            let [k1, k2] = integrals.modes[k].map(|m| 0.5 * modulus * m);
            Ring { r1: 0.0, r2: self.radii[k], k1, k2 }
        });
        let strength = (modulus * integrals.energy.max(0.0) / self.largest()).sqrt();
        Found { rings, strength, doubt: integrals.doubt }
    }
}

/// A point, and the field there in the tip's frame.
struct Place {
    point: TipPoint<f64>,
    world: Vec2,
    u: Gradients,
    force: Vec2,
}

/// Stresses of one strain.
struct Stresses {
    /// σ
    own: [[f64; 2]; 2],
    /// In a body of the tip's material.
    at_tip: [[f64; 2]; 2],
}

/// P_j,j = σ_ij (S_tip − S)_ijkl σᵃ_kl,1 − b_i uᵃ_i,1 with the compliance S, written without it:
/// what σ exceeds the stress of the tip's material by, on εᵃ,_1.
fn divergence(stresses: &Stresses, force: Vec2, aux: &Auxiliary) -> f64 {
    let Stresses { own, at_tip } = stresses;
    let excess = std::array::from_fn(|i| std::array::from_fn(|j| own[i][j] - at_tip[i][j]));
    work(&excess, &aux.along) - (force.x * aux.gradient[0].x + force.y * aux.gradient[1].x)
}

/// σ_ij g_i,j of a symmetric stress.
fn work(s: &[[f64; 2]; 2], g: &Gradients) -> f64 {
    s[0][0] * g[0].x + s[0][1] * (g[0].y + g[1].x) + s[1][1] * g[1].y
}

/// Divisions of cells with formulas that vary fast, for all discs together. A cell in a layer takes some hundred; what
/// more would be good for is told by a [`Doubt`].
const MOST_DIVISIONS: usize = 50_000;

/// The same in operations of the formulas, one of which takes these many points in a division.
const DIVISION_OPERATIONS: usize = 1 << 32;
const DIVISION_POINTS: usize = 1 << 10;

/// Pairs of tips and cells that are worked on at a time.
const BATCH: usize = 1 << 14;

/// The integrals around all tips, each over its discs: tips × cells in parallel, sums in order.
///
/// # Errors
/// Cancelled.
pub(super) fn found(
    space: &Space<'_>,
    tips: &[Interaction<'_>],
    watcher: &dyn Watcher,
) -> Result<Vec<Found>, Cancelled> {
    let cells: Vec<Vec<usize>> = tips.par_iter().map(|tip| tip.cells().collect()).collect();
    let pairs = cells.iter().map(Vec::len).sum::<usize>().max(1);
    let stage = Stage::new(watcher, Phase::Intensity, pairs)?;
    let operations = space.probe_operations().max(1);
    let divisions = MOST_DIVISIONS.min(DIVISION_OPERATIONS / (DIVISION_POINTS * operations));
    let quadrature = space.quadrature(0).with_divisions(divisions / pairs);
    let mut integrals: Vec<_> = tips.iter().map(Interaction::start).collect();
    let mut work = (0..tips.len()).flat_map(|k| cells[k].iter().map(move |&c| (k, c)));
    loop {
        let batch: Vec<_> = work.by_ref().take(BATCH).collect();
        if batch.is_empty() {
            break;
        }
        let part =
            |&(k, c): &(usize, usize)| stage.advance(1).map(|()| tips[k].cell(&quadrature, c));
        let parts: Vec<_> = batch.par_iter().map(part).collect();
        for ((k, _), part) in batch.into_iter().zip(parts) {
            integrals[k] = sum(integrals[k], part?);
        }
    }
    Ok(tips.iter().zip(integrals).map(|(tip, sums)| tip.found(&sums)).collect())
}

fn sum(a: Integrals, b: Integrals) -> Integrals {
    let mode = |k: usize, i: usize| a.modes[k][i] + b.modes[k][i];
    let modes = std::array::from_fn(|k| [mode(k, 0), mode(k, 1)]);
    let mut doubt = a.doubt;
    doubt.add(&b.doubt);
    Integrals { modes, energy: a.energy + b.energy, doubt }
}

impl Integrals {
    fn times(self, weight: f64) -> Self {
        let modes = self.modes.map(|modes| modes.map(|m| weight * m));
        Self { modes, energy: weight * self.energy, doubt: self.doubt }
    }
}

/// r² of a point in the tip's frame.
fn square(point: &TipPoint<f64>) -> f64 {
    point.x * point.x + point.y * point.y
}

/// q and q′(r)/r for r² = `square`; zero outside the disc.
pub(super) fn cut_off(square: f64, radius: f64) -> (f64, f64) {
    let base = (1.0 - square / (radius * radius)).max(0.0);
    let slope = -2.0 * f64::from(CUT_OFF_POWER) / (radius * radius);
    (base.powi(CUT_OFF_POWER), slope * base.powi(CUT_OFF_POWER - 1))
}

/// A vector in a frame with the given x axis.
pub(super) fn turned(axis: Vec2, vector: [f64; 2]) -> Vec2 {
    let vector = Vec2::from(vector);
    vec2(axis.dot(vector), axis.cross(vector))
}

/// The displacement gradient in a frame with the given x axis.
fn in_frame(u: &[Jet<f64>], axis: Vec2) -> [Vec2; 2] {
    let (gx, gy) = (turned(axis, [u[0].x, u[0].y]), turned(axis, [u[1].x, u[1].y]));
    [gx * axis.x + gy * axis.y, gy * axis.x - gx * axis.y]
}
