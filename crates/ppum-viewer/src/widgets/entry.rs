//! A line of text that counts once it is finished.

use egui::{TextEdit, Ui};

/// Shows a text that can be edited, under a name; the new one once Enter or leaving the field
/// finishes it; Escape gives it up.
pub fn entry(ui: &mut Ui, name: &str, text: &str, hint: &str, width: f32) -> Option<String> {
    let id = ui.scope_id().with(name);
    let unfinished = ui.data(|data| data.get_temp::<String>(id));
    let mut edited = unfinished.unwrap_or_else(|| text.to_owned());
    let about = format!("{name}: {}", if edited.is_empty() { hint } else { &edited });
    let field = TextEdit::singleline(&mut edited).id(id.with("field")).hint_text(hint.to_owned());
    let response = ui.add(field.desired_width(width)).on_hover_text(about);
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::text_edit(true, text, &edited, hint);
        info.label = Some(name.to_owned());
        info
    });
    if response.lost_focus() {
        ui.data_mut(|data| data.remove::<String>(id));
        let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
        return (edited != text && !is_given_up).then_some(edited);
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, edited));
    }
    None
}
