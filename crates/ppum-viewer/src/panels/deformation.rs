//! The deformed plate.

use egui::Ui;

use crate::desk::Desk;

/// Shows it.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let _ = (ui, desk);
}
