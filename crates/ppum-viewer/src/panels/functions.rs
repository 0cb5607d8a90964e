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
pub fn show(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let (pane, stage) = desk.active();
    let Some(opened) = &stage.opened else { return };
    let dataset = Arc::clone(&opened.dataset);
    let controls = &mut stage.controls;
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
    failure(ui, stage, FaultOrigin::Subject);
}

/// The weight: one of the library, or a formula of t.
fn weight(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, dataset: &Dataset) {
    let own = controls.facts.weight.clone();
    let current = pane.scene.subject.weight.clone().unwrap_or_else(|| own.clone());
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.strong("weight");
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
        if back(ui, "Back to the file's weight", pane.scene.subject.weight.is_some()) {
            controls.editor("weight").forget();
            chosen = Some(own.clone());
        }
    });
    let names = names(["t"].into_iter().chain(WEIGHTS.iter().map(|entry| entry.name)), &[]);
    let subject =
        EditedText { name: "Formula of the weight", current: &current, names: &names, version: 0 };
    let check = |text: &str| match weight_of(text, &dataset.tables) {
        _ if text.trim().is_empty() => Ok(()),
        Ok(_) => Ok(()),
        Err(error) => Err(TextDiagnostic::of_replacement(&error, text)),
    };
    chosen = chosen.or(controls.editor("weight").show(ui, &subject, check));
    if let Some(text) = chosen {
        let is_empty = text.trim().is_empty();
        if is_empty {
            controls.editor("weight").stay_empty(&own);
        }
        pane.scene.subject.weight = (text != own && !is_empty).then_some(text);
    }
}

/// A function at all its places.
fn function(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, dataset: &Dataset, stem: &Stem) {
    let name = format!("function {}", stem.name);
    let replaced = pane.scene.subject.replaced(&stem.name).map(str::to_owned);
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.strong(&stem.name);
        ui.label(note(ui, used(stem)));
        if back(ui, &format!("Back to the file's {}", stem.name), replaced.is_some()) {
            controls.editor(&name).forget();
            chosen = Some(stem.text.clone());
        }
    });
    let parameters = stem.parameters.iter().map(String::as_str);
    let names = names(["x", "y", "r", "theta"].into_iter().chain(parameters), &dataset.tables);
    let current = replaced.unwrap_or_else(|| stem.text.clone());
    let title = format!("Formula of {}", stem.name);
    let subject = EditedText { name: &title, current: &current, names: &names, version: 0 };
    let step = dataset.steps.get(pane.scene.subject.step_of(dataset));
    let check = |text: &str| match step {
        // the text of the file may be words for what is no formula
        Some(step) if text != stem.text => step
            .check_function(&stem.name, text, &dataset.tables)
            .map(|_| ())
            .map_err(|error| TextDiagnostic::of_replacement(&error, text)),
        _ => Ok(()),
    };
    chosen = chosen.or(controls.editor(&name).show(ui, &subject, check));
    if let Some(text) = chosen {
        let text = (text != stem.text).then_some(text);
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
    let key = format!("named {name}");
    let defined = pane.scene.subject.defined(name).map(str::to_owned);
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.strong(name);
        ui.label(note(ui, "quantity of the file"));
        if back(ui, &format!("Back to the file's {name}"), defined.is_some()) {
            controls.editor(&key).forget();
            chosen = Some(own.to_owned());
        }
    });
    let field = controls.known.field().cloned();
    let names = controls.known.names.clone();
    let current = defined.unwrap_or_else(|| own.to_owned());
    let title = format!("Formula of {name}");
    let version = version(field.as_ref());
    let subject = EditedText { name: &title, current: &current, names: &names, version };
    let check = |text: &str| {
        let Some(field) = &field else { return Ok(()) };
        let all = Vocabulary::of(field.field());
        let vocabulary = Vocabulary { named: &all.named[..number.min(all.named.len())], ..all };
        let found = QuantityFormula::new(text, &vocabulary).map(|_| ());
        found.map_err(|error| TextDiagnostic::of_definition(&error, text))
    };
    chosen = chosen.or(controls.editor(&key).show(ui, &subject, check));
    if let Some(text) = chosen {
        pane.scene.subject.define(name, (text != own).then_some(text));
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
