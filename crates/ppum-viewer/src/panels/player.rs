//! The player of a series in the bar at the top of the window.

use egui::{Button, DragValue, Label, RichText, Role, Slider, Ui, WidgetInfo, vec2};
use ppum::dataset::Step;
use ppum::text::trimmed;
use ppum_scene::facts::GrowthFacts;

use crate::actions::Action;
use crate::panel_context::PanelContext;
use crate::player::{Player, SPEEDS};
use crate::widgets::button;

/// Shows the player if the dataset is a series, in a row of its own, which is never broken.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let opened = context.active().1.opened.as_ref();
    if opened.is_some_and(|opened| opened.dataset.steps.len() > 1) {
        ui.horizontal(|ui| row(ui, context));
    }
}

/// Playing, speed and steps come first: none of them moves when the text behind the slider changes.
fn row(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let active = context.session.active;
    let Some(opened) = &context.viewports[active].opened else { return };
    let steps = &opened.dataset.steps;
    let subject = &mut context.session.panes[active].scene.subject;
    let last = steps.len() - 1;
    let stop = steps[last].growth.as_ref().and_then(|growth| growth.stop);
    let mut step = subject.step_of(&opened.dataset).min(last);
    playing(ui, context.player, context.actions);
    for (sign, name, by) in [("◀", "Step before", -1), ("▶", "Step after", 1)] {
        if button(ui, sign, name).clicked() {
            context.actions.push(Action::Step(by));
        }
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
    let load = trimmed(steps[step].load);
    let progress = context.viewports[active].controls.step_range.progress_text();
    ui.label(progress.unwrap_or_else(|| format!("step {step} of {last}, load {load}")));
    if let Some(stop) = stop.filter(|_| step == last) {
        let text = RichText::new(format!("Growth ends: {}", stop.words()));
        ui.add(Label::new(text.strong()).truncate()).on_hover_text(ends(steps));
    }
}

/// Play or stop, the speed, and whether it begins again.
fn playing(ui: &mut Ui, player: &mut Player, actions: &mut Vec<Action>) {
    let (text, name) =
        if player.is_playing { ("Stop", "Stop") } else { ("Play", "Play the steps") };
    let play = Button::new(text).min_size(vec2(PLAY, 0.0)).selected(player.is_playing);
    let play = ui.add(play).on_hover_text(name);
    play.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    if play.clicked() {
        actions.push(Action::Play);
    }
    let speed = DragValue::new(&mut player.speed).range(SPEEDS).speed(0.1).suffix(" /s");
    let speed = ui.add_sized([SPEED, ui.spacing().interact_size.y], speed.max_decimals(1));
    speed.on_hover_text("Speed: steps in a second");
    let looping = ui.selectable_label(player.is_looping, "↻").on_hover_text("Again and again");
    looping.widget_info(|| WidgetInfo::selected(Role::Button, true, player.is_looping, "Loop"));
    if looping.clicked() {
        player.is_looping = !player.is_looping;
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

/// Widths of the text behind the slider, and of the reason why growth ends \[points\].
const REST: f32 = 170.0;
const REASON: f32 = 200.0;
/// Widths of buttons whose texts change \[points\].
const PLAY: f32 = 52.0;
const SPEED: f32 = 52.0;
