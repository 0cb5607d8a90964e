//! Counting what threads have done, for a watcher.

use std::sync::atomic::{AtomicUsize, Ordering};

use ppum::progress::{Cancelled, Phase, Progress, Watcher};

/// The parts of an evaluation, reported as threads finish them, in whatever order.
pub(crate) struct Parts<'w> {
    watcher: &'w dyn Watcher,
    done: AtomicUsize,
    total: usize,
}

impl<'w> Parts<'w> {
    /// The beginning.
    pub(crate) fn start(watcher: &'w dyn Watcher, total: usize) -> Result<Self, Cancelled> {
        let total = total.max(1);
        watcher.report(Progress::start(Phase::Evaluation, total))?;
        Ok(Self { watcher, done: AtomicUsize::new(0), total })
    }

    /// One more is done.
    pub(crate) fn finish_one(&self) -> Result<(), Cancelled> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watcher.report(Progress::new(Phase::Evaluation, done, self.total))
    }
}
