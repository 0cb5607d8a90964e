//! Images in motion: the steps of a series, or the deformed body with a factor that grows and
//! falls. All have one range.
//!
//! A [`SeriesAnimation`] looks at all frames first, then draws them one after the other: none but
//! one of their fields needs to be in memory.

mod film;
mod frames;

pub use film::{AnimationFormat, SeriesAnimation};
pub use frames::{FrameSource, FrameView, InMemory, MotionKind, MovingError, Work, with_subject};
