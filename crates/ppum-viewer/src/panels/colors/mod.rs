//! Colours: map, scale, range, and what lies beyond it.

mod maps;
pub(crate) mod range;

use std::sync::Arc;

use egui::{DragValue, Ui};
use ppum_render::colormap::{Colormap, Rgb};
use ppum_render::scale::Scale;
use ppum_scene::colors::{ColorOptions, MOST_BANDS};
use ppum_scene::help::tooltip;
use ppum_scene::range::RangeLocations;

use super::failure;
use crate::controls::Controls;
use crate::controls::facts::Facts;
use crate::frames::{FaultOrigin, RenderedFrame};
use crate::panel_context::PanelContext;
use crate::viewport::ViewState;
use crate::widgets::note_of;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let default = viewport.frames.newest().map(|frame| frame.default_map());
    let default = default.unwrap_or(ColorOptions::default_map(None));
    let colors = &mut pane.scene.colors;
    map(ui, colors, &mut viewport.controls, default);
    scale(ui, colors);
    range::show(ui, pane, viewport);
    beyond(ui, &mut pane.scene.colors);
    without_value(ui, &mut pane.scene.colors);
    colors_note(ui, viewport);
    failure(ui, viewport, FaultOrigin::Colors);
}

/// The map: which, reversed, in steps.
fn map(ui: &mut Ui, colors: &mut ColorOptions, controls: &mut Controls, default: &str) {
    let name = colors.colormap.clone().unwrap_or_else(|| default.to_owned());
    let base = name.strip_suffix("_r").unwrap_or(&name).to_owned();
    let mut is_reversed = base != name;
    let shown = Colormap::named(&name).map(|map| match colors.bands {
        Some(count) => map.banded(count),
        None => map,
    });
    if shown.is_ok_and(|map| maps::preview(ui, &map).clicked()) {
        controls.maps.toggle();
    }
    let chosen = controls.maps.show(ui, "Search colour maps", &base, &maps::CHOICES, maps::row);
    let mut has_changed = chosen.is_some();
    let base = chosen.unwrap_or(base);
    ui.horizontal(|ui| {
        ui.label(&base);
        has_changed |= ui.checkbox(&mut is_reversed, "reversed").changed();
        bands(ui, colors);
    });
    if has_changed {
        let name = if is_reversed { format!("{base}_r") } else { base };
        colors.colormap = (name != default).then_some(name);
    }
}

fn bands(ui: &mut Ui, colors: &mut ColorOptions) {
    let mut has_bands = colors.bands.is_some();
    if ui.checkbox(&mut has_bands, "in steps").on_hover_text(tooltip("bands")).changed() {
        colors.bands = has_bands.then_some(8);
    }
    if let Some(count) = &mut colors.bands {
        let value = DragValue::new(count).range(1..=MOST_BANDS).speed(0.1);
        ui.add(value).accessible_name("Number of steps");
    }
}

fn scale(ui: &mut Ui, colors: &mut ColorOptions) {
    ui.horizontal(|ui| {
        for (scale, name, meaning) in [
            (Scale::Linear, "linear", "Equal steps"),
            (Scale::Log, "log", "Equal ratios, of positive values"),
            (Scale::SymLog, "symlog", "Logarithmic on both sides of zero, linear around it"),
        ] {
            ui.selectable_value(&mut colors.scale, scale, name).on_hover_text(meaning);
        }
    });
}

/// The colours of values below and above the range.
fn beyond(ui: &mut Ui, colors: &mut ColorOptions) {
    let contrast = ui.checkbox(&mut colors.contrast, "contrast beyond the range");
    contrast.on_hover_text(tooltip("extremes"));
}

/// The colour of points without a value.
fn without_value(ui: &mut Ui, colors: &mut ColorOptions) {
    ui.horizontal(|ui| {
        let mut has_color = colors.nan_color.is_some();
        let checkbox = ui.checkbox(&mut has_color, "colour for no value");
        if checkbox.on_hover_text(tooltip("nan_color")).changed() {
            colors.nan_color = has_color.then_some(Rgb([160, 160, 160]));
        }
        if let Some(Rgb(color)) = &mut colors.nan_color {
            ui.color_edit_button_srgb(color);
        }
    });
}

/// Shows the meaning of the colours, and the bounds of all other values.
fn colors_note(ui: &mut Ui, viewport: &mut ViewState) {
    let Some(frame) = viewport.frames.newest() else { return };
    let Controls { color_note, facts, .. } = &mut viewport.controls;
    // a weak one, which keeps no image
    let key = Arc::downgrade(frame);
    if !color_note.as_ref().is_some_and(|(of, _)| of.ptr_eq(&key)) {
        *color_note = Some((key, words(frame, facts)));
    }
    if let Some((_, text)) = color_note {
        note_of(ui, text, LINES);
    }
}

/// Lines of what is told.
const LINES: usize = 4;

/// Pixels are counted for it.
fn words(frame: &RenderedFrame, facts: &Facts) -> String {
    let (dataset, field) = (frame.field.dataset(), frame.field.field());
    let telling = match facts.places {
        Some(places) => RangeLocations::with(places, field),
        None => RangeLocations::new(dataset, field),
    };
    let text = telling.colors(&frame.colored);
    let text = format!("{}{}", text[..1].to_uppercase(), &text[1..]);
    match frame.drawn.undefined() {
        [0, _] => text,
        [without, all] => format!("{text}; no value at {without} of {all} pixels"),
    }
}
