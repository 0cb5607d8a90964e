//! A field for the name of a file, with what is in its folder; and the dialog of the system, where
//! there is one.

use std::env;
use std::fs;
use std::path::{MAIN_SEPARATOR, MAIN_SEPARATOR_STR, Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Align2, Key, Modifiers, TextEdit, Ui, Window};
use ppum::dataset::Dataset;

use super::drawing::DRAWINGS;
use super::session_file;
use crate::job::BackgroundJob;
use crate::page::PageOrder;
use crate::query::BackgroundQuery;
use crate::save_target::{SaveTarget, has_extension};
use crate::session::ProblemDraft;
use crate::widgets::chooser::RowList;
use crate::widgets::note_folder;

/// The contents of a file that is saved.
#[derive(Clone, Debug)]
pub enum SavedFile {
    /// A dataset.
    Dataset(Arc<Dataset>),
    /// The session.
    Session,
    /// The text of a problem.
    Problem(ProblemDraft),
    /// A page.
    Page(Arc<PageOrder>),
}

/// The purpose of a file. The content to be written is held: whatever is shown when the name is
/// given, this is what gets the name.
#[derive(Clone, Debug)]
pub enum Purpose {
    /// To open it in a pane.
    Open(usize),
    /// To make a problem of a drawing; what is shown in a pane stays.
    Import(usize),
    /// To write something.
    Save(SavedFile),
}

impl Purpose {
    /// The heading, and the ends of the names of files that fit, the usual one first.
    fn words(&self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Open(0) => ("Open a file", OPENED),
            Self::Open(_) => ("Open a file on the right", OPENED),
            Self::Import(_) => ("Import a drawing", DRAWINGS),
            Self::Save(SavedFile::Session) => ("Save the session", &[session_file::EXTENSION]),
            Self::Save(SavedFile::Dataset(_)) => ("Save the dataset", &["h5"]),
            Self::Save(SavedFile::Problem(_)) => ("Save the problem", &["toml"]),
            Self::Save(SavedFile::Page(_)) => ("Export a page for browsers", &["html"]),
        }
    }

    fn is_open(&self) -> bool {
        matches!(self, Self::Open(_) | Self::Import(_))
    }
}

const OPENED: &[&str] =
    &["h5", "toml", session_file::EXTENSION, "hdf5", "dxf", "svg", "msh", "geo"];

/// The field while it is open.
#[derive(Debug)]
pub struct Dialog {
    purpose: Purpose,
    /// The folder of names without one.
    folder: PathBuf,
    target: SaveTarget,
    chosen: Option<usize>,
    listed: BackgroundQuery<PathBuf, Vec<FolderEntry>>,
    /// The dialog of the system, and when it was opened.
    system: Option<(Instant, BackgroundJob<Option<PathBuf>>)>,
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
        let folder = if start.is_dir() { Some(start) } else { start.parent() };
        let folder = folder.unwrap_or(Path::new("")).to_owned();
        let (target, listed) = (SaveTarget::new(text), BackgroundQuery::default());
        Self { purpose, folder, target, chosen: None, listed, system: None }
    }

    /// Returns the purpose of the file.
    pub(crate) fn purpose(&self) -> &Purpose {
        &self.purpose
    }

    /// Shows it: `Some(None)` once it is closed, with a file if one was chosen.
    pub fn show(&mut self, ui: &Ui) -> Option<Option<PathBuf>> {
        self.poll(ui);
        let mut is_open = true;
        let mut done = None;
        let window = Window::new(self.purpose.words().0).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
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
        let count = self.fitting().len();
        self.walk(count, down, up);
        let label = ui.label("Name of the file, with its folder");
        let width = ui.available_width().clamp(200.0, 460.0);
        let edit = TextEdit::singleline(&mut self.target.name).desired_width(width).code_editor();
        let edit = ui.add(edit).labelled_by(label.id);
        edit.request_focus();
        if edit.changed() {
            self.chosen = None;
            self.target.forget();
        }
        if !self.purpose.is_open() && !self.target.name.trim().is_empty() {
            note_folder(ui, &self.path());
        }
        // what is written now decides, not what stood there before
        let fitting = self.fitting();
        let row = |ui: &mut Ui, (name, is_folder): &FolderEntry, is_chosen: bool| {
            let end = if *is_folder { MAIN_SEPARATOR_STR } else { "" };
            ui.selectable_label(is_chosen, format!("{name}{end}"))
        };
        let list = RowList { name: "folder", height: 220.0, at: self.chosen, is_followed: true };
        let mut taken = list.show(ui, fitting.iter(), row).cloned();
        if tab || (enter && self.chosen.is_some()) {
            taken = taken.or_else(|| fitting.get(self.chosen.unwrap_or(0)).cloned());
        }
        let is_named = enter && self.chosen.is_none();
        let is_completed = tab && taken.is_some();
        let mut done = taken.and_then(|entry| self.take(ui, entry, !tab));
        if is_completed && let Some(mut state) = TextEditState::load(ui.ctx(), edit.id) {
            let end = CCursor::new(self.target.name.chars().count());
            state.cursor.set_char_range(Some(CCursorRange::one(end)));
            state.store(ui.ctx(), edit.id);
        }
        self.target.show_result(ui);
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

    /// True if the button is pressed.
    fn buttons(&mut self, ui: &mut Ui) -> bool {
        ui.horizontal(|ui| {
            if ui.button("Browse…").on_hover_text("The dialog of the system").clicked() {
                self.browse(ui);
            }
            let word = match self.purpose.is_open() {
                _ if self.target.is_asking() => "Replace it",
                true => "Open",
                false => "Save",
            };
            ui.button(word).clicked()
        })
        .inner
    }

    /// Goes into a folder, or completes a name; a file that was meant is done with.
    fn take(&mut self, ui: &Ui, (name, is_folder): FolderEntry, is_meant: bool) -> Option<PathBuf> {
        let path = self.shown_folder().join(&name);
        self.target.name = path.display().to_string();
        self.chosen = None;
        if is_folder {
            self.target.name.push(MAIN_SEPARATOR);
        }
        ui.ctx().request_repaint();
        (is_meant && !is_folder).then(|| self.confirm(&path)).flatten()
    }

    fn path(&self) -> PathBuf {
        let path = self.folder.join(home(self.target.name.trim()));
        let has_end = path.extension().is_some() || self.purpose.is_open();
        match self.purpose.words().1.first() {
            Some(end) if !has_end => path.with_extension(end),
            _ => path,
        }
    }

    /// The file, if it fits; else the reason why not stands below the field.
    fn confirm(&mut self, path: &Path) -> Option<PathBuf> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let error = match self.purpose.is_open() {
            _ if path.is_dir() => Some("this is a folder: choose a file in it".to_owned()),
            true => (!path.exists()).then(|| "there is no such file".to_owned()),
            false => self.target.refuses(&path, self.purpose.words().1, None).or_else(|| {
                ppum_file::check(&path).err().map(|e| format!("it cannot be written: {e}"))
            }),
        };
        self.target.result = error.clone().map(Err);
        error.is_none().then_some(path)
    }

    /// Returns the entries of the folder that begin with the text; files only if they fit.
    fn fitting(&mut self) -> Vec<FolderEntry> {
        let text = &self.target.name;
        let name = Path::new(text).file_name().filter(|_| !text.ends_with(MAIN_SEPARATOR));
        let name = name.and_then(|name| name.to_str()).unwrap_or_default().to_lowercase();
        let here = self.shown_folder();
        let known = self.listed.newest().filter(|(listed, _)| *listed == here);
        let Some(Ok(entries)) = known.map(|(_, entries)| &**entries) else { return Vec::new() };
        let is_fit = |(entry, is_folder): &&FolderEntry| {
            let fits = *is_folder || has_extension(Path::new(entry), self.purpose.words().1);
            let is_shown = !entry.starts_with('.') || name.starts_with('.');
            fits && is_shown && entry.to_lowercase().starts_with(&name)
        };
        entries.iter().filter(is_fit).take(MOST).cloned().collect()
    }

    /// The folder that the text leads to.
    fn shown_folder(&self) -> PathBuf {
        let path = home(&self.target.name);
        let folder = match self.target.name.ends_with(['/', MAIN_SEPARATOR]) {
            true => Some(&*path),
            false => path.parent(),
        };
        let folder = self.folder.join(folder.unwrap_or(Path::new("")));
        if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder }
    }

    /// Takes what was listed and chosen, and lists the folder of the text.
    fn poll(&mut self, ui: &Ui) {
        let here = self.shown_folder();
        let folder = here.clone();
        self.listed.ask(&here, false, ui.ctx(), move |_| Some(Ok(entries(&folder))));
        if let Some((since, job)) = &self.system
            && let Some(outcome) = job.poll()
        {
            let since = *since;
            self.system = None;
            match outcome {
                Ok(Some(path)) => self.target.name = path.display().to_string(),
                // nobody cancels a dialog so soon
                _ if since.elapsed() < QUICK => {
                    self.target.result = Some(Err(NO_DIALOG.into()));
                }
                _ => {}
            }
        }
    }

    /// Opens the dialog of the system, which the window does not wait for.
    fn browse(&mut self, ui: &Ui) {
        if self.system.is_some() {
            return;
        }
        let ((title, ends), is_open) = (self.purpose.words(), self.purpose.is_open());
        let folder = self.shown_folder();
        let job = BackgroundJob::start(ui.ctx(), move |_| {
            let dialog = rfd::FileDialog::new().set_title(title).set_directory(folder);
            let dialog = dialog.add_filter(ends.join(", "), ends);
            if is_open { dialog.pick_file() } else { dialog.save_file() }
        });
        self.system = Some((Instant::now(), job));
    }
}

const NO_DIALOG: &str = "the system has no dialog for files; write the name here";
/// A dialog that closes within this time was never open.
const QUICK: Duration = Duration::from_millis(500);

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
