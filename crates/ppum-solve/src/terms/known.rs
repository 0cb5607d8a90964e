//! Parts of the field that are known.

use ppum::crack::{SegmentId, Side};
use ppum::dataset::BoxPartition;
use ppum::function::Function;
use ppum::vec2::{Rect, Vec2};

/// A part of the field that is known except for a smooth rest: functions times coefficients,
/// singular at a point where a load acts.
pub struct KnownField {
    pub at: Vec2,
    pub load: Vec2,
    /// The face of a crack on which the load acts, if the point lies on one.
    pub face: Option<(SegmentId, Side)>,
    /// Radius of the disc in which the field stands for what is not smooth.
    pub(super) room: f64,
    /// Radius of the disc that the patches that hold the point must lie in.
    pub reach: f64,
    pub(crate) functions: Vec<Function>,
    /// The coefficient of each function in each component.
    pub(crate) coefficients: Vec<[f64; 2]>,
}

impl KnownField {
    /// The patches that have the field, ascending: those that hold the point, and those in
    /// the room.
    pub(crate) fn patches(&self, partition: &BoxPartition, bounds: &Rect) -> Vec<u32> {
        let has = |&k: &u32| {
            let support = partition.support(k as usize);
            support.contains(self.at) || self.is_near(&support.intersection(bounds), self.room)
        };
        (0..partition.len() as u32).filter(has).collect()
    }

    fn is_near(&self, part: &Rect, radius: f64) -> bool {
        part.corners().iter().all(|p| (*p - self.at).length() < radius)
    }

    /// True if the patches that hold the point have room, and are not much larger than the
    /// distance to the next boundary.
    pub fn fits(&self, partition: &BoxPartition, bounds: &Rect) -> bool {
        (0..partition.len()).all(|k| self.fits_in(&partition.support(k), bounds))
    }

    /// True if one patch fits, or does not hold the point.
    pub(crate) fn fits_in(&self, support: &Rect, bounds: &Rect) -> bool {
        !support.contains(self.at) || self.is_near(&support.intersection(bounds), self.reach)
    }
}

/// A formula that is zero on the other side of a crack.
pub(crate) fn on_side(text: &str, side: Option<(u32, Side)>) -> String {
    match side {
        None => text.into(),
        Some((crack, Side::Above)) => format!("(1 + side({crack}))/2*{text}"),
        Some((crack, Side::Below)) => format!("(1 - side({crack}))/2*{text}"),
    }
}
