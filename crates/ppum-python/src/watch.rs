//! Calls from Python: without its lock, with its signals, and with no panic that it could
//! not catch.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use ppum::progress::{Progress, Verdict, Watcher};
use pyo3::prelude::*;

use crate::errors::InternalError;
use crate::pool::pool;

/// How often signals are looked for, and progress is told: people wait no longer for Ctrl-C
/// to work.
const TICK: Duration = Duration::from_millis(50);

/// Whatever `work` gives; a panic is an `InternalError`, since Python's `except Exception` would
/// not catch it.
pub(crate) fn guard<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(internal(&*panic)))
}

fn internal(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    InternalError::new_err(format!("a mistake in ppum itself, please report it: {text}"))
}

/// Does work on a pool of threads, without Python's lock. `progress` is called now and then with
/// the phase, the parts that are done, all parts and the step; an exception of it, or of a signal,
/// stops the work and is raised.
pub(crate) fn long<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Watcher) -> T + Send,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let (latest, is_cancelled) = (Mutex::new(None), AtomicBool::new(false));
    let watcher = |progress: Progress| {
        *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
        Verdict::go_on_unless(is_cancelled.load(Ordering::Relaxed))
    };
    thread::scope(|scope| {
        let (done, mut result) = mpsc::channel();
        let watcher: &dyn Watcher = &watcher;
        scope.spawn(move || {
            let worked = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(watcher))));
            // nobody hears it if the caller has panicked
            let _ = done.send(worked);
        });
        loop {
            let waiting = &mut result;
            match py.detach(move || waiting.recv_timeout(TICK)) {
                Ok(worked) => return worked.map_err(|panic| internal(&*panic)),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(InternalError::new_err("a thread of ppum ended without a result"));
                }
            }
            let heard = latest.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Err(error) = py.check_signals().and_then(|()| tell(progress, heard)) {
                is_cancelled.store(true, Ordering::Relaxed);
                let waiting = &mut result;
                // it ends soon, and its result is not wanted any more
                let _ = py.detach(move || waiting.recv());
                return Err(error);
            }
        }
    })
}

fn tell(progress: Option<&Bound<'_, PyAny>>, heard: Option<Progress>) -> PyResult<()> {
    let (Some(progress), Some(heard)) = (progress, heard) else { return Ok(()) };
    let Progress { phase, done, total, step, .. } = heard;
    progress.call1((phase.name(), done, total, step)).map(drop)
}

/// Panics, here or on a thread of the pool: that this is an exception is tested.
#[pyfunction]
#[pyo3(name = "_panic")]
pub(crate) fn panic_for_tests(py: Python<'_>, on_pool: bool) -> PyResult<()> {
    if on_pool {
        return long(py, None, None, |_| panic!("on purpose"));
    }
    guard(|| panic!("on purpose"))
}
