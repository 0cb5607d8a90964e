//! Block Gauss–Seidel: one sweep through the colours and one back.
//!
//! ```text
//! K = L + D + Lᵀ      forward: x = (D + L)⁻¹ f      backward: x ← x + (D + Lᵀ)⁻¹ (f − K x)
//! ```
//!
//! D holds the diagonal blocks, L what couples a block to earlier colours. A sweep from zero, a
//! correction and the sweep back make a symmetric positive definite preconditioner of whatever is
//! done between them. Blocks that nearly depend on each other, [knots](super::knots), are relaxed
//! together besides.

use super::block_matrix::BlockMatrix;
use super::inverse::inverse;
use super::knots::{Knot, knots};
use super::rows::{BlockSubset, SymmetricRows, Vectors, add_product};
use faer::MatRef;
use rayon::prelude::*;

/// A matrix with the inverses of its diagonal blocks.
#[derive(Debug)]
pub(super) struct Smoother<'a> {
    pub(super) rows: SymmetricRows<'a>,
    /// D⁻¹, block after block, row-major.
    inverses: Vec<f64>,
    /// Where the inverse of each block begins.
    starts: Vec<usize>,
    /// Blocks that are relaxed together besides.
    knots: Vec<Knot>,
}

impl<'a> Smoother<'a> {
    pub(super) fn new(rows: SymmetricRows<'a>) -> Self {
        let matrix = &rows.matrix;
        let all: Vec<Vec<f64>> =
            (0..matrix.n_blocks()).into_par_iter().map(|i| inverse(diagonal(matrix, i))).collect();
        let mut starts = vec![0];
        all.iter().for_each(|inverse| starts.push(starts[starts.len() - 1] + inverse.len()));
        Self { inverses: all.concat(), starts, knots: knots(&rows), rows }
    }

    /// Sweeps alone, to compare with.
    #[cfg(test)]
    pub(super) fn forget_knots(&mut self) {
        self.knots.clear();
    }

    /// Bytes of the matrix, its rows and the inverses.
    pub(super) fn bytes(&self) -> usize {
        self.rows.bytes()
            + size_of_val(self.inverses.as_slice())
            + size_of_val(self.starts.as_slice())
            + self.knots.iter().map(Knot::bytes).sum::<usize>()
    }

    /// An approximation of K⁻¹ f, and what it leaves: a sweep, then the knots.
    pub(super) fn before(&self, f: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut x = self.forward(f);
        let mut rest = self.residual(&x);
        for knot in &self.knots {
            knot.relax(&self.rows, f, &mut x, &mut rest);
        }
        (x, rest)
    }

    /// The transposed way: the knots in the other order, then the sweep back.
    pub(super) fn after(&self, f: &[f64], x: &mut [f64], mut rest: Vec<f64>) {
        for knot in self.knots.iter().rev() {
            knot.relax_alone(&self.rows, f, x, &mut rest);
        }
        self.backward(f, x);
    }

    /// (D + L)⁻¹ f
    fn forward(&self, f: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; f.len()];
        for colour in 0..self.rows.n_colours() {
            let (others, own) = Vectors::without(&mut x, self.rows.of_colour(colour));
            self.rows
                .for_colour(colour, own, &|i, x| self.relax(i, BlockSubset::Before, f, &others, x));
        }
        x
    }

    /// f − K x for the x of [`Smoother::forward`]: −Lᵀ x.
    fn residual(&self, x: &[f64]) -> Vec<f64> {
        let mut residual = vec![0.0; x.len()];
        let x = Vectors::whole(x);
        self.rows.for_all(&mut residual, &|i, out| {
            self.rows.add_row(i, BlockSubset::After, &x, -1.0, out);
        });
        residual
    }

    /// x ← x + (D + Lᵀ)⁻¹ (f − K x)
    fn backward(&self, f: &[f64], x: &mut [f64]) {
        for colour in (0..self.rows.n_colours()).rev() {
            let (others, own) = Vectors::without(x, self.rows.of_colour(colour));
            self.rows
                .for_colour(colour, own, &|i, x| self.relax(i, BlockSubset::Others, f, &others, x));
        }
    }

    /// x_i ← D_ii⁻¹ (f_i − Σ_j K_ij x_j)
    fn relax(&self, i: usize, subset: BlockSubset, f: &[f64], others: &Vectors<'_>, x: &mut [f64]) {
        let mut rest = f[self.rows.unknowns(i)].to_vec();
        self.rows.add_row(i, subset, others, -1.0, &mut rest);
        x.fill(0.0);
        add_product(&self.inverses[self.starts[i]..self.starts[i + 1]], &rest, 1.0, x);
    }
}

fn diagonal(matrix: &BlockMatrix, i: usize) -> MatRef<'_, f64> {
    matrix.block(i, i).expect("a block is coupled to itself")
}
