//! Following long calls, and stopping them.
//!
//! Solving, drawing and sampling may take long. Each such call takes a [`Watcher`]: a progress bar,
//! a window, a notebook. It is told of every [`Progress`], from whatever thread is working, and
//! answers whether the work goes on; a call that is stopped returns [`Cancelled`] and leaves
//! nothing behind. Watching changes no result.
//!
//! ```
//! use ppum::progress::{Cancelled, Phase, Progress, Verdict, Watcher, unwatched};
//! use std::sync::atomic::{AtomicBool, Ordering};
//!
//! fn long_call(watcher: &dyn Watcher) -> Result<usize, Cancelled> {
//!     for done in 0..100 {
//!         watcher.report(Progress::new(Phase::Assembly, done, 100))?;
//!     }
//!     Ok(100)
//! }
//!
//! assert_eq!(long_call(unwatched())?, 100);
//! let cancel = AtomicBool::new(true); // a button somewhere
//! let button = |_: Progress| Verdict::go_on_unless(cancel.load(Ordering::Relaxed));
//! assert_eq!(long_call(&button), Err(Cancelled));
//! # Ok::<(), Cancelled>(())
//! ```

/// The state of a long call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Progress {
    /// The phase.
    pub phase: Phase,
    /// Parts of the phase that are done.
    pub done: usize,
    /// Parts of the phase, at least 1.
    pub total: usize,
    /// The solution that the phase belongs to, from 0, of a call that makes several one after
    /// the other.
    pub step: usize,
}

impl Progress {
    /// So many parts of a phase are done, of so many.
    #[must_use]
    pub fn new(phase: Phase, done: usize, total: usize) -> Self {
        Self { phase, done, total, step: 0 }
    }

    /// Assigns the progress to a solution of the series, see [`Progress::step`].
    #[must_use]
    pub fn in_step(self, step: usize) -> Self {
        Self { step, ..self }
    }

    /// The beginning of a phase of so many parts.
    #[must_use]
    pub fn start(phase: Phase, total: usize) -> Self {
        Self::new(phase, 0, total)
    }
}

/// A phase of a long call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Building the cover and the local spaces.
    Cover,
    /// The stable basis of each patch.
    Basis,
    /// Integrating over the cells.
    Assembly,
    /// Factorisation and solution.
    Solution,
    /// The error of a solution.
    Estimation,
    /// Stress intensity factors.
    Intensity,
    /// Evaluating a field at many points.
    Evaluation,
}

impl Phase {
    /// Name in progress bars, reports and the history of a dataset.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cover => "cover",
            Self::Basis => "basis",
            Self::Assembly => "assembly",
            Self::Solution => "solution",
            Self::Estimation => "estimate",
            Self::Intensity => "intensity",
            Self::Evaluation => "evaluation",
        }
    }
}

/// The answer of a [`Watcher`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The work goes on.
    GoOn,
    /// The work stops as soon as it can.
    Stop,
}

impl Verdict {
    /// `Stop` if the call has been cancelled.
    #[must_use]
    pub fn go_on_unless(cancelled: bool) -> Self {
        if cancelled { Self::Stop } else { Self::GoOn }
    }
}

/// The follower of a long call. Closures from [`Progress`] to [`Verdict`] are watchers.
pub trait Watcher: Sync {
    /// Hears of progress, and says whether to go on. Called from the threads that work: it should
    /// be quick.
    fn on_progress(&self, progress: Progress) -> Verdict;
}

impl<F: Fn(Progress) -> Verdict + Sync> Watcher for F {
    fn on_progress(&self, progress: Progress) -> Verdict {
        self(progress)
    }
}

impl dyn Watcher + '_ {
    /// Tells of progress.
    ///
    /// # Errors
    /// The watcher wants the call to stop.
    pub fn report(&self, progress: Progress) -> Result<(), Cancelled> {
        match self.on_progress(progress) {
            Verdict::GoOn => Ok(()),
            Verdict::Stop => Err(Cancelled),
        }
    }
}

/// Nobody watches; the call runs to its end.
#[must_use]
pub fn unwatched() -> &'static dyn Watcher {
    &|_: Progress| Verdict::GoOn
}

/// A long call that was stopped by its [`Watcher`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;
