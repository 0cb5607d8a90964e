//! Reproducible random numbers for tests.

use crate::vec2::{Vec2, vec2};

/// A 64 bit linear congruential generator with Knuth's constants; the upper bits are used.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform in \[0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in \[0, 1)².
    pub(crate) fn point(&mut self) -> Vec2 {
        vec2(self.unit(), self.unit())
    }
}
