//! The drawer below the plate, page by page.

pub mod plot;
pub mod tips;

use egui::Ui;

use crate::app::PAGES;
use crate::desk::Desk;
use crate::session::Page;

/// The tabs and the page that is open.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let Some(open) = desk.session.drawer else { return };
    ui.horizontal(|ui| {
        for page in PAGES {
            if ui.selectable_label(page == open, name(page)).clicked() {
                desk.session.drawer = Some(page);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if super::top::button(ui, "×", "Close the drawer").clicked() {
                desk.session.drawer = None;
            }
        });
    });
    match open {
        Page::Plot => plot::show(ui, desk),
        Page::Tips => tips::show(ui, desk),
        Page::Series | Page::Solver | Page::Problem => {}
    }
}

fn name(page: Page) -> &'static str {
    match page {
        Page::Plot => "Plot",
        Page::Tips => "Tips",
        Page::Series => "Series",
        Page::Solver => "Solver",
        Page::Problem => "Problem",
    }
}
