//! The functions of tips that stand for Williams' series: the solution takes combinations of them only.

use super::Space;
use crate::problem::{Enrichment, Problem};
use ppum::crack::TipId;
use ppum::dataset::{Step, monomials};
use ppum::function::{FunctionKind, GROUP, WESTERGAARD, native};
use std::ops::Range;

/// The functions of a tip on a patch: the four of [`WESTERGAARD`] times polynomials. With z = x + iy in the tip's frame
///
/// ```text
/// r^(n+½) e^{i(n+½)θ} = zⁿ √r e^{iθ/2}      r^(n+½) e^{i(n−3/2)θ} = zⁿ √r e^{−3iθ/2}
/// ```
///
/// so that Williams' series up to r^(N − ½) are combinations of them with polynomials of degree N − 1.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) tip: TipId,
    /// Their numbers among the patch's functions.
    pub(crate) functions: Range<usize>,
    /// N − 1
    pub(crate) degree: usize,
}

impl Series {
    /// Number of terms N.
    pub(crate) fn terms(&self) -> usize {
        self.degree + 1
    }
}

/// True if tips have Williams' series.
pub(crate) fn has_series(problem: &Problem) -> bool {
    problem.discretization.enrichment == Enrichment::Williams && problem.equation.is_uniform()
}

/// The series of all patches of a problem's step; none where the material varies, as its terms are others then.
pub(super) fn series(problem: &Problem, step: &Step) -> Vec<Vec<Series>> {
    if !has_series(problem) {
        return Vec::new();
    }
    let first = first_functions(step);
    (0..step.partition.len()).map(|patch| of_patch(step, patch, &first)).collect()
}

/// The first function of each tip that is built in: those of the problem's own come later in the table.
fn first_functions(step: &Step) -> Vec<Option<TipId>> {
    let mut known = Vec::new();
    let tip = |kind: &FunctionKind| match kind {
        FunctionKind::Formula { text, frame, .. } => native(text, *frame),
        _ => None,
    };
    let mut first = |kind: &FunctionKind| {
        let (tip, _) = tip(kind).filter(|(tip, k)| *k == 0 && !known.contains(tip))?;
        known.push(tip);
        Some(tip)
    };
    step.functions.iter().map(|function| first(&function.kind)).collect()
}

fn of_patch(step: &Step, patch: usize, first: &[Option<TipId>]) -> Vec<Series> {
    let (data, mut at, mut found) = (&step.fields[0], 0, Vec::new());
    for block in data.blocks(patch) {
        let degree = usize::from(data.block_degree[block]);
        if let Some(tip) = first[data.block_function[block] as usize] {
            let functions = at..at + WESTERGAARD.len() * monomials(degree);
            found.push(Series { tip, functions, degree });
        }
        at += monomials(degree);
    }
    found
}

impl Space<'_> {
    /// The series of a patch.
    pub(crate) fn series(&self, patch: usize) -> &[Series] {
        self.series.get(patch).map_or(&[], Vec::as_slice)
    }

    /// Number of unknowns of a patch, before any are cut off.
    pub(crate) fn unknowns(&self, patch: usize) -> usize {
        let (components, series) = (self.equation.components(), self.series(patch));
        let theirs: usize = series.iter().map(|series| series.functions.len()).sum();
        let terms: usize = series.iter().map(Series::terms).sum();
        // of a term a field for opening and one for sliding, or one function alone
        components * (self.sizes[patch] - theirs + terms)
    }
}

const _: () = assert!(GROUP == WESTERGAARD.len());
