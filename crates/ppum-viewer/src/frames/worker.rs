//! The thread that makes the images.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::maker::{FrameMaker, FrameStop, NextStep, StepResult};
use super::renderer::Backend;
use super::request::{AskStatus, LatestRequest, RequestStatus};
use super::{FaultOrigin, FrameResult, ImageFailure};

/// Calls whoever shows the images.
pub(super) type Wake = Box<dyn Fn() + Send>;

/// One step: what is to be shown of it, and when the next is due. A panic is told as a failure, and
/// forgets everything.
pub(super) fn step(
    maker: &mut FrameMaker,
    backend: Backend,
    latest: &LatestRequest,
    status: AskStatus<'_>,
) -> (Option<FrameResult>, NextStep) {
    let made = catch_unwind(AssertUnwindSafe(|| maker.step(latest, Instant::now(), status)));
    match made {
        Ok(Ok(StepResult { frame, next })) => (frame.map(Ok), next),
        Ok(Err(FrameStop::Cancelled)) => (None, NextStep::More),
        Ok(Err(FrameStop::Failed(failure))) => (Some(Err(failure)), NextStep::Rest),
        Err(_) => {
            *maker = FrameMaker::new(backend);
            (Some(Err(ImageFailure::new(FaultOrigin::Program, PANIC))), NextStep::Rest)
        }
    }
}

const PANIC: &str = "internal error, please report it: this cannot be drawn; choose something else";

/// Adds an outcome; of frames that nobody has taken the last one is enough.
fn add(outcomes: &mut Vec<FrameResult>, outcome: Option<FrameResult>) {
    let Some(outcome) = outcome else { return };
    if outcome.is_ok() && outcomes.last().is_some_and(Result::is_ok) {
        outcomes.pop();
    }
    outcomes.push(outcome);
}

/// A thread that makes images.
pub(super) struct Worker(Arc<WorkerChannel>);

#[derive(Default)]
struct WorkerChannel {
    state: Mutex<WorkerState>,
    changed: Condvar,
}

#[derive(Default)]
struct WorkerState {
    latest: Option<LatestRequest>,
    /// Requests so far, and the number of the last one that is fulfilled.
    count: usize,
    fulfilled: usize,
    is_closed: bool,
    outcomes: Vec<FrameResult>,
}

impl WorkerChannel {
    fn state(&self) -> MutexGuard<'_, WorkerState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The request to work for, with its number, when something is to be done for it; none if the
    /// pane is closed.
    fn next(&self, number: usize, next: NextStep) -> Option<(LatestRequest, usize)> {
        let time = match next {
            NextStep::More => Duration::ZERO,
            NextStep::After(time) => time,
            NextStep::Rest => Duration::MAX,
        };
        let is_waiting = |state: &mut WorkerState| state.count == number && !state.is_closed;
        let waited = self.changed.wait_timeout_while(self.state(), time, is_waiting);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let latest = state.latest.clone().filter(|_| !state.is_closed)?;
        Some((latest, state.count))
    }

    fn status(&self, number: usize) -> RequestStatus {
        let state = self.state();
        match () {
            () if state.is_closed => RequestStatus::Closed,
            () if state.count != number => RequestStatus::Replaced,
            () => RequestStatus::Current,
        }
    }
}

impl Worker {
    pub(super) fn new(backend: Backend, wake: Wake) -> Self {
        let shared = Arc::new(WorkerChannel::default());
        let theirs = Arc::clone(&shared);
        thread::spawn(move || serve(&theirs, backend, &wake));
        Self(shared)
    }

    pub(super) fn want(&self, latest: LatestRequest) {
        let mut state = self.0.state();
        state.latest = Some(latest);
        state.count += 1;
        // why something else had no image is no news
        state.outcomes.retain(Result::is_ok);
        drop(state);
        self.0.changed.notify_all();
    }

    pub(super) fn take(&mut self) -> Vec<FrameResult> {
        std::mem::take(&mut self.0.state().outcomes)
    }

    pub(super) fn is_working(&self) -> bool {
        let state = self.0.state();
        state.count != state.fulfilled || !state.outcomes.is_empty()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.0.state().is_closed = true;
        self.0.changed.notify_all();
    }
}

/// Makes images until nobody wants any.
fn serve(shared: &WorkerChannel, backend: Backend, wake: &Wake) {
    let mut maker = FrameMaker::new(backend);
    let (mut number, mut next) = (0, NextStep::Rest);
    while let Some((latest, newest)) = shared.next(number, next) {
        number = newest;
        let outcome;
        (outcome, next) = step(&mut maker, backend, &latest, &|| shared.status(number));
        let mut state = shared.state();
        let is_stale = state.count != number;
        let outcome = outcome.filter(|outcome| outcome.is_ok() || !is_stale);
        let has_news = outcome.is_some();
        add(&mut state.outcomes, outcome);
        if next == NextStep::Rest {
            state.fulfilled = number;
        }
        drop(state);
        if has_news || next == NextStep::Rest {
            wake();
        }
    }
}
