//! Parts of the field: smooth, jump, tip, one patch.

use egui::{Button, DragValue, Ui};
use ppum::decompose::{KINDS, Part};

use super::failure;
use crate::controls::Controls;
use crate::desk::Desk;
use crate::frames::Fault;
use crate::session::Pane;

/// Shows it.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>) {
    let (pane, stage) = desk.active();
    let part = pane.scene.subject.part.as_deref().and_then(|part| part.parse().ok());
    ui.horizontal_wrapped(|ui| {
        let all = Button::selectable(part.is_none(), "all");
        if ui.add(all).on_hover_text("The whole field").clicked() {
            pane.scene.subject.part = None;
        }
        for kind in KINDS {
            kind_button(ui, pane, &stage.controls, kind, part);
        }
    });
    patch(ui, pane, &mut stage.controls, part);
    failure(ui, stage, Fault::Subject);
}

fn kind_button(ui: &mut Ui, pane: &mut Pane, controls: &Controls, kind: Part, part: Option<Part>) {
    let is_chosen = part == Some(kind);
    let has_it = controls.facts.parts.contains(&kind);
    let button = Button::selectable(is_chosen, kind.to_string());
    let response = ui.add_enabled(has_it || is_chosen, button).on_hover_text(meaning(kind));
    let response = response.on_disabled_hover_text("The field has no blocks of this kind");
    if response.clicked() {
        pane.scene.subject.part = Some(kind.to_string());
    }
}

fn meaning(kind: Part) -> &'static str {
    match kind {
        Part::Smooth => "Polynomials alone",
        Part::Jump => "Polynomials times the side of a crack, or on one component of a patch",
        Part::Tip => "Functions of crack tips",
        Part::Other => "Functions of corners and of one's own",
        Part::Patch(_) => "One patch",
    }
}

/// One patch, by its number or by a click on the plate.
fn patch(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, part: Option<Part>) {
    ui.horizontal(|ui| {
        let chosen = match part {
            Some(Part::Patch(patch)) => Some(patch),
            _ => None,
        };
        let mut number = chosen.unwrap_or(0);
        let last = u32::try_from(controls.facts.patches.saturating_sub(1)).unwrap_or(u32::MAX);
        let of = ui.selectable_label(chosen.is_some(), "one patch");
        let value = DragValue::new(&mut number).range(0..=last).speed(0.2);
        let value = ui.add(value).accessible_name("Number of the patch");
        if of.clicked() || value.changed() {
            pane.scene.subject.part = Some(Part::Patch(number).to_string());
        }
        let is_moved = pane.scene.deformed.is_some();
        let pick = Button::selectable(controls.is_picking, "pick");
        let pick = ui.add_enabled(!is_moved, pick).on_hover_text("Click on a patch of the plate");
        let why = "On the deformed plate patches are not where they were";
        if pick.on_disabled_hover_text(why).accessible_name("Pick a patch on the plate").clicked() {
            controls.is_picking = !controls.is_picking;
        }
    });
}
