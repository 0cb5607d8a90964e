//! Plates and pieces of plates that nothing holds: of all solutions, which differ by rigid motions,
//! the one without any on average.
//!
//! ```text
//! ∫ u·m_k dA = 0 over the piece, for each of its free motions m_k
//! ```
//!
//! The condition couples all unknowns of a piece. So the system first gets a penalty on the unknowns of
//! one patch, which is exact for balanced loads whatever its size. Solutions for the same functionals
//! as loads are the rigid motions themselves, in whatever functions, and they are subtracted.

use crate::balance::Balance;
use crate::basis::{BasisEvaluator, StableBasis};
use crate::batch::in_batches;
use crate::block_matrix::BlockMatrix;
use crate::cell::CellFunctions;
use crate::cholesky::{Cholesky, CholeskyError};
use crate::pieces::Pieces;
use crate::rigid::{PerMotion, RigidMotions};
use crate::shape::Shapes;
use crate::space::Space;
use faer::Mat;
use faer::linalg::solvers::{DenseSolveCore, Solve};

/// A free motion of a piece.
struct Motion {
    piece: usize,
    motions: RigidMotions,
    motion: PerMotion,
    /// Index in [`Gauge::patches`].
    group: usize,
}

/// The free motions of all pieces and the functionals that fix them.
pub(crate) struct Gauge {
    motions: Vec<Motion>,
    /// Of each motion, ∫ N·m over its piece, in the order of the system.
    moments: Vec<Vec<f64>>,
    /// Of each piece that is free, the patch whose unknowns get the penalty.
    patches: Vec<usize>,
}

impl Gauge {
    /// The gauge of the free motions of pieces, given the unknowns of the matrix.
    ///
    /// Cost: where there are free motions, one more pass over the cells.
    pub(crate) fn new(
        space: &Space<'_>,
        basis: &StableBasis,
        pieces: &Pieces,
        balances: &[Balance],
        free: &[Vec<PerMotion>],
        matrix: &BlockMatrix,
    ) -> Self {
        let mut motions = Vec::new();
        let mut groups = 0;
        for (piece, (balance, free)) in balances.iter().zip(free).enumerate() {
            let of_piece = |&motion: &PerMotion| Motion {
                piece,
                motions: balance.motions,
                motion,
                group: groups,
            };
            motions.extend(free.iter().map(of_piece));
            groups += usize::from(!free.is_empty());
        }
        let mut gauge = Self { moments: Vec::new(), motions, patches: Vec::new() };
        if groups > 0 {
            gauge.moments = gauge.integrate(space, basis, pieces, matrix);
            gauge.patches = (0..groups).map(|group| gauge.firmest(group, matrix)).collect();
        }
        gauge
    }

    /// Number of free motions.
    pub(crate) fn len(&self) -> usize {
        self.motions.len()
    }

    /// Adds γ Σ_k r_k r_kᵀ, r_k the part of a functional on the unknowns of one patch.
    pub(crate) fn add_penalty(&self, matrix: &mut BlockMatrix) {
        for (group, &patch) in self.patches.iter().enumerate() {
            let rows: Vec<_> = self.parts(group, patch, matrix).collect();
            let length = rows.iter().copied().flatten().fold(0.0f64, |m, v| m.max(v * v));
            let stiffness = matrix.block(patch, patch).expect("a patch is coupled to itself");
            let n = stiffness.nrows();
            let gamma = (0..n).map(|k| stiffness[(k, k)]).fold(0.0, f64::max) / length;
            let entry = |a, b| gamma * rows.iter().map(|r| r[a] * r[b]).sum::<f64>();
            let block = Mat::from_fn(n, n, entry);
            matrix.add_block(patch, patch, block.as_ref());
        }
    }

    /// Subtracts the rigid motions that the penalty has left in a solution.
    ///
    /// # Errors
    /// Those of the linear solver.
    pub(crate) fn center(
        &self,
        solver: &Cholesky<'_>,
        matrix: &BlockMatrix,
        solution: &mut [f64],
    ) -> Result<(), CholeskyError> {
        if self.motions.is_empty() {
            return Ok(());
        }
        let loads = self.loads(matrix);
        let rough = solve_all(solver, &loads)?;
        // Loads of motions that have one mean each: those of one patch look much alike, and the
        // rounding of their differences would be seen in strains.
        let loads = combined(&loads, &self.means(&rough).partial_piv_lu().inverse());
        let rigid = solve_all(solver, &loads)?;
        let parts = self.means(&rigid).partial_piv_lu().solve(self.means(&[&*solution]));
        for (k, rigid) in rigid.iter().enumerate() {
            solution.iter_mut().zip(rigid).for_each(|(u, r)| *u -= parts[(k, 0)] * r);
        }
        Ok(())
    }

    /// The functionals of the penalty as right-hand sides: their solutions are rigid motions.
    fn loads(&self, matrix: &BlockMatrix) -> Vec<Vec<f64>> {
        let load = |(motion, moments): (&Motion, &Vec<f64>)| {
            let mut load = vec![0.0; moments.len()];
            let range = matrix.unknowns(self.patches[motion.group]);
            load[range.clone()].copy_from_slice(&moments[range]);
            load
        };
        self.motions.iter().zip(&self.moments).map(load).collect()
    }

    /// ∫ u·m_l of some u: a row for each motion, a column for each u.
    fn means<U: AsRef<[f64]>>(&self, all: &[U]) -> Mat<f64> {
        let (rows, columns) = (self.moments.len(), all.len());
        Mat::from_fn(rows, columns, |l, k| dot(&self.moments[l], all[k].as_ref()))
    }

    /// The functionals of one group on the unknowns of a patch.
    fn parts<'g>(
        &'g self,
        group: usize,
        patch: usize,
        matrix: &BlockMatrix,
    ) -> impl Iterator<Item = &'g [f64]> {
        let range = matrix.unknowns(patch);
        let all = self.motions.iter().zip(&self.moments);
        all.filter(move |(motion, _)| motion.group == group)
            .map(move |(_, moments)| &moments[range.clone()])
    }

    /// The patch on which the motions of a group are largest and least alike.
    fn firmest(&self, group: usize, matrix: &BlockMatrix) -> usize {
        let volume = |patch: usize| {
            let rows: Vec<_> = self.parts(group, patch, matrix).collect();
            Mat::from_fn(rows.len(), rows.len(), |k, l| dot(rows[k], rows[l])).determinant()
        };
        let all = (0..matrix.n_blocks()).map(|patch| (patch, volume(patch)));
        all.fold((0, 0.0), |best, new| if new.1 > best.1 { new } else { best }).0
    }

    /// ∫ N·m over the pieces of the motions, cell by cell.
    fn integrate(
        &self,
        space: &Space<'_>,
        basis: &StableBasis,
        pieces: &Pieces,
        matrix: &BlockMatrix,
    ) -> Vec<Vec<f64>> {
        let quadrature = space.quadrature(0);
        let components = if self.motions[0].motions.count() == 1 { 1 } else { 2 };
        let mut moments = vec![vec![0.0; matrix.n_unknowns()]; self.motions.len()];
        in_batches(
            space.partition.len(),
            || (BasisEvaluator::new(space, basis), Shapes::default()),
            |(evaluator, shapes), cell| {
                let functions = CellFunctions::new(space, basis, cell);
                let mut parts = vec![vec![0.0; functions.len() * components]; self.motions.len()];
                for rule in space.rules(&quadrature, cell).iter() {
                    evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
                    let numbers = functions.numbers(&rule.patches);
                    for (q, (&offset, &weight)) in
                        rule.offsets.iter().zip(&rule.weights).enumerate()
                    {
                        let x = rule.anchor + offset;
                        let piece = pieces.of(x);
                        for (part, motion) in parts.iter_mut().zip(&self.motions) {
                            if motion.piece == piece {
                                let m = motion.motions.combined(&motion.motion, x);
                                shapes.add_load(q, &numbers, &m[..components], weight, part);
                            }
                        }
                    }
                }
                (functions, parts)
            },
            |_, (functions, parts)| {
                for (sum, part) in moments.iter_mut().zip(&parts) {
                    functions.add_to(matrix, components, part, sum);
                }
            },
        );
        moments
    }
}

fn solve_all(solver: &Cholesky<'_>, loads: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, CholeskyError> {
    loads.iter().map(|load| Ok(solver.solve(load)?.unknowns)).collect()
}

/// Combinations of vectors, with the factors of each in a column.
fn combined(vectors: &[Vec<f64>], factors: &Mat<f64>) -> Vec<Vec<f64>> {
    let entry = |k: usize, row: usize| {
        vectors.iter().enumerate().map(|(j, vector)| factors[(j, k)] * vector[row]).sum()
    };
    let rows = vectors.first().map_or(0, Vec::len);
    (0..vectors.len()).map(|k| (0..rows).map(|row| entry(k, row)).collect()).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
