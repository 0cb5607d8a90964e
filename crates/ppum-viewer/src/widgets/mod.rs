//! Parts that panels are made of; they know nothing of datasets.

pub mod chart;
pub mod chooser;
pub mod editor;
pub mod entry;

use std::path::Path;

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Label, RichText, Stroke, Ui, Visuals, vec2};

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

/// The colour of errors: red that is read on both grounds.
pub(crate) fn wrong(ui: &Ui) -> Color32 {
    red(ui.visuals().dark_mode)
}

/// Colours that are seen without effort: every kind of text has a contrast of at least 4.5 to its
/// ground, and the outline of every control one of 3, as WCAG 2.2 asks for (1.4.3, 1.4.11).
pub(crate) fn make_readable(visuals: &mut Visuals) {
    visuals.error_fg_color = red(visuals.dark_mode);
    let [text, button, outline] = if visuals.dark_mode { [190, 205, 115] } else { [40, 40, 135] };
    let outline = Stroke::new(1.0, Color32::from_gray(outline));
    (visuals.widgets.inactive.bg_stroke, visuals.widgets.open.bg_stroke) = (outline, outline);
    if !visuals.dark_mode {
        visuals.warn_fg_color = Color32::from_rgb(160, 75, 0);
        visuals.hyperlink_color = Color32::from_rgb(0, 90, 170);
    }
    visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(text);
    visuals.widgets.inactive.fg_stroke.color = Color32::from_gray(button);
    visuals.weak_text_alpha = PALE;
}

/// The colour around the image: dark windows have a grey there, in which black ends of colour maps
/// and black cracks are seen to end.
pub(crate) fn ground(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_gray(GROUND) } else { visuals.extreme_bg_color }
}

const GROUND: u8 = 46;

/// Opacity of words that stand beside others.
const PALE: f32 = 0.75;

/// Returns the red of a theme.
fn red(is_dark: bool) -> Color32 {
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
    ui.visuals().text_color().gamma_multiply(PALE)
}

/// Shows a note in a space that is always so many lines high, for words that change all the time; a
/// tooltip has the text that does not fit.
pub(crate) fn note_of(ui: &mut Ui, text: &str, lines: usize) {
    lines_of(ui, text, pale(ui), lines);
}

/// Draws it in any colour.
pub(crate) fn lines_of(ui: &mut Ui, text: &str, color: Color32, lines: usize) {
    let width = ui.available_width();
    let mut job = LayoutJob::simple(text.to_owned(), FontId::proportional(NOTE), color, width);
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

/// A symbol such as `K_I` with what follows `_` below the line, smaller.
pub(crate) fn symbol(ui: &Ui, text: &str) -> LayoutJob {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let color = ui.visuals().strong_text_color();
    let (main, below) = text.split_once('_').unwrap_or((text, ""));
    let mut job = LayoutJob::default();
    job.append(main, 0.0, TextFormat::simple(font.clone(), color));
    let small = FontId::new(0.72 * font.size, font.family);
    let low = TextFormat { valign: egui::Align::BOTTOM, ..TextFormat::simple(small, color) };
    job.append(below, 0.0, low);
    job
}

/// Aligns the numbers of each column at their points, in letters of one width.
pub(crate) fn align_points<const N: usize>(rows: &mut [[String; N]]) {
    let digits = |text: &str| text.chars().take_while(|c| matches!(c, '0'..='9' | '−')).count();
    for column in 0..N {
        let cells = rows.iter_mut().map(|row| &mut row[column]);
        let cells = cells.map(|cell| (*cell = cell.replace('-', "−"), cell).1);
        let numbers: Vec<_> = cells.filter(|cell| digits(cell) > 0).collect();
        let most = numbers.iter().map(|cell| digits(cell)).max().unwrap_or(0);
        for cell in numbers {
            cell.insert_str(0, &" ".repeat(most - digits(cell)));
        }
    }
}

/// Says in which folder a file of some name goes; all of the name on hover.
pub(crate) fn note_folder(ui: &mut Ui, path: &Path) {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(&path).display().to_string();
    let text = note(ui, format!("in {folder}"));
    ui.add(Label::new(text).truncate()).on_hover_text(path.display().to_string());
}

/// Size of notes \[points\].
const NOTE: f32 = 11.5;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_numbers_are_below_each_other() {
        let mut rows =
            [["1.5", "a"], ["-120.25", "7"], ["–", "12"]].map(|row| row.map(str::to_owned));
        align_points(&mut rows);
        assert_eq!(rows, [["   1.5", "a"], ["−120.25", " 7"], ["–", "12"]]);
    }

    /// The luminance of a colour as WCAG 2 defines it.
    fn luminance(color: Color32) -> f32 {
        let [r, g, b, _] = egui::Rgba::from(color).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast(text: Color32, ground: Color32) -> f32 {
        let text = ground.blend(text);
        let [a, b] = [luminance(text), luminance(ground)];
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// Black, at which maps begin and in which cracks are drawn, ends where the ground begins.
    #[test]
    fn black_is_seen_on_the_ground() {
        for visuals in [Visuals::dark(), Visuals::light()] {
            assert!(contrast(Color32::BLACK, ground(&visuals)) >= 1.5);
        }
    }

    /// Boxes that are ticked, fields and buttons are seen whether they are in use or not.
    #[test]
    fn all_controls_have_outlines_that_eyes_see() {
        for mut visuals in [Visuals::dark(), Visuals::light()] {
            make_readable(&mut visuals);
            let widgets = &visuals.widgets;
            for widget in [&widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open] {
                let Stroke { width, color } = widget.bg_stroke;
                for ground in [visuals.panel_fill, visuals.window_fill] {
                    let found = contrast(color, ground);
                    assert!(width >= 1.0 && found >= 3.0, "{visuals:?}: {color:?} {found}");
                }
            }
        }
    }

    #[test]
    fn all_text_has_the_contrast_that_eyes_need() {
        for mut visuals in [Visuals::dark(), Visuals::light()] {
            make_readable(&mut visuals);
            let pale = visuals.text_color().gamma_multiply(PALE);
            let texts = [
                ("text", visuals.text_color()),
                ("note", pale),
                ("weak text", visuals.weak_text_color()),
                ("mistake", visuals.error_fg_color),
                ("warning", visuals.warn_fg_color),
                ("link", visuals.hyperlink_color),
                ("button", visuals.widgets.inactive.fg_stroke.color),
            ];
            for (name, text) in texts {
                let found = contrast(text, visuals.panel_fill);
                assert!(found >= 4.5, "{name}, dark: {}: {found}", visuals.dark_mode);
            }
        }
    }
}
