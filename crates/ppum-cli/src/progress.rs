//! The progress of long calls: on a terminal only.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use ppum::progress::{Progress, Verdict, Watcher};

/// A line on standard error that disappears when it is dropped; silent where that is no terminal.
pub(crate) struct ProgressLine(ProgressBar, Mutex<Option<String>>);

impl ProgressLine {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        bar.set_prefix(within().clone());
        bar.set_style(style(false));
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar, Mutex::new(None))
    }

    /// Takes the line away until something is shown again.
    pub(crate) fn clear(&self) {
        self.0.suspend(|| ());
        self.0.set_message("");
    }

    /// The steps are parts of a series that takes so many seconds more.
    pub(crate) fn in_series(&self, steps: usize, left: f64) {
        let left = HumanDuration(Duration::from_secs_f64(left.min(1e9)));
        self.1
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .replace(format!(" of {steps}, {left} left"));
    }

    fn show(&self, progress: Progress) {
        if progress.step == 0 {
            // the part of something longer may be another one since
            self.0.set_prefix(within().clone());
        }
        if self.0.message() != progress.phase.name() {
            if progress.step > 0 {
                let series = self.1.lock().unwrap_or_else(PoisonError::into_inner);
                let of = series.as_deref().unwrap_or_default();
                self.0.set_prefix(format!("{}step {}{of}  ", within(), progress.step));
            }
            self.0.set_message(progress.phase.name());
            self.0.set_style(style(progress.total > 1));
        }
        self.0.set_length(progress.total as u64);
        self.0.set_position(progress.done as u64);
    }
}

impl Watcher for ProgressLine {
    /// Shows the progress; signals end the program as a whole, so nothing is to be stopped.
    fn on_progress(&self, progress: Progress) -> Verdict {
        self.show(progress);
        Verdict::GoOn
    }
}

/// A phase without parts has no bar.
fn style(has_parts: bool) -> ProgressStyle {
    let bar = if has_parts { "[{bar:40}] {pos}/{len}" } else { "" };
    ProgressStyle::with_template(&format!("{{spinner}} {{elapsed:>4}}  {{prefix}}{{msg:14}} {bar}"))
        .expect("the template is right")
        .progress_chars("=> ")
}

/// The task that all bars belong to, which they print in front: `3/20 `.
static WITHIN: Mutex<String> = Mutex::new(String::new());

fn within() -> std::sync::MutexGuard<'static, String> {
    WITHIN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Bars that begin from now on belong to the parts of something longer, until this is dropped.
pub(crate) struct NestedBars {
    total: usize,
}

impl NestedBars {
    pub(crate) fn new(total: usize) -> Self {
        Self { total }
    }

    /// Bars belong to the part of this number, from 0.
    pub(crate) fn begin(&self, part: usize) {
        *within() = format!("{}/{}  ", part + 1, self.total);
    }
}

impl Drop for NestedBars {
    fn drop(&mut self) {
        within().clear();
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
