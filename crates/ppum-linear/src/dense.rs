//! Small dense matrices.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

/// Adds a block to the entries of a matrix in some rows and columns, by their numbers.
pub fn add_at(sum: &mut Mat<f64>, rows: &[usize], columns: &[usize], block: &Mat<f64>) {
    for (b, &column) in columns.iter().enumerate() {
        let sum = sum.col_as_slice_mut(column);
        rows.iter().zip(block.col_as_slice(b)).for_each(|(&row, entry)| sum[row] += entry);
    }
}

/// The entries of a matrix in some rows and columns, by their numbers.
pub fn taken(all: &Mat<f64>, rows: &[usize], columns: &[usize]) -> Mat<f64> {
    let mut part = Mat::zeros(rows.len(), columns.len());
    for (b, &column) in columns.iter().enumerate() {
        let all = all.col_as_slice(column);
        part.col_as_slice_mut(b).iter_mut().zip(rows).for_each(|(entry, &row)| *entry = all[row]);
    }
    part
}

/// A B, on one thread: what runs beside others does not divide its work.
pub fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut product = Mat::zeros(a.nrows(), b.ncols());
    matmul(product.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    product
}

/// Aᵀ x
pub fn times(a: MatRef<'_, f64>, x: &[f64]) -> Vec<f64> {
    (0..a.ncols()).map(|j| (0..a.nrows()).map(|k| a[(k, j)] * x[k]).sum()).collect()
}
