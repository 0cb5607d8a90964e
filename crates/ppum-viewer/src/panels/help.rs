//! The list of keys.

use egui::{Grid, Ui, Window};

use crate::actions::{ALL, GROUPS};

/// Shows the keys while it is open.
pub fn show(ui: &Ui, is_open: &mut bool) {
    Window::new("Keys").open(is_open).collapsible(false).show(ui.ctx(), |ui| {
        for group in GROUPS {
            ui.strong(group);
            Grid::new(group).num_columns(2).show(ui, |ui| {
                for entry in ALL.iter().filter(|entry| entry.group == group) {
                    let Some(key) = &entry.key else { continue };
                    ui.monospace(ui.ctx().format_shortcut(key));
                    ui.label(entry.name);
                    ui.end_row();
                }
            });
        }
    });
}
