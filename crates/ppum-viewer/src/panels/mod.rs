//! Panels around the view. Panels change the session and nothing else.

pub mod colors;
pub mod compare;
pub mod deformation;
pub mod drawer;
pub mod export;
pub mod files;
pub mod functions;
pub mod help;
pub mod import;
pub mod overlays;
pub mod palette;
pub mod parts;
pub mod player;
pub mod probes;
pub mod quantity;
pub mod start;
pub mod top;

use egui::{Button, CollapsingHeader, RichText, ScrollArea, Ui};

use crate::actions::{self, Action};
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::viewport::ViewState;
pub(crate) use crate::widgets::{button, note, wrong};

/// The panels on the right, one below the other, each of which folds.
pub fn side(ui: &mut Ui, context: &mut PanelContext<'_>) {
    type Show = fn(&mut Ui, &mut PanelContext<'_>);
    const ALL: [(&str, Show, bool); 8] = [
        ("Quantity", quantity::show, true),
        ("Colours", colors::show, true),
        ("Overlays", overlays::show, true),
        ("Probes", probes::show, false),
        ("Parts", parts::show, false),
        ("Deformation", deformation::show, false),
        ("Compare", compare::show, false),
        ("Functions", functions::show, false),
    ];
    modes(ui, context);
    ui.separator();
    let wanted = context.active().1.controls.panel_to_open.take();
    ScrollArea::vertical().show(ui, |ui| {
        for (name, show, is_open) in ALL {
            let opened = (wanted == Some(name)).then_some(true);
            let header = CollapsingHeader::new(name).default_open(is_open).open(opened);
            header.show_unindented(ui, |ui| show(ui, context));
        }
    });
}

/// Switches of what is shown in place of the plate as it is, and of how two views are related:
/// their state is seen wherever the panels are.
fn modes(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let session = &context.session;
    let (pane, is_split) = (session.pane(), session.panes.len() > 1);
    let all = [
        ("Deformed", pane.scene.deformed.is_some(), Action::Deform),
        ("Mirrored", pane.scene.mirror.is_some(), Action::Mirror),
        ("Resampled", pane.compare.is_some(), Action::Compare),
        ("Linked views", is_split && session.linked, Action::Link),
        ("Difference", session.minus.is_shown, Action::Minus),
    ];
    ui.horizontal_wrapped(|ui| {
        for (name, is_on, action) in all {
            let is_possible = is_on || context.is_possible(action);
            let button = ui.add_enabled(is_possible, Button::selectable(is_on, name));
            let hint = actions::all().find(|entry| entry.action == action);
            let hint = hint.map_or(name, |entry| entry.name);
            if button.on_hover_text(hint).on_disabled_hover_text(hint).clicked() {
                context.actions.push(action);
            }
        }
    });
    failure(ui, context.active().1, FaultOrigin::Mirror);
}

/// The reason why there is no image of what is wanted, where it arose.
fn failure(ui: &mut Ui, viewport: &ViewState, fault: FaultOrigin) {
    if let Some(failure) = viewport.frames.failure().filter(|failure| failure.fault == fault) {
        ui.label(RichText::new(&failure.message).color(wrong(ui)));
    }
}

/// A button that takes back what was changed; nothing where nothing was.
fn back(ui: &mut Ui, name: &str, is_changed: bool) -> bool {
    is_changed && button(ui, "↺", name).clicked()
}
