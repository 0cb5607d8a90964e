//! The number of threads. Results do not depend on it.

use std::num::NonZeroUsize;

/// Most threads that may be asked for: more than machines have cores. Each takes some MiB, and the
/// system itself fails where there are a hundred times as many.
const MOST: usize = 1024;

/// The number of threads on the command line.
pub(crate) fn number(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse().ok().filter(|number: &NonZeroUsize| number.get() <= MOST);
    number.ok_or_else(|| {
        format!("write a whole number from 1 to {MOST}; more threads than cores are of no use")
    })
}

/// Refuses what rayon would take from the environment.
pub(crate) fn check() -> anyhow::Result<()> {
    const NAME: &str = "RAYON_NUM_THREADS";
    let given = std::env::var(NAME).ok().and_then(|text| text.parse::<usize>().ok());
    anyhow::ensure!(given.is_none_or(|n| n <= MOST), "{NAME}: at most {MOST} threads are of use");
    Ok(())
}

/// Does `work` on `threads` threads, by default on all cores.
pub(crate) fn with<T: Send>(
    threads: Option<NonZeroUsize>,
    work: impl FnOnce() -> T + Send,
) -> anyhow::Result<T> {
    let Some(threads) = threads else { return Ok(work()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build()?;
    Ok(pool.install(work))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_threads() {
        assert_eq!(number("1").map(NonZeroUsize::get), Ok(1));
        assert_eq!(number("1024").map(NonZeroUsize::get), Ok(MOST));
        for wrong in ["", "0", "-1", "1.5", "1025", "1000000", "99999999999999999999999"] {
            assert!(number(wrong).is_err(), "{wrong}");
        }
    }
}
