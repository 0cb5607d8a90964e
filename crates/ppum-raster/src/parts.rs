//! Counting what threads have done, for a watcher.

use std::sync::atomic::{AtomicUsize, Ordering};

use ppum::progress::{Cancelled, Phase, Progress, Watcher};

/// The parts of an evaluation, reported to a watcher as threads finish them, in whatever order.
pub struct Parts<'w> {
    watcher: &'w dyn Watcher,
    done: AtomicUsize,
    total: usize,
}

impl<'w> Parts<'w> {
    /// Reports that an evaluation of `total` parts, one at least, begins.
    ///
    /// # Errors
    /// [`Cancelled`] if the watcher stops the evaluation.
    pub fn start(watcher: &'w dyn Watcher, total: usize) -> Result<Self, Cancelled> {
        let total = total.max(1);
        watcher.report(Progress::start(Phase::Evaluation, total))?;
        Ok(Self { watcher, done: AtomicUsize::new(0), total })
    }

    /// Reports that one more part is done.
    ///
    /// # Errors
    /// [`Cancelled`] if the watcher stops the evaluation.
    pub fn finish_one(&self) -> Result<(), Cancelled> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watcher.report(Progress::new(Phase::Evaluation, done, self.total))
    }
}
