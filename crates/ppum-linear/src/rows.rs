//! All rows of a symmetric block matrix of which one half is stored, in an order that may be worked
//! on in parallel.
//!
//! Blocks get *colours* so that no two of a colour are coupled, greedily in their order: about four
//! on a uniform cover. Vectors hold the unknowns of the first colour, then those of the second, and
//! so on: a colour is one slice, and its blocks are parts of it that threads write to at the same
//! time. Values of a block depend on its row alone, so that results have the same bits on any
//! number of threads.

use super::block_matrix::{BlockMatrix, running_sum};
use super::neighbours::Neighbours;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::Range;

/// Blocks that one thread takes at a time: enough to hide what it costs to hand work to a thread,
/// few enough for all threads to have some on small levels.
const GRAIN: usize = 64;

/// A symmetric matrix by rows.
#[derive(Debug)]
pub(crate) struct SymmetricRows<'a> {
    pub(crate) matrix: Cow<'a, BlockMatrix>,
    neighbours: Neighbours,
    /// Blocks by colours, ascending in each.
    order: Vec<u32>,
    /// The colour of each block.
    colours: Vec<u32>,
    /// Where each colour begins in the order, and its end.
    colour_starts: Vec<usize>,
    /// Where the unknowns of the blocks of the order begin in vectors, and their end.
    offsets: Vec<usize>,
    /// The offset of the unknowns of each block in vectors.
    own: Vec<usize>,
}

/// The blocks of a row that a sum runs over, by the order of their colours to that of the row,
/// which is the colour of its own block alone.
pub(super) type BlockSubset = fn(Ordering) -> bool;

impl<'a> SymmetricRows<'a> {
    pub(crate) fn new(matrix: Cow<'a, BlockMatrix>) -> Self {
        let neighbours = Neighbours::new(matrix.pattern());
        let colours = colours(&neighbours);
        let n_colours = colours.iter().max().map_or(0, |most| *most as usize + 1);
        let mut order: Vec<u32> = (0..colours.len() as u32).collect();
        order.sort_by_key(|&block| colours[block as usize]);
        let first = |colour| order.partition_point(|&b| (colours[b as usize] as usize) < colour);
        let colour_starts = (0..=n_colours).map(first).collect();
        let offsets = running_sum(order.iter().map(|&b| matrix.unknowns(b as usize).len()));
        let mut own = vec![0; colours.len()];
        order.iter().zip(&offsets).for_each(|(&block, &start)| own[block as usize] = start);
        Self { matrix, neighbours, order, colours, colour_starts, offsets, own }
    }

    pub(crate) fn n_unknowns(&self) -> usize {
        self.matrix.n_unknowns()
    }

    pub(crate) fn n_blocks(&self) -> usize {
        self.order.len()
    }

    pub(super) fn n_colours(&self) -> usize {
        self.colour_starts.len() - 1
    }

    /// Bytes of the matrix and of its rows.
    pub(super) fn bytes(&self) -> usize {
        let lists = self.neighbours.bytes() + 4 * size_of_val(self.own.as_slice());
        self.matrix.bytes() + lists
    }

    /// The unknowns of a block in vectors.
    pub(super) fn unknowns(&self, block: usize) -> Range<usize> {
        let start = self.own[block];
        start..start + self.matrix.unknowns(block).len()
    }

    /// The unknowns of a colour in vectors.
    pub(super) fn of_colour(&self, colour: usize) -> Range<usize> {
        self.offsets[self.colour_starts[colour]]..self.offsets[self.colour_starts[colour + 1]]
    }

    /// A vector in the order of the matrix as one in this order.
    pub(crate) fn coloured(&self, x: &[f64]) -> Vec<f64> {
        let all = self.order.iter().map(|&block| &x[self.matrix.unknowns(block as usize)]);
        all.flatten().copied().collect()
    }

    /// The way back of [`SymmetricRows::coloured`].
    pub(crate) fn plain(&self, x: &[f64]) -> Vec<f64> {
        (0..self.n_blocks()).flat_map(|block| x[self.unknowns(block)].iter().copied()).collect()
    }

    /// The largest entry of the diagonal.
    pub(super) fn largest_diagonal(&self) -> f64 {
        let of = |i| {
            let block = self.matrix.block(i, i).expect("a block is coupled to itself");
            (0..block.nrows()).map(|k| block[(k, k)]).fold(0.0, f64::max)
        };
        (0..self.n_blocks()).map(of).fold(0.0, f64::max)
    }

    /// K x.
    pub(crate) fn multiply(&self, x: &[f64], out: &mut [f64]) {
        self.for_all(out, &|block, out| {
            out.fill(0.0);
            self.add_row(block, |_| true, &Vectors::whole(x), 1.0, out);
        });
    }

    /// Adds factor · Σ_j K_ij x_j over a part of row i.
    pub(super) fn add_row(
        &self,
        i: usize,
        subset: BlockSubset,
        x: &Vectors<'_>,
        factor: f64,
        out: &mut [f64],
    ) {
        let colour = self.colours[i];
        for entry in self.neighbours.of(i) {
            let j = entry.column as usize;
            if subset(self.colours[j].cmp(&colour)) {
                let (block, x) =
                    (self.matrix.stored(entry.stored as usize), x.at(self.unknowns(j)));
                if j < i {
                    add_transposed(block, x, factor, out);
                } else {
                    add_product(block, x, factor, out);
                }
            }
        }
    }

    /// The blocks that a block is coupled to, itself among them.
    pub(super) fn neighbours(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        self.neighbours.of(i).iter().map(|entry| entry.column as usize)
    }

    /// r_i ← (f − K x)_i
    pub(super) fn remainder(&self, i: usize, f: &[f64], x: &[f64], r: &mut [f64]) {
        let own = self.unknowns(i);
        r[own.clone()].copy_from_slice(&f[own.clone()]);
        self.add_row(i, |_| true, &Vectors::whole(x), -1.0, &mut r[own]);
    }

    /// Calls `work` with each block and its part of `out`, on all threads.
    pub(super) fn for_all(&self, out: &mut [f64], work: &(impl Fn(usize, &mut [f64]) + Sync)) {
        self.divide(0..self.n_blocks(), out, work);
    }

    /// Works on the blocks of a colour, `out` being its slice.
    pub(super) fn for_colour(
        &self,
        colour: usize,
        out: &mut [f64],
        work: &(impl Fn(usize, &mut [f64]) + Sync),
    ) {
        self.divide(self.colour_starts[colour]..self.colour_starts[colour + 1], out, work);
    }

    fn divide(
        &self,
        places: Range<usize>,
        mut out: &mut [f64],
        work: &(impl Fn(usize, &mut [f64]) + Sync),
    ) {
        if places.len() <= GRAIN {
            for place in places {
                let (own, rest) = out.split_at_mut(self.offsets[place + 1] - self.offsets[place]);
                work(self.order[place] as usize, own);
                out = rest;
            }
            return;
        }
        let middle = places.start + places.len() / 2;
        let (left, right) = out.split_at_mut(self.offsets[middle] - self.offsets[places.start]);
        rayon::join(
            || self.divide(places.start..middle, left, work),
            || self.divide(middle..places.end, right, work),
        );
    }
}

/// A vector of which a slice, its colour's, may be missing because it is written to.
pub(super) struct Vectors<'a> {
    before: &'a [f64],
    after: &'a [f64],
    /// Where the part behind the missing slice begins.
    resumes: usize,
}

impl<'a> Vectors<'a> {
    pub(super) fn whole(x: &'a [f64]) -> Self {
        Self { before: x, after: &[], resumes: x.len() }
    }

    /// A vector without a range, and the slice of the range.
    pub(super) fn without(x: &'a mut [f64], range: Range<usize>) -> (Self, &'a mut [f64]) {
        let (before, rest) = x.split_at_mut(range.start);
        let (own, after) = rest.split_at_mut(range.len());
        (Self { before, after, resumes: range.end }, own)
    }

    fn at(&self, range: Range<usize>) -> &'a [f64] {
        if range.start < self.resumes && range.end <= self.before.len() {
            &self.before[range]
        } else {
            &self.after[range.start - self.resumes..range.end - self.resumes]
        }
    }
}

/// out ← out + factor · B x, with the rows of B one after the other.
pub(super) fn add_product(block: &[f64], x: &[f64], factor: f64, out: &mut [f64]) {
    for (out, row) in out.iter_mut().zip(block.chunks_exact(x.len().max(1))) {
        *out += factor * dot(row, x);
    }
}

/// aᵀ b in four sums side by side, which the processor forms at once.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut sums, (a, b)) = ([0.0; 4], (a.chunks_exact(4), b.chunks_exact(4)));
    let rest = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum::<f64>();
    for (a, b) in a.zip(b) {
        (0..4).for_each(|k| sums[k] += a[k] * b[k]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// out ← out + factor · Bᵀ x.
pub(super) fn add_transposed(block: &[f64], x: &[f64], factor: f64, out: &mut [f64]) {
    for (x, row) in x.iter().zip(block.chunks_exact(out.len().max(1))) {
        let x = factor * x;
        out.iter_mut().zip(row).for_each(|(out, b)| *out += b * x);
    }
}

/// The smallest colour that no earlier neighbour has, block by block.
fn colours(neighbours: &Neighbours) -> Vec<u32> {
    let n = neighbours.len();
    let mut colours = vec![0; n];
    let mut taken = Vec::new();
    for i in 0..n {
        let earlier = neighbours.of(i).iter().take_while(|e| (e.column as usize) < i);
        taken.clear();
        taken.extend(earlier.map(|e| colours[e.column as usize]));
        taken.sort_unstable();
        taken.dedup();
        let free = (0..).zip(&taken).find(|(colour, taken)| colour != *taken);
        colours[i] = free.map_or(taken.len() as u32, |(colour, _)| colour);
    }
    colours
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_matrices::grid_matrix;
    use ppum_testkit::random::Random;

    #[test]
    fn no_two_of_a_colour_are_coupled_and_products_agree() {
        let matrix = grid_matrix(13, 9, &mut Random(5));
        let rows = SymmetricRows::new(Cow::Borrowed(&matrix));
        assert_eq!(rows.n_colours(), 4, "eight neighbours each");
        for (i, j) in matrix.pattern().pairs() {
            assert!(i == j || rows.colours[i] != rows.colours[j]);
        }
        let mut random = Random(7);
        let x: Vec<f64> = (0..matrix.n_unknowns()).map(|_| random.between(-1.0, 1.0)).collect();
        assert_eq!(rows.plain(&rows.coloured(&x)), x);
        let mut product = vec![f64::NAN; x.len()];
        rows.multiply(&rows.coloured(&x), &mut product);
        // sums of at most 45 products of numbers up to ten
        for (y, expected) in rows.plain(&product).iter().zip(matrix.multiply(&x)) {
            assert!((y - expected).abs() < 1e-12);
        }
    }
}
