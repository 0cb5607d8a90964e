//! Evaluation of a field: v = Σ_i φ_i v_i with gradient and Hessian.
//!
//! A [`Field`] is a dataset's field at one step, compiled. [`Field::at`] looks at it from an
//! anchor; points are `anchor + offset`. The weights, weight gradients and weighted local fields of
//! the covering patches are summed and divided once (Üffinger et al. 2011, equations (4),
//! (9), (10)):
//!
//! ```text
//! S = Σ W_i     U = Σ W_i v_i     u = U / S     ∇u = (∇U − u ∇S) / S
//! ```

mod compiled;
mod functions;
mod lanes;
mod local;

pub use compiled::{Field, FieldError};
pub use local::{LocalField, PartitionOfUnity};
