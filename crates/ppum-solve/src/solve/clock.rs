//! Seconds of phases.

use ppum::progress::Phase;
use std::time::Instant;

/// A clock that is read at the end of each phase.
pub(super) struct Clock {
    last: Instant,
    pub(super) seconds: Vec<(Phase, f64)>,
}

impl Clock {
    pub(super) fn new() -> Self {
        Self { last: Instant::now(), seconds: Vec::new() }
    }

    /// The phase that ends now has lasted since the end of the one before.
    pub(super) fn lap(&mut self, phase: Phase) {
        self.seconds.push((phase, self.last.elapsed().as_secs_f64()));
        self.last = Instant::now();
    }
}
