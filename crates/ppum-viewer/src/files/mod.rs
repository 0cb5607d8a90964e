//! Files: read and written in the background, watched while they are open, remembered.

pub mod dialog;
pub mod drawing;
pub mod examples;
pub mod read;
pub mod session_file;
mod texts;
pub mod watch;
pub mod window_state;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::Ui;

use crate::job::BackgroundJob;
use crate::save_target::replace;
use crate::session::{ProblemDraft, Session};
pub use dialog::SavedFile;
use dialog::{Dialog, Purpose};
use read::{FileRead, ReadFile, Why};
use texts::StoredTexts;
use watch::{Stamp, Watch};
use window_state::WindowState;

/// Something that is told about a file until it is closed or no longer true.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The file.
    pub path: PathBuf,
    /// The text of the note.
    pub text: String,
    /// True if something could not be done.
    pub is_error: bool,
    /// The time when it was told.
    pub since: Instant,
}

/// The files of a window.
#[derive(Debug)]
pub struct WindowFiles {
    /// The notes about files, the newest last.
    pub notes: Vec<Note>,
    /// The stored state.
    pub kept: WindowState,
    /// The previews of the examples.
    pub previews: examples::Previews,
    /// The file of the session, once it has one.
    pub session: Option<PathBuf>,
    /// Changed texts that have made place for others.
    texts: StoredTexts,
    folder: Option<PathBuf>,
    readings: Vec<FileRead>,
    writings: Vec<FileWrite>,
    /// The stored state, on its way to its file; true if all of it is on the way.
    keeping: Option<BackgroundJob<std::io::Result<()>>>,
    is_kept: bool,
    /// True once it was told that nothing can be kept: once is enough.
    is_forgetful: bool,
    /// The session that was kept last, and when.
    last: Option<Session>,
    since: Instant,
    dialog: Option<Dialog>,
    watch: Watch,
    ctx: egui::Context,
}

/// A file that is being written.
#[derive(Debug)]
struct FileWrite {
    path: PathBuf,
    what: SavedFile,
    job: BackgroundJob<Result<Stamp, String>>,
}

/// The least time between two writings of a session that changes.
const PAUSE: Duration = Duration::from_secs(5);

impl WindowFiles {
    /// Files of a window that remembers in a folder, if it has one.
    #[must_use]
    pub fn new(ctx: &egui::Context, folder: Option<PathBuf>) -> Self {
        let kept = folder.as_deref().map(WindowState::read).unwrap_or_default();
        let texts = folder.as_deref().map_or_else(|| Ok(StoredTexts::default()), StoredTexts::read);
        let mut files = Self {
            notes: Vec::new(),
            kept,
            texts: StoredTexts::default(),
            previews: examples::Previews::default(),
            session: None,
            folder,
            readings: Vec::new(),
            writings: Vec::new(),
            keeping: None,
            is_kept: true,
            is_forgetful: false,
            last: None,
            since: Instant::now(),
            dialog: None,
            watch: Watch::new(ctx),
            ctx: ctx.clone(),
        };
        match texts {
            Ok(texts) => files.texts = texts,
            Err(error) => files.tell(Path::new(""), error, true),
        }
        files
    }

    /// Changed texts that have made place for others, the newest last.
    #[must_use]
    pub fn texts(&self) -> &[ProblemDraft] {
        &self.texts.all
    }

    /// Keeps a text that makes place for another one, if it is changed.
    pub fn put_aside(&mut self, draft: ProblemDraft) {
        if draft.is_changed() && !self.texts.all.contains(&draft) {
            self.texts.all.push(draft);
            self.is_kept = false;
        }
    }

    /// No longer keeps a text: it is shown, saved or not wanted.
    pub fn release(&mut self, draft: &ProblemDraft) {
        let before = self.texts.all.len();
        self.texts.all.retain(|text| text != draft);
        self.is_kept &= self.texts.all.len() == before;
    }

    /// True if all that is remembered outlasts the window.
    pub(crate) fn can_keep(&self) -> bool {
        self.folder.is_some() && !self.is_forgetful
    }

    /// Begins to read a file for a pane.
    pub fn open(&mut self, path: &Path, pane: usize, why: Why) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.readings.retain(|reading| reading.pane != pane || reading.path != path);
        self.readings.push(FileRead::new(&self.ctx, path, pane, why));
    }

    /// Returns the files that were read since.
    pub fn arrived(&mut self) -> Vec<ReadFile> {
        let mut arrived = Vec::new();
        self.readings.retain(|reading| {
            let news = reading.poll();
            let is_running = news.is_none();
            arrived.extend(news);
            is_running
        });
        arrived
    }

    /// The files that are being read.
    pub(crate) fn readings(&self) -> &[FileRead] {
        &self.readings
    }

    /// No longer wants a file that is being read.
    pub fn cancel(&mut self, path: &Path) {
        self.readings.retain(|reading| reading.path != path);
    }

    /// True while files are read or written.
    #[must_use]
    pub fn is_working(&self) -> bool {
        let is_keeping = self.keeping.is_some() || (!self.is_kept && self.folder.is_some());
        !self.readings.is_empty() || !self.writings.is_empty() || is_keeping
    }

    /// Remembers nothing from now on: what is shown is for an image only.
    pub fn leave_no_trace(&mut self) {
        self.folder = None;
    }

    /// Puts a file in front of the recent ones, and keeps that.
    pub fn remember(&mut self, path: &Path) {
        self.kept.note(path);
        self.is_kept = false;
    }

    /// Keeps what is remembered, in the background and one writing after the other: recent files at
    /// once, the session a while after it has changed. A disk that is full is told once.
    pub fn keep(&mut self, session: &Session) {
        if let Some(outcome) = self.keeping.as_ref().and_then(BackgroundJob::poll) {
            self.keeping = None;
            let outcome = outcome.and_then(|kept| kept.map_err(|error| error.to_string()));
            self.tell_forgetful(outcome.err());
        }
        let is_same = self.is_kept && self.last.as_ref() == Some(session);
        if is_same || self.keeping.is_some() || self.folder.is_none() {
            return;
        }
        match PAUSE.checked_sub(self.since.elapsed()).filter(|_| self.is_kept) {
            Some(rest) => self.ctx.request_repaint_after(rest),
            None => self.keep_now(session),
        }
    }

    fn keep_now(&mut self, session: &Session) {
        let Some(folder) = self.folder.clone() else { return };
        (self.is_kept, self.last, self.since) = (true, Some(session.clone()), Instant::now());
        let (kept, session, texts) = (self.kept.clone(), session.clone(), self.texts.update());
        self.keeping = Some(BackgroundJob::start(&self.ctx, move |_| {
            kept.write(&folder)?;
            texts.write(&folder)?;
            window_state::keep_session(&session, &folder)
        }));
    }

    /// Tells that nothing can be kept, once; and no longer where it can be again.
    fn tell_forgetful(&mut self, error: Option<String>) {
        let Some(folder) = self.folder.clone() else { return };
        match error {
            Some(error) if !self.is_forgetful => {
                let folder_name = folder.display();
                let text = format!(
                    "recent files and what is open cannot be kept in {folder_name} for the next time: {error}"
                );
                self.tell(&folder, text, true);
                self.is_forgetful = true;
            }
            None if self.is_forgetful => {
                self.settle(&folder);
                self.is_forgetful = false;
            }
            _ => {}
        }
    }

    /// Waits until everything is written, and all that is remembered too: the window is about
    /// to close.
    pub fn finish(&mut self, session: &Session) {
        self.writings.drain(..).for_each(|writing| drop(writing.job.wait()));
        // what is being kept is older than what is kept then
        self.keeping.take().into_iter().for_each(|job| drop(job.wait()));
        self.keep_now(session);
        self.keeping.take().into_iter().for_each(|job| drop(job.wait()));
    }

    /// Begins to find what the examples are problems of.
    pub fn find_previews(&mut self) {
        self.previews.find(&self.ctx, self.folder.as_deref());
    }

    /// The folder of what is remembered.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Tells something about a file in place of what was told of it before.
    pub fn tell(&mut self, path: &Path, text: impl Into<String>, is_error: bool) {
        self.settle(path);
        let (path, since) = (path.to_owned(), Instant::now());
        self.notes.push(Note { path, text: text.into(), is_error, since });
    }

    /// Tells something that is wrong with a file beside what was told of it before.
    pub fn tell_too(&mut self, path: &Path, text: &str) {
        let before = self.notes.iter().find(|note| note.path == path && note.is_error);
        let text = match before {
            Some(before) => format!("{}\n{text}", before.text),
            None => text.to_owned(),
        };
        self.tell(path, text, true);
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
        let start = match (&purpose, near) {
            (Purpose::Open(_) | Purpose::Import(_), _) | (_, None) => self.folder_near(near),
            (_, Some(near)) => near.to_owned(),
        };
        self.dialog = Some(Dialog::new(purpose, &start));
    }

    /// The folder of a file, or of the last one that was opened; the one that the program was
    /// started in if that is gone.
    pub(crate) fn folder_near(&self, near: Option<&Path>) -> PathBuf {
        let recent = self.kept.recent.first().map(PathBuf::as_path);
        let folder = near.or(recent).and_then(Path::parent).filter(|folder| folder.is_dir());
        folder.map_or_else(|| std::env::current_dir().unwrap_or_default(), Path::to_owned)
    }

    /// True while a file is chosen or written.
    pub(crate) fn is_saving(&self) -> bool {
        self.dialog.is_some() || !self.writings.is_empty()
    }

    /// Shows the field for a name while it is open; what it is for and the file, once one
    /// is chosen.
    pub fn show(&mut self, ui: &Ui) -> Option<(Purpose, PathBuf)> {
        let dialog = self.dialog.as_mut()?;
        let done = dialog.show(ui)?;
        let purpose = dialog.purpose().clone();
        self.dialog = None;
        Some((purpose, done?))
    }

    /// Writes a file in the background; a session is that of now.
    pub fn save(&mut self, path: PathBuf, what: SavedFile, session: &Session) {
        let text = match &what {
            SavedFile::Session => {
                let folder = path.parent().unwrap_or(Path::new(""));
                session_file::text(session, folder).map_err(|error| error.to_string())
            }
            SavedFile::Problem(draft) => Ok(draft.text.clone()),
            SavedFile::Dataset(_) | SavedFile::Page(_) => Ok(String::new()),
        };
        let (target, content) = (path.clone(), what.clone());
        let job = BackgroundJob::start(&self.ctx, move |_| {
            match content {
                SavedFile::Dataset(dataset) => {
                    ppum_format::write(&dataset, &target).map_err(|error| error.to_string())
                }
                SavedFile::Page(page) => page.write(&target),
                SavedFile::Session | SavedFile::Problem(_) => {
                    replace(&target, text?.as_bytes()).map_err(|error| error.to_string())
                }
            }?;
            Ok(watch::stamp(&target))
        });
        self.writings.push(FileWrite { path, what, job });
    }

    /// Returns the files that were written since; what could not be written is told.
    pub fn written(&mut self) -> Vec<(PathBuf, SavedFile)> {
        let mut written = Vec::new();
        for FileWrite { path, what, job } in std::mem::take(&mut self.writings) {
            match job.poll().map(Result::flatten) {
                None => self.writings.push(FileWrite { path, what, job }),
                Some(Ok(stamp)) => {
                    // what the window itself has written is no news to it
                    self.follow(&path, stamp);
                    self.tell(&path, format!("{} is written", path.display()), false);
                    written.push((path, what));
                }
                Some(Err(error)) => {
                    self.tell(&path, format!("{} cannot be written: {error}", name(&path)), true);
                }
            }
        }
        written
    }
}

/// The name of a file without its folder.
#[must_use]
pub fn name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display(), |name| Path::new(name).display()).to_string()
}
