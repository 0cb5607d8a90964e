//! Plane geometry of bodies: what lies in a box, near a point, around a tip.

mod box_list;
mod clearance;
mod clip;
mod components;
mod jumps;
mod material;
mod vicinity;

pub use box_list::{BoxList, around, wider};
pub use clearance::{
    AMPLE_CLEARANCE, TipClearance, TipObstacle, bent_part, exceeds, from_tip, is_known,
    known_points, sure_side,
};
pub use clip::{
    clipped, distance, inside, is_on_rim, length_inside, meets, rim_crossings, runs_of_rim,
    segment_inside, solid_part, without,
};
pub use jumps::Jumps;
pub use material::{interface_distance, jumps_within};
pub use vicinity::Vicinity;
