//! The quantity: by its name or by a formula.

use egui::Ui;

use crate::desk::Desk;

/// A field for a name or formula; a mistake stands below it, while the last good picture stays.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let (pane, _) = desk.active();
    let mut text = pane.scene.quantity.clone().unwrap_or_default();
    let label = ui.label("Quantity or formula");
    let field = egui::TextEdit::singleline(&mut text).code_editor().hint_text("von-mises");
    if ui.add(field).labelled_by(label.id).changed() {
        pane.scene.quantity = (!text.trim().is_empty()).then_some(text);
    }
}
