//! The menu of files, and what is told of them.

use std::path::PathBuf;
use std::time::Duration;

use egui::{Align2, Area, Frame, Id, Label, Order, ProgressBar, RichText, ScrollArea, Spinner, Ui};

use crate::actions::Action;
use crate::export::ExportChoice;
use crate::files::examples;
use crate::files::name;
use crate::files::read::{FileRead, Why};
use crate::panel_context::PanelContext;
use crate::widgets::button;

/// The menu.
pub fn menu(ui: &mut Ui, context: &mut PanelContext<'_>) {
    ui.menu_button("File", |ui| {
        let all = [
            ("Open…", Action::Open),
            ("Open beside…", Action::OpenBeside),
            ("New problem", Action::NewProblem),
            ("Import a drawing…", Action::Import),
            ("Save the dataset…", Action::SaveDataset),
            ("Save the session", Action::SaveSession),
            ("Save the session as…", Action::SaveSessionAs),
            ("Close", Action::Close),
        ];
        items(ui, context, &all);
        ui.separator();
        exports(ui, context);
        ui.separator();
        ui.menu_button("Recent files", |ui| recent(ui, context));
        ui.menu_button("Examples", |ui| {
            for (k, example) in examples::ALL.iter().enumerate() {
                if ui.button(example.title()).clicked() {
                    context.actions.push(Action::Example(k));
                }
            }
        });
    });
}

/// Shows the exports of the image.
pub fn exports(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let all = [
        ("Image…", Action::Save(ExportChoice::Image)),
        ("Figure for print…", Action::Save(ExportChoice::Figure)),
        ("Animation of the steps…", Action::Save(ExportChoice::Steps)),
        ("Animation of the deformation…", Action::Save(ExportChoice::Deformation)),
        ("Export page…", Action::ExportPage),
        ("Copy the command", Action::CopyCommand),
    ];
    items(ui, context, &all);
}

/// Items of a menu.
fn items(ui: &mut Ui, context: &mut PanelContext<'_>, all: &[(&str, Action)]) {
    for (name, action) in all {
        if ui.add_enabled(context.is_possible(*action), egui::Button::new(*name)).clicked() {
            context.actions.push(*action);
        }
    }
}

/// Files that were opened, the newest first.
pub fn recent(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let recent: Vec<PathBuf> = context.files.kept.recent.clone();
    if recent.is_empty() {
        ui.weak("None yet.");
    }
    for path in recent {
        let button = ui.button(name(&path)).on_hover_text(path.display().to_string());
        if button.clicked() {
            context.files.open(&path, context.session.active, Why::Opened);
        }
    }
}

/// Shows the files that are being read, and notes about files: over the view's upper edge, so that
/// nothing moves for them.
pub fn notes(ui: &Ui, context: &mut PanelContext<'_>) {
    let waits =
        context.files.readings().iter().filter_map(|r| QUICK.checked_sub(r.since.elapsed()));
    if let Some(rest) = waits.min() {
        ui.ctx().request_repaint_after(rest);
    }
    let is_slow = context.files.readings().iter().any(is_slow);
    if context.files.notes.is_empty() && !is_slow {
        return;
    }
    let area = Area::new(Id::unique("notes")).order(Order::Foreground);
    let area = area.anchor(Align2::CENTER_TOP, [0.0, 36.0]).fade_in(false);
    area.show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            let room = ui.ctx().content_rect().size();
            ui.set_max_width((room.x - 60.0).clamp(80.0, 640.0));
            let most = (0.5 * room.y).max(40.0);
            ScrollArea::vertical().max_height(most).show(ui, |ui| {
                readings(ui, context);
                notes_panel(ui, context);
            });
        });
    });
}

/// Files that are read within this time are not shown: words that come and go at once only disturb.
const QUICK: Duration = Duration::from_millis(300);

fn is_slow(reading: &FileRead) -> bool {
    reading.since.elapsed() > QUICK
}

fn readings(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let mut cancelled = None;
    for reading in context.files.readings().iter().filter(|reading| is_slow(reading)) {
        ui.horizontal(|ui| {
            match reading.part().filter(|part| *part < 1.0) {
                Some(part) => {
                    ui.add(ProgressBar::new(part).desired_width(80.0));
                    ui.label(format!("reading {}", name(&reading.path)));
                }
                None => {
                    ui.add(Spinner::new().size(14.0));
                    ui.label(format!("checking {}", name(&reading.path)));
                }
            }
            if button(ui, "✗", "Stop reading").clicked() {
                cancelled = Some(reading.path.clone());
            }
        });
    }
    if let Some(path) = cancelled {
        context.files.cancel(&path);
    }
}

fn notes_panel(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let mut closed = None;
    for note in &context.files.notes {
        ui.horizontal(|ui| {
            if button(ui, "✗", "Close the note").clicked() {
                closed = Some(note.path.clone());
            }
            let text = RichText::new(&note.text);
            let text = if note.is_error { text.color(ui.visuals().error_fg_color) } else { text };
            ui.add(Label::new(text).wrap());
        });
        // what went well need not be confirmed
        if !note.is_error {
            match SHOWN.checked_sub(note.since.elapsed()) {
                Some(rest) => ui.ctx().request_repaint_after(rest),
                None => closed = Some(note.path.clone()),
            }
        }
    }
    if let Some(path) = closed {
        context.files.settle(&path);
    }
}

/// The time for which it is told that something went well.
const SHOWN: Duration = Duration::from_secs(4);
