//! The import of a drawing: its layers, the tolerance, and the body that comes of them.

use std::sync::Arc;

use egui::{Align2, Key, Label, Modifiers, RichText, ScrollArea, Sense, Ui, Window, vec2};
use ppum_import::ImportOptions;

use super::{note, wrong};
use crate::files::drawing::{DrawingSource, ImportedProblem};
use crate::query::BackgroundQuery;
use crate::shapes::{self, ImagePlacement};
use crate::solving::preview::Preview;
use crate::widgets::entry::entry;

/// A drawing while it is imported.
#[derive(Debug)]
pub struct ImportDialog {
    drawing: Arc<DrawingSource>,
    /// True for each layer that is taken.
    taken: Vec<bool>,
    tolerance: f64,
    found: BackgroundQuery<ImportOptions, ImportedProblem>,
}

impl ImportDialog {
    /// Takes all layers, with the tolerance of `ppum import`.
    #[must_use]
    pub fn new(drawing: Arc<DrawingSource>) -> Self {
        let taken = vec![true; drawing.layers.len()];
        let (ImportOptions { tolerance, .. }, found) = Default::default();
        Self { drawing, taken, tolerance, found }
    }

    /// The drawing.
    #[must_use]
    pub fn drawing(&self) -> &DrawingSource {
        &self.drawing
    }

    /// True while the drawing is read.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.found.is_working()
    }

    /// Shows it: `Some(None)` once it is closed, with the text of the problem if it is imported.
    pub fn show(&mut self, ui: &Ui) -> Option<Option<String>> {
        let options = self.options();
        let (theirs, drawing) = (options.clone(), Arc::clone(&self.drawing));
        let import = move |_: &dyn ppum::progress::Watcher| Some(drawing.import(&theirs));
        self.found.ask(&options, false, ui.ctx(), import);
        let known = self.found.newest().filter(|(asked, _)| *asked == options);
        let found = known.map(|(_, found)| Arc::clone(found));
        if known.is_none() {
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(15));
        }
        let (mut is_open, mut is_imported) = (true, false);
        let title = format!("Import {}", crate::files::name(&self.drawing.path));
        let window = Window::new(title).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
        window.open(&mut is_open).collapsible(false).resizable(false).show(ui.ctx(), |ui| {
            ui.set_width(WIDTH);
            self.layers(ui);
            self.tolerance(ui);
            result(ui, found.as_deref());
            let is_ready = found.as_ref().is_some_and(|found| found.is_ok());
            let button = ui.add_enabled(is_ready, egui::Button::new("Import"));
            // Enter in a field finishes that
            let has_field = ui.ctx().egui_wants_keyboard_input();
            let is_entered = !has_field && ui.input(|input| input.key_pressed(Key::Enter));
            is_imported = button.clicked() || is_entered;
        });
        let escape = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        match found.as_deref() {
            Some(Ok(found)) if is_imported => Some(Some(found.text.clone())),
            _ => (escape || !is_open).then_some(None),
        }
    }

    fn options(&self) -> ImportOptions {
        let chosen = self.drawing.layers.iter().zip(&self.taken);
        let chosen = chosen.filter(|(_, is_taken)| **is_taken).map(|(name, _)| name.clone());
        // curves without a name are taken with all layers
        let is_all = self.taken.iter().all(|is_taken| *is_taken);
        let layers = if is_all { Vec::new() } else { chosen.collect() };
        ImportOptions { tolerance: self.tolerance, layers }
    }

    fn layers(&mut self, ui: &mut Ui) {
        if self.drawing.layers.len() < 2 {
            return;
        }
        ui.label("Layers, groups or labels");
        let area = ScrollArea::vertical().id_salt("layers").max_height(130.0);
        area.auto_shrink([false, true]).show(ui, |ui| {
            let last = self.taken.iter().filter(|is_taken| **is_taken).count() == 1;
            ui.horizontal_wrapped(|ui| {
                for (name, is_taken) in self.drawing.layers.iter().zip(&mut self.taken) {
                    // of none at all nothing could be imported
                    ui.add_enabled(!(last && *is_taken), egui::Checkbox::new(is_taken, name));
                }
            });
        });
    }

    fn tolerance(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.label("Tolerance");
            let text = format!("{:e}", self.tolerance);
            let written = entry(ui, "Tolerance", &text, "1e-6", 70.0);
            let number = written.and_then(|text| text.trim().parse().ok());
            let number = number.filter(|number: &f64| number.is_finite());
            self.tolerance = number.map_or(self.tolerance, |number| number.clamp(1e-12, 1e-2));
            let text = "of the longer side: ends within it are joined";
            ui.label(note(ui, text));
        });
    }
}

/// Width of the window, and height of the image of the body \[points\].
const WIDTH: f32 = 400.0;
const HEIGHT: f32 = 210.0;

/// The body and what was not read, or why there is no body.
fn result(ui: &mut Ui, found: Option<&Result<ImportedProblem, String>>) {
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, HEIGHT), Sense::hover());
    let mut line = String::new();
    let mut notices: &[String] = &[];
    match found {
        Some(Ok(found)) => {
            notices = &found.notices;
            if let Some(preview) = &found.preview {
                let items = preview.items([WIDTH, HEIGHT].map(|n| n as u32), 1.0);
                shapes::draw(&ui.painter_at(rect), ImagePlacement::new(rect.min, 1.0), &items);
                line = counts(preview);
            }
        }
        Some(Err(error)) => {
            let text = RichText::new(error).color(wrong(ui));
            let builder = egui::UiBuilder::new().max_rect(rect);
            ui.new_child(builder).add(Label::new(text).wrap());
        }
        None => drop(ui.put(rect, egui::Spinner::new())),
    }
    ui.label(line);
    ScrollArea::vertical().id_salt("notices").max_height(60.0).show(ui, |ui| {
        for notice in notices {
            ui.label(note(ui, notice));
        }
    });
}

fn counts(preview: &Preview) -> String {
    let count = |number: usize, one: &str, many: &str| match number {
        1 => format!("1 {one}"),
        number => format!("{number} {many}"),
    };
    let [holes, cracks, ..] = preview.counts();
    let (holes, cracks) = (count(holes, "hole", "holes"), count(cracks, "crack", "cracks"));
    format!("An outline, {holes}, {cracks}")
}
