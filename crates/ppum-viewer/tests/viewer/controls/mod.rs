//! The controls: each changes the session, and the picture is that of the session.

mod bar;
mod colors;
mod compare;
mod deformation;
mod functions;
mod overlays;
mod parts;
mod quantity;
mod random;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use ppum_scene::scene::SceneRequest;
use ppum_viewer::Viewer;
use ppum_viewer::frames::RenderedFrame;
use std::sync::Arc;

use crate::kit::{plate, settle, window};

pub(crate) type Window = Harness<'static, Viewer>;

/// A window high enough for all panels.
pub(crate) fn plate_window() -> Window {
    window(plate(), [1100.0, 1400.0])
}

pub(crate) fn scene(window: &Window) -> SceneRequest {
    window.state().session.pane().scene.clone()
}

pub(crate) fn frame(window: &Window) -> Arc<RenderedFrame> {
    let newest = window.state().viewports[0].frames.newest();
    Arc::clone(newest.expect("there is a picture"))
}

/// Clicks on what has a label, and waits for the picture.
pub(crate) fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    settle(window);
}

/// Opens a panel that is folded.
pub(crate) fn open(window: &mut Window, panel: &str) {
    click(window, panel);
    // until it has unfolded
    window.run_steps(30);
    settle(window);
}

/// Writes a text in place of what a field holds.
pub(crate) fn write(window: &mut Window, field: &str, text: &str) {
    window.get_by_label(field).click();
    window.step();
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.step();
    window.get_by_label(field).type_text(text);
    settle(window);
}

/// The bounds of the colours.
pub(crate) fn bounds(window: &Window) -> [f64; 2] {
    let norm = frame(window).colored.normalization;
    [norm.min(), norm.max()]
}
