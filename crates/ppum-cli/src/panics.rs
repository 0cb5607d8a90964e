//! Panics, ours and those of libraries, as errors: nobody should read a trace of the stack.

use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Mutex, PoisonError};

use anyhow::bail;

/// Place and message of the first panic.
static TOLD: Mutex<Option<String>> = Mutex::new(None);

/// Does the work; a panic is an error that asks for a report.
///
/// With `RUST_BACKTRACE` set the usual trace is printed as well.
pub(crate) fn guarded(work: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
    let usual = panic::take_hook();
    let traces = std::env::var_os("RUST_BACKTRACE").is_some();
    panic::set_hook(Box::new(move |info| {
        keep(info);
        if traces {
            usual(info);
        }
    }));
    // nothing that the work holds is used after it
    match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok(done) => done,
        Err(_) => bail!(
            "ppum stopped at a mistake of its own: {}\nfiles are as they were, and a series has the steps that were complete; please report it, \
             with the command and its files",
            take_message().unwrap_or_else(|| "it does not say where".to_owned())
        ),
    }
}

/// Keeps the first panic: others follow from it.
fn keep(info: &PanicHookInfo<'_>) {
    let payload = info.payload();
    let text = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let message = text.unwrap_or("no message");
    let place = info.location().map_or(String::new(), |place| format!(" ({place})"));
    TOLD.lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get_or_insert_with(|| format!("{message}{place}"));
}

fn take_message() -> Option<String> {
    TOLD.lock().unwrap_or_else(PoisonError::into_inner).take()
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;

    #[test]
    fn a_panic_is_an_error_with_its_place() {
        assert!(guarded(|| Ok(())).is_ok());
        let error = guarded(|| panic!("no room for {} values", 7)).expect_err("a panic");
        let text = error.to_string();
        assert!(text.contains("no room for 7 values") && text.contains("panics.rs:"), "{text}");
        // also of another thread
        let error = guarded(|| {
            (0..64).into_par_iter().for_each(|k: usize| assert!(k < 60, "lane {k}"));
            Ok(())
        });
        assert!(error.expect_err("a panic").to_string().contains("lane 6"));
    }
}
