//! Parts that panels are made of; they know nothing of plates.

pub mod chart;
pub mod chooser;
pub mod editor;
pub mod entry;

use egui::{Color32, RichText, Ui};

/// A button with a sign, which has a name too.
pub fn button(ui: &mut Ui, sign: &str, name: &str) -> egui::Response {
    let response = ui.button(sign).on_hover_text(name);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    response
}

/// A text that is cut off after so many letters.
pub(crate) fn elided(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// The colour of mistakes: red that is read on both grounds.
pub(crate) fn wrong(ui: &Ui) -> Color32 {
    match ui.visuals().dark_mode {
        true => Color32::from_rgb(255, 120, 110),
        false => Color32::from_rgb(185, 20, 20),
    }
}

/// Words beside a control, smaller and paler.
pub(crate) fn note(ui: &Ui, text: impl Into<String>) -> RichText {
    RichText::new(text).size(NOTE).color(ui.visuals().text_color().gamma_multiply(0.75))
}

/// Size of notes \[points\].
const NOTE: f32 = 11.5;
