//! Parts of the field: smooth, jump, tip, one patch.

use egui::{Button, DragValue, Ui};
use ppum::decompose::{FieldPart, KINDS};

use super::failure;
use crate::controls::Controls;
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::session::Pane;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let part = pane.scene.subject.part.as_deref().and_then(|part| part.parse().ok());
    ui.horizontal_wrapped(|ui| {
        let all = Button::selectable(part.is_none(), "all");
        if ui.add(all).on_hover_text("The whole field").clicked() {
            pane.scene.subject.part = None;
        }
        for kind in KINDS {
            kind_button(ui, pane, &viewport.controls, kind, part);
        }
    });
    patch(ui, pane, &mut viewport.controls, part);
    failure(ui, viewport, FaultOrigin::Subject);
}

fn kind_button(
    ui: &mut Ui,
    pane: &mut Pane,
    controls: &Controls,
    kind: FieldPart,
    part: Option<FieldPart>,
) {
    let is_chosen = part == Some(kind);
    let has_it = controls.facts.parts.contains(&kind);
    let button = Button::selectable(is_chosen, kind.to_string());
    let response = ui.add_enabled(has_it || is_chosen, button).on_hover_text(meaning(kind));
    let response = response.on_disabled_hover_text("The field has no blocks of this kind");
    if response.clicked() {
        pane.scene.subject.part = Some(kind.to_string());
    }
}

fn meaning(kind: FieldPart) -> &'static str {
    match kind {
        FieldPart::Smooth => "Polynomials alone",
        FieldPart::Jump => "Polynomials times the side of a crack, or on one component of a patch",
        FieldPart::Tip => "Functions of crack tips",
        FieldPart::Other => "Functions of corners and of one's own",
        FieldPart::Patch(_) => "One patch",
    }
}

/// One patch, by its number or by a click on the body.
fn patch(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls, part: Option<FieldPart>) {
    ui.horizontal(|ui| {
        let chosen = match part {
            Some(FieldPart::Patch(patch)) => Some(patch),
            _ => None,
        };
        let mut number = chosen.unwrap_or(0);
        let last = u32::try_from(controls.facts.patches.saturating_sub(1)).unwrap_or(u32::MAX);
        let of = ui.selectable_label(chosen.is_some(), "one patch");
        let value = DragValue::new(&mut number).range(0..=last).speed(0.2);
        let value = ui.add(value).accessible_name("Number of the patch");
        if of.clicked() || value.changed() {
            pane.scene.subject.part = Some(FieldPart::Patch(number).to_string());
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
