//! The drawer below the view: one page at a time.

pub mod plot;
mod preview;
pub mod problem;
pub mod series;
pub mod series_table;
pub mod solver;
pub mod tips;

use egui::{Panel, Ui};

use crate::actions::Action;
use crate::panel_context::PanelContext;
use crate::session::DrawerPage;
use crate::widgets::button;

/// Shows the names of all pages, and the open one below them.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let Some(page) = context.session.drawer else {
        Panel::bottom("pages")
            .resizable(false)
            .show(ui, |ui| ui.horizontal(|ui| tabs(ui, context)));
        return;
    };
    let most = (0.7 * ui.available_height()).max(120.0);
    let panel =
        Panel::bottom("drawer").resizable(true).default_size(280.0).size_range(120.0..=most);
    panel.show(ui, |ui| {
        ui.horizontal(|ui| {
            tabs(ui, context);
            if button(ui, "✗", "Close the drawer").clicked() {
                context.session.drawer = None;
            }
        });
        ui.separator();
        // all the room there is, whatever the page needs: else the drawer would shrink to that
        let room = ui.available_size();
        ui.allocate_ui(room, |ui| {
            ui.set_min_size(room);
            match page {
                DrawerPage::Plot => plot::show(ui, context),
                DrawerPage::Tips => tips::show(ui, context),
                DrawerPage::Series => series::show(ui, context),
                DrawerPage::Solver => solver::show(ui, context),
                DrawerPage::Problem => problem::show(ui, context),
            }
        });
    });
}

/// The names of the pages; a click opens one, or closes it.
fn tabs(ui: &mut Ui, context: &mut PanelContext<'_>) {
    for page in DrawerPage::ALL {
        let is_open = context.session.drawer == Some(page);
        if ui.selectable_label(is_open, name(page)).clicked() {
            context.actions.push(Action::Drawer(page));
        }
    }
}

/// The name of a page.
#[must_use]
pub fn name(page: DrawerPage) -> &'static str {
    match page {
        DrawerPage::Plot => "Plot",
        DrawerPage::Tips => "Tips and K",
        DrawerPage::Series => "Series",
        DrawerPage::Solver => "Solver",
        DrawerPage::Problem => "Problem",
    }
}
