//! Modes of a singular symmetric matrix, K z = 0, in the way of iteration.
//!
//! K u = f has solutions for balanced f alone, zᵀ f = 0. The part of a load outside of the range is
//! taken by the functionals r_k that would hold the modes, as a penalty γ Σ r_k r_kᵀ takes it
//! whatever its size:
//!
//! ```text
//! f ← f − Σ s_k r_k,   zᵀ f = 0
//! ```

use super::conjugate::{dot, norm};
use super::rows::SymmetricRows;
use faer::Mat;
use faer::linalg::solvers::Solve;

/// The modes of a matrix, orthonormal, and functionals that hold them.
#[derive(Clone, Debug, Default)]
pub(super) struct NullSpace {
    pub(super) modes: Vec<Vec<f64>>,
    functionals: Vec<Vec<f64>>,
}

impl NullSpace {
    /// The kernel that some vectors span.
    pub(super) fn new(vectors: Vec<Vec<f64>>, functionals: Vec<Vec<f64>>) -> Self {
        let mut kernel = Self { modes: Vec::new(), functionals };
        for mut vector in vectors {
            // twice, so that rounding leaves nothing
            kernel.project(&mut vector);
            kernel.project(&mut vector);
            let norm = norm(&vector);
            vector.iter_mut().for_each(|x| *x /= norm);
            kernel.modes.push(vector);
        }
        kernel
    }

    /// x ← x − Σ z zᵀ x
    pub(super) fn project(&self, x: &mut [f64]) {
        for mode in &self.modes {
            let part = dot(mode, x);
            x.iter_mut().zip(mode).for_each(|(x, z)| *x -= part * z);
        }
    }

    /// Makes a load balanced.
    pub(super) fn balance(&self, f: &mut [f64]) {
        let n = self.modes.len();
        if n == 0 {
            return;
        }
        let works = Mat::from_fn(n, n, |k, l| dot(&self.modes[k], &self.functionals[l]));
        let unbalanced = Mat::from_fn(n, 1, |k, _| dot(&self.modes[k], f));
        let forces = works.partial_piv_lu().solve(unbalanced);
        for (k, functional) in self.functionals.iter().enumerate() {
            f.iter_mut().zip(functional).for_each(|(f, r)| *f -= forces[(k, 0)] * r);
        }
        // what rounding has left
        self.project(f);
    }

    /// The largest ‖K z‖ over the stiffness of the stiffest unknown; not a number where modes
    /// are none.
    pub(super) fn force(&self, rows: &SymmetricRows<'_>, largest_diagonal: f64) -> f64 {
        let of = |mode: &Vec<f64>| {
            let mut product = vec![0.0; mode.len()];
            rows.multiply(mode, &mut product);
            norm(&product) / largest_diagonal
        };
        self.modes.iter().map(of).fold(0.0, |most, force| if force <= most { most } else { force })
    }
}
