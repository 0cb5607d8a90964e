//! Work on all cores, watched, with results that do not depend on their number.
//!
//! It runs on the pool of threads that it is called from. Sums are formed in the order of the
//! items, and a [`Watcher`] hears of every one of them, so that it can stop the work within the
//! time of one.

use ppum::progress::{Cancelled, Phase, Progress, Verdict, Watcher};
use ppum::vec2::Rect;
use ppum_problem::geometry::Vicinity;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

/// A watcher for one step, which adds the number of the step to all progress.
pub struct StepWatcher<'w> {
    /// Called with the progress.
    pub watcher: &'w dyn Watcher,
    /// The number of the step.
    pub step: usize,
}

impl Watcher for StepWatcher<'_> {
    fn on_progress(&self, progress: Progress) -> Verdict {
        self.watcher.on_progress(progress.in_step(self.step))
    }
}

/// Items worked on between additions, at least and for each thread: enough for the cores, little
/// enough for the memory.
const LEAST_BATCH: usize = 32;
const BATCH_OF_THREAD: usize = 8;

/// Work in one phase, as a watcher sees it.
pub struct WorkPhase<'w> {
    watcher: &'w dyn Watcher,
    phase: Phase,
    /// Parts of the phase, where they are known.
    total: Option<usize>,
    done: AtomicUsize,
    /// A watcher need not say twice that it wants the work to stop.
    is_stopped: AtomicBool,
}

impl<'w> WorkPhase<'w> {
    /// The beginning of a phase of so many parts.
    ///
    /// # Errors
    /// The watcher wants the work to stop.
    pub fn new(watcher: &'w dyn Watcher, phase: Phase, total: usize) -> Result<Self, Cancelled> {
        Self::start(watcher, phase, Some(total.max(1)))
    }

    /// Starts a phase whose parts are not counted: it has one part, which is never done.
    ///
    /// # Errors
    /// The watcher wants the work to stop.
    pub fn uncounted(watcher: &'w dyn Watcher, phase: Phase) -> Result<Self, Cancelled> {
        Self::start(watcher, phase, None)
    }

    fn start(
        watcher: &'w dyn Watcher,
        phase: Phase,
        total: Option<usize>,
    ) -> Result<Self, Cancelled> {
        let (done, is_stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let stage = Self { watcher, phase, total, done, is_stopped };
        stage.advance(0).map(|()| stage)
    }

    /// Tells that further parts are done.
    ///
    /// # Errors
    /// The watcher wants the work to stop, or has wanted it before.
    pub fn advance(&self, parts: usize) -> Result<(), Cancelled> {
        let done = self.done.fetch_add(parts, Relaxed) + parts;
        let progress = match self.total {
            Some(total) => Progress::new(self.phase, done.min(total), total),
            None => Progress::start(self.phase, 1),
        };
        self.goes_on()?;
        self.watcher.report(progress).inspect_err(|_| self.is_stopped.store(true, Relaxed))
    }

    /// # Errors
    /// The watcher has wanted the work to stop.
    fn goes_on(&self) -> Result<(), Cancelled> {
        if self.is_stopped.load(Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

/// The reason why work over the body ends before it is complete.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Halt {
    /// The watcher wants it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Something there is not finite.
    #[error("something is not finite {0}")]
    NotFinite(Vicinity),
}

impl Halt {
    /// Something in a cell or patch is not finite.
    pub(crate) fn at(rect: Rect) -> Self {
        Self::NotFinite(rect.into())
    }
}

/// Calls `work` for 0 … n − 1 on all cores, beside the counted parts of a stage.
///
/// # Errors
/// The first one in the order of the items; the watcher of `stage` wants the work to stop.
pub(crate) fn each<T: Send>(
    stage: &WorkPhase<'_>,
    n: usize,
    work: impl Fn(usize) -> Result<T, Halt> + Sync,
) -> Result<Vec<T>, Halt> {
    let watched = |item| {
        stage.advance(0)?;
        work(item)
    };
    let all: Vec<_> = (0..n).into_par_iter().map(watched).collect();
    all.into_iter().collect()
}

/// Calls `work` for 0 … n − 1 on all cores, a batch at a time, then `add` in order, while the next
/// batch is worked on. Sums formed in `add` so have the same bits whatever the number of threads.
/// `state` makes what a core keeps.
///
/// # Errors
/// The first one in the order of the items; the watcher of `stage` wants the work to stop.
pub(crate) fn in_batches<S, T: Send>(
    stage: &WorkPhase<'_>,
    n: usize,
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize) -> Result<T, Halt> + Sync,
    mut add: impl FnMut(usize, T) + Send,
) -> Result<(), Halt> {
    let watched = |state: &mut S, item: usize| {
        stage.goes_on()?;
        let part = work(state, item);
        stage.advance(1)?;
        part
    };
    let size = LEAST_BATCH.max(BATCH_OF_THREAD * rayon::current_num_threads());
    let batch = |first: usize| -> Vec<Result<T, Halt>> {
        (first..n.min(first + size)).into_par_iter().map_init(&state, watched).collect()
    };
    let mut parts = batch(0);
    for first in (0..n).step_by(size) {
        let add = &mut add;
        let added = move || -> Result<(), Halt> {
            (first..).zip(parts).try_for_each(|(item, part)| {
                add(item, part?);
                Ok(())
            })
        };
        let (added, next) = rayon::join(added, || batch(first + size));
        added?;
        parts = next;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::progress::{Verdict, unwatched};
    use std::sync::Mutex;

    fn sum(watcher: &dyn Watcher, n: usize) -> Result<f64, Halt> {
        let (stage, mut sum) = (WorkPhase::new(watcher, Phase::Assembly, n)?, 0.0);
        in_batches(
            &stage,
            n,
            || (),
            |(), item| Ok(1.0 / (item + 1) as f64),
            |_, part| sum += part,
        )?;
        Ok(sum)
    }

    #[test]
    fn sums_do_not_depend_on_the_number_of_threads() {
        let on = |threads: usize| {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| sum(unwatched(), 1000)).expect("a sum").to_bits()
        };
        assert_eq!(on(1), on(3));
    }

    /// If several errors occur, the first in order is returned, however the threads run.
    #[test]
    fn the_first_error_counts() {
        let at = |item: usize| {
            let p = ppum::vec2::vec2(item as f64, 0.0);
            Halt::at(Rect::new(p, p))
        };
        let stage = WorkPhase::new(unwatched(), Phase::Basis, 300).expect("nobody stops it");
        let work = |(): &mut (), item: usize| if item % 50 == 49 { Err(at(item)) } else { Ok(()) };
        let mut added = 0;
        let found = in_batches(&stage, 300, || (), work, |_, ()| added += 1);
        assert_eq!((found, added), (Err(at(49)), 49));
    }

    /// The work stops within a few items of each thread, also where the watcher says so once only.
    #[test]
    fn a_watcher_that_has_spoken_once_is_heard() {
        let heard = Mutex::new(0);
        let once = |_: Progress| {
            let mut heard = heard.lock().expect("no panic");
            *heard += 1;
            Verdict::go_on_unless(*heard == 20)
        };
        assert_eq!(sum(&once, 10_000), Err(Halt::Cancelled(Cancelled)));
        assert!(*heard.lock().expect("no panic") < 40);
    }
}
