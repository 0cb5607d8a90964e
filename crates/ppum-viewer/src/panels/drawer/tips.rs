//! The table of the crack tips of the step: one line per tip, as `ppum sif` prints it.

use egui::{Grid, RichText, ScrollArea, Ui};
use ppum::text::LocationText;
use ppum_scene::facts::{HEADS, MEANING, Tip};
use ppum_scene::range::places;
use ppum_scene::table::{Column, NumberTable};

use super::plot::outputs;
use super::series_table::end;
use crate::actions::Action;
use crate::measure::words::number;
use crate::panel_context::PanelContext;
use crate::widgets::{align_points, button, symbol};

/// Shows the table; a click on a line flies to its tip.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(opened) = viewport.opened.clone() else { return };
    viewport.controls.facts.look_up(&opened.dataset, pane.scene.subject.step_of(&opened.dataset));
    let tips = std::mem::take(&mut viewport.controls.facts.tips);
    let places = viewport.controls.facts.places.unwrap_or_else(|| places(&opened.dataset));
    if tips.is_empty() {
        ui.label("This step has no crack tips.");
        end(&opened.dataset).into_iter().for_each(|end| drop(ui.label(end)));
    } else {
        rows(ui, context, &places, &tips);
    }
    context.active().1.controls.facts.tips = tips;
}

/// The rows that are seen: there may be thousands.
fn rows(ui: &mut Ui, context: &mut PanelContext<'_>, places: &LocationText, tips: &[Tip]) {
    let csv = || table(tips).csv();
    let bytes = || csv().into_bytes();
    let (_, viewport) = context.active();
    ui.horizontal_wrapped(|ui| outputs(ui, viewport, ("tips", &[("csv", &bytes)]), &csv));
    let area = ScrollArea::both().auto_shrink([false, false]);
    // the heads go along
    let (height, all) = (ui.spacing().interact_size.y, tips.len() + 1);
    let gap = ui.spacing().item_spacing.y;
    area.show_rows(ui, height, all, |ui, seen| {
        let grid = Grid::new("tips").with_row_color(move |row, style| {
            let is_odd = (seen.start + row) % 2 == 1;
            is_odd.then_some(style.visuals.faint_bg_color)
        });
        let last = seen.end.saturating_sub(1).min(tips.len());
        grid.min_row_height(height).spacing([18.0, gap]).show(ui, |ui| {
            for head in ["tip", "crack", "position", "direction"].into_iter().chain(shown(HEADS)) {
                ui.label(symbol(ui, head)).on_hover_text(MEANING);
            }
            ui.end_row();
            let seen = seen.start..last.max(seen.start);
            let texts = |tip: &Tip| texts(tip, places.show(tip.at.into()));
            let mut cells: Vec<_> = tips[seen.clone()].iter().map(texts).collect();
            align_points(&mut cells);
            for (number, cells) in seen.zip(&cells) {
                let name = format!("Fly to tip {number}");
                if button(ui, &number.to_string(), &name).clicked() {
                    context.actions.push(Action::Tip(number));
                }
                row(ui, &tips[number], cells);
            }
        });
    });
}

/// Returns the columns with values: all but the checks, which tooltips tell.
fn shown<T>(columns: [T; 8]) -> impl Iterator<Item = T> {
    columns.into_iter().take(6)
}

/// Crack, position and direction of a tip, and its factors.
fn texts(tip: &Tip, at: String) -> [String; 9] {
    let angle = format!("{}°", number(tip.angle.to_degrees(), 4));
    let [k1, k2, t, g, growth, error, ..] = tip.words();
    [tip.crack.to_string(), at, angle, k1, k2, t, g, growth, error]
}

fn row(ui: &mut Ui, tip: &Tip, cells: &[String]) {
    let [.., spread, balance] = &tip.words();
    let checks = format!("spread {spread}, J/G-1 {balance}: checks alone").replace('-', "−");
    for text in cells {
        ui.label(RichText::new(text).monospace()).on_hover_text(&checks);
    }
    ui.end_row();
}

/// The tips with all digits.
#[must_use]
pub fn table(tips: &[Tip]) -> NumberTable {
    let names = "tip crack x y angle k1 k2 t_stress j g growth_angle relative_error spread";
    let units = |name: &str| if name.ends_with("angle") { "rad" } else { "" };
    let columns = names.split(' ').map(|name| Column::new(name, units(name))).collect();
    let row = |(number, tip): (usize, &Tip)| {
        let Tip { crack, at: [x, y], angle, .. } = *tip;
        let error = tip.relative_error();
        let factors = [tip.k1, tip.k2, tip.t_stress, tip.j, tip.g, tip.growth_angle];
        let place = [number as f64, f64::from(crack), x, y, angle];
        place.into_iter().chain(factors.map(|n| n.0)).chain([error, tip.spread.0])
    };
    NumberTable::new(columns, tips.iter().enumerate().flat_map(row).collect())
}
