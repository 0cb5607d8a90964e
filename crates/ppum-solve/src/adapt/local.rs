//! The fields of the local spaces that are nearest to a solution.
//!
//! The local fields u_i of a solution are no measure of what their spaces can do: where a patch overlaps others, and least where
//! its partition function φ_i is small, u = Σ φ_i u_i leaves open how much of it is whose. Polynomials of high order, jumps
//! and kinks of which nearly nothing lies where the patch is alone have local fields that differ far more than they err. So
//! each is replaced by the nearest one,
//!
//! ```text
//! v_i = argmin ∫ |∇(φ_i (v − u))|² + h⁻² |φ_i (v − u)|²        v in the space of patch i
//! ```
//!
//! in the inner product of the stable basis: v_i = u_i + Σ_k N_k ⟨φ_i N_k, φ_i (u − u_i)⟩, which vanishes where the patch is alone.

use super::overlap::{Seen, coefficients_of};
use crate::basis::{Projections, ShapeEvaluator, Shapes};
use crate::space::Space;
use crate::watched::{Halt, Stage, in_batches};
use faer::Mat;
use ppum::dataset::FieldData;

/// The coefficients of the nearest local fields of some fields on each patch, a row for each component of each field. Advances
/// the stage by the number of cells.
///
/// # Errors
/// Cancelled.
pub(super) fn nearest(
    fields: &[&FieldData],
    projections: &Projections,
    space: &Space<'_>,
    stage: &Stage<'_>,
) -> Result<Vec<Mat<f64>>, Halt> {
    let (quadrature, coefficients) = (space.quadrature(0), coefficients_of(fields, space));
    let n = coefficients.len();
    let rows = coefficients.first().map_or(0, Mat::nrows);
    let mut products: Vec<Mat<f64>> =
        space.sizes.iter().map(|&size| Mat::zeros(size, rows)).collect();
    let start = || (ShapeEvaluator::new(space), Shapes::default());
    let work = |(evaluator, shapes): &mut (ShapeEvaluator<'_>, Shapes), cell: usize| {
        let mut parts = Vec::new();
        let rules = space.rules(&quadrature, cell);
        for rule in rules.iter().filter(|rule| rule.patches.len() > 1) {
            evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
            parts.extend(Seen { space, rule, shapes }.misfits(&coefficients));
        }
        Ok(parts)
    };
    let add = |_, parts: Vec<(usize, Mat<f64>)>| {
        parts.iter().for_each(|(patch, part)| products[*patch] += part);
    };
    in_batches(stage, n, start, work, add)?;
    let components = rows / fields.len();
    let add = |(patch, (own, products)): (usize, (Mat<f64>, &Mat<f64>))| {
        own + projections.fields(patch, products.as_ref(), components)
    };
    Ok(coefficients.into_iter().zip(&products).enumerate().map(add).collect())
}
