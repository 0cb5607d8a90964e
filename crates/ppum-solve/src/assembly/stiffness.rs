//! The stiffness of a cell: K = ∫ Bᵀ D B.
//!
//! ```text
//! ε = (∂₁u₁, ∂₂u₂, ∂₂u₁ + ∂₁u₂)   or   ∇u of a potential        σ = D ε        K_ab = ∫ ε_a · σ_b
//! ```
//!
//! A row of strains is that of one unknown at all points of a rule, section by section; products of rows of strains with rows of
//! weighted stresses are integrals.

use super::Assembly;
use crate::basis::{Fields, Shapes};
use crate::law::{Law, Rigidity};
use crate::quadrature::Rule;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use ppum::real::{Job, Real, Scalar};
use std::borrow::Cow;

/// Most components of a strain.
const SECTIONS: usize = 3;

/// A symmetric matrix over the unknowns of some patches, row-major; of blocks of different patches only those are there of
/// which the first patch comes before the second.
#[derive(Clone, Debug)]
pub(super) struct CellMatrix {
    /// First unknown of each patch, and their number.
    first: Vec<usize>,
    values: Vec<f64>,
}

impl CellMatrix {
    /// Zero, for patches with so many unknowns.
    pub(super) fn new(sizes: impl Iterator<Item = usize>) -> Self {
        let mut first = vec![0];
        sizes.for_each(|size| first.push(first[first.len() - 1] + size));
        let n = first[first.len() - 1];
        Self { values: vec![0.0; n * n], first }
    }

    fn n(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// The unknowns of patch k with those of patch l.
    pub(super) fn block(&self, k: usize, l: usize) -> MatRef<'_, f64> {
        let all = MatRef::from_row_major_slice(&self.values, self.n(), self.n());
        let [rows, columns] = [k, l].map(|k| self.first[k]..self.first[k + 1]);
        all.submatrix(rows.start, columns.start, rows.len(), columns.len())
    }

    pub(super) fn block_mut(&mut self, k: usize, l: usize) -> MatMut<'_, f64> {
        let n = self.n();
        let [rows, columns] = [k, l].map(|k| self.first[k]..self.first[k + 1]);
        MatMut::from_row_major_slice_mut(&mut self.values, n, n).submatrix_mut(
            rows.start,
            columns.start,
            rows.len(),
            columns.len(),
        )
    }

    /// Makes all blocks those of one symmetric matrix.
    pub(super) fn complete(&mut self) {
        let n = self.n();
        for a in 0..n {
            (0..a).for_each(|b| self.values[a * n + b] = self.values[b * n + a]);
        }
    }
}

/// The stiffness of a cell: a matrix over its patches in some order.
#[derive(Clone, Debug)]
pub(super) struct Stiffness<'a> {
    pub(super) matrix: Cow<'a, CellMatrix>,
    /// The place of each patch of the cell in that order; none if it is their own.
    pub(super) seats: Option<Vec<usize>>,
}

impl Stiffness<'_> {
    /// The unknowns of patch k of the cell with those of patch l, which does not come before it.
    pub(super) fn block(&self, k: usize, l: usize) -> MatRef<'_, f64> {
        match &self.seats {
            Some(seats) => self.matrix.block(seats[k], seats[l]),
            None => self.matrix.block(k, l),
        }
    }
}

/// Rows of strains and of weighted stresses at the points of a rule.
#[derive(Debug, Default)]
pub(crate) struct Strains {
    /// Length of a section: points, and zeros up to whole vectors.
    stride: usize,
    sections: usize,
    strain: Vec<f64>,
    stress: Vec<f64>,
    /// D times the weights, [sections · sections, stride].
    rigidity: Vec<f64>,
}

impl Strains {
    /// Adds the points of a rule to the stiffness of a cell. `shapes` are the plain functions there; `fields` are the
    /// unknowns of the rule's patches, and `numbers` the places of these patches in the matrix, ascending.
    pub(super) fn integrate(
        &mut self,
        law: &Law<'_>,
        (rule, shapes): (&Rule, &Shapes),
        (fields, numbers): (&[Fields<'_>], &[usize]),
        matrix: &mut CellMatrix,
    ) {
        let rows: Vec<usize> = fields.iter().map(|fields| fields.len(law.components)).collect();
        self.clear(law, rule, &rule.weights, rows.iter().sum());
        let (mut row, mut function) = (0, 0);
        for (fields, rows) in fields.iter().zip(&rows) {
            function = self.see(fields, law.components, shapes, function, row);
            row += rows;
        }
        f64::dispatch(Stresses(self));
        let length = self.sections * self.stride;
        let part = |array, first, rows| part(array, first * length, rows, length, length);
        let mut first = 0;
        for (k, &p) in numbers.iter().enumerate() {
            let strains = part(&self.strain, first, rows[k]);
            let mut second = first;
            for (l, &q) in numbers.iter().enumerate().skip(k) {
                let stresses = part(&self.stress, second, rows[l]).transpose();
                let block = matrix.block_mut(p, q);
                matmul(block, Accum::Add, strains, stresses, 1.0, Par::Seq);
                second += rows[l];
            }
            first += rows[k];
        }
    }

    /// Adds ∫ ε_a·σ_b of all pairs of fields to a matrix, with weights of their own at the points of a rule. The slopes by x and y
    /// have a row for each component of each field.
    pub(crate) fn add_products(
        &mut self,
        law: &Law<'_>,
        (rule, weights): (&Rule, &[f64]),
        [dx, dy]: [&[f64]; 2],
        sum: &mut Mat<f64>,
    ) {
        let (fields, n) = (sum.nrows(), weights.len());
        self.clear(law, rule, weights, fields);
        let row = |array: &[f64], k: usize| array[k * n..(k + 1) * n].to_vec();
        for field in 0..fields {
            let sections = if law.components == 1 {
                vec![row(dx, field), row(dy, field)]
            } else {
                let [first, second] = [2 * field, 2 * field + 1];
                let mut shear = row(dy, first);
                shear.iter_mut().zip(row(dx, second)).for_each(|(sum, slope)| *sum += slope);
                vec![row(dx, first), row(dy, second), shear]
            };
            for (k, section) in sections.iter().enumerate() {
                let first = (field * self.sections + k) * self.stride;
                self.strain[first..first + n].copy_from_slice(section);
            }
        }
        f64::dispatch(Stresses(self));
        let length = self.sections * self.stride;
        let [strains, stresses] =
            [&self.strain, &self.stress].map(|array| part(array, 0, fields, length, length));
        matmul(sum.as_mut(), Accum::Add, strains, stresses.transpose(), 1.0, Par::Seq);
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

    /// The strains of a patch's unknowns, from a row on; its functions stand from `function` on. Returns the next function.
    fn see(
        &mut self,
        fields: &Fields<'_>,
        components: usize,
        shapes: &Shapes,
        function: usize,
        row: usize,
    ) -> usize {
        let slopes = |n: usize| {
            [&shapes.dx, &shapes.dy].map(|array| shapes.rows(array, function..function + n))
        };
        let (n, Fields { scalar, vector }) = (shapes.points, *fields);
        let [dx, dy] = slopes(scalar.ncols());
        let own = scalar.nrows();
        if components == 1 {
            matmul(self.section(row, own, 0, n), Accum::Replace, scalar, dx, 1.0, Par::Seq);
            matmul(self.section(row, own, 1, n), Accum::Replace, scalar, dy, 1.0, Par::Seq);
            return function + scalar.ncols();
        }
        matmul(self.section(row, own, 0, n), Accum::Replace, scalar, dx, 1.0, Par::Seq);
        matmul(self.section(row, own, 2, n), Accum::Replace, scalar, dy, 1.0, Par::Seq);
        (0..own).for_each(|k| self.turn(row + k, row + own + k));
        let Some([x, y]) = vector else { return function + scalar.ncols() };
        let [dx, dy] = slopes(x.ncols());
        let (row, fields) = (row + 2 * own, x.nrows());
        matmul(self.section(row, fields, 0, n), Accum::Replace, x, dx, 1.0, Par::Seq);
        matmul(self.section(row, fields, 1, n), Accum::Replace, y, dy, 1.0, Par::Seq);
        matmul(self.section(row, fields, 2, n), Accum::Replace, x, dy, 1.0, Par::Seq);
        matmul(self.section(row, fields, 2, n), Accum::Add, y, dx, 1.0, Par::Seq);
        function + x.ncols()
    }

    /// A section of some rows.
    fn section(&mut self, row: usize, rows: usize, section: usize, n: usize) -> MatMut<'_, f64> {
        let length = self.sections * self.stride;
        let first = row * length + section * self.stride;
        let values = match rows {
            0 => &mut [],
            _ => &mut self.strain[first..first + (rows - 1) * length + n],
        };
        // not `from_row_major_slice_with_stride_mut`: that of faer 0.24.4 swaps the strides and lets products write beyond the slice
        MatMut::from_column_major_slice_with_stride_mut(values, n, rows, length).transpose_mut()
    }

    /// The strains of a function in the second component from those in the first.
    fn turn(&mut self, from: usize, to: usize) {
        let (length, stride) = (self.sections * self.stride, self.stride);
        let (from, to) = (from * length, to * length);
        self.strain.copy_within(from..from + stride, to + 2 * stride);
        self.strain.copy_within(from + 2 * stride..from + length, to + stride);
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
