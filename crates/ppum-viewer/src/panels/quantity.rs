//! The quantity: chosen by its name, or written as a formula.

use egui::{Button, RichText, Ui, vec2};
use ppum::quantity::Quantity;
use ppum_scene::quantity::{DisplayedQuantity, default_quantity};

use super::{failure, wrong};
use crate::field::OwnedField;
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::shapes::plain;
use crate::widgets::chooser::named;
use crate::widgets::editor::{EditedText, TextDiagnostic};
use crate::widgets::lines_of;
use std::borrow::Cow;
use std::sync::Arc;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let field = viewport.controls.known.field().cloned();
    let default = field.as_ref().map_or("", |field| default_quantity(field.field()));
    let current = pane.scene.quantity.clone().unwrap_or_else(|| default.to_owned());
    let controls = &mut viewport.controls;
    let words = field.as_deref().map_or(String::new(), |field| words(&current, field));
    let button = Button::new(RichText::new(words)).right_text("▾").truncate();
    if ui
        .add_sized([ui.available_width(), 24.0], button)
        .accessible_name("Choose a quantity")
        .clicked()
    {
        controls.quantities.toggle();
    }
    let choices = &controls.known.choices;
    let mut chosen = controls.quantities.show(ui, "Search quantities", &current, choices, named);
    let names = controls.known.names.clone();
    let subject = EditedText {
        name: "Quantity or formula",
        current: &current,
        names: &names,
        version: version(field.as_ref()),
    };
    let check = |text: &str| check(text, field.as_deref());
    let editor = controls.editor("quantity");
    chosen = chosen.or(editor.show_text(ui, &subject, check));
    // nothing below moves when there is an error or no formula
    let size = vec2(ui.available_width(), ROW);
    ui.allocate_ui(size, |ui| {
        ui.set_min_height(ROW);
        if let Some(error) = editor.error() {
            return lines_of(ui, error, wrong(ui), 2);
        }
        let Some(text) = formula_of(&current, field.as_deref()) else { return };
        let button = ui.button("Show its formula");
        if button.on_hover_text("As a formula, it can be changed").clicked() {
            chosen = Some(text);
        }
    });
    if let Some(text) = chosen {
        pane.scene.quantity = (text != default).then_some(text);
    }
    failure(ui, viewport, FaultOrigin::Quantity);
}

/// Height of the row below the text, in which two lines of an error have room \[points\].
const ROW: f32 = 28.0;

/// Another number for another field.
pub(super) fn version(field: Option<&Arc<OwnedField>>) -> usize {
    field.map_or(0, |field| Arc::as_ptr(field) as usize)
}

fn check(text: &str, field: Option<&OwnedField>) -> Result<(), TextDiagnostic> {
    let Some(field) = field else { return Ok(()) };
    DisplayedQuantity::parse(text, field.field())
        .map(|_| ())
        .map_err(|error| TextDiagnostic::of_quantity(&error, text))
}

/// The words for what a text shows; the text itself if it shows nothing.
fn words(text: &str, field: &OwnedField) -> String {
    let field = field.field();
    match DisplayedQuantity::parse(text, field) {
        Ok(shown) => {
            let [symbol, unit] = shown.words(field).map(|text| plain(&text));
            if unit.is_empty() { symbol } else { format!("{symbol} [{unit}]") }
        }
        Err(_) => text.to_owned(),
    }
}

/// The formula behind a name of the file's or of the library's, to begin one's own with.
fn formula_of(name: &str, field: Option<&OwnedField>) -> Option<String> {
    let field = field?.field();
    let shown = DisplayedQuantity::parse(name, field);
    let is_name = matches!(shown, Ok(DisplayedQuantity::Quantity(quantity))
        if !matches!(&quantity, Quantity::Formula(formula) if formula.label() != name));
    let vocabulary = ppum::quantity::Vocabulary::of(field);
    vocabulary.definition(name).filter(|_| is_name).map(Cow::into_owned)
}
