//! Loads whose solutions are dual to stress intensity factors: K(v) = a(v, z) for all v.

use super::Assembly;
use super::functions::CellFunctions;
use crate::basis::{BasisEvaluator, Shapes};
use crate::geometry::Placed;
use crate::intensity::{FACTORS, Sensitivity};
use crate::linear::BlockMatrix;
use crate::watched::{Halt, Stage, in_batches};

/// K(N) of both modes, in the order of the matrix, summed over all tips. Advances the stage by the number of pairs of a tip and
/// a cell.
///
/// # Errors
/// Cancelled.
pub(crate) fn dual_loads(
    assembly: Assembly<'_>,
    matrix: &BlockMatrix,
    tips: &[Sensitivity<'_>],
    stage: &Stage<'_>,
) -> Result<[Vec<f64>; FACTORS], Halt> {
    let Assembly { space, basis, .. } = assembly;
    let (quadrature, c) = (space.quadrature(0), assembly.components());
    let near = Placed::new(space.partition().cell.iter().copied().zip(0..));
    let work: Vec<_> =
        tips.iter().flat_map(|tip| tip.cells(&near).into_iter().map(move |c| (tip, c))).collect();
    let mut loads = [0, 1].map(|_| vec![0.0; matrix.n_unknowns()]);
    in_batches(
        stage,
        work.len(),
        || (BasisEvaluator::new(space, basis), Shapes::default()),
        |(evaluator, shapes), k| {
            let (tip, cell) = work[k];
            let functions = CellFunctions::new(&assembly, cell);
            let mut parts = [0, 1].map(|_| vec![0.0; functions.len() * c]);
            for rule in tip.rules(&quadrature, cell) {
                evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
                let numbers = functions.numbers(&rule.patches);
                for (q, kernels) in tip.kernels(&rule).iter().enumerate() {
                    for (kernel, part) in kernels.iter().zip(&mut parts) {
                        shapes.add_slopes(q, &numbers, kernel, part);
                    }
                }
            }
            Ok((functions, parts))
        },
        |_, (functions, parts)| {
            for (sum, part) in loads.iter_mut().zip(&parts) {
                functions.add_to(basis, matrix, c, part, sum);
            }
        },
    )?;
    Ok(loads)
}
