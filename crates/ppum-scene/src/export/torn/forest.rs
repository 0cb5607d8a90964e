//! Sets of numbers that are joined one by one.

/// Each number leads to a smaller one of its set, the smallest to itself.
pub(super) struct Forest(Vec<u32>);

impl Forest {
    /// Each number below a count in a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The smallest number of a set.
    pub(super) fn root(&self, mut number: usize) -> usize {
        while self.0[number] as usize != number {
            number = self.0[number] as usize;
        }
        number
    }

    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
