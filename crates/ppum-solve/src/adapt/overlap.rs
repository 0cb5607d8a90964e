//! The disagreement of the local fields where patches overlap.
//!
//! ```text
//! η_j² = ∫_{C_j} Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C        u = Σ_i φ_i u_i        s_i = min(1, 2/p_i)²
//! ```
//!
//! Neighbours approximate one smooth field with polynomials of their own; what each of them misses is other than
//! what the next one misses. Where a patch is alone the integrand vanishes: its error is seen at the rim of its flat top.
//! Of two fields the same integral has the product (σ(u_i) − σ(u)) : (ε(v_i) − ε(v)) in place of the square.

use crate::basis::{ShapeEvaluator, Shapes};
use crate::law::{Law, LawAt};
use crate::quadrature::Rule;
use crate::space::Space;
use crate::watched::{Halt, Stage, in_batches};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::dataset::FieldData;
use ppum::vec2::{Vec2, vec2};
use std::ops::Range;

/// φ below which a local field is not made out of φ times it: its share is rounding.
const LEAST: f64 = 1e-10;

/// The products of the disagreements of some fields of a space in each cell: a row for each of them, symmetric. The local
/// field of a patch does not count where one of its lonely functions is other than zero. Advances the stage by the number of cells.
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
    let start = || (ShapeEvaluator::new(space), Shapes::default());
    let work = |(evaluator, shapes): &mut (ShapeEvaluator<'_>, Shapes), cell: usize| {
        let mut sum = Mat::zeros(fields.len(), fields.len());
        let rules = space.rules(&quadrature, cell);
        for rule in rules.iter().filter(|rule| rule.patches.len() > 1) {
            evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
            let seen = Seen { space, rule, shapes, coefficients: &coefficients, lonely };
            seen.add(&law, fields.len(), &mut sum);
        }
        Ok(sum)
    };
    in_batches(stage, n, start, work, |_, of_cell| all.push(of_cell))?;
    Ok(all)
}

/// Part of the disagreement that is the error: of smooth fields of the orders 1 to 8 the disagreement was 1.1, 1.4, 2.0,
/// 2.9, 3.0, 4.2, 5.5 and 6.2 times the error, as polynomials of higher order differ more outside their flat tops than they
/// err inside.
fn share_of_error(order: usize) -> f64 {
    (2.0 / order.max(1) as f64).min(1.0)
}

/// The coefficients of all components of all fields on a patch, a row each, of functions as the solver has them.
fn of_patch(fields: &[&FieldData], space: &Space<'_>, patch: usize) -> Mat<f64> {
    let rows = fields.iter().flat_map(|field| field.coefficients_of(patch));
    let rows: Vec<Vec<f64>> = rows.map(|row| space.shifted(patch, row)).collect();
    Mat::from_fn(rows.len(), space.sizes[patch], |i, k| rows[i][k])
}

/// Shapes at the points of a rule, and the coefficients of all patches.
struct Seen<'a> {
    space: &'a Space<'a>,
    rule: &'a Rule,
    shapes: &'a Shapes,
    coefficients: &'a [Mat<f64>],
    /// Of each patch, first functions of components: of these it has nearly nothing for itself, and many combinations of those of
    /// several patches make one field. Its local field is no approximation there.
    lonely: &'a [Vec<usize>],
}

/// φ u and its gradient of all components of a patch: [components of all fields, points].
struct Products {
    patch: usize,
    /// The row of φ among the shapes.
    phi: usize,
    /// s_i
    share: f64,
    value: Mat<f64>,
    dx: Mat<f64>,
    dy: Mat<f64>,
}

impl Seen<'_> {
    fn add(&self, law: &Law<'_>, fields: usize, sum: &mut Mat<f64>) {
        let products = self.products();
        let (dx, dy) = (total(&products, |part| &part.dx), total(&products, |part| &part.dy));
        let mut differences = vec![[Vec2::ZERO; 2]; fields];
        for (q, weight) in self.rule.weights.iter().enumerate() {
            let law = law.at(self.rule.anchor + self.rule.offsets[q]);
            let whole = [dx.col_as_slice(q), dy.col_as_slice(q)];
            for part in &products {
                let phi = self.at(&self.shapes.value, part.phi, q);
                if phi >= LEAST && !self.is_lonely(part, q) {
                    self.differences(part, whole, q, &mut differences);
                    add_products(&law, &differences, weight * part.share * phi, sum);
                }
            }
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

    fn is_lonely(&self, part: &Products, q: usize) -> bool {
        let of = |function: &usize| self.at(&self.shapes.value, part.phi + function, q);
        self.lonely[part.patch].iter().any(|function| of(function) != 0.0)
    }

    fn combined(&self, patch: usize, array: &[f64], range: Range<usize>) -> Mat<f64> {
        let (rows, coefficients) = (self.shapes.rows(array, range), &self.coefficients[patch]);
        let mut out = Mat::zeros(coefficients.nrows(), rows.ncols());
        matmul(out.as_mut(), Accum::Replace, coefficients, rows, 1.0, Par::Seq);
        out
    }

    fn at(&self, array: &[f64], row: usize, q: usize) -> f64 {
        array[row * self.shapes.points + q]
    }

    /// ∇u_i − ∇u of all fields at a point: ∇u_i = (∇(φ_i u_i) − u_i ∇φ_i)/φ_i, and ∇u, given whole, is Σ_i ∇(φ_i u_i).
    fn differences(&self, part: &Products, whole: [&[f64]; 2], q: usize, out: &mut [[Vec2; 2]]) {
        let [value, dx, dy] = [&part.value, &part.dx, &part.dy].map(|array| array.col_as_slice(q));
        let [phi, px, py] = [&self.shapes.value, &self.shapes.dx, &self.shapes.dy]
            .map(|array| self.at(array, part.phi, q));
        let components = value.len() / out.len();
        for (row, (value, (dx, dy))) in value.iter().zip(dx.iter().zip(dy)).enumerate() {
            let u = value / phi;
            let local = vec2(dx - u * px, dy - u * py) / phi;
            out[row / components][row % components] = local - vec2(whole[0][row], whole[1][row]);
        }
    }
}

/// The sum over the patches.
fn total(products: &[Products], of: fn(&Products) -> &Mat<f64>) -> Mat<f64> {
    let zero = of(&products[0]).clone() * faer::Scale(0.0);
    products.iter().fold(zero, |sum, part| sum + of(part))
}

/// Adds weight · σ(d_a):d_b for all pairs of fields.
fn add_products(law: &LawAt, differences: &[[Vec2; 2]], weight: f64, sum: &mut Mat<f64>) {
    for (a, d) in differences.iter().enumerate() {
        let flux = law.flux(d);
        for (b, e) in differences.iter().enumerate() {
            let of_component = |i: usize| flux[i][0] * e[i].x + flux[i][1] * e[i].y;
            sum[(a, b)] += weight * (0..law.components()).map(of_component).sum::<f64>();
        }
    }
}
