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
pub fn menu(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    ui.menu_button("File", |ui| {
        let has_dataset = desk.active().1.opened.is_some();
        for (name, action, is_possible) in [
            ("Open…", Action::Open, true),
            ("Open beside…", Action::OpenBeside, has_dataset),
            ("Save the dataset…", Action::SaveDataset, has_dataset),
            ("Save the session", Action::SaveSession, true),
            ("Save the session as…", Action::SaveSessionAs, true),
            ("Close", Action::Close, has_dataset),
        ] {
            if ui.add_enabled(is_possible, egui::Button::new(name)).clicked() {
                desk.actions.push(action);
            }
        }
        ui.separator();
        exports(ui, desk);
        ui.separator();
        ui.menu_button("Recent files", |ui| recent(ui, desk));
        ui.menu_button("Examples", |ui| {
            for (k, example) in examples::ALL.iter().enumerate() {
                if ui.button(example.title()).clicked() {
                    desk.actions.push(Action::Example(k));
                }
            }
        });
    });
}

/// Shows the exports of the image.
pub fn exports(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let stage = desk.active().1;
    let steps = stage.opened.as_ref().map_or(0, |opened| opened.dataset.steps.len());
    let (has_dataset, is_elastic) = (steps > 0, steps > 0 && !stage.is_rigid());
    for (name, action, is_possible) in [
        ("Image…", Action::Save(ExportChoice::Picture), has_dataset),
        ("Figure for print…", Action::Save(ExportChoice::Figure), has_dataset),
        ("Animation of the steps…", Action::Save(ExportChoice::Steps), steps > 1),
        ("Animation of the deformation…", Action::Save(ExportChoice::Deformation), is_elastic),
        ("Export page…", Action::ExportPage, has_dataset),
        ("Copy the command", Action::CopyCommand, has_dataset),
    ] {
        if ui.add_enabled(is_possible, egui::Button::new(name)).clicked() {
            desk.actions.push(action);
        }
    }
}

/// Files that were opened, the newest first.
pub fn recent(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let recent: Vec<PathBuf> = desk.files.kept.recent.clone();
    if recent.is_empty() {
        ui.weak("None yet.");
    }
    for path in recent {
        let button = ui.button(name(&path)).on_hover_text(path.display().to_string());
        if button.clicked() {
            desk.files.open(&path, desk.session.active, Why::Opened);
        }
    }
}

/// Shows the files that are being read, and notes about files: over the view's upper edge, so that
/// nothing moves for them.
pub fn notes(ui: &Ui, desk: &mut PanelContext<'_>) {
    let waits = desk.files.readings().iter().filter_map(|r| QUICK.checked_sub(r.since.elapsed()));
    if let Some(rest) = waits.min() {
        ui.ctx().request_repaint_after(rest);
    }
    let is_slow = desk.files.readings().iter().any(is_slow);
    if desk.files.notes.is_empty() && !is_slow {
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
                readings(ui, desk);
                notes_panel(ui, desk);
            });
        });
    });
}

/// Files that are read within this time are not shown: words that come and go at once only disturb.
const QUICK: Duration = Duration::from_millis(300);

fn is_slow(reading: &FileRead) -> bool {
    reading.since.elapsed() > QUICK
}

fn readings(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let mut cancelled = None;
    for reading in desk.files.readings().iter().filter(|reading| is_slow(reading)) {
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
        desk.files.cancel(&path);
    }
}

fn notes_panel(ui: &mut Ui, desk: &mut PanelContext<'_>) {
    let mut closed = None;
    for note in &desk.files.notes {
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
        desk.files.settle(&path);
    }
}

/// The time for which it is told that something went well.
const SHOWN: Duration = Duration::from_secs(4);
