//! Work of the window with files and problems: shows files that were read, reads files again that
//! have changed, shows solutions.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Align2, Color32, TextStyle, Ui};
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::camera;
use crate::files::dialog::Purpose;
use crate::files::read::{FileContent, ReadFile, Why};
use crate::files::watch::{Stamp, stamp};
use crate::files::{SavedFile, name, session_file};
use crate::page::PageOrder;
use crate::panels::import::ImportDialog;
use crate::player;
use crate::session::{Pane, Session};
use crate::solving::ComputedDataset;
use crate::undo::Undo;
use crate::viewport::{OpenDataset, ViewState};

impl Viewer {
    /// Takes what has been read, written, dropped, chosen and solved since.
    pub(crate) fn work(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.take_dropped(ui);
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
        for (path, what) in self.files.written() {
            self.wrote(&path, &what);
        }
        match self.files.show(ui) {
            Some((Purpose::Open(pane) | Purpose::Import(pane), path)) => {
                self.open_file(&ctx, &path, pane)
            }
            Some((Purpose::Save(what), path)) => self.files.save(path, what, &self.session),
            None => {}
        }
        self.import(ui);
        self.tell_fallbacks();
        self.leave_when_saved(&ctx);
    }

    /// Reports the choices that the views had to replace.
    fn tell_fallbacks(&mut self) {
        for viewport in &mut self.viewports {
            let path = viewport.opened.as_ref().and_then(|opened| opened.path.clone());
            let path = path.unwrap_or_default();
            for text in viewport.told.drain(..) {
                let name = viewport.opened.as_ref().map_or_else(String::new, OpenDataset::name);
                self.files.tell_too(&path, &format!("{name}: {text}"));
            }
        }
    }

    /// True while something is read, written, solved or drawn.
    #[must_use]
    pub fn is_working(&self) -> bool {
        let is_drawing = self.viewports.iter().any(ViewState::is_drawing);
        let is_importing = self.importing.as_ref().is_some_and(ImportDialog::is_working);
        is_drawing || is_importing || self.files.is_working() || self.solving.is_working()
    }

    /// Opens a file in a pane, which is made if it is the one beside.
    pub fn open_file(&mut self, ctx: &egui::Context, path: &Path, pane: usize) {
        let pane = pane.min(1);
        if pane == self.session.panes.len() {
            self.session.panes.push(Pane::default());
            self.viewports.push(ViewState::new(ctx, self.backend));
        }
        self.files.open(path, pane, Why::Opened);
    }

    /// Shows a session: reads its files, and tells which are missing.
    pub fn take_session(&mut self, ctx: &egui::Context, session: Session) {
        self.shelve();
        self.session = session;
        self.session.repair();
        self.viewports =
            self.session.panes.iter().map(|_| ViewState::new(ctx, self.backend)).collect();
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

    /// Asks for the name of the file of what a view shows.
    pub(super) fn ask_dataset_of(&mut self, pane: usize) {
        match self.opened(pane).map(|opened| Arc::clone(&opened.dataset)) {
            Some(dataset) => self.ask(SavedFile::Dataset(dataset)),
            None => self.files.tell(Path::new(""), NOTHING_TO_SAVE, true),
        }
    }

    /// Asks for the name of a page of what is seen now; what keeps it from being written is told.
    pub(super) fn ask_page(&mut self) {
        let (pane, viewport) = (self.session.pane(), &self.viewports[self.session.active]);
        let view = viewport.camera.view.filter(|_| pane.place.is_some());
        let file = viewport.opened.as_ref().and_then(|opened| opened.path.as_deref());
        match PageOrder::new(viewport.frame(), pane.scene.clone(), view, file) {
            Ok(order) => self.ask(SavedFile::Page(Arc::new(order))),
            Err(reason) => {
                let told = format!("no page is exported: {reason}");
                self.files.tell(Path::new(""), told, true);
            }
        }
    }

    /// Asks for the name of a file, and proposes one: that which it has, or one beside the dataset
    /// or the problem that it belongs to.
    pub(super) fn ask(&mut self, what: SavedFile) {
        let folder = self.files.folder_near(None);
        let shown = self.viewports.iter().filter_map(|viewport| viewport.opened.as_ref());
        let mut all = shown.chain(self.undone_solution());
        let near = match &what {
            SavedFile::Dataset(dataset) => {
                let opened = all.find(|opened| Arc::ptr_eq(&opened.dataset, dataset));
                opened.and_then(|opened| opened.proposed_name(&folder))
            }
            SavedFile::Page(_) => {
                let opened = self.opened(self.session.active);
                let near = opened.and_then(|opened| opened.proposed_name(&folder));
                near.map(|near| near.with_extension("html"))
            }
            SavedFile::Session => self.files.session.clone().or_else(|| {
                Some(self.session.pane().file.as_ref()?.with_extension(session_file::EXTENSION))
            }),
            SavedFile::Problem(draft) => draft.proposed_name(),
        };
        self.files.ask(Purpose::Save(what), near.as_deref());
    }

    /// Closes a dataset; of two panes the one.
    pub fn close(&mut self, pane: usize) {
        self.player.is_playing = false;
        if self.session.panes.len() > 1 {
            self.merge(pane);
        } else {
            self.session.panes[pane] = Pane::default();
            (self.viewports[pane].opened, self.viewports[pane].camera.view) = (None, None);
        }
    }

    /// Something was written: it has a file now.
    fn wrote(&mut self, path: &Path, what: &SavedFile) {
        match what {
            SavedFile::Dataset(dataset) => self.note_dataset_file(dataset, path),
            SavedFile::Session => self.files.session = Some(path.to_owned()),
            SavedFile::Page(_) => return,
            SavedFile::Problem(written) => self.note_problem_file(written, path),
        }
        self.files.remember(path);
    }

    /// A dataset is in a file now: the views that show it are of that file; one that showed what
    /// was there before reads it again.
    fn note_dataset_file(&mut self, dataset: &Arc<Dataset>, path: &Path) {
        let is_it = |opened: &&mut OpenDataset| Arc::ptr_eq(&opened.dataset, dataset);
        if let Some(hidden) = self.hidden_solution().filter(is_it) {
            hidden.path = Some(path.to_owned());
        }
        let panes = self.session.panes.iter_mut().zip(&mut self.viewports);
        for (number, (pane, viewport)) in panes.enumerate() {
            let Some(opened) = &mut viewport.opened else { continue };
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
                    FileContent::Drawing(drawing) => {
                        self.importing = Some(ImportDialog::new(drawing));
                    }
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
            FileContent::Drawing(_) => {
                ("a drawing", if is_dataset { "a dataset" } else { "a problem" })
            }
            FileContent::Session(_) if is_dataset => ("a session", "a dataset"),
            FileContent::Session(_) => ("a session", "a problem"),
        };
        Err(format!("it is {is}, where {wanted} should be; open it by itself"))
    }

    fn tell_unreadable(&mut self, path: &Path, why: Why, stamp: Stamp, error: &str) {
        let name = name(path);
        let text = match (why, stamp) {
            (Why::Changed, None) => {
                format!("{name} is no longer there; what was read of it is still shown. {SAVE_IT}")
            }
            (Why::Changed, _) => format!(
                "{name} has changed and cannot be read: {error}. What was read before is still shown. {SAVE_IT}"
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
            self.solving.gives_way = true;
        }
        let is_linked = self.session.linked && self.session.panes.len() > 1;
        let (pane, viewport) = (&mut self.session.panes[pane], &mut self.viewports[pane]);
        pane.file = Some(path.clone());
        // linked views show a place that may be one of the other body alone
        let is_elsewhere = |place| !is_linked && !camera::is_of(place, &dataset.domain.bounds);
        if viewport.opened.is_none() && pane.place.is_some_and(is_elsewhere) {
            viewport.show_whole(pane);
        }
        viewport.told.extend(player::mend(pane, &dataset));
        let before = viewport.opened.as_ref().map(|opened| &opened.dataset);
        if why == Why::Changed && before.is_some_and(|before| is_another(before, &dataset)) {
            viewport.told.push(another_body(&dataset));
        }
        viewport.take(pane, OpenDataset::new(Some(path), dataset));
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
        self.solving.gives_way = true;
        let solution = Some(Arc::new(solution));
        self.replace_solution(number, OpenDataset { path: None, dataset, solution });
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

/// True if a dataset is of another body: no body of the same title whose holes have changed.
fn is_another(before: &Dataset, now: &Dataset) -> bool {
    let is_renamed = before.title != now.title && before.domain != now.domain;
    is_renamed || before.domain.bounds != now.domain.bounds
}

/// Returns the message about a file that has another body now.
fn another_body(dataset: &Dataset) -> String {
    let title = dataset.title.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("another body is in this file now, “{title}”, and is shown; {OTHER_NAME}")
}

const OTHER_NAME: &str = "let the program that writes it use another name to keep both";
const SAVE_IT: &str = "File, Save the dataset… writes that to a file";

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
