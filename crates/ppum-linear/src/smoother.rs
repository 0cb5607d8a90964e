//! Block Gauss–Seidel: one sweep through the colours and one back.
//!
//! ```text
//! K = L + D + Lᵀ      forward: x = (D + L)⁻¹ f      backward: x ← x + (D + Lᵀ)⁻¹ (f − K x)
//! ```
//!
//! D holds the diagonal blocks, L what couples a block to earlier colours. A sweep from zero, a
//! correction and the sweep back make a symmetric positive definite preconditioner of whatever is
//! done between them. Blocks that nearly depend on each other, [clusters](super::clusters), are
//! relaxed together besides.

use super::block_matrix::{BlockMatrix, running_sum};
use super::clusters::{StrongCluster, clusters};
use super::inverse::inverse;
use super::rows::{BlockSubset, SymmetricRows, Vectors, add_product};
use faer::MatRef;
use rayon::prelude::*;
use std::cmp::Ordering;

/// A matrix with the inverses of its diagonal blocks.
#[derive(Debug)]
pub(super) struct Smoother<'a> {
    pub(super) rows: SymmetricRows<'a>,
    /// D⁻¹, block after block, row-major.
    inverses: Vec<f64>,
    /// Where the inverse of each block begins.
    starts: Vec<usize>,
    /// Blocks that are relaxed together besides.
    clusters: Vec<StrongCluster>,
}

impl<'a> Smoother<'a> {
    pub(super) fn new(rows: SymmetricRows<'a>) -> Self {
        let matrix = &rows.matrix;
        let all: Vec<Vec<f64>> =
            (0..matrix.n_blocks()).into_par_iter().map(|i| inverse(diagonal(matrix, i))).collect();
        let starts = running_sum(all.iter().map(Vec::len));
        Self { inverses: all.concat(), starts, clusters: clusters(&rows), rows }
    }

    /// Sweeps alone, to compare with.
    #[cfg(test)]
    pub(super) fn forget_clusters(&mut self) {
        self.clusters.clear();
    }

    /// Bytes of the matrix, its rows and the inverses.
    pub(super) fn bytes(&self) -> usize {
        self.rows.bytes()
            + size_of_val(self.inverses.as_slice())
            + size_of_val(self.starts.as_slice())
            + self.clusters.iter().map(StrongCluster::bytes).sum::<usize>()
    }

    /// An approximation of K⁻¹ f, and what it leaves: a sweep, then the clusters.
    pub(super) fn before(&self, f: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut x = vec![0.0; f.len()];
        self.sweep(0..self.rows.n_colours(), Ordering::is_lt, f, &mut x);
        let mut rest = self.residual(&x);
        for cluster in &self.clusters {
            cluster.relax(&self.rows, f, &mut x, &mut rest);
        }
        (x, rest)
    }

    /// The transposed way: the clusters in the other order, then the sweep back.
    pub(super) fn after(&self, f: &[f64], x: &mut [f64], mut rest: Vec<f64>) {
        for cluster in self.clusters.iter().rev() {
            cluster.relax_alone(&self.rows, f, x, &mut rest);
        }
        self.sweep((0..self.rows.n_colours()).rev(), Ordering::is_ne, f, x);
    }

    /// Relaxes block by block: (D + L)⁻¹ f forward from zero, x + (D + Lᵀ)⁻¹ (f − K x) backward.
    fn sweep(
        &self,
        colours: impl Iterator<Item = usize>,
        subset: BlockSubset,
        f: &[f64],
        x: &mut [f64],
    ) {
        for colour in colours {
            let (others, own) = Vectors::without(x, self.rows.of_colour(colour));
            self.rows.for_colour(colour, own, &|i, x| self.relax(i, subset, f, &others, x));
        }
    }

    /// f − K x for the x of a sweep from zero: −Lᵀ x.
    fn residual(&self, x: &[f64]) -> Vec<f64> {
        let mut residual = vec![0.0; x.len()];
        let x = Vectors::whole(x);
        self.rows.for_all(&mut residual, &|i, out| {
            self.rows.add_row(i, Ordering::is_gt, &x, -1.0, out);
        });
        residual
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
