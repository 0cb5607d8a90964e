//! Small dense matrices.

use faer::Mat;

/// Adds a block to the entries of a matrix in some rows and columns, by their numbers.
pub(crate) fn add_at(sum: &mut Mat<f64>, rows: &[usize], columns: &[usize], block: &Mat<f64>) {
    for (b, &column) in columns.iter().enumerate() {
        for (a, &row) in rows.iter().enumerate() {
            sum[(row, column)] += block[(a, b)];
        }
    }
}
