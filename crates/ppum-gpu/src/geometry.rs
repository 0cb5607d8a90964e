//! What changes with the view: frames of functions, cracks and holes, seen from the view's centre.

use ppum::crack::TipId;
use ppum::vec2::Vec2;

/// Where the functions of a group are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GroupFrame {
    /// The function 1.
    One,
    /// The side of a crack, by its index.
    Side(u32),
    /// World coordinates.
    World,
    /// A fixed origin and x axis.
    Fixed {
        /// Origin.
        origin: Vec2,
        /// Angle of the x axis, radians.
        angle: f64,
    },
    /// A crack tip.
    Tip(TipId),
}
