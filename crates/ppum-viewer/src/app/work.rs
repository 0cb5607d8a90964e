//! Work of the window with files and problems: shows files that were read, reads files again that
//! have changed, shows solutions.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Align2, Color32, TextStyle, Ui};
use ppum::dataset::Dataset;

use crate::actions::Action;
use crate::app::Viewer;
use crate::app::closing::CloseGuard;
use crate::files::dialog::Purpose;
use crate::files::read::{FileContent, ReadFile, Why};
use crate::files::watch::{Stamp, stamp};
use crate::files::{SavedFile, WrittenFile, name, session_file};
use crate::page::PageOrder;
use crate::plate;
use crate::player;
use crate::session::{Pane, Session};
use crate::solving::{ComputedDataset, editor_id};
use crate::stage::{OpenDataset, ViewPane};
use crate::undo::Undo;

impl Viewer {
    /// Takes what has been read, written, dropped, chosen and solved since.
    pub(crate) fn work(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.take_dropped(ui);
        if !self.files.is_saving() {
            self.page = None;
        }
        if let Some(rect) = ctx.input(|input| input.viewport().inner_rect) {
            self.files.kept.size = Some(rect.size().into());
        }
        self.files.keep(&self.session);
        self.let_in(&ctx);
        let (panes, draft) = (&self.session.panes, &self.session.draft);
        let draft = draft.as_ref().and_then(|draft| draft.path.as_deref());
        let is_open = |path: &Path| {
            panes.iter().any(|pane| pane.file.as_deref() == Some(path)) || draft == Some(path)
        };
        for path in self.files.changed(is_open) {
            self.read_again(&path);
        }
        if let Some(solved) = self.solving.poll() {
            self.show_solved(&ctx, solved);
        }
        for written in self.files.written() {
            self.wrote(written);
        }
        if let Some((purpose, path)) = self.files.show(ui) {
            self.chosen(&ctx, purpose, path);
        }
        self.tell_fallbacks();
        self.leave_when_saved(&ctx);
    }

    /// Reports the choices that the views had to replace.
    fn tell_fallbacks(&mut self) {
        for stage in &mut self.stages {
            let path = stage.opened.as_ref().and_then(|opened| opened.path.clone());
            let path = path.unwrap_or_default();
            for text in stage.told.drain(..) {
                let name = stage.opened.as_ref().map_or_else(String::new, OpenDataset::name);
                self.files.tell_too(&path, &format!("{name}: {text}"));
            }
        }
    }

    /// True while something is read, written, solved or drawn.
    #[must_use]
    pub fn is_working(&self) -> bool {
        let is_drawing = self.stages.iter().any(ViewPane::is_drawing);
        is_drawing || self.files.is_working() || self.solving.is_working()
    }

    /// Opens a file in a pane, which is made if it is the one beside.
    pub fn open_file(&mut self, ctx: &egui::Context, path: &Path, pane: usize) {
        let pane = pane.min(1);
        if pane == self.session.panes.len() {
            self.session.panes.push(Pane::default());
            self.stages.push(ViewPane::new(ctx, self.backend));
        }
        self.files.open(path, pane, Why::Opened);
    }

    /// Shows a session: reads its files, and tells which are missing.
    pub fn take_session(&mut self, ctx: &egui::Context, session: Session) {
        self.shelve();
        self.session = session;
        self.session.repair();
        self.stages = self.session.panes.iter().map(|_| ViewPane::new(ctx, self.backend)).collect();
        self.settings = Undo::new(self.session.settings());
        self.show_theme(ctx);
        for (number, pane) in self.session.panes.iter().enumerate() {
            if let Some(path) = &pane.file {
                self.files.open(path, number, Why::Restored);
            }
        }
        self.solving.begin(None);
        if let Some(path) = self.session.draft.as_ref().and_then(|draft| draft.path.as_ref()) {
            self.files.open(path, 0, Why::Restored);
        }
    }

    /// Keeps all that is to be remembered; the window closes.
    pub fn leave(&mut self) {
        // another window may keep its session in the place of this one
        if let Some(draft) = self.session.draft.clone() {
            self.files.put_aside(draft);
        }
        self.files.finish(&self.session);
    }

    /// Does what was asked for with files and problems.
    pub(crate) fn act_on_files(&mut self, ctx: &egui::Context, action: Action) {
        let active = self.session.active;
        let file = self.session.panes[active].file.clone();
        match action {
            Action::Open => self.files.ask(Purpose::Open(active), file.as_deref()),
            Action::OpenBeside => self.files.ask(Purpose::Open(1), file.as_deref()),
            Action::Close => self.part(ctx, CloseGuard::Pane(active)),
            Action::SaveDataset => self.ask_dataset_of(active),
            Action::SaveDatasetOf(pane) => self.ask_dataset_of(pane),
            Action::ExportPage => self.ask_page(active),
            // who writes the problem means the problem
            Action::SaveSession if ctx.memory(|m| m.has_focus(editor_id())) => self.save_problem(),
            Action::SaveSession => match self.files.session.clone() {
                Some(path) => self.write_session(path),
                None => self.ask_session(),
            },
            Action::SaveSessionAs => self.ask_session(),
            Action::Solve => {
                self.follow_dataset();
                self.part(ctx, CloseGuard::Solve(None));
            }
            Action::Example(number) => self.part(ctx, CloseGuard::Solve(Some(number))),
            Action::CancelSolving => self.solving.cancel(),
            Action::SaveProblem => self.save_problem(),
            Action::SaveProblemAs => {
                if let Some(draft) = self.session.draft.clone() {
                    self.ask_problem(draft);
                }
            }
            Action::CloseProblem => {
                self.shelve();
                self.session.drawer = None;
            }
            Action::TakeText(number) => self.take_text(number),
            Action::DiscardText(number) => {
                if let Some(draft) = self.files.texts().get(number).cloned() {
                    self.part(ctx, CloseGuard::Text(draft));
                }
            }
            Action::ShowText => self.show_text_of(active),
            _ => {}
        }
    }

    /// Asks for the name of the file of what a view shows.
    fn ask_dataset_of(&mut self, pane: usize) {
        match self.opened(pane).map(|opened| Arc::clone(&opened.dataset)) {
            Some(dataset) => self.ask_dataset(&dataset),
            None => self.files.tell(Path::new(""), NOTHING_TO_SAVE, true),
        }
    }

    /// Asks for the name of a dataset's file: its own, or that of its problem.
    pub(super) fn ask_dataset(&mut self, dataset: &Arc<Dataset>) {
        let mut all = self.stages.iter().filter_map(|stage| stage.opened.as_ref());
        let opened = all.find(|opened| Arc::ptr_eq(&opened.dataset, dataset));
        let folder = self.files.folder_near(None);
        let near = opened.and_then(|opened| opened.proposed_name(&folder));
        self.files.ask(Purpose::SaveDataset(Arc::clone(dataset)), near.as_deref());
    }

    /// Asks for the name of a page of what is seen now; what keeps it from being written is told.
    fn ask_page(&mut self, pane: usize) {
        match PageOrder::new(&self.session.panes[pane], &self.stages[pane]) {
            Ok(order) => self.page = Some(order),
            Err(reason) => {
                let told = format!("no page is exported: {reason}");
                return self.files.tell(Path::new(""), told, true);
            }
        }
        let folder = self.files.folder_near(None);
        let near = self.opened(pane).and_then(|opened| opened.proposed_name(&folder));
        let near = near.map(|near| near.with_extension("html"));
        self.files.ask(Purpose::ExportPage, near.as_deref());
    }

    fn ask_session(&mut self) {
        let near = self.files.session.clone().or_else(|| {
            let file = self.session.pane().file.as_ref()?;
            Some(file.with_extension(session_file::EXTENSION))
        });
        self.files.ask(Purpose::SaveSession, near.as_deref());
    }

    /// Closes a dataset; of two panes the one.
    pub fn close(&mut self, pane: usize) {
        self.player.is_playing = false;
        if self.session.panes.len() > 1 {
            self.merge(pane);
        } else {
            self.session.panes[pane] = Pane::default();
            self.stages[pane].opened = None;
        }
    }

    fn write_session(&mut self, path: PathBuf) {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        match session_file::text(&self.session, &folder) {
            Ok(text) => self.files.write_text(path, SavedFile::Session, text),
            Err(error) => self.files.tell(&path, error.to_string(), true),
        }
    }

    /// Opens or writes the file that was chosen.
    fn chosen(&mut self, ctx: &egui::Context, purpose: Purpose, path: PathBuf) {
        match purpose {
            Purpose::Open(pane) => self.open_file(ctx, &path, pane),
            Purpose::SaveSession => self.write_session(path),
            Purpose::SaveProblem(draft) => self.write_problem(path, draft),
            Purpose::ExportPage => {
                if let Some(page) = self.page.take() {
                    self.files.write(path, SavedFile::Page, move |path| page.write(path));
                }
            }
            Purpose::SaveDataset(dataset) => self.files.write_dataset(path, dataset),
        }
    }

    /// Something was written: it has a file now.
    fn wrote(&mut self, WrittenFile { path, what }: WrittenFile) {
        match what {
            SavedFile::Dataset(dataset) => self.note_dataset_file(&dataset, &path),
            SavedFile::Session => self.files.session = Some(path.clone()),
            SavedFile::Page => return,
            SavedFile::Problem(written) => self.note_problem_file(&written, &path),
        }
        self.files.remember(&path);
    }

    /// A dataset is in a file now: the views that show it are of that file; one that showed what
    /// was there before reads it again.
    fn note_dataset_file(&mut self, dataset: &Arc<Dataset>, path: &Path) {
        let panes = self.session.panes.iter_mut().zip(&mut self.stages);
        for (number, (pane, stage)) in panes.enumerate() {
            let Some(opened) = &mut stage.opened else { continue };
            if Arc::ptr_eq(&opened.dataset, dataset) {
                (pane.file, opened.path) = (Some(path.to_owned()), Some(path.to_owned()));
            } else if pane.file.as_deref() == Some(path) {
                self.files.open(path, number, Why::Changed);
            }
        }
    }

    /// Shows what was read; what cannot be read is told beside its name, and harms nothing.
    pub(super) fn arrive(&mut self, ctx: &egui::Context, arrived: ReadFile) {
        let ReadFile { path, pane, why, stamp, content } = arrived;
        // it may have been closed since, and another one taken its place
        let Some(pane) = self.place_of(&path, pane, why) else { return };
        let content = content.and_then(|content| self.expected(&path, why, content));
        if content.is_ok() || why != Why::Opened {
            self.files.follow(&path, stamp);
        }
        match content {
            Err(error) => self.tell_unreadable(&path, why, stamp, &error),
            Ok(content) => {
                self.files.settle(&path);
                if why == Why::Opened {
                    self.files.remember(&path);
                }
                match content {
                    FileContent::Dataset(dataset) => self.show_dataset(pane, path, dataset, why),
                    FileContent::Problem(text) => self.take_problem(path, text, why),
                    FileContent::Session(session) => {
                        self.take_session(ctx, *session);
                        self.files.session = Some(path);
                    }
                }
            }
        }
    }

    fn is_of_pane(&self, path: &Path, pane: usize) -> bool {
        self.session.panes.get(pane).is_some_and(|pane| pane.file.as_deref() == Some(path))
    }

    /// The pane that a file is for; none if it is no longer open.
    fn place_of(&self, path: &Path, pane: usize, why: Why) -> Option<usize> {
        let last = self.session.panes.len() - 1;
        if why == Why::Opened || self.is_of_pane(path, pane) {
            return Some(pane.min(last));
        }
        let is_text = self.session.draft.as_ref().is_some_and(|d| d.path.as_deref() == Some(path));
        (0..=last).find(|pane| self.is_of_pane(path, *pane)).or(is_text.then_some(0))
    }

    /// Returns the content if a file that is open already, or that a session names, has the
    /// expected kind; an error if something else is in it.
    fn expected(&self, path: &Path, why: Why, content: FileContent) -> Result<FileContent, String> {
        let is_dataset = (0..self.session.panes.len()).any(|pane| self.is_of_pane(path, pane));
        let (is, wanted) = match &content {
            _ if why == Why::Opened => return Ok(content),
            FileContent::Dataset(_) if is_dataset => return Ok(content),
            FileContent::Problem(_) if !is_dataset => return Ok(content),
            FileContent::Dataset(_) => ("a dataset", "a problem"),
            FileContent::Problem(_) => ("the text of a problem", "a dataset"),
            FileContent::Session(_) if is_dataset => ("a session", "a dataset"),
            FileContent::Session(_) => ("a session", "a problem"),
        };
        Err(format!("it is {is}, where {wanted} should be; open it by itself"))
    }

    fn tell_unreadable(&mut self, path: &Path, why: Why, stamp: Stamp, error: &str) {
        let name = name(path);
        let text = match (why, stamp) {
            (Why::Changed, None) => {
                format!("{name} is no longer there; what was read of it is still shown")
            }
            (Why::Changed, _) => format!(
                "{name} has changed and cannot be read: {error}. What was read before is still shown"
            ),
            // a session may lie far from its files
            (Why::Restored, _) => {
                format!("{} of the session cannot be read: {error}", path.display())
            }
            (Why::Opened, _) => format!("{name} cannot be read: {error}"),
        };
        self.files.tell(path, text, true);
    }

    fn show_dataset(&mut self, pane: usize, path: PathBuf, dataset: Arc<Dataset>, why: Why) {
        let is_same = self.session.panes[pane].file.as_ref() == Some(&path);
        if why == Why::Opened && !is_same {
            self.session.panes[pane] = Pane::default();
        }
        let is_linked = self.session.linked && self.session.panes.len() > 1;
        let (pane, stage) = (&mut self.session.panes[pane], &mut self.stages[pane]);
        pane.file = Some(path.clone());
        // linked views show a place that may be one of the other body alone
        let is_elsewhere = |place| !is_linked && !plate::is_of(place, &dataset.domain.bounds);
        if stage.opened.is_none() && pane.place.is_some_and(is_elsewhere) {
            stage.show_whole(pane);
        }
        stage.told.extend(player::mend(pane, &dataset));
        stage.take(pane, OpenDataset::new(Some(path), dataset));
    }

    /// Reads a file again that has changed; of one that vanished the last state stays.
    fn read_again(&mut self, path: &Path) {
        if stamp(path).is_none() {
            self.tell_unreadable(path, Why::Changed, None, "");
            return;
        }
        for (number, pane) in self.session.panes.iter().enumerate() {
            if pane.file.as_deref() == Some(path) {
                self.files.open(path, number, Why::Changed);
            }
        }
        let draft = self.session.draft.as_ref().and_then(|draft| draft.path.as_deref());
        if draft == Some(path) {
            self.files.open(path, 0, Why::Changed);
        }
    }

    /// Shows what was solved; the view is kept if the body has the same place.
    fn show_solved(&mut self, ctx: &egui::Context, solved: ComputedDataset) {
        let ComputedDataset { pane, dataset, solution } = solved;
        let number = self.free_pane(ctx, pane, solution.is_complete());
        let (pane, stage) = (&mut self.session.panes[number], &mut self.stages[number]);
        pane.file = None;
        // what was a series may be one step now
        let _ = player::mend(pane, &dataset);
        stage.take(pane, OpenDataset { path: None, dataset, solution: Some(Arc::new(solution)) });
    }

    /// Files that were dropped: the first in the active pane, another one beside it.
    fn take_dropped(&mut self, ui: &Ui) {
        let (dropped, is_hovered) = ui
            .input(|input| (input.raw.dropped_files.clone(), !input.raw.hovered_files.is_empty()));
        for (k, file) in dropped.iter().take(2).enumerate() {
            let pane = if k == 0 { self.session.active } else { 1 };
            self.open_file(ui.ctx(), file.path(), pane);
        }
        if is_hovered {
            hint(ui);
        }
    }
}

const NOTHING_TO_SAVE: &str = "Nothing is saved: this view shows no dataset. Choose the view that shows it by a click, or solve the problem first";

/// Words over the whole window while a file is dragged over it.
fn hint(ui: &Ui) {
    let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop"));
    let painter = ui.ctx().layer_painter(layer);
    let rect = ui.ctx().content_rect();
    painter.rect_filled(rect, 0.0, Color32::from_black_alpha(150));
    let font = TextStyle::Heading.resolve(ui.style());
    painter.text(rect.center(), Align2::CENTER_CENTER, "Drop it to open it", font, Color32::WHITE);
}
