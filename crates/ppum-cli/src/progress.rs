//! The progress of long calls: on a terminal only.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use ppum::progress::{Progress, Verdict, Watcher};

/// A line on standard error that disappears when it is dropped; silent where that is no terminal.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    fn show(&self, progress: Progress) {
        if self.0.message() != progress.phase.name() {
            self.0.set_message(progress.phase.name());
            self.0.set_style(style(progress.total > 1));
        }
        self.0.set_length(progress.total as u64);
        self.0.set_position(progress.done as u64);
    }
}

impl Watcher for Bar {
    /// Shows the progress; signals end the program as a whole, so nothing is to be stopped.
    fn hear(&self, progress: Progress) -> Verdict {
        self.show(progress);
        Verdict::GoOn
    }
}

/// A phase without parts has no bar.
fn style(has_parts: bool) -> ProgressStyle {
    let bar = if has_parts { "[{bar:40}] {pos}/{len}" } else { "" };
    ProgressStyle::with_template(&format!("{{spinner}} {{elapsed:>4}}  {{msg:14}} {bar}"))
        .expect("the template is right")
        .progress_chars("=> ")
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
