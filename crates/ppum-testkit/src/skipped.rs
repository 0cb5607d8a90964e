//! Tests that need what a machine may lack: skipped where everybody sees it, and counted.

use std::fmt::Display;
use std::io::Write;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Tests of this binary that were skipped.
static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// Notes that the running test is skipped for want of a graphics adapter. The line holds the number of tests
/// skipped so far, so the last one holds the number of the whole binary; it goes past the harness, which would
/// show it for failed tests only.
///
/// # Panics
/// If `PPUM_REQUIRE_GPU` is set: then no test may be skipped.
pub fn skipped(reason: &dyn Display) {
    assert!(std::env::var_os("PPUM_REQUIRE_GPU").is_none(), "{reason}");
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    let thread = std::thread::current();
    let test = thread.name().unwrap_or_default();
    // a closed standard error is no reason to fail
    let _ = writeln!(std::io::stderr(), "SKIPPED {count} (so far): {test}: {reason}");
}
