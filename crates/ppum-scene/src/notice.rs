//! What is told where something that was asked for is not seen.

use std::fmt;

/// Something that was asked for and is not seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    /// None of the levels that were listed occurs.
    NoIsoline,
    /// No cross has room.
    NoCross,
    /// No arrow has room.
    NoArrow,
    /// Supports and loads without a problem file.
    NoProblem,
    /// Supports and loads of a problem file that cannot be read.
    UnreadableProblem,
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoIsoline => "no isoline lies in the picture: its values pass none of the levels",
            Self::NoCross => "no cross stands in the picture; choose a smaller distance",
            Self::NoArrow => "no arrow stands in the picture; choose a smaller distance",
            Self::NoProblem => {
                "the dataset holds no problem file, so its supports and loads are not known"
            }
            Self::UnreadableProblem => {
                "the dataset's problem file cannot be read, so its supports and loads are not known"
            }
        })
    }
}
