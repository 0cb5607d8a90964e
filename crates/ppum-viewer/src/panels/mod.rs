//! What stands around the plate. Panels change the session and nothing else.

pub mod chart;
pub mod chooser;
pub mod colors;
pub mod compare;
pub mod deformation;
pub mod drawer;
pub mod editor;
pub mod entry;
pub mod export;
#[cfg(feature = "solve")]
pub mod files;
pub mod functions;
pub mod help;
pub mod overlays;
pub mod palette;
pub mod parts;
pub mod player;
pub mod probes;
pub mod quantity;
#[cfg(feature = "solve")]
pub mod start;
pub mod top;

use egui::{CollapsingHeader, Color32, RichText, ScrollArea, Ui};

use crate::desk::Desk;
use crate::frames::Fault;
use crate::stage::Stage;

/// The panels on the right, one below the other, each of which folds.
pub fn side(ui: &mut Ui, desk: &mut Desk<'_>) {
    type Show = fn(&mut Ui, &mut Desk<'_>);
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
    let wants_quantity = std::mem::take(&mut desk.active().1.controls.wants_quantity);
    ScrollArea::vertical().show(ui, |ui| {
        for (name, show, is_open) in ALL {
            let opened = (wants_quantity && name == "Quantity").then_some(true);
            let header = CollapsingHeader::new(name).default_open(is_open).open(opened);
            header.show_unindented(ui, |ui| show(ui, desk));
        }
    });
}

/// The reason why there is no picture of what is wanted, where it arose.
fn failure(ui: &mut Ui, stage: &Stage, fault: Fault) {
    if let Some(failure) = stage.frames.failure().filter(|failure| failure.fault == fault) {
        ui.label(RichText::new(&failure.message).color(wrong(ui)));
    }
}

/// The colour of mistakes: red that is read on both grounds.
pub(crate) fn wrong(ui: &Ui) -> Color32 {
    match ui.visuals().dark_mode {
        true => Color32::from_rgb(255, 120, 110),
        false => Color32::from_rgb(185, 20, 20),
    }
}

/// Words beside a control, smaller and paler.
fn note(ui: &Ui, text: impl Into<String>) -> RichText {
    RichText::new(text).size(NOTE).color(ui.visuals().text_color().gamma_multiply(0.75))
}

/// Size of notes \[points\].
const NOTE: f32 = 11.5;

/// A button that takes back what was changed; nothing where nothing was.
fn back(ui: &mut Ui, name: &str, is_changed: bool) -> bool {
    is_changed && top::button(ui, "↺", name).clicked()
}
