//! The deformed body in motion: its factor goes from nothing to what was chosen and back. Nothing
//! of that is the session's.

use ppum_scene::magnification::Magnification;

/// A factor that swings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeformationAnimation {
    /// When it began \[s\].
    since: f64,
    /// The part of the factor that is shown.
    part: f64,
}

/// There and back \[s\].
const PERIOD: f64 = 3.0;

impl DeformationAnimation {
    /// Begins at a time \[s\].
    #[must_use]
    pub fn new(now: f64) -> Self {
        Self { since: now, part: 0.0 }
    }

    /// Goes on to where the factor is at a time.
    pub fn go_on(&mut self, now: f64) {
        let turns = (now - self.since) / PERIOD;
        self.part = 0.5 - 0.5 * (std::f64::consts::TAU * turns).cos();
    }

    /// The part of the whole factor.
    #[must_use]
    pub fn part(&self) -> f64 {
        self.part
    }

    /// The factor that is shown of a whole one.
    pub(crate) fn of(&self, whole: f64) -> Magnification {
        Magnification::Given(self.part * whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swing_goes_from_nothing_to_all_and_back() {
        let mut swing = DeformationAnimation::new(7.0);
        for (now, part) in [(7.0, 0.0), (7.0 + 0.25 * PERIOD, 0.5), (7.0 + 0.5 * PERIOD, 1.0)] {
            swing.go_on(now);
            assert!((swing.part() - part).abs() < 1e-12, "{now}");
        }
        swing.go_on(7.0 + PERIOD);
        assert!(swing.part() < 1e-12);
        swing.go_on(7.0 + 0.5 * PERIOD);
        assert_eq!(swing.of(40.0), Magnification::Given(40.0));
    }
}
