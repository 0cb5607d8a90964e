//! Files: read and written in the background, watched while they are open, remembered.

pub mod dialog;
pub mod examples;
pub mod kept;
pub mod read;
pub mod session_file;
pub mod watch;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Ui;
use ppum::dataset::Dataset;

use crate::job::Job;
use crate::session::Session;
use dialog::{Dialog, Purpose};
use kept::Kept;
use read::{Arrived, Reading, Why};
use watch::{Stamp, Watch};

/// Something that is told about a file until it is closed or no longer true.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The file.
    pub path: PathBuf,
    /// What is told.
    pub text: String,
    /// True if something could not be done.
    pub is_error: bool,
}

/// The files of a window.
#[derive(Debug)]
pub struct Files {
    /// What is told of files, the newest last.
    pub notes: Vec<Note>,
    /// What is remembered.
    pub kept: Kept,
    /// The file of the session, once it has one.
    pub session: Option<PathBuf>,
    folder: Option<PathBuf>,
    readings: Vec<Reading>,
    writings: Vec<Writing>,
    dialog: Option<Dialog>,
    watch: Watch,
    ctx: egui::Context,
}

/// A file that is being written.
#[derive(Debug)]
struct Writing {
    path: PathBuf,
    what: What,
    job: Job<Result<Stamp, String>>,
}

/// What is written to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The dataset of a pane.
    Dataset(usize),
    /// The session.
    Session,
    /// The problem's text.
    Problem,
    /// Something that was made.
    Export,
}

/// A file that was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// The file.
    pub path: PathBuf,
    /// What is in it.
    pub what: What,
}

impl Files {
    /// Files of a window that remembers in a folder, if it has one.
    #[must_use]
    pub fn new(ctx: &egui::Context, folder: Option<PathBuf>) -> Self {
        let kept = folder.as_deref().map(Kept::read).unwrap_or_default();
        Self {
            notes: Vec::new(),
            kept,
            session: None,
            folder,
            readings: Vec::new(),
            writings: Vec::new(),
            dialog: None,
            watch: Watch::new(ctx),
            ctx: ctx.clone(),
        }
    }

    /// Begins to read a file for a pane.
    pub fn open(&mut self, path: &Path, pane: usize, why: Why) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.readings.retain(|reading| reading.pane != pane || reading.path != path);
        self.readings.push(Reading::new(&self.ctx, path, pane, why));
    }

    /// What was read since.
    pub fn arrived(&mut self) -> Vec<Arrived> {
        let mut arrived = Vec::new();
        self.readings.retain(|reading| match reading.poll() {
            Some(news) => {
                arrived.push(news);
                false
            }
            None => true,
        });
        arrived
    }

    /// The files that are being read.
    #[must_use]
    pub fn readings(&self) -> &[Reading] {
        &self.readings
    }

    /// No longer wants a file that is being read.
    pub fn cancel(&mut self, path: &Path) {
        self.readings.retain(|reading| reading.path != path);
    }

    /// True while files are read or written.
    #[must_use]
    pub fn is_working(&self) -> bool {
        !self.readings.is_empty() || !self.writings.is_empty()
    }

    /// Puts a file in front of the recent ones, and keeps that.
    pub fn remember(&mut self, path: &Path) {
        self.kept.note(path);
        self.keep();
    }

    /// Keeps what is remembered. A disk that is full, or a folder that is not to be written, is no reason to disturb anybody.
    pub fn keep(&mut self) {
        let Some(folder) = self.folder.clone() else { return };
        let kept = self.kept.clone();
        // on this thread: two small files in one step each, in the order in which they were meant
        let _ = kept.write(&folder);
    }

    /// Keeps the session for the next time.
    pub fn keep_session(&self, session: &Session) {
        if let Some(folder) = &self.folder {
            let _ = kept::keep_session(session, folder);
        }
    }

    /// The folder of what is remembered.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Tells something about a file in place of what was told of it before.
    pub fn tell(&mut self, path: &Path, text: impl Into<String>, is_error: bool) {
        self.settle(path);
        self.notes.push(Note { path: path.to_owned(), text: text.into(), is_error });
    }

    /// Nothing is to be told about a file any more.
    pub fn settle(&mut self, path: &Path) {
        self.notes.retain(|note| note.path != path);
    }

    /// Follows a file that was read when it had this stamp.
    pub fn follow(&self, path: &Path, stamp: Stamp) {
        self.watch.follow(path, stamp);
    }

    /// The files that have changed since, of those that are still open.
    #[must_use]
    pub fn changed(&self, is_open: impl Fn(&Path) -> bool) -> Vec<PathBuf> {
        self.watch.keep(is_open);
        self.watch.changed()
    }

    /// Asks for the name of a file, beginning near another one.
    pub fn ask(&mut self, purpose: Purpose, near: Option<&Path>) {
        let recent = self.kept.recent.first();
        let folder = near.or(recent.map(PathBuf::as_path)).and_then(Path::parent);
        let here = std::env::current_dir().unwrap_or_default();
        let folder = folder.filter(|folder| folder.is_dir()).unwrap_or(&here);
        let start = match (&purpose, near) {
            (Purpose::Open(_), _) | (_, None) => folder.to_owned(),
            (_, Some(near)) => near.to_owned(),
        };
        self.dialog = Some(Dialog::new(purpose, &start));
    }

    /// Shows the field for a name while it is open; what it is for and the file, once one is chosen.
    pub fn show(&mut self, ui: &Ui) -> Option<(Purpose, PathBuf)> {
        let dialog = self.dialog.as_mut()?;
        let done = dialog.show(ui)?;
        let purpose = dialog.purpose().clone();
        self.dialog = None;
        Some((purpose, done?))
    }

    /// Writes something in the background.
    pub fn write(
        &mut self,
        path: PathBuf,
        what: What,
        write: impl FnOnce(&Path) -> Result<(), String> + Send + 'static,
    ) {
        let target = path.clone();
        let job = Job::start(&self.ctx, move |_| {
            write(&target)?;
            Ok(watch::stamp(&target))
        });
        self.writings.push(Writing { path, what, job });
    }

    /// Writes a text in the background.
    pub fn write_text(&mut self, path: PathBuf, what: What, text: String) {
        self.write(path, what, move |path| kept::replace(path, &text).map_err(|e| e.to_string()));
    }

    /// Writes bytes in the background.
    pub fn write_bytes(&mut self, path: PathBuf, bytes: Arc<[u8]>) {
        self.write(path, What::Export, move |path| {
            let written: std::io::Result<()> =
                ppum_file::replace(path, |out| out.write_all(&bytes));
            written.map_err(|error| error.to_string())
        });
    }

    /// Writes a dataset in the background.
    pub fn write_dataset(&mut self, path: PathBuf, pane: usize, dataset: Arc<Dataset>) {
        self.write(path, What::Dataset(pane), move |path| {
            ppum_format::write(&dataset, path).map_err(|error| error.to_string())
        });
    }

    /// What was written since; what could not be written is told.
    pub fn written(&mut self) -> Vec<Written> {
        let mut done = Vec::new();
        self.writings.retain(|writing| match writing.job.poll() {
            Some(outcome) => {
                done.push((writing.path.clone(), writing.what, outcome.flatten()));
                false
            }
            None => true,
        });
        let mut written = Vec::new();
        for (path, what, outcome) in done {
            match outcome {
                Ok(stamp) => {
                    // what the window itself has written is no news to it
                    self.follow(&path, stamp);
                    self.tell(&path, format!("{} is written", name(&path)), false);
                    written.push(Written { path, what });
                }
                Err(error) => {
                    self.tell(&path, format!("{} cannot be written: {error}", name(&path)), true);
                }
            }
        }
        written
    }

    /// Waits until everything is written: the window is about to close.
    pub fn finish(&mut self) {
        while !self.writings.is_empty() {
            self.written();
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    }
}

/// The name of a file without its folder.
#[must_use]
pub fn name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display(), |name| Path::new(name).display()).to_string()
}
