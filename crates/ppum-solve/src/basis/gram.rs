//! Gram matrices of the functions of patches, over the domain.

use super::shape::{ShapeEvaluator, Shapes};
use crate::quadrature::CellRule;
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, each, in_batches};
use faer::linalg::matmul::triangular::{BlockStructure, matmul as triangular};
use faer::{Accum, Mat, Par};
use ppum::vec2::Vec2;
use std::ops::Range;
use std::sync::Arc;

/// The measures of a patch's functions.
#[derive(Clone, Debug)]
pub(super) struct Gram {
    /// ∫ ∇(φψ)·∇(φψ′) + h⁻² φ² ψ ψ′
    pub(super) weighted: Mat<f64>,
    /// ∫ h⁻² ψ²
    pub(super) plain: Vec<f64>,
    /// ∫ h⁻² ψ² where the patch is alone
    pub(super) alone: Vec<f64>,
}

impl Gram {
    fn zero(functions: usize) -> Self {
        Self {
            weighted: Mat::zeros(functions, functions),
            plain: vec![0.0; functions],
            alone: vec![0.0; functions],
        }
    }

    fn add_part(&mut self, part: &Self) {
        self.weighted += &part.weighted;
        self.plain.iter_mut().zip(&part.plain).for_each(|(sum, part)| *sum += part);
        self.alone.iter_mut().zip(&part.alone).for_each(|(sum, part)| *sum += part);
    }

    /// Adds points of a patch's functions φψ times the roots of the weights; the first one has ψ
    /// = 1. Only the lower half of the weighted matrix is added to.
    fn add(&mut self, shapes: &Shapes, range: Range<usize>, weights: &[f64], half: Vec2) {
        let h2 = 1.0 / (half.x * half.y);
        for (array, factor) in shapes.gram_terms(h2) {
            let rows = shapes.rows(array, range.clone());
            let (sum, lower) = (self.weighted.as_mut(), BlockStructure::TriangularLower);
            let all = BlockStructure::Rectangular;
            let columns = rows.transpose();
            triangular(sum, lower, Accum::Add, rows, all, columns, all, factor, Par::Seq);
        }
        let row = |k: usize| shapes.row(&shapes.value, k);
        let phi = row(range.start).iter().zip(weights);
        let is_seen = |phi: f64| if phi > LEAST { 1.0 / phi } else { 0.0 };
        let scales: Vec<_> =
            phi.map(|(&phi, weight)| is_seen(phi) * (h2 * weight).sqrt()).collect();
        let is_alone = f64::from(u8::from(range.len() == shapes.functions));
        for ((k, plain), alone) in range.zip(&mut self.plain).zip(&mut self.alone) {
            let square: f64 = row(k).iter().zip(&scales).map(|(v, s)| (v * s) * (v * s)).sum();
            *plain += square;
            *alone += is_alone * square;
        }
    }

    /// Makes the weighted matrix whole.
    fn complete(&mut self) {
        for k in 0..self.weighted.nrows() {
            (0..k).for_each(|l| self.weighted[(l, k)] = self.weighted[(k, l)]);
        }
    }
}

/// φ at which nothing of φψ is left but rounding.
pub(super) const LEAST: f64 = 1e-280;

/// The Gram matrix of every patch, over the domain.
pub(super) fn grams(space: &TrialSpace<'_>, stage: &WorkPhase<'_>) -> Result<Vec<Arc<Gram>>, Halt> {
    let (quadrature, alike) = (space.quadrature(0), space.alike());
    let of_cells = each(stage, alike.kinds.len(), |kind| {
        let (kind, alone) = (&alike.kinds[kind], alike.kinds[kind].space(space));
        let mut seen = (ShapeEvaluator::of_series(&alone), Shapes::default());
        Ok(parts(&alone, &alone.covering_patches[0], &kind.rules, &mut seen))
    })?;
    let of_kinds: Vec<_> =
        alike.patch_kinds.iter().map(|cells| Arc::new(sum(cells, &of_cells))).collect();
    let mut grams: Vec<_> =
        (0..space.sizes.len()).map(|i| Gram::zero(space.evaluated(i))).collect();
    in_batches(
        stage,
        space.partition().len(),
        || (ShapeEvaluator::of_series(space), Shapes::default()),
        |seen, cell| {
            let rules = || space.rules(&quadrature, cell);
            let is_alike = alike.cell(cell).is_some();
            let covering_patches = &space.covering_patches[cell];
            Ok(if is_alike { Vec::new() } else { parts(space, covering_patches, &rules(), seen) })
        },
        |cell, parts| {
            let own = space.covering_patches[cell].iter().zip(&parts);
            let of_kind = alike
                .cell(cell)
                .into_iter()
                .flat_map(|member| member.patches.iter().zip(&of_cells[member.kind as usize]));
            for (&patch, part) in
                own.chain(of_kind).filter(|(p, _)| alike.patch(**p as usize).is_none())
            {
                grams[patch as usize].add_part(part);
            }
        },
    )?;
    let finished = |(patch, mut gram): (usize, Gram)| match alike.patch(patch) {
        Some(kind) => Arc::clone(&of_kinds[kind]),
        None => {
            gram.complete();
            Arc::new(gram)
        }
    };
    Ok(grams.into_iter().enumerate().map(finished).collect())
}

/// The Gram matrix of a patch with these cells.
fn sum(cells: &[(u32, u32)], of_cells: &[Vec<Gram>]) -> Gram {
    let part = |&(kind, seat): &(u32, u32)| &of_cells[kind as usize][seat as usize];
    let mut gram = Gram::zero(part(&cells[0]).plain.len());
    cells.iter().for_each(|cell| gram.add_part(part(cell)));
    gram.complete();
    gram
}

/// Returns the contributions of a cell to the Gram matrices of its patches.
fn parts<'s>(
    space: &'s TrialSpace<'s>,
    covering_patches: &[u32],
    rules: &[CellRule],
    (evaluator, shapes): &mut (ShapeEvaluator<'s>, Shapes),
) -> Vec<Gram> {
    let mut parts: Vec<_> =
        covering_patches.iter().map(|&p| Gram::zero(space.evaluated(p as usize))).collect();
    for rule in rules {
        evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
        shapes.scale(&rule.weights);
        add_grams(space, rule, covering_patches, shapes, &mut parts);
    }
    parts
}

/// Adds the points of shapes that carry the roots of the weights.
fn add_grams(
    space: &TrialSpace<'_>,
    rule: &CellRule,
    covering_patches: &[u32],
    shapes: &Shapes,
    parts: &mut [Gram],
) {
    let mut first = 0;
    for &patch in &rule.patches {
        let range = first..first + space.evaluated(patch as usize);
        first = range.end;
        let k = covering_patches.binary_search(&patch).expect("a rule's patches meet its cell");
        parts[k].add(shapes, range, &rule.weights, space.partition().half[patch as usize]);
    }
}
