//! Direct solution of K u = f by the sparse Cholesky factorisation P D K D P^T = L L^T, D =
//! diag(K)^−½.
//!
//! Shape functions of several patches can be dependent where those of each patch are not: on a
//! strip between two cracks that lies in the overlap of two rows of patches all of φ_1 P + φ_2 Q
//! vanishes for P = φ_2 R, Q = −φ_1 R, which are polynomials there. Pivots then vanish, and the
//! unknowns they belong to are left out: K is semi-definite, f consistent, and any solution is the
//! same field. Whether f is consistent is seen from the residual of the whole system.
//!
//! The order of elimination is found on the graph of the blocks, and fronts of the tree that it
//! makes are dense matrices: `docs/decisions/0027-factorisation.md` has the measurements.

use super::block_matrix::BlockMatrix;
use super::conjugate::{norm, relative};
use super::elimination::Elimination;
use super::factor::CholeskyFactor;
use super::neighbours::Neighbours;
use super::solver::{LinearError, LinearSolution, LinearSolver, check_load};
use faer::Mat;
use std::borrow::Cow;

/// Most steps of iterative refinement.
const REFINEMENTS: usize = 2;

/// Relative size of a correction after which the next one is rounding: it is about its square.
const LAST_CORRECTION: f64 = 1e-9;

/// Relative residual up to which a load is consistent with a semi-definite matrix. Seen are 1e−12
/// to 1e−7, where pivots just above the limit are left; loads on a piece that nothing holds
/// leave 1.
const CONSISTENT: f64 = 1e-6;

/// Pivots are at most one, the diagonal, except for those that are replaced.
const REPLACED: f64 = 2.0;

/// The factorisation of a symmetric positive semi-definite matrix, for any number of
/// right-hand sides.
#[derive(Debug)]
pub struct Cholesky<'a> {
    matrix: Cow<'a, BlockMatrix>,
    /// D
    scale: Vec<f64>,
    factor: CholeskyFactor,
    /// Unknowns that are left out, because they depend on others.
    dependent: Vec<usize>,
}

impl<'a> Cholesky<'a> {
    /// Factorises `matrix`.
    ///
    /// # Errors
    /// A diagonal entry or pivot that is not positive or not finite; a matrix too large for
    /// the memory.
    pub fn new(matrix: &'a BlockMatrix) -> Result<Self, LinearError> {
        Self::of(Cow::Borrowed(matrix))
    }

    /// Factorises a matrix that it may own.
    ///
    /// # Errors
    /// Those of [`Cholesky::new`].
    pub fn of(matrix: Cow<'a, BlockMatrix>) -> Result<Self, LinearError> {
        let scale = inverse_root_diagonal(&matrix)?;
        let sizes: Vec<_> = (0..matrix.n_blocks()).map(|i| matrix.unknowns(i).len()).collect();
        let neighbours = Neighbours::new(matrix.pattern());
        let elimination = Elimination::new(&neighbours, &sizes);
        let no_memory = |_| LinearError::OutOfMemory { unknowns: matrix.n_unknowns() };
        let factor = CholeskyFactor::new(&matrix, &scale, elimination).map_err(no_memory)?;
        let dependent = replaced_pivots(&factor, &matrix)?;
        Ok(Self { matrix, scale, factor, dependent })
    }

    /// K⁻¹ x, as it comes: without a look at the residual.
    pub(super) fn apply_inverse(&self, x: &[f64]) -> Vec<f64> {
        self.inverse(&[x.to_vec()]).remove(0)
    }

    /// f − K u.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let product = self.matrix.multiply(u);
        f.iter().zip(product).map(|(f, ku)| f - ku).collect()
    }

    /// Adds a correction, if it makes the residual smaller; false if another one would not.
    fn refine(
        &self,
        load: &[f64],
        unknowns: &mut Vec<f64>,
        rest: &mut Vec<f64>,
        mut correction: Vec<f64>,
    ) -> bool {
        let is_last = norm(&correction) <= LAST_CORRECTION * norm(unknowns);
        correction.iter_mut().zip(&*unknowns).for_each(|(c, u)| *c += u);
        let left = self.residual(load, &correction);
        // rounding can feed what is nearly free
        let is_better = norm(&left) < norm(rest);
        if is_better {
            (*unknowns, *rest) = (correction, left);
        }
        is_better && !is_last
    }

    /// D P^T (L L^T)⁻¹ P D x of each x.
    fn inverse(&self, all: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let order = self.factor.order(&self.matrix);
        let mut columns = Mat::from_fn(order.len(), all.len(), |row, k| {
            let u = order[row];
            self.scale[u] * all[k][u]
        });
        self.factor.solve(columns.as_mut());
        let mut solutions = vec![vec![0.0; order.len()]; all.len()];
        for (k, solution) in solutions.iter_mut().enumerate() {
            for (row, &u) in order.iter().enumerate() {
                solution[u] = self.scale[u] * columns[(row, k)];
            }
        }
        solutions
    }
}

impl LinearSolver for Cholesky<'_> {
    fn solve(&self, f: &[f64]) -> Result<LinearSolution, LinearError> {
        Ok(self.solve_all(&[f.to_vec()])?.remove(0))
    }

    /// Up to two steps of iterative refinement.
    fn solve_all(&self, loads: &[Vec<f64>]) -> Result<Vec<LinearSolution>, LinearError> {
        let mut all = self.solve_roughly(loads)?;
        let rest = |(load, unknowns): (&Vec<f64>, &Vec<f64>)| self.residual(load, unknowns);
        let mut rests: Vec<_> = loads.iter().zip(&all).map(rest).collect();
        let mut open: Vec<usize> = (0..loads.len()).collect();
        for _ in 0..REFINEMENTS {
            let corrections =
                self.inverse(&open.iter().map(|&k| rests[k].clone()).collect::<Vec<_>>());
            let mut corrections = corrections.into_iter();
            open.retain(|&k| {
                let correction = corrections.next().unwrap_or_default();
                self.refine(&loads[k], &mut all[k], &mut rests[k], correction)
            });
        }
        let solution = |((load, unknowns), rest): ((&Vec<f64>, Vec<f64>), Vec<f64>)| {
            let relative_residual = relative(&rest, load);
            match self.dependent.first() {
                Some(&u) if relative_residual > CONSISTENT => {
                    Err(not_positive_definite(&self.matrix, u))
                }
                _ => Ok(LinearSolution { unknowns, relative_residual, history: None }),
            }
        };
        loads.iter().zip(all).zip(rests).map(solution).collect()
    }

    fn solve_roughly(&self, loads: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, LinearError> {
        loads.iter().try_for_each(|load| check_load(&self.matrix, load))?;
        Ok(self.inverse(loads))
    }

    fn n_dependent(&self) -> usize {
        self.dependent.len()
    }

    fn bytes(&self) -> usize {
        self.matrix.bytes() + self.factor.bytes()
    }
}

/// The unknowns whose pivots were replaced, ascending.
fn replaced_pivots(
    factor: &CholeskyFactor,
    matrix: &BlockMatrix,
) -> Result<Vec<usize>, LinearError> {
    let mut replaced = Vec::new();
    for (u, pivot) in factor.order(matrix).into_iter().zip(factor.pivots()) {
        if !pivot.is_finite() {
            return Err(not_positive_definite(matrix, u));
        }
        replaced.extend((pivot > REPLACED).then_some(u));
    }
    replaced.sort_unstable();
    Ok(replaced)
}

/// D = diag(K)^−½.
fn inverse_root_diagonal(matrix: &BlockMatrix) -> Result<Vec<f64>, LinearError> {
    let mut scale = Vec::with_capacity(matrix.n_unknowns());
    for i in 0..matrix.n_blocks() {
        let block = matrix.block(i, i).expect("a block is coupled to itself");
        for k in 0..block.nrows() {
            match block[(k, k)] {
                d if d > 0.0 && d.is_finite() => scale.push(d.sqrt().recip()),
                _ => return Err(LinearError::NotPositiveDefinite { patch: i, unknown: k }),
            }
        }
    }
    Ok(scale)
}

fn not_positive_definite(matrix: &BlockMatrix, u: usize) -> LinearError {
    let patch = matrix.patch_of(u);
    LinearError::NotPositiveDefinite { patch, unknown: u - matrix.unknowns(patch).start }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BlockPattern, fill};
    use ppum_testkit::random::Random;

    /// n × n patches, each coupled to its eight neighbours.
    fn grid(n: usize) -> BlockPattern {
        let (mut starts, mut columns) = (vec![0], Vec::new());
        for (y, x) in (0..n).flat_map(|y| (0..n).map(move |x| (y, x))) {
            columns.push((y * n + x) as u32);
            columns.extend((x + 1 < n).then_some((y * n + x + 1) as u32));
            if y + 1 < n {
                let last = (x + 1).min(n - 1);
                columns.extend((x.saturating_sub(1)..=last).map(|v| ((y + 1) * n + v) as u32));
            }
            starts.push(columns.len());
        }
        BlockPattern::new(starts, columns)
    }

    /// A random, diagonally dominant matrix on a grid with patches of 3 to 5 unknowns.
    fn dominant(n: usize) -> BlockMatrix {
        let mut random = Random(2);
        let sizes: Vec<usize> = (0..n * n).map(|i| 3 + i % 3).collect();
        let pattern = grid(n);
        let mut matrix = BlockMatrix::new(&sizes, pattern.clone());
        for i in 0..n * n {
            for j in pattern.row(i).iter().map(|&j| j as usize) {
                let mut block = Mat::from_fn(sizes[i], sizes[j], |_, _| random.between(-1.0, 1.0));
                if i == j {
                    let shift = Mat::<f64>::identity(sizes[i], sizes[i]) * faer::Scale(25.0);
                    block = &block + block.transpose() + shift;
                }
                matrix.add_block(i, j, block.as_ref());
            }
        }
        matrix
    }

    /// The second-difference matrix of `3 · patches` unknowns in a chain; its first diagonal entry
    /// is 2 for an end that is held and 1 for a free one, where with both ends free K is singular.
    fn chain(patches: usize, first: f64, last: f64) -> BlockMatrix {
        let starts = (0..patches).map(|i| 2 * i).chain([2 * patches - 1]).collect();
        let columns = (0..patches as u32).flat_map(|i| [i, i + 1]).take(2 * patches - 1).collect();
        let mut matrix = BlockMatrix::new(&vec![3; patches], BlockPattern::new(starts, columns));
        let last_unknown = 3 * patches - 1;
        let entry = |u: usize, v: usize| match u.abs_diff(v) {
            0 if u == 0 => first,
            0 if u == last_unknown => last,
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        };
        for i in 0..patches {
            for j in i..(i + 2).min(patches) {
                let block = Mat::from_fn(3, 3, |a, b| entry(3 * i + a, 3 * j + b));
                matrix.add_block(i, j, block.as_ref());
            }
        }
        matrix
    }

    #[test]
    fn a_loaded_string_by_hand() {
        // −u'' = 1 on n interior points, held at both ends: u_k = k (n + 1 − k) / 2.
        let matrix = chain(20, 2.0, 2.0);
        let solution = Cholesky::new(&matrix).unwrap().solve(&[1.0; 60]).unwrap();
        for (k, u) in (1..=60).zip(&solution.unknowns) {
            assert!((u - f64::from(k * (61 - k)) / 2.0).abs() < 1e-10);
        }
        assert!(solution.relative_residual < 1e-13);
    }

    #[test]
    fn a_known_solution_on_a_grid_is_found_again() {
        let matrix = dominant(12);
        let mut random = Random(9);
        let exact: Vec<f64> = (0..matrix.n_unknowns()).map(|_| random.between(-1.0, 1.0)).collect();
        let cholesky = Cholesky::new(&matrix).unwrap();
        let solution = cholesky.solve(&matrix.multiply(&exact)).unwrap();
        for (u, exact) in solution.unknowns.iter().zip(&exact) {
            assert!((u - exact).abs() < 1e-13);
        }
        assert!(solution.relative_residual < 1e-15);
    }

    #[test]
    fn no_load_no_solution_and_no_unknowns_none() {
        let matrix = chain(4, 2.0, 2.0);
        let solution = Cholesky::new(&matrix).unwrap().solve(&[0.0; 12]).unwrap();
        assert_eq!(solution.unknowns, [0.0; 12]);
        assert_eq!(solution.relative_residual, 0.0);
        let empty = BlockMatrix::new(&[0], BlockPattern::new(vec![0, 1], vec![0]));
        assert!(Cholesky::new(&empty).unwrap().solve(&[]).unwrap().unknowns.is_empty());
    }

    /// The factor is counted before it is there.
    #[test]
    fn the_factor_is_as_large_as_estimated() {
        for n in [24, 40] {
            let matrix = dominant(n);
            let sizes: Vec<_> = (0..n * n).map(|i| matrix.unknowns(i).len()).collect();
            let found = fill(&grid(n), &sizes);
            let factor = Cholesky::new(&matrix).unwrap();
            // panels have their triangles in full
            let ratio = 8.0 * found / factor.factor.bytes() as f64;
            assert!((0.7..=1.0).contains(&ratio), "{n}: {ratio}");
        }
    }

    #[test]
    fn a_free_chain_is_singular() {
        assert!(Cholesky::new(&chain(20, 1.0, 2.0)).unwrap().dependent.is_empty());
        let matrix = chain(20, 1.0, 1.0);
        let free = Cholesky::new(&matrix).unwrap();
        assert_eq!(free.dependent.len(), 1);
        let error = free.solve(&[1.0; 60]).unwrap_err();
        assert!(matches!(error, LinearError::NotPositiveDefinite { .. }), "{error}");
        // balanced loads stretch it
        let mut load = [0.0; 60];
        (load[3], load[50]) = (-1.0, 1.0);
        let solution = free.solve(&load).unwrap();
        assert!((solution.unknowns[50] - solution.unknowns[3] - 47.0).abs() < 1e-10);
        assert!(solution.relative_residual < 1e-13);
    }

    /// Unknowns that say the same as others are left out, and the field is the same.
    #[test]
    fn dependent_unknowns_are_left_out() {
        let matrix = dominant(6);
        let (n, pattern) = (matrix.n_unknowns(), grid(6));
        // each patch once more: K ⊗ [1 1; 1 1]
        let sizes: Vec<_> = (0..36).map(|i| 2 * matrix.unknowns(i).len()).collect();
        let mut twice = BlockMatrix::new(&sizes, pattern.clone());
        for i in 0..36 {
            for j in pattern.row(i).iter().map(|&j| j as usize) {
                let block = matrix.block(i, j).expect("coupled");
                let (rows, columns) = (block.nrows(), block.ncols());
                let all =
                    Mat::from_fn(2 * rows, 2 * columns, |a, b| block[(a % rows, b % columns)]);
                twice.add_block(i, j, all.as_ref());
            }
        }
        let factor = Cholesky::new(&twice).unwrap();
        assert_eq!(factor.dependent.len(), n);
        let exact: Vec<f64> = (0..n).map(|u| (u as f64).cos()).collect();
        let load = matrix.multiply(&exact);
        let both = |part: &dyn Fn(usize) -> Vec<f64>| (0..36).flat_map(part).collect::<Vec<f64>>();
        let load = both(&|i| [&load[matrix.unknowns(i)]; 2].concat());
        let found = factor.solve(&load).unwrap();
        assert!(found.relative_residual < 1e-14, "{}", found.relative_residual);
        for i in 0..36 {
            let (first, size) = (twice.unknowns(i).start, matrix.unknowns(i).len());
            for (a, u) in matrix.unknowns(i).enumerate() {
                let sum = found.unknowns[first + a] + found.unknowns[first + size + a];
                assert!((sum - exact[u]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_negative_or_undefined_pivot_is_placed() {
        for bad in [-1.0, f64::NAN] {
            for (patch, unknown) in [(0, 0), (17, 2), (80, 1), (143, 0)] {
                // Uncoupled patches of ones, so that nothing else can go wrong.
                let mut matrix = BlockMatrix::new(&[3; 144], grid(12));
                for i in 0..144 {
                    let block = Mat::from_fn(3, 3, |a, b| match (a == b, (i, a)) {
                        (true, place) if place == (patch, unknown) => bad,
                        (equal, _) => f64::from(u8::from(equal)),
                    });
                    matrix.add_block(i, i, block.as_ref());
                }
                let expected = LinearError::NotPositiveDefinite { patch, unknown };
                assert_eq!(Cholesky::new(&matrix).unwrap_err(), expected);
            }
        }
    }

    #[test]
    fn a_load_that_is_not_finite_is_placed() {
        let matrix = chain(4, 2.0, 2.0);
        let mut load = [1.0; 12];
        load[7] = f64::INFINITY;
        let error = Cholesky::new(&matrix).unwrap().solve(&load).unwrap_err();
        assert_eq!(error, LinearError::LoadNotFinite { patch: 2 });
    }

    #[test]
    fn the_solution_does_not_depend_on_the_number_of_threads() {
        let matrix = dominant(24);
        let load: Vec<f64> = (0..matrix.n_unknowns()).map(|u| (u as f64).sin()).collect();
        let solve_with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Cholesky::new(&matrix).unwrap().solve(&load).unwrap().unknowns)
        };
        assert_eq!(solve_with(1), solve_with(3));
    }
}
