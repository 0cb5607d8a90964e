//! The number of threads. Results do not depend on it.

use std::num::NonZeroUsize;

/// Does `work` on `threads` threads, by default on all cores.
pub(crate) fn with<T: Send>(
    threads: Option<NonZeroUsize>,
    work: impl FnOnce() -> T + Send,
) -> anyhow::Result<T> {
    let Some(threads) = threads else { return Ok(work()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build()?;
    Ok(pool.install(work))
}
