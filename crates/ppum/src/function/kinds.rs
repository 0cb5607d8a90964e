//! The kinds of functions, as data.

use super::indicator::Cut;
use crate::crack::TipId;
use crate::vec2::Vec2;

/// One entry of a step's function table.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Name for reports, e.g. `westergaard 1 of crack 0 end`.
    pub name: String,
    /// Its kind.
    pub kind: FunctionKind,
}

/// The kinds of functions a block can multiply its polynomial with.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FunctionKind {
    /// f = 1: the smooth part.
    One,
    /// f = +1 on the left of the crack's direction, −1 on the right: a jump.
    Side {
        /// Index of the crack.
        crack: u32,
    },
    /// f = 1 on one connected component of what cracks leave of a patch, 0 on the others: a jump
    /// where cracks meet.
    Component {
        /// The component's tree: the first cut is the root, each other one stands behind the one it
        /// follows from.
        cuts: Vec<Cut>,
    },
    /// f = ±1, the sign of a level field of a mesh.
    Level {
        /// Index of the level field among the step's fields.
        field: u32,
    },
    /// f = a formula of x, y, r, theta of its frame.
    Formula {
        /// The formula.
        text: String,
        /// The frame of x, y, r and theta.
        frame: Frame,
        /// Named constants the formula may use.
        parameters: Vec<(String, f64)>,
        /// Lines and points where it is not smooth, beside those the formula itself shows.
        declared: NonsmoothPoints,
        /// The role of the formula.
        role: Role,
    },
}

/// The role of a formula in a field. Values do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Role {
    /// The singular field of a crack tip.
    Tip,
    /// A term r^λ of the field at a corner.
    Corner,
    /// The field of a force at a point.
    Force,
    /// The kink at an interface of two materials.
    Interface,
    /// A user-defined function.
    #[default]
    User,
}

impl Role {
    /// All roles with their names in files and reports.
    pub const NAMES: [(Self, &'static str); 5] = [
        (Self::Tip, "tip"),
        (Self::Corner, "corner"),
        (Self::Force, "force"),
        (Self::Interface, "interface"),
        (Self::User, "user"),
    ];

    /// Its name, e.g. `tip`.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(role, _)| *role == self).map_or("user", |(_, name)| name)
    }
}

impl FunctionKind {
    /// The level fields that the function is made of.
    pub(crate) fn levels(&self) -> impl Iterator<Item = u32> {
        let (frame, sign) = match self {
            Self::Formula { frame: Frame::Levels(fields), .. } => (Some(*fields), None),
            Self::Level { field } => (None, Some(*field)),
            _ => (None, None),
        };
        frame.into_iter().flatten().chain(sign)
    }

    /// Returns the role of a formula; `None` for other kinds.
    #[must_use]
    pub fn role(&self) -> Option<Role> {
        match self {
            Self::Formula { role, .. } => Some(*role),
            _ => None,
        }
    }

    /// A user-defined formula without parameters and declarations.
    #[must_use]
    pub fn formula(text: &str, frame: Frame) -> Self {
        let (text, parameters, declared) =
            (text.to_owned(), Vec::new(), NonsmoothPoints::default());
        Self::Formula { text, frame, parameters, declared, role: Role::User }
    }
}

/// Places where a function is not smooth, as its author declares them; in the coordinates of its
/// frame. Quadrature honours them, evaluation does not need them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NonsmoothPoints {
    /// Segments across which the function or a derivative jumps.
    pub kinks: Vec<[Vec2; 2]>,
    /// Points at which the function or a derivative is infinite.
    pub singular: Vec<Vec2>,
}

/// The coordinates of a formula. In each of them r = √(x² + y²) and θ ∈ \[−π, π\] is the
/// polar angle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Frame {
    /// World coordinates.
    World,
    /// A fixed origin and x axis.
    Fixed {
        /// Origin.
        origin: Vec2,
        /// Angle of the x axis, radians.
        angle: f64,
    },
    /// A crack tip: origin at the tip, x along the direction of growth; θ jumps on the crack
    /// itself, kinks included.
    Tip(TipId),
    /// Two level fields of a mesh, as indices of the step's fields, are x and y: the distances
    /// along an interpolated crack and from it. θ jumps where y = 0 and x < 0.
    Levels([u32; 2]),
}
