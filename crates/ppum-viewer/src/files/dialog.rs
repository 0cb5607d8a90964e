//! A field for the name of a file, with what is in its folder; and the dialog of the system, where
//! there is one.

use std::env;
use std::fs;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::Arc;

use egui::{Align2, Key, Modifiers, ScrollArea, TextEdit, Ui, Window};
use ppum::dataset::Dataset;

use super::read::has_extension;
use super::session_file;
use crate::job::BackgroundJob;
use crate::replaced_file::{self, ReplacedFile};
use crate::session::ProblemDraft;
use crate::widgets::note_folder;

/// The purpose of a file. The content to be written is held: whatever is shown when the name is
/// given, this is what gets the name.
#[derive(Clone, Debug)]
pub enum Purpose {
    /// To open it in a pane.
    Open(usize),
    /// To write the session.
    SaveSession,
    /// To write a dataset.
    SaveDataset(Arc<Dataset>),
    /// To write the text of a problem.
    SaveProblem(ProblemDraft),
    /// To write a page.
    ExportPage,
}

impl Purpose {
    /// The heading.
    #[must_use]
    pub fn title(&self) -> &'static str {
        match self {
            Self::Open(0) => "Open a file",
            Self::Open(_) => "Open a file on the right",
            Self::SaveSession => "Save the session",
            Self::SaveDataset(_) => "Save the dataset",
            Self::SaveProblem(_) => "Save the problem",
            Self::ExportPage => "Export a page for browsers",
        }
    }

    /// The ends of the names of files that fit, the usual one first.
    #[must_use]
    pub fn extensions(&self) -> &'static [&'static str] {
        match self {
            Self::Open(_) => &["h5", "toml", session_file::EXTENSION, "hdf5"],
            Self::SaveSession => &[session_file::EXTENSION],
            Self::SaveDataset(_) => &["h5"],
            Self::SaveProblem(_) => &["toml"],
            Self::ExportPage => &["html"],
        }
    }

    fn is_open(&self) -> bool {
        matches!(self, Self::Open(_))
    }
}

/// The field while it is open.
#[derive(Debug)]
pub struct Dialog {
    purpose: Purpose,
    /// The folder of names without one.
    folder: PathBuf,
    text: String,
    chosen: Option<usize>,
    listed: Option<(PathBuf, Vec<FolderEntry>)>,
    listing: Option<(PathBuf, BackgroundJob<Vec<FolderEntry>>)>,
    system: Option<BackgroundJob<Option<PathBuf>>>,
    error: Option<String>,
    replacing: ReplacedFile,
}

/// Something in a folder: its name, and whether it is a folder too.
type FolderEntry = (String, bool);

/// Entries that are shown; who looks for others writes more of the name.
const MOST: usize = 200;

impl Dialog {
    /// A field that begins in a folder, or with a name.
    #[must_use]
    pub fn new(purpose: Purpose, start: &Path) -> Self {
        let mut text = start.display().to_string();
        if start.is_dir() && !text.ends_with(MAIN_SEPARATOR) {
            text.push(MAIN_SEPARATOR);
        }
        let (listed, listing, system, error) = (None, None, None, None);
        let replacing = ReplacedFile::default();
        let folder = if start.is_dir() { Some(start) } else { start.parent() };
        let folder = folder.unwrap_or(Path::new("")).to_owned();
        Self { purpose, folder, text, chosen: None, listed, listing, system, error, replacing }
    }

    /// Returns the purpose of the file.
    #[must_use]
    pub fn purpose(&self) -> &Purpose {
        &self.purpose
    }

    /// Shows it: `Some(None)` once it is closed, with a file if one was chosen.
    pub fn show(&mut self, ui: &Ui) -> Option<Option<PathBuf>> {
        self.poll(ui);
        let mut is_open = true;
        let mut done = None;
        let window = Window::new(self.purpose.title()).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
        let window = window.open(&mut is_open).collapsible(false).resizable(false);
        window.show(ui.ctx(), |ui| done = self.fields(ui));
        let escape = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        if done.is_none() && (escape || !is_open) {
            return Some(None);
        }
        done.map(Some)
    }

    fn fields(&mut self, ui: &mut Ui) -> Option<PathBuf> {
        let keys = [Key::Tab, Key::ArrowDown, Key::ArrowUp];
        let [tab, down, up] = ui.input_mut(|i| keys.map(|key| i.consume_key(Modifiers::NONE, key)));
        let enter = ui.input(|i| i.key_pressed(Key::Enter));
        let fitting = self.fitting();
        self.walk(fitting.len(), down, up);
        let label = ui.label("Name of the file, with its folder");
        let width = ui.available_width().clamp(200.0, 460.0);
        let edit = ui.add(TextEdit::singleline(&mut self.text).desired_width(width).code_editor());
        let edit = edit.labelled_by(label.id);
        edit.request_focus();
        if edit.changed() {
            (self.chosen, self.error) = (None, None);
            self.replacing.forget();
        }
        if !self.purpose.is_open() && !self.text.trim().is_empty() {
            note_folder(ui, &self.path());
        }
        // what is written now decides, not what stood there before
        let fitting = self.fitting();
        let mut taken = self.list(ui, &fitting);
        if tab || (enter && self.chosen.is_some()) {
            taken = taken.or_else(|| fitting.get(self.chosen.unwrap_or(0)).cloned());
        }
        let is_named = enter && self.chosen.is_none();
        let mut done = taken.and_then(|entry| self.take(ui, entry, !tab));
        if let Some(error) = &self.error {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
        if (self.buttons(ui) || is_named) && done.is_none() {
            done = self.confirm(&self.path());
        }
        done
    }

    /// The way of the marked entry.
    fn walk(&mut self, count: usize, down: bool, up: bool) {
        self.chosen = match self.chosen {
            None if down && count > 0 => Some(0),
            Some(k) if down => Some((k + 1).min(count.saturating_sub(1))),
            Some(k) if up => k.checked_sub(1),
            chosen => chosen.filter(|k| *k < count),
        };
    }

    fn list(&self, ui: &mut Ui, fitting: &[FolderEntry]) -> Option<FolderEntry> {
        let mut taken = None;
        ScrollArea::vertical().max_height(220.0).auto_shrink([false, true]).show(ui, |ui| {
            for (k, entry) in fitting.iter().enumerate() {
                let is_chosen = self.chosen == Some(k);
                let name =
                    if entry.1 { format!("{}{MAIN_SEPARATOR}", entry.0) } else { entry.0.clone() };
                let button = ui.selectable_label(is_chosen, name);
                if is_chosen {
                    button.scroll_to_me(None);
                }
                if button.clicked() {
                    taken = Some(entry.clone());
                }
            }
        });
        taken
    }

    /// True if the button is pressed.
    fn buttons(&mut self, ui: &mut Ui) -> bool {
        ui.horizontal(|ui| {
            if ui.button("Browse…").on_hover_text("The dialog of the system").clicked() {
                self.browse(ui);
            }
            let word = match (self.error.as_deref(), self.purpose.is_open()) {
                (Some(replaced_file::ASK), _) => "Replace it",
                (_, true) => "Open",
                (_, false) => "Save",
            };
            ui.button(word).clicked()
        })
        .inner
    }

    /// Goes into a folder, or completes a name; a file that was meant is done with.
    fn take(&mut self, ui: &Ui, (name, is_folder): FolderEntry, is_meant: bool) -> Option<PathBuf> {
        let path = self.shown_folder().join(&name);
        self.text = path.display().to_string();
        self.chosen = None;
        if is_folder {
            self.text.push(MAIN_SEPARATOR);
        }
        ui.ctx().request_repaint();
        (is_meant && !is_folder).then(|| self.confirm(&path)).flatten()
    }

    fn path(&self) -> PathBuf {
        let path = self.folder.join(home(self.text.trim()));
        let has_end = path.extension().is_some() || self.purpose.is_open();
        match self.purpose.extensions().first() {
            Some(end) if !has_end => path.with_extension(end),
            _ => path,
        }
    }

    /// The file, if it fits; else the reason why not stands below the field.
    fn confirm(&mut self, path: &Path) -> Option<PathBuf> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let [is_dir, is_there] = [path.is_dir(), path.exists()];
        let ends = self.purpose.extensions();
        let error = match self.purpose.is_open() {
            _ if is_dir => Some("this is a folder: choose a file in it".to_owned()),
            true => (!is_there).then(|| "there is no such file".to_owned()),
            false if !has_extension(&path, ends) => {
                Some(format!("the name of this file ends with .{}", ends.join(" or .")))
            }
            false if !self.replacing.allows(&path) => Some(replaced_file::ASK.to_owned()),
            false => ppum_file::check(&path).err().map(|e| format!("it cannot be written: {e}")),
        };
        self.error = error;
        self.error.is_none().then_some(path)
    }

    /// Returns the entries of the folder that begin with the text; files only if they fit.
    fn fitting(&self) -> Vec<FolderEntry> {
        let name =
            Path::new(&self.text).file_name().filter(|_| !self.text.ends_with(MAIN_SEPARATOR));
        let name = name.and_then(|name| name.to_str()).unwrap_or_default().to_lowercase();
        let here = self.shown_folder();
        let Some((_, entries)) = self.listed.as_ref().filter(|(listed, _)| *listed == here) else {
            return Vec::new();
        };
        let is_fit = |(entry, is_folder): &&FolderEntry| {
            let fits = *is_folder || has_extension(Path::new(entry), self.purpose.extensions());
            let is_shown = !entry.starts_with('.') || name.starts_with('.');
            fits && is_shown && entry.to_lowercase().starts_with(&name)
        };
        entries.iter().filter(is_fit).take(MOST).cloned().collect()
    }

    /// The folder that the text leads to.
    fn shown_folder(&self) -> PathBuf {
        let path = home(&self.text);
        let folder = match self.text.ends_with(['/', MAIN_SEPARATOR]) {
            true => Some(&*path),
            false => path.parent(),
        };
        let folder = self.folder.join(folder.unwrap_or(Path::new("")));
        if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
    }

    /// Takes what was listed and chosen, and lists the folder of the text.
    fn poll(&mut self, ui: &Ui) {
        if let Some((folder, job)) = &self.listing
            && let Some(entries) = job.poll()
        {
            self.listed = Some((folder.clone(), entries.unwrap_or_default()));
            self.listing = None;
        }
        let here = self.shown_folder();
        if self.listing.is_none() && self.listed.as_ref().is_none_or(|(listed, _)| *listed != here)
        {
            let folder = here.clone();
            self.listing = Some((here, BackgroundJob::start(ui.ctx(), move |_| entries(&folder))));
        }
        if let Some(outcome) = self.system.as_ref().and_then(BackgroundJob::poll) {
            self.system = None;
            match outcome {
                Ok(Some(path)) => self.text = path.display().to_string(),
                _ => self.error = Some("nothing was chosen; a name can be written here".into()),
            }
        }
    }

    /// Opens the dialog of the system, which the window does not wait for.
    fn browse(&mut self, ui: &Ui) {
        if self.system.is_some() {
            return;
        }
        let (title, is_open) = (self.purpose.title(), self.purpose.is_open());
        let (ends, folder) = (self.purpose.extensions(), self.shown_folder());
        self.system = Some(BackgroundJob::start(ui.ctx(), move |_| {
            let dialog = rfd::FileDialog::new().set_title(title).set_directory(folder);
            let dialog = dialog.add_filter(ends.join(", "), ends);
            if is_open { dialog.pick_file() } else { dialog.save_file() }
        }));
    }
}

/// `~` is the folder of the person, as shells have it.
fn home(text: &str) -> PathBuf {
    match (text.strip_prefix("~/"), env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(text),
    }
}

/// Returns the entries of a folder, folders first.
fn entries(folder: &Path) -> Vec<FolderEntry> {
    let entry = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().ok()?;
        Some((name, entry.path().is_dir()))
    };
    let read = fs::read_dir(folder).into_iter().flatten();
    let mut entries: Vec<FolderEntry> = read.filter_map(|e| entry(e.ok()?)).collect();
    entries.sort_by_key(|(name, is_folder)| (!is_folder, name.to_lowercase()));
    entries
}
