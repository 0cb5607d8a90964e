//! The range of the colours while one looks through a series: that of all its steps in the view,
//! as an animation of them has it.

use ppum_render::range::RangeChoice;
use ppum_render::view::View;
use ppum_scene::colors::ColorOptions;
use ppum_scene::overlays::Overlays;

use super::whole::{RangeSearch, Whole};
use crate::frames::FrameRequest;
use crate::session::Pane;
use crate::viewport::OpenDataset;

/// The range of all steps, found in the background.
#[derive(Default)]
pub struct StepRange {
    /// Its question, and since when that is asked \[s\].
    asked: Option<(FrameRequest, f64)>,
    search: Option<Whole>,
    found: Option<(FrameRequest, Option<RangeChoice>)>,
}

/// The range of a view is looked for when it has been at rest for so long \[s\].
const REST: f64 = 0.3;
/// Most pixels along a side of the images that it is found from.
const PIXELS: u32 = 512;

/// Returns what the range is found for: the steps of a series in a view, once one was chosen and as
/// long as the range is automatic.
pub(crate) fn asked(pane: &Pane, opened: &OpenDataset, view: View) -> Option<FrameRequest> {
    let (dataset, scene) = (&opened.dataset, &pane.scene);
    let is_series = dataset.steps.len() > 1 && scene.subject.step.is_some();
    if !is_series || pane.one_step_range || scene.colors.range != RangeChoice::Auto {
        return None;
    }
    let ColorOptions { scale, symmetric, .. } = scene.colors;
    let mut scene = scene.clone();
    scene.subject.step = None;
    scene.overlays = Overlays::default();
    scene.colors = ColorOptions { scale, symmetric, ..ColorOptions::default() };
    let larger = view.pixels[0].max(view.pixels[1]).div_ceil(PIXELS);
    let view = View { pixels: view.pixels.map(|n| n.div_ceil(larger)), ..view };
    Some(FrameRequest::new(dataset.clone(), scene, view))
}

impl StepRange {
    /// Goes on with what is asked for now, at a time of the window.
    pub(crate) fn advance(&mut self, ctx: &egui::Context, asked: Option<FrameRequest>, now: f64) {
        let Some(asked) = asked else { return *self = Self::default() };
        if self.asked.as_ref().is_none_or(|(known, _)| *known != asked) {
            // another place has the range of the one before until its own is found
            self.found.take_if(|(known, _)| *known != asked && !known.differs_in_place(&asked));
            (self.search, self.asked) = (None, Some((asked, now)));
        }
        let Some((asked, since)) = self.asked.as_ref().filter(|_| self.is_searching()) else {
            return;
        };
        let rest = since + REST - now;
        if self.found.is_some() && rest > 0.0 {
            return ctx.request_repaint_after_secs(rest as f32);
        }
        let steps = 0..asked.dataset.steps.len();
        let new = || Whole::of(ctx, Some(asked.clone()), steps);
        match self.search.get_or_insert_with(new).advance() {
            RangeSearch::Working => return,
            RangeSearch::Found(range) => self.found = Some((asked.clone(), Some(range))),
            RangeSearch::Failed(_) => self.found = Some((asked.clone(), None)),
        }
        self.search = None;
        ctx.request_repaint();
    }

    /// True until the range of what is asked for is known.
    pub(crate) fn is_searching(&self) -> bool {
        let found = self.found.as_ref().map(|(known, _)| known);
        self.asked.as_ref().is_some_and(|(asked, _)| found != Some(asked))
    }

    /// The range, if it is known.
    pub(crate) fn range(&self) -> Option<RangeChoice> {
        self.found.as_ref().and_then(|(_, range)| *range)
    }

    /// The progress of the first search, which the player waits for.
    pub(crate) fn progress_text(&self) -> Option<String> {
        let search = self.search.as_ref().filter(|_| self.found.is_none())?;
        Some(format!("range of colours: {}", search.progress_text()))
    }
}
