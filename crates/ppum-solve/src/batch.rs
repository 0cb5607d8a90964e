//! Work on all cores with results that do not depend on their number.

use rayon::prelude::*;

/// Items worked on between additions: enough for the cores, little enough for the memory.
const BATCH: usize = 128;

/// Calls `work` for 0 … n − 1 on all cores, a batch at a time, then `add` in order. Sums formed in
/// `add` so have the same bits whatever the number of threads. `state` makes what a core keeps.
pub(crate) fn in_batches<S, T: Send>(
    n: usize,
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize) -> T + Sync,
    mut add: impl FnMut(usize, T),
) {
    let items: Vec<_> = (0..n).collect();
    for batch in items.chunks(BATCH) {
        let parts: Vec<_> =
            batch.par_iter().map_init(&state, |state, &item| work(state, item)).collect();
        for (&item, part) in batch.iter().zip(parts) {
            add(item, part);
        }
    }
}
