//! The corpus of fields: what every renderer must draw alike, and how alike.
//!
//! A [`DrawingCase`] is a dataset with windows to look at and quantities to draw. [`Truth`]
//! evaluates a window point by point in double precision and says what a renderer may miss:
//!
//! - *local scale*: the largest magnitude, in the 3 × 3 pixels around one, of the quantity and of
//!   what it is made of: |u| for values, |∇u| for derivatives (Young's modulus is of size one in
//!   all cases), |∇u|² for the energy density, since a component may pass zero where its neighbours
//!   do not. |∇u| counts at least as a tenth of its mean: a patch of degree 0 has none. Quantities
//!   of the partition have the scale one, or their own;
//! - *band*: pixels whose centre is within [`BAND`] pixels of a crack or its straight continuation,
//!   of the border of a patch's support or of the domain's rim. There a rounded coordinate decides
//!   what is seen. They are left out, and their share is bounded by the tests.

mod cases;
mod truth;
mod window;

pub use cases::{
    DrawingCase, arc_zooms, coverings, equations, functions, junction_zooms, junctions, wholes,
    zooms,
};
pub use truth::{BAND, Differences, ExpectedValues, Truth};
pub use window::Window;
