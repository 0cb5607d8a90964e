//! The range of the whole body, of one step or of all: found in the background, then fixed.

use std::collections::VecDeque;
use std::ops::Range as Steps;
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_render::range::RangeChoice;
use ppum_scene::overlays::Overlays;
use ppum_scene::scene::SceneRequest;

use crate::camera;
use crate::frames::{FrameRequest, PaneFrames, SubtractedImage};

/// A range that is looked for.
pub struct Whole {
    frames: PaneFrames,
    /// The request of all steps; none of a body without size.
    request: Option<FrameRequest>,
    steps: VecDeque<usize>,
    total: usize,
    found: Option<[f64; 2]>,
}

/// Pixels of the images that it is found from.
const PIXELS: [u32; 2] = [512, 512];

/// The state of the search for a range.
#[derive(Clone, Debug, PartialEq)]
pub enum RangeSearch {
    /// It is looked for.
    Working,
    /// The range.
    Found(RangeChoice),
    /// The reason why there is none.
    Failed(String),
}

impl Whole {
    /// Looks for the range of a scene on the whole body at some steps, or of its difference from
    /// another one, whatever its range and its overlays are.
    #[must_use]
    pub fn new(
        ctx: &egui::Context,
        dataset: &Arc<Dataset>,
        (scene, minus): (&SceneRequest, Option<SubtractedImage>),
        steps: Steps<usize>,
    ) -> Self {
        let mut scene =
            SceneRequest { overlays: Overlays::default(), deformed: None, ..scene.clone() };
        scene.colors.range = RangeChoice::Auto;
        let view = camera::view(None, dataset.domain.bounds, PIXELS, 0);
        let new = |view| FrameRequest::new(Arc::clone(dataset), scene, view);
        Self::of(ctx, view.map(|view| FrameRequest { minus, ..new(view) }), steps)
    }

    /// Looks for the range of what is requested at some steps.
    pub(super) fn of(
        ctx: &egui::Context,
        request: Option<FrameRequest>,
        steps: Steps<usize>,
    ) -> Self {
        let ctx = ctx.clone();
        Self {
            frames: PaneFrames::new(move || ctx.request_repaint()),
            request,
            total: steps.len(),
            steps: steps.collect(),
            found: None,
        }
    }

    /// The progress of the search as text.
    pub(crate) fn progress_text(&self) -> String {
        format!("{} of {} steps", self.total - self.steps.len(), self.total)
    }

    /// Takes what has been found since.
    pub fn advance(&mut self) -> RangeSearch {
        if self.frames.poll() {
            if let Some(failure) = self.frames.failure() {
                return RangeSearch::Failed(failure.message.clone());
            }
            self.take();
        }
        let Some(&step) = self.steps.front() else { return self.end() };
        let Some(mut request) = self.request.clone() else {
            return RangeSearch::Failed("the plate has no size".into());
        };
        request.scene.subject.step = Some(step);
        self.frames.want(request);
        RangeSearch::Working
    }

    /// Adds the range of an image that is done.
    fn take(&mut self) {
        let Some(frame) = self.frames.newest() else { return };
        if self.frames.is_working()
            || frame.request.scene.subject.step != self.steps.front().copied()
        {
            return;
        }
        self.steps.pop_front();
        if !frame.colored.has_values {
            return;
        }
        let norm = &frame.colored.normalization;
        let [min, max] = self.found.unwrap_or([norm.min(), norm.max()]);
        self.found = Some([min.min(norm.min()), max.max(norm.max())]);
    }

    fn end(&self) -> RangeSearch {
        match self.found {
            Some([min, max]) => RangeSearch::Found(RangeChoice::Fixed(min, max)),
            None => RangeSearch::Failed("the quantity has no finite values on the plate".into()),
        }
    }
}
