//! Processor time of threads. Unlike elapsed time it hardly depends on what else the machine does.

use std::time::Duration;

/// Returns the processor time of the calling thread since its start, or zero where the system does
/// not report it.
#[must_use]
pub fn thread_time() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|text| text.parse().ok());
    Duration::from_nanos(nanoseconds.unwrap_or_default())
}
