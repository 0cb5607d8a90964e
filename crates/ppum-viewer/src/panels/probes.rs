//! Probes: points whose values are kept in sight, and follow quantity and step.

use egui::{RichText, Ui};
use ppum_scene::table::{Column, NumberTable};

use crate::actions::Action;
use crate::measure::probe::ProbeReading;
use crate::measure::words;
use crate::panel_context::PanelContext;
use crate::panels::drawer::plot::outputs;
use crate::session::VisibleRegion;
use crate::viewport::ViewState;
use crate::widgets::button;
use crate::widgets::entry::entry;

/// The list, what is read at each, and what can be done with it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let mut extrema = context.session.pane().extrema;
    if ui.checkbox(&mut extrema, "Mark the extrema of the view").changed() {
        context.actions.push(Action::Extrema);
    }
    let (pane, viewport) = context.active();
    if pane.probes.is_empty() {
        ui.weak("Press p at the pointer, or choose Probe at the top and click the plate.");
        return;
    }
    let Some(names) = names(viewport) else { return };
    let mut removed = None;
    for k in 0..pane.probes.len() {
        ui.push_id(k, |ui| {
            ui.horizontal(|ui| {
                let is_selected = viewport.tools.selected == Some(k);
                let chosen = ui.selectable_label(is_selected, format!("{}", k + 1));
                if chosen.on_hover_text("Select this probe").clicked() {
                    viewport.tools.selected = Some(k);
                }
                let texts = pane.probes[k].texts();
                for (axis, name) in ["x", "y"].into_iter().enumerate() {
                    let name = format!("{name} of probe {}", k + 1);
                    let text = entry(ui, &name, &texts[axis], name.as_str(), 84.0);
                    let changed = text.and_then(|text| pane.probes[k].with_text(axis, &text));
                    pane.probes[k] = changed.unwrap_or(pane.probes[k]);
                }
                if button(ui, "→", &format!("Fly to probe {}", k + 1)).clicked() {
                    let width = viewport.camera.view.map_or(1.0, |view| view.width);
                    let center = pane.probes[k].point().into();
                    viewport.camera.fly_to(Some(VisibleRegion { center, width }));
                }
                if button(ui, "×", &format!("Remove probe {}", k + 1)).clicked() {
                    removed = Some(k);
                }
            });
            let texts = pane.probes[k].texts();
            if texts.iter().any(|text| text.chars().count() > LONGEST) {
                lines(ui, &[format!("({}, {})", texts[0], texts[1])]);
            }
            if let Some(probed) = viewport.tools.probes.get(k) {
                probe_lines(ui, probed, &names);
            }
        });
    }
    if let Some(k) = removed {
        pane.probes.remove(k);
        viewport.tools.selected = None;
    }
    let all = viewport.tools.probes.clone();
    let table = table(&all, &names);
    ui.horizontal_wrapped(|ui| {
        if ui.button("Remove all").clicked() {
            pane.probes.clear();
        }
        if ui.button("Copy").on_hover_text("As text, with all digits").clicked() {
            let texts = all.iter().map(|probed| words::all(probed, &names[0], &names[1]));
            ui.ctx().copy_text(texts.collect());
        }
        let csv = || table.csv().into_bytes();
        outputs(ui, viewport, ("probes", &[("csv", &csv)]), &|| table.csv());
    });
}

/// Letters of a coordinate that its field shows.
const LONGEST: usize = 9;

/// The quantity's name and unit.
fn names(viewport: &mut ViewState) -> Option<[String; 2]> {
    let frame = viewport.frame().cloned()?;
    let reader = viewport.tools.reader(&frame);
    Some([reader.name.clone(), reader.unit.clone()])
}

fn probe_lines(ui: &mut Ui, probed: &ProbeReading, [name, unit]: &[String; 2]) {
    let mut all = vec![words::values(probed, name, unit)];
    all.extend(words::terms(probed));
    all.push(words::faces(probed).join(", "));
    all.extend(words::gradients(probed));
    let owner = [words::owner(probed), words::patches(probed)];
    all.push(owner.into_iter().flatten().collect::<Vec<_>>().join("; "));
    lines(ui, &all);
}

/// Small lines, the first of which is strong.
fn lines(ui: &mut Ui, lines: &[String]) {
    for (k, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
        let text = RichText::new(line).size(11.5);
        ui.add(egui::Label::new(if k == 0 { text.strong() } else { text }).wrap());
    }
}

/// The probes with all digits: places as anchor and offset, a row for each side of a crack; of a
/// difference also the values on the right and on the left.
#[must_use]
pub fn table(probes: &[ProbeReading], [name, unit]: &[String; 2]) -> NumberTable {
    let plain = ["probe", "x", "y", "dx", "dy", "side"].map(|name| Column::new(name, ""));
    let slopes = ["dx", "dy"].map(|by| Column::new(&format!("d({name})/{by}"), ""));
    let is_difference = probes.iter().flat_map(|probed| &probed.sides).any(|s| s.terms.is_some());
    let terms = ["right", "left"].map(|name| Column::new(name, unit));
    let terms = terms.into_iter().filter(|_| is_difference);
    let all = plain.into_iter().chain([Column::new(name, unit)]).chain(slopes).chain(terms);
    let columns = all.collect();
    let mut rows = Vec::new();
    for (k, probed) in probes.iter().enumerate() {
        let ([x, y], [dx, dy]) = (probed.spot.anchor, probed.spot.offset);
        for sided in &probed.sides {
            let side = match sided.side {
                None => 0.0,
                Some(ppum::crack::Side::Above) => 1.0,
                Some(ppum::crack::Side::Below) => -1.0,
            };
            let g = sided.gradient;
            rows.extend([(k + 1) as f64, x, y, dx, dy, side, sided.value, g.x, g.y]);
            rows.extend(sided.terms.into_iter().flatten());
        }
    }
    NumberTable::new(columns, rows)
}
