//! The progress bar of a solver: on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use ppum_solve::solve::Progress;

/// A bar on standard error that disappears when it is dropped; silent where that is no terminal.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Self {
        let style = ProgressStyle::with_template("{msg:14} [{bar:40}] {pos}/{len}  {elapsed}")
            .expect("the template is right")
            .progress_chars("=> ");
        Self(ProgressBar::new(1).with_style(style))
    }

    pub(crate) fn show(&self, progress: Progress) {
        if self.0.message() != progress.phase.name() {
            self.0.set_message(progress.phase.name());
        }
        self.0.set_length(progress.total as u64);
        self.0.set_position(progress.done as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
