//! The disagreement of the local fields where patches overlap.
//!
//! ```text
//! η_j² = ∫_{C_j} Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C        u = Σ_i φ_i u_i
//! s_i = min(1, 2/p_i)², min(1, 2/p_i) if a point lies in the patch where the field is singular
//! ```
//!
//! Neighbours approximate one smooth field with polynomials of their own; what each of them misses
//! is other than what the next one misses. Where a patch is alone the integrand vanishes: its error
//! is seen at the rim of its flat top. For the product of two fields u and v, (σ(u_i) − σ(u)) :
//! (ε(v_i) − ε(v)) takes the place of the square.

use crate::basis::{ShapeEvaluator, Shapes};
use crate::law::{Law, OPERATORS, Strain};
use crate::quadrature::CellRule;
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use ppum::vec2::Vec2;
use ppum_problem::geometry::BoxList;
use std::ops::Range;

/// φ below which a local field is not made out of φ times it: its share is rounding.
const LEAST: f64 = 1e-10;

/// Local fields of some fields of a space.
#[derive(Clone, Copy)]
pub struct LocalFields<'a> {
    /// The space of the fields.
    pub space: &'a TrialSpace<'a>,
    /// Its stresses.
    pub law: &'a Law<'a>,
    /// The coefficients, for each patch, of the functions that the solver evaluates: a row for each
    /// component of each field.
    pub coefficients: &'a [Mat<f64>],
    /// For each patch, the first functions of components whose support lies almost entirely under
    /// other patches: many combinations of those of several patches make one field. Its local field
    /// is no approximation where one of them is other than zero, and does not count there.
    pub sole_support: &'a [Vec<usize>],
}

/// The energy of the first field, and the products of the disagreements of all of them in each
/// cell: a row for each field, symmetric. Advances the stage by the number of cells.
///
/// # Errors
/// Cancelled.
pub(super) fn disagreements(
    fields: LocalFields<'_>,
    singular: &BoxList<Vec2>,
    stage: &WorkPhase<'_>,
) -> Result<(f64, Vec<Mat<f64>>), Halt> {
    let LocalFields { space, law, coefficients, .. } = fields;
    let quadrature = space.quadrature(0);
    let n = coefficients.first().map_or(0, Mat::nrows) / law.components;
    let (mut energy, mut all) = (0.0, Vec::with_capacity(coefficients.len()));
    let share = |patch: usize| {
        let is_singular = singular.near(&space.partition().support(patch)).next().is_some();
        share_of_error(space.order(patch), is_singular)
    };
    let shares: Vec<f64> = (0..coefficients.len()).map(share).collect();
    let start = || (ShapeEvaluator::of_series(space), Shapes::default());
    let work = |(evaluator, shapes): &mut (ShapeEvaluator<'_>, Shapes), cell: usize| {
        let (mut energy, mut sum) = (0.0, Mat::zeros(n, n));
        for rule in space.rules(&quadrature, cell).iter() {
            evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
            energy += SampledFields { fields, shares: &shares, law, rule, shapes }.add(&mut sum);
        }
        Ok((energy, sum))
    };
    in_batches(stage, coefficients.len(), start, work, |_, (part, of_cell)| {
        energy += part;
        all.push(of_cell);
    })?;
    Ok((energy, all))
}

/// Part s of the square of the disagreement that is that of the error: of smooth fields of the
/// orders 1 to 8 the disagreement was 1.1, 1.4, 2.0, 2.9, 3.0, 4.2, 5.5 and 6.2 times the error, as
/// polynomials of higher order differ more outside their flat tops than they err inside. Beside
/// singular points the error is inside, too.
fn share_of_error(order: usize, is_singular: bool) -> f64 {
    let share = (2.0 / order.max(1) as f64).min(1.0);
    if is_singular { share } else { share * share }
}

/// Shapes at the points of a rule, and the fields that they make.
struct SampledFields<'a> {
    fields: LocalFields<'a>,
    /// s_i of each patch.
    shares: &'a [f64],
    law: &'a Law<'a>,
    rule: &'a CellRule,
    shapes: &'a Shapes,
}

/// φ u and its gradient of all components of all fields of a patch: a row of points for each.
struct PatchProducts {
    patch: usize,
    /// The row of φ among the shapes.
    phi: usize,
    value: Vec<f64>,
    slopes: Vec<Vec<f64>>,
}

impl SampledFields<'_> {
    /// Adds the disagreements at the points to the products; returns the energy of the first field
    /// there.
    fn add(&self, sum: &mut Mat<f64>) -> f64 {
        let mut products = self.products();
        let whole: Vec<_> = (0..self.shapes.slopes.len()).map(|k| total(&products, k)).collect();
        if products.len() > 1 {
            for part in &mut products {
                let weights = self.weights(part);
                self.make_differences(part, &whole, &weights);
                self.add_products(&weights, &part.slopes, sum);
            }
        }
        0.5 * self.energy(&whole)
    }

    /// Twice the energy of the first field, given the slopes of all.
    fn energy(&self, slopes: &[Vec<f64>]) -> f64 {
        let (points, components) = (self.shapes.points, self.law.components);
        let at = |(q, (x, weight)): (usize, (Vec2, f64))| {
            let mut strain = Strain::default();
            for j in 0..components {
                let mut own = [0.0; OPERATORS];
                own.iter_mut().zip(slopes).for_each(|(own, row)| *own = row[j * points + q]);
                strain.add(j, 1.0, own);
            }
            weight * self.law.at(x).energy(&strain)
        };
        self.rule.points().enumerate().map(at).sum()
    }

    /// Adds ∫ σ:∇v of all pairs of fields. Slopes have a row for each component of each field.
    fn add_products(&self, weights: &[f64], slopes: &[Vec<f64>], sum: &mut Mat<f64>) {
        let (law, n, fields) = (self.law, weights.len(), sum.nrows());
        let mut stresses: Vec<_> = slopes.iter().map(|slopes| vec![0.0; slopes.len()]).collect();
        for (m, term) in law.terms.iter().enumerate() {
            let coefficients = self.rule.points().map(|(x, _)| law.coefficients(x)[m]);
            let factors = coefficients.zip(weights);
            let factors: Vec<f64> = factors.map(|(coefficient, w)| coefficient * w).collect();
            for first in (0..slopes[0].len()).step_by(law.components * n) {
                let row = |i: usize| first + i * n..first + (i + 1) * n;
                for [i, k, j, l] in term.entries() {
                    let entry = term.entry([i, k], [j, l]);
                    let sums = stresses[k][row(i)].iter_mut().zip(&slopes[l][row(j)]);
                    sums.zip(&factors).for_each(|((sum, slope), w)| *sum += entry * w * slope);
                }
            }
        }
        let rows = |array| MatRef::from_row_major_slice(array, fields, law.components * n);
        for (stresses, slopes) in stresses.iter().zip(slopes) {
            let (stresses, slopes) = (rows(stresses.as_slice()), rows(slopes));
            matmul(sum.as_mut(), Accum::Add, stresses, slopes.transpose(), 1.0, Par::Seq);
        }
    }

    fn products(&self) -> Vec<PatchProducts> {
        let coefficients = self.fields.coefficients;
        let mut first = 0;
        let of_patch = |&patch: &u32| {
            let patch = patch as usize;
            let range = first..first + coefficients[patch].ncols();
            first = range.end;
            let combined = |array: &Vec<f64>| self.combined(patch, array, range.clone());
            let (value, slopes) = (combined(&self.shapes.value), &self.shapes.slopes);
            PatchProducts {
                patch,
                phi: range.start,
                value,
                slopes: slopes.iter().map(combined).collect(),
            }
        };
        self.rule.patches.iter().map(of_patch).collect()
    }

    /// s φ times the weights of the rule; zero where the local field does not count.
    fn weights(&self, part: &PatchProducts) -> Vec<f64> {
        let weight = |(q, (weight, phi)): (usize, (&f64, &f64))| {
            let counts = *phi >= LEAST && !self.has_sole_support(part, q);
            if counts { weight * self.shares[part.patch] * phi } else { 0.0 }
        };
        let phi = self.shapes.row(&self.shapes.value, part.phi);
        self.rule.weights.iter().zip(phi).enumerate().map(weight).collect()
    }

    fn has_sole_support(&self, part: &PatchProducts, q: usize) -> bool {
        let of = |function: &usize| self.shapes.row(&self.shapes.value, part.phi + function)[q];
        self.fields.sole_support[part.patch].iter().any(|function| of(function) != 0.0)
    }

    fn combined(&self, patch: usize, array: &[f64], range: Range<usize>) -> Vec<f64> {
        let rows = self.shapes.rows(array, range);
        let coefficients = &self.fields.coefficients[patch];
        let (n, points) = (coefficients.nrows(), rows.ncols());
        let mut out = vec![0.0; n * points];
        let target = MatMut::from_row_major_slice_mut(&mut out, n, points);
        matmul(target, Accum::Replace, coefficients, rows, 1.0, Par::Seq);
        out
    }

    /// The gradients of a part become ∇u_i − ∇u of all fields, ∇u_i = (∇(φ_i u_i) − u_i ∇φ_i)/φ_i,
    /// and ∇u, given whole, being Σ_i ∇(φ_i u_i); some finite number where they have no weight.
    fn make_differences(&self, part: &mut PatchProducts, whole: &[Vec<f64>], weights: &[f64]) {
        let phi = self.shapes.row(&self.shapes.value, part.phi).iter().zip(weights);
        let inverse: Vec<f64> =
            phi.map(|(phi, weight)| if *weight > 0.0 { 1.0 / phi } else { 0.0 }).collect();
        let of_phi = self.shapes.factor_slopes(part.phi);
        let points = self.shapes.points;
        for ((slopes, of_phi), whole) in part.slopes.iter_mut().zip(of_phi).zip(whole) {
            let rows = slopes.chunks_exact_mut(points).zip(part.value.chunks_exact(points));
            for ((slopes, values), whole) in rows.zip(whole.chunks_exact(points)) {
                let Some(of_phi) = of_phi else {
                    (0..points).for_each(|q| slopes[q] = slopes[q] * inverse[q] - whole[q]);
                    continue;
                };
                for q in 0..points {
                    let u = values[q] * inverse[q];
                    slopes[q] = (slopes[q] - u * of_phi[q]) * inverse[q] - whole[q];
                }
            }
        }
    }
}

/// The sum over the patches of D_k of their products.
fn total(products: &[PatchProducts], k: usize) -> Vec<f64> {
    let mut sum = products[0].slopes[k].clone();
    for part in &products[1..] {
        sum.iter_mut().zip(&part.slopes[k]).for_each(|(sum, part)| *sum += part);
    }
    sum
}
