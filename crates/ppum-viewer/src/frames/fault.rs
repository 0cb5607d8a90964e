//! The reasons why there are no images.

/// Where an error lies that keeps an image from being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultOrigin {
    /// The step, the part, the functions or the weight.
    Subject,
    /// The quantity.
    Quantity,
    /// The deformation.
    Deformed,
    /// The lines at which the body is mirrored.
    Mirror,
    /// Range, scale or map of the colours.
    Colors,
    /// Isolines, arrows, crosses.
    Overlays,
    /// The comparison with resampling.
    Compare,
    /// The subtrahend.
    Minus,
    /// The program itself.
    Program,
}

impl FaultOrigin {
    /// True if there is an image all the same.
    pub(super) fn leaves_picture(self) -> bool {
        matches!(self, Self::Overlays | Self::Compare)
    }
}

/// The reason why there is no image of what is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageFailure {
    /// Where it arose.
    pub fault: FaultOrigin,
    /// The reason, with the remedy.
    pub message: String,
}

impl ImageFailure {
    /// A failure of a viewport, in words.
    pub(super) fn new(fault: FaultOrigin, message: impl Into<String>) -> Self {
        Self { fault, message: message.into() }
    }

    /// Makes a failure of an error with this origin.
    pub(super) fn at<E: std::error::Error>(fault: FaultOrigin) -> impl Fn(E) -> Self {
        move |error| Self::new(fault, error.to_string())
    }
}
