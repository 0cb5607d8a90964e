//! The stiffness of a cell: K = ∫ Bᵀ D B.
//!
//! ```text
//! ε = (∂₁u₁, ∂₂u₂, ∂₂u₁ + ∂₁u₂)   or   ∇u of a potential        σ = D ε        K_ab = ∫ ε_a · σ_b
//! K_(i,a)(j,b) = Σ_kl C_ikjl ∫ ∂_k ψ_a ∂_l ψ_b        of functions ψ that each component has for itself
//! ```
//!
//! A row of strains is that of one vector field at all points of a rule, section by section;
//! products of rows of strains with rows of weighted stresses are integrals. All components share
//! the products of the slopes of ψ: a third of the operations.

use super::Assembly;
use super::cell_matrix::CellMatrix;
use crate::basis::{Fields, Shapes};
use crate::law::{Law, LawAt, Rigidity};
use crate::quadrature::Rule;
use faer::linalg::matmul::matmul;
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};
use ppum::real::{Job, Real, Scalar};
use ppum::vec2::Vec2;
use std::ops::Range;

/// Most components of a strain.
const SECTIONS: usize = 3;

/// Slopes, strains and weighted stresses at the points of a rule.
#[derive(Debug, Default)]
pub(super) struct Strains {
    /// Of the functions that each component has for itself ∂₁ψ and ∂₂ψ, of each patch [2,
    /// functions, points].
    slopes: Vec<f64>,
    /// The same times weights and a coefficient of the law.
    weighted: Vec<f64>,
    /// ∫ a ∂_k ψ_a ∂_l ψ_b of two patches.
    products: Vec<f64>,
    /// Length of a section of the strains and stresses: points, and zeros up to whole vectors.
    stride: usize,
    sections: usize,
    strain: Vec<f64>,
    stress: Vec<f64>,
    /// D times the weights, [sections · sections, stride].
    rigidity: Vec<f64>,
}

/// The unknowns of a patch: the first of its slopes and of its strains, and their numbers.
#[derive(Clone, Copy, Debug)]
struct Rows {
    slope: usize,
    scalars: usize,
    strain: usize,
    vectors: usize,
}

/// Of σ_ik, its section of a row of stresses.
const SECTION: [[usize; 2]; 2] = [[0, 2], [2, 1]];

impl Strains {
    /// Adds the points of a rule to the stiffness of a cell. `shapes` are the plain functions
    /// there; `fields` are the unknowns of the rule's patches, and `numbers` the places of these
    /// patches in the matrix, ascending.
    pub(super) fn integrate(
        &mut self,
        law: &Law<'_>,
        (rule, shapes): (&Rule, &Shapes),
        (fields, numbers): (&[Fields<'_>], &[usize]),
        matrix: &mut CellMatrix,
    ) {
        let vectors = fields.iter().map(Fields::vectors).sum();
        self.clear(law, rule, &rule.weights, vectors);
        let rows = self.see_all(fields, shapes);
        let n = rows.len();
        let pairs = || (0..n).flat_map(|k| (k..n).map(move |l| (k, l)));
        for (m, term) in law.terms.iter().enumerate() {
            self.weigh(rule, |x| law.coefficients(x)[m]);
            for (k, l) in pairs() {
                let places = [numbers[k], numbers[l]];
                self.add_scalars(term, [rows[k], rows[l]], shapes.points, (matrix, places));
            }
        }
        f64::dispatch(Stresses(self));
        for (k, l) in pairs().filter(|&(k, l)| rows[k].vectors + rows[l].vectors > 0) {
            let block = matrix.block_mut(numbers[k], numbers[l]);
            self.add_vectors([rows[k], rows[l]], shapes.points, block);
        }
    }

    /// Multiplies the slopes by the weights of a rule and a coefficient.
    fn weigh(&mut self, rule: &Rule, coefficient: impl Fn(Vec2) -> f64) {
        let points = rule.offsets.iter().zip(&rule.weights);
        let factors: Vec<f64> = points.map(|(&o, w)| w * coefficient(rule.anchor + o)).collect();
        self.weighted.clear();
        for row in self.slopes.chunks_exact(factors.len().max(1)) {
            self.weighted.extend(row.iter().zip(&factors).map(|(slope, factor)| slope * factor));
        }
    }

    /// K_(i,a)(j,b) += Σ_kl C_ikjl ∫ a ∂_k ψ_a ∂_l ψ_b for the functions that each component has
    /// for itself, C a term of the law.
    fn add_scalars(
        &mut self,
        law: &LawAt,
        [p, q]: [Rows; 2],
        n: usize,
        (matrix, places): (&mut CellMatrix, [usize; 2]),
    ) {
        let components = law.components();
        let pairs = || (0..components * components).map(|n| (n / components, n % components));
        for (k, l) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let factors =
                pairs().map(|(i, j)| ([i * p.scalars, j * q.scalars], law.entry([i, k], [j, l])));
            let factors: Vec<_> = factors.filter(|(_, factor)| *factor != 0.0).collect();
            if factors.is_empty() {
                continue;
            }
            self.products.resize(p.scalars * q.scalars, 0.0);
            let to = MatMut::from_row_major_slice_mut(&mut self.products, p.scalars, q.scalars);
            let [left, right] = [p.slopes(&self.slopes, k, n), q.slopes(&self.weighted, l, n)];
            matmul(to, Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
            for (at, factor) in factors {
                matrix.add(places, at, (&self.products, q.scalars), factor);
            }
        }
    }

    /// ∫ ε_a · σ_b where one or both of the unknowns are vector fields.
    fn add_vectors(&self, [p, q]: [Rows; 2], n: usize, mut block: MatMut<'_, f64>) {
        let length = self.sections * self.stride;
        let of =
            |array, rows: Rows| part(array, rows.strain * length, rows.vectors, length, length);
        let [own, other] = [p, q].map(|rows| of(&self.stress, rows));
        let (below, beside) = (2 * p.scalars, 2 * q.scalars);
        for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let first = SECTION[i][k] * self.stride;
            let (left, right) = (p.slopes(&self.slopes, k, n), other.subcols(first, n).transpose());
            let to = block.rb_mut().submatrix_mut(i * p.scalars, beside, p.scalars, q.vectors);
            matmul(to, Accum::Add, left, right, 1.0, Par::Seq);
            let (left, right) = (own.subcols(first, n), q.slopes(&self.slopes, k, n).transpose());
            let to = block.rb_mut().submatrix_mut(below, i * q.scalars, p.vectors, q.scalars);
            matmul(to, Accum::Add, left, right, 1.0, Par::Seq);
        }
        let to = block.submatrix_mut(below, beside, p.vectors, q.vectors);
        matmul(to, Accum::Add, of(&self.strain, p), other.transpose(), 1.0, Par::Seq);
    }

    /// Room for the rows of unknowns, all zero, and the rigidity at the points.
    fn clear(&mut self, law: &Law<'_>, rule: &Rule, weights: &[f64], rows: usize) {
        let points = weights.len();
        self.sections = if law.components == 1 { 2 } else { SECTIONS };
        self.stride = points.next_multiple_of(<f64 as Scalar>::VECTOR);
        for (array, rows) in [
            (&mut self.strain, self.sections * rows),
            (&mut self.stress, self.sections * rows),
            (&mut self.rigidity, self.sections * self.sections),
        ] {
            array.clear();
            array.resize(rows * self.stride, 0.0);
        }
        let uniform = law.is_uniform().then(|| law.rigidity(rule.anchor));
        for (q, (&offset, weight)) in rule.offsets.iter().zip(weights).enumerate() {
            let Rigidity(rigidity) = uniform.unwrap_or_else(|| law.rigidity(rule.anchor + offset));
            for (k, row) in rigidity.iter().enumerate().take(self.sections) {
                for (l, entry) in row.iter().enumerate().take(self.sections) {
                    self.rigidity[(k * self.sections + l) * self.stride + q] = weight * entry;
                }
            }
        }
    }

    /// The slopes and strains of the unknowns of all patches, whose functions stand one after
    /// the other.
    fn see_all(&mut self, fields: &[Fields<'_>], shapes: &Shapes) -> Vec<Rows> {
        let length = fields.iter().map(|fields| 2 * fields.scalar.nrows() * shapes.points).sum();
        self.slopes.resize(length, 0.0);
        let (mut function, mut slope, mut strain) = (0, 0, 0);
        let of_patch = |fields: &Fields<'_>| {
            let (scalars, vectors) = (fields.scalar.nrows(), fields.vectors());
            let rows = Rows { slope, scalars, strain, vectors };
            self.see(fields, shapes, function, rows);
            function += fields.plain();
            slope += 2 * scalars * shapes.points;
            strain += vectors;
            rows
        };
        fields.iter().map(of_patch).collect()
    }

    /// The slopes and strains of the unknowns of a patch, whose functions stand from `function` on.
    fn see(&mut self, fields: &Fields<'_>, shapes: &Shapes, function: usize, rows: Rows) {
        let slopes = |n: usize| {
            [&shapes.dx, &shapes.dy].map(|array| shapes.rows(array, function..function + n))
        };
        let (n, Fields { scalar, vector }) = (shapes.points, *fields);
        for (k, slope) in slopes(scalar.ncols()).into_iter().enumerate() {
            let to = &mut self.slopes[rows.section(k, n)];
            let to = MatMut::from_row_major_slice_mut(to, rows.scalars, n);
            matmul(to, Accum::Replace, scalar, slope, 1.0, Par::Seq);
        }
        let Some([x, y]) = vector else { return };
        let ([dx, dy], (row, fields)) = (slopes(x.ncols()), (rows.strain, rows.vectors));
        matmul(self.section(row, fields, 0, n), Accum::Replace, x, dx, 1.0, Par::Seq);
        matmul(self.section(row, fields, 1, n), Accum::Replace, y, dy, 1.0, Par::Seq);
        matmul(self.section(row, fields, 2, n), Accum::Replace, x, dy, 1.0, Par::Seq);
        matmul(self.section(row, fields, 2, n), Accum::Add, y, dx, 1.0, Par::Seq);
    }

    /// A section of some rows.
    fn section(&mut self, row: usize, rows: usize, section: usize, n: usize) -> MatMut<'_, f64> {
        let length = self.sections * self.stride;
        let first = row * length + section * self.stride;
        let values = match rows {
            0 => &mut [],
            _ => &mut self.strain[first..first + (rows - 1) * length + n],
        };
        // not `from_row_major_slice_with_stride_mut`: that of faer 0.24.4 swaps the strides and
        // lets products write beyond the slice
        MatMut::from_column_major_slice_with_stride_mut(values, n, rows, length).transpose_mut()
    }
}

impl Rows {
    /// The place of the slopes along an axis.
    fn section(&self, axis: usize, n: usize) -> Range<usize> {
        let first = self.slope + axis * self.scalars * n;
        first..first + self.scalars * n
    }

    /// The slopes along an axis: [functions, points].
    fn slopes<'a>(&self, array: &'a [f64], axis: usize, n: usize) -> MatRef<'a, f64> {
        MatRef::from_row_major_slice(&array[self.section(axis, n)], self.scalars, n)
    }
}

/// Some rows of an array.
fn part(
    array: &[f64],
    first: usize,
    rows: usize,
    columns: usize,
    stride: usize,
) -> MatRef<'_, f64> {
    MatRef::from_row_major_slice(&array[first..first + rows * stride], rows, columns)
}

/// The work σ = D ε.
struct Stresses<'a>(&'a mut Strains);

impl Job<f64> for Stresses<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        match self.0.sections {
            2 => self.0.stresses::<R, 2>(zero),
            _ => self.0.stresses::<R, SECTIONS>(zero),
        }
    }
}

impl Strains {
    #[inline(always)]
    fn stresses<R: Real<Scalar = f64>, const S: usize>(&mut self, zero: R) {
        let (stride, length) = (self.stride, S * self.stride);
        let mut q = 0;
        while q < stride {
            let mut rigidity = [[zero; S]; S];
            let mut k = 0;
            while k < S * S {
                rigidity[k / S][k % S] = zero.load(&self.rigidity[k * stride + q..]);
                k += 1;
            }
            let mut first = q;
            while first < self.strain.len() {
                let mut strain = [zero; S];
                let mut k = 0;
                while k < S {
                    strain[k] = zero.load(&self.strain[first + k * stride..]);
                    k += 1;
                }
                k = 0;
                while k < S {
                    let (mut stress, mut l) = (rigidity[k][0] * strain[0], 1);
                    while l < S {
                        stress = rigidity[k][l].mul_add(strain[l], stress);
                        l += 1;
                    }
                    stress.store(&mut self.stress[first + k * stride..]);
                    k += 1;
                }
                first += length;
            }
            q += R::LANES;
        }
    }
}

impl Assembly<'_> {
    /// The unknowns of some patches.
    pub(super) fn fields(&self, patches: &[u32], tied: bool) -> Vec<Fields<'_>> {
        patches.iter().map(|&patch| self.basis.fields(patch, tied)).collect()
    }
}
