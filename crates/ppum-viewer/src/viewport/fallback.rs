//! Replacement of choices that a dataset does not have: a file that was written again, a session of
//! another one.

use egui::{Align, Layout, Rect, RichText, Ui, UiBuilder, vec2};
use ppum_scene::colors::ColorOptions;
use ppum_scene::scene::Subject;

use crate::frames::{FaultOrigin, ImageFailure, PaneFrames};
use crate::session::Pane;
use crate::viewport::ViewState;
use crate::widgets::wrong;

impl ViewState {
    /// Drops the settings that keep a dataset from having any image, as if it had been opened
    /// without them; that can be undone. Where there is an image the error is for the user to
    /// correct, and the image stays.
    pub(super) fn fall_back(&mut self, pane: &mut Pane) {
        if self.frames.newest().is_some() {
            return;
        }
        let failure = self.frames.failure().cloned();
        self.told.extend(failure.and_then(|failure| leave(pane, &failure)));
    }

    /// Shows the whole body instead of a location that no view can show.
    pub fn show_whole(&mut self, pane: &mut Pane) {
        pane.place = None;
        self.camera.stop();
        self.told.push("the place that was chosen cannot be shown; the whole plate is".into());
    }
}

/// Leaves what a failure comes from; what is told of it, if there was something to leave.
fn leave(pane: &mut Pane, ImageFailure { fault, message }: &ImageFailure) -> Option<String> {
    let scene = &mut pane.scene;
    Some(match fault {
        FaultOrigin::Quantity => {
            let quantity = scene.quantity.take()?;
            format!("{quantity} cannot be shown: {message}. The default quantity is shown")
        }
        FaultOrigin::Subject => {
            let own = Subject { step: scene.subject.step, ..Subject::default() };
            change(&mut scene.subject, own)?;
            format!("what was replaced cannot be: {message}. Everything is as the file has it")
        }
        FaultOrigin::Deformed => {
            scene.deformed.take()?;
            format!("the plate cannot be deformed: {message}")
        }
        FaultOrigin::Mirror => {
            scene.mirror.take()?;
            format!("the plate cannot be mirrored: {message}")
        }
        FaultOrigin::Colors => {
            change(&mut scene.colors, ColorOptions::default())?;
            format!("the colours cannot be those chosen: {message}. The default ones are")
        }
        FaultOrigin::Overlays
        | FaultOrigin::Compare
        | FaultOrigin::Minus
        | FaultOrigin::Program => return None,
    })
}

/// Changes a value; none if it is that already.
fn change<T: PartialEq>(value: &mut T, to: T) -> Option<()> {
    (*value != to).then(|| *value = to)
}

/// Widest words \[points\].
const WIDEST: f32 = 440.0;

/// Says in the middle of the view why there is nothing to see; differences say so themselves.
pub(super) fn show(ui: &mut Ui, rect: Rect, frames: &PaneFrames) {
    let failure = frames.failure().filter(|failure| failure.fault != FaultOrigin::Minus);
    let (Some(failure), None) = (failure, frames.newest()) else { return };
    let width = (rect.width() - 40.0).clamp(40.0, WIDEST);
    let room = Rect::from_center_size(rect.center(), vec2(width, 0.5 * rect.height()));
    let builder = UiBuilder::new().max_rect(room).layout(Layout::top_down(Align::Center));
    let mut child = ui.new_child(builder);
    child.set_clip_rect(rect);
    let text = RichText::new(&failure.message).color(wrong(ui));
    child.add(egui::Label::new(text).wrap());
}
