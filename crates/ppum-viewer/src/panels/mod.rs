//! What stands around the plate. Panels change the session and nothing else.

pub mod colors;
pub mod deformation;
pub mod export;
pub mod functions;
pub mod help;
pub mod overlays;
pub mod palette;
pub mod parts;
pub mod quantity;
pub mod top;

use egui::{CollapsingHeader, ScrollArea, Ui};

use crate::desk::Desk;

/// The panels on the right, one below the other, each of which folds.
pub fn side(ui: &mut Ui, desk: &mut Desk<'_>) {
    type Show = fn(&mut Ui, &mut Desk<'_>);
    const ALL: [(&str, Show, bool); 6] = [
        ("Quantity", quantity::show, true),
        ("Colours", colors::show, true),
        ("Overlays", overlays::show, true),
        ("Parts", parts::show, false),
        ("Deformation", deformation::show, false),
        ("Functions", functions::show, false),
    ];
    ScrollArea::vertical().show(ui, |ui| {
        for (name, show, is_open) in ALL {
            CollapsingHeader::new(name).default_open(is_open).show(ui, |ui| show(ui, desk));
        }
    });
}
