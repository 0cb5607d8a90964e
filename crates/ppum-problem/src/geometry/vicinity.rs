//! The location in the body that an error is about.

use std::fmt;

use ppum::text::{beside, trimmed};
use ppum::vec2::{Rect, Vec2};

/// The neighbourhood of a cell or a patch: users know places, not numbers of patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vicinity {
    /// Its middle.
    pub center: Vec2,
    /// Its extent from the middle along x and y.
    pub reach: Vec2,
}

impl From<Rect> for Vicinity {
    fn from(rect: Rect) -> Self {
        Self { center: rect.center(), reach: rect.size() * 0.5 }
    }
}

impl fmt::Display for Vicinity {
    /// `around (0.5, 0.25), up to 0.125 away`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { center, reach } = *self;
        let far = reach.x.max(reach.y);
        let [x, y] = [center.x, center.y].map(|v| trimmed(beside(v, far)));
        write!(f, "around ({x}, {y}), up to {} away", trimmed(far))
    }
}

/// `[0.5, -0.25]`
pub(crate) fn shown(p: Vec2) -> String {
    format!("[{}, {}]", trimmed(p.x), trimmed(p.y))
}
