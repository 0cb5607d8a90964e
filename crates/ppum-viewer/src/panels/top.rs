//! The bar at the top of the window.

use egui::{Label, ProgressBar, RichText, Sense, Ui};

use super::player;
use crate::actions::Action;
use crate::measure::tool::Tool;
use crate::panel_context::PanelContext;
use crate::session::DrawerPage;
use crate::widgets::button;

/// A text on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Shows buttons for the most frequent actions, and the title in the room that they leave: it ends
/// in … where it has none, and is told on hover then.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        super::files::menu(ui, context);
        for (sign, name, action) in [
            ("⌂", "Show the whole plate", Action::Fit),
            ("↶", "Undo", Action::Undo),
            ("↷", "Redo", Action::Redo),
            ("←", "Back to the view before", Action::Back),
            ("→", "Forward to the view after", Action::Forward),
            ("☰", "Find an action", Action::Palette),
            ("?", "Keys", Action::Help),
        ] {
            if button(ui, sign, name).clicked() {
                context.actions.push(action);
            }
        }
        if context.active().1.opened.is_some() {
            reading(ui, context);
        }
        replaced(ui, context);
        solving(ui, context);
        let opened = context.active().1.opened.as_ref();
        let title = one_line(opened.map_or("ppum", |opened| &opened.dataset.title));
        ui.add(Label::new(RichText::new(title).strong()).truncate());
    });
    player::show(ui, context);
}

/// Says that functions, the weight or quantities are not those of the file.
fn replaced(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let (pane, viewport) = context.active();
    let subject = &pane.scene.subject;
    let count = subject.functions.len() + subject.quantities.len();
    let count = count + usize::from(subject.weight.is_some());
    if count > 0 {
        let text = RichText::new(format!("⚠ {count} replaced")).color(ui.visuals().warn_fg_color);
        let button = ui.button(text);
        let button = button.on_hover_text("Formulas in the place of the file's: show them");
        if button.clicked() {
            viewport.controls.panel_to_open = Some("Functions");
            context.session.panels = true;
        }
    }
}

/// Shows the progress of a running solution on every page; a click opens the page *Problem*.
fn solving(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let Some(running) = context.solving.running() else { return };
    let told = running.progress_report();
    let step = told.progress.map_or(0, |progress| progress.step);
    let text = match told.steps {
        Some(last) => format!("step {step} of {last}"),
        None => "solving".into(),
    };
    let bar = ProgressBar::new(told.part).desired_width(130.0).text(text);
    let response = ui.add(bar).interact(Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, "A solution runs"));
    if response.on_hover_text("Show the problem, and cancel there").clicked() {
        context.session.drawer = Some(DrawerPage::Problem);
    }
}

/// Shows buttons for features that are easily overlooked: saving images, probes, K at a tip, two
/// views.
fn reading(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let is_probing = context.active().1.tools.tool == Some(Tool::Probe);
    ui.separator();
    ui.menu_button("Save image", |ui| super::files::exports(ui, context))
        .response
        .on_hover_text("An image, a figure for print, an animation");
    for (name, hint, action) in [
        (
            "Probe",
            "Click points of the plate to keep their values; p keeps those at the pointer",
            Action::Draw(Tool::Probe),
        ),
        ("K at a tip", "K, T and G on a circle around the nearest tip", Action::CircleForK),
        ("Two views", "Two views side by side, or one", Action::Split),
    ] {
        let is_on = is_probing && name == "Probe";
        let button = egui::Button::new(name).selected(is_on);
        let button = ui.add_enabled(context.is_possible(action), button);
        if button.on_hover_text(hint).clicked() {
            context.actions.push(action);
        }
    }
}
