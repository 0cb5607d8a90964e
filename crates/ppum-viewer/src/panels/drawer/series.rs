//! Stress intensity factors and lengths of cracks against the steps of a series, as curves or in a
//! table.

use std::sync::Arc;

use egui::{Pos2, ScrollArea, Ui, vec2};
use ppum::crack::tips;
use ppum::dataset::{Dataset, Step, TipIntensity};
use ppum::text::trimmed;
use ppum_figure::plot::{CurveStyle, Plot, PlotAxis, PlotCurve};

use super::plot::outputs;
use super::series_table;
use crate::panel_context::PanelContext;
use crate::session::Pane;
use crate::shapes::plain;
use crate::viewport::ViewState;
use crate::widgets::chart::{chart, reading};

/// Values of each step, as a curve.
pub(super) type StepValues = Vec<(String, Vec<[f64; 2]>)>;

/// Shows them; a click goes to the step.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let Some(opened) = &viewport.opened else { return };
    let dataset = &opened.dataset;
    if dataset.steps.len() < 2 {
        ui.label("This dataset has one step. Of a series its history is plotted here.");
        return;
    }
    let dataset = Arc::clone(dataset);
    ui.horizontal_wrapped(|ui| {
        let has_table = &mut viewport.controls.has_step_table;
        ui.selectable_value(has_table, false, "Curves");
        ui.selectable_value(has_table, true, "Table");
        ui.separator();
        let csv = || series_table::table(&dataset).csv();
        let bytes = || csv().into_bytes();
        outputs(ui, viewport, ("steps", &[("csv", &bytes)]), &csv);
    });
    match viewport.controls.has_step_table {
        true => series_table::show(ui, context),
        false => charts(ui, pane, viewport),
    }
}

/// Curves over the steps.
fn charts(ui: &mut Ui, pane: &mut Pane, viewport: &mut ViewState) {
    let Some(opened) = &viewport.opened else { return };
    let dataset = &opened.dataset;
    let plots = || plots(dataset);
    let plots = viewport.controls.histories.get_or_make(dataset.into(), plots).clone();
    let step = pane.scene.subject.step_of(dataset);
    let range = [-0.5, dataset.steps.len() as f64 - 0.5];
    let room = ui.available_size() - vec2(0.0, 14.0);
    let gap = ui.spacing().item_spacing.x;
    let width = (room.x / plots.len() as f32 - gap).max(LEAST);
    ScrollArea::horizontal().show(ui, |ui| {
        ui.horizontal(|ui| {
            for (name, mut plot) in plots {
                plot.x.range = Some(range);
                plot.x.marks = (0..dataset.steps.len()).map(|k| k as f64).collect();
                let chart = chart(ui, name, &plot, vec2(width, room.y.max(120.0)));
                chart.mark(ui, step as f64);
                let last = dataset.steps.len() - 1;
                let step_at = |at: Pos2| (chart.across(at.x).round().max(0.0) as usize).min(last);
                if let Some(at) = chart.response.interact_pointer_pos() {
                    pane.scene.subject.step = Some(step_at(at));
                }
                if let Some(at) = chart.response.hover_pos() {
                    reading(ui, chart.response.rect, &words(&plot, step_at(at)));
                }
            }
        });
    });
}

/// The values of a step: `step 3: tip 0 7.1214, tip 1 7.1209`.
#[must_use]
pub fn words(plot: &Plot, step: usize) -> String {
    let value = |curve: &PlotCurve| {
        let [_, value] = curve.points.get(step).copied().filter(|[_, v]| v.is_finite())?;
        let name = if curve.label.is_empty() { &plot.y.label } else { &curve.label };
        Some(format!("{} {}", plain(name), trimmed(value).replace('-', "−")))
    };
    let values: Vec<_> = plot.curves.iter().filter_map(value).take(TOLD).collect();
    let none = || "no value".to_owned();
    let values = if values.is_empty() { none() } else { values.join(", ") };
    format!("step {step}: {values}")
}

/// Values that are read at a step.
const TOLD: usize = 6;

/// Curves of a plot: of more tips or cracks the first ones are drawn, since nobody could tell
/// them apart.
const MOST: usize = 24;
/// The least width of a plot that can be read \[points\].
const LEAST: f32 = 210.0;

/// The plots that there is something for, with their names.
#[must_use]
pub fn plots(dataset: &Dataset) -> Vec<(&'static str, Plot)> {
    let factors = |value: fn(&TipIntensity) -> f64| {
        by_tip(dataset, |step, number| {
            let tip = tips(&step.cracks).nth(number)?;
            step.intensities.iter().find(|found| found.tip == tip).map(value)
        })
    };
    let lengths = by_crack(dataset);
    let all = [
        ("K_I against the steps", "K_{I}", factors(|tip| tip.k1)),
        ("K_II against the steps", "K_{II}", factors(|tip| tip.k2)),
        ("Crack length against the steps", "crack length", lengths),
        ("Load against the steps", "load", loads(dataset)),
    ];
    let some = all.into_iter().filter(|(.., values)| values.iter().any(|(_, v)| !v.is_empty()));
    some.map(|(name, label, values)| (name, plot(label, values))).collect()
}

pub(super) fn plot(label: &str, values: StepValues) -> Plot {
    let is_one = values.len() == 1;
    let curve = |(k, (name, points)): (usize, (String, Vec<[f64; 2]>))| {
        let name = if is_one { String::new() } else { name };
        // both tips of a symmetric crack are seen
        let look = if k % 2 == 0 { CurveStyle::Dotted } else { CurveStyle::Dashed };
        PlotCurve::new(name, points).with_look(look)
    };
    let curves = values.into_iter().enumerate().map(curve).collect();
    let (x, y) = (PlotAxis::new("step", ""), PlotAxis::new(label, ""));
    Plot { x, y, curves, has_names_above: !is_one, ..Plot::default() }
}

/// A value of each step against its number.
pub(super) fn over_steps(dataset: &Dataset, value: impl Fn(&Step) -> f64) -> Vec<[f64; 2]> {
    dataset.steps.iter().enumerate().map(|(k, step)| [k as f64, value(step)]).collect()
}

/// The load in each step; a constant one is no curve, the player says it.
fn loads(dataset: &Dataset) -> StepValues {
    let points = over_steps(dataset, |step| step.load);
    let is_constant = points.windows(2).all(|pair| pair[0][1] == pair[1][1]);
    if is_constant { Vec::new() } else { vec![("load".into(), points)] }
}

/// A value of each tip in the steps that have it; broken where it is missing.
fn by_tip(dataset: &Dataset, value: impl Fn(&Step, usize) -> Option<f64>) -> StepValues {
    let count = dataset.steps.iter().map(|step| tips(&step.cracks).count()).max().unwrap_or(0);
    let count = count.min(MOST);
    let curve = |number: usize| {
        let points = over_steps(dataset, |step| value(step, number).unwrap_or(f64::NAN));
        let is_known = points.iter().any(|[_, v]| v.is_finite());
        is_known.then(|| (format!("tip {number}"), points))
    };
    (0..count).filter_map(curve).collect()
}

/// The length of each crack in the steps that have it.
fn by_crack(dataset: &Dataset) -> StepValues {
    let count = dataset.steps.iter().map(|step| step.cracks.len()).max().unwrap_or(0);
    let count = count.min(MOST);
    let curve = |number: usize| {
        let length = |step: &Step| step.cracks.get(number).map_or(f64::NAN, |c| c.length());
        (format!("crack {number}"), over_steps(dataset, length))
    };
    (0..count).map(curve).collect()
}
