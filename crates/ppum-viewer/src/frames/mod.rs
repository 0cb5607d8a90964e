//! Pictures, computed in the background: the window says what is wanted, and takes the newest
//! there is.
//!
//! A picture comes about in stages, each of which keeps what it made last: the subject (field,
//! quantity, deformation), its values, their range, their colours, what lies over them, what
//! resampling gives. Only what has changed is made anew. Of slow values there is a rough picture
//! first: in single precision, of the strips that have come into view alone where a picture was
//! moved by whole pixels, at a quarter of the resolution where all of it would take too long. Once
//! one rests the picture is that of `ppum render`, to the last bit.

mod ease;
mod fault;
mod frame;
mod laid;
mod maker;
mod memo;
mod minus;
mod over;
mod paint;
mod renderer;
mod resampled;
mod stop;
mod strips;
mod subject;
#[cfg(test)]
mod tests;
mod values;
mod wanted;
mod worker;

use std::sync::Arc;
use std::time::{Duration, Instant};

pub use fault::{Failure, Fault};
pub use frame::Frame;
use frame::Outcome;
pub use laid::Laid;
use maker::Wish;
pub use minus::{Minus, Subtracted};
pub use paint::Painted;
pub use renderer::Backend;
pub use resampled::Other;
pub use wanted::Wanted;
use worker::Worker;

/// The pictures of one pane.
pub struct Frames {
    worker: Worker,
    asked: Option<(Wanted, Instant)>,
    newest: Option<Arc<Frame>>,
    failure: Option<Failure>,
}

/// Views that follow each other faster than this are those of someone who moves.
const MOVING: Duration = Duration::from_millis(500);
/// Who moved and has wanted nothing else for so long is at rest; longer where the window is slow.
const REST: Duration = Duration::from_millis(100);

impl Frames {
    /// Begins to make pictures; calls `wake` whenever there is something new.
    #[must_use]
    pub fn new(wake: impl Fn() + Send + 'static) -> Self {
        Self::with_backend(Backend::default(), wake)
    }

    /// The same with something else that computes the values.
    #[must_use]
    pub fn with_backend(backend: Backend, wake: impl Fn() + Send + 'static) -> Self {
        let worker = Worker::new(backend, Box::new(wake));
        Self { worker, asked: None, newest: None, failure: None }
    }

    /// Says what is wanted now. What was wanted before is stopped, unless it is nearly there.
    pub fn want(&mut self, wanted: Wanted) {
        let (at, mut rests_at) = (Instant::now(), None);
        if let Some((before, then)) = &self.asked {
            if *before == wanted {
                return;
            }
            let since = at.duration_since(*then);
            let is_moving = since < MOVING && wanted.differs_in_place(before);
            rests_at = is_moving.then(|| at + REST.max(since * 3 / 2));
            if !wanted.is_of_same(before) {
                self.failure = None;
            }
        }
        self.asked = Some((wanted.clone(), at));
        self.drop_foreign();
        self.worker.want(Wish { wanted, rests_at });
    }

    /// Takes what has been made since; true if that is something new.
    pub fn poll(&mut self) -> bool {
        let outcomes = self.worker.take();
        let is_new = !outcomes.is_empty();
        for outcome in outcomes {
            match outcome {
                Ok(frame) => {
                    let stays = |failure: &Failure| failure.fault.leaves_picture();
                    self.failure = self.failure.take().filter(|f| stays(f) && !frame.is_final);
                    self.newest = Some(frame);
                }
                Err(failure) => self.failure = Some(failure),
            }
        }
        self.drop_foreign();
        is_new
    }

    /// Forgets a picture of another dataset where it would stand for the one that is wanted: once
    /// that has none, or at once if the plate is another one.
    fn drop_foreign(&mut self) {
        let (Some((asked, _)), Some(newest)) = (&self.asked, &self.newest) else { return };
        let is_without =
            self.failure.as_ref().is_some_and(|failure| !failure.fault.leaves_picture());
        let is_near = !is_without && newest.wanted.is_alike(asked);
        if !newest.wanted.is_of_same(asked) && !is_near {
            self.newest = None;
        }
    }

    /// The newest picture, of whatever was wanted then.
    #[must_use]
    pub fn newest(&self) -> Option<&Arc<Frame>> {
        self.newest.as_ref()
    }

    /// The reason why there is no picture of what is wanted now.
    #[must_use]
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// True while something better than the newest picture is being made.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.worker.is_working()
    }
}
