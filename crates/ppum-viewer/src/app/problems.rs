//! The text of the problem that is written: where it comes from, what it makes place for, and the
//! file that it gets.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Ui;
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::files::examples::{self, Example};
use crate::files::read::Why;
use crate::files::{SavedFile, name};
use crate::session::{DrawerPage, ProblemDraft};

impl Viewer {
    pub(super) fn save_problem(&mut self) {
        if let Some(draft) = self.session.draft.clone() {
            self.save_text(draft);
        }
    }

    /// Writes a text into its file, or asks for the name of one.
    pub(super) fn save_text(&mut self, draft: ProblemDraft) {
        match draft.path.clone() {
            Some(path) => self.files.save(path, SavedFile::Problem(draft), &self.session),
            None => self.ask(SavedFile::Problem(draft)),
        }
    }

    /// Solves the problem of the text, or an example in its place; what the active view shows makes
    /// place for the solution.
    pub(super) fn solve(&mut self, example: Option<usize>) {
        if let Some(example) = example.and_then(|k| examples::ALL.get(k))
            && !self.take_example(example)
        {
            return;
        }
        self.session.drawer = Some(DrawerPage::Problem);
        if let Some(draft) = &self.session.draft {
            self.solving.solve(draft, self.session.active);
        }
    }

    /// Takes the text of an example, with the files that it names in a folder; tells it if these
    /// cannot be put there.
    fn take_example(&mut self, example: &Example) -> bool {
        let own = self.files.folder().map_or_else(std::env::temp_dir, Path::to_owned);
        match example.folder(&own) {
            Ok(folder) => {
                let text = ProblemDraft::unchanged(example.text.to_owned());
                self.begin_text(ProblemDraft { folder, ..text }, None);
                true
            }
            Err(error) => {
                self.files.tell(&own, format!("the example cannot be put there: {error}"), true);
                false
            }
        }
    }

    /// A text is written from now on; if the one before was changed, it is put aside.
    fn begin_text(&mut self, draft: ProblemDraft, origin: Option<Arc<Dataset>>) {
        self.shelve();
        self.files.release(&draft);
        self.solving.begin(origin);
        self.session.draft = Some(draft);
        self.session.drawer = Some(DrawerPage::Problem);
    }

    /// Takes the text away; a changed one is put aside.
    pub(super) fn shelve(&mut self) {
        if let Some(draft) = self.session.draft.take() {
            self.files.put_aside(draft);
        }
    }

    /// Takes a text that was put aside, by its number.
    pub(super) fn take_text(&mut self, number: usize) {
        let Some(draft) = self.files.texts().get(number).cloned() else { return };
        self.files.release(&draft);
        // its file may have changed since
        if let Some(path) = &draft.path {
            self.files.open(path, 0, Why::Restored);
        }
        self.begin_text(draft, None);
    }

    /// Shows the text of the problem that a view shows the solution of.
    pub(super) fn show_text_of(&mut self, pane: usize) {
        let Some(dataset) = self.opened(pane).map(|opened| Arc::clone(&opened.dataset)) else {
            return;
        };
        if let Some(text) = dataset.problem.clone() {
            self.begin_text(ProblemDraft::unchanged(text), Some(dataset));
        }
    }

    /// Shows the text of what the active view shows, unless the text was changed, is being solved,
    /// or was opened since and not solved yet.
    pub(super) fn follow_dataset(&mut self) {
        let Some(opened) = self.opened(self.session.active) else { return };
        let (shown, dataset) = (opened.problem(), Arc::clone(&opened.dataset));
        let is_free = |draft: &ProblemDraft| {
            self.solving.gives_way && !draft.is_changed() && self.solving.running().is_none()
        };
        let draft = self.session.draft.as_ref();
        if draft.is_some_and(|draft| !is_free(draft)) {
            return;
        }
        let is_same =
            |shown: &ProblemDraft| draft.is_some_and(|draft| draft.is_same_problem(shown));
        match shown {
            Some(shown) if is_same(&shown) => self.solving.origin = Some(dataset),
            Some(shown) => self.begin_text_of(shown, dataset),
            None => self.session.draft = None,
        }
    }

    /// Shows the text that a dataset was solved from, with its file.
    fn begin_text_of(&mut self, draft: ProblemDraft, dataset: Arc<Dataset>) {
        // the file may have changed since
        if let Some(path) = &draft.path {
            self.files.open(path, 0, Why::Restored);
        }
        self.begin_text(draft, Some(dataset));
    }

    /// The text of a problem is in a file now: that which is written, or one that was put aside.
    pub(super) fn note_problem_file(&mut self, written: &ProblemDraft, path: &Path) {
        for opened in self.viewports.iter_mut().filter_map(|viewport| viewport.opened.as_mut()) {
            opened.note_problem_file(written, path);
        }
        let was_aside = self.files.texts().contains(written);
        self.files.release(written);
        let Some(draft) = &mut self.session.draft else { return };
        if !was_aside && draft.is_same_problem(written) {
            (draft.path, draft.folder) = (Some(path.to_owned()), None);
        }
        if draft.path.as_deref() == Some(path) {
            draft.original = Some(written.text.clone());
        }
    }

    /// Begins the text of a new problem.
    pub(super) fn begin_problem(&mut self) {
        self.begin_text(ProblemDraft::unchanged(ppum_problem::TEMPLATE.to_owned()), None);
    }

    /// Shows the import of a drawing; once it is confirmed, begins the text of its problem, which
    /// no file has yet. Saved, it goes into the folder of the drawing.
    pub(super) fn import(&mut self, ui: &Ui) {
        let Some(dialog) = &mut self.importing else { return };
        let Some(done) = dialog.show(ui) else { return };
        let path = dialog.drawing().path.clone();
        self.importing = None;
        let Some(text) = done else { return };
        let folder = path.parent().map(Path::to_owned);
        self.begin_text(ProblemDraft { folder, text, ..ProblemDraft::default() }, None);
        let text = "The drawing is a problem now: add material and loads, then solve it";
        self.files.tell(&path, text, false);
    }

    /// The text of a problem that was opened, or has changed on disk.
    pub(super) fn take_problem(&mut self, path: PathBuf, text: String, why: Why) {
        if why == Why::Opened {
            let draft = ProblemDraft { path: Some(path), ..ProblemDraft::unchanged(text) };
            return self.begin_text(draft, None);
        }
        let Some(draft) = &mut self.session.draft else { return };
        let is_changed = draft.is_changed();
        let before = draft.original.replace(text.clone());
        if !is_changed {
            draft.text = text;
        } else if before.is_some_and(|before| before != text) && draft.text != text {
            let name = name(&path);
            let text = format!(
                "{name} has changed, and so has the text here: save this one over it, or open it again"
            );
            self.files.tell(&path, text, true);
        }
    }
}
