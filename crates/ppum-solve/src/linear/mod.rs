//! Linear algebra: block matrices, solvers of linear systems, eigenvalues of small dense matrices.
//!
//! Nothing here knows fields or patches: a block is what belongs to one index.

mod block_matrix;
mod cholesky;
mod conjugate;
mod dense;
mod eigen;
mod elimination;
mod factor;
mod front;
mod inverse;
mod kernel;
mod knots;
mod multilevel;
mod neighbours;
mod nonnegative;
mod ordering;
mod pencil;
mod rows;
mod smoother;
mod solver;
mod spectrum;
mod strip;
mod sweep;
#[cfg(test)]
mod test_matrices;
mod transfer;

pub(crate) use block_matrix::{BlockMatrix, BlockPattern};
pub(crate) use cholesky::Cholesky;
pub(crate) use dense::{add_at, product, taken, times};
pub use eigen::EigenError;
pub(crate) use eigen::{SymmetricEigen, inverse_root_diagonal, scaled};
pub(crate) use elimination::fill;
pub(crate) use multilevel::{Coarse, Multilevel};
pub(crate) use nonnegative::nonnegative_residual;
pub(crate) use pencil::largest_eigenvalue;
pub use solver::LinearError;
pub(crate) use solver::{LinearSolution, LinearSolver};
pub use spectrum::Spectrum;
pub(crate) use transfer::Transfer;
