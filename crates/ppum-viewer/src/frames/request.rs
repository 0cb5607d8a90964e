//! The request of a pane.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum_render::view::View;
use ppum_scene::compare::Compare;
use ppum_scene::scene::{SceneRequest, Subject};

use crate::same_arc::SameArc;

/// The request: a view of a scene of a dataset.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRequest {
    /// The dataset.
    pub dataset: SameArc<Dataset>,
    /// The shown scene of it.
    pub scene: SceneRequest,
    /// Where, on how many pixels.
    pub view: View,
    /// The resampling beside it, if that is requested.
    pub compare: Option<Compare>,
    /// The subtrahend.
    pub minus: Option<SubtractedImage>,
}

/// Another image, which is subtracted from one of the same view.
#[derive(Clone, Debug, PartialEq)]
pub struct SubtractedImage {
    /// Its dataset.
    pub dataset: SameArc<Dataset>,
    /// The chosen step, part and replacements of the dataset.
    pub subject: Subject,
    /// The quantity.
    pub quantity: Option<String>,
}

impl FrameRequest {
    /// A view of a scene, and nothing beside it.
    #[must_use]
    pub fn new(dataset: Arc<Dataset>, scene: SceneRequest, view: View) -> Self {
        Self { dataset: dataset.into(), scene, view, compare: None, minus: None }
    }

    /// True if another one is of the same datasets.
    pub(super) fn is_of_same(&self, other: &Self) -> bool {
        let left = |request: &Self| request.minus.as_ref().map(|minus| minus.dataset.clone());
        let is_same_left = left(self).zip(left(other)).is_none_or(|(left, other)| left == other);
        self.dataset == other.dataset && is_same_left
    }

    /// True if another one is of a body of the same shape and kind: of a file that was written
    /// again, for instance.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        let (dataset, other) = (&self.dataset, &other.dataset);
        dataset.domain == other.domain && dataset.equation == other.equation
    }

    /// True if another one differs in nothing but the place.
    pub(crate) fn differs_in_place(&self, other: &Self) -> bool {
        *self != *other && *self == Self { view: self.view, ..other.clone() }
    }
}

/// The request, and the time when the moving view will be at rest.
#[derive(Clone, Debug)]
pub(super) struct LatestRequest {
    pub(super) request: FrameRequest,
    /// None if one does not move.
    pub(super) rests_at: Option<Instant>,
}

impl LatestRequest {
    /// How long it takes until one is at rest; none if one is.
    pub(super) fn moves_for(&self, now: Instant) -> Option<Duration> {
        let rest = self.rests_at?.checked_duration_since(now);
        rest.filter(|rest| !rest.is_zero())
    }
}

/// Whether a request is still the one to work for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RequestStatus {
    Current,
    /// There is another one by now.
    Replaced,
    /// The pane is closed.
    Closed,
}

/// Asks for the status, from any thread.
pub(super) type AskStatus<'a> = &'a (dyn Fn() -> RequestStatus + Sync);
