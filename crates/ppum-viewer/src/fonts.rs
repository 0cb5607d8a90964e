//! The letters of the window: those of figures, with the signs of buttons.

use std::sync::Arc;

use egui::{FontData, FontDefinitions, FontFamily};

const TEXT: &[u8] = include_bytes!("../data/DejaVuSans-window.ttf");
const FIXED: &[u8] = include_bytes!("../data/DejaVuSansMono-window.ttf");

/// DejaVu Sans, and DejaVu Sans Mono for texts that are edited.
pub(crate) fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let mut add = |name: &str, file: &'static [u8]| {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(file)));
    };
    add("text", TEXT);
    add("fixed", FIXED);
    let both = |names: [&str; 2]| names.map(str::to_owned).to_vec();
    fonts.families.insert(FontFamily::Proportional, both(["text", "fixed"]));
    fonts.families.insert(FontFamily::Monospace, both(["fixed", "text"]));
    fonts
}
