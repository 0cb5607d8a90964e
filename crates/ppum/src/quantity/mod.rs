//! Quantities: the scalar that is drawn, probed or compared, from a field's value and gradient.
//!
//! With displacement u, strain ε = (∇u + ∇uᵀ)/2 and stress σ = λ tr(ε) I + 2μ ε. Where a derivative
//! does not exist (at a crack tip) quantities of the gradient are +∞: nothing is clamped.
//!
//! Quantities have names, or are [formulas](QuantityFormula) of those that have;
//! [`QuantityGradient`] has their exact gradients.

mod face;
mod foreign;
mod formula;
mod gradient;
mod kinds;
mod many;
mod material;
mod reflected;
mod reflection;
mod sample;
mod tensors;

pub use face::{FaceQuantity, face_names};
pub use formula::{
    QuantityBlock, QuantityFormula, QuantityFormulaError, QuantityInput, Vocabulary,
};
pub use gradient::{QuantityGradient, ValueWithGradient};
pub use kinds::{Axis, Quantity, QuantityError, available, names};
pub use material::MaterialGradient;
pub use reflected::ReflectedQuantity;
pub use reflection::{Reflection, ValueChange};
pub use sample::{Sample, Source};
