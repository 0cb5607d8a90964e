//! The disagreement of the local fields where patches overlap.
//!
//! ```text
//! η_j² = ∫_{C_j} Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C        u = Σ_i φ_i u_i        s_i = min(1, 2/p_i)²
//! ```
//!
//! Neighbours approximate one smooth field with polynomials of their own; what each of them misses
//! is other than what the next one misses. Where a patch is alone the integrand vanishes: its error
//! is seen at the rim of its flat top. Of two fields the same integral has the product (σ(u_i) −
//! σ(u)) : (ε(v_i) − ε(v)) in place of the square.

use crate::assembly::Strains;
use crate::basis::{ShapeEvaluator, Shapes};
use crate::law::Law;
use crate::quadrature::Rule;
use crate::space::Space;
use crate::watched::{Halt, Stage, in_batches};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, Par};
use ppum::dataset::FieldData;
use std::ops::Range;

/// φ below which a local field is not made out of φ times it: its share is rounding.
const LEAST: f64 = 1e-10;

/// The products of the disagreements of some fields of a space in each cell: a row for each of
/// them, symmetric. The local field of a patch does not count where one of its lonely functions is
/// other than zero. Advances the stage by the number of cells.
///
/// # Errors
/// Cancelled.
pub(super) fn disagreements(
    fields: &[&FieldData],
    lonely: &[Vec<usize>],
    space: &Space<'_>,
    stage: &Stage<'_>,
) -> Result<Vec<Mat<f64>>, Halt> {
    let (law, quadrature) = (Law::new(space.equation()), space.quadrature(0));
    let coefficients: Vec<Mat<f64>> =
        (0..space.partition().len()).map(|patch| of_patch(fields, space, patch)).collect();
    let n = coefficients.len();
    let mut all = Vec::with_capacity(n);
    let start = || (ShapeEvaluator::new(space), Shapes::default(), Strains::default());
    let work = |seen: &mut (ShapeEvaluator<'_>, Shapes, Strains), cell: usize| {
        let (evaluator, shapes, strains) = seen;
        let mut sum = Mat::zeros(fields.len(), fields.len());
        let rules = space.rules(&quadrature, cell);
        for rule in rules.iter().filter(|rule| rule.patches.len() > 1) {
            evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
            let seen = SampledSolution { space, rule, shapes, coefficients: &coefficients, lonely };
            seen.add(&law, strains, &mut sum);
        }
        Ok(sum)
    };
    in_batches(stage, n, start, work, |_, of_cell| all.push(of_cell))?;
    Ok(all)
}

/// Part of the disagreement that is the error: of smooth fields of the orders 1 to 8 the
/// disagreement was 1.1, 1.4, 2.0, 2.9, 3.0, 4.2, 5.5 and 6.2 times the error, as polynomials of
/// higher order differ more outside their flat tops than they err inside.
fn share_of_error(order: usize) -> f64 {
    (2.0 / order.max(1) as f64).min(1.0)
}

/// The coefficients of all components of all fields on a patch, a row each, of functions as the
/// solver has them.
fn of_patch(fields: &[&FieldData], space: &Space<'_>, patch: usize) -> Mat<f64> {
    let rows = fields.iter().flat_map(|field| field.coefficients_of(patch));
    let rows: Vec<Vec<f64>> = rows.map(|row| space.shifted(patch, row)).collect();
    Mat::from_fn(rows.len(), space.sizes[patch], |i, k| rows[i][k])
}

/// Shapes at the points of a rule, and the coefficients of all patches.
struct SampledSolution<'a> {
    space: &'a Space<'a>,
    rule: &'a Rule,
    shapes: &'a Shapes,
    coefficients: &'a [Mat<f64>],
    /// Of each patch, first functions of components: of these it has nearly nothing for itself, and
    /// many combinations of those of several patches make one field. Its local field is no
    /// approximation there.
    lonely: &'a [Vec<usize>],
}

/// φ u and its gradient of all components of all fields of a patch: a row of points for each.
struct Products {
    patch: usize,
    /// The row of φ among the shapes.
    phi: usize,
    /// s_i
    share: f64,
    value: Vec<f64>,
    dx: Vec<f64>,
    dy: Vec<f64>,
}

impl SampledSolution<'_> {
    fn add(&self, law: &Law<'_>, strains: &mut Strains, sum: &mut Mat<f64>) {
        let mut products = self.products();
        let whole = [total(&products, |part| &part.dx), total(&products, |part| &part.dy)];
        for part in &mut products {
            let weights = self.weights(part);
            self.make_differences(part, &whole, &weights);
            let slopes = [part.dx.as_slice(), part.dy.as_slice()];
            strains.add_products(law, (self.rule, &weights), slopes, sum);
        }
    }

    fn products(&self) -> Vec<Products> {
        let mut first = 0;
        let of_patch = |&patch: &u32| {
            let patch = patch as usize;
            let range = first..first + self.space.sizes[patch];
            first = range.end;
            let [value, dx, dy] = [&self.shapes.value, &self.shapes.dx, &self.shapes.dy]
                .map(|array| self.combined(patch, array, range.clone()));
            let share = share_of_error(self.space.order(patch)).powi(2);
            Products { patch, phi: range.start, share, value, dx, dy }
        };
        self.rule.patches.iter().map(of_patch).collect()
    }

    /// s φ times the weights of the rule; zero where the local field does not count.
    fn weights(&self, part: &Products) -> Vec<f64> {
        let weight = |(q, (weight, phi)): (usize, (&f64, &f64))| {
            let counts = *phi >= LEAST && !self.is_lonely(part, q);
            if counts { weight * part.share * phi } else { 0.0 }
        };
        let phi = self.row(&self.shapes.value, part.phi);
        self.rule.weights.iter().zip(phi).enumerate().map(weight).collect()
    }

    fn is_lonely(&self, part: &Products, q: usize) -> bool {
        let of = |function: &usize| self.row(&self.shapes.value, part.phi + function)[q];
        self.lonely[part.patch].iter().any(|function| of(function) != 0.0)
    }

    fn combined(&self, patch: usize, array: &[f64], range: Range<usize>) -> Vec<f64> {
        let (rows, coefficients) = (self.shapes.rows(array, range), &self.coefficients[patch]);
        let (n, points) = (coefficients.nrows(), rows.ncols());
        let mut out = vec![0.0; n * points];
        let target = MatMut::from_row_major_slice_mut(&mut out, n, points);
        matmul(target, Accum::Replace, coefficients, rows, 1.0, Par::Seq);
        out
    }

    fn row<'a>(&self, array: &'a [f64], row: usize) -> &'a [f64] {
        &array[row * self.shapes.points..][..self.shapes.points]
    }

    /// The gradients of a part become ∇u_i − ∇u of all fields, ∇u_i = (∇(φ_i u_i) − u_i ∇φ_i)/φ_i,
    /// and ∇u, given whole, being Σ_i ∇(φ_i u_i); some finite number where they have no weight.
    fn make_differences(&self, part: &mut Products, whole: &[Vec<f64>; 2], weights: &[f64]) {
        let phi = self.row(&self.shapes.value, part.phi).iter().zip(weights);
        let inverse: Vec<f64> =
            phi.map(|(phi, weight)| if *weight > 0.0 { 1.0 / phi } else { 0.0 }).collect();
        let points = self.shapes.points;
        for (slopes, of_phi, whole) in [
            (&mut part.dx, self.row(&self.shapes.dx, part.phi), &whole[0]),
            (&mut part.dy, self.row(&self.shapes.dy, part.phi), &whole[1]),
        ] {
            let rows = slopes.chunks_exact_mut(points).zip(part.value.chunks_exact(points));
            for ((slopes, values), whole) in rows.zip(whole.chunks_exact(points)) {
                for q in 0..points {
                    let u = values[q] * inverse[q];
                    slopes[q] = (slopes[q] - u * of_phi[q]) * inverse[q] - whole[q];
                }
            }
        }
    }
}

/// The sum over the patches.
fn total(products: &[Products], of: fn(&Products) -> &Vec<f64>) -> Vec<f64> {
    let mut sum = of(&products[0]).clone();
    for part in &products[1..] {
        sum.iter_mut().zip(of(part)).for_each(|(sum, part)| *sum += part);
    }
    sum
}
