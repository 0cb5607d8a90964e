//! The steps of a series in a table: the factors of each tip, its next increment and what ends it.

use egui::{Grid, RichText, Role, ScrollArea, Ui, WidgetInfo};
use ppum::crack::{End, TipId, tips};
use ppum::dataset::{Dataset, Step, TipIncrement, TipIntensity};
use ppum::text::{short, trimmed};
use ppum_scene::facts::increment;
use ppum_scene::table::{Column, NumberTable};

use crate::panel_context::PanelContext;
use crate::widgets::{align_points, symbol};

/// A tip of a step, or a step without tips.
struct TipRow<'a> {
    number: usize,
    step: &'a Step,
    tip: Option<TipId>,
    /// True if it is the first row of its step.
    is_first: bool,
}

/// The heads of the columns behind the step and its load.
const HEADS: [&str; 5] = ["tip", "K_I", "K_II", "grown by", "next increment"];

/// Shows the table; a click on a step goes there.
pub(super) fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(opened) = viewport.opened.clone() else { return };
    let dataset = &opened.dataset;
    if let Some(end) = end(dataset) {
        ui.strong(end);
    }
    let rows = rows(dataset);
    let shown = pane.scene.subject.step_of(dataset);
    let height = ui.spacing().interact_size.y;
    let area = ScrollArea::both().auto_shrink([false, false]);
    area.show_rows(ui, height, rows.len() + 1, |ui, seen| {
        Grid::new("steps").min_row_height(height).spacing([18.0, 3.0]).show(ui, |ui| {
            for head in ["step", "load"].into_iter().chain(HEADS) {
                ui.label(symbol(ui, head));
            }
            ui.end_row();
            let last = seen.end.saturating_sub(1).min(rows.len());
            let rows = &rows[seen.start..last.max(seen.start)];
            let mut cells: Vec<_> = rows.iter().map(TipRow::texts).collect();
            align_points(&mut cells);
            for (row, cells) in rows.iter().zip(&cells) {
                if row.show(ui, cells, shown) {
                    pane.scene.subject.step = Some(row.number);
                }
            }
        });
    });
}

/// Says why growth ends, if the last step knows.
pub(super) fn end(dataset: &Dataset) -> Option<String> {
    let last = dataset.steps.len().checked_sub(1)?;
    let stop = dataset.steps[last].growth.as_ref()?.stop?;
    Some(format!("Growth ends with step {last}: {}.", stop.words()))
}

/// One row for each tip of each step.
fn rows(dataset: &Dataset) -> Vec<TipRow<'_>> {
    let of_step = |(number, step): (usize, &'_ Step)| {
        let all: Vec<_> = tips(&step.cracks).map(Some).collect();
        if all.is_empty() { (number, vec![None]) } else { (number, all) }
    };
    let steps = dataset.steps.iter().enumerate().map(of_step);
    steps
        .flat_map(|(number, all)| {
            let step = &dataset.steps[number];
            let row = move |(k, tip)| TipRow { number, step, tip, is_first: k == 0 };
            all.into_iter().enumerate().map(row)
        })
        .collect()
}

impl TipRow<'_> {
    fn factors(&self) -> Option<&TipIntensity> {
        self.step.intensities.iter().find(|known| Some(known.tip) == self.tip)
    }

    fn growth(&self) -> Option<&TipIncrement> {
        self.step.growth.as_ref()?.tips.iter().find(|known| Some(known.tip) == self.tip)
    }

    /// True if its step was clicked.
    fn show(&self, ui: &mut Ui, cells: &[String], shown: usize) -> bool {
        let mut is_clicked = false;
        if self.is_first {
            let text = RichText::new(self.number.to_string()).monospace();
            let (is_shown, name) = (self.number == shown, format!("Go to step {}", self.number));
            let step = ui.selectable_label(is_shown, text).on_hover_text(&name);
            step.widget_info(|| WidgetInfo::selected(Role::Button, true, is_shown, &name));
            is_clicked = step.clicked();
        } else {
            ui.label("");
        }
        for text in cells {
            ui.monospace(text);
        }
        ui.end_row();
        is_clicked
    }

    /// The load, once for its step, and the columns of the tip.
    fn texts(&self) -> [String; 6] {
        let name = self.tip.map(|tip| format!("{} {}", tip.crack, tip.end.name()));
        let [k1, k2] = [0, 1].map(|k| self.factors().map(|tip| short([tip.k1, tip.k2][k])));
        let grown = self.growth().map(|tip| short(tip.extension));
        let next = self.growth().map(increment);
        let load = if self.is_first { trimmed(self.step.load) } else { String::new() };
        [Some(load), name, k1, k2, grown, next].map(|text| text.unwrap_or_else(|| "–".into()))
    }

    fn numbers(&self) -> [f64; 10] {
        let tip = self.tip.map_or([f64::NAN; 2], |tip| {
            [f64::from(tip.crack), f64::from(u8::from(tip.end == End::Last))]
        });
        let factors = self.factors().map_or([f64::NAN; 2], |tip| [tip.k1, tip.k2]);
        let growth = self.growth();
        let [grown, length, angle] =
            growth.map_or([f64::NAN; 3], |tip| [tip.extension, tip.length, tip.direction]);
        let [crack, end] = tip;
        let [k1, k2] = factors;
        let cracked =
            self.tip.map_or(f64::NAN, |tip| self.step.cracks[tip.crack as usize].length());
        [self.number as f64, self.step.load, crack, end, cracked, k1, k2, grown, length, angle]
    }
}

/// All steps with all digits; `end` is 0 for the first end of a crack and 1 for the last.
#[must_use]
pub fn table(dataset: &Dataset) -> NumberTable {
    let names = [
        "step",
        "load",
        "crack",
        "end",
        "crack_length",
        "k1",
        "k2",
        "extension",
        "increment",
        "angle",
    ];
    let unit = |name: &str| if name == "angle" { "rad" } else { "" };
    let columns = names.map(|name| Column::new(name, unit(name))).into();
    NumberTable::new(columns, rows(dataset).iter().flat_map(TipRow::numbers).collect())
}
