//! Tests that need what a machine may lack: skipped where everybody sees it, and counted.

use std::collections::BTreeSet;
use std::io::Write;
use std::sync::{Mutex, PoisonError};

/// Names of the tests of this binary that were skipped.
static SKIPPED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Notes that the running test is skipped, all of it or a part, for want of a graphics adapter. The
/// line holds the number of tests skipped so far, so the last one holds the number of the whole
/// binary; it goes past the harness, which would show it for failed tests only.
///
/// # Panics
/// If `PPUM_REQUIRE_GPU` is set: then no test may be skipped.
pub fn skipped(reason: &str) {
    assert!(std::env::var_os("PPUM_REQUIRE_GPU").is_none(), "{reason}");
    let test = std::thread::current().name().unwrap_or_default().to_owned();
    let mut known = SKIPPED.lock().unwrap_or_else(PoisonError::into_inner);
    if known.insert(test.clone()) {
        // a closed standard error is no reason to fail
        let _ = writeln!(std::io::stderr(), "SKIPPED {} (so far): {test}: {reason}", known.len());
    }
}
