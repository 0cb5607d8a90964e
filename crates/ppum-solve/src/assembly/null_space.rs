//! Bodies and pieces of bodies that nothing holds: of all solutions, which differ by rigid-body
//! modes, the one without any on average.
//!
//! ```text
//! ∫ u·m_k dA = 0 over the piece, for each of its free modes m_k
//! ```
//!
//! Where points are held, u_i(x₀) = g_i takes the place of as many of these conditions, and those
//! that stay are for the motions that the points leave. If pieces touch, the free motions are those
//! of several pieces together ([`RigidMotion`]).
//!
//! The conditions couple all unknowns of a piece. So the system first gets a penalty on the
//! unknowns of one patch, which is exact for balanced loads whatever its size: of a motion of
//! several pieces one of the first that moves. Solutions for the same functionals as loads are the
//! rigid motions themselves, in whatever functions, and they are subtracted.

use super::point::PointValues;
use super::spring::{PatchFunctional, PieceMoments, Spring, dot};
use crate::basis::Shapes;
use crate::equilibrium::{Balance, BodyEquilibrium, PieceConditions, RigidMotion};
use crate::law::{PerMode, RigidModes};
use crate::quadrature::CellRule;
use faer::Mat;
use faer::linalg::solvers::{DenseSolveCore, Solve};
use ppum::vec2::Vec2;
use ppum_linear::{BlockMatrix, LinearError, LinearSolver};
use ppum_problem::Support;

/// A free mode of a piece.
#[derive(Clone, PartialEq)]
struct Mode {
    piece: usize,
    modes: RigidModes,
    mode: PerMode,
}

/// The free modes of all pieces.
pub struct FreeModes<'p> {
    plate: &'p BodyEquilibrium,
    modes: Vec<Mode>,
}

impl<'p> FreeModes<'p> {
    /// The free modes of a body.
    pub fn new(plate: &'p BodyEquilibrium) -> Self {
        let pieces = plate.balances.iter().zip(&plate.free).enumerate();
        let of_piece = |(piece, (balance, free)): (usize, (&Balance, &'p Vec<PerMode>))| {
            let modes = balance.modes;
            free.iter().map(move |&mode| Mode { piece, modes, mode })
        };
        Self { plate, modes: pieces.flat_map(of_piece).collect() }
    }

    /// No free modes, on the same pieces: their functionals are not wanted.
    pub(crate) fn none(plate: &'p BodyEquilibrium) -> Self {
        Self { plate, modes: Vec::new() }
    }

    /// Number of free modes.
    pub(crate) fn len(&self) -> usize {
        self.modes.len()
    }

    /// Adds ∫ N·m over the points of a rule in its piece for each mode m; shapes are those of the
    /// rule's patches, `numbers` their places in a part.
    pub(super) fn add(
        &self,
        rule: &CellRule,
        shapes: &Shapes,
        numbers: &[usize],
        components: usize,
        parts: &mut [Vec<f64>],
    ) {
        if self.modes.is_empty() {
            return;
        }
        let pieces = &self.plate.pieces;
        let places: Vec<(Vec2, usize)> = rule.points().map(|(x, _)| (x, pieces.of(x))).collect();
        for (part, mode) in parts.iter_mut().zip(&self.modes) {
            let load = |(&(x, piece), weight): (&(Vec2, usize), &f64)| {
                let weight = if piece == mode.piece { *weight } else { 0.0 };
                mode.modes.combined(&mode.mode, x).map(|m| weight * m)
            };
            let loads: Vec<[f64; 2]> = places.iter().zip(&rule.weights).map(load).collect();
            shapes.add_loads(&loads, numbers, components, part);
        }
    }
}

/// A condition on fields: a functional of the unknowns and its value.
struct ConstraintCondition {
    functional: Vec<f64>,
    value: f64,
}

/// Stiffness of the spring that holds pieces while it is looked for where they touch, in parts of
/// the penalty. The result does not depend on it.
const SOFT: f64 = 1e-6;

/// The free motions of all pieces and the functionals that fix them.
pub struct NullSpaceConstraint {
    motions: Vec<RigidMotion>,
    /// For each motion, ∫ N·m over its pieces, in the order of the system.
    moments: Vec<Vec<f64>>,
    /// For each motion, ∫ u_s·m over its pieces, of the known part of the field.
    known: Vec<f64>,
    /// The modes of each motion that get the penalty.
    holders: Vec<PatchFunctional>,
    /// The penalties on all modes of pieces that touch others.
    of_touching: Vec<PatchFunctional>,
    /// Conditions that take the place of moments that vanish; none where no point is held.
    conditions: Vec<ConstraintCondition>,
}

impl NullSpaceConstraint {
    /// The constraint of free modes with these moments, ∫ N·m over their pieces in the order of
    /// the matrix, and those of the known part of the field.
    pub fn new(
        FreeModes { plate, modes }: FreeModes<'_>,
        (moments, known): (Vec<Vec<f64>>, Vec<f64>),
        matrix: &BlockMatrix,
    ) -> Self {
        let motions = plate.motions.clone();
        let factors = Mat::from_fn(modes.len(), motions.len(), |mode, k| motions[k].factors[mode]);
        let known_of = |k: usize| known.iter().zip(&motions[k].factors).map(|(m, f)| m * f).sum();
        let (mut holders, mut of_touching) = (Vec::new(), Vec::new());
        for group in &plate.groups {
            for &piece in group.iter().filter(|&&piece| !plate.free[piece].is_empty()) {
                let (first, n) = (plate.first_mode(piece), plate.free[piece].len());
                let of_piece = PieceMoments { moments: &moments[first..first + n], matrix };
                let patch = of_piece.firmest();
                let own = motions.iter().filter(|motion| motion.lead == piece);
                holders.extend(own.map(|motion| of_piece.holder(patch, &motion.factors[first..])));
                if group.len() > 1 {
                    let unit =
                        |k: usize| Vec::from_iter((0..n).map(|j| f64::from(u8::from(j == k))));
                    of_touching.extend((0..n).map(|k| of_piece.holder(patch, &unit(k))));
                }
            }
        }
        Self {
            moments: combined(&moments, &factors),
            known: (0..motions.len()).map(known_of).collect(),
            motions,
            holders,
            of_touching,
            conditions: Vec::new(),
        }
    }

    /// The constraint of a body with supports.
    pub fn with_supports(
        mut self,
        supports: &[Support],
        groups: &[PieceConditions],
        values: &dyn Fn(Vec2) -> PointValues,
    ) -> Self {
        if supports.is_empty() {
            return self;
        }
        let rows: Vec<_> = supports.iter().map(|support| values(support.at)).collect();
        for (group, conditions) in groups.iter().enumerate() {
            let held = conditions.held.iter().map(|&(number, component)| ConstraintCondition {
                functional: rows[number].functionals[component].clone(),
                value: supports[number].displacement[component].unwrap_or(0.0)
                    - rows[number].known[component],
            });
            self.conditions.extend(held);
            let left = conditions.left.iter().map(|factors| self.moment(group, factors));
            let left: Vec<_> = left.collect();
            self.conditions.extend(left);
        }
        self
    }

    /// A combination of the moments of a group of pieces, which vanishes for the whole field.
    fn moment(&self, group: usize, factors: &[f64]) -> ConstraintCondition {
        let own = (0..self.motions.len()).filter(|&k| self.motions[k].group == group);
        let functional = vec![0.0; self.moments.first().map_or(0, Vec::len)];
        let mut condition = ConstraintCondition { functional, value: 0.0 };
        for (k, factor) in own.zip(factors) {
            let sums = condition.functional.iter_mut().zip(&self.moments[k]);
            sums.for_each(|(sum, m)| *sum += factor * m);
            condition.value -= factor * self.known[k];
        }
        condition
    }

    /// Number of free motions.
    pub fn n_free(&self) -> usize {
        self.motions.len()
    }

    /// Adds γ Σ_k r_k r_kᵀ, r_k the part of a functional on the unknowns of one patch.
    pub fn add_penalty(&self, matrix: &mut BlockMatrix) {
        Spring::new(&self.holders, 1.0, matrix).add_to(matrix);
    }

    /// The spring for pieces that others hold where they touch; nothing where none do.
    pub fn spring(&self, matrix: &BlockMatrix) -> Spring {
        Spring::new(&self.of_touching, SOFT, matrix)
    }

    /// Replaces the rigid-body modes that the penalty has left in a solution by those of the
    /// conditions.
    ///
    /// # Errors
    /// Those of the linear solver.
    pub fn center(
        &self,
        solver: &dyn LinearSolver,
        matrix: &BlockMatrix,
        solution: &mut [f64],
    ) -> Result<(), LinearError> {
        if self.motions.is_empty() {
            return Ok(());
        }
        let rigid = match solver.kernel() {
            Some(modes) => modes,
            None => self.rigid(solver, matrix)?,
        };
        let (functionals, excess) = match self.conditions.is_empty() {
            true => (self.means(&rigid), self.means(&[&*solution]) + self.known_means()),
            false => (self.values(&rigid), self.excess(solution)),
        };
        let parts = functionals.partial_piv_lu().solve(excess);
        for (k, rigid) in rigid.iter().enumerate() {
            solution.iter_mut().zip(rigid).for_each(|(u, r)| *u -= parts[(k, 0)] * r);
        }
        Ok(())
    }

    /// The rigid-body modes, as solutions for the functionals of the penalty.
    fn rigid(
        &self,
        solver: &dyn LinearSolver,
        matrix: &BlockMatrix,
    ) -> Result<Vec<Vec<f64>>, LinearError> {
        let loads = self.loads(matrix);
        let rough = solver.solve_roughly(&loads)?;
        // Loads of modes that have one mean each: those of one patch look much alike, and the
        // rounding of their differences would be seen in strains.
        let loads = combined(&loads, &self.means(&rough).partial_piv_lu().inverse());
        Ok(solver.solve_all(&loads)?.into_iter().map(|solution| solution.unknowns).collect())
    }

    /// The functionals of the penalty as right-hand sides: their solutions are rigid-body modes.
    pub fn loads(&self, matrix: &BlockMatrix) -> Vec<Vec<f64>> {
        let load = |holder: &PatchFunctional| {
            let mut load = vec![0.0; matrix.n_unknowns()];
            load[matrix.unknowns(holder.patch)].copy_from_slice(&holder.functional);
            load
        };
        self.holders.iter().map(load).collect()
    }

    /// ∫ u·m_l of some u: a row for each mode, a column for each u.
    fn means<U: AsRef<[f64]>>(&self, all: &[U]) -> Mat<f64> {
        let (rows, columns) = (self.moments.len(), all.len());
        Mat::from_fn(rows, columns, |l, k| dot(&self.moments[l], all[k].as_ref()))
    }

    /// ∫ u_s·m_l, in a column.
    fn known_means(&self) -> Mat<f64> {
        Mat::from_fn(self.known.len(), 1, |l, _| self.known[l])
    }

    /// The functionals of the conditions of some u, as [`NullSpaceConstraint::means`].
    fn values(&self, all: &[Vec<f64>]) -> Mat<f64> {
        let functional = |l: usize| &self.conditions[l].functional;
        Mat::from_fn(self.conditions.len(), all.len(), |l, k| dot(functional(l), &all[k]))
    }

    /// Returns the excess of a solution's functionals over their values.
    fn excess(&self, solution: &[f64]) -> Mat<f64> {
        let excess = |ConstraintCondition { functional, value }: &ConstraintCondition| {
            dot(functional, solution) - value
        };
        Mat::from_fn(self.conditions.len(), 1, |l, _| excess(&self.conditions[l]))
    }
}

/// Combinations of vectors, with the factors of each in a column.
fn combined(vectors: &[Vec<f64>], factors: &Mat<f64>) -> Vec<Vec<f64>> {
    let entry = |k: usize, row: usize| {
        vectors.iter().enumerate().map(|(j, vector)| factors[(j, k)] * vector[row]).sum()
    };
    let rows = vectors.first().map_or(0, Vec::len);
    (0..factors.ncols()).map(|k| (0..rows).map(|row| entry(k, row)).collect()).collect()
}
