//! A line of text that counts once it is finished.

use egui::{Color32, TextEdit, TextStyle, Ui};

use super::elided;

/// Shows a text that can be edited, under a name; the new one once Enter or leaving the field
/// finishes it; Escape gives it up.
pub fn entry(ui: &mut Ui, name: &str, text: &str, hint: &str, width: f32) -> Option<String> {
    let id = ui.scope_id().with(name);
    let field_id = id.with("field");
    let unfinished = ui.data(|data| data.get_temp::<String>(id));
    let is_written = unfinished.is_some() || ui.memory(|memory| memory.has_focus(field_id));
    let whole = unfinished.unwrap_or_else(|| text.to_owned());
    let about = format!("{name}: {}", if whole.is_empty() { hint } else { &whole });
    let mut edited = if is_written { whole.clone() } else { fitting(ui, &whole, width) };
    let field = TextEdit::singleline(&mut edited).id(field_id).hint_text(hint.to_owned());
    let response = ui.add(field.desired_width(width)).on_hover_text(about);
    response.widget_info(|| {
        let shown = if is_written { &edited } else { &whole };
        let mut info = egui::WidgetInfo::text_edit(true, text, shown, hint);
        info.label = Some(name.to_owned());
        info
    });
    if response.lost_focus() {
        ui.data_mut(|data| data.remove::<String>(id));
        let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
        // a text that is only shown may be cut off
        return (is_written && edited != text && !is_given_up).then_some(edited);
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, if is_written { edited } else { whole }));
    }
    None
}

/// A text as far as a field of this width has room for it.
fn fitting(ui: &Ui, text: &str, width: f32) -> String {
    let (font, room) =
        (TextStyle::Body.resolve(ui.style()), width - 2.0 * ui.spacing().button_padding.x);
    let has_room = |text: &String| {
        let galley = ui.painter().layout_no_wrap(text.clone(), font.clone(), Color32::WHITE);
        galley.size().x <= room
    };
    let all = (0..=text.chars().count()).rev().map(|most| elided(text, most));
    all.into_iter().find(has_room).unwrap_or_default()
}
