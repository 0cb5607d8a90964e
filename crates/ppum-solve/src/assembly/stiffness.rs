//! The stiffness of a cell: K = ∫ ∇N·C·∇N.
//!
//! ```text
//! K_(i,a)(j,b) = Σ_kl C_ikjl ∫ ∂_k ψ_a ∂_l ψ_b
//! K_(i,a)b = Σ_k ∫ ∂_k ψ_a σ_ik(v_b)        K_ab = Σ_ik ∫ ∂_k v_ia σ_ik(v_b)
//! ```
//!
//! with functions ψ that each component has for itself, and vector fields v. All components share
//! the products of the slopes of ψ: a third of the operations. At each point the numbers of all
//! functions follow each other, so that integrals are sums of outer products, for which nothing has
//! to be transposed.

use super::Assembly;
use super::cell_matrix::CellMatrix;
use crate::basis::{PatchFields, Shapes};
use crate::law::{Law, LawAt, Rigidity};
use crate::quadrature::CellRule;
use faer::linalg::matmul::matmul;
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};
use ppum::real::{LaneJob, LaneNumber, Real};
use ppum::vec2::Vec2;
use std::ops::Range;

/// Gradients and stresses of unknowns at the points of a rule.
#[derive(Debug, Default)]
pub(super) struct PointGradients {
    /// ∂_k ψ, of each patch \[points, axes, functions\].
    slopes: Vec<f64>,
    /// The slopes times weights and a coefficient of the law.
    weighted: Vec<f64>,
    /// ∫ a ∂_k ψ_a ∂_l ψ_b of two patches, \[axes, functions, axes, functions\].
    products: Vec<f64>,
    /// ∂_k v_i, of each patch \[components, points, axes, fields\].
    gradients: Vec<f64>,
    /// σ_ik(v) times weights, in the same order.
    stresses: Vec<f64>,
}

/// The unknowns of a patch at the points of a rule: functions that each component has for itself,
/// vector fields, and the numbers of those of the patches before.
#[derive(Clone, Copy, Debug)]
struct PatchUnknowns {
    points: usize,
    scalars: usize,
    scalars_before: usize,
    vectors: usize,
    vectors_before: usize,
}

impl PointGradients {
    /// Adds the points of a rule to the stiffness of a cell. `shapes` are the plain functions
    /// there; `fields` are the unknowns of the rule's patches, and `numbers` the places of these
    /// patches in the matrix, ascending.
    pub(super) fn integrate(
        &mut self,
        law: &Law<'_>,
        (rule, shapes): (&CellRule, &Shapes),
        (fields, numbers): (&[PatchFields<'_>], &[usize]),
        matrix: &mut CellMatrix,
    ) {
        let all = self.evaluate_all(fields, shapes);
        let n = all.len();
        let pairs = || (0..n).flat_map(|k| (k..n).map(move |l| (k, l)));
        for (m, term) in law.terms.iter().enumerate() {
            self.weigh(rule, &all, |x| law.coefficients(x)[m]);
            for (k, l) in pairs() {
                self.add_scalars(term, [all[k], all[l]], (matrix, [numbers[k], numbers[l]]));
            }
        }
        if all.iter().all(|unknowns| unknowns.vectors == 0) {
            return;
        }
        self.find_stresses(law, rule, &all);
        for (k, l) in pairs().filter(|&(k, l)| all[k].vectors + all[l].vectors > 0) {
            self.add_vectors([all[k], all[l]], matrix.block_mut(numbers[k], numbers[l]));
        }
    }

    /// The gradients of the unknowns of all patches, whose functions stand one after the other.
    fn evaluate_all(&mut self, fields: &[PatchFields<'_>], shapes: &Shapes) -> Vec<PatchUnknowns> {
        let scalars: usize = fields.iter().map(|fields| fields.scalar.nrows()).sum();
        let vectors: usize = fields.iter().map(PatchFields::vectors).sum();
        self.slopes.resize(2 * scalars * shapes.points, 0.0);
        self.gradients.resize(4 * vectors * shapes.points, 0.0);
        let (mut first, mut scalars_before, mut vectors_before) = (0, 0, 0);
        let of_patch = |fields: &PatchFields<'_>| {
            let (points, scalars) = (shapes.points, fields.scalar.nrows());
            let vectors = fields.vectors();
            let unknowns =
                PatchUnknowns { points, scalars, scalars_before, vectors, vectors_before };
            self.evaluate(fields, shapes, first, &unknowns);
            first += fields.plain();
            (scalars_before, vectors_before) = (scalars_before + scalars, vectors_before + vectors);
            unknowns
        };
        fields.iter().map(of_patch).collect()
    }

    /// The gradients of the unknowns of a patch, whose functions stand from `first` on.
    fn evaluate(
        &mut self,
        fields: &PatchFields<'_>,
        shapes: &Shapes,
        first: usize,
        unknowns: &PatchUnknowns,
    ) {
        for (axis, array) in [&shapes.dx, &shapes.dy].into_iter().enumerate() {
            let combine = |factors: MatRef<'_, f64>, to: &mut [f64]| {
                let (rows, slopes) =
                    (factors.nrows(), shapes.rows(array, first..first + factors.ncols()));
                let to = MatMut::from_column_major_slice_mut(to, 2 * rows, shapes.points);
                let to = to.subrows_mut(axis * rows, rows);
                matmul(to, Accum::Replace, factors, slopes, 1.0, Par::Seq);
            };
            combine(fields.scalar, &mut self.slopes[unknowns.scalar_range()]);
            for (component, part) in fields.vector.iter().flatten().enumerate() {
                combine(*part, &mut self.gradients[unknowns.vector_range(component)]);
            }
        }
    }

    /// Multiplies the slopes by the weights of a rule and a coefficient.
    fn weigh(&mut self, rule: &CellRule, all: &[PatchUnknowns], coefficient: impl Fn(Vec2) -> f64) {
        let points = rule.offsets.iter().zip(&rule.weights);
        let factors: Vec<f64> = points.map(|(&o, w)| w * coefficient(rule.anchor + o)).collect();
        self.weighted.resize(self.slopes.len(), 0.0);
        for unknowns in all {
            let range = unknowns.scalar_range();
            let (from, to) = (&self.slopes[range.clone()], &mut self.weighted[range]);
            f64::dispatch(FactorWeights { from, factors: &factors, to });
        }
    }

    /// K_(i,a)(j,b) += Σ_kl C_ikjl ∫ a ∂_k ψ_a ∂_l ψ_b for the functions that each component has
    /// for itself, C a term of the law.
    fn add_scalars(
        &mut self,
        law: &LawAt,
        [p, q]: [PatchUnknowns; 2],
        (matrix, places): (&mut CellMatrix, [usize; 2]),
    ) {
        let (left, right) = (p.slopes(&self.slopes), q.slopes(&self.weighted));
        if law.components() == 1 {
            // C is a multiple of the unit tensor
            let block = matrix.block_mut(places[0], places[1]);
            let factor = law.modulus(0);
            matmul(block, Accum::Add, left, right.transpose(), factor, Par::Seq);
            return;
        }
        let (rows, columns) = (2 * p.scalars, 2 * q.scalars);
        self.products.resize(rows * columns, 0.0);
        let to = MatMut::from_row_major_slice_mut(&mut self.products, rows, columns);
        let (left, right) = (p.both_slopes(&self.slopes), q.both_slopes(&self.weighted));
        matmul(to, Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
        let sizes = [p.scalars, q.scalars];
        f64::dispatch(Contraction { law, products: &self.products, sizes, matrix, places });
    }

    /// ∫ ∇u·σ(v) where one or both of the unknowns are vector fields.
    fn add_vectors(&self, [p, q]: [PatchUnknowns; 2], mut block: MatMut<'_, f64>) {
        let n = 2 * p.points;
        let [own, other] = [p, q].map(|unknowns| unknowns.fields(&self.stresses));
        let (below, beside) = (2 * p.scalars, 2 * q.scalars);
        for i in 0..2 {
            let to = block.rb_mut().submatrix_mut(i * p.scalars, beside, p.scalars, q.vectors);
            let right = other.subcols(i * n, n).transpose();
            matmul(to, Accum::Add, p.slopes(&self.slopes), right, 1.0, Par::Seq);
            let to = block.rb_mut().submatrix_mut(below, i * q.scalars, p.vectors, q.scalars);
            let right = q.slopes(&self.slopes).transpose();
            matmul(to, Accum::Add, own.subcols(i * n, n), right, 1.0, Par::Seq);
        }
        let to = block.submatrix_mut(below, beside, p.vectors, q.vectors);
        matmul(to, Accum::Add, p.fields(&self.gradients), other.transpose(), 1.0, Par::Seq);
    }

    /// σ = C ∇v times weights.
    fn find_stresses(&mut self, law: &Law<'_>, rule: &CellRule, all: &[PatchUnknowns]) {
        let uniform = law.is_uniform().then(|| law.rigidity(rule.anchor));
        let points = rule.offsets.iter().zip(&rule.weights);
        let weighted = |(&offset, weight): (&Vec2, &f64)| {
            let Rigidity(d) = uniform.unwrap_or_else(|| law.rigidity(rule.anchor + offset));
            d.map(|row| row.map(|entry| weight * entry))
        };
        let rigidity: Vec<_> = points.map(weighted).collect();
        self.stresses.resize(self.gradients.len(), 0.0);
        for unknowns in all.iter().filter(|unknowns| unknowns.vectors > 0) {
            let range = unknowns.vector_range(0).start..unknowns.vector_range(1).end;
            let (gradients, to) = (&self.gradients[range.clone()], &mut self.stresses[range]);
            let fields = unknowns.vectors;
            f64::dispatch(Stresses { fields, rigidity: &rigidity, gradients, to });
        }
    }
}

impl PatchUnknowns {
    /// The place of the slopes.
    fn scalar_range(&self) -> Range<usize> {
        let first = 2 * self.points * self.scalars_before;
        first..first + 2 * self.points * self.scalars
    }

    /// The place of a component of the vector fields.
    fn vector_range(&self, component: usize) -> Range<usize> {
        let length = 2 * self.points * self.vectors;
        let first = 4 * self.points * self.vectors_before + component * length;
        first..first + length
    }

    /// The slopes: [functions, points · axes].
    fn slopes<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.scalar_range()];
        MatRef::from_column_major_slice(values, self.scalars, 2 * self.points)
    }

    /// The slopes: [axes · functions, points].
    fn both_slopes<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.scalar_range()];
        MatRef::from_column_major_slice(values, 2 * self.scalars, self.points)
    }

    /// Gradients or stresses of the vector fields: [fields, components · points · axes].
    fn fields<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.vector_range(0).start..self.vector_range(1).end];
        MatRef::from_column_major_slice(values, self.vectors, 4 * self.points)
    }
}

/// Numbers of all functions at each point times the factor of the point.
struct FactorWeights<'a> {
    from: &'a [f64],
    factors: &'a [f64],
    to: &'a mut [f64],
}

impl LaneJob<f64> for FactorWeights<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, _: R) {
        let length = (self.from.len() / self.factors.len().max(1)).max(1);
        let points = self.from.chunks_exact(length).zip(self.to.chunks_exact_mut(length));
        for ((from, to), factor) in points.zip(self.factors) {
            for (from, to) in from.iter().zip(to) {
                *to = from * factor;
            }
        }
    }
}

/// K_(i,a)(j,b) += Σ_kl C_ikjl G_(k,a)(l,b), row-major, for two patches with so many functions.
struct Contraction<'a> {
    law: &'a LawAt,
    products: &'a [f64],
    sizes: [usize; 2],
    matrix: &'a mut CellMatrix,
    places: [usize; 2],
}

impl LaneJob<f64> for Contraction<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, _: R) {
        let [rows, columns] = self.sizes;
        for [i, k, j, l] in self.law.entries() {
            let factor = self.law.entry([i, k], [j, l]);
            for a in 0..rows {
                let sums = self.matrix.row_mut(self.places, i * rows + a);
                let first = ((k * rows + a) * 2 + l) * columns;
                let sums = sums[j * columns..(j + 1) * columns].iter_mut();
                for (sum, g) in sums.zip(&self.products[first..first + columns]) {
                    *sum += factor * g;
                }
            }
        }
    }
}

/// The stresses of the vector fields of a patch.
struct Stresses<'a> {
    fields: usize,
    /// The law on (ε_11, ε_22, 2ε_12) at each point, times the weight.
    rigidity: &'a [[[f64; 3]; 3]],
    gradients: &'a [f64],
    to: &'a mut [f64],
}

impl LaneJob<f64> for Stresses<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, _: R) {
        let (half, n) = (self.gradients.len() / 2, self.fields);
        let ([first, second], (to, below)) =
            ([&self.gradients[..half], &self.gradients[half..]], self.to.split_at_mut(half));
        let gradients = first.chunks_exact(2 * n).zip(second.chunks_exact(2 * n));
        let stresses = to.chunks_exact_mut(2 * n).zip(below.chunks_exact_mut(2 * n));
        for (((u, v), (s, t)), d) in gradients.zip(stresses).zip(self.rigidity) {
            let ((ux, uy), (vx, vy)) = (u.split_at(n), v.split_at(n));
            let ((sx, sy), (tx, ty)) = (s.split_at_mut(n), t.split_at_mut(n));
            for a in 0..n {
                let (x, y, z) = (ux[a], vy[a], uy[a] + vx[a]);
                sx[a] = d[0][0] * x + d[0][1] * y + d[0][2] * z;
                ty[a] = d[1][0] * x + d[1][1] * y + d[1][2] * z;
                sy[a] = d[2][0] * x + d[2][1] * y + d[2][2] * z;
                tx[a] = sy[a];
            }
        }
    }
}

impl Assembly<'_> {
    /// The unknowns of some patches.
    pub(super) fn fields(&self, patches: &[u32], tied: bool) -> Vec<PatchFields<'_>> {
        patches.iter().map(|&patch| self.basis.fields(patch, tied)).collect()
    }
}
