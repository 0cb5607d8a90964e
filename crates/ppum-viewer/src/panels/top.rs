//! The bar above the plate.

use egui::Ui;

use super::player;
use crate::actions::Action;
use crate::desk::Desk;
use crate::widgets::{button, elided};

/// Letters of a title that has room.
const MOST: usize = 60;

/// A text on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Title, and what one does all the time.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    ui.horizontal_wrapped(|ui| {
        super::files::menu(ui, desk);
        let (_, stage) = desk.active();
        let title = stage.opened.as_ref().map_or("ppum", |opened| &opened.dataset.title);
        let title = one_line(title);
        let response = ui.strong(elided(&title, MOST));
        if title.chars().count() > MOST {
            response.on_hover_text(title);
        }
        for (sign, name, action) in [
            ("⌂", "Show the whole plate", Action::Fit),
            ("↶", "Undo", Action::Undo),
            ("↷", "Redo", Action::Redo),
            ("←", "Back to the view before", Action::Back),
            ("→", "Forward to the view after", Action::Forward),
            ("☰", "Find an action", Action::Palette),
            ("?", "Keys", Action::Help),
        ] {
            if button(ui, sign, name).clicked() {
                desk.actions.push(action);
            }
        }
        player::show(ui, desk);
    });
}
