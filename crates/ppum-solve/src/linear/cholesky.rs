//! Direct solution of K u = f by the sparse Cholesky factorisation P D K D Pᵀ = L Lᵀ, D = diag(K)^−½.
//!
//! Shape functions of several patches can be dependent where those of each patch are not: on a strip
//! between two cracks that lies in the overlap of two rows of patches all of φ_1 P + φ_2 Q vanishes
//! for P = φ_2 R, Q = −φ_1 R, which are polynomials there. Pivots then vanish, and the unknowns they
//! belong to are left out: K is semi-definite, f consistent, and any solution is the same field. Whether
//! f is consistent is seen from the residual of the whole system. Only then the factorisation is L D Lᵀ.
//!
//! The fill-reducing permutation P is approximate minimum degree, the factorisation supernodal and
//! sequential: `docs/decisions/0001-ordering.md` has the measurements behind both choices.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, LltRef, SymbolicCholesky, SymbolicCholeskyRaw,
    SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMat, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use super::block_matrix::{BlockMatrix, BlockPattern};
use super::solver::{LinearError, LinearSolution, LinearSolver};
use std::borrow::Cow;

/// A pivot L_kk² up to this fraction of K_kk is rounding noise and counts as zero. In a system
/// after the stable transformation the fraction is at least the reciprocal condition number, seen
/// between 1e−3 and 1e−7; an exactly singular one leaves about 1e−16.
const PIVOT_LIMIT: f64 = 1e-13;

/// Pivots up to this fraction of K_kk are replaced in a matrix that has vanishing ones: functions that
/// are dependent up to rounding come with others that nearly are.
const LEFT_OUT_BELOW: f64 = 1e-10;

/// Most steps of iterative refinement.
const REFINEMENTS: usize = 2;

/// Substitute for a vanishing pivot: its unknown becomes zero, and the rest does not see it.
const LEFT_OUT: f64 = 1e40;

/// Relative residual up to which a load is consistent with a semi-definite matrix. Seen are 1e−12 to
/// 1e−7, where pivots just above the limit are left; loads on a piece that nothing holds leave 1.
const CONSISTENT: f64 = 1e-6;

/// The factorisation of a symmetric positive semi-definite matrix, for any number of right-hand sides.
#[derive(Debug)]
pub(crate) struct Cholesky<'a> {
    matrix: Cow<'a, BlockMatrix>,
    /// D
    scale: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Factor,
    /// Unknowns that are left out, because they depend on others.
    dependent: Vec<usize>,
}

/// The values of a factorisation, in the order of the symbolic one.
#[derive(Debug)]
enum Factor {
    /// L Lᵀ of a definite matrix.
    Definite(Vec<f64>),
    /// L D Lᵀ of a semi-definite one, vanishing pivots replaced by [`LEFT_OUT`].
    Semidefinite(Vec<f64>),
}

impl<'a> Cholesky<'a> {
    /// Factorises `matrix`.
    ///
    /// # Errors
    /// A diagonal entry or pivot that is not positive or not finite; a matrix too large for the memory.
    pub(crate) fn new(matrix: &'a BlockMatrix) -> Result<Self, LinearError> {
        Self::of(Cow::Borrowed(matrix))
    }

    /// The same of a matrix that it may own.
    pub(super) fn of(matrix: Cow<'a, BlockMatrix>) -> Result<Self, LinearError> {
        let mut lower = matrix.lower_triangle();
        let scale = inverse_root_diagonal(&matrix, &lower)?;
        multiply(&mut lower, &scale);
        let unknowns = matrix.n_unknowns();
        let no_memory = |_: FaerError| LinearError::OutOfMemory { unknowns };
        let symbolic = analyse(&lower).map_err(no_memory)?;
        let values = definite(&symbolic, &lower).map_err(no_memory)?;
        let factor = match values {
            Some(values) => Factor::Definite(values),
            None => Factor::Semidefinite(semidefinite(&symbolic, &lower).map_err(no_memory)?),
        };
        let mut cholesky = Self { matrix, scale, symbolic, factor, dependent: Vec::new() };
        cholesky.dependent = cholesky.replaced_pivots()?;
        Ok(cholesky)
    }

    /// Bytes of the matrix and of the factor's values.
    pub(crate) fn bytes(&self) -> usize {
        self.matrix.bytes() + self.factor_bytes()
    }

    /// Bytes of the factor's values.
    fn factor_bytes(&self) -> usize {
        match &self.factor {
            Factor::Definite(values) | Factor::Semidefinite(values) => {
                size_of_val(values.as_slice())
            }
        }
    }

    /// f − K u.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let product = self.matrix.multiply(u);
        f.iter().zip(product).map(|(f, ku)| f - ku).collect()
    }

    /// The unknowns whose pivots were replaced, ascending.
    fn replaced_pivots(&self) -> Result<Vec<usize>, LinearError> {
        let Factor::Semidefinite(values) = &self.factor else { return Ok(Vec::new()) };
        let mut replaced = Vec::new();
        for (k, pivot) in diagonal(&self.symbolic, values).into_iter().enumerate() {
            let u = original_index(&self.symbolic, k);
            if !pivot.is_finite() {
                return Err(not_positive_definite(&self.matrix, u));
            }
            // other pivots are at most 1, the diagonal
            replaced.extend((pivot > 2.0).then_some(u));
        }
        replaced.sort_unstable();
        Ok(replaced)
    }
}

impl LinearSolver for Cholesky<'_> {
    /// Up to two steps of iterative refinement.
    fn solve(&self, f: &[f64]) -> Result<LinearSolution, LinearError> {
        assert_eq!(f.len(), self.matrix.n_unknowns(), "one entry for each unknown");
        if let Some(u) = f.iter().position(|x| !x.is_finite()) {
            return Err(LinearError::LoadNotFinite { patch: self.matrix.patch_of(u) });
        }
        let mut unknowns = f.to_vec();
        self.apply_inverse(&mut unknowns);
        let mut rest = self.residual(f, &unknowns);
        for _ in 0..REFINEMENTS {
            let mut correction = rest.clone();
            self.apply_inverse(&mut correction);
            correction.iter_mut().zip(&unknowns).for_each(|(c, u)| *c += u);
            let left = self.residual(f, &correction);
            // rounding can feed what is nearly free
            if norm(&left) >= norm(&rest) {
                break;
            }
            (unknowns, rest) = (correction, left);
        }
        let residual = norm(&rest);
        let relative_residual = if residual == 0.0 { 0.0 } else { residual / norm(f) };
        match self.dependent.first() {
            Some(&u) if relative_residual > CONSISTENT => {
                Err(not_positive_definite(&self.matrix, u))
            }
            _ => Ok(LinearSolution { unknowns, relative_residual, course: None }),
        }
    }

    /// x ← D (L Lᵀ)⁻¹ D x, permutations included.
    fn apply_inverse(&self, x: &mut [f64]) {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut buffer = MemBuffer::new(scratch);
        let n = x.len();
        x.iter_mut().zip(&self.scale).for_each(|(x, d)| *x *= d);
        let column = MatMut::from_column_major_slice_mut(x, n, 1);
        let stack = MemStack::new(&mut buffer);
        match &self.factor {
            Factor::Definite(values) => LltRef::new(&self.symbolic, values)
                .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
            Factor::Semidefinite(values) => LdltRef::new(&self.symbolic, values)
                .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
        }
        x.iter_mut().zip(&self.scale).for_each(|(x, d)| *x *= d);
    }

    fn n_dependent(&self) -> usize {
        self.dependent.len()
    }
}

/// D = diag(K)^−½.
fn inverse_root_diagonal(
    matrix: &BlockMatrix,
    lower: &SparseColMat<usize, f64>,
) -> Result<Vec<f64>, LinearError> {
    // The diagonal is the first entry of its column of the lower triangle.
    let root = |u: usize| match lower.val_of_col(u)[0] {
        d if d > 0.0 && d.is_finite() => Ok(d.sqrt().recip()),
        _ => Err(not_positive_definite(matrix, u)),
    };
    (0..matrix.n_unknowns()).map(root).collect()
}

/// K ← D K D.
fn multiply(lower: &mut SparseColMat<usize, f64>, scale: &[f64]) {
    let (symbolic, values) = lower.parts_mut();
    for (u, &d) in scale.iter().enumerate() {
        for k in symbolic.col_range(u) {
            values[k] *= d * scale[symbolic.row_idx()[k]];
        }
    }
}

fn analyse(lower: &SparseColMat<usize, f64>) -> Result<SymbolicCholesky<usize>, FaerError> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    factorize_symbolic_cholesky(lower.symbolic(), Side::Lower, SymmetricOrdering::Amd, params)
}

/// The factor that elimination makes of a pattern of blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fill {
    /// Values of the factor.
    pub(crate) values: f64,
    /// Operations of the factorisation.
    pub(crate) operations: f64,
}

/// The factor of a matrix with `sizes[i]` unknowns in patch i, counted without its values: elimination on the graph
/// of the patches, in the order in which they would be eliminated. An estimate, as the order of the unknowns may differ.
pub(crate) fn fill(pattern: &BlockPattern, sizes: &[usize]) -> Fill {
    let n = pattern.len();
    let mut starts = vec![0];
    let mut columns = Vec::new();
    for i in 0..n {
        columns.extend(pattern.row(i).iter().map(|&j| j as usize));
        starts.push(columns.len());
    }
    // row i of the upper triangle is column i of the lower one
    let lower = SymbolicSparseColMat::new_checked(n, n, starts, None, columns);
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
        ..Default::default()
    };
    let order = SymmetricOrdering::Amd;
    let factor = factorize_symbolic_cholesky(lower.as_ref(), Side::Lower, order, params);
    let beyond = Fill { values: f64::INFINITY, operations: f64::INFINITY };
    let Ok(factor) = factor else { return beyond };
    let SymbolicCholeskyRaw::Simplicial(columns) = factor.raw() else { return beyond };
    let size = |k: usize| sizes[original_index(&factor, k)] as f64;
    let mut fill = Fill { values: 0.0, operations: 0.0 };
    for (k, ends) in columns.col_ptr().windows(2).enumerate() {
        let below: f64 = columns.row_idx()[ends[0]..ends[1]].iter().map(|&row| size(row)).sum();
        fill.values += size(k) * below;
        fill.operations += size(k) * below * below;
    }
    fill
}

/// The values of L of a matrix with ones on its diagonal, in the order of the symbolic factorisation;
/// none if a pivot vanishes.
fn definite(
    symbolic: &SymbolicCholesky<usize>,
    lower: &SparseColMat<usize, f64>,
) -> Result<Option<Vec<f64>>, FaerError> {
    let mut values = room(symbolic.len_val())?;
    let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let done = symbolic.factorize_numeric_llt(
        &mut values,
        lower.as_ref(),
        Side::Lower,
        Default::default(),
        Par::Seq,
        MemStack::new(&mut buffer),
        Default::default(),
    );
    let positive = |&root: &f64| root * root > PIVOT_LIMIT;
    let definite = done.is_ok() && diagonal(symbolic, &values).iter().all(positive);
    Ok(definite.then_some(values))
}

/// The values of L D Lᵀ with replaced pivots; none is finite from where one is not.
fn semidefinite(
    symbolic: &SymbolicCholesky<usize>,
    lower: &SparseColMat<usize, f64>,
) -> Result<Vec<f64>, FaerError> {
    let mut values = room(symbolic.len_val())?;
    let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let positive = vec![1; lower.ncols()];
    let replace = LdltRegularization {
        dynamic_regularization_signs: Some(&positive),
        dynamic_regularization_delta: LEFT_OUT,
        dynamic_regularization_epsilon: LEFT_OUT_BELOW,
    };
    let done = symbolic.factorize_numeric_ldlt(
        &mut values,
        lower.as_ref(),
        Side::Lower,
        replace,
        Par::Seq,
        MemStack::new(&mut buffer),
        Default::default(),
    );
    // small pivots are replaced, so that only a value that is not finite can be an error
    if done.is_err() {
        values.fill(f64::NAN);
    }
    Ok(values)
}

fn room(len: usize) -> Result<Vec<f64>, FaerError> {
    let mut values = Vec::new();
    values.try_reserve_exact(len).map_err(|_| FaerError::OutOfMemory)?;
    values.resize(len, 0.0);
    Ok(values)
}

/// The diagonal of a factor, in the order of elimination.
fn diagonal(symbolic: &SymbolicCholesky<usize>, values: &[f64]) -> Vec<f64> {
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else {
        return Vec::new(); // only the empty system is not supernodal
    };
    let factor = SupernodalLltRef::new(symbolic, values);
    let blocks = (0..symbolic.n_supernodes()).map(|s| factor.supernode(s).val());
    blocks.flat_map(|block| (0..block.ncols()).map(move |k| block[(k, k)])).collect()
}

/// The unknown that is eliminated as number `k`.
fn original_index(symbolic: &SymbolicCholesky<usize>, k: usize) -> usize {
    symbolic.perm().map_or(k, |perm| perm.arrays().0[k])
}

fn not_positive_definite(matrix: &BlockMatrix, u: usize) -> LinearError {
    let patch = matrix.patch_of(u);
    LinearError::NotPositiveDefinite { patch, unknown: u - matrix.unknowns(patch).start }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::BlockPattern;
    use faer::Mat;
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

    /// Elimination on the graph of patches counts what elimination on the unknowns has.
    #[test]
    fn the_factor_is_as_large_as_estimated() {
        for n in [24, 40] {
            let matrix = dominant(n);
            let sizes: Vec<_> = (0..n * n).map(|i| matrix.unknowns(i).len()).collect();
            let found = fill(&grid(n), &sizes);
            let factor = Cholesky::new(&matrix).unwrap();
            let ratio = found.values / factor.symbolic.len_val() as f64;
            assert!((0.7..1.3).contains(&ratio), "{n}: {ratio}");
            // a dense matrix takes n³/3 multiplications and as many additions
            let unknowns = matrix.n_unknowns() as f64;
            assert!(found.operations <= unknowns.powi(3) + 1.0, "{n}: {}", found.operations);
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
