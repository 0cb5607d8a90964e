//! Estimated errors of stress intensity factors.
//!
//! A factor is a linear functional of the field, K(u) = a(u, z) with a dual solution z of its own, so that its error is
//! a(u − u_h, z − z_h) (Becker & Rannacher 2001). The disagreements of local fields stand for both errors,
//!
//! ```text
//! |K − K_h| ≈ Σ_j |∫_{C_j} Σ_i s_i φ_i (σ(u_i) − σ(u_h)) : (ε(z_i) − ε(z_h))| + Σ_j d_j(u) η_j(z)
//! ```
//!
//! with the parts d_j of the estimated error that stand for data. Without the absolute values the first sum has the sign of the error,
//! and may cancel where the error does not; products of norms, Σ_j η_j(u) η_j(z), were up to a hundred times the error (docs/decisions/0018).
//!
//! The functionals of all tips are added up, so that two dual solutions serve any number of tips; each tip's error is the sum over
//! the cells that have no other tip nearer.

use super::SolveError;
use super::solution::{Solving, write_coefficients};
use crate::adapt::{Estimated, shared_disagreement};
use crate::assembly::{Assembly, dual_loads};
use crate::basis::StableBasis;
use crate::intensity::{FACTORS, Sensitivity, sensitivities};
use crate::law::Law;
use crate::linear::{BlockMatrix, LinearSolver};
use crate::space::Space;
use crate::watched::Stage;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::Phase;
use ppum::vec2::{Rect, Vec2};

/// The dual solutions of K_I and K_II of all tips with factors.
pub(super) struct Duals {
    /// The places of the tips.
    tips: Vec<Vec2>,
    /// Plain coefficients.
    coefficients: [Vec<f64>; FACTORS],
}

impl Solving<'_> {
    /// The dual solutions of a system; none without factors.
    pub(super) fn duals(
        &self,
        dataset: &Dataset,
        (basis, matrix): (&StableBasis, &BlockMatrix),
        solver: &dyn LinearSolver,
    ) -> Result<Option<Duals>, SolveError> {
        let Self { problem, space, watcher } = *self;
        let field = Field::new(dataset, 0)?;
        let tips = sensitivities(dataset, &field, space);
        if tips.is_empty() {
            return Ok(None);
        }
        let law = &Law::new(&problem.equation);
        let stage = Stage::uncounted(watcher, Phase::Solution)?;
        let assembly = Assembly { problem, space, basis, law };
        let loads = dual_loads(assembly, matrix, &tips, &stage).map_err(SolveError::of_data)?;
        let plain = |load: &Vec<f64>| -> Result<Vec<f64>, SolveError> {
            let solution = solver.solve(load).map_err(|error| self.located(error))?;
            Ok(basis.plain(space, &solution.unknowns, problem.components()))
        };
        let [opening, sliding] = &loads;
        let coefficients = [plain(opening)?, plain(sliding)?];
        let tips = tips.iter().map(Sensitivity::tip).collect();
        Ok(Some(Duals { tips, coefficients }))
    }
}

/// The estimated errors of factors.
#[derive(Clone, Debug, Default)]
pub(super) struct Goal {
    /// Of (K_I, K_II) of each tip with factors, in their order.
    pub(super) errors: Vec<f64>,
    /// Of each cell, what it adds to the error of the nearest tip, and the number of that tip.
    pub(super) cells: Vec<(usize, f64)>,
}

impl Duals {
    /// The estimated errors, from those of the solution. Advances the stage by twice the number of cells.
    pub(super) fn goal(
        &self,
        dataset: &Dataset,
        space: &Space<'_>,
        estimated: &Estimated,
        stage: &Stage<'_>,
    ) -> Result<Goal, SolveError> {
        let own = Field::new(dataset, 0)?;
        let mut dual = dataset.clone();
        let mut parts = vec![[0.0; FACTORS]; space.partition().len()];
        for (mode, coefficients) in self.coefficients.iter().enumerate() {
            write_coefficients(&mut dual.steps[0].fields[0], coefficients);
            let field = Field::new(&dual, 0)?;
            let shared = shared_disagreement([&own, &field], space, stage);
            let of_cells = shared.map_err(SolveError::of_data)?;
            for ((part, shared), unseen) in parts.iter_mut().zip(of_cells).zip(&estimated.unseen) {
                part[mode] = shared.mixed.abs() + (unseen * shared.second).sqrt();
            }
        }
        Ok(self.of_tips(&space.partition().cell, &parts))
    }

    fn of_tips(&self, cells: &[Rect], parts: &[[f64; FACTORS]]) -> Goal {
        let mut errors = vec![[0.0; FACTORS]; self.tips.len()];
        let mut of_cells = Vec::with_capacity(cells.len());
        for (cell, part) in cells.iter().zip(parts) {
            let tip = nearest(&self.tips, cell);
            errors[tip].iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            of_cells.push((tip, part[0].hypot(part[1])));
        }
        let errors = errors.into_iter().map(|[first, second]| first.hypot(second)).collect();
        Goal { errors, cells: of_cells }
    }
}

/// The tip that is nearest to the middle of a cell.
fn nearest(tips: &[Vec2], cell: &Rect) -> usize {
    let distance = |k: &usize| (tips[*k] - cell.center()).length();
    (0..tips.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}
