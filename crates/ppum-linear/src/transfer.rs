//! Vectors between the levels: each block of a fine level takes its values from one block of the
//! coarse level.

use super::rows::{SymmetricRows, add_product, add_transposed};
use faer::Mat;

/// The prolongation P from a coarse level, block-diagonal: x_i = (I ⊗ B_i) y_k with the parent k of
/// block i, the unit matrix having as many rows as components are interpolated alike.
#[derive(Clone, Debug, Default)]
pub struct Transfer {
    parents: Vec<Option<u32>>,
    repeats: Vec<u8>,
    /// B_i, block after block, row-major.
    values: Vec<f64>,
    starts: Vec<usize>,
    /// The children of each coarse block.
    children: Vec<Vec<u32>>,
}

impl Transfer {
    /// A transfer from so many coarse blocks, without fine blocks yet.
    pub fn from_blocks(n: usize) -> Self {
        Self { children: vec![Vec::new(); n], starts: vec![0], ..Self::default() }
    }

    /// Adds the next fine block: its parent with B, and how often B stands on the diagonal; or
    /// none, and it stays zero.
    pub fn push(&mut self, from: Option<(u32, &Mat<f64>, u8)>) {
        let block = self.parents.len() as u32;
        self.parents.push(from.map(|(parent, ..)| parent));
        self.repeats.push(from.map_or(1, |(.., repeat)| repeat));
        if let Some((parent, matrix, _)) = from {
            self.children[parent as usize].push(block);
            self.values
                .extend(matrix.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()));
        }
        self.starts.push(self.values.len());
    }

    /// Bytes of all.
    pub(super) fn bytes(&self) -> usize {
        let per_block = 2 * size_of::<usize>() + size_of::<Vec<u32>>();
        size_of_val(self.values.as_slice()) + per_block * self.parents.len()
    }

    /// x ← x + P y
    pub(super) fn add_prolonged(
        &self,
        (from, y): (&SymmetricRows<'_>, &[f64]),
        to: &SymmetricRows<'_>,
        x: &mut [f64],
    ) {
        to.for_all(x, &|i, x| {
            let Some(parent) = self.parents[i] else { return };
            let (y, repeat) = (&y[from.unknowns(parent as usize)], self.repeats[i].into());
            let own = x.chunks_mut(width(x.len(), repeat));
            for (x, y) in own.zip(y.chunks(width(y.len(), repeat))) {
                add_product(self.block(i), y, 1.0, x);
            }
        });
    }

    /// Pᵀ r
    pub(super) fn restricted(
        &self,
        (from, r): (&SymmetricRows<'_>, &[f64]),
        to: &SymmetricRows<'_>,
    ) -> Vec<f64> {
        let mut y = vec![0.0; to.n_unknowns()];
        to.for_all(&mut y, &|k, y| {
            for &child in &self.children[k] {
                let i = child as usize;
                let (r, repeat) = (&r[from.unknowns(i)], self.repeats[i].into());
                let own = y.chunks_mut(width(y.len(), repeat));
                for (r, y) in r.chunks(width(r.len(), repeat)).zip(own) {
                    add_transposed(self.block(i), r, 1.0, y);
                }
            }
        });
        y
    }

    fn block(&self, i: usize) -> &[f64] {
        &self.values[self.starts[i]..self.starts[i + 1]]
    }
}

fn width(len: usize, repeat: usize) -> usize {
    (len / repeat).max(1)
}
