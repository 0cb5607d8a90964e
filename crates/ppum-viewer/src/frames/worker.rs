//! The thread that makes the pictures.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Instant;

use super::maker::{FrameMaker, Next, StepResult, Wish};
use super::renderer::Backend;
use super::stop::{Ask, Claim, StageEnd};
use super::{Failure, Fault, Outcome};

/// Calls whoever shows the pictures.
pub(super) type Wake = Box<dyn Fn() + Send>;

/// One step: what is to be shown of it, and when the next is due. A panic is told as a failure, and
/// forgets everything.
pub(super) fn step(
    maker: &mut FrameMaker,
    backend: Backend,
    wish: &Wish,
    claim: Ask<'_>,
) -> (Option<Outcome>, Next) {
    let made = catch_unwind(AssertUnwindSafe(|| maker.step(wish, Instant::now(), claim)));
    match made {
        Ok(Ok(StepResult { frame, next })) => (frame.map(Ok), next),
        Ok(Err(StageEnd::Cancelled)) => (None, Next::More),
        Ok(Err(StageEnd::Failed(failure))) => (Some(Err(failure)), Next::Rest),
        Err(_) => {
            *maker = FrameMaker::new(backend);
            let message = PANIC.to_owned();
            (Some(Err(Failure { fault: Fault::Program, message })), Next::Rest)
        }
    }
}

const PANIC: &str = "a mistake of the program keeps it from drawing this; choose something else, and please report it";

/// Adds an outcome; of frames that nobody has taken the last one is enough.
fn add(outcomes: &mut Vec<Outcome>, outcome: Option<Outcome>) {
    let Some(outcome) = outcome else { return };
    if outcome.is_ok() && outcomes.last().is_some_and(Result::is_ok) {
        outcomes.pop();
    }
    outcomes.push(outcome);
}

/// A thread that makes pictures.
pub(super) struct Worker(Arc<Shared>);

#[derive(Default)]
struct Shared {
    state: Mutex<WorkerState>,
    changed: Condvar,
}

#[derive(Default)]
struct WorkerState {
    wish: Option<Wish>,
    /// Wishes so far, and the last one that is fulfilled.
    wishes: usize,
    fulfilled: usize,
    is_closed: bool,
    outcomes: Vec<Outcome>,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, WorkerState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The wish to work for, with its number, when something is to be done for it; none if nobody
    /// wants anything any more.
    fn next(&self, number: usize, next: Next) -> Option<(Wish, usize)> {
        let is_waiting = |state: &mut WorkerState| state.wishes == number && !state.is_closed;
        let mut state = self.state();
        state = match next {
            Next::More => state,
            Next::After(time) => {
                let waited = self.changed.wait_timeout_while(state, time, is_waiting);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
            Next::Rest => {
                let waited = self.changed.wait_while(state, is_waiting);
                waited.unwrap_or_else(PoisonError::into_inner)
            }
        };
        let wish = state.wish.clone().filter(|_| !state.is_closed)?;
        Some((wish, state.wishes))
    }

    fn claim(&self, number: usize) -> Claim {
        let state = self.state();
        match () {
            () if state.is_closed => Claim::Gone,
            () if state.wishes != number => Claim::Replaced,
            () => Claim::Wanted,
        }
    }
}

impl Worker {
    pub(super) fn new(backend: Backend, wake: Wake) -> Self {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        thread::spawn(move || serve(&theirs, backend, &wake));
        Self(shared)
    }

    pub(super) fn want(&self, wish: Wish) {
        let mut state = self.0.state();
        state.wish = Some(wish);
        state.wishes += 1;
        // why something else had no picture is no news
        state.outcomes.retain(Result::is_ok);
        drop(state);
        self.0.changed.notify_all();
    }

    pub(super) fn take(&mut self) -> Vec<Outcome> {
        std::mem::take(&mut self.0.state().outcomes)
    }

    pub(super) fn is_working(&self) -> bool {
        let state = self.0.state();
        state.wishes != state.fulfilled || !state.outcomes.is_empty()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.0.state().is_closed = true;
        self.0.changed.notify_all();
    }
}

/// Makes pictures until nobody wants any.
fn serve(shared: &Shared, backend: Backend, wake: &Wake) {
    let mut maker = FrameMaker::new(backend);
    let (mut number, mut next) = (0, Next::Rest);
    while let Some((wish, newest)) = shared.next(number, next) {
        number = newest;
        let outcome;
        (outcome, next) = step(&mut maker, backend, &wish, &|| shared.claim(number));
        let mut state = shared.state();
        let is_stale = state.wishes != number;
        let outcome = outcome.filter(|outcome| outcome.is_ok() || !is_stale);
        let has_news = outcome.is_some();
        add(&mut state.outcomes, outcome);
        if next == Next::Rest {
            state.fulfilled = number;
        }
        drop(state);
        if has_news || next == Next::Rest {
            wake();
        }
    }
}
