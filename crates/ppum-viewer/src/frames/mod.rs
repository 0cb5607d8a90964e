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
mod worker;

use std::sync::Arc;
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum_render::view::View;
use ppum_scene::compare::Compare;
use ppum_scene::drawing::{Drawn, Shown};
use ppum_scene::scene::Scene;

use crate::field::OwnedField;
pub use laid::Laid;
use maker::Wish;
pub use minus::{Minus, Subtracted};
pub use paint::Painted;
pub use renderer::Backend;
pub use resampled::Other;
use worker::Worker;

/// What is wanted: a view of a scene of a dataset.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The dataset.
    pub dataset: Arc<Dataset>,
    /// What is shown of it, and how.
    pub scene: Scene,
    /// Where, on how many pixels.
    pub view: View,
    /// What resampling gives beside it, if that is asked for.
    pub compare: Option<Compare>,
    /// What is subtracted from it.
    pub minus: Option<Minus>,
}

impl Wanted {
    /// A view of a scene, and nothing beside it.
    #[must_use]
    pub fn new(dataset: Arc<Dataset>, scene: Scene, view: View) -> Self {
        Self { dataset, scene, view, compare: None, minus: None }
    }

    /// True if another one is of the same datasets.
    fn is_of_same(&self, other: &Self) -> bool {
        let is_same_left = match (&self.minus, &other.minus) {
            (Some(minus), Some(other)) => Arc::ptr_eq(&minus.dataset, &other.dataset),
            _ => true,
        };
        Arc::ptr_eq(&self.dataset, &other.dataset) && is_same_left
    }

    /// True if another one is of a plate of the same shape and kind: of a file that was written
    /// again, for instance.
    fn is_alike(&self, other: &Self) -> bool {
        let (dataset, other) = (&self.dataset, &other.dataset);
        dataset.domain == other.domain && dataset.equation == other.equation
    }

    /// True if another one differs in nothing but the place.
    fn differs_in_place(&self, other: &Self) -> bool {
        *self != *other && *self == Self { view: self.view, ..other.clone() }
    }
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.dataset, &other.dataset)
            && self.scene == other.scene
            && self.view == other.view
            && self.compare == other.compare
            && self.minus == other.minus
    }
}

/// A picture with all that it was made of.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What was wanted.
    pub wanted: Wanted,
    /// The field, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// What is shown.
    pub shown: Arc<Shown>,
    /// What was subtracted from it.
    pub subtracted: Option<Subtracted>,
    /// Its values; of a rough picture those of its own view.
    pub drawn: Arc<Drawn>,
    /// Their colours, and the view that they are of.
    pub picture: Arc<Painted>,
    /// What lies over them; of an older view until it is drawn anew.
    pub layers: Arc<Laid>,
    /// The view in whose pixels the layers are.
    pub layers_view: View,
    /// How many times its displacement the plate is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// What resampling gives, if that was asked for; of an older view until it is there.
    pub other: Option<Arc<Other>>,
    /// True if nothing better will come.
    pub is_final: bool,
    /// The reason why the processor draws in place of the graphics card that was to.
    pub note: Option<String>,
    /// What its values took \[s\].
    pub seconds: f64,
}

/// Where a mistake lies that keeps a picture from being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The step, the part, the functions or the weight.
    Subject,
    /// The quantity.
    Quantity,
    /// The deformation.
    Deformed,
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
    fn leaves_picture(self) -> bool {
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

type Outcome = Result<Arc<Frame>, Failure>;

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
