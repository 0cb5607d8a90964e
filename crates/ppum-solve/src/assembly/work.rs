//! The work of all that is given on a field: the right-hand side of a problem, with the field in
//! place of the functions of a space.
//!
//! ```text
//! f(w) = ∫ t·w ds + ∫ b·w dA + ∫ σ(w):ε⁰ dA + Σ F·w(x₀) + ∫ h g·w ds − ∫ (σ(w) n)·g ds
//! ```
//!
//! On boundaries that are held w is nothing but for its error. Nitsche's penalty of it, β ∫ w·g ds,
//! is what makes the traction of a solution converge like its energy, so a step may have β of each
//! cell.

use super::boundary::CellBoundary;
use super::cell::SourceTerm;
use super::loads::boundary_rules;
use super::prescribed::PrescribedData;
use crate::law::{Law, Strain};
use crate::quadrature::{CellRule, CrackFace, EdgeRule};
use crate::space::TrialSpace;
use crate::terms::known_fields;
use crate::watched::{Halt, WorkPhase, in_batches};
use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use ppum_problem::{BoundaryPart, Problem};
use rayon::prelude::*;

/// Gauss points more in each direction than the rules of the system have: weight functions have the
/// cut-off of a disc.
const EXTRA: usize = 4;

/// The name of the values of cells that are Nitsche's β over the largest modulus on the boundary.
pub const PENALTY: &str = "penalty";

/// A field whose work is wanted, with the cells to integrate over and the law of the body.
#[derive(Clone, Copy)]
pub struct WorkOnField<'a> {
    /// The field, a displacement.
    pub field: &'a Field<'a>,
    /// The walks over its step.
    pub space: &'a TrialSpace<'a>,
    /// The law of the loaded body, with the given strains.
    pub law: &'a Law<'a>,
}

impl WorkOnField<'_> {
    /// The work of all that a problem gives. Advances the stage by the number of cells.
    ///
    /// # Errors
    /// Work that is not finite, with its place; cancelled.
    pub fn of(
        &self,
        problem: &Problem,
        given: &PrescribedData<'_>,
        stage: &WorkPhase<'_>,
    ) -> Result<f64, Halt> {
        let mut sum = self.of_forces(problem);
        let quadrature = self.space.quadrature(EXTRA);
        in_batches(
            stage,
            self.space.partition().len(),
            || (),
            |(), cell| {
                let mut part = 0.0;
                let pieces = given.boundary(self.space, &quadrature, cell);
                let penalty = self.penalty(cell, &pieces);
                for piece in &pieces {
                    part += self.on_boundary(piece, penalty);
                }
                let source = given.source(cell);
                let shared = source.filter(|source| source.rules.is_none());
                if shared.is_some() || self.law.has_initial_stress() {
                    for rule in &quadrature.cell(self.space.cell(cell)) {
                        part += self.inside(rule, shared, self.law.has_initial_stress());
                    }
                }
                for rule in source.and_then(|source| source.rules).unwrap_or_default() {
                    part += self.inside(rule, source, false);
                }
                let rect = self.space.partition().cell[cell];
                part.is_finite().then_some(part).ok_or(Halt::at(rect))
            },
            |_, part| sum += part,
        )?;
        Ok(sum)
    }

    /// Σ F·w(x₀)
    fn of_forces(&self, problem: &Problem) -> f64 {
        let at = |place: Vec2, face: Option<CrackFace>, load: Vec2| {
            let (mut local, side) = self.seen_from(place, face);
            let mut w = [Jet::constant(0.0); 2];
            local.evaluate::<0>(Vec2::ZERO, side, &mut w);
            w[0].v * load.x + w[1].v * load.y
        };
        let all = known_fields(problem).into_iter();
        all.map(|force| at(force.at, force.face.map(CrackFace::from), force.load)).sum()
    }

    fn seen_from(
        &self,
        anchor: Vec2,
        face: Option<CrackFace>,
    ) -> (ppum::field::LocalField<'_>, Side) {
        match face {
            Some(CrackFace { segment, side }) => (self.field.on(segment, anchor), side),
            None => (self.field.at(anchor), Side::Above),
        }
    }

    /// The field at the points of a rule, two components a point.
    fn on_edge(&self, rule: &EdgeRule) -> Vec<Jet<f64>> {
        let mut jets = vec![Jet::constant(0.0); 2 * rule.offsets.len()];
        let (local, side) = self.seen_from(rule.anchor, rule.face);
        local.evaluate_over::<1>(&rule.offsets, side, &rule.patches, &mut jets);
        jets
    }

    fn in_cell(&self, rule: &CellRule) -> Vec<Jet<f64>> {
        let mut jets = vec![Jet::constant(0.0); 2 * rule.offsets.len()];
        let local = self.field.at(rule.anchor);
        local.evaluate_over::<1>(&rule.offsets, Side::Above, &rule.patches, &mut jets);
        jets
    }

    /// Nitsche's β in a cell.
    fn penalty(&self, cell: usize, pieces: &[CellBoundary<'_>]) -> f64 {
        let all = self.field.step.attributes.iter().find(|values| values.name == PENALTY);
        let Some(penalty) = all.map(|all| all.values[cell]) else { return 0.0 };
        let mut modulus = 0.0_f64;
        for piece in pieces.iter().filter(|piece| piece.exchange.is_none() && !piece.is_exact) {
            for (x, ..) in piece.rules.iter().flat_map(EdgeRule::points) {
                let law = self.law.at(x);
                let held = (0..2).filter(|&i| piece.held[i]);
                modulus = held.fold(modulus, |most, i| most.max(law.modulus(i)));
            }
        }
        penalty * modulus
    }

    /// The work of tractions and given values on a piece of a cell's boundary.
    fn on_boundary(&self, piece: &CellBoundary<'_>, penalty: f64) -> f64 {
        let mut sum = 0.0;
        for rule in piece.own.unwrap_or(&piece.rules) {
            let jets = self.on_edge(rule);
            for ((x, normal, weight), w) in rule.points().zip(jets.chunks_exact(2)) {
                sum += weight * self.at_border(piece, penalty, (x, normal), w);
            }
        }
        sum
    }

    fn at_border(
        &self,
        piece: &CellBoundary<'_>,
        penalty: f64,
        (x, normal): (Vec2, Vec2),
        w: &[Jet<f64>],
    ) -> f64 {
        let (values, value) = ((piece.values)(x, normal), Vec2 { x: w[0].v, y: w[1].v });
        let law = self.law.at(x);
        let traction = law.linear_stress(&law.strain(w)).traction(normal);
        let exchange = piece.exchange.map_or(0.0, |exchange| exchange.value(x));
        let initial = self.law.initial_stress(x).traction(normal);
        let part = |i: usize| {
            let axis = piece.axes[i];
            match (piece.held[i], piece.exchange.is_some()) {
                (false, _) => values[i] * value.dot(axis),
                (true, true) => exchange * values[i] * value.dot(axis),
                (true, false) => {
                    let held = if piece.is_exact { 0.0 } else { penalty * values[i] };
                    (initial.dot(axis) + held) * value.dot(axis) - values[i] * traction.dot(axis)
                }
            }
        };
        part(0) + part(1)
    }

    /// The work of a source, and of the given strains if they count, at the points of a rule.
    fn inside(&self, rule: &CellRule, source: Option<SourceTerm<'_>>, with_strains: bool) -> f64 {
        let (jets, mut sum) = (self.in_cell(rule), 0.0);
        for ((x, weight), w) in rule.points().zip(jets.chunks_exact(2)) {
            if let Some(source) = source {
                let [a, b] = (source.values)(x);
                sum += weight * (a * w[0].v + b * w[1].v);
            }
            if with_strains {
                let law = self.law.at(x);
                let initial = law.stress(&Strain::default());
                let strain = law.strain(w);
                sum -= weight * (0..2).map(|i| initial.row_work(&strain, i)).sum::<f64>();
            }
        }
        sum
    }
}

/// The influence of what acts at points: their places, and the work of unit loads there times the
/// weight of the point.
#[derive(Clone, Debug, Default)]
pub struct Influence {
    /// The points.
    pub at: Vec<Vec2>,
    /// The normals out of the body; zero inside.
    pub normals: Vec<Vec2>,
    /// True of points on the face to the right of a crack.
    pub below: Vec<bool>,
    /// The work of forces along x and y.
    pub forces: Vec<[f64; 2]>,
    /// The work of strains xx, yy and 2xy; none on boundaries.
    pub strains: Vec<[f64; 3]>,
}

impl WorkOnField<'_> {
    /// The influence of tractions on a part of the boundary.
    #[must_use]
    pub fn influence_on(&self, problem: &Problem, on: BoundaryPart) -> Influence {
        let (mut all, quadrature) = (Influence::default(), self.space.quadrature(EXTRA));
        for cell in 0..self.space.partition().len() {
            for rule in boundary_rules(problem, on, &quadrature, self.space.cell(cell)) {
                let below = rule.face.is_some_and(|face| face.side == Side::Below);
                let jets = self.on_edge(&rule);
                for ((x, normal, weight), w) in rule.points().zip(jets.chunks_exact(2)) {
                    all.at.push(x);
                    all.normals.push(normal);
                    all.below.push(below);
                    all.forces.push([weight * w[0].v, weight * w[1].v]);
                }
            }
        }
        all
    }

    /// The influence of forces and strains inside.
    #[must_use]
    pub fn influence_inside(&self) -> Influence {
        let (mut all, quadrature) = (Influence::default(), self.space.quadrature(EXTRA));
        for cell in 0..self.space.partition().len() {
            for rule in &quadrature.cell(self.space.cell(cell)) {
                let jets = self.in_cell(rule);
                for ((x, weight), w) in rule.points().zip(jets.chunks_exact(2)) {
                    let law = self.law.at(x);
                    let [[xx, xy, _], [_, yy, _]] = law.linear_stress(&law.strain(w)).0;
                    all.at.push(x);
                    all.normals.push(Vec2::ZERO);
                    all.below.push(false);
                    all.forces.push([weight * w[0].v, weight * w[1].v]);
                    all.strains.push([xx, yy, xy].map(|stress| weight * stress));
                }
            }
        }
        all
    }
}

impl WorkOnField<'_> {
    /// ∫ ε(u) : (δC − ρ C) : ε(w) dA of another field u, if the law differs by δC from one before;
    /// ρ C is that of the mean of both.
    #[must_use]
    pub fn of_change(&self, u: &Field<'_>, before: &Law<'_>, ratio: f64) -> f64 {
        let quadrature = self.space.quadrature(EXTRA);
        let in_cell = |cell: usize| {
            let mut sum = 0.0;
            for rule in &quadrature.cell(self.space.cell(cell)) {
                let (jets, mut local) = (self.in_cell(rule), u.at(rule.anchor));
                for (&offset, (weight, w)) in
                    rule.offsets.iter().zip(rule.weights.iter().zip(jets.chunks_exact(2)))
                {
                    let mut jets = vec![Jet::constant(0.0); u.components()];
                    local.evaluate::<1>(offset, Side::Above, &mut jets);
                    let laws = [before, self.law].map(|law| law.at(rule.anchor + offset));
                    let [a, b] =
                        laws.map(|law| law.linear_stress(&law.strain(&jets)).work(&law.strain(w)));
                    sum += weight * ((b - a) - ratio * 0.5 * (a + b));
                }
            }
            sum
        };
        let parts: Vec<f64> =
            (0..self.space.partition().len()).into_par_iter().map(in_cell).collect();
        parts.iter().sum()
    }
}
