//! Functions and the weight, replaced: the coefficients stay, the functions are others.

use egui::{Button, ComboBox, Ui};
use ppum::dataset::Dataset;
use ppum::formula::function_names;
use ppum::library::WEIGHTS;
use ppum::quantity::{QuantityFormula, Vocabulary};
use ppum::replace::weight_of;
use std::sync::Arc;

use super::quantity::version;
use super::{back, failure, note};
use crate::controls::Controls;
use crate::controls::facts::Stem;
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::session::Pane;
use crate::widgets::editor::{EditedText, TextDiagnostic};

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(opened) = &viewport.opened else { return };
    let dataset = Arc::clone(&opened.dataset);
    let controls = &mut viewport.controls;
    weight(ui, pane, controls, &dataset);
    for stem in controls.facts.functions.clone() {
        function(ui, pane, controls, &dataset, &stem);
    }
    for (number, (name, own)) in controls.facts.quantities.clone().iter().enumerate() {
        quantity(ui, pane, controls, number, (name, own));
    }
    let subject = &mut pane.scene.subject;
    let is_changed =
        !subject.functions.is_empty() || !subject.quantities.is_empty() || subject.weight.is_some();
    let all = Button::new("Back to the file's, all of them");
    if ui.add_enabled(is_changed, all).clicked() {
        subject.functions.clear();
        subject.quantities.clear();
        subject.weight = None;
        controls.editors.retain(|name, _| name == "quantity");
    }
    failure(ui, viewport, FaultOrigin::Subject);
}

/// A text that may replace one of the file's.
struct Replacement<'a> {
    /// The name among all editors.
    key: String,
    name: &'a str,
    /// The name for those who do not see it.
    title: String,
    /// The text of the file.
    own: &'a str,
    /// The one in its place.
    other: Option<String>,
    /// Names that may be completed.
    names: &'a [String],
    /// Another number whenever the same text may have another meaning.
    version: usize,
}

impl Replacement<'_> {
    /// Shows its name, what `head` adds, a way back to the file's, and the text; returns the new
    /// text in place of the file's, none for that itself. `head` may choose a text.
    fn show(
        &self,
        ui: &mut Ui,
        controls: &mut Controls,
        head: impl FnOnce(&mut Ui) -> Option<String>,
        check: impl FnOnce(&str) -> Result<(), TextDiagnostic>,
    ) -> Option<Option<String>> {
        let editor = controls.editor(&self.key);
        let head = |ui: &mut Ui| {
            ui.strong(self.name);
            let chosen = head(ui);
            let hint = format!("Back to the file's {}", self.name);
            let is_back = back(ui, &hint, self.other.is_some());
            if is_back { Some(self.own.to_owned()) } else { chosen }
        };
        let chosen = ui.horizontal(head).inner;
        if chosen.as_deref() == Some(self.own) {
            editor.forget();
        }
        let current = self.other.as_deref().unwrap_or(self.own);
        let (names, version) = (self.names, self.version);
        let text = EditedText { name: &self.title, current, names, version };
        let text = chosen.or(editor.show(ui, &text, check))?;
        Some((text != self.own).then_some(text))
    }
}

/// The weight: one of the library, or a formula of t.
fn weight(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, dataset: &Dataset) {
    let own = controls.facts.weight.clone();
    let other = pane.scene.subject.weight.clone();
    let current = other.clone().unwrap_or_else(|| own.clone());
    let library = |ui: &mut Ui| {
        let mut chosen = None;
        let list = ComboBox::from_id_salt("weights").selected_text("library").width(90.0);
        let list = list.show_ui(ui, |ui| {
            for entry in &WEIGHTS {
                let row = ui.selectable_label(entry.name == current, entry.name);
                if row.on_hover_text(format!("{}: {}", entry.about, entry.texts[0])).clicked() {
                    chosen = Some(entry.name.to_owned());
                }
            }
        });
        list.response.accessible_name("Weights of the library");
        chosen
    };
    let names = names(["t"].into_iter().chain(WEIGHTS.iter().map(|entry| entry.name)), &[]);
    let (key, title) = ("weight".to_owned(), "Formula of the weight".to_owned());
    let text =
        Replacement { key, name: "weight", title, own: &own, other, names: &names, version: 0 };
    let check = |text: &str| match weight_of(text, &dataset.tables) {
        Err(error) if !text.trim().is_empty() => Err(TextDiagnostic::of_replacement(&error, text)),
        _ => Ok(()),
    };
    if let Some(text) = text.show(ui, controls, library, check) {
        let is_empty = text.as_ref().is_some_and(|text| text.trim().is_empty());
        if is_empty {
            controls.editor("weight").stay_empty(&own);
        }
        pane.scene.subject.weight = text.filter(|_| !is_empty);
    }
}

/// A function at all its places.
fn function(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, dataset: &Dataset, stem: &Stem) {
    let parameters = stem.parameters.iter().map(String::as_str);
    let names = names(["x", "y", "r", "theta"].into_iter().chain(parameters), &dataset.tables);
    let text = Replacement {
        key: format!("function {}", stem.name),
        name: &stem.name,
        title: format!("Formula of {}", stem.name),
        own: &stem.text,
        other: pane.scene.subject.replaced(&stem.name).map(str::to_owned),
        names: &names,
        version: 0,
    };
    let step = dataset.steps.get(pane.scene.subject.step_of(dataset));
    let check = |text: &str| match step {
        // the text of the file may be words for what is no formula
        Some(step) if text != stem.text => step
            .check_function(&stem.name, text, &dataset.tables)
            .map(|_| ())
            .map_err(|error| TextDiagnostic::of_replacement(&error, text)),
        _ => Ok(()),
    };
    let head = |ui: &mut Ui| {
        ui.label(note(ui, used(stem)));
        None
    };
    if let Some(text) = text.show(ui, controls, head, check) {
        pane.scene.subject.replace(&stem.name, text);
    }
}

/// A quantity that the file names, which may use those before it.
fn quantity(
    ui: &mut Ui,
    pane: &mut Pane,
    controls: &mut Controls,
    number: usize,
    (name, own): (&str, &str),
) {
    let field = controls.known.field().cloned();
    let names = controls.known.names.clone();
    let text = Replacement {
        key: format!("named {name}"),
        name,
        title: format!("Formula of {name}"),
        own,
        other: pane.scene.subject.defined(name).map(str::to_owned),
        names: &names,
        version: version(field.as_ref()),
    };
    let check = |text: &str| {
        let Some(field) = &field else { return Ok(()) };
        let all = Vocabulary::of(field.field());
        let vocabulary = Vocabulary { named: &all.named[..number.min(all.named.len())], ..all };
        let found = QuantityFormula::new(text, &vocabulary).map(|_| ());
        found.map_err(|error| TextDiagnostic::of_definition(&error, text))
    };
    let head = |ui: &mut Ui| {
        ui.label(note(ui, "quantity of the file"));
        None
    };
    if let Some(text) = text.show(ui, controls, head, check) {
        pane.scene.subject.define(name, text);
    }
}

fn used(stem: &Stem) -> String {
    let patches = match stem.patches {
        1 => "1 patch".to_owned(),
        count => format!("{count} patches"),
    };
    match stem.places {
        1 => patches,
        places => format!("{patches}, {places} places"),
    }
}

/// Names of variables, tables and functions of the language.
fn names<'a>(
    variables: impl Iterator<Item = &'a str>,
    tables: &[Arc<ppum::formula::Table>],
) -> Vec<String> {
    let variables = variables.map(str::to_owned);
    let tables = tables.iter().map(|table| table.name().to_owned());
    variables.chain(tables).chain(function_names().map(str::to_owned)).collect()
}
