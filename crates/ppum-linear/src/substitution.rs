//! Solutions with a factor, of several right-hand sides at once: what takes time is to read
//! the factor.

use super::factor::CholeskyFactor;
use super::front::{Front, split_at_ranges};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatMut, MatRef, Par};
use rayon::prelude::*;
use std::ops::Range;

/// Part of a solution: the rows of the pivots of a subtree or of the top.
struct PartialSolution {
    /// Its first row, in the order of elimination.
    first: usize,
    rows: Mat<f64>,
}

impl PartialSolution {
    fn of(&self, rows: Range<usize>) -> MatRef<'_, f64> {
        self.rows.as_ref().subrows(rows.start - self.first, rows.len())
    }

    fn of_mut(&mut self, rows: Range<usize>) -> MatMut<'_, f64> {
        self.rows.as_mut().subrows_mut(rows.start - self.first, rows.len())
    }
}

impl CholeskyFactor {
    /// x ← (L L^T)⁻¹ x of each column, in the order of elimination.
    pub(super) fn solve(&self, mut columns: MatMut<'_, f64>) {
        let tree = &self.elimination;
        let top = tree.top();
        let part = |fronts: Range<usize>| {
            let rows = tree.unknowns(fronts);
            let own = columns.as_ref().subrows(rows.start, rows.len()).to_owned();
            PartialSolution { first: rows.start, rows: own }
        };
        let mut parts: Vec<PartialSolution> = tree.subtrees.iter().cloned().map(part).collect();
        let mut last = part(top.clone());
        let mut left: Vec<Mat<f64>> = Vec::new();
        left.resize_with(tree.fronts.len(), Mat::new);
        let slots = split_at_ranges(&mut left, &tree.subtrees);
        let forward =
            |((fronts, slots), x): ((&Range<usize>, &mut [Mat<f64>]), &mut PartialSolution)| {
                fronts.clone().for_each(|front| self.forward(front, x, slots, fronts.start));
            };
        let trees = || tree.subtrees.par_iter();
        trees().zip(slots).zip(parts.par_iter_mut()).with_max_len(1).for_each(forward);
        top.clone().for_each(|front| self.forward(front, &mut last, &mut left, 0));
        top.rev().for_each(|front| self.backward(front, &mut last, None));
        trees().zip(parts.par_iter_mut()).with_max_len(1).for_each(|(fronts, x)| {
            fronts.clone().rev().for_each(|front| self.backward(front, x, Some(&last)));
        });
        for PartialSolution { first, rows } in parts.iter().chain([&last]) {
            columns.as_mut().subrows_mut(*first, rows.nrows()).copy_from(rows);
        }
    }

    /// The pivots of a front without what is above them; what they take from the rows below is left
    /// for the parent.
    fn forward(&self, number: usize, x: &mut PartialSolution, left: &mut [Mat<f64>], first: usize) {
        let front = &self.elimination.fronts[number];
        let (pivots, n) = (self.elimination.unknowns(number..number + 1), front.n_pivots());
        let mut rows = Mat::zeros(front.rows(), x.rows.ncols());
        rows.subrows_mut(0, n).copy_from(x.of(pivots.clone()));
        for &child in &front.children {
            add(&mut rows, &self.elimination.fronts[child], &left[child - first]);
            left[child - first] = Mat::new();
        }
        for panel in &self.panels[number] {
            let (square, below) = panel.parts();
            let (_, rest) = rows.as_mut().split_at_row_mut(panel.first);
            let (mut own, rest) = rest.split_at_row_mut(panel.width);
            solve_lower_triangular_in_place(square, own.as_mut(), Par::Seq);
            matmul(rest, Accum::Add, below, own, -1.0, Par::Seq);
        }
        x.of_mut(pivots).copy_from(rows.subrows(0, n));
        left[number - first] = rows.subrows(n, front.rows() - n).to_owned();
    }

    /// The pivots of a front from the rows below, which are known: of its own part, or of the top.
    fn backward(&self, number: usize, x: &mut PartialSolution, top: Option<&PartialSolution>) {
        let front = &self.elimination.fronts[number];
        let pivots = self.elimination.unknowns(number..number + 1);
        let mut rows = Mat::zeros(front.rows(), x.rows.ncols());
        rows.subrows_mut(0, pivots.len()).copy_from(x.of(pivots.clone()));
        for (at, &place) in front.starts[front.pivots.len()..].iter().zip(&front.below) {
            let offsets = &self.elimination.offsets[place as usize..];
            let known = offsets[0]..offsets[1];
            let part = top.filter(|top| top.first <= known.start).unwrap_or(x);
            rows.subrows_mut(*at, known.len()).copy_from(part.of(known));
        }
        for panel in self.panels[number].iter().rev() {
            let (square, below) = panel.parts();
            let (_, rest) = rows.as_mut().split_at_row_mut(panel.first);
            let (mut own, rest) = rest.split_at_row_mut(panel.width);
            matmul(own.as_mut(), Accum::Add, below.transpose(), rest, -1.0, Par::Seq);
            solve_upper_triangular_in_place(square.transpose(), own, Par::Seq);
        }
        x.of_mut(pivots.clone()).copy_from(rows.subrows(0, pivots.len()));
    }
}

/// Adds what a child has left to the rows of its parent.
fn add(rows: &mut Mat<f64>, child: &Front, left: &Mat<f64>) {
    for run in &child.runs {
        let mut own = rows.subrows_mut(run.to, run.end() - run.from);
        own += left.subrows(run.from, run.end() - run.from);
    }
}
