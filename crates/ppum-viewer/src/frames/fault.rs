//! The reasons why there are no pictures.

/// Where a mistake lies that keeps a picture from being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The step, the part, the functions or the weight.
    Subject,
    /// The quantity.
    Quantity,
    /// The deformation.
    Deformed,
    /// The lines at which the plate is mirrored.
    Mirror,
    /// Range, scale or map of the colours.
    Colors,
    /// Isolines, arrows, crosses.
    Overlays,
    /// The comparison with resampling.
    Compare,
    /// What is subtracted.
    Minus,
    /// The program itself.
    Program,
}

impl Fault {
    /// True if there is a picture all the same.
    pub(super) fn leaves_picture(self) -> bool {
        matches!(self, Self::Overlays | Self::Compare)
    }
}

/// The reason why there is no picture of what is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Where it arose.
    pub fault: Fault,
    /// The reason, with the remedy.
    pub message: String,
}

impl Failure {
    /// A failure of a stage, in words.
    pub(super) fn new(fault: Fault, message: impl Into<String>) -> Self {
        Self { fault, message: message.into() }
    }

    /// What an error means that arose in some place.
    pub(super) fn at<E: std::error::Error>(fault: Fault) -> impl Fn(E) -> Self {
        move |error| Self::new(fault, error.to_string())
    }
}
