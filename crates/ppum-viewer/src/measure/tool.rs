//! The tools that the mouse draws over the view, and their handles.

/// The effect of a drag over the view, or of a click.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// A line, from its start.
    Line,
    /// A circle, from its centre; around a tip if it begins at one.
    Circle,
    /// A ray from the nearest tip.
    Ray,
    /// The crack that is clicked.
    Crack,
    /// Probes, each where it is clicked.
    Probe,
}

impl Tool {
    /// Returns the hint for its use.
    pub(crate) fn hint(self) -> &'static str {
        match self {
            Self::Line => "drag a line over the plate",
            Self::Circle => "drag a circle from its centre; begin at a tip for K",
            Self::Ray => "drag away from a tip",
            Self::Crack => "click a crack",
            Self::Probe => "click points of the plate to keep their values",
        }
    }
}

/// A handle of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CurveHandle {
    From,
    To,
    Center,
    Radius,
}
