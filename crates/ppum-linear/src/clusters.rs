//! Clusters: blocks of a matrix that nearly depend on each other, so that relaxing one at a time
//! does not solve them.
//!
//! ```text
//! cos² = the largest eigenvalue of K_ii⁻¹ K_ij K_jj⁻¹ K_ji
//! ```
//!
//! is one if a function of block i is one of block j: sweeps part the two at a rate of cos², and
//! coarser levels have nothing like them. A cluster is a group of blocks that such pairs tie
//! together. The remaining residual there is solved for at once, after the forward sweep and before
//! the backward sweep.

use super::block_matrix::{BlockMatrix, running_sum};
use super::dense::product;
use super::eigen::SymmetricEigen;
use super::inverse::inverse;
use super::rows::{SymmetricRows, add_product};
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use rayon::prelude::*;

/// cos² from which on a pair is a cluster: sweeps one by one would take twenty to reduce what is
/// between them to a third. Ordinary neighbours have less, also at tips; pairs at junctions that
/// make steps grow have 0.95 to 0.9995.
const NEAR: f64 = 0.9;

/// Unknowns of a cluster that are factorised in less time than a level is swept; pairs that would
/// make it larger stay apart.
const LARGEST: usize = 1_000;

/// Blocks that are solved for together.
#[derive(Debug)]
pub(super) struct StrongCluster {
    blocks: Vec<usize>,
    /// The inverse of their part of the matrix, row-major.
    inverse: Vec<f64>,
    /// The blocks that they are coupled to, themselves among them.
    around: Vec<usize>,
}

impl StrongCluster {
    /// x ← x + A⁻¹ r with the part A of the matrix and the part r of `rest`, the residual of x,
    /// which is renewed.
    pub(super) fn relax(
        &self,
        rows: &SymmetricRows<'_>,
        f: &[f64],
        x: &mut [f64],
        rest: &mut [f64],
    ) {
        self.correct(rows, rest, x);
        for &i in &self.around {
            rows.remainder(i, f, x, rest);
        }
    }

    /// Relaxes without a residual, which is neither known nor needed.
    pub(super) fn relax_alone(
        &self,
        rows: &SymmetricRows<'_>,
        f: &[f64],
        x: &mut [f64],
        rest: &mut [f64],
    ) {
        for &i in &self.blocks {
            rows.remainder(i, f, x, rest);
        }
        self.correct(rows, rest, x);
    }

    fn correct(&self, rows: &SymmetricRows<'_>, rest: &[f64], x: &mut [f64]) {
        let own: Vec<f64> =
            self.blocks.iter().flat_map(|&i| rest[rows.unknowns(i)].iter().copied()).collect();
        let mut correction = vec![0.0; own.len()];
        add_product(&self.inverse, &own, 1.0, &mut correction);
        let mut left = correction.as_slice();
        for &i in &self.blocks {
            let (part, others) = left.split_at(rows.unknowns(i).len());
            x[rows.unknowns(i)].iter_mut().zip(part).for_each(|(x, part)| *x += part);
            left = others;
        }
    }

    /// Bytes of the inverse.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.inverse.as_slice())
    }
}

/// The clusters of a matrix, in the order of their first blocks.
pub(super) fn clusters(rows: &SymmetricRows<'_>) -> Vec<StrongCluster> {
    let groups = groups(&rows.matrix, &near_pairs(&rows.matrix));
    groups.into_iter().map(|blocks| cluster(rows, blocks)).collect()
}

fn cluster(rows: &SymmetricRows<'_>, blocks: Vec<usize>) -> StrongCluster {
    let mut around: Vec<usize> = blocks.iter().flat_map(|&i| rows.neighbours(i)).collect();
    around.sort_unstable();
    around.dedup();
    StrongCluster { inverse: inverse(part(&rows.matrix, &blocks).as_ref()), around, blocks }
}

/// The part of the matrix that belongs to some blocks, ascending.
fn part(matrix: &BlockMatrix, blocks: &[usize]) -> Mat<f64> {
    let starts = running_sum(blocks.iter().map(|&i| matrix.unknowns(i).len()));
    let n = starts[blocks.len()];
    let mut all = Mat::zeros(n, n);
    for (a, &i) in blocks.iter().enumerate() {
        for (b, &j) in blocks.iter().enumerate().skip(a) {
            let Some(block) = matrix.block(i, j) else { continue };
            let (n, m) = (block.nrows(), block.ncols());
            all.submatrix_mut(starts[a], starts[b], n, m).copy_from(block);
            all.submatrix_mut(starts[b], starts[a], m, n).copy_from(block.transpose());
        }
    }
    all
}

/// Pairs of blocks with cos² above [`NEAR`], the nearest first. Blocks that have no more unknowns
/// than the smallest one are not tested: they are all alike, and far from depending on each other.
fn near_pairs(matrix: &BlockMatrix) -> Vec<(f64, usize, usize)> {
    let size = |i: usize| matrix.unknowns(i).len();
    let least = (0..matrix.n_blocks()).map(size).min().unwrap_or(0);
    let is_large = |&(i, j): &(usize, usize)| i != j && size(i) > least && size(j) > least;
    let pairs: Vec<_> = matrix.pattern().pairs().filter(is_large).collect();
    let cosine = |&(i, j): &(usize, usize)| (cosine(matrix, i, j).unwrap_or(0.0), i, j);
    let mut found: Vec<_> =
        pairs.par_iter().map(cosine).filter(|(cosine, ..)| *cosine > NEAR).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    found
}

/// cos² of two blocks; none of blocks that are not definite.
fn cosine(matrix: &BlockMatrix, i: usize, j: usize) -> Option<f64> {
    let [own, other] = [i, j].map(|k| matrix.block(k, k).map(|b| b.llt(Side::Lower).ok()));
    let (own, other) = (own??, other??);
    let between = matrix.block(i, j)?.to_owned();
    let right = other.solve(between.transpose());
    let all = own.solve(product(between.as_ref(), right.as_ref()));
    // similar to a symmetric matrix: Lᵀ (…) L⁻ᵀ
    let l = own.L();
    let turned = product(l.transpose(), all.as_ref());
    let turned = l.partial_piv_lu().solve(turned.transpose());
    let symmetric = (&turned + turned.transpose()) * faer::Scale(0.5);
    SymmetricEigen::new(symmetric.as_ref()).ok()?.values.first().copied()
}

/// Blocks that pairs tie together, each group ascending.
fn groups(matrix: &BlockMatrix, pairs: &[(f64, usize, usize)]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for &(_, i, j) in pairs {
        let known = groups.iter().filter(|g| g.contains(&i) || g.contains(&j));
        let mut united: Vec<usize> = known.flatten().copied().chain([i, j]).collect();
        united.sort_unstable();
        united.dedup();
        if united.iter().map(|&k| matrix.unknowns(k).len()).sum::<usize>() > LARGEST {
            continue;
        }
        groups.retain(|g| !g.contains(&i) && !g.contains(&j));
        groups.push(united);
    }
    groups.sort();
    groups
}

#[cfg(test)]
mod tests {
    use super::super::block_matrix::BlockPattern;
    use super::super::conjugate::dot;
    use super::super::smoother::Smoother;
    use super::*;
    use ppum_testkit::random::Random;
    use std::borrow::Cow;

    /// Blocks of 1, 2, 3, 3, 2 and 1 unknowns in a row, each coupled to the next by a matrix of
    /// norm 0.4, but 2 and 3 by the diagonal c, ½, 0 beside unit matrices: their cosine is c.
    fn chain(c: f64) -> BlockMatrix {
        let sizes = [1, 2, 3, 3, 2, 1];
        let pattern =
            BlockPattern::new(vec![0, 2, 4, 6, 8, 10, 11], vec![0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
        let mut matrix = BlockMatrix::new(&sizes, pattern);
        for (i, n) in sizes.into_iter().enumerate() {
            let own = if i == 2 || i == 3 { 1.0 } else { 2.0 };
            matrix.add_block(i, i, (Mat::<f64>::identity(n, n) * faer::Scale(own)).as_ref());
            let Some(&m) = sizes.get(i + 1) else { continue };
            let between = Mat::from_fn(n, m, |a, b| match (i, a == b) {
                (2, true) => [c, 0.5, 0.0][a],
                (2, false) => 0.0,
                // away from the third function of the middle blocks, which is nearly used up
                (_, true) if a < 2 => 0.01,
                _ => 0.0,
            });
            matrix.add_block(i, i + 1, between.as_ref());
        }
        matrix
    }

    #[test]
    fn cosines_are_those_of_the_functions() {
        for c in [0.0, 0.5, 0.96, 1.0 - 1e-9] {
            let matrix = chain(c);
            let expected = c.max(0.5).powi(2);
            let found = cosine(&matrix, 2, 3).expect("definite blocks");
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        }
        assert!(near_pairs(&chain(0.9)).is_empty(), "0.81");
        let rows = chain(0.96);
        let found = clusters(&SymmetricRows::new(Cow::Borrowed(&rows)));
        assert_eq!(found.len(), 1);
        assert_eq!((&found[0].blocks[..], &found[0].around[..]), (&[2, 3][..], &[1, 2, 3, 4][..]));
    }

    /// Pairs with a block in common are one cluster, unless it would be too large.
    #[test]
    fn pairs_come_together() {
        let pattern = BlockPattern::new((0..=5).collect(), (0..5).collect());
        let small = BlockMatrix::new(&[2; 5], pattern.clone());
        let pairs = [(0.99, 3, 4), (0.98, 0, 1), (0.95, 1, 3)];
        assert_eq!(groups(&small, &pairs), [vec![0, 1, 3, 4]]);
        let large = BlockMatrix::new(&[LARGEST / 3; 5], pattern);
        assert_eq!(groups(&large, &pairs), [vec![0, 1], vec![3, 4]]);
    }

    /// Smoothing forward and back is symmetric with clusters too, and parts nearly dependent
    /// blocks, which sweeps alone do not.
    #[test]
    fn clusters_part_what_sweeps_do_not() {
        let left = |c: f64, with_clusters: bool| {
            let matrix = chain(c);
            let mut smoother = Smoother::new(SymmetricRows::new(Cow::Borrowed(&matrix)));
            if !with_clusters {
                smoother.forget_clusters();
            }
            let m = |f: &[f64]| {
                let (mut x, rest) = smoother.before(f);
                smoother.after(f, &mut x, rest);
                x
            };
            let mut random = Random(5);
            let mut vector = || (0..12).map(|_| random.between(-1.0, 1.0)).collect::<Vec<f64>>();
            let (f, g) = (vector(), vector());
            assert!((dot(&f, &m(&g)) - dot(&g, &m(&f))).abs() < 1e-9 * dot(&f, &m(&f)).abs());
            // the error of the vector of which blocks 2 and 3 have opposite parts: its energy is 2
            // (1 − c)
            let mut x = vec![0.0; 12];
            let [one, other] = [2, 3].map(|i| smoother.rows.unknowns(i).start);
            (x[one], x[other]) = (1.0, -1.0);
            let mut load = vec![0.0; 12];
            smoother.rows.multiply(&x, &mut load);
            let apart: f64 = m(&load).iter().zip(&x).map(|(a, b)| (a - b).powi(2)).sum();
            (apart / dot(&x, &x)).sqrt()
        };
        let (with, without) = (left(0.99, true), left(0.99, false));
        assert!(with < 0.05 && without > 0.85, "{with} {without}");
    }
}
