//! Error of the given data that a solution does not show: sources, tractions and values.

use super::boundary::BoundaryConditions;
use super::span::unseen;
use crate::assembly::boundary_rules;
use crate::law::Law;
use crate::quadrature::{CellRule, EdgeRule, Quadrature};
use crate::space::TrialSpace;
use crate::terms::{face_law, known_fields};
use crate::watched::{Halt, WorkPhase, in_batches};
use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::Problem;
use std::f64::consts::PI;

/// Part of a cell around a singular point of a known field within which boundaries are not looked
/// at: that field is all there, with no tractions but those of the rounding of places, which have
/// no bound.
const AT_POINT: f64 = 1e-6;

/// The squares of what each cell misses of the data. Advances the stage by their number.
///
/// # Errors
/// Cancelled.
pub(super) fn unseen_data(
    problem: &Problem,
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    law: &Law<'_>,
    stage: &WorkPhase<'_>,
) -> Result<Vec<f64>, Halt> {
    let n = space.partition().len();
    let data = DataResidual {
        problem,
        field,
        space,
        law,
        quadrature: space.quadrature(0),
        boundary: BoundaryConditions::all(problem),
        known: known_fields(problem).into_iter().map(|field| field.at).collect(),
        has_source: problem.source.iter().any(|f| f.formula().constant().is_none()),
    };
    let mut squares = Vec::with_capacity(n);
    let work = |(): &mut (), cell: usize| Ok(data.in_cell(cell));
    in_batches(stage, n, || (), work, |_, square| squares.push(square))?;
    Ok(squares)
}

/// Prescribed data, and the field that should satisfy them.
struct DataResidual<'a> {
    problem: &'a Problem,
    field: &'a Field<'a>,
    space: &'a TrialSpace<'a>,
    law: &'a Law<'a>,
    quadrature: Quadrature<'a>,
    boundary: Vec<BoundaryConditions>,
    /// Singular points of known fields.
    known: Vec<Vec2>,
    /// True if the source varies: a constant is a polynomial.
    has_source: bool,
}

impl DataResidual<'_> {
    fn in_cell(&self, cell: usize) -> f64 {
        let (rect, order) = (&self.space.partition().cell[cell], self.space.order(cell));
        let mut unseen = 0.0;
        for part in self.boundary.iter().filter(|part| part.may_meet(rect)) {
            let cell = self.space.cell(cell);
            let rules = boundary_rules(self.problem, part.on, &self.quadrature, cell);
            unseen +=
                rules.iter().map(|rule| self.on_boundary(part, rule, (rect, order))).sum::<f64>();
        }
        unseen + self.of_source(cell) + self.of_initial_stress(cell)
    }

    /// ∫ |σ⁰ − Π σ⁰|² / C of the stress where the body does not deform, with the best polynomials
    /// of a degree below the order p, which the strains of polynomials have: what the rest of it
    /// does to the energy. Nothing is said of cells with other functions, which may see it.
    fn of_initial_stress(&self, cell: usize) -> f64 {
        let data = &self.space.step().fields[0];
        let has_others = |&patch: &u32| data.blocks(patch as usize).len() > 1;
        if !self.law.has_varying_strains()
            || self.space.covering_patches[cell].iter().any(has_others)
        {
            return 0.0;
        }
        self.unseen_in_cell(cell, &|x| self.law.initial_stress(x).mandel())
    }

    /// (d/(π p))² ∫ |f − Π f|² / C with the cell's diagonal d and the best polynomial Π f of a
    /// degree below the order p: of order 1 the bound of Payne and Weinberger (1960) for what the
    /// rest of the source does to the energy. Nothing is said of cells with user-defined functions:
    /// they are there to see what polynomials do not.
    fn of_source(&self, cell: usize) -> f64 {
        let mut patches = self.space.covering_patches[cell].iter();
        if !self.has_source || patches.any(|&k| self.space.has_user_functions(k as usize)) {
            return 0.0;
        }
        let (rect, order) = (&self.space.partition().cell[cell], self.space.order(cell));
        let d = rect.size().length() / (PI * order.max(1) as f64);
        d * d * self.unseen_in_cell(cell, &|x| self.problem.source_at(x))
    }

    /// ∫ |f − Π f|² / C over a cell.
    fn unseen_in_cell<const N: usize>(&self, cell: usize, f: &dyn Fn(Vec2) -> [f64; N]) -> f64 {
        let (rect, order) = (&self.space.partition().cell[cell], self.space.order(cell));
        let rules = self.space.rules(&self.quadrature, cell);
        let (places, mut values) = values_in_cell(&rules, rect, f);
        unseen(&places, order, &mut values) / self.law.at(rect.center()).modulus(0)
    }

    /// The squares of what the field misses of the tractions and values at the points of a
    /// rule.
    fn on_boundary(
        &self,
        part: &BoundaryConditions,
        rule: &EdgeRule,
        (rect, order): (&Rect, usize),
    ) -> f64 {
        let h = rect.size().x.max(rect.size().y);
        let (p, tips) = (order as f64, self.tips(rule));
        let (local, side) = match rule.face {
            Some(face) => (self.field.on(face.segment, rule.anchor), face.side),
            None => (self.field.at(rule.anchor), Side::Above),
        };
        let law = rule.face.and_then(|face| face_law(self.problem, face.segment.crack));
        let between = law.map(|law| law.tractions(self.field, self.law, rule, h));
        let mut sum = 0.0;
        for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
            let (mut u, x, n) = ([Jet::constant(0.0); 2], rule.anchor + offset, rule.normals[q]);
            local.over_patches::<f64, 1>([offset.x, offset.y], side, &rule.patches, &mut u);
            if !u.iter().all(|jet| jet.v.is_finite()) {
                // a place between patches, up to rounding
                continue;
            }
            let law = self.law.on(x, rule.face.map(|face| (face.segment, face.side)));
            let flux: [f64; 2] = law.stress(&law.strain(&u)).traction(n).into();
            let (held, axes, mut given) = part.given(self.problem, (x, n), u.map(|u| u.v));
            if let Some(between) = &between {
                let state = between[q];
                given = state.traction.into();
                // each face has a half of what is between them
                sum += 0.5 * weight * law.modulus(0) * (p * p + 1.0) / h * state.gap.powi(2);
            }
            let nearest = |p: f64, place: Vec2| p.min((x - place).length());
            let to_tip = tips.iter().copied().fold(f64::INFINITY, nearest);
            let to_point = self.known.iter().copied().fold(f64::INFINITY, nearest);
            if to_point < AT_POINT * h {
                continue;
            }
            let width = (h / (2.0 * (p + 1.0))).min(to_tip).min(to_point);
            let missed = [0, 1].map(|i| u[i].v - given[i]);
            let excess = [0, 1].map(|i| flux[i] - given[i]);
            for i in 0..law.components() {
                sum += weight
                    * if held[i] {
                        law.modulus(i) * (p * p + 1.0) / h * axes[i].dot(missed.into()).powi(2)
                    } else {
                        width / law.modulus(i) * axes[i].dot(excess.into()).powi(2)
                    };
            }
        }
        sum
    }

    /// The tips of the crack whose face a rule lies on: the tractions of tip functions one by one
    /// are not square integrable there, but are with the distance as their weight.
    fn tips(&self, rule: &EdgeRule) -> Vec<Vec2> {
        let crack = rule.face.map(|face| &self.field.step.cracks[face.segment.crack as usize]);
        crack.iter().flat_map(|crack| crack.tips().map(|end| crack.end_point(end))).collect()
    }
}

/// The points of a cell, in units of half its size, with the roots of their weights, and a function
/// there.
fn values_in_cell<const N: usize>(
    rules: &[CellRule],
    rect: &Rect,
    function: &dyn Fn(Vec2) -> [f64; N],
) -> (Vec<(Vec2, f64)>, Vec<Vec<f64>>) {
    let (center, half) = (rect.center(), rect.size() * 0.5);
    let (mut places, mut values) = (Vec::new(), vec![Vec::new(); N]);
    for rule in rules {
        for (x, weight) in rule.points() {
            let (way, root) = (x - center, weight.sqrt());
            places.push((vec2(way.x / half.x, way.y / half.y), root));
            values.iter_mut().zip(function(x)).for_each(|(values, f)| values.push(root * f));
        }
    }
    (places, values)
}
