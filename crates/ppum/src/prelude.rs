//! The names that almost every use of the crate begins with.

pub use crate::cover::Cover;
pub use crate::crack::{Crack, Side};
pub use crate::dataset::{Dataset, FieldData, Step};
pub use crate::equation::{Equation, Material, StressState};
pub use crate::field::Field;
pub use crate::function::{Function, FunctionKind};
pub use crate::quantity::Quantity;
pub use crate::vec2::{Rect, Vec2, vec2};
pub use crate::weight::WeightFunction;
