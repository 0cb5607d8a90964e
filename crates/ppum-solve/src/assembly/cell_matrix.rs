//! The symmetric matrix of a cell, in blocks of pairs of patches.

use faer::{MatMut, MatRef};
use std::borrow::Cow;
use std::ops::Range;

/// A symmetric matrix over the unknowns of some patches: the blocks of patches k ≤ l, each
/// row-major, in the order (0, 0), (0, 1), (1, 1), (0, 2), …; those of patches that do not overlap
/// are left out.
#[derive(Clone, Debug)]
pub(super) struct CellMatrix {
    /// Unknowns of each patch.
    sizes: Vec<usize>,
    /// First value of each block, and the number of all at the end.
    starts: Vec<usize>,
    values: Vec<f64>,
}

impl CellMatrix {
    /// Zero, for patches with so many unknowns, in the memory of an earlier one.
    pub(super) fn new(
        sizes: impl Iterator<Item = usize>,
        overlap: impl Fn(usize, usize) -> bool,
        mut values: Vec<f64>,
    ) -> Self {
        let (sizes, mut starts): (Vec<usize>, _) = (sizes.collect(), vec![0]);
        for l in 0..sizes.len() {
            for k in 0..=l {
                let length = if overlap(k, l) { sizes[k] * sizes[l] } else { 0 };
                starts.push(starts[starts.len() - 1] + length);
            }
        }
        values.clear();
        values.resize(starts[starts.len() - 1], 0.0);
        Self { values, sizes, starts }
    }

    /// Its memory, for the next one.
    pub(super) fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// The values of the block of patches k ≤ l.
    fn range(&self, k: usize, l: usize) -> Range<usize> {
        assert!(k <= l, "the block of patches {l} and {k} is that of {k} and {l}, transposed");
        let at = l * (l + 1) / 2 + k;
        self.starts[at]..self.starts[at + 1]
    }

    /// The unknowns of patch k with those of patch l.
    pub(super) fn block(&self, k: usize, l: usize) -> MatRef<'_, f64> {
        if k > l {
            return self.block(l, k).transpose();
        }
        let values = &self.values[self.range(k, l)];
        MatRef::from_row_major_slice(values, self.sizes[k], self.sizes[l])
    }

    /// The unknowns of patch k with those of patch l ≥ k.
    pub(super) fn block_mut(&mut self, k: usize, l: usize) -> MatMut<'_, f64> {
        let range = self.range(k, l);
        let values = &mut self.values[range];
        MatMut::from_row_major_slice_mut(values, self.sizes[k], self.sizes[l])
    }

    /// A row of the block of patches k ≤ l.
    pub(super) fn row_mut(&mut self, [k, l]: [usize; 2], row: usize) -> &mut [f64] {
        let (first, columns) = (self.range(k, l).start, self.sizes[l]);
        &mut self.values[first + row * columns..first + (row + 1) * columns]
    }
}

/// The stiffness of a cell: a matrix over its patches in some order.
#[derive(Clone, Debug)]
pub(super) struct Stiffness<'a> {
    pub(super) matrix: Cow<'a, CellMatrix>,
    /// The place of each patch of the cell in that order; none if it is their own.
    pub(super) seats: Option<Vec<usize>>,
}

impl Stiffness<'_> {
    /// The unknowns of patch k of the cell with those of patch l, which does not come before it.
    pub(super) fn block(&self, k: usize, l: usize) -> MatRef<'_, f64> {
        match &self.seats {
            Some(seats) => self.matrix.block(seats[k], seats[l]),
            None => self.matrix.block(k, l),
        }
    }
}
