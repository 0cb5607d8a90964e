//! Pictures in motion: the steps of a series, or the deformed plate with a factor that grows and
//! falls. All have one range.
//!
//! A [`Film`] looks at all frames first, then draws them one after the other: none but one of their
//! fields needs to be in memory.

mod film;
mod frames;

pub use film::{AnimationFormat, Film};
pub use frames::{FrameView, Frames, InMemory, Moving, MovingError, Work, with_subject};
