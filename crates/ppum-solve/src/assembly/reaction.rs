//! Reactions: the resultant force and moment that restraints exert on the body.
//!
//! ```text
//! R_k = ∫ m_k,i t_i     t_i = (C(ε(u) − ε⁰) n)_i − β (u_i − g_i)     over the i that are held
//! ```
//!
//! m_k are the rigid-body modes. With Nitsche's own β the system, tested with a rigid-body mode,
//! says just that the reactions balance the loads: what differs is rounding, however coarse
//! the cells.

use super::functions::CellFunctions;
use super::spring::dot;
use crate::basis::StableBasis;
use crate::law::{MODES, PerMode, RigidModes};
use ppum::dataset::Reaction;
use ppum_linear::BlockMatrix;
use ppum_problem::{BoundaryCondition, Problem, restraint_words};

/// The modes that reactions do work on: the moment is about the centre of the box.
pub(crate) fn modes(problem: &Problem) -> RigidModes {
    RigidModes::new(problem.domain().bounds.center(), 1.0, &problem.equation)
}

/// Integrals over the boundary of a cell where one condition gives values, for every rigid-body
/// mode m.
#[derive(Clone, Debug)]
pub(crate) struct Restraint {
    /// Number of the condition.
    pub(crate) condition: usize,
    /// ∫ m_i (σ(N) n)_i, one number per unknown of the cell.
    traction: [Vec<f64>; MODES],
    /// ∫ m_i N_i
    value: [Vec<f64>; MODES],
    /// ∫ m_i g_i
    given: PerMode,
    /// ∫ m_i (C ε⁰ n)_i
    prestress: PerMode,
}

impl Restraint {
    pub(crate) fn new(condition: usize, unknowns: usize) -> Self {
        let zero = || std::array::from_fn(|_| vec![0.0; unknowns]);
        Self {
            condition,
            traction: zero(),
            value: zero(),
            given: [0.0; MODES],
            prestress: [0.0; MODES],
        }
    }

    /// Adds points with the values that each mode takes there, times the roots of their weights:
    /// rows of tractions and values are functions at these points, times the roots.
    pub(crate) fn add(
        &mut self,
        modes: &[Vec<f64>],
        tractions: FunctionRows<'_>,
        values: FunctionRows<'_>,
    ) {
        for (sums, (functions, rows)) in
            [(&mut self.traction, tractions), (&mut self.value, values)]
        {
            for (sum, mode) in sums.iter_mut().zip(modes) {
                for (q, m) in mode.iter().enumerate() {
                    let rows = rows.iter().enumerate();
                    rows.for_each(|(a, &row)| sum[row] += m * functions[(a, q)]);
                }
            }
        }
    }

    /// Adds the data that are given at points where the modes have these values, and the tractions
    /// that given strains take away, all times the roots.
    pub(crate) fn give(&mut self, modes: &[Vec<f64>], given: &[f64], prestress: &[f64]) {
        for (k, mode) in modes.iter().enumerate() {
            self.given[k] += dot(mode, given);
            self.prestress[k] += dot(mode, prestress);
        }
    }

    /// The reaction as a function of the cell's unknowns, now that β is known.
    pub(crate) fn finish(self, beta: f64) -> CellReaction {
        let (mut work, value) = (self.traction, self.value);
        for (work, value) in work.iter_mut().zip(&value) {
            work.iter_mut().zip(value).for_each(|(work, value)| *work -= beta * value);
        }
        let given = std::array::from_fn(|k| beta * self.given[k] - self.prestress[k]);
        CellReaction { condition: self.condition, work, given }
    }
}

/// Functions at points, and the cell's unknown of each row.
type FunctionRows<'a> = (faer::MatRef<'a, f64>, &'a [usize]);

/// R_k = work_k · u + given_k, u the cell's unknowns.
#[derive(Clone, Debug)]
pub(crate) struct CellReaction {
    condition: usize,
    work: [Vec<f64>; MODES],
    given: PerMode,
}

/// The reactions of all cells, in the order of the cells.
#[derive(Default)]
pub struct Reactions(Vec<(CellFunctions, Vec<CellReaction>)>);

impl Reactions {
    /// Adds those of the next cell.
    pub(crate) fn push(&mut self, functions: CellFunctions, parts: Vec<CellReaction>) {
        if !parts.is_empty() {
            self.0.push((functions, parts));
        }
    }

    /// The reactions of a solution in the order of the matrix, one entry per condition that
    /// gives values.
    pub fn of(
        &self,
        problem: &Problem,
        basis: &StableBasis,
        matrix: &BlockMatrix,
        solution: &[f64],
    ) -> Vec<Reaction> {
        let components = problem.components();
        let mut sums = vec![[0.0; MODES]; problem.boundary.len()];
        for (functions, parts) in &self.0 {
            let unknowns = functions.take_from(basis, matrix, components, solution);
            for part in parts {
                for (k, sum) in sums[part.condition].iter_mut().enumerate() {
                    let terms = part.work[k].iter().zip(&unknowns).map(|(w, u)| w * u);
                    *sum += terms.sum::<f64>() + part.given[k];
                }
            }
        }
        let holding = problem.boundary.iter().zip(sums).filter(|(c, _)| c.held().contains(&true));
        let reaction = |(condition, sum): (&BoundaryCondition, PerMode)| {
            let (force, moment) = modes(problem).resultant(sum);
            Reaction {
                on: restraint_words(condition.on, problem.domain(), problem.pieces()),
                held: condition.coordinates_of(condition.held())[..components].to_vec(),
                force: <[f64; 2]>::from(force)[..components].to_vec(),
                moment: moment.unwrap_or(0.0),
            }
        };
        holding.map(reaction).collect()
    }
}
