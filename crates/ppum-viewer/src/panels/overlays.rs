//! The panel of overlays.

use egui::{Checkbox, DragValue, RichText, Sense, TextEdit, Ui, vec2};
use ppum_figure::overlay::{LegendEntry, Symbol};
use ppum_scene::help::tooltip;
use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays, SPACING};

use super::{failure, note, wrong};
use crate::controls::{Controls, LevelsDraft};
use crate::frames::FaultOrigin;
use crate::panel_context::PanelContext;
use crate::session::Pane;
use crate::shapes::color;
use crate::viewport::ViewState;

/// Distances of arrows and crosses \[pixels\].
const SPACINGS: std::ops::RangeInclusive<f64> = 8.0..=400.0;

/// Columns of overlays: all of them are full.
const COLUMNS: usize = 3;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    ui.columns(COLUMNS, |columns| {
        for (number, overlay) in Overlay::ALL.into_iter().enumerate() {
            switch(&mut columns[number % COLUMNS], pane, &viewport.controls, overlay);
        }
    });
    let is_elastic = viewport.controls.facts.is_elastic;
    let overlays = &mut pane.scene.overlays;
    isolines(ui, overlays, &mut viewport.controls);
    let arrows = if is_elastic { "arrows of the displacement" } else { "arrows of the gradient" };
    glyphs(ui, &mut overlays.arrows, arrows, None);
    let why = (!is_elastic).then_some("A potential has no stresses; arrows show its gradient");
    glyphs(ui, &mut overlays.crosses, "crosses of principal stresses", why);
    if viewport.pair.minus().is_some() && overlays.isolines.is_some() {
        ui.label(note(ui, "A difference has no isolines: they are found of one field"));
    }
    legend(ui, viewport);
    failure(ui, viewport, FaultOrigin::Overlays);
}

/// An overlay, with the reason why there is none of it.
fn switch(ui: &mut Ui, pane: &mut Pane, controls: &Controls, overlay: Overlay) {
    let shown = &mut pane.scene.overlays.shown;
    let mut is_on = shown.contains(&overlay);
    let absent = controls.facts.without.iter().find(|(other, _)| *other == overlay);
    let is_moved = pane.scene.deformed.is_some() && !overlay.is_deformable();
    let why = match absent {
        Some((_, why)) => Some(*why),
        None => is_moved.then_some("The deformed plate has cells and cracks alone"),
    };
    let response = ui.add_enabled(why.is_none() || is_on, Checkbox::new(&mut is_on, name(overlay)));
    let text = why.map_or_else(|| overlay.meaning(), str::to_owned);
    if response.on_hover_text(&text).on_disabled_hover_text(text).changed() {
        shown.retain(|other| *other != overlay);
        shown.extend(is_on.then_some(overlay));
    }
}

/// Its word on a switch.
fn name(overlay: Overlay) -> &'static str {
    match overlay {
        // as people write it; files and options have it the other way
        Overlay::Centers => "centres",
        other => other.name(),
    }
}

/// Isolines: chosen levels, a number of them, or those that are listed.
fn isolines(ui: &mut Ui, overlays: &mut Overlays, controls: &mut Controls) {
    ui.horizontal(|ui| {
        let mut is_on = overlays.isolines.is_some();
        let checkbox = ui.checkbox(&mut is_on, "isolines");
        if checkbox.on_hover_text(tooltip("isolines")).changed() {
            overlays.isolines = is_on.then_some(IsolineLevels::Auto);
        }
        if is_on {
            levels(ui, overlays, controls);
            ui.checkbox(&mut overlays.level_labels, "labels")
                .on_hover_text(tooltip("level_labels"));
        }
    });
    if let Some(mistake) = controls.levels.mistake.as_ref().filter(|_| overlays.isolines.is_some())
    {
        ui.label(RichText::new(mistake).color(wrong(ui)));
    }
}

fn levels(ui: &mut Ui, overlays: &mut Overlays, controls: &mut Controls) {
    let draft = &mut controls.levels;
    if draft.base != overlays.isolines {
        let text = overlays.isolines.as_ref().map(IsolineLevels::to_string).unwrap_or_default();
        *draft = LevelsDraft { text, base: overlays.isolines.clone(), mistake: None };
    }
    let edit = TextEdit::singleline(&mut draft.text).desired_width(90.0);
    let help = "auto, a number of levels, or their values with commas: 0.5, for one";
    let edit = ui.add(edit).accessible_name("Levels of isolines").on_hover_text(help);
    if edit.changed() {
        match draft.text.parse::<IsolineLevels>() {
            Ok(levels) => {
                (draft.base, draft.mistake) = (Some(levels.clone()), None);
                overlays.isolines = Some(levels);
            }
            Err(mistake) => draft.mistake = Some(mistake.to_owned()),
        }
    }
}

/// Arrows or crosses with their distance; the name begins with that of the option.
fn glyphs(ui: &mut Ui, spacing: &mut Option<f64>, name: &str, why: Option<&str>) {
    ui.horizontal(|ui| {
        let mut is_on = spacing.is_some();
        let response = ui.add_enabled(why.is_none() || is_on, Checkbox::new(&mut is_on, name));
        let option = name.split(' ').next().unwrap_or(name);
        let response = response.on_hover_text(tooltip(option));
        if response.on_disabled_hover_text(why.unwrap_or_default()).changed() {
            *spacing = is_on.then_some(SPACING);
        }
        if let Some(spacing) = spacing {
            let value = DragValue::new(spacing).range(SPACINGS).speed(0.5).suffix(" px");
            ui.add(value.fixed_decimals(0)).accessible_name(format!("Distance of {name}"));
        }
    });
}

/// Shows the legend entries that have no room on the image, and notices about overlays that are not
/// visible.
fn legend(ui: &mut Ui, viewport: &ViewState) {
    let Some(frame) = viewport.frames.newest() else { return };
    for entry in &frame.layers.legend {
        line(ui, entry);
    }
    for notice in &frame.layers.notices {
        ui.label(note(ui, notice.to_string()));
    }
}

fn line(ui: &mut Ui, entry: &LegendEntry) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
        match entry.symbol {
            Symbol::Line(pen) => {
                let stroke = egui::Stroke::new(pen.width as f32, color(pen.color));
                ui.painter().hline(rect.x_range(), rect.center().y, stroke);
            }
            Symbol::Square(fill) => {
                ui.painter().rect_filled(rect, 1.0, color(fill));
            }
            _ => {}
        }
        ui.small(&entry.label);
    });
}
