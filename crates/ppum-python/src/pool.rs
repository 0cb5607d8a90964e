//! The threads that work is done on.
//!
//! Threads do not survive `fork`, so each process has a pool of its own, made when it first needs
//! one. That of rayon itself is never used.

use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::InternalError;

/// The pool, and the process that it belongs to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// A pool of so many threads; without a number that of the process, with as many as there are
/// processors, or as `RAYON_NUM_THREADS` says.
pub(crate) fn pool(threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    if let Some(threads) = threads {
        return made(threads);
    }
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*pool
        && *process == process::id()
    {
        return Ok(pool.clone());
    }
    let new = made(0)?;
    // the threads of the parent's pool are not here, and nothing can be said to them
    std::mem::forget(pool.replace((process::id(), new.clone())));
    Ok(new)
}

/// A new pool; of zero threads as many as there are processors.
fn made(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    let named = builder.thread_name(|k| format!("ppum-{k}"));
    named.build().map(Arc::new).map_err(|error| {
        InternalError::new_err(format!(
            "no threads to work on: {error}; ask for fewer with `threads`"
        ))
    })
}
