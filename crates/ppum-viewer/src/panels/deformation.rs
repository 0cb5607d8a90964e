//! The deformed body: how much, at rest or in motion.

use egui::{Slider, Ui};
use ppum::text::trimmed_to;
use ppum_scene::help::tooltip;
use ppum_scene::magnification::{Magnification, words};

use super::failure;
use crate::controls::Controls;
use crate::controls::deformation_animation::DeformationAnimation;
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::session::Pane;
use crate::viewport::ViewState;
use crate::widgets::note_of;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let is_elastic = viewport.controls.facts.is_elastic;
    let is_off = pane.scene.deformed.is_none();
    ui.add_enabled_ui(is_elastic || !is_off, |ui| {
        kinds(ui, pane, &viewport.controls);
        // rows that are always there: nothing moves when the plate is deformed
        ui.add_enabled_ui(!is_off, |ui| {
            factor(ui, pane, &viewport.controls);
            motion(ui, pane, &mut viewport.controls);
        });
    });
    if !is_elastic && is_off {
        ui.weak("A potential has no displacements");
    } else {
        factor_note(ui, viewport);
    }
    failure(ui, viewport, FaultOrigin::Deformed);
}

fn kinds(ui: &mut Ui, pane: &mut Pane, controls: &Controls) {
    let deformed = &mut pane.scene.deformed;
    let given = match *deformed {
        Some(Magnification::Given(factor)) => factor,
        _ => controls.factor.unwrap_or(1.0),
    };
    ui.horizontal(|ui| {
        for (factor, name, meaning) in [
            (None, "off", "The plate as it was before it was loaded"),
            (
                Some(Magnification::Auto),
                "automatic",
                "The largest displacement is some 5 % of the plate",
            ),
            (Some(Magnification::Given(given)), "factor", "So many times its displacement"),
        ] {
            ui.selectable_value(deformed, factor, name).on_hover_text(meaning);
        }
    });
}

/// The factor on a logarithmic scale on both sides of zero; whoever moves it chooses it.
fn factor(ui: &mut Ui, pane: &mut Pane, controls: &Controls) {
    let usual = controls.factor.unwrap_or(1.0);
    let mut factor = match pane.scene.deformed {
        Some(Magnification::Given(factor)) => factor,
        _ => usual,
    };
    // a slider counts in logarithms, which factors of nearly no or of huge displacements leave
    let most = DECADES * usual.abs().clamp(SMALLEST, 1.0 / SMALLEST);
    let slider = Slider::new(&mut factor, -most..=most)
        .logarithmic(true)
        .smallest_positive(most / (DECADES * DECADES))
        .clamping(egui::SliderClamping::Never)
        .custom_formatter(|factor, _| trimmed_to(factor, 3))
        .custom_parser(crate::controls::range::parse);
    if ui.add(slider).accessible_name("Factor of the deformation").changed() && factor.is_finite() {
        pane.scene.deformed = Some(Magnification::Given(factor));
    }
}

/// The smallest automatic factor that a slider shows; the largest is one over it.
const SMALLEST: f64 = 1e-100;
/// The slider's ends are so many times the automatic factor, its smallest step one over that.
const DECADES: f64 = 100.0;

/// The factor from nothing to all and back; the border of the body as it was.
fn motion(ui: &mut Ui, pane: &mut Pane, controls: &mut Controls) {
    ui.horizontal(|ui| {
        let (sign, name) = match controls.swing {
            None => ("▶", "Play the deformation"),
            Some(_) => ("■", "Stop the deformation"),
        };
        if crate::widgets::button(ui, sign, name).clicked() {
            let now = ui.input(|input| input.time);
            controls.swing = controls.swing.is_none().then(|| DeformationAnimation::new(now));
        }
        ui.checkbox(&mut pane.scene.outline, "outline").on_hover_text(tooltip("outline"));
    });
}

/// The factor of the image.
fn factor_note(ui: &mut Ui, viewport: &ViewState) {
    let factor = viewport.frames.newest().and_then(|frame| frame.factor);
    // a factor in motion has no digits that one could read
    let is_moving = viewport.controls.swing.is_some();
    let shown = factor.map(|factor| if is_moving { rounded(factor) } else { factor });
    note_of(ui, &shown.map(words).unwrap_or_default(), 1);
}

fn rounded(factor: f64) -> f64 {
    format!("{factor:.1e}").parse().unwrap_or(factor)
}
