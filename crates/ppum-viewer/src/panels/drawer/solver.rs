//! The solver's report of a step: its numbers, the seconds of its phases, its warnings; and values
//! of patches as colours.

use egui::{Grid, Label, ScrollArea, Ui, vec2};
use ppum::dataset::{Dataset, Record, Step, Warning};
use ppum::quantity::Quantity;
use ppum::text::trimmed;
use ppum_figure::plot::Plot;
use ppum_render::cells;
use ppum_scene::plots::{NamedDataset, SolverWork, adaptation, history as history_of};
use ppum_scene::quantity::OF_PATCHES;
use ppum_solve::report;

use super::series::{over_steps, plot};
use crate::panel_context::PanelContext;
use crate::session::VisibleRegion;
use crate::widgets::chart::chart;
use crate::widgets::{elided, note};

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(dataset) = viewport.opened.as_ref().map(|o| std::sync::Arc::clone(&o.dataset)) else {
        return;
    };
    let Some(step) = dataset.steps.get(pane.scene.subject.step_of(&dataset)) else { return };
    patches(ui, context);
    ui.separator();
    let room = ui.available_height();
    ScrollArea::horizontal().id_salt("solver").show(ui, |ui| {
        ui.horizontal_top(|ui| {
            numbers(ui, step, room);
            warnings(ui, context, &dataset, step, room);
            if step.record(STOP).is_some() && dataset.steps.len() == 1 {
                ui.vertical(|ui| {
                    ui.set_max_width(WIDEST);
                    ui.add(Label::new(ONE_STEP).wrap());
                });
            }
            for (name, plot) in plots(&dataset, step) {
                chart(ui, name, &plot, vec2(WIDTH, (room - 14.0).max(120.0)));
            }
        });
    });
}

/// Width of a plot: names of phases have room beside each other \[points\].
const WIDTH: f32 = 540.0;
/// The record of what ended an adaptation.
const STOP: &str = "adaptation stop";
const ONE_STEP: &str = "The dataset holds the last step of its adaptation alone. With keep = \"all\" under [adaptivity] the error of \
     each step is plotted here.";

/// Values of patches that have a button of their own, and letters of their names.
const MOST: usize = 30;
const LETTERS: usize = 30;

/// Buttons that colour the patches by one of their values.
fn patches(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(frame) = viewport.frames.newest() else { return };
    let field = frame.field.field();
    ui.horizontal_wrapped(|ui| {
        ui.label("Colour the patches by");
        let names = cells::names(field);
        for name in names.iter().take(MOST) {
            // a quantity of this name goes before, unless it is said that patches are meant
            let has_quantity = Quantity::parse(name, field).is_ok();
            let text = if has_quantity { format!("{OF_PATCHES}{name}") } else { name.clone() };
            let is_shown = pane.scene.quantity.as_ref() == Some(&text);
            if ui.selectable_label(is_shown, elided(name, LETTERS)).clicked() {
                pane.scene.quantity = (!is_shown).then_some(text);
            }
        }
        if names.len() > MOST {
            ui.label(note(ui, format!("and {} more among the quantities", names.len() - MOST)));
        }
    });
}

/// The records of the solver that are no times.
fn numbers(ui: &mut Ui, step: &Step, height: f32) {
    let (times, numbers): (Vec<_>, Vec<_>) = step.history.iter().partition(|r| r.unit == "s");
    ScrollArea::vertical().id_salt("numbers").max_height(height).show(ui, |ui| {
        let grid = Grid::new("history").num_columns(2).striped(true);
        grid.max_col_width(WIDEST).show(ui, |ui| {
            let mut row = |name: &str, value: String| {
                ui.label(name);
                ui.monospace(value);
                ui.end_row();
            };
            row("patches", step.partition.len().to_string());
            // the course of iterations and the sizes of levels, hundreds of records, are
            // for programs
            let many = ["iteration ", "level "];
            let is_told = |r: &&Record| !many.iter().any(|word| r.name.starts_with(word));
            let mut told: Vec<_> = numbers.into_iter().filter(is_told).collect();
            told.sort_by_key(|record| !FIRST.contains(&record.name.as_str()));
            for Record { name, value, unit } in told {
                row(name, worded(name, *value, unit));
            }
            for Record { name, value, .. } in &times {
                row(name, format!("{value:.3} s"));
            }
            if !times.is_empty() {
                row("all phases", format!("{:.3} s", times.iter().map(|r| r.value).sum::<f64>()));
            }
        });
    });
}

/// Width of a column of words, which are wrapped in it \[points\].
const WIDEST: f32 = 240.0;

/// The records that are needed first.
const FIRST: [&str; 4] = ["unknowns", "estimated error", "estimated error of factors", STOP];

/// A number of the solver as one reads it: bytes in MiB, codes as words.
fn worded(name: &str, value: f64, unit: &str) -> String {
    match (report::word(name, value), unit) {
        (Some(word), _) => word.to_owned(),
        (None, "B") => format!("{:.1} MiB", value / f64::from(1u32 << 20)),
        _ => format!("{} {unit}", trimmed(value)).trim_end().to_owned(),
    }
}

/// The name of the plot of an adaptation.
const ADAPTATION: &str = "Estimated error against unknowns";

/// The history of an adaptation; seconds of the phases; of a series residuals and unknowns.
#[must_use]
pub fn plots(dataset: &Dataset, step: &Step) -> Vec<(&'static str, Plot)> {
    let history = adaptation(dataset).map(|plot| (ADAPTATION, plot));
    let mut plots: Vec<_> = history.into_iter().collect();
    let index = dataset.steps.iter().position(|other| std::ptr::eq(other, step));
    let named = [NamedDataset { name: "", dataset }];
    if let Ok(mut phases) = history_of(&named, SolverWork::Seconds, index) {
        (phases.title, phases.x.label) = (String::new(), "phase".into());
        plots.push(("Seconds of the phases", phases));
    }
    for (title, name) in
        [("Residual against the steps", "residual"), ("Unknowns against the steps", "unknowns")]
    {
        let mut points = over_steps(dataset, |step| step.record(name).unwrap_or(f64::NAN));
        points.retain(|[_, value]| !value.is_nan());
        if points.len() > 1 {
            let mut plot = plot(name, vec![(String::new(), points)]);
            if name == "residual" {
                plot.y = plot.y.logarithmic();
            }
            plots.push((title, plot));
        }
    }
    plots
}

/// Shows the warnings of the diagnostics; a click flies there.
fn warnings(
    ui: &mut Ui,
    context: &mut PanelContext<'_>,
    dataset: &Dataset,
    step: &Step,
    height: f32,
) {
    ScrollArea::vertical().id_salt("warnings").max_height(height).show(ui, |ui| {
        ui.vertical(|ui| {
            ui.set_width(if step.warnings.is_empty() { 90.0 } else { 320.0 });
            if step.warnings.is_empty() {
                ui.weak("No warnings.");
            }
            for warning in &step.warnings {
                let text = format!("⚠ {}", warning.message);
                let label = ui.add(egui::Button::new(text).wrap().frame(false));
                if label.on_hover_text("Fly there").clicked() {
                    fly(context, dataset, warning);
                }
            }
        });
    });
}

fn fly(context: &mut PanelContext<'_>, dataset: &Dataset, warning: &Warning) {
    let Some(at) = warning.at else { return };
    let size = dataset.domain.bounds.size();
    let width = 0.2 * size.x.max(size.y);
    context.active().1.camera.fly_to(Some(VisibleRegion { center: at.into(), width }));
}
