//! What is shown while no dataset is open: files of before, and examples.

use egui::{RichText, ScrollArea, Ui};

use crate::actions::Action;
use crate::desk::Desk;
use crate::files::examples;

/// Shows it.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let room = ui.available_width();
    ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
    ScrollArea::vertical().id_salt("start").auto_shrink([false; 2]).show(ui, |ui| {
        let width = (room - 32.0).clamp(200.0, 760.0);
        ui.add_space(16.0);
        ui.horizontal(|ui| {
            ui.add_space((0.5 * (room - width)).max(12.0));
            ui.vertical(|ui| {
                ui.set_width(width);
                page(ui, desk);
            });
        });
    });
}

fn page(ui: &mut Ui, desk: &mut Desk<'_>) {
    ui.heading("ppum");
    ui.label("Fields with cracks, exact at every pixel, down to the tip.");
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if ui.button(RichText::new("Open a file…").strong()).clicked() {
            desk.actions.push(Action::Open);
        }
        ui.weak("Ctrl+O, or drop it here: a dataset (.h5), a problem (.toml), a session");
    });
    ui.add_space(12.0);
    ui.strong("Recent files");
    recent(ui, desk);
    ui.add_space(12.0);
    ui.strong("Examples");
    ui.weak("A click solves the problem, within seconds mostly, and shows it with its text.");
    ui.add_space(4.0);
    let columns = ((ui.available_width() / 240.0) as usize).clamp(1, 3);
    egui::Grid::new("examples").num_columns(columns).spacing([16.0, 6.0]).show(ui, |ui| {
        for (k, example) in examples::ALL.iter().enumerate() {
            if ui.button(example.title()).clicked() {
                desk.actions.push(Action::Example(k));
            }
            if (k + 1) % columns == 0 {
                ui.end_row();
            }
        }
    });
}

/// Files with their folders.
fn recent(ui: &mut Ui, desk: &mut Desk<'_>) {
    let recent = desk.files.kept.recent.clone();
    if recent.is_empty() {
        ui.weak("None yet.");
    }
    for path in recent {
        ui.horizontal(|ui| {
            if ui.button(crate::files::name(&path)).clicked() {
                let pane = desk.session.active;
                desk.files.open(&path, pane, crate::files::read::Why::Opened);
            }
            let folder = path.parent().map(|folder| folder.display().to_string());
            ui.add(egui::Label::new(RichText::new(folder.unwrap_or_default()).weak()).truncate());
        });
    }
}
