//! Sums over the intervals of a line that sweeps over the plane, of which the largest is known.

/// Sums over the intervals of a line: a tree whose nodes know what was added to all below them, and
/// the largest sum there.
pub(super) struct IntervalSums {
    leaves: usize,
    added: Vec<i64>,
    most: Vec<i64>,
}

impl IntervalSums {
    pub(super) fn new(intervals: usize) -> Self {
        let leaves = intervals.next_power_of_two();
        Self { leaves, added: vec![0; 2 * leaves], most: vec![0; 2 * leaves] }
    }

    /// Adds to the intervals from one to another, which is not among them.
    pub(super) fn add(&mut self, from: usize, to: usize, work: i64) {
        let (mut low, mut high) = (from + self.leaves, to + self.leaves);
        let ends = [low, high.saturating_sub(1)];
        while low < high {
            if low % 2 == 1 {
                self.put(low, work);
                low += 1;
            }
            if high % 2 == 1 {
                high -= 1;
                self.put(high, work);
            }
            (low, high) = (low / 2, high / 2);
        }
        ends.into_iter().for_each(|leaf| self.pull_up(leaf));
    }

    fn put(&mut self, node: usize, work: i64) {
        self.added[node] += work;
        self.most[node] += work;
    }

    /// Forms the sums of the nodes above a leaf again.
    fn pull_up(&mut self, leaf: usize) {
        let mut node = leaf / 2;
        while node > 0 {
            let below = self.most[2 * node].max(self.most[2 * node + 1]);
            self.most[node] = self.added[node] + below;
            node /= 2;
        }
    }

    /// The largest sum.
    pub(super) fn most(&self) -> i64 {
        self.most[1]
    }

    /// The interval with the largest sum.
    pub(super) fn place(&self) -> usize {
        let mut node = 1;
        while node < self.leaves {
            node = 2 * node + usize::from(self.most[2 * node + 1] > self.most[2 * node]);
        }
        node - self.leaves
    }
}
