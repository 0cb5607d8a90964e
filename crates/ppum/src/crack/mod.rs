//! Cracks: their edges, ends, tips and sides; [`LocalCrack`] and [`LocalTip`] evaluate them.

mod local;
mod polyline;
#[cfg(test)]
mod tests;

pub use local::{LocalCrack, LocalSegment, LocalTip, LocalVertex, TipPoint};
pub use polyline::{Crack, CrackEnd, End, SegmentId, Side, TipId, tips};
