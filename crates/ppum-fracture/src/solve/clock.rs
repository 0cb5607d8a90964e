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

    /// The phase that ends now has lasted since the end of the one before; a phase in several parts
    /// has their sum.
    pub(super) fn lap(&mut self, phase: Phase) {
        let seconds = self.last.elapsed().as_secs_f64();
        match self.seconds.iter_mut().find(|(known, _)| *known == phase) {
            Some((_, sum)) => *sum += seconds,
            None => self.seconds.push((phase, seconds)),
        }
        self.last = Instant::now();
    }
}
