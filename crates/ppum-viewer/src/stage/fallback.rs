//! What is shown where something was chosen that a dataset does not have: a file that was written
//! anew, a session of another one.

use egui::{Align, Layout, Rect, RichText, Ui, UiBuilder, vec2};
use ppum_scene::colors::Colors;
use ppum_scene::scene::Subject;

use crate::frames::{Failure, Fault, Frames};
use crate::session::Pane;
use crate::stage::Stage;
use crate::widgets::wrong;

impl Stage {
    /// Leaves what keeps a dataset from having any picture, as if it was opened without; that can
    /// be undone. Where there is a picture of it the mistake is to be mended, and the
    /// picture stays.
    pub(super) fn fall_back(&mut self, pane: &mut Pane) {
        if self.frames.newest().is_some() {
            return;
        }
        let failure = self.frames.failure().cloned();
        self.told.extend(failure.and_then(|failure| leave(pane, &failure)));
    }

    /// Shows the whole plate in place of a place that no view has.
    pub fn show_whole(&mut self, pane: &mut Pane) {
        pane.place = None;
        self.flight = None;
        self.told.push("the place that was chosen cannot be shown; the whole plate is".into());
    }
}

/// Leaves what a failure comes from; what is told of it, if there was something to leave.
fn leave(pane: &mut Pane, Failure { fault, message }: &Failure) -> Option<String> {
    let scene = &mut pane.scene;
    match fault {
        Fault::Quantity => {
            let quantity = scene.quantity.take()?;
            Some(format!("{quantity} cannot be shown: {message}. The default quantity is shown"))
        }
        Fault::Subject => {
            let own = Subject { step: scene.subject.step, ..Subject::default() };
            (scene.subject != own).then(|| {
                scene.subject = own;
                format!("what was replaced cannot be: {message}. Everything is as the file has it")
            })
        }
        Fault::Deformed => {
            scene.deformed.take()?;
            Some(format!("the plate cannot be deformed: {message}"))
        }
        Fault::Mirror => {
            scene.mirror.take()?;
            Some(format!("the plate cannot be mirrored: {message}"))
        }
        Fault::Colors => (scene.colors != Colors::default()).then(|| {
            scene.colors = Colors::default();
            format!("the colours cannot be those chosen: {message}. The default ones are")
        }),
        Fault::Overlays | Fault::Compare | Fault::Minus | Fault::Program => None,
    }
}

/// Widest words \[points\].
const WIDEST: f32 = 440.0;

/// Says in the middle of the plate why there is nothing to see; differences say so themselves.
pub(super) fn show(ui: &mut Ui, rect: Rect, frames: &Frames) {
    let failure = frames.failure().filter(|failure| failure.fault != Fault::Minus);
    let (Some(failure), None) = (failure, frames.newest()) else { return };
    let width = (rect.width() - 40.0).clamp(40.0, WIDEST);
    let room = Rect::from_center_size(rect.center(), vec2(width, 0.5 * rect.height()));
    let builder = UiBuilder::new().max_rect(room).layout(Layout::top_down(Align::Center));
    let mut child = ui.new_child(builder);
    child.set_clip_rect(rect);
    let text = RichText::new(&failure.message).color(wrong(ui));
    child.add(egui::Label::new(text).wrap());
}
