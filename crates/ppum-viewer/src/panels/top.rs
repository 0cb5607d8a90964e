//! The bar at the top of the window.

use egui::{Label, ProgressBar, RichText, Sense, Ui};

use super::player;
use crate::actions::Action;
use crate::panel_context::PanelContext;
use crate::reading::tool::Tool;
use crate::session::DrawerPage;
use crate::widgets::button;

/// A text on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Shows buttons for the most frequent actions, and the title in the room that they leave: it ends
/// in … where it has none, and is told on hover then.
pub fn show(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        super::files::menu(ui, desk);
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
                desk.actions.push(action);
            }
        }
        if desk.active().1.opened.is_some() {
            reading(ui, desk);
        }
        replaced(ui, desk);
        solving(ui, desk);
        let opened = desk.active().1.opened.as_ref();
        let title = one_line(opened.map_or("ppum", |opened| &opened.dataset.title));
        ui.add(Label::new(RichText::new(title).strong()).truncate());
    });
    player::show(ui, desk);
}

/// Says that functions, the weight or quantities are not those of the file.
fn replaced(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let (pane, stage) = desk.active();
    let subject = &pane.scene.subject;
    let count = subject.functions.len() + subject.quantities.len();
    let count = count + usize::from(subject.weight.is_some());
    if count > 0 {
        let text = RichText::new(format!("⚠ {count} replaced")).color(ui.visuals().warn_fg_color);
        let button = ui.button(text);
        let button = button.on_hover_text("Formulas in the place of the file's: show them");
        if button.clicked() {
            stage.controls.wants = Some("Functions");
            desk.session.panels = true;
        }
    }
}

/// Shows the progress of a running solution on every page; a click opens the page *Problem*.
fn solving(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let Some(running) = desk.solving.running() else { return };
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
        desk.session.drawer = Some(DrawerPage::Problem);
    }
}

/// Shows buttons for features that are easily overlooked: saving images, probes, K at a tip, two
/// views.
fn reading(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let (pane, stage) = desk.active();
    let has_tips = stage.tips(pane) > 0;
    let is_probing = stage.reading.tool == Some(Tool::Probe);
    ui.separator();
    ui.menu_button("Save image", |ui| super::files::exports(ui, desk))
        .response
        .on_hover_text("An image, a figure for print, an animation");
    for (name, hint, action, is_possible) in [
        (
            "Probe",
            "Click points of the plate to keep their values; p keeps those at the pointer",
            Action::Draw(Tool::Probe),
            true,
        ),
        (
            "K at a tip",
            "K, T and G on a circle around the nearest tip",
            Action::CircleForK,
            has_tips,
        ),
        ("Two views", "Two views side by side, or one", Action::Split, true),
    ] {
        let is_on = is_probing && name == "Probe";
        let button = ui.add_enabled(is_possible, egui::Button::new(name).selected(is_on));
        if button.on_hover_text(hint).clicked() {
            desk.actions.push(action);
        }
    }
}
