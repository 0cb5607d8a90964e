//! Images, computed in the background: the window says what is wanted, and takes the newest
//! there is.
//!
//! An image comes about in stages, each of which keeps what it made last: the subject (field,
//! quantity, deformation), its values, their range, their colours, what lies over them, what
//! resampling gives. Only what has changed is made again. Slow values are drawn roughly first: in
//! single precision, only on the strips that have come into view where an image was moved by whole
//! pixels, at a quarter of the resolution where all of it would take too long. Once the view is at
//! rest the image is that of `ppum render`, to the last bit.

mod ease;
mod fault;
mod frame;
mod maker;
mod overlay_shapes;
mod paint;
mod renderer;
mod request;
mod resampled;
mod strips;
mod subject;
#[cfg(test)]
mod tests;
mod values;
mod worker;

use std::sync::Arc;
use std::time::{Duration, Instant};

pub use fault::{FaultOrigin, ImageFailure};
use frame::FrameResult;
pub use frame::RenderedFrame;
pub use overlay_shapes::OverlayShapes;
pub use paint::ColoredImage;
pub use renderer::Backend;
use request::LatestRequest;
pub use request::{FrameRequest, SubtractedImage};
pub use resampled::ResampledView;
pub use subject::{FrameSubject, Subtrahend};
use worker::Worker;

/// The images of one pane.
pub struct PaneFrames {
    worker: Worker,
    asked: Option<(FrameRequest, Instant)>,
    newest: Option<Arc<RenderedFrame>>,
    failure: Option<ImageFailure>,
}

/// Views that follow each other faster than this are those of someone who moves.
const MOVING: Duration = Duration::from_millis(500);
/// A view that has not moved for so long is at rest; longer where the window is slow.
const REST: Duration = Duration::from_millis(100);

impl PaneFrames {
    /// Begins to make images; calls `wake` whenever there is something new.
    #[must_use]
    pub fn new(wake: impl Fn() + Send + 'static) -> Self {
        Self::with_backend(Backend::default(), wake)
    }

    /// Begins to make images with a given backend.
    pub(crate) fn with_backend(backend: Backend, wake: impl Fn() + Send + 'static) -> Self {
        let worker = Worker::new(backend, Box::new(wake));
        Self { worker, asked: None, newest: None, failure: None }
    }

    /// Sets the present request. The previous one is stopped, unless it is nearly done.
    pub fn want(&mut self, request: FrameRequest) {
        let (at, mut rests_at) = (Instant::now(), None);
        if let Some((before, then)) = &self.asked {
            if *before == request {
                return;
            }
            let since = at.duration_since(*then);
            let is_moving = since < MOVING && request.differs_in_place(before);
            rests_at = is_moving.then(|| at + REST.max(since * 3 / 2));
            if !request.is_of_same(before) {
                self.failure = None;
            }
        }
        self.asked = Some((request.clone(), at));
        self.drop_foreign();
        self.worker.want(LatestRequest { request, rests_at });
    }

    /// Takes what has been made since; true if that is something new.
    pub fn poll(&mut self) -> bool {
        let outcomes = self.worker.take();
        let is_new = !outcomes.is_empty();
        for outcome in outcomes {
            match outcome {
                Ok(frame) => {
                    let stays = |failure: &ImageFailure| failure.fault.leaves_picture();
                    self.failure = self.failure.take().filter(|f| stays(f) && !frame.is_final);
                    self.newest = Some(frame);
                }
                Err(failure) => self.failure = Some(failure),
            }
        }
        self.drop_foreign();
        is_new
    }

    /// Forgets an image of another dataset where it would stand for the one that is wanted: once
    /// that has none, or at once if the body is another one.
    fn drop_foreign(&mut self) {
        let (Some((asked, _)), Some(newest)) = (&self.asked, &self.newest) else { return };
        let is_without =
            self.failure.as_ref().is_some_and(|failure| !failure.fault.leaves_picture());
        let is_near = !is_without && newest.request.is_alike(asked);
        if !newest.request.is_of_same(asked) && !is_near {
            self.newest = None;
        }
    }

    /// The newest image, of whatever was wanted then.
    #[must_use]
    pub fn newest(&self) -> Option<&Arc<RenderedFrame>> {
        self.newest.as_ref()
    }

    /// The reason why there is no image of what is wanted now.
    #[must_use]
    pub fn failure(&self) -> Option<&ImageFailure> {
        self.failure.as_ref()
    }

    /// True while something better than the newest image is being made.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.worker.is_working()
    }
}
