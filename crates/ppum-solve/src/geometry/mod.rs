//! Plane geometry of plates: what lies in a box, near a point, around a tip.

mod around;
mod clearance;
mod clip;
mod components;
mod jumps;
mod material;
mod placed;

pub use around::Around;
pub(crate) use clearance::{AMPLE_CLEARANCE, bent_part, from_tip, sure_side};
pub use clearance::{Obstacle, TipClearance};
pub(crate) use clip::{
    clipped, distance, inside, length_inside, meets, rim_crossings, runs_of_rim, segment_inside,
};
pub(crate) use jumps::Jumps;
pub(crate) use material::interface_distance;
pub(crate) use placed::{Placed, around, wider};

/// Part of a length by which another may exceed it and still be as long, and cosine of angles that
/// are right ones: lengths of cracks are often whole cells, and their rounding must not decide
/// which cells are divided.
const AS_LONG: f64 = 1e-6;

/// True if a length is larger than another by more than rounding of either.
pub(crate) fn exceeds(length: f64, other: f64) -> bool {
    length > other * (1.0 + AS_LONG)
}
