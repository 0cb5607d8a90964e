//! Symmetric block-sparse matrices over the patch graph.
//!
//! Block (i, j) couples the unknowns of patches i and j; it is there if the patches overlap. For K
//! = Kᵀ, only the blocks with i ≤ j are stored, diagonal blocks in full.
//!
//! **Unknowns of a patch are ordered component-major**: unknown `c · n_i + k` is component c of
//! function k, with n_i functions in patch i. So a block of a two-component problem is made of
//! 2 × 2 scalar blocks, each contiguous in function indices, on each of which the stable
//! transformation acts alike. Unknowns of the whole system run through the patches in order.

use faer::{MatMut, MatRef};

/// The pairs of coupled patches i ≤ j, row by row (CSR).
///
/// Row i holds `columns[starts[i] .. starts[i + 1]]`, ascending, and begins with i itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockPattern {
    starts: Vec<usize>,
    columns: Vec<u32>,
}

impl BlockPattern {
    /// The pattern with the given row starts [patches + 1] and columns.
    ///
    /// # Panics
    /// If a row does not begin with its diagonal block, or is not ascending, or leaves the range.
    #[must_use]
    pub fn new(starts: Vec<usize>, columns: Vec<u32>) -> Self {
        assert!(starts.first() == Some(&0) && starts.last() == Some(&columns.len()));
        let pattern = Self { starts, columns };
        for i in 0..pattern.len() {
            let row = pattern.row(i);
            assert!(row.first() == Some(&(i as u32)), "row {i} begins with its diagonal block");
            assert!(row.is_sorted_by(|a, b| a < b), "row {i} is ascending");
            assert!(row.iter().all(|&j| (j as usize) < pattern.len()), "row {i} is in range");
        }
        pattern
    }

    /// Number of patches.
    #[must_use]
    pub(crate) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Patches j ≥ i coupled to patch i, ascending, i first.
    #[must_use]
    pub fn row(&self, i: usize) -> &[u32] {
        &self.columns[self.starts[i]..self.starts[i + 1]]
    }

    /// Position of block (i, j) among all blocks.
    fn position(&self, i: usize, j: usize) -> Option<usize> {
        self.row(i).binary_search(&(j as u32)).ok().map(|k| self.starts[i] + k)
    }

    /// Row and column of every block, in the order of storage.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.len()).flat_map(|i| self.row(i).iter().map(move |&j| (i, j as usize)))
    }
}

/// A symmetric matrix of dense blocks; see the module's head for the order of the unknowns.
#[derive(Clone, Debug)]
pub struct BlockMatrix {
    pattern: BlockPattern,
    /// First unknown of each patch, and their number [patches + 1].
    offsets: Vec<usize>,
    /// Blocks in the order of the pattern, each row-major.
    values: Vec<f64>,
    /// First value of each block, and their number [blocks + 1].
    block_starts: Vec<usize>,
}

impl BlockMatrix {
    /// The zero matrix with `sizes[i]` unknowns in patch i and the blocks of `pattern`.
    ///
    /// # Panics
    /// If the numbers of patches differ.
    #[must_use]
    pub fn new(sizes: &[usize], pattern: BlockPattern) -> Self {
        assert_eq!(sizes.len(), pattern.len(), "one size a patch");
        let offsets = running_sum(sizes.iter().copied());
        let block_starts = running_sum(pattern.pairs().map(|(i, j)| sizes[i] * sizes[j]));
        let values = vec![0.0; block_starts[block_starts.len() - 1]];
        Self { pattern, offsets, values, block_starts }
    }

    /// Number of unknowns.
    #[must_use]
    pub fn n_unknowns(&self) -> usize {
        self.offsets[self.pattern.len()]
    }

    /// The blocks that are stored.
    pub(super) fn pattern(&self) -> &BlockPattern {
        &self.pattern
    }

    /// Number of patches.
    #[must_use]
    pub fn n_blocks(&self) -> usize {
        self.pattern.len()
    }

    /// Unknowns of patch i.
    #[must_use]
    pub fn unknowns(&self, i: usize) -> std::ops::Range<usize> {
        self.offsets[i]..self.offsets[i + 1]
    }

    /// The patch that unknown `u` belongs to.
    ///
    /// # Panics
    /// If there is no such unknown.
    #[must_use]
    pub(crate) fn patch_of(&self, u: usize) -> usize {
        assert!(u < self.n_unknowns(), "unknown {u} of {}", self.n_unknowns());
        self.offsets.partition_point(|&start| start <= u) - 1
    }

    /// Block (i, j) with i ≤ j, or nothing if the patches are not coupled.
    #[must_use]
    pub fn block(&self, i: usize, j: usize) -> Option<MatRef<'_, f64>> {
        let (rows, columns) = (self.unknowns(i).len(), self.unknowns(j).len());
        let place = self.pattern.position(i, j)?;
        Some(MatRef::from_row_major_slice(self.stored(place), rows, columns))
    }

    /// Adds `block` [unknowns of i × unknowns of j] to block (i, j), i ≤ j.
    ///
    /// The order of the additions decides the last bits of the sum: add in a fixed order.
    ///
    /// # Panics
    /// If i > j, the patches are not coupled, or the shape is wrong.
    pub fn add_block(&mut self, i: usize, j: usize, block: MatRef<'_, f64>) {
        let (rows, columns) = (self.unknowns(i).len(), self.unknowns(j).len());
        assert_eq!((block.nrows(), block.ncols()), (rows, columns), "shape of block ({i}, {j})");
        let k = self.pattern.position(i, j).expect("a block (i, j) of coupled patches, i ≤ j");
        let range = self.block_starts[k]..self.block_starts[k + 1];
        let mut sum = MatMut::from_row_major_slice_mut(&mut self.values[range], rows, columns);
        sum += block;
    }

    /// The values of the stored block `k`, row-major.
    pub(super) fn stored(&self, k: usize) -> &[f64] {
        &self.values[self.block_starts[k]..self.block_starts[k + 1]]
    }

    /// Number of values that are stored.
    pub(crate) fn n_values(&self) -> usize {
        self.values.len()
    }

    /// Bytes of the values and of their places.
    pub fn bytes(&self) -> usize {
        let places =
            size_of_val(self.block_starts.as_slice()) + size_of_val(self.offsets.as_slice());
        let pattern = &self.pattern;
        let pattern =
            size_of_val(pattern.columns.as_slice()) + size_of_val(pattern.starts.as_slice());
        size_of_val(self.values.as_slice()) + places + pattern
    }

    /// K x.
    ///
    /// # Panics
    /// If `x` has not one entry for each unknown.
    #[must_use]
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        assert_eq!(x.len(), self.n_unknowns(), "one entry for each unknown");
        let mut y = vec![0.0; x.len()];
        for (k, (i, j)) in self.pattern.pairs().enumerate() {
            let (rows, columns) = (self.unknowns(i), self.unknowns(j));
            for (a, entries) in rows.zip(self.stored(k).chunks_exact(columns.len().max(1))) {
                y[a] += entries.iter().zip(&x[columns.clone()]).map(|(k, x)| k * x).sum::<f64>();
                if i != j {
                    let x_a = x[a];
                    y[columns.clone()].iter_mut().zip(entries).for_each(|(y, k)| *y += k * x_a);
                }
            }
        }
        y
    }
}

/// 0, x₀, x₀ + x₁, …
pub(super) fn running_sum(sizes: impl Iterator<Item = usize>) -> Vec<usize> {
    let sums = sizes.scan(0, |sum, size| {
        *sum += size;
        Some(*sum)
    });
    std::iter::once(0).chain(sums).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;
    use ppum_testkit::random::Random;

    /// Patches 0–1–2 and 0–3 coupled, with different sizes, one of them empty.
    fn pattern() -> BlockPattern {
        BlockPattern::new(vec![0, 3, 5, 6, 7], vec![0, 1, 3, 1, 2, 2, 3])
    }

    /// A random matrix as blocks, and the same in full.
    fn random_matrix(sizes: &[usize]) -> (BlockMatrix, Mat<f64>) {
        let mut random = Random(11);
        let mut blocks = BlockMatrix::new(sizes, pattern());
        let mut full = Mat::zeros(blocks.n_unknowns(), blocks.n_unknowns());
        for (i, j) in pattern().pairs() {
            let mut block = Mat::from_fn(sizes[i], sizes[j], |_, _| random.between(-1.0, 1.0));
            if i == j {
                block = &block + block.transpose();
            }
            blocks.add_block(i, j, block.as_ref());
            let (rows, columns) = (blocks.unknowns(i), blocks.unknowns(j));
            for (a, row) in rows.clone().enumerate() {
                for (b, column) in columns.clone().enumerate() {
                    full[(row, column)] = block[(a, b)];
                    full[(column, row)] = block[(a, b)];
                }
            }
        }
        (blocks, full)
    }

    /// The matrix in full, read through its blocks.
    fn in_full(blocks: &BlockMatrix) -> Mat<f64> {
        let n = blocks.n_unknowns();
        Mat::from_fn(n, n, |row, column| {
            let (u, v) = (row.min(column), row.max(column));
            let (i, j) = (blocks.patch_of(u), blocks.patch_of(v));
            let (a, b) = (u - blocks.unknowns(i).start, v - blocks.unknowns(j).start);
            blocks.block(i, j).map_or(0.0, |block| block[(a, b)])
        })
    }

    #[test]
    fn the_product_agrees_with_the_full_matrix() {
        let (blocks, full) = random_matrix(&[3, 2, 0, 4]);
        assert_eq!(in_full(&blocks), full);
        let mut random = Random(5);
        let x: Vec<f64> = (0..9).map(|_| random.between(-1.0, 1.0)).collect();
        let expected = &full * Mat::from_fn(9, 1, |i, _| x[i]);
        for (i, y) in blocks.multiply(&x).into_iter().enumerate() {
            assert!((y - expected[(i, 0)]).abs() < 1e-14);
        }
    }

    #[test]
    fn blocks_add_up() {
        let (mut blocks, full) = random_matrix(&[3, 2, 1, 4]);
        let more = Mat::from_fn(3, 4, |i, j| (10 * i + j) as f64);
        blocks.add_block(0, 3, more.as_ref());
        let sum = in_full(&blocks);
        assert_eq!(sum[(1, 6 + 2)], full[(1, 6 + 2)] + 12.0);
        assert_eq!(sum[(6 + 3, 2)], full[(6 + 3, 2)] + 23.0);
        assert!(blocks.block(1, 3).is_none());
    }

    #[test]
    fn unknowns_and_patches_match() {
        let (blocks, _) = random_matrix(&[3, 2, 0, 4]);
        let patches: Vec<usize> = (0..9).map(|u| blocks.patch_of(u)).collect();
        assert_eq!(patches, [0, 0, 0, 1, 1, 3, 3, 3, 3]);
        assert_eq!(blocks.unknowns(2), 5..5);
    }

    #[test]
    #[should_panic(expected = "diagonal block")]
    fn a_row_without_its_diagonal_is_refused() {
        let _ = BlockPattern::new(vec![0, 1, 2], vec![1, 1]);
    }
}
