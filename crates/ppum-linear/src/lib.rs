//! Linear algebra: block matrices, solvers of linear systems, eigenvalues of small dense matrices.
//!
//! Nothing here knows fields or patches: a block is what belongs to one index.

mod block_matrix;
mod cholesky;
mod clusters;
mod conjugate;
mod dense;
mod eigen;
mod elimination;
mod factor;
mod front;
mod inverse;
mod multilevel;
mod neighbours;
mod nonnegative;
mod null_space;
mod ordering;
mod panel;
mod pencil;
mod rows;
mod smoother;
mod solver;
mod spectrum;
mod substitution;
#[cfg(test)]
mod test_matrices;
mod transfer;

pub use block_matrix::{BlockMatrix, BlockPattern};
pub use cholesky::Cholesky;
pub use dense::{add_at, product, taken, times};
pub use eigen::{EigenError, SymmetricEigen, inverse_root_diagonal, scaled};
pub use elimination::fill;
pub use multilevel::{CoarseLevel, Multilevel};
pub use nonnegative::nonnegative_residual;
pub use pencil::largest_eigenvalue;
pub use solver::{ConvergenceHistory, LinearError, LinearSolution, LinearSolver};
pub use spectrum::Spectrum;
pub use transfer::Transfer;
