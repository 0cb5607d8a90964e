//! The request of a pane.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_render::view::View;
use ppum_scene::compare::Compare;
use ppum_scene::scene::SceneRequest;

use super::subtrahend::SubtractedImage;

/// The request: a view of a scene of a dataset.
#[derive(Clone, Debug)]
pub struct FrameRequest {
    /// The dataset.
    pub dataset: Arc<Dataset>,
    /// The shown scene of it.
    pub scene: SceneRequest,
    /// Where, on how many pixels.
    pub view: View,
    /// The resampling beside it, if that is requested.
    pub compare: Option<Compare>,
    /// The subtrahend.
    pub minus: Option<SubtractedImage>,
}

impl FrameRequest {
    /// A view of a scene, and nothing beside it.
    #[must_use]
    pub fn new(dataset: Arc<Dataset>, scene: SceneRequest, view: View) -> Self {
        Self { dataset, scene, view, compare: None, minus: None }
    }

    /// True if another one is of the same datasets.
    pub(super) fn is_of_same(&self, other: &Self) -> bool {
        let is_same_left = match (&self.minus, &other.minus) {
            (Some(minus), Some(other)) => Arc::ptr_eq(&minus.dataset, &other.dataset),
            _ => true,
        };
        Arc::ptr_eq(&self.dataset, &other.dataset) && is_same_left
    }

    /// True if another one is of a body of the same shape and kind: of a file that was written
    /// again, for instance.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        let (dataset, other) = (&self.dataset, &other.dataset);
        dataset.domain == other.domain && dataset.equation == other.equation
    }

    /// True if another one differs in nothing but the place.
    pub(super) fn differs_in_place(&self, other: &Self) -> bool {
        *self != *other && *self == Self { view: self.view, ..other.clone() }
    }
}

impl PartialEq for FrameRequest {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.dataset, &other.dataset)
            && self.scene == other.scene
            && self.view == other.view
            && self.compare == other.compare
            && self.minus == other.minus
    }
}
