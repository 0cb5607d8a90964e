//! The factor L L^T of a symmetric block matrix, front by front.
//!
//! A front holds the columns of its pivots with what earlier fronts have left there, eliminates
//! them as a dense matrix, and hands on what that leaves to its parent (the multifrontal method of
//! Duff & Reid 1983). Threads take subtrees, and panels of large fronts. The values of a panel are
//! computed in one order, so that results have the same bits on any number of threads.

use super::block_matrix::BlockMatrix;
use super::elimination::Elimination;
use super::front::{Front, RowRun, split_at_ranges};
use super::neighbours::Neighbours;
use super::panel::{FactorFailure, FrontPanel, ZeroPivotPolicy};
use rayon::prelude::*;
use std::ops::Range;

/// Columns of a panel: wide enough for fast products, narrow enough that all threads have some.
const WIDTH: usize = 128;

/// Operations from which on threads share a front.
const SHARED: usize = 1 << 22;

/// The factor of a matrix.
#[derive(Debug)]
pub(super) struct CholeskyFactor {
    pub(super) elimination: Elimination,
    /// The columns of the pivots of each front.
    pub(super) panels: Vec<Vec<FrontPanel>>,
}

/// A matrix that is to be factorised, and how.
struct FactorInput<'m> {
    matrix: &'m BlockMatrix,
    neighbours: Neighbours,
    /// D
    scale: &'m [f64],
    elimination: &'m Elimination,
    vanishing: ZeroPivotPolicy,
}

/// The contribution block of a child, and its rows in the parent.
type ContributionBlock<'e> = (&'e [RowRun], Vec<FrontPanel>);

/// The result of a front: the columns of its pivots, and its contribution block until the parent
/// takes that.
#[derive(Debug, Default)]
struct FactoredFront {
    pivots: Vec<FrontPanel>,
    below: Vec<FrontPanel>,
}

impl CholeskyFactor {
    /// The factor of D K D; unknowns of pivots that vanish are left out.
    pub(super) fn new(
        matrix: &BlockMatrix,
        scale: &[f64],
        elimination: Elimination,
    ) -> Result<Self, FactorFailure> {
        let neighbours = Neighbours::new(matrix.pattern());
        let vanishing = ZeroPivotPolicy::Refused;
        let source =
            FactorInput { matrix, neighbours, scale, elimination: &elimination, vanishing };
        let panels = match source.factor() {
            Err(FactorFailure::Pivot) => {
                FactorInput { vanishing: ZeroPivotPolicy::LeftOut, ..source }.factor()?
            }
            other => other?,
        };
        Ok(Self { elimination, panels })
    }

    /// Bytes of the values.
    pub(super) fn bytes(&self) -> usize {
        self.panels.iter().flatten().map(FrontPanel::bytes).sum()
    }

    /// The unknowns of a matrix in the order of elimination.
    pub(super) fn order(&self, matrix: &BlockMatrix) -> Vec<usize> {
        self.elimination.order.iter().flat_map(|&block| matrix.unknowns(block as usize)).collect()
    }

    /// The pivots L_kk in that order.
    pub(super) fn pivots(&self) -> impl Iterator<Item = f64> {
        self.panels.iter().flatten().flat_map(FrontPanel::diagonal)
    }
}

impl FactorInput<'_> {
    fn factor(&self) -> Result<Vec<Vec<FrontPanel>>, FactorFailure> {
        let Elimination { fronts, subtrees, .. } = self.elimination;
        let mut done: Vec<FactoredFront> = Vec::new();
        done.resize_with(fronts.len(), FactoredFront::default);
        let parts = split_at_ranges(&mut done, subtrees);
        let of_subtree = |(range, part): (&Range<usize>, &mut [FactoredFront])| {
            range.clone().try_for_each(|front| self.eliminate(front, part, range.start))
        };
        subtrees.par_iter().zip(parts).with_max_len(1).try_for_each(of_subtree)?;
        self.elimination.top().try_for_each(|front| self.eliminate(front, &mut done, 0))?;
        Ok(done.into_iter().map(|front| front.pivots).collect())
    }

    /// Eliminates a front. Those of its subtree are done, the first of them with the
    /// number `first`.
    fn eliminate(
        &self,
        number: usize,
        done: &mut [FactoredFront],
        first: usize,
    ) -> Result<(), FactorFailure> {
        let front = &self.elimination.fronts[number];
        let of_child = |&child: &usize| {
            let runs = self.elimination.fronts[child].runs.as_slice();
            (runs, std::mem::take(&mut done[child - first].below))
        };
        let left: Vec<_> = front.children.iter().map(of_child).collect();
        let shared = front.rows() * front.rows() * front.n_pivots() > SHARED;
        let least = if shared { 1 } else { usize::MAX };
        let mut panels = self.gather(front, &left, least)?;
        drop(left);
        let n_panels = panels.partition_point(|panel| panel.first < front.n_pivots());
        for k in 0..n_panels {
            let (before, after) = panels.split_at_mut(k + 1);
            let own = &mut before[k];
            own.eliminate(self.vanishing, shared)?;
            let after = after.par_iter_mut().with_max_len(1).with_min_len(least);
            after.for_each(|panel| panel.subtract(own));
        }
        let mut below = panels.split_off(n_panels);
        below.iter_mut().for_each(|panel| panel.first -= front.n_pivots());
        done[number - first] = FactoredFront { pivots: panels, below };
        Ok(())
    }

    /// The panels of a front: entries of the matrix, and what the children have left. A thread
    /// takes so many at least.
    fn gather(
        &self,
        front: &Front,
        left: &[ContributionBlock<'_>],
        least: usize,
    ) -> Result<Vec<FrontPanel>, FactorFailure> {
        let panel = |blocks: &Range<usize>| -> Result<FrontPanel, FactorFailure> {
            let [from, to] = [blocks.start, blocks.end].map(|block| front.starts[block]);
            let mut panel = FrontPanel::new(from, to - from, front.rows())?;
            if from < front.n_pivots() {
                self.add_entries(front, blocks.clone(), &mut panel);
            }
            left.iter().for_each(|(runs, panels)| add(&mut panel, runs, panels));
            Ok(panel)
        };
        front.panels(WIDTH).par_iter().with_max_len(1).with_min_len(least).map(panel).collect()
    }

    /// Adds the matrix's own entries in the columns of some pivots.
    fn add_entries(&self, front: &Front, blocks: Range<usize>, panel: &mut FrontPanel) {
        let Elimination { order, places, .. } = self.elimination;
        for local in blocks {
            let place = front.pivots.start + local;
            let i = order[place] as usize;
            let columns = self.matrix.unknowns(i);
            for entry in self.neighbours.of(i) {
                let j = entry.column as usize;
                let other = places[j] as usize;
                if other < place {
                    continue;
                }
                let rows = self.matrix.unknowns(j);
                let values = self.matrix.stored(entry.stored as usize);
                let (down, right) = if i <= j { (1, rows.len()) } else { (columns.len(), 1) };
                let row = front.starts[front.local(other)];
                for (a, u) in columns.clone().enumerate() {
                    let out = panel.column_mut(front.starts[local] + a, row);
                    for (b, (v, out)) in rows.clone().zip(out).enumerate() {
                        *out = values[a * right + b * down] * (self.scale[u] * self.scale[v]);
                    }
                }
            }
        }
    }
}

/// Adds what a child has left to a panel of its parent.
fn add(panel: &mut FrontPanel, runs: &[RowRun], left: &[FrontPanel]) {
    let columns = panel.first..panel.end();
    for part in left {
        let mut number = runs.partition_point(|run| run.end() <= part.first);
        for column in part.first..part.end() {
            number += usize::from(runs[number].end() <= column);
            let to = runs[number].to + column - runs[number].from;
            if !columns.contains(&to) {
                continue;
            }
            for run in &runs[number..] {
                let from = run.from.max(column);
                let source = &part.column(column, from)[..run.end() - from];
                let out = panel.column_mut(to, run.to + from - run.from);
                out.iter_mut().zip(source).for_each(|(out, x)| *out += x);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::test_matrices::grid_matrix;
    use crate::{BlockMatrix, BlockPattern, Cholesky, LinearSolver};
    use faer::Mat;
    use faer::linalg::solvers::Solve;
    use ppum_testkit::random::Random;

    /// Blocks of 90 unknowns, all coupled: one front in several panels, which threads share.
    fn dense(blocks: usize, random: &mut Random) -> BlockMatrix {
        let starts = (0..=blocks).scan(0, |sum, i| {
            let start = *sum;
            *sum += blocks - i;
            Some(start)
        });
        let columns = (0..blocks as u32).flat_map(|i| i..blocks as u32).collect();
        let pattern = BlockPattern::new(starts.collect(), columns);
        let mut matrix = BlockMatrix::new(&vec![90; blocks], pattern);
        for i in 0..blocks {
            for j in i..blocks {
                let mut block = Mat::from_fn(90, 90, |_, _| random.between(-1.0, 1.0));
                if i == j {
                    let shift = Mat::<f64>::identity(90, 90) * faer::Scale(600.0);
                    block = &block + block.transpose() + shift;
                }
                matrix.add_block(i, j, block.as_ref());
            }
        }
        matrix
    }

    fn in_full(matrix: &BlockMatrix) -> Mat<f64> {
        let n = matrix.n_unknowns();
        let mut full = Mat::zeros(n, n);
        let mut unit = vec![0.0; n];
        for k in 0..n {
            unit[k] = 1.0;
            full.col_mut(k).iter_mut().zip(matrix.multiply(&unit)).for_each(|(a, b)| *a = b);
            unit[k] = 0.0;
        }
        full
    }

    /// The dense factorisation is the reference, for several right-hand sides at once.
    #[test]
    fn solutions_are_those_of_the_full_matrix() {
        let mut random = Random(21);
        for matrix in [grid_matrix(9, 31, &mut random), dense(5, &mut random)] {
            let n = matrix.n_unknowns();
            let mut load = || (0..n).map(|_| random.between(-1.0, 1.0)).collect::<Vec<f64>>();
            let loads = [load(), load(), load()];
            let full = in_full(&matrix);
            let exact = full.partial_piv_lu().solve(Mat::from_fn(n, 3, |u, k| loads[k][u]));
            let found = Cholesky::new(&matrix).unwrap().solve_roughly(&loads).unwrap();
            let largest = exact.norm_max();
            for (k, found) in found.iter().enumerate() {
                for (u, x) in found.iter().enumerate() {
                    assert!((x - exact[(u, k)]).abs() < 1e-13 * largest);
                }
            }
        }
    }

    /// Strips of a front that threads share have the same bits on any number of them.
    #[test]
    fn shared_fronts_do_not_depend_on_the_number_of_threads() {
        let matrix = dense(6, &mut Random(4));
        let load: Vec<f64> = (0..matrix.n_unknowns()).map(|u| (u as f64).cos()).collect();
        let solve_with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Cholesky::new(&matrix).unwrap().solve(&load).unwrap().unknowns)
        };
        let alone = solve_with(1);
        assert_eq!(alone, solve_with(2));
        assert_eq!(alone, solve_with(3));
    }
}
