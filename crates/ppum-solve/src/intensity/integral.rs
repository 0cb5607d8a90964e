//! The interaction integral over the cells of a space.

use super::Loads;
use super::auxiliary::{Auxiliary, Body, Gradients, stress};
use super::bent::Bend;
use super::course::Course;
use super::faces::{Faces, pressed};
use super::slope::Slope;
use crate::geometry::{Placed, around};
use crate::law::Law;
use crate::quadrature::{Disc, Doubt, Quadrature, Rule};
use crate::space::Space;
use crate::watched::Stage;
use ppum::crack::{Side, TipId, TipPoint};
use ppum::dataset::{Material, Ring, TipIntensity};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::progress::{Cancelled, Phase, Watcher};
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;

/// Exponent of the cut-off q = (1 − r²/R²)^m. It is smooth enough for plain Gauss rules across r = R:
/// with m = 4 their error is seen at 1e-7, with more at 1e-10.
const CUT_OFF_POWER: i32 = 6;

/// Gauss points in each direction of large pieces and at the tip: the cut-off bends there.
const ORDER: usize = 12;

/// Size of pieces from which on they are large, in radii of the smallest disc. Smaller ones take fewer points, down to the
/// order of the assembly. With 1 that is seen at 1e-8 in discs no larger than the cells.
const ALL_POINTS: f64 = 0.5;

/// Discs for each tip.
pub(super) const RINGS: usize = 3;

/// Auxiliary fields: one for each of K_I, K_II and T.
pub(super) const MODES: usize = 3;

/// Integrals of all modes over each disc.
pub(super) type Modes = [[f64; MODES]; RINGS];

/// Integrals around a tip.
#[derive(Clone, Copy, Default)]
pub(super) struct Integrals {
    pub(super) modes: Modes,
    /// The J-integral over the largest disc.
    pub(super) j: f64,
    /// Twice the strain energy in the largest disc.
    pub(super) energy: f64,
    /// Errors that the rules leave.
    pub(super) doubt: Doubt,
}

/// The findings at a tip.
pub(super) struct Found {
    pub(super) rings: [Ring; RINGS],
    pub(super) t_stress: Option<f64>,
    pub(super) j: Option<f64>,
    /// See [`Outcome::strength`](super::Outcome::strength).
    pub(super) strength: f64,
    /// Errors that quadrature leaves in the discs.
    pub(super) doubt: Doubt,
}

impl Found {
    /// The same as they are stored: the values of the largest disc, whose integral averages most.
    pub(super) fn factors(&self, tip: TipId) -> TipIntensity {
        let Ring { k1, k2, .. } = self.rings[RINGS - 1];
        let Self { t_stress, j, .. } = *self;
        TipIntensity { tip, k1, k2, t_stress, j, error: None, rings: self.rings.to_vec() }
    }
}

/// The interaction integrals around one tip.
pub(super) struct Interaction<'a> {
    pub(super) field: &'a Field<'a>,
    pub(super) space: &'a Space<'a>,
    law: Law<'a>,
    /// The material at the tip, and the body of it that the auxiliary fields are in.
    material: Material,
    pub(super) body: Body,
    /// The crack in the discs.
    pub(super) course: Course,
    pub(super) center: Vec2,
    /// The direction of growth.
    axis: Vec2,
    /// Radii of the discs, ascending.
    pub(super) radii: [f64; RINGS],
    pub(super) loads: Loads<'a>,
    /// How the material varies, as the J-integral needs it; none if it jumps in the discs.
    slope: Option<Slope<'a>>,
    /// σ_22 at the tip by the loads on its faces; none if these have a resultant there.
    pressed: Option<f64>,
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
        let crack = &field.step.cracks[tip.crack as usize];
        let course = Course::new(crack, tip, radii[RINGS - 1]);
        let center = course.center();
        let law = Law::new(field.equation);
        let elastic = field.equation.elastic()?;
        let material = elastic.at(center);
        let body = Body::new(&material);
        let slope = Slope::new(elastic, center, radii[RINGS - 1]);
        let pressed = loads.faces.map_or(Some(0.0), |load| pressed(&course, load));
        Some(Self {
            field,
            space,
            law,
            material,
            body,
            course,
            center,
            axis: crack.growth_direction(tip.end),
            radii,
            loads,
            slope,
            pressed,
        })
    }

    pub(super) fn largest(&self) -> f64 {
        self.radii[RINGS - 1]
    }

    /// The cells that meet the largest disc.
    pub(super) fn cells(&self, cells: &Placed<usize>) -> impl Iterator<Item = usize> {
        let (all, radius) = (&self.space.partition().cell, self.largest());
        let square = Rect::around(self.center, vec2(radius, radius));
        let near = cells.near(&square).copied().collect::<Vec<_>>().into_iter();
        near.filter(move |&c| all[c].distance(self.center) < radius)
    }

    /// The pieces of the crack that are not along the axis, or loaded, in all cells that they may meet.
    fn bends(&self, cells: &Placed<usize>) -> Vec<Bend> {
        let faces = self.faces();
        let mut all = Vec::new();
        for part in self.course.parts().filter(|part| !part.is_first || faces.is_some()) {
            let loads = faces.as_ref().map_or_else(Vec::new, |faces| faces.breaks(&part));
            let at: Vec<f64> = loads.into_iter().chain(self.radii).collect();
            for ends in self.course.pieces(&part, &at) {
                let near = cells.near(&around(&ends));
                all.extend(near.map(|&cell| Bend { part, ends, cell }));
            }
        }
        all
    }

    fn faces(&self) -> Option<Faces<'_>> {
        let Self { course, body, radii, pressed, .. } = self;
        let is_balanced = pressed.is_some();
        self.loads.faces.map(|load| Faces { course, body, radii, load, is_balanced })
    }

    fn cell(
        &self,
        quadrature: &Quadrature<'_>,
        seen: &mut Option<LocalField<'a>>,
        c: usize,
    ) -> Integrals {
        let rules = self.rules(quadrature, c);
        let parts = rules.iter().map(|rule| self.rule(rule, seen));
        let mut sums = parts.fold(Integrals::default(), Integrals::plus);
        rules.iter().for_each(|rule| sums.doubt.add(&rule.doubt));
        sums
    }

    /// The rules for a cell.
    fn rules(&self, quadrature: &Quadrature<'_>, c: usize) -> Vec<Rule> {
        let disc = Disc {
            center: self.center,
            radius: self.largest(),
            scale: ALL_POINTS * self.radii[0],
            order: ORDER,
            least: self.space.degree() + 4,
        };
        quadrature.disc(&self.space.partition().cell[c], &self.space.coverers[c], disc)
    }

    /// The part of a rule's points inside the largest disc. `seen` is the field as it was last looked at: most rules around a
    /// tip have the tip as their anchor.
    fn rule(&self, rule: &Rule, seen: &mut Option<LocalField<'a>>) -> Integrals {
        let tip = self.course.at(rule.anchor);
        let point = |offset: Vec2| tip.point([offset.x, offset.y], Side::Above);
        let all = rule.offsets.iter().zip(&rule.weights);
        let near = all.filter(|(o, _)| square(&point(**o)) < self.largest() * self.largest());
        let (offsets, weights): (Vec<Vec2>, Vec<f64>) = near.unzip();
        let mut jets = vec![Jet::constant(0.0); 2 * offsets.len()];
        let known = seen.take().filter(|local| local.anchor == rule.anchor);
        let local = seen.insert(known.unwrap_or_else(|| self.field.at(rule.anchor)));
        local.evaluate_over::<1>(&offsets, Side::Above, &rule.patches, &mut jets);
        let mut integrals = Integrals::default();
        for ((&offset, &weight), u) in offsets.iter().zip(&weights).zip(jets.chunks_exact(2)) {
            let place = Place {
                point: point(offset),
                world: rule.anchor + offset,
                u: in_frame(u, tip.axis),
                force: self.force(rule.anchor + offset, tip.axis),
            };
            self.add(&place, weight, &mut integrals);
        }
        integrals
    }

    /// The body force in the tip's frame.
    fn force(&self, at: Vec2, axis: Vec2) -> Vec2 {
        self.loads.force.map_or(Vec2::ZERO, |force| turned(axis, force(at)))
    }

    /// Adds the integrands at a point.
    ///
    /// With q,_j = q′/r x_j the parts without q are the same for all discs.
    fn add(&self, place: &Place, weight: f64, sums: &mut Integrals) {
        let Place { point, u, .. } = place;
        let Integrands { stresses, flows, sources } = self.integrands(place);
        for (modes, radius) in sums.modes.iter_mut().zip(self.radii) {
            let (q, slope) = cut_off(square(point), radius);
            for (sum, (flow, source)) in modes.iter_mut().zip(flows.iter().zip(sources)) {
                *sum += weight * (slope * flow + q * source);
            }
        }
        let (q, slope) = cut_off(square(point), self.largest());
        let energy = energy_flow(&stresses.own, u).dot(vec2(point.x, point.y));
        sums.j -= weight * (slope * energy + q * self.energy_source(place));
        sums.energy += weight * work(&stresses.own, u);
    }

    /// P_j x_j, which times q′/r is P_j q_,j, and P_j,j.
    fn integrands(&self, place: &Place) -> Integrands {
        self.integrands_with(place, &self.auxiliary(&place.point))
    }

    /// The same with the auxiliary fields there.
    pub(super) fn integrands_with(
        &self,
        place: &Place,
        auxiliary: &[Auxiliary; MODES],
    ) -> Integrands {
        let Place { point, u, .. } = place;
        let stresses = self.stresses(place);
        let through = self.through(&stresses, u, vec2(point.x, point.y));
        let flows =
            auxiliary.each_ref().map(|a| through[0].dot(a.gradient[0]) + through[1].dot(a.gradient[1]));
        let sources = if self.has_sources() {
            auxiliary.each_ref().map(|a| divergence(&stresses, place.force, a))
        } else {
            [0.0; MODES]
        };
        Integrands { stresses, flows, sources }
    }

    /// E′ at the tip.
    pub(super) fn modulus(&self) -> f64 {
        self.material.effective_young()
    }

    /// False where all flows have no divergence.
    fn has_sources(&self) -> bool {
        self.loads.force.is_some() || !self.law.is_uniform()
    }

    /// E_j,j of the flow of energy: what the material's variation and the body force add to it, ½ ε:C,_1:ε + b_i u_i,1.
    fn energy_source(&self, place: &Place) -> f64 {
        let graded =
            self.slope.as_ref().map_or(0.0, |s| s.energy(place.world, self.axis, &place.u));
        graded + place.force.x * place.u[0].x + place.force.y * place.u[1].x
    }

    /// σ of a gradient at a point.
    pub(super) fn stress(&self, world: Vec2, u: &Gradients) -> [[f64; 2]; 2] {
        let uniform = self.law.is_uniform();
        stress(if uniform { self.body.lame } else { self.law.coefficients(world) }, u)
    }

    fn stresses(&self, place: &Place) -> Stresses {
        let at_tip = stress(self.body.lame, &place.u);
        Stresses { own: self.stress(place.world, &place.u), at_tip }
    }

    pub(super) fn auxiliary(&self, point: &TipPoint<f64>) -> [Auxiliary; MODES] {
        if self.has_sources() { self.body.fields::<2>(point) } else { self.body.fields::<1>(point) }
    }

    /// What P_j x_j is of ∇uᵃ: with σᵃ_ij u_i,1 x_j = C:(u_,1 x) on ∇uᵃ, and P_j = σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 −
    /// σᵃ_ik ε_ik δ_1j, where σᵃ_ik ε_ik is the stress that the tip's material would have, on εᵃ.
    fn through(&self, stresses: &Stresses, u: &Gradients, x: Vec2) -> Gradients {
        let Stresses { own, at_tip } = stresses;
        let dual = stress(self.body.lame, &[x * u[0].x, x * u[1].x]);
        let row = |i: usize| {
            let along = own[i][0] * x.x + own[i][1] * x.y + dual[i][0] - x.x * at_tip[i][0];
            vec2(along, dual[i][1] - x.x * at_tip[i][1])
        };
        [row(0), row(1)]
    }

    /// The part that does not come from the cells: the loads on the faces.
    fn start(&self) -> Integrals {
        let modes = self.faces().map_or_else(Modes::default, |faces| faces.integrals());
        Integrals { modes, ..Integrals::default() }
    }

    /// K = E′/2 M, and T = E′M + σ_22. Of the part of the field that is constant at the tip the force sees ε_11 by its work,
    /// and σ_22 by the opening of its own field, u_2(−π) − u_2(π) = (κ − 1)/(4μ): together E′M = σ_11 − σ_22.
    fn found(&self, integrals: &Integrals) -> Found {
        let modulus = self.modulus();
        let rings = std::array::from_fn(|k| {
            let [m1, m2, _] = integrals.modes[k];
            Ring { r1: 0.0, r2: self.radii[k], k1: 0.5 * modulus * m1, k2: 0.5 * modulus * m2 }
        });
        let of_force = modulus * integrals.modes[RINGS - 1][2];
        let strength = (modulus * integrals.energy.max(0.0) / self.largest()).sqrt();
        Found {
            rings,
            t_stress: self.pressed.map(|pressed| of_force + pressed).filter(|t| t.is_finite()),
            j: self.slope.as_ref().map(|_| integrals.j).filter(|j| j.is_finite()),
            strength,
            doubt: integrals.doubt,
        }
    }
}

/// A point, and the field there in the tip's frame.
pub(super) struct Place {
    pub(super) point: TipPoint<f64>,
    pub(super) world: Vec2,
    pub(super) u: Gradients,
    pub(super) force: Vec2,
}

/// The integrands of all modes at a point.
pub(super) struct Integrands {
    stresses: Stresses,
    pub(super) flows: [f64; MODES],
    pub(super) sources: [f64; MODES],
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
    let row = |i: usize| [own[i][0] - at_tip[i][0], own[i][1] - at_tip[i][1]];
    let excess = [row(0), row(1)];
    work(&excess, &aux.along) - (force.x * aux.gradient[0].x + force.y * aux.gradient[1].x)
}

/// E_j = W δ_1j − σ_ij u_i,1, a vector over j, with W = ½ σ_ij u_i,j: the flow of energy whose integral round a tip is J.
fn energy_flow(stress: &[[f64; 2]; 2], u: &Gradients) -> Vec2 {
    let flow = |j: usize| stress[0][j] * u[0].x + stress[1][j] * u[1].x;
    vec2(0.5 * work(stress, u) - flow(0), -flow(1))
}

/// σ_ij g_i,j of a symmetric stress.
pub(super) fn work(s: &[[f64; 2]; 2], g: &Gradients) -> f64 {
    s[0][0] * g[0].x + s[0][1] * (g[0].y + g[1].x) + s[1][1] * g[1].y
}

/// Divisions of cells with formulas that vary fast, for all discs together. A cell in a layer takes some hundred; what
/// more would be good for is told by a [`Doubt`].
const MOST_DIVISIONS: usize = 50_000;

/// The same in operations of the formulas, one of which takes these many points in a division.
const DIVISION_OPERATIONS: usize = 1 << 32;
const DIVISION_POINTS: usize = 1 << 10;

/// Pieces of work that are done at a time.
const BATCH: usize = 1 << 14;

/// A piece of the work at a tip, given by its number.
enum Work {
    Cell(usize, usize),
    Bend(usize, Bend),
}

/// The integrals around all tips, each over its discs: tips × cells in parallel, sums in order.
///
/// # Errors
/// Cancelled.
pub(super) fn found<'a>(
    space: &Space<'_>,
    tips: &[Interaction<'a>],
    watcher: &dyn Watcher,
) -> Result<Vec<Found>, Cancelled> {
    let near = Placed::new(space.partition().cell.iter().copied().zip(0..));
    let of_tip = |(k, tip): (usize, &Interaction<'_>)| {
        let of_cells = tip.cells(&near).map(|c| Work::Cell(k, c));
        of_cells.chain(tip.bends(&near).into_iter().map(|bend| Work::Bend(k, bend))).collect()
    };
    let work: Vec<Vec<Work>> = tips.par_iter().enumerate().map(of_tip).collect();
    let count = |is_counted: fn(&Work) -> bool| {
        work.iter().flatten().filter(|work| is_counted(work)).count().max(1)
    };
    let cells_of_tips = count(|work| matches!(work, Work::Cell(..)));
    let stage = Stage::new(watcher, Phase::Intensity, count(|_| true))?;
    let operations = space.probe_operations().max(1);
    let divisions = MOST_DIVISIONS.min(DIVISION_OPERATIONS / (DIVISION_POINTS * operations));
    let [quadrature, finer] =
        [0, ORDER].map(|extra| space.quadrature(extra).with_divisions(divisions / cells_of_tips));
    let mut integrals: Vec<_> = tips.iter().map(Interaction::start).collect();
    let mut work = work.into_iter().flatten();
    loop {
        let batch: Vec<_> = work.by_ref().take(BATCH).collect();
        if batch.is_empty() {
            break;
        }
        let part = |seen: &mut Option<LocalField<'a>>, work: &Work| {
            stage.advance(1).map(|()| match work {
                Work::Cell(k, c) => (*k, tips[*k].cell(&quadrature, seen, *c)),
                Work::Bend(k, bend) => (*k, tips[*k].bend(&finer, bend)),
            })
        };
        let parts: Vec<_> = batch.par_iter().map_init(|| None, part).collect();
        for part in parts {
            let (k, part) = part?;
            integrals[k] = integrals[k].plus(part);
        }
    }
    Ok(tips.iter().zip(integrals).map(|(tip, sums)| tip.found(&sums)).collect())
}

impl Integrals {
    pub(super) fn plus(self, other: Self) -> Self {
        let mode = |k: usize| std::array::from_fn(|i| self.modes[k][i] + other.modes[k][i]);
        let mut doubt = self.doubt;
        doubt.add(&other.doubt);
        let (j, energy) = (self.j + other.j, self.energy + other.energy);
        Self { modes: std::array::from_fn(mode), j, energy, doubt }
    }

    pub(super) fn times(self, weight: f64) -> Self {
        let modes = self.modes.map(|modes| modes.map(|m| weight * m));
        Self { modes, j: weight * self.j, energy: weight * self.energy, doubt: self.doubt }
    }
}

/// r² of a point in the tip's frame.
pub(super) fn square(point: &TipPoint<f64>) -> f64 {
    point.x * point.x + point.y * point.y
}

/// q and q′(r)/r for r² = `square`; zero outside the disc.
pub(super) fn cut_off(square: f64, radius: f64) -> (f64, f64) {
    let base = (1.0 - square / (radius * radius)).max(0.0);
    let slope = -2.0 * f64::from(CUT_OFF_POWER) / (radius * radius);
    let power = base.powi(CUT_OFF_POWER - 1);
    (base * power, slope * power)
}

/// A vector in a frame with the given x axis.
pub(super) fn turned(axis: Vec2, vector: [f64; 2]) -> Vec2 {
    let vector = Vec2::from(vector);
    vec2(axis.dot(vector), axis.cross(vector))
}

/// The displacement gradient in a frame with the given x axis.
pub(super) fn in_frame(u: &[Jet<f64>], axis: Vec2) -> Gradients {
    let (gx, gy) = (turned(axis, [u[0].x, u[0].y]), turned(axis, [u[1].x, u[1].y]));
    [gx * axis.x + gy * axis.y, gy * axis.x - gx * axis.y]
}
