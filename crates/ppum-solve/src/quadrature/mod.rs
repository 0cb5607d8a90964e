//! Quadrature: where the solver looks at the fields.
//!
//! The leaf cells of a cover tile the domain's box. `Quadrature::cell` divides a cell into pieces
//! on which all integrands of the method are smooth and gives each a Gauss rule:
//!
//! 1. rectangles with a constant set of covering patches;
//! 2. cut at kinks of the partition functions, where these do not cancel;
//! 3. cut by the crack segments that meet the rectangle, each of which divides the pieces that it
//!    meets along its line, so that all of them stay convex; the straight extensions of cracks,
//!    across which sides jump, cut too, and straight kinks of the active functions and of
//!    the material; and along the normals where arcs of different curves meet;
//! 4. near a point at which an active function is singular, triangles with their apex there and a
//!    rule for the powers of r that occur (`SingularGrowth`), and bisection of pieces that are
//!    closer to it than their diameter;
//! 5. cut along curved kinks, the pieces getting sides that follow the curve;
//! 6. the same along the arcs of cracks and rims, and what lies in a hole dropped;
//! 7. divided until rules resolve functions that may vary fast (`Probes`).
//!
//! Points are an anchor plus offsets. Near a singular point the anchor is that point itself, so
//! that the distance to it carries no rounding of the coordinates. `Quadrature::edge` does the
//! same along edges and faces of cracks, `Quadrature::rim` along the rims of holes,
//! [`Quadrature::disc`] for the domain integrals of stress intensity.
//!
//! Nothing here knows fields, formulas or basis functions: `SmoothnessGeometry` says where
//! integrands are not smooth.

mod adapt;
mod arcs;
mod cell;
mod chart;
mod curve;
mod edge;
mod edge_line;
mod error_estimate;
mod gauss;
mod geometry;
mod graded_interval;
mod holes;
mod local_curve;
mod orders;
mod piece;
mod polygon;
mod roots;
mod rule;
mod singular;
mod split;
#[cfg(test)]
mod tests;

pub use cell::{CoveredCell, Disc, Quadrature, circumference};
pub(crate) use curve::may_meet;
pub(crate) use edge::closed_meet;

pub use error_estimate::QuadratureErrorEstimate;
pub use gauss::gauss;
pub use gauss::{GaussRule, closed};
pub use geometry::CrackFace;
pub(crate) use geometry::{
    BranchCoordinate, KinkLine, LevelFunction, Probes, SingularGrowth, Singularity,
    SmoothnessGeometry,
};
pub(crate) use orders::Orders;
pub(crate) use roots::{clamp_non_finite, sign_changes, zero};
pub use rule::{CellRule, EdgeRule};
