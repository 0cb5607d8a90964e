//! Plane geometry of plates: what lies in a box, near a point, around a tip.

mod around;
mod clearance;
mod clip;
mod components;
mod jumps;
mod material;
mod placed;

pub use around::Around;
pub(crate) use clearance::{
    AMPLE_CLEARANCE, bent_part, exceeds, from_tip, points_of_forces, sure_side,
};
pub use clearance::{Obstacle, TipClearance};
pub(crate) use clip::{
    clipped, distance, inside, is_on_rim, length_inside, meets, rim_crossings, runs_of_rim,
    segment_inside, solid_part, without,
};
pub(crate) use jumps::Jumps;
pub(crate) use material::{eigenstrain_jumps, interface_distance};
pub(crate) use placed::{Placed, around, wider};
