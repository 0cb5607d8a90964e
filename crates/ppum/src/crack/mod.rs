//! Cracks: their edges, ends, tips and sides; [`LocalCrack`] and [`LocalTip`] evaluate them.

mod local;
mod local_chain;
mod local_edge;
mod polyline;
#[cfg(test)]
mod tests;

pub use local::{LocalCrack, LocalTip, TipPoint};
pub use local_chain::EdgeGroup;
pub use local_edge::{LocalSegment, LocalVertex};
pub use polyline::{Crack, CrackEnd, End, SegmentId, Side, TipId, tips};
