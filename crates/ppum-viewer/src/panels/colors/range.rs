//! The range of the colours: found, of the whole body, fixed.

use egui::{Button, Checkbox, DragValue, Label, Response, RichText, TextStyle, Ui};
use ppum::text::trimmed_to;
use ppum_render::range::RangeChoice;
use ppum_scene::colors::ColorOptions;
use ppum_scene::help::tooltip;

use crate::controls::range::{digits, parse, set};
use crate::controls::whole::Whole;
use crate::panels::{note, wrong};
use crate::session::Pane;
use crate::viewport::ViewState;

/// Digits of a bound that is shown, at least: all that a range has that was found are not read.
const DIGITS: usize = 5;

/// Shows it.
pub(super) fn show(ui: &mut Ui, pane: &mut Pane, viewport: &mut ViewState) {
    let colors = &mut pane.scene.colors;
    let bounds = viewport.frames.newest().map(|frame| {
        let norm = &frame.colored.normalization;
        [norm.min(), norm.max()]
    });
    let bounds = bounds.unwrap_or([0.0, 1.0]);
    kinds(ui, colors, bounds);
    if let RangeChoice::Percentiles(p, q) = colors.range {
        percentiles(ui, colors, [p, q]);
    } else {
        fixed(ui, colors, viewport, bounds);
    }
    let colors = &mut pane.scene.colors;
    let is_symmetric = ui.checkbox(&mut colors.symmetric, "symmetric about zero");
    if is_symmetric.on_hover_text(tooltip("symmetric")).changed() && colors.symmetric {
        mirror(colors);
    }
    // a row of its own, which is never broken: nothing moves when a range is found
    ui.horizontal(|ui| {
        ui.label(note(ui, "range of the"));
        whole(ui, pane, viewport);
    });
}

/// The rules.
fn kinds(ui: &mut Ui, colors: &mut ColorOptions, bounds: [f64; 2]) {
    ui.horizontal_wrapped(|ui| {
        let percentiles = match colors.range {
            found @ RangeChoice::Percentiles(..) => found,
            _ => RangeChoice::Percentiles(2.0, 98.0),
        };
        let frozen = match colors.range {
            given @ RangeChoice::Fixed(..) => given,
            _ => RangeChoice::Fixed(bounds[0], bounds[1]),
        };
        for (range, name, meaning) in [
            (
                RangeChoice::Auto,
                "auto",
                "All values of the view, but robust against peaks that are infinite",
            ),
            (RangeChoice::Full, "full", "All finite values of the view"),
            (percentiles, "percentiles", "Between two percentiles of the view"),
            (frozen, "fixed", "The range stays as it is now, wherever one goes"),
        ] {
            ui.selectable_value(&mut colors.range, range, name).on_hover_text(meaning);
        }
    });
}

fn percentiles(ui: &mut Ui, colors: &mut ColorOptions, [mut p, mut q]: [f64; 2]) {
    ui.horizontal(|ui| {
        let low = DragValue::new(&mut p).range(0.0..=q - 0.1).speed(0.1).suffix(" %");
        let low = ui.add(low).accessible_name("Lower percentile");
        let high = DragValue::new(&mut q).range(p + 0.1..=100.0).speed(0.1).suffix(" %");
        if low.union(ui.add(high).accessible_name("Upper percentile")).changed() {
            colors.range = RangeChoice::Percentiles(p, q);
        }
    });
}

/// The two ends as numbers, those that were found too: whoever changes one fixes both.
fn fixed(ui: &mut Ui, colors: &mut ColorOptions, viewport: &mut ViewState, bounds: [f64; 2]) {
    let mut ends = match colors.range {
        RangeChoice::Fixed(min, max) => [min, max],
        _ => bounds,
    };
    let speed = ((ends[1] - ends[0]).abs() / 300.0).max(f64::MIN_POSITIVE);
    let shown = digits(ends, DIGITS);
    let mut changed = None;
    ui.horizontal(|ui| {
        for (end, name, word) in [(0, "Lower end", "from"), (1, "Upper end", "to")] {
            ui.label(note(ui, word));
            let value = DragValue::new(&mut ends[end]).speed(speed).update_while_editing(false);
            let value = value.custom_formatter(|value, _| trimmed_to(value, shown));
            let response = ui.add(value.custom_parser(parse)).accessible_name(name);
            changed = changed.or(response.changed().then_some(end));
        }
        if let Some(refused) = &viewport.controls.refused {
            let text = RichText::new(refused).color(wrong(ui));
            ui.add(Label::new(text).truncate()).on_hover_text(refused);
        }
    });
    if let Some(end) = changed {
        viewport.controls.refused = set(colors, ends, end).err();
    }
}

/// Makes a fixed range one around zero.
fn mirror(colors: &mut ColorOptions) {
    if let RangeChoice::Fixed(min, max) = colors.range {
        let size = min.abs().max(max.abs());
        colors.range = RangeChoice::Fixed(-size, size);
    }
}

/// The range of the whole body, found in the background; of a series, whether an automatic range is
/// that of all steps.
fn whole(ui: &mut Ui, pane: &mut Pane, viewport: &mut ViewState) {
    let Some(opened) = &viewport.opened else { return };
    let controls = &mut viewport.controls;
    let step = pane.scene.subject.step_of(&opened.dataset);
    let button = range_button(ui, controls.whole.as_ref());
    if button.on_hover_text("Finds the range of the whole plate and fixes it").clicked() {
        controls.refused = None;
        controls.whole = match controls.whole {
            Some(_) => None,
            None => {
                let shown = (&pane.scene, viewport.pair.minus().cloned());
                Some(Whole::new(ui.ctx(), &opened.dataset, shown, step..step + 1))
            }
        };
    }
    if opened.dataset.steps.len() > 1 {
        let mut is_of_all = !pane.one_step_range;
        let is_automatic = pane.scene.colors.range == RangeChoice::Auto;
        let all = ui.add_enabled(is_automatic, Checkbox::new(&mut is_of_all, "all steps"));
        pane.one_step_range = !is_of_all;
        all.on_hover_text(ALL_STEPS);
    }
}

const ALL_STEPS: &str =
    "While you go through the steps, the automatic range is that of all of them in this view";

/// The button of a search for a range: while that works it stops it, and is as large as before, so
/// that nothing moves.
fn range_button(ui: &mut Ui, whole: Option<&Whole>) -> Response {
    let name = "whole plate";
    let Some(whole) = whole else { return ui.button(name) };
    let font = TextStyle::Button.resolve(ui.style());
    let color = ui.visuals().text_color();
    let text = ui.painter().layout_no_wrap(name.to_owned(), font, color).size();
    let size = text + 2.0 * ui.spacing().button_padding;
    ui.add(Button::new("stop").min_size(size)).on_hover_text(whole.progress_text())
}
