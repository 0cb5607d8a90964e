//! The content of a file, found in the background.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use ppum::dataset::Dataset;
use ppum_problem::MAX_LENGTH as MAX_PROBLEM;

use super::drawing::{DRAWINGS, DrawingSource};
use super::session_file;
use super::watch::{Stamp, stamp};
use crate::job::{BackgroundJob, CancelToken};
use crate::save_target::has_extension;
use crate::session::Session;

/// The content of a file.
#[derive(Clone, Debug)]
pub enum FileContent {
    /// A dataset.
    Dataset(Arc<Dataset>),
    /// The text of a problem.
    Problem(String),
    /// A drawing, to be imported.
    Drawing(Arc<DrawingSource>),
    /// The session of a window.
    Session(Box<Session>),
}

/// The reason why a file is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Somebody opens it.
    Opened,
    /// A session names it: view and settings are there already.
    Restored,
    /// It has changed on disk.
    Changed,
}

/// A file that was read.
#[derive(Clone, Debug)]
pub struct ReadFile {
    /// The file.
    pub path: PathBuf,
    /// The pane that it is for.
    pub pane: usize,
    /// The reason.
    pub why: Why,
    /// Its stamp before it was read.
    pub stamp: Stamp,
    /// The content, or the reason why it cannot be read.
    pub content: Result<FileContent, String>,
}

/// A file that is being read.
#[derive(Debug)]
pub struct FileRead {
    /// The file.
    pub path: PathBuf,
    /// The pane that it is for.
    pub pane: usize,
    /// The reason.
    pub why: Why,
    /// The time when it was begun.
    pub since: Instant,
    stamp: Stamp,
    job: BackgroundJob<Result<FileContent, String>>,
    bytes: Arc<AtomicU64>,
}

impl FileRead {
    /// Begins to read a file.
    #[must_use]
    pub fn new(ctx: &egui::Context, path: PathBuf, pane: usize, why: Why) -> Self {
        let (file, bytes) = (path.clone(), Arc::new(AtomicU64::new(0)));
        let stamp = stamp(&path);
        let counted = Arc::clone(&bytes);
        let job = BackgroundJob::start(ctx, move |stop| read(&file, &counted, stop));
        Self { path, pane, why, since: Instant::now(), stamp, job, bytes }
    }

    /// The part of the file that was read, of those whose length is known; what follows is
    /// checked then.
    #[must_use]
    pub fn part(&self) -> Option<f32> {
        let (length, _) = self.stamp?;
        Some(self.bytes.load(Ordering::Relaxed) as f32 / length.max(1) as f32)
    }

    /// Returns the file that was read, once.
    #[must_use]
    pub fn poll(&self) -> Option<ReadFile> {
        let content = self.job.poll()?.flatten();
        let Self { path, pane, why, stamp, .. } = self;
        Some(ReadFile { path: path.clone(), pane: *pane, why: *why, stamp: *stamp, content })
    }
}

/// Signature at the start of an HDF5 file; a block of the user's may stand before it.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

fn read(path: &Path, counted: &AtomicU64, stop: &CancelToken) -> Result<FileContent, String> {
    if has_extension(path, DRAWINGS) {
        return DrawingSource::read(path).map(Arc::new).map(FileContent::Drawing);
    }
    match is_text(path) {
        Err(error) => Err(error.to_string()),
        Ok(true) => text(path),
        Ok(false) => dataset(path, counted, stop).map(Arc::new).map(FileContent::Dataset),
    }
}

/// True if a file is no dataset: by its name, or by its first bytes.
fn is_text(path: &Path) -> io::Result<bool> {
    if has_extension(path, &["toml", session_file::EXTENSION]) {
        return Ok(true);
    }
    if has_extension(path, &["h5", "hdf5"]) {
        return Ok(false);
    }
    let mut head = Vec::new();
    ppum_file::open(path, u64::MAX)?.take(HDF5.len() as u64).read_to_end(&mut head)?;
    Ok(head != HDF5 && std::str::from_utf8(&head).is_ok())
}

/// A session or a problem.
fn text(path: &Path) -> Result<FileContent, String> {
    let text = ppum_file::text(path, MAX_PROBLEM).map_err(|error| error.to_string())?;
    let is_session =
        has_extension(path, &[session_file::EXTENSION]) || text.trim_start().starts_with('{');
    if !is_session {
        return Ok(FileContent::Problem(text));
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let session = session_file::parse(&text, folder).map_err(|error| error.to_string())?;
    Ok(FileContent::Session(Box::new(session)))
}

/// A file that counts what was read of it, and ends where nobody wants it.
struct CountingReader<'a> {
    file: File,
    bytes: &'a AtomicU64,
    stop: &'a CancelToken,
}

impl Read for CountingReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.stop.is_set() {
            return Err(io::Error::other("cancelled"));
        }
        let count = self.file.read(buffer)?;
        self.bytes.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }
}

fn dataset(path: &Path, bytes: &AtomicU64, stop: &CancelToken) -> Result<Dataset, String> {
    let whole = || {
        let file = ppum_file::open(path, ppum_format::MAX_LENGTH)?;
        ppum_file::within(CountingReader { file, bytes, stop }, ppum_format::MAX_LENGTH)
    };
    let bytes = whole().map_err(|error| error.to_string())?;
    ppum_format::from_bytes(bytes).map_err(|error| error.to_string())
}
