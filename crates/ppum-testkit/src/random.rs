//! Reproducible random numbers.

use ppum::vec2::{Rect, Vec2, vec2};

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine. The field is the seed.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in \[a, b).
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in 0 .. n; n > 0.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// One of some values; not none.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// Uniform in \[0, 1).
    pub fn unit(&mut self) -> f64 {
        self.between(0.0, 1.0)
    }

    /// Uniform in a box.
    pub fn point(&mut self, b: &Rect) -> Vec2 {
        vec2(self.between(b.min.x, b.max.x), self.between(b.min.y, b.max.y))
    }

    /// A direction.
    pub fn direction(&mut self) -> Vec2 {
        let (s, c) = self.between(0.0, std::f64::consts::TAU).sin_cos();
        vec2(c, s)
    }
}
