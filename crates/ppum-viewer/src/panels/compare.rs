//! The direct image against a resampled one: the method, the grid, and what it costs; and against
//! the one on the left.

use egui::{Grid, RichText, Slider, Ui};
use ppum::text::trimmed_to;
use ppum_render::resample::Interpolation;
use ppum_render::resample::norms::{DifferenceNorms, NAMES};
use ppum_scene::compare::Compare;
use ppum_scene::range::RangeLocations;

use super::{failure, note, wrong};
use crate::actions::Action;
use crate::frames::{FaultOrigin, RenderedFrame, ResampledView};
use crate::measure::words::value;
use crate::panel_context::PanelContext;
use crate::session::Pane;
use crate::viewport::difference::rounded;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    against_left(ui, context);
    ui.separator();
    against_resampled(ui, context);
}

/// The difference of the two views, how large it is, and where.
fn against_left(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let mut is_on = context.session.minus.is_shown;
    let text =
        "On the right, the values minus those of the left: of two files, steps or quantities";
    if ui.checkbox(&mut is_on, "right − left").on_hover_text(text).changed() {
        context.actions.push(Action::Minus);
    }
    if !context.session.minus.is_shown {
        return;
    }
    let Some(viewport) = context.viewports.get(1) else { return };
    let Some(frame) = viewport.frames.newest() else { return };
    if let Some(minus) = frame.minus() {
        let [_, unit] = minus.words();
        if let Some(norms) = &frame.norms {
            sizes(ui, norms, &unit);
        }
        extrema(ui, frame, &unit);
        for warning in minus.warnings() {
            ui.label(RichText::new(warning).color(wrong(ui)));
        }
    }
    failure(ui, viewport, FaultOrigin::Minus);
}

/// The norms of a difference, and what part of the left they are.
fn sizes(ui: &mut Ui, norms: &DifferenceNorms, unit: &str) {
    Grid::new("difference").num_columns(3).spacing([14.0, 2.0]).show(ui, |ui| {
        let all = NAMES.into_iter().zip(norms.absolute).zip(norms.relative());
        for ((name, size), part) in all {
            ui.label(format!("difference {name}"));
            ui.label(value(rounded(size), unit));
            ui.weak(percent(part));
            ui.end_row();
        }
    });
}

/// The least and the largest difference, with their places.
fn extrema(ui: &mut Ui, frame: &RenderedFrame, unit: &str) {
    let Some(values) = &frame.colored.span.values else { return };
    let telling = RangeLocations::new(frame.field.dataset(), frame.field.field());
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    let names = ["smallest", "largest"].into_iter();
    for (name, told) in names.zip(telling.extrema(values, frame.colored.view.width)) {
        ui.label(note(ui, format!("{name} {told}{unit}")));
    }
    let text = "Means over the pixels that are seen, and in parts of the left; the extrema are those of the pixels";
    ui.label(note(ui, text));
}

fn against_resampled(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let mut is_on = pane.compare.is_some();
    let text = "The image that is interpolated between the points of a grid";
    if ui.checkbox(&mut is_on, "against resampled").on_hover_text(text).changed() {
        pane.compare = is_on.then(Compare::default);
    }
    if pane.compare.is_some() {
        chosen(ui, pane);
        let other = viewport.frames.newest().and_then(|frame| frame.other.as_ref());
        match other {
            _ if viewport.pair.minus().is_some() => {
                ui.label(note(ui, "A difference is not resampled: compare one of its sides"));
            }
            _ if pane.scene.deformed.is_some() => {
                ui.label(note(
                    ui,
                    "The deformed plate is not compared: grids are of the plate as it was",
                ));
            }
            _ if pane.scene.mirror.is_some() => {
                ui.label(note(ui, "The mirrored plate is not compared: grids are of the part"));
            }
            Some(other) => measured(ui, other),
            None => {}
        }
    }
    failure(ui, viewport, FaultOrigin::Compare);
}

/// Method, grid, and what stands on the right of the divider.
fn chosen(ui: &mut Ui, pane: &mut Pane) {
    let Some(compare) = &mut pane.compare else { return };
    ui.horizontal(|ui| {
        for method in [Interpolation::Nearest, Interpolation::Bilinear, Interpolation::Bicubic] {
            ui.selectable_value(&mut compare.method, method, method.name());
        }
    });
    ui.add(grid(compare)).accessible_name("Points of the grid");
    ui.horizontal(|ui| {
        let difference = &mut pane.against.difference;
        let text = "On the right of the divider, which can be dragged";
        ui.selectable_value(difference, false, "resampled").on_hover_text(text);
        ui.selectable_value(difference, true, "difference").on_hover_text(text);
    });
}

/// Points on a side: powers of two.
fn grid(compare: &mut Compare) -> Slider<'_> {
    let [fewest, most] = Compare::GRIDS.map(|grid| f64::from(grid.ilog2()));
    let get_set = move |new: Option<f64>| {
        if let Some(power) = new {
            compare.grid = 1 << (power.round().clamp(fewest, most) as u32);
        }
        f64::from(compare.grid).log2()
    };
    let slider = Slider::from_get_set(fewest..=most, get_set).step_by(1.0);
    slider
        .custom_formatter(|power, _| format!("{}²", power.exp2().round()))
        .custom_parser(|text| text.trim_end_matches('²').parse::<f64>().ok().map(f64::log2))
}

/// Errors over the pixels that are seen, memory and time.
fn measured(ui: &mut Ui, other: &ResampledView) {
    let relative = other.norms.relative();
    Grid::new("measured").num_columns(3).spacing([14.0, 2.0]).show(ui, |ui| {
        for (name, error) in NAMES.into_iter().zip(relative) {
            ui.label(format!("error {name}"));
            ui.label(percent(error));
            ui.end_row();
        }
        ui.label("memory");
        ui.label(bytes(other.bytes));
        ui.weak(format!("direct {}", bytes(other.direct_bytes)));
        ui.end_row();
        ui.label("time");
        ui.label(seconds(other.seconds[0]));
        ui.weak(format!("drawing {}", seconds(other.seconds[1])));
        ui.end_row();
    });
    let text = "Errors are those of the pixels that are seen, in parts of the field's own";
    ui.label(note(ui, text));
}

fn percent(error: f64) -> String {
    match error {
        error if error.is_infinite() => "∞".to_owned(),
        error => format!("{} %", trimmed_to(100.0 * error, 3)),
    }
}

fn seconds(seconds: f64) -> String {
    match 1e3 * seconds {
        ms if ms < 10.0 => format!("{} ms", trimmed_to(ms, 2)),
        ms if ms < 1000.0 => format!("{ms:.0} ms"),
        ms => format!("{:.1} s", 1e-3 * ms),
    }
}

/// Memory in the unit that has one to three digits before the point.
fn bytes(count: u64) -> String {
    let units = ["bytes", "kB", "MB", "GB"];
    let power = (count.max(1).ilog10() / 3).min(3) as usize;
    format!("{} {}", trimmed_to(count as f64 / 1e3f64.powi(power as i32), 3), units[power])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_has_a_unit() {
        assert_eq!([0, 999].map(bytes), ["0 bytes", "999 bytes"]);
        assert_eq!([32_768, 134_217_728].map(bytes), ["32.8 kB", "134 MB"]);
    }
}
