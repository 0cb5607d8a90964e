//! The interaction integral over the cells of a space.

use super::auxiliary::{TipMaterialBody, difference, stress};
use super::face_loads::{TipFaces, pressed};
use super::loads::TipLoads;
use super::path::{CrackPiece, PathSegment, TipPath};
use super::sums::{Gradients, Integrals, Modes, RINGS, TipRing, in_frame, tensor_in_frame, turned};
use ppum::crack::{Side, TipId};
use ppum::dataset::{Ring, TipIntensity};
use ppum::edge::Edge;
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::progress::{Cancelled, Phase, Watcher};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::Symmetry;
use ppum_problem::geometry::BoxList;
use ppum_solve::assembly::FACTORS;
use ppum_solve::law::{Coefficients, EnergySlope, FaceLocation, Law, Strain};
use ppum_solve::quadrature::{CellRule, Disc, EdgeRule, Quadrature, QuadratureErrorEstimate};
use ppum_solve::space::TrialSpace;
use ppum_solve::terms::{FaceLaw, FaceTraction};
use ppum_solve::watched::WorkPhase;
use rayon::prelude::*;

/// Gauss points in each direction of large pieces and at the tip: the cut-off bends there.
const ORDER: usize = 12;

/// Size of pieces from which on they are large, in radii of the smallest disc. Smaller ones take
/// fewer points, down to the order of the assembly. With 1 that is seen at 1e-8 in discs no larger
/// than the cells.
const ALL_POINTS: f64 = 0.5;

/// The integrals of a tip, ring by ring, and what follows from them.
pub(super) struct TipIntegrals {
    pub(super) rings: [Ring; RINGS],
    pub(super) t_stress: Option<f64>,
    pub(super) j: Option<f64>,
    /// See [`TipResult::energy_scale`](super::TipResult::energy_scale).
    pub(super) energy_scale: f64,
    /// Errors that quadrature leaves in the discs.
    pub(super) doubt: QuadratureErrorEstimate,
}

impl TipIntegrals {
    /// Returns the factors as they are stored: the values of the largest disc, whose integral
    /// averages most.
    pub(super) fn factors(&self, tip: TipId) -> TipIntensity {
        let Ring { k1, k2, .. } = self.rings[RINGS - 1];
        let Self { t_stress, j, .. } = *self;
        TipIntensity { tip, k1, k2, t_stress, j, error: None, rings: self.rings.to_vec() }
    }
}

/// The interaction integrals around one tip.
pub(super) struct Interaction<'a> {
    pub(super) field: &'a Field<'a>,
    pub(super) space: &'a TrialSpace<'a>,
    pub(super) law: &'a Law<'a>,
    /// The body of the material at the tip that the auxiliary fields are in.
    pub(super) body: TipMaterialBody,
    /// The crack in the discs.
    pub(super) path: TipPath,
    pub(super) center: Vec2,
    /// The direction of growth.
    pub(super) axis: Vec2,
    /// Radii of the discs, ascending.
    pub(super) radii: [f64; RINGS],
    pub(super) loads: &'a dyn TipLoads,
    has_force: bool,
    /// The gradient without stress at the tip, in its frame. The field is taken without it.
    pub(super) shift: Gradients,
    /// The displacement of the tip of a crack that is an arc there, in its frame.
    origin: Vec2,
    /// How the material varies, as the J-integral needs it; none if it jumps in the discs.
    slope: Option<EnergySlope<'a>>,
    /// σ_12 and σ_22 at the tip by the loads on its faces; none if these have a resultant there.
    pressed: Option<Vec2>,
    /// The law between the faces of the crack.
    face_law: Option<FaceLaw>,
    /// The ring that the tip is in a body of revolution.
    pub(super) ring: Option<TipRing>,
    /// The symmetry to the axis of a field of which one half is in the body.
    half: Option<Symmetry>,
}

impl<'a> Interaction<'a> {
    /// Prepares the integrals over discs of the given radii, which ascend; the auxiliary fields are
    /// those of the material at the tip. None unless the field is a displacement.
    pub(super) fn new(
        field: &'a Field<'a>,
        space: &'a TrialSpace<'a>,
        law: &'a Law<'a>,
        tip: TipId,
        radii: [f64; RINGS],
        loads: &'a dyn TipLoads,
    ) -> Option<Self> {
        let crack = &field.step.cracks[tip.crack as usize];
        let path = TipPath::new(crack, tip, radii[RINGS - 1]);
        let center = path.center();
        let axis = crack.growth_direction(tip.end);
        let body = TipMaterialBody::at(field.equation.elastic()?, [center, axis], path.curvature());
        let slope = EnergySlope::new(law.clone(), center, radii[RINGS - 1]);
        let free = law.at(center).elastic(&Strain::default()).in_plane().map(|row| -row);
        let is_finite = |g: &Gradients| g.as_flattened().iter().all(|e| e.is_finite());
        let shift = Some(tensor_in_frame(&free, axis)).filter(is_finite).unwrap_or_default();
        let origin = if body.curvature == 0.0 {
            Vec2::ZERO
        } else {
            turned(axis, displacement(field, center))
        };
        let half = loads.symmetry(tip);
        let is_loaded = loads.traction(tip.crack, Side::Above, center).is_some();
        let pressed = if is_loaded { pressed(&path, loads, half) } else { Some(Vec2::ZERO) };
        let face_law = loads.face_law(tip.crack);
        let between =
            face_law.map_or(0.0, |of| of.pressed(field, law, path.behind_tip(0.0), radii[0]));
        let own = Self {
            field,
            space,
            law,
            face_law,
            body,
            path,
            center,
            axis,
            shift,
            origin,
            radii,
            loads,
            has_force: loads.body_force(center).is_some(),
            slope,
            pressed: pressed.map(|pressed| pressed + vec2(0.0, between)),
            ring: None,
            half,
        };
        let ring = own.tip_ring(displacement(field, center));
        Some(Self { ring, ..own })
    }

    /// Takes the field relative to another displacement of the tip.
    #[cfg(test)]
    pub(super) fn set_origin(&mut self, displacement: [f64; 2]) {
        self.origin = turned(self.axis, displacement);
    }

    pub(super) fn largest(&self) -> f64 {
        self.radii[RINGS - 1]
    }

    /// True if the faces touch at the tip or within a quarter of a cell of this size from it.
    pub(super) fn touches(&self, cell: f64) -> bool {
        let is_closed = |of: FaceLaw| {
            let points = [0.0, 0.125, 0.25].map(|part| self.path.behind_tip(part * cell));
            let pressed = |at| of.pressed(self.field, self.law, at, self.radii[0]);
            points.into_iter().any(|at| pressed(at) < 0.0)
        };
        self.face_law.is_some_and(is_closed)
    }

    /// The cells that meet the largest disc.
    pub(super) fn cells(&self, cells: &BoxList<usize>) -> impl Iterator<Item = usize> {
        let (all, radius) = (&self.space.partition().cell, self.largest());
        let square = Rect::around(self.center, vec2(radius, radius));
        let near = cells.near(&square).copied().collect::<Vec<_>>().into_iter();
        near.filter(move |&c| all[c].distance(self.center) < radius)
    }

    /// The pieces of the crack that are not part of the edge at the tip, or loaded, in all cells
    /// that they may meet.
    fn crack_pieces(&self, cells: &BoxList<usize>) -> Vec<CrackPiece> {
        let in_cells = |(part, edge): (PathSegment, Edge)| {
            let near = cells.near(&edge.bounds());
            near.map(move |&cell| CrackPiece { part, edge, cell }).collect::<Vec<_>>()
        };
        self.pieces_of_faces().into_iter().flat_map(in_cells).collect()
    }

    /// The pieces of the crack that are not part of the edge at the tip, or loaded.
    pub(super) fn pieces_of_faces(&self) -> Vec<(PathSegment, Edge)> {
        let faces = self.faces();
        let mut all = Vec::new();
        let is_loaded = faces.is_some() || self.face_law.is_some();
        for part in self.path.parts().filter(|part| !part.is_first || is_loaded) {
            let loads = faces.as_ref().map_or_else(Vec::new, |faces| faces.breaks(&part));
            let at: Vec<f64> = loads.into_iter().chain(self.radii).collect();
            all.extend(self.path.pieces(&part, &at).into_iter().map(|edge| (part, edge)));
        }
        all
    }

    /// The tractions between faces that touch, at the points of a rule on one face in a cell, in
    /// the tip's frame; zero at other tips.
    pub(super) fn between(&self, rule: &EdgeRule, cell: usize) -> Vec<Vec2> {
        let size = self.space.partition().cell[cell].size();
        let size = size.x.max(size.y);
        let all = self.face_law.map(|of| of.tractions(self.field, self.law, rule, size));
        let in_frame = |state: FaceTraction| turned(self.axis, state.traction.into());
        all.into_iter().flatten().map(in_frame).collect()
    }

    fn faces(&self) -> Option<TipFaces<'_>> {
        let Self { path, body, radii, pressed, .. } = self;
        let (is_balanced, is_half) = (pressed.is_some(), self.half.is_some());
        self.loads.traction(path.tip().crack, Side::Above, self.center)?;
        let is_axisymmetric = self.ring.is_some();
        let load = self.loads;
        Some(TipFaces { path, body, radii, load, is_balanced, is_half, is_axisymmetric })
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
    fn rules(&self, quadrature: &Quadrature<'_>, c: usize) -> Vec<CellRule> {
        let disc = Disc {
            center: self.center,
            radius: self.largest(),
            scale: ALL_POINTS * self.radii[0],
            order: ORDER,
            least: self.space.degree() + 4,
        };
        quadrature.disc(self.space.cell(c), disc)
    }

    /// The number of halves, alike in the integrals of symmetric and of antisymmetric fields, that
    /// those over the body stand for.
    pub(super) fn halves(&self) -> [f64; FACTORS] {
        match self.half {
            None => [1.0; FACTORS],
            Some(Symmetry::Symmetric) => [2.0, 0.0],
            Some(Symmetry::Antisymmetric) => [0.0, 2.0],
        }
    }

    /// The factors of the integrals over the body in K.
    pub(super) fn kernel_factors(&self) -> [f64; FACTORS] {
        let circle = self.ring.map_or(1.0, |ring| ring.circumference);
        self.halves().map(|halves| 0.5 * self.modulus() * halves / circle)
    }

    /// E′ at the tip.
    pub(super) fn modulus(&self) -> f64 {
        self.body.modulus
    }

    /// False where all flows have no divergence.
    pub(super) fn has_sources(&self) -> bool {
        self.has_force || !self.law.is_uniform() || self.law.has_initial_stress()
    }

    /// ∇u of the jets at a point without the gradient that has no stress at the tip, in its frame.
    pub(super) fn gradient(&self, u: &[Jet<f64>], axis: Vec2) -> Gradients {
        difference(&in_frame(u, axis), &self.shift)
    }

    /// The part of ∇u that has stress at a point, in the tip's frame.
    pub(super) fn elastic(
        &self,
        u: &[Jet<f64>],
        (world, face): (Vec2, FaceLocation),
        axis: Vec2,
    ) -> Gradients {
        if !self.law.has_initial_stress() {
            return in_frame(u, axis);
        }
        let law = self.law.on(world, face);
        tensor_in_frame(&law.elastic(&law.strain(u)).in_plane(), axis)
    }

    /// The direction w in which the crack goes on if it is turned about its centre of curvature, in
    /// the tip's frame: along the axis at the tip, and along the arc.
    pub(super) fn way(&self, world: Vec2) -> Vec2 {
        vec2(1.0, 0.0)
            + turned(self.axis, (world - self.center).into()).left() * self.body.curvature
    }

    /// The field at a point without what has no stress at the tip.
    pub(super) fn turned_field(&self, u: &[Jet<f64>], world: Vec2, axis: Vec2) -> TurnedField {
        let (gradient, way) = (self.gradient(u, axis), self.way(world));
        let at = turned(axis, (world - self.center).into());
        let along = |g: &Gradients, way: Vec2| Vec2::from(g.map(|row| Vec2::from(row).dot(way)));
        let value = turned(axis, [u[0].v, u[1].v]) - self.origin;
        let displacement = value - along(&self.shift, at);
        let turned = displacement.left() * self.body.curvature;
        TurnedField { displacement, derivative: (along(&gradient, way) - turned).into(), gradient }
    }

    /// E_j,j of the flow of energy: W_,w at a fixed ∇u, and what the body force adds to it,
    /// b_i 𝓛u_i. Given strains that are not turned with the body do work, too.
    pub(super) fn energy_source(&self, world: Vec2, force: [f64; 2], u: &[Jet<f64>]) -> f64 {
        let of = self.turned_field(u, world, self.axis);
        let way = self.way(world);
        let way = self.axis * way.x + self.axis.left() * way.y;
        let slope = self.slope.as_ref().map_or(0.0, |s| s.at(world, way, u));
        let turned =
            if self.body.curvature == 0.0 { 0.0 } else { self.turned_strain(&of, u, world) };
        slope + force[0] * of.derivative[0] + force[1] * of.derivative[1] + turned
    }

    /// q σ : (e₃ × η − η × e₃) of the strain η that is given beyond that at the tip.
    fn turned_strain(&self, of: &TurnedField, u: &[Jet<f64>], world: Vec2) -> f64 {
        let elastic = self.elastic(u, (world, None), self.axis);
        let stress = stress(self.moduli(world), &elastic);
        let given = difference(&of.gradient, &elastic);
        let shear = given[0][1] + given[1][0];
        self.body.curvature
            * (2.0 * stress[0][1] * (given[0][0] - given[1][1])
                - shear * (stress[0][0] - stress[1][1]))
    }

    /// The coefficients of the law at a point, in the frame of the tip.
    pub(super) fn moduli(&self, world: Vec2) -> Coefficients {
        if self.law.is_uniform() {
            return self.body.moduli;
        }
        self.body.in_frame(self.law.coefficients(world), self.axis)
    }

    /// The part that does not come from the cells: the loads on the faces.
    pub(super) fn start(&self) -> Integrals {
        let modes = self.faces().map_or_else(Modes::default, |faces| faces.integrals());
        Integrals { modes, ..Integrals::default() }
    }

    /// K = E′/2 M, and T = E′M + σ_22. The part of the field that is constant at the tip adds ε_11
    /// by the work of the force, and σ_22 by the opening of its own field, u_2(−π) − u_2(π) = (κ −
    /// 1)/(4μ): together E′M = σ_11 − σ_22.
    pub(super) fn integrals(&self, integrals: &Integrals) -> TipIntegrals {
        let (modulus, [one, two]) = (self.modulus(), self.halves());
        let (circle, hoop) = self.ring.map_or((1.0, 0.0), |ring| {
            (ring.circumference, modulus * self.body.poisson() * ring.elastic)
        });
        let integrals = &integrals.times(one.max(two) / circle);
        let [one, two] = [one, two].map(|halves| halves.min(1.0));
        let rings = std::array::from_fn(|k| {
            let [m1, m2, _] = integrals.modes[k];
            let [k1, k2] = [one * m1, two * m2].map(|m| 0.5 * modulus * m);
            Ring { r1: 0.0, r2: self.radii[k], k1, k2 }
        });
        let of_force = one * modulus * integrals.modes[RINGS - 1][2];
        let [shear, across] = self.body.faces;
        let of_faces = |at: Vec2| of_force + hoop + (shear * at.x + across * at.y);
        let energy_scale = (modulus * integrals.energy.max(0.0) / self.largest()).sqrt();
        TipIntegrals {
            rings,
            t_stress: self.pressed.map(of_faces).filter(|t| t.is_finite()),
            j: self.slope.as_ref().map(|_| integrals.j).filter(|j| j.is_finite()),
            energy_scale,
            doubt: integrals.doubt,
        }
    }
}

/// A field at a point in the frame of a tip, without the motion and the strain at the tip.
pub(super) struct TurnedField {
    pub(super) displacement: Vec2,
    pub(super) gradient: Gradients,
    /// 𝓛u, its change if it is turned with the crack: u_,1 where that is straight.
    pub(super) derivative: [f64; 2],
}

/// The displacement at a point.
fn displacement(field: &Field<'_>, at: Vec2) -> [f64; 2] {
    let mut jets = vec![Jet::constant(0.0); field.components()];
    field.at(at).evaluate::<0>(Vec2::ZERO, Side::Above, &mut jets);
    [jets[0].v, jets[1].v]
}

/// Divisions of cells with formulas that vary fast, for all discs together. A cell in a layer takes
/// some hundred; a [`QuadratureErrorEstimate`] reports the errors that more of them would remove.
const MOST_DIVISIONS: usize = 50_000;

/// The limit in operations of the formulas: a division evaluates them at this many points.
const DIVISION_OPERATIONS: usize = 1 << 32;
const DIVISION_POINTS: usize = 1 << 10;

/// Pieces of work that are done at a time.
const BATCH: usize = 1 << 14;

/// A region to integrate over at a tip, which its number gives.
enum TipRegion {
    Cell(usize, usize),
    Crack(usize, CrackPiece),
    /// All elements of a mesh.
    Mesh(usize),
}

/// The integrals around all tips, each over its discs: tips × cells in parallel, sums in order.
///
/// # Errors
/// Cancelled.
pub(super) fn integrate_tips<'a>(
    space: &TrialSpace<'_>,
    tips: &[Interaction<'a>],
    watcher: &dyn Watcher,
) -> Result<Vec<TipIntegrals>, Cancelled> {
    let near = BoxList::new(space.partition().cell.iter().copied().zip(0..));
    let of_tip = |(k, tip): (usize, &Interaction<'_>)| {
        if tip.is_on_mesh() {
            return vec![TipRegion::Mesh(k)];
        }
        let of_cells = tip.cells(&near).map(|c| TipRegion::Cell(k, c));
        of_cells
            .chain(tip.crack_pieces(&near).into_iter().map(|bend| TipRegion::Crack(k, bend)))
            .collect()
    };
    let work: Vec<Vec<TipRegion>> = tips.par_iter().enumerate().map(of_tip).collect();
    let count = |is_counted: fn(&TipRegion) -> bool| {
        work.iter().flatten().filter(|work| is_counted(work)).count().max(1)
    };
    let cells_of_tips = count(|work| matches!(work, TipRegion::Cell(..)));
    let stage = WorkPhase::new(watcher, Phase::Intensity, count(|_| true))?;
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
        let part = |seen: &mut Option<LocalField<'a>>, work: &TipRegion| {
            stage.advance(1)?;
            Ok::<_, Cancelled>(match work {
                TipRegion::Cell(k, c) => (*k, tips[*k].cell(&quadrature, seen, *c)),
                TipRegion::Crack(k, bend) => (*k, tips[*k].on_crack(&finer, bend)),
                TipRegion::Mesh(k) => (*k, tips[*k].mesh(&stage)?),
            })
        };
        let parts: Vec<_> = batch.par_iter().map_init(|| None, part).collect();
        for part in parts {
            let (k, part) = part?;
            integrals[k] = integrals[k].plus(part);
        }
    }
    Ok(tips.iter().zip(integrals).map(|(tip, sums)| tip.integrals(&sums)).collect())
}
