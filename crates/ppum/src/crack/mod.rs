//! Cracks as polylines: their ends, tips and sides; [`LocalCrack`] and [`LocalTip`] evaluate them.

mod local;
mod polyline;

pub use local::{LocalCrack, LocalSegment, LocalTip, TipPoint};
pub use polyline::{Crack, CrackEnd, End, SegmentId, Side, TipId, tips};
