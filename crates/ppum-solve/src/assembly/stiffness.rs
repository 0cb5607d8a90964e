//! The stiffness of a cell: K = ∫ ∇N·C·∇N.
//!
//! ```text
//! K_(i,a)(j,b) = Σ_kl C_ikjl ∫ D_k ψ_a D_l ψ_b
//! K_(i,a)b = Σ_k ∫ D_k ψ_a σ_ik(v_b)        K_ab = Σ_ik ∫ D_k v_ia σ_ik(v_b)
//! ```
//!
//! with the operators D_k of strains, functions ψ that each component has for itself, and vector
//! fields v. All components share the products of the slopes of ψ: a third of the operations. At
//! each point the numbers of all functions follow each other, so that integrals are sums of outer
//! products, for which nothing has to be transposed.

use super::Assembly;
use super::cell_matrix::CellMatrix;
use crate::basis::{PatchFields, Shapes};
use crate::law::{Law, LawAt};
use crate::quadrature::CellRule;
use faer::linalg::matmul::matmul;
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};
use ppum::real::{LaneJob, LaneNumber, Real};
use ppum::vec2::Vec2;
use std::ops::Range;

/// Strains and stresses of unknowns at the points of a rule.
#[derive(Debug, Default)]
pub(super) struct PointStrains {
    /// D_k ψ, of each patch \[points, operators, functions\].
    slopes: Vec<f64>,
    /// The slopes times weights and a coefficient of the law.
    weighted: Vec<f64>,
    /// ∫ a D_k ψ_a D_l ψ_b of two patches, \[operators, functions, operators, functions\].
    products: Vec<f64>,
    /// D_k v_i, of each patch \[components, points, operators, fields\].
    strains: Vec<f64>,
    /// σ_ik(v) times weights, in the same order.
    stresses: Vec<f64>,
}

/// The unknowns of a patch at the points of a rule: functions that each component has for itself,
/// vector fields, and the numbers of those of the patches before.
#[derive(Clone, Copy, Debug)]
struct PatchUnknowns {
    operators: usize,
    points: usize,
    scalars: usize,
    scalars_before: usize,
    vectors: usize,
    vectors_before: usize,
}

impl PointStrains {
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

    /// The strains of the unknowns of all patches, whose functions stand one after the other.
    fn evaluate_all(&mut self, fields: &[PatchFields<'_>], shapes: &Shapes) -> Vec<PatchUnknowns> {
        let scalars: usize = fields.iter().map(|fields| fields.scalar.nrows()).sum();
        let vectors: usize = fields.iter().map(PatchFields::vectors).sum();
        let operators = shapes.slopes.len();
        self.slopes.resize(operators * scalars * shapes.points, 0.0);
        self.strains.resize(2 * operators * vectors * shapes.points, 0.0);
        let (mut first, mut scalars_before, mut vectors_before) = (0, 0, 0);
        let of_patch = |fields: &PatchFields<'_>| {
            let (points, scalars) = (shapes.points, fields.scalar.nrows());
            let vectors = fields.vectors();
            let unknowns = PatchUnknowns {
                operators,
                points,
                scalars,
                scalars_before,
                vectors,
                vectors_before,
            };
            self.evaluate(fields, shapes, first, &unknowns);
            first += fields.plain();
            (scalars_before, vectors_before) = (scalars_before + scalars, vectors_before + vectors);
            unknowns
        };
        fields.iter().map(of_patch).collect()
    }

    /// The strains of the unknowns of a patch, whose functions stand from `first` on.
    fn evaluate(
        &mut self,
        fields: &PatchFields<'_>,
        shapes: &Shapes,
        first: usize,
        unknowns: &PatchUnknowns,
    ) {
        let operators = unknowns.operators;
        for (k, array) in shapes.slopes.iter().enumerate() {
            let combine = |factors: MatRef<'_, f64>, to: &mut [f64]| {
                let (rows, slopes) =
                    (factors.nrows(), shapes.rows(array, first..first + factors.ncols()));
                let to = MatMut::from_column_major_slice_mut(to, operators * rows, shapes.points);
                let to = to.subrows_mut(k * rows, rows);
                matmul(to, Accum::Replace, factors, slopes, 1.0, Par::Seq);
            };
            combine(fields.scalar, &mut self.slopes[unknowns.scalar_range()]);
            for (component, part) in fields.vector.iter().flatten().enumerate() {
                combine(*part, &mut self.strains[unknowns.vector_range(component)]);
            }
        }
    }

    /// Multiplies the slopes by the weights of a rule and a coefficient.
    fn weigh(&mut self, rule: &CellRule, all: &[PatchUnknowns], coefficient: impl Fn(Vec2) -> f64) {
        let factors: Vec<f64> = rule.points().map(|(x, w)| w * coefficient(x)).collect();
        self.weighted.resize(self.slopes.len(), 0.0);
        for unknowns in all {
            let range = unknowns.scalar_range();
            let (from, to) = (&self.slopes[range.clone()], &mut self.weighted[range]);
            f64::dispatch(ScaledRows { from, factors: &factors, to });
        }
    }

    /// K_(i,a)(j,b) += Σ_kl C_ikjl ∫ a D_k ψ_a D_l ψ_b for the functions that each component has
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
        let (rows, columns) = (p.operators * p.scalars, q.operators * q.scalars);
        self.products.resize(rows * columns, 0.0);
        let to = MatMut::from_row_major_slice_mut(&mut self.products, rows, columns);
        let (left, right) = (p.both_slopes(&self.slopes), q.both_slopes(&self.weighted));
        matmul(to, Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
        let (products, sizes) = (&self.products, [p.scalars, q.scalars]);
        let operators = q.operators;
        f64::dispatch(Contraction { law, operators, products, sizes, matrix, places });
    }

    /// ∫ σ(v):D u where one or both of the unknowns are vector fields.
    fn add_vectors(&self, [p, q]: [PatchUnknowns; 2], mut block: MatMut<'_, f64>) {
        let n = p.operators * p.points;
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
        matmul(to, Accum::Add, p.fields(&self.strains), other.transpose(), 1.0, Par::Seq);
    }

    /// σ(v) times weights.
    fn find_stresses(&mut self, law: &Law<'_>, rule: &CellRule, all: &[PatchUnknowns]) {
        let rigidity = law.rigidity(rule.points());
        self.stresses.resize(self.strains.len(), 0.0);
        for unknowns in all.iter().filter(|unknowns| unknowns.vectors > 0) {
            let range = unknowns.vector_range(0).start..unknowns.vector_range(1).end;
            let (strains, to) = (&self.strains[range.clone()], &mut self.stresses[range]);
            rigidity.stresses(unknowns.vectors, strains, to);
        }
    }
}

impl PatchUnknowns {
    /// The place of the slopes.
    fn scalar_range(&self) -> Range<usize> {
        let n = self.operators * self.points;
        n * self.scalars_before..n * (self.scalars_before + self.scalars)
    }

    /// The place of a component of the vector fields.
    fn vector_range(&self, component: usize) -> Range<usize> {
        let n = self.operators * self.points;
        let length = n * self.vectors;
        let first = 2 * n * self.vectors_before + component * length;
        first..first + length
    }

    /// The slopes: [functions, points · operators].
    fn slopes<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.scalar_range()];
        MatRef::from_column_major_slice(values, self.scalars, self.operators * self.points)
    }

    /// The slopes: [operators · functions, points].
    fn both_slopes<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.scalar_range()];
        MatRef::from_column_major_slice(values, self.operators * self.scalars, self.points)
    }

    /// Strains or stresses of the vector fields: [fields, components · points · operators].
    fn fields<'a>(&self, array: &'a [f64]) -> MatRef<'a, f64> {
        let values = &array[self.vector_range(0).start..self.vector_range(1).end];
        MatRef::from_column_major_slice(values, self.vectors, 2 * self.operators * self.points)
    }
}

/// Numbers of all functions at each point times the factor of the point.
struct ScaledRows<'a> {
    from: &'a [f64],
    factors: &'a [f64],
    to: &'a mut [f64],
}

impl LaneJob<f64> for ScaledRows<'_> {
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
    operators: usize,
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
                let first = ((k * rows + a) * self.operators + l) * columns;
                let sums = sums[j * columns..(j + 1) * columns].iter_mut();
                for (sum, g) in sums.zip(&self.products[first..first + columns]) {
                    *sum += factor * g;
                }
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
