//! Columns of a dense symmetric matrix, from the diagonal down: what threads take of a front.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{self as ldlt, LdltRegularization};
use faer::linalg::cholesky::llt::factor as llt;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

/// A pivot L_kk² up to this fraction of K_kk is rounding noise and counts as zero. In a system
/// after the stable transformation the fraction is at least the reciprocal condition number, seen
/// between 1e−3 and 1e−7; an exactly singular one leaves about 1e−16.
const PIVOT_LIMIT: f64 = 1e-13;

/// Pivots up to this fraction of K_kk are replaced in a matrix that has vanishing ones: functions
/// that are dependent up to rounding come with others that nearly are.
const LEFT_OUT_BELOW: f64 = 1e-10;

/// Substitute for a vanishing pivot: its unknown becomes zero, and the rest does not see it.
const LEFT_OUT: f64 = 1e40;

/// Rows of a panel that a thread takes at a time.
const ROWS: usize = 256;

/// The way to take pivots that vanish.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ZeroPivotPolicy {
    /// The matrix is to have none.
    Refused,
    /// Their unknowns are left out.
    LeftOut,
}

/// The reason why a factorisation ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FactorFailure {
    Memory,
    Pivot,
}

/// The rows from `first` on of the columns from `first` on, column by column.
#[derive(Debug, Default)]
pub(super) struct FrontPanel {
    pub(super) first: usize,
    pub(super) width: usize,
    height: usize,
    values: Vec<f64>,
}

impl FrontPanel {
    /// Zeros, in a matrix of `rows` rows.
    pub(super) fn new(first: usize, width: usize, rows: usize) -> Result<Self, FactorFailure> {
        let (height, mut values) = (rows - first, Vec::new());
        values.try_reserve_exact(width * height).map_err(|_| FactorFailure::Memory)?;
        values.resize(width * height, 0.0);
        Ok(Self { first, width, height, values })
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice())
    }

    /// The place behind its last column.
    pub(super) fn end(&self) -> usize {
        self.first + self.width
    }

    /// A column of the whole matrix, from a row on.
    pub(super) fn column(&self, column: usize, row: usize) -> &[f64] {
        let start = (column - self.first) * self.height;
        &self.values[start + row - self.first..start + self.height]
    }

    pub(super) fn column_mut(&mut self, column: usize, row: usize) -> &mut [f64] {
        let start = (column - self.first) * self.height;
        &mut self.values[start + row - self.first..start + self.height]
    }

    /// The diagonal.
    pub(super) fn diagonal(&self) -> impl Iterator<Item = f64> {
        (self.first..self.end()).map(|k| self.column(k, k)[0])
    }

    fn matrix(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.values, self.height, self.width)
    }

    /// The square at the diagonal, and what is below it.
    pub(super) fn parts(&self) -> (MatRef<'_, f64>, MatRef<'_, f64>) {
        self.matrix().split_at_row(self.width)
    }

    /// Eliminates its columns: L L^T = A of the square, and B ← B L^−T of what is below.
    pub(super) fn eliminate(
        &mut self,
        vanishing: ZeroPivotPolicy,
        parallel: bool,
    ) -> Result<(), FactorFailure> {
        let all = MatMut::from_column_major_slice_mut(&mut self.values, self.height, self.width);
        let (mut square, below) = all.split_at_row_mut(self.width);
        match vanishing {
            ZeroPivotPolicy::Refused => positive(square.as_mut())?,
            ZeroPivotPolicy::LeftOut => semidefinite(square.as_mut())?,
        }
        let divide = |rows: MatMut<'_, f64>| {
            solve_lower_triangular_in_place(square.as_ref(), rows.transpose_mut(), Par::Seq);
        };
        if parallel && below.nrows() > ROWS {
            let parts = below.nrows().div_ceil(ROWS);
            below.par_row_partition_mut(parts).for_each(divide);
        } else {
            divide(below);
        }
        Ok(())
    }

    /// Takes what the elimination of an earlier panel leaves away from this one.
    pub(super) fn subtract(&mut self, earlier: &Self) {
        let below = earlier.matrix().subrows(self.first - earlier.first, self.height);
        let own = below.subrows(0, self.width).transpose();
        let all = MatMut::from_column_major_slice_mut(&mut self.values, self.height, self.width);
        matmul(all, Accum::Add, below, own, -1.0, Par::Seq);
    }
}

/// L L^T of a definite matrix.
fn positive(mut square: MatMut<'_, f64>) -> Result<(), FactorFailure> {
    let scratch =
        llt::cholesky_in_place_scratch::<f64>(square.nrows(), Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| FactorFailure::Memory)?;
    let stack = MemStack::new(&mut buffer);
    let (regular, how) = (Default::default(), Default::default());
    llt::cholesky_in_place(square.as_mut(), regular, Par::Seq, stack, how)
        .map_err(|_| FactorFailure::Pivot)?;
    let is_positive = |k: usize| square[(k, k)] * square[(k, k)] > PIVOT_LIMIT;
    (0..square.nrows()).all(is_positive).then_some(()).ok_or(FactorFailure::Pivot)
}

/// L L^T of a semi-definite matrix with replaced pivots; none is finite where one is not.
fn semidefinite(mut square: MatMut<'_, f64>) -> Result<(), FactorFailure> {
    let n = square.nrows();
    let scratch = ldlt::cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| FactorFailure::Memory)?;
    let positive = vec![1; n];
    let replace = LdltRegularization {
        dynamic_regularization_signs: Some(&positive),
        dynamic_regularization_delta: LEFT_OUT,
        dynamic_regularization_epsilon: LEFT_OUT_BELOW,
    };
    let stack = MemStack::new(&mut buffer);
    let done =
        ldlt::cholesky_in_place(square.as_mut(), replace, Par::Seq, stack, Default::default());
    for k in 0..n {
        // small pivots are replaced, so that only a value that is not finite can be an error
        let root = if done.is_ok() { square[(k, k)].sqrt() } else { f64::NAN };
        square[(k, k)] = root;
        (k + 1..n).for_each(|i| square[(i, k)] *= root);
    }
    Ok(())
}
