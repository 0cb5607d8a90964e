//! Parts that panels are made of; they know nothing of plates.

pub mod chart;
pub mod chooser;
pub mod editor;
pub mod entry;

use egui::text::LayoutJob;
use egui::{Color32, FontId, Label, RichText, Ui, vec2};

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
    red(ui.visuals().dark_mode)
}

/// The same of a theme.
pub(crate) fn red(is_dark: bool) -> Color32 {
    match is_dark {
        true => Color32::from_rgb(255, 120, 110),
        false => Color32::from_rgb(185, 20, 20),
    }
}

/// Words beside a control, smaller and paler.
pub(crate) fn note(ui: &Ui, text: impl Into<String>) -> RichText {
    RichText::new(text).size(NOTE).color(pale(ui))
}

fn pale(ui: &Ui) -> Color32 {
    ui.visuals().text_color().gamma_multiply(0.75)
}

/// The same in a room that is always so many lines high, for words that change all the time; what has no room is told on
/// hover.
pub(crate) fn note_of(ui: &mut Ui, text: &str, lines: usize) {
    let width = ui.available_width();
    let mut job = LayoutJob::simple(text.to_owned(), FontId::proportional(NOTE), pale(ui), width);
    job.wrap.max_rows = lines;
    let galley = ui.painter().layout_job(job);
    let row = galley.rows.first().map_or(0.0, |row| row.rect().height());
    let (height, is_cut) = ((row * lines as f32).max(galley.size().y), galley.elided);
    ui.allocate_ui(vec2(width, height), |ui| {
        ui.set_min_height(height);
        let label = ui.add(Label::new(galley));
        label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
        if is_cut {
            label.on_hover_text(text);
        }
    });
}

/// Size of notes \[points\].
const NOTE: f32 = 11.5;
