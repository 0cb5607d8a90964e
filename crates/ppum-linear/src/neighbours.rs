//! All blocks of the rows of a symmetric block matrix of which one half is stored.

use super::block_matrix::{BlockPattern, running_sum};

/// A block of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbour {
    pub(super) column: u32,
    /// Its place among the stored blocks; left of the diagonal it is the transposed one.
    pub(super) stored: u32,
}

/// The blocks of all rows.
#[derive(Debug)]
pub(super) struct Neighbours {
    starts: Vec<usize>,
    blocks: Vec<Neighbour>,
}

impl Neighbours {
    pub(super) fn new(pattern: &BlockPattern) -> Self {
        let n = pattern.len();
        let mut counts = vec![0; n];
        for (i, j) in pattern.pairs() {
            counts[i] += 1;
            counts[j] += usize::from(i != j);
        }
        let starts = running_sum(counts.into_iter());
        let mut next = starts.clone();
        let mut blocks = vec![Neighbour { column: 0, stored: 0 }; starts[n]];
        let mut put = |row: usize, column: usize, stored: usize| {
            blocks[next[row]] = Neighbour { column: column as u32, stored: stored as u32 };
            next[row] += 1;
        };
        // rows ascend, so what is left of a diagonal comes before what is right of it
        let pairs = || pattern.pairs().enumerate();
        pairs().filter(|(_, (i, j))| i != j).for_each(|(stored, (i, j))| put(j, i, stored));
        pairs().for_each(|(stored, (i, j))| put(i, j, stored));
        Self { starts, blocks }
    }

    /// Number of rows.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The blocks of a row, those left of the diagonal first; each part ascends.
    pub(super) fn of(&self, i: usize) -> &[Neighbour] {
        &self.blocks[self.starts[i]..self.starts[i + 1]]
    }

    /// Bytes of the lists.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.blocks.as_slice())
    }
}
