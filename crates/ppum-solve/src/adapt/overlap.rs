//! The disagreement of local fields where patches overlap.
//!
//! ```text
//! η_j² = ∫_{C_j} Σ_i s_i w_i |ε(v_i) − ε(u)|²_C      w_i = φ_i²/Σ_l φ_l²      s_i = min(1, 2/p_i)^½
//! ```
//!
//! v_i is the field of the patch's local space that is nearest to the solution u (`local`). Neighbours approximate one smooth
//! field with spaces of their own; what each of them misses is other than what the next one misses. Where a patch is alone the
//! integrand vanishes: its error is seen at the rim of its flat top. The weights w_i are those of the norm in which v_i is
//! nearest: where φ_i vanishes nothing says what v_i is. Of two fields the same integral has the product
//! (σ(v_i) − σ(u)) : (ε(z_i) − ε(z)) in place of the square.

use super::local::nearest;
use crate::assembly::Strains;
use crate::basis::{Projections, ShapeEvaluator, Shapes};
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

/// The products of the disagreements of some fields of a space in each cell: a row for each of them, symmetric. Advances the
/// stage by twice the number of cells.
///
/// # Errors
/// Cancelled.
pub(super) fn disagreements(
    fields: &[&FieldData],
    projections: &Projections,
    space: &Space<'_>,
    stage: &Stage<'_>,
) -> Result<Vec<Mat<f64>>, Halt> {
    let (law, quadrature) = (Law::new(space.equation()), space.quadrature(0));
    let coefficients = coefficients_of(fields, space);
    let nearest = nearest(fields, projections, space, stage)?;
    let n = coefficients.len();
    let mut all = Vec::with_capacity(n);
    let start = || (ShapeEvaluator::new(space), Shapes::default(), Strains::default());
    let work = |seen: &mut (ShapeEvaluator<'_>, Shapes, Strains), cell: usize| {
        let (evaluator, shapes, strains) = seen;
        let mut sum = Mat::zeros(fields.len(), fields.len());
        let rules = space.rules(&quadrature, cell);
        for rule in rules.iter().filter(|rule| rule.patches.len() > 1) {
            evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
            let seen = Seen { space, rule, shapes };
            seen.add(&law, (&coefficients, &nearest), projections, strains, &mut sum);
        }
        Ok(sum)
    };
    in_batches(stage, n, start, work, |_, of_cell| all.push(of_cell))?;
    Ok(all)
}

/// Part of the disagreement that is the error: of smooth fields of the orders 1 to 6 the disagreement was 1.1, 1.2, 1.3, 1.5, 1.4
/// and 1.5 times the error.
fn share_of_error(order: usize) -> f64 {
    (2.0 / order.max(1) as f64).min(1.0).powf(0.25)
}

/// The coefficients of all components of some fields on each patch, a row each.
pub(super) fn coefficients_of(fields: &[&FieldData], space: &Space<'_>) -> Vec<Mat<f64>> {
    (0..space.partition().len()).map(|patch| of_patch(fields, space, patch)).collect()
}

/// The coefficients of all components of all fields on a patch, a row each, of functions as the solver has them.
fn of_patch(fields: &[&FieldData], space: &Space<'_>, patch: usize) -> Mat<f64> {
    let rows = fields.iter().flat_map(|field| field.coefficients_of(patch));
    let rows: Vec<Vec<f64>> = rows.map(|row| space.shifted(patch, row)).collect();
    Mat::from_fn(rows.len(), space.sizes[patch], |i, k| rows[i][k])
}

/// Shapes at the points of a rule.
pub(super) struct Seen<'a> {
    pub(super) space: &'a Space<'a>,
    pub(super) rule: &'a Rule,
    pub(super) shapes: &'a Shapes,
}

/// φ u and its gradient of all components of all fields of a patch: a row of points for each.
pub(super) struct Products {
    patch: usize,
    /// The row of φ among the shapes.
    phi: usize,
    /// s_i
    share: f64,
    value: Vec<f64>,
    dx: Vec<f64>,
    dy: Vec<f64>,
}

impl Seen<'_> {
    /// Adds the products of the disagreements of fields with these coefficients and nearest local fields.
    fn add(
        &self,
        law: &Law<'_>,
        (own, nearest): (&[Mat<f64>], &[Mat<f64>]),
        projections: &Projections,
        strains: &mut Strains,
        sum: &mut Mat<f64>,
    ) {
        let products = self.products(own);
        let whole = [total(&products, |part| &part.dx), total(&products, |part| &part.dy)];
        let squares = self.squares(&products);
        for part in &mut self.products(nearest) {
            let weights = self.weights(part, &squares, projections.reduced(part.patch));
            self.make_differences(part, &whole, &weights);
            let slopes = [part.dx.as_slice(), part.dy.as_slice()];
            strains.add_products(law, (self.rule, &weights), slopes, sum);
        }
    }

    /// Of each patch ⟨φ_i ψ_k, φ_i (u − u_i)⟩ over the points of the rule, for all fields u with these coefficients.
    pub(super) fn misfits(&self, coefficients: &[Mat<f64>]) -> Vec<(usize, Mat<f64>)> {
        let products = self.products(coefficients);
        let u = total(&products, |part| &part.value);
        let whole = [u, total(&products, |part| &part.dx), total(&products, |part| &part.dy)];
        products.iter().map(|part| (part.patch, self.misfit(part, &whole))).collect()
    }

    /// The same of one patch, with the values and slopes of u.
    fn misfit(&self, part: &Products, [u, dx, dy]: &[Vec<f64>; 3]) -> Mat<f64> {
        let (half, Shapes { value, dx: by_x, dy: by_y, .. }) =
            (self.space.partition().half[part.patch], self.shapes);
        let [phi, phi_x, phi_y] = [value, by_x, by_y].map(|array| self.row(array, part.phi));
        let misfits = [
            (value, self.weighted(&part.value, &[(u, phi)], 1.0 / (half.x * half.y))),
            (by_x, self.weighted(&part.dx, &[(dx, phi), (u, phi_x)], 1.0)),
            (by_y, self.weighted(&part.dy, &[(dy, phi), (u, phi_y)], 1.0)),
        ];
        let n = self.space.sizes[part.patch];
        let mut sum = Mat::zeros(n, u.len() / self.shapes.points);
        for (array, misfit) in &misfits {
            let rows = self.shapes.rows(array, part.phi..part.phi + n);
            matmul(sum.as_mut(), Accum::Add, rows, misfit.transpose(), 1.0, Par::Seq);
        }
        sum
    }

    /// Rows of factor · weights · (Σ w f − own), with pairs of rows w and one row f for all of them.
    fn weighted(&self, own: &[f64], all: &[(&Vec<f64>, &[f64])], factor: f64) -> Mat<f64> {
        let points = self.shapes.points;
        Mat::from_fn(own.len() / points, points, |k, q| {
            let sum: f64 = all.iter().map(|(rows, f)| rows[k * points + q] * f[q]).sum();
            factor * self.rule.weights[q] * (sum - own[k * points + q])
        })
    }

    fn products(&self, coefficients: &[Mat<f64>]) -> Vec<Products> {
        let mut first = 0;
        let of_patch = |&patch: &u32| {
            let patch = patch as usize;
            let range = first..first + self.space.sizes[patch];
            first = range.end;
            let [value, dx, dy] = [&self.shapes.value, &self.shapes.dx, &self.shapes.dy]
                .map(|array| self.combined(&coefficients[patch], array, range.clone()));
            let share = share_of_error(self.space.order(patch)).powi(2);
            Products { patch, phi: range.start, share, value, dx, dy }
        };
        self.rule.patches.iter().map(of_patch).collect()
    }

    /// s φ²/Σ φ² times the weights of the rule, given the sums; zero where one of the reduced functions of the patch is not.
    fn weights(&self, part: &Products, squares: &[f64], reduced: &[usize]) -> Vec<f64> {
        let value = |function: usize| self.row(&self.shapes.value, part.phi + function);
        let phi = value(0);
        let weight = |q: usize| {
            let counts =
                phi[q] >= LEAST && reduced.iter().all(|&function| value(function)[q] == 0.0);
            if counts {
                self.rule.weights[q] * part.share * phi[q].powi(2) / squares[q]
            } else {
                0.0
            }
        };
        (0..self.shapes.points).map(weight).collect()
    }

    /// Σ φ² at the points.
    fn squares(&self, products: &[Products]) -> Vec<f64> {
        let phi = |part: &Products, q: usize| self.row(&self.shapes.value, part.phi)[q];
        let sum = |q| products.iter().map(|part| phi(part, q).powi(2)).sum();
        (0..self.shapes.points).map(sum).collect()
    }

    fn combined(&self, coefficients: &Mat<f64>, array: &[f64], range: Range<usize>) -> Vec<f64> {
        let rows = self.shapes.rows(array, range);
        let (n, points) = (coefficients.nrows(), rows.ncols());
        let mut out = vec![0.0; n * points];
        let target = MatMut::from_row_major_slice_mut(&mut out, n, points);
        matmul(target, Accum::Replace, coefficients, rows, 1.0, Par::Seq);
        out
    }

    fn row<'a>(&self, array: &'a [f64], row: usize) -> &'a [f64] {
        &array[row * self.shapes.points..][..self.shapes.points]
    }

    /// The gradients of a part become ∇u_i − ∇u of all fields, ∇u_i = (∇(φ_i u_i) − u_i ∇φ_i)/φ_i, and ∇u, given whole, being
    /// Σ_i ∇(φ_i u_i); some finite number where they have no weight.
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
