//! The drawer below the plate: one page at a time.

pub mod plot;
pub mod problem;
pub mod series;
pub mod solver;
pub mod tips;

use egui::{Panel, Ui};

use crate::desk::Desk;
use crate::session::Page;
use crate::widgets::button;

/// Shows the open page with the names of all others above it.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let Some(page) = desk.session.drawer else { return };
    let most = (0.7 * ui.available_height()).max(120.0);
    let panel =
        Panel::bottom("drawer").resizable(true).default_size(280.0).size_range(120.0..=most);
    panel.show(ui, |ui| {
        ui.horizontal(|ui| {
            for other in Page::ALL {
                if ui.selectable_label(other == page, name(other)).clicked() {
                    desk.session.drawer = Some(other);
                }
            }
            if button(ui, "✗", "Close the drawer").clicked() {
                desk.session.drawer = None;
            }
        });
        ui.separator();
        // all the room there is, whatever the page needs: else the drawer would shrink to that
        let room = ui.available_size();
        ui.allocate_ui(room, |ui| {
            ui.set_min_size(room);
            match page {
                Page::Plot => plot::show(ui, desk),
                Page::Tips => tips::show(ui, desk),
                Page::Series => series::show(ui, desk),
                Page::Solver => solver::show(ui, desk),
                Page::Problem => problem::show(ui, desk),
            }
        });
    });
}

/// The name of a page.
#[must_use]
pub fn name(page: Page) -> &'static str {
    match page {
        Page::Plot => "Plot",
        Page::Tips => "Tips",
        Page::Series => "Series",
        Page::Solver => "Solver",
        Page::Problem => "Problem",
    }
}
