//! Plane geometry of bodies: what lies in a box, near a point, around a tip.

mod box_list;
mod clearance;
mod clip;
mod components;
mod cracks;
mod jumps;
mod material;
mod nearby;
mod straight;
mod vicinity;

pub use box_list::{BoxList, around, wider};
pub use clearance::{
    AMPLE_CLEARANCE, TipClearance, TipObstacle, bent_part, exceeds, from_tip, is_known,
    known_points, sure_side,
};
pub use clip::{
    clipped, distance, edge_inside, inside, is_on_rim, length_inside, meets, rim_crossings,
    runs_of_rim, solid_part, without,
};
pub(crate) use clip::{lies_along, solid_length};
pub(crate) use cracks::{Holes, edges_at, holes_at, holes_of, reaches, settled, with_ends};
pub use cracks::{crack, cracks};
pub use jumps::Jumps;
pub use material::{interface_distance, jumps_within};
pub(crate) use nearby::{Nearby, TooDense, first_pair};
pub(crate) use straight::needed;
pub use vicinity::Vicinity;
pub(crate) use vicinity::shown;
