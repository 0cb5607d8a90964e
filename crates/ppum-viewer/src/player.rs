//! The steps of a series, one after the other.

use std::time::{Duration, Instant};

use ppum::dataset::Dataset;

use crate::session::Pane;
use crate::viewport::ViewState;

/// The player of the steps.
#[derive(Clone, Debug)]
pub struct Player {
    /// True while it plays.
    pub is_playing: bool,
    /// Steps in a second.
    pub speed: f64,
    /// True if it begins again after the last step.
    pub is_looping: bool,
    shown: Option<Instant>,
}

/// Speeds that can be chosen \[steps/s\].
pub const SPEEDS: std::ops::RangeInclusive<f64> = 0.2..=30.0;

impl Default for Player {
    fn default() -> Self {
        Self { is_playing: false, speed: 2.0, is_looping: true, shown: None }
    }
}

impl Player {
    /// Starts, from the first step if the last one is shown; or stops.
    pub fn toggle(&mut self, pane: &mut Pane, dataset: &Dataset) {
        let last = dataset.steps.len().saturating_sub(1);
        self.is_playing = !self.is_playing && last > 0;
        self.shown = None;
        if self.is_playing && pane.scene.subject.step_of(dataset) >= last {
            pane.scene.subject.step = Some(0);
        }
    }

    /// Goes on to the next step when it is time, and the one before was seen.
    pub fn advance(&mut self, ctx: &egui::Context, pane: &mut Pane, viewport: &ViewState) {
        let Some(opened) = viewport.opened.as_ref().filter(|_| self.is_playing) else { return };
        // an image that is ready wakes the window, and so does the first range of all steps
        let has_range = viewport.controls.step_range.progress_text().is_none();
        if viewport.frames.is_working() || !has_range {
            return;
        }
        let pause = Duration::from_secs_f64(1.0 / self.speed);
        let now = Instant::now();
        let shown = *self.shown.get_or_insert(now);
        if let Some(rest) = pause.checked_sub(now - shown).filter(|rest| !rest.is_zero()) {
            ctx.request_repaint_after(rest);
            return;
        }
        self.shown = None;
        let last = opened.dataset.steps.len().saturating_sub(1);
        let step = pane.scene.subject.step_of(&opened.dataset);
        match step < last {
            true => go(pane, &opened.dataset, 1),
            false if self.is_looping => pane.scene.subject.step = Some(0),
            false => self.is_playing = false,
        }
        ctx.request_repaint();
    }
}

/// Goes some steps on or back, to the ends at most.
pub fn go(pane: &mut Pane, dataset: &Dataset, by: isize) {
    let last = dataset.steps.len().saturating_sub(1);
    let step = pane.scene.subject.step_of(dataset).min(last);
    pane.scene.subject.step = Some(step.saturating_add_signed(by).min(last));
}

/// Leaves the choice of a step that a dataset does not have; what is to be told then.
pub fn mend(pane: &mut Pane, dataset: &Dataset) -> Option<String> {
    let step = pane.scene.subject.step.take_if(|step| *step >= dataset.steps.len())?;
    Some(format!("there is no step {step}; the last one is shown"))
}
