//! The player of a series in the bar at the top of the window.

use egui::{DragValue, Label, RichText, Slider, Ui};
use ppum::dataset::Step;
use ppum::text::trimmed;
use ppum_scene::facts::GrowthFacts;

use crate::actions::Action;
use crate::panel_context::PanelContext;
use crate::player::SPEEDS;
use crate::widgets::button;

/// Shows the player if the dataset is a series, in a row of its own, which is never broken.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let opened = context.active().1.opened.as_ref();
    if opened.is_some_and(|opened| opened.dataset.steps.len() > 1) {
        ui.horizontal(|ui| row(ui, context));
    }
}

fn row(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let active = context.session.active;
    let Some(opened) = &context.viewports[active].opened else { return };
    let steps = &opened.dataset.steps;
    let subject = &mut context.session.panes[active].scene.subject;
    let last = steps.len() - 1;
    let stop = steps[last].growth.as_ref().and_then(|growth| growth.stop);
    let mut step = subject.step_of(&opened.dataset).min(last);
    if button(ui, "◀", "Step before").clicked() {
        context.actions.push(Action::Step(-1));
    }
    let rest = if stop.is_some() { REST + REASON } else { REST };
    ui.spacing_mut().slider_width = (ui.available_width() - rest).clamp(60.0, 600.0);
    let slider = ui.add(Slider::new(&mut step, 0..=last).show_value(false));
    slider.widget_info(|| {
        let text = format!("Step {step} of {last}");
        egui::WidgetInfo::slider(true, step as f64, text)
    });
    if slider.changed() {
        subject.step = Some(step);
    }
    if button(ui, "▶", "Step after").clicked() {
        context.actions.push(Action::Step(1));
    }
    let load = trimmed(steps[step].load);
    ui.label(format!("step {step} of {last}, load {load}"));
    let (sign, name) =
        if context.player.is_playing { ("■", "Stop") } else { ("▷", "Play the steps") };
    if button(ui, sign, name).clicked() {
        context.actions.push(Action::Play);
    }
    let speed = DragValue::new(&mut context.player.speed).range(SPEEDS).speed(0.1).suffix(" /s");
    ui.add(speed.max_decimals(1)).on_hover_text("Speed: steps in a second");
    let looping =
        ui.selectable_label(context.player.is_looping, "↻").on_hover_text("Again and again");
    looping.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::Button, true, context.player.is_looping, "Loop")
    });
    if looping.clicked() {
        context.player.is_looping = !context.player.is_looping;
    }
    if let Some(stop) = stop.filter(|_| step == last) {
        let text = RichText::new(format!("Growth ends: {}", stop.words()));
        ui.add(Label::new(text.strong()).truncate()).on_hover_text(ends(steps));
    }
}

/// Describes the actions of the tips in the last steps, the last one with tips included.
fn ends(steps: &[Step]) -> String {
    let told = |(number, step): (usize, &Step)| {
        let lines = GrowthFacts::new(step.growth.as_ref()?).lines();
        Some(format!("step {number}: {}", lines.join("; ")))
    };
    let first = steps.len().saturating_sub(2);
    let told: Vec<_> = steps.iter().enumerate().skip(first).filter_map(told).collect();
    told.join("\n")
}

/// Width of the controls other than the slider, and of the reason why growth ends \[points\].
const REST: f32 = 330.0;
const REASON: f32 = 200.0;
