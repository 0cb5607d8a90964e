//! Terms that features of a problem add to its weak form beside cells and boundary, as values of
//! one form for all features.
//!
//! - A `KnownField` is a part of the field whose coefficients are known, with its load: functions
//!   of the space, a right-hand side, a point where cells are small and estimates do not look.
//! - A [`FaceLaw`] gives the tractions between the faces of a crack from the field there: a term of
//!   K and J, of the estimate, of growth.
//! - A `HeldLine` is a line on which all fields have a component that is zero: a condition on the
//!   basis.
//!
//! A feature makes its values in a module of its own, and is registered in one of the functions
//! here. Features that exclude each other are listed in `ppum-problem/src/check/features.rs`.

mod contact;
mod forces;
mod held;
mod known;

pub use contact::{FaceLaw, FaceTraction};
pub use held::symmetry_of_field;
pub(crate) use held::{HeldLine, held_lines, is_held_exactly};
pub(crate) use known::{KnownField, on_side};

use ppum_problem::Problem;

/// The parts of the field that are known, in the order of their functions in tables.
pub fn known_fields(problem: &Problem) -> Vec<KnownField> {
    forces::fields(problem)
}

/// Returns the law between the faces of a crack, if they act on each other.
pub fn face_law(problem: &Problem, crack: u32) -> Option<FaceLaw> {
    FaceLaw::of(problem, crack)
}
