//! Files that are open, looked at once a second: who computes them again sees the new ones.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;
use std::time::{Duration, SystemTime};

/// Length and time of a file; none if it is not there.
pub type Stamp = Option<(u64, SystemTime)>;

/// The stamp of a file now.
pub(crate) fn stamp(path: &Path) -> Stamp {
    let data = fs::metadata(path).ok()?;
    Some((data.len(), data.modified().unwrap_or(SystemTime::UNIX_EPOCH)))
}

/// The time between two looks.
const INTERVAL: Duration = Duration::from_secs(1);

/// A thread that looks at files and tells of those that have changed. It ends with this value.
#[derive(Debug)]
pub struct Watch {
    shared: Arc<Mutex<WatchState>>,
}

#[derive(Debug, Default)]
struct WatchState {
    followed: Vec<WatchedFile>,
    changed: Vec<PathBuf>,
}

/// A file with the stamp that the window knows, and another one that was seen last.
#[derive(Debug)]
struct WatchedFile {
    path: PathBuf,
    known: Stamp,
    seen: Stamp,
}

impl Watch {
    /// Starts to look; the window is woken when something has changed, and only then.
    #[must_use]
    pub fn new(ctx: &egui::Context) -> Self {
        let shared = Arc::new(Mutex::new(WatchState::default()));
        let (theirs, ctx) = (Arc::downgrade(&shared), ctx.clone());
        thread::spawn(move || look(&theirs, &ctx));
        Self { shared }
    }

    /// Follows a file that was read when it had this stamp.
    pub fn follow(&self, path: &Path, known: Stamp) {
        let mut state = lock(&self.shared);
        state.followed.retain(|file| file.path != path);
        state.followed.push(WatchedFile { path: path.to_owned(), known, seen: known });
    }

    /// Leaves all files but those that are still open.
    pub fn keep(&self, is_open: impl Fn(&Path) -> bool) {
        lock(&self.shared).followed.retain(|file| is_open(&file.path));
    }

    /// The files that have changed since, or vanished.
    #[must_use]
    pub fn changed(&self) -> Vec<PathBuf> {
        std::mem::take(&mut lock(&self.shared).changed)
    }
}

fn lock(state: &Mutex<WatchState>) -> MutexGuard<'_, WatchState> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

fn look(shared: &Weak<Mutex<WatchState>>, ctx: &egui::Context) {
    loop {
        thread::sleep(INTERVAL);
        let Some(shared) = shared.upgrade() else { return };
        let paths: Vec<_> = lock(&shared).followed.iter().map(|file| file.path.clone()).collect();
        // a disk may be slow: nobody waits for it
        let stamps: Vec<_> = paths.iter().map(|path| stamp(path)).collect();
        let mut state = lock(&shared);
        let mut changed = Vec::new();
        for (path, now) in paths.into_iter().zip(stamps) {
            let file = state.followed.iter_mut().find(|file| file.path == path);
            if file.is_some_and(|file| file.note(now)) {
                changed.push(path);
            }
        }
        if !changed.is_empty() {
            state.changed.extend(changed);
            ctx.request_repaint();
        }
    }
}

impl WatchedFile {
    /// True if the file is another one, twice in a row: one that is being written is waited for.
    fn note(&mut self, now: Stamp) -> bool {
        let is_at_rest = self.seen == now;
        self.seen = now;
        let is_news = is_at_rest && self.known != now;
        if is_news {
            self.known = now;
        }
        is_news
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: u64) -> Stamp {
        Some((100, SystemTime::UNIX_EPOCH + Duration::from_secs(seconds)))
    }

    #[test]
    fn a_change_is_told_once_and_when_it_is_over() {
        let mut file = WatchedFile { path: "a".into(), known: at(1), seen: at(1) };
        let told = [1, 2, 3, 3, 3].map(|seconds| file.note(at(seconds)));
        assert_eq!(told, [false, false, false, true, false]);
        let gone = [None, None, None].map(|now| file.note(now));
        assert_eq!(gone, [false, true, false]);
        // another program may take a file away for a moment
        let replaced = [at(9), None, at(9), at(9)].map(|now| file.note(now));
        assert_eq!(replaced, [false, false, false, true]);
    }
}
