//! The stable basis: shape functions transformed patch by patch before anything is integrated.
//!
//! The system could be assembled in the plain functions and transformed afterwards, T K Tᵀ. That
//! multiplies the rounding errors of K by up to 1/ε, which forces a cut-off ε of 1e-9; a cut-off that
//! large drops jumps across slivers and leaves an error floor at 1e-4 (see
//! `docs/decisions/0002-stable-basis.md`). Functions transformed at the quadrature points have no
//! such amplification.

mod confined;
mod local;
mod shape;
mod tie;
mod transform;
mod williams;

use crate::quadrature::{EdgeRule, Rule};
use crate::space::{Space, Unchanged};
use crate::watched::{Halt, Stage, in_batches};
use confined::{lonely, reductions};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use local::LocalBasis;
use ppum::dataset::monomials;
use ppum::vec2::Vec2;
pub(crate) use shape::{ShapeEvaluator, Shapes};
use std::collections::BTreeMap;
use std::ops::Range;

/// A penalty on values at a part of the border, β ∫ N Nᵀ: what Nitsche's method adds to a cell's system.
pub(crate) struct Penalty {
    /// Rules on the border of one cell where values are given.
    pub(crate) rules: Vec<EdgeRule>,
    /// β over λ + 2μ or the conductivity \[1/L\].
    pub(crate) weight: f64,
}

/// The stable basis of every patch.
#[derive(Debug)]
pub(crate) struct StableBasis {
    patches: Vec<LocalBasis>,
    /// Of each patch, the number of functions kept.
    pub(crate) sizes: Vec<usize>,
    /// Of each patch, the first functions of the jumps around corners and junctions of cracks of which nearly nothing lies
    /// where it is alone.
    pub(crate) lonely: Vec<Vec<usize>>,
    grams: Vec<Gram>,
}

/// What was made for an earlier space, and what is as it was.
pub(crate) type Earlier<'a, T> = Option<(&'a Unchanged, &'a T)>;

impl StableBasis {
    /// The basis of a space, from the Gram matrices of its patches, as far as they are not those of an earlier one. Advances the
    /// stage by twice the number of cells.
    ///
    /// # Errors
    /// Functions that are not finite, with their place; cancelled.
    pub(crate) fn new(
        space: &Space<'_>,
        earlier: Earlier<'_, Self>,
        stage: &Stage<'_>,
    ) -> Result<Self, Halt> {
        let grams = grams(space, earlier, stage)?;
        let reductions = reductions(space, &grams, stage)?;
        let none = Vec::new();
        let mut patches = Vec::with_capacity(grams.len());
        in_batches(
            stage,
            grams.len(),
            || (),
            |(), i| {
                LocalBasis::new(space, i, &grams[i], reductions.get(&i).unwrap_or(&none))
                    .map_err(|_| Halt::at(space.partition().support(i)))
            },
            |_, basis| patches.push(basis),
        )?;
        let sizes = patches.iter().map(LocalBasis::len).collect();
        let lonely = (0..patches.len()).map(|i| lonely(space, i, &grams[i])).collect();
        Ok(Self { patches, sizes, lonely, grams })
    }

    /// True if a patch has the very functions that a patch of another basis has.
    pub(crate) fn is_same(&self, patch: usize, other: &Self, its: usize) -> bool {
        self.patches[patch].is_same(&other.patches[its])
    }

    /// Makes the basis of patches orthonormal in I + Σ w ∫ N Nᵀ, the sum over penalties with weights w: functions
    /// that a large penalty acts on become small, and no row of the matrix is much larger than others. Nothing is
    /// cut off.
    ///
    /// # Errors
    /// Functions that are not finite, with their place; cancelled.
    pub(crate) fn damp(&mut self, space: &Space<'_>, penalties: &[Penalty]) -> Result<(), Halt> {
        for (patch, gram) in self.border_grams(space, penalties) {
            self.patches[patch as usize]
                .damp(gram.as_ref())
                .map_err(|_| Halt::at(space.partition().support(patch as usize)))?;
        }
        Ok(())
    }

    /// I + Σ w ∫ N Nᵀ of the patches that rules on the border see.
    fn border_grams(&self, space: &Space<'_>, penalties: &[Penalty]) -> BTreeMap<u32, Mat<f64>> {
        let (mut evaluator, mut shapes) = (BasisEvaluator::new(space, self), Shapes::default());
        let mut grams = BTreeMap::new();
        for (rule, weight) in
            penalties.iter().flat_map(|p| p.rules.iter().map(move |rule| (rule, p.weight)))
        {
            evaluator.evaluate_edge(rule, &mut shapes);
            shapes.scale(&rule.weights);
            let mut first = 0;
            for &patch in &rule.patches {
                let n = self.sizes[patch as usize];
                let gram = grams.entry(patch).or_insert_with(|| Mat::identity(n, n));
                let rows = shapes.rows(&shapes.value, first..first + n);
                matmul(gram.as_mut(), Accum::Add, rows, rows.transpose(), weight, Par::Seq);
                first += n;
            }
        }
        grams
    }

    /// Of each patch, the number of unknowns.
    pub(crate) fn unknowns(&self, components: usize) -> impl Iterator<Item = usize> + '_ {
        self.patches.iter().map(move |patch| patch.unknowns(components))
    }

    /// Of each patch, the number of unknowns cut off.
    pub(crate) fn cut_off(&self, components: usize) -> impl Iterator<Item = usize> + '_ {
        self.patches.iter().map(move |patch| patch.cut_off(components))
    }

    /// Of each patch, the least eigenvalue of its Gram matrix that was kept, see [`LocalBasis::least`].
    pub(crate) fn least(&self) -> Vec<f64> {
        self.patches.iter().map(|patch| patch.least).collect()
    }

    /// Bytes of all transformations.
    pub(crate) fn bytes(&self) -> usize {
        let values = |m: &Mat<f64>| m.nrows() * m.ncols();
        let of = |patch: &LocalBasis| values(&patch.matrix) + patch.tie.as_ref().map_or(0, values);
        self.patches.iter().map(of).sum::<usize>() * size_of::<f64>()
    }

    /// The transformation T of a patch \[kept, functions\].
    pub(crate) fn transform(&self, patch: u32) -> MatRef<'_, f64> {
        self.patches[patch as usize].matrix.as_ref()
    }

    /// Of a patch whose components share unknowns, what these are of each function in each component: [unknowns, components ·
    /// functions], component by component.
    pub(crate) fn tie(&self, patch: u32) -> Option<&Mat<f64>> {
        self.patches[patch as usize].tie.as_ref()
    }

    /// Replaces plain shape functions of some patches by those of the basis.
    pub(crate) fn apply(&self, patches: &[u32], plain: &Shapes, out: &mut Shapes) {
        let kept = patches.iter().map(|&p| self.sizes[p as usize]).sum();
        out.resize(kept, plain.points);
        let (mut from, mut to) = (0, 0);
        for &patch in patches {
            let t = &self.patches[patch as usize].matrix;
            for (source, target) in
                [(&plain.value, &mut out.value), (&plain.dx, &mut out.dx), (&plain.dy, &mut out.dy)]
            {
                let source = plain.rows(source, from..from + t.ncols());
                let range = to * plain.points..(to + t.nrows()) * plain.points;
                let target =
                    MatMut::from_row_major_slice_mut(&mut target[range], t.nrows(), plain.points);
                matmul(target, Accum::Replace, t, source, 1.0, Par::Seq);
            }
            (from, to) = (from + t.ncols(), to + t.nrows());
        }
    }

    /// Plain coefficients from those of the basis, patch by patch and component by component.
    pub(crate) fn plain(&self, space: &Space<'_>, solution: &[f64], components: usize) -> Vec<f64> {
        let mut rest = solution;
        let mut out = Vec::new();
        for (patch, basis) in self.patches.iter().enumerate() {
            let (part, tail) = rest.split_at(basis.unknowns(components));
            rest = tail;
            for mut component in basis.plain(part, components) {
                undo_shifts(space, patch, &mut component);
                out.append(&mut component);
            }
        }
        out
    }
}

/// c (f − σ) = c f − σ c: takes the constant parts of a patch's functions to its polynomials. Jumps
/// have the degree of the polynomials, which come first.
fn undo_shifts(space: &Space<'_>, patch: usize, coefficients: &mut [f64]) {
    let mut first = 0;
    for block in space.data().blocks(patch) {
        let size = monomials(space.data().block_degree[block] as usize);
        let shift = space.shifts[block];
        if shift != 0.0 {
            for k in 0..size {
                coefficients[k] -= shift * coefficients[first + k];
            }
        }
        first += size;
    }
}

/// Evaluates the functions of the stable basis.
#[derive(Debug)]
pub(crate) struct BasisEvaluator<'s> {
    basis: &'s StableBasis,
    evaluator: ShapeEvaluator<'s>,
    plain: Shapes,
}

impl<'s> BasisEvaluator<'s> {
    pub(crate) fn new(space: &'s Space<'s>, basis: &'s StableBasis) -> Self {
        Self { basis, evaluator: ShapeEvaluator::new(space), plain: Shapes::default() }
    }

    /// The basis functions of `patches`, which must be all that cover the points.
    pub(crate) fn evaluate(
        &mut self,
        anchor: Vec2,
        offsets: &[Vec2],
        patches: &[u32],
        out: &mut Shapes,
    ) {
        self.evaluator.evaluate(anchor, offsets, patches, &mut self.plain);
        self.basis.apply(patches, &self.plain, out);
    }

    /// The basis functions at the points of a rule along an edge; on a face of a crack its side.
    pub(crate) fn evaluate_edge(&mut self, rule: &EdgeRule, out: &mut Shapes) {
        self.evaluator.evaluate_edge(rule, &mut self.plain);
        self.basis.apply(&rule.patches, &self.plain, out);
    }
}

/// The measures of a patch's functions.
#[derive(Clone, Debug)]
struct Gram {
    /// ∫ ∇(φψ)·∇(φψ′) + h⁻² φ² ψ ψ′
    weighted: Mat<f64>,
    /// ∫ h⁻² ψ²
    plain: Vec<f64>,
    /// The same where the patch is alone.
    alone: Vec<f64>,
}

impl Gram {
    fn zero(functions: usize) -> Self {
        Self {
            weighted: Mat::zeros(functions, functions),
            plain: vec![0.0; functions],
            alone: vec![0.0; functions],
        }
    }

    fn add_part(&mut self, part: &Self) {
        self.weighted += &part.weighted;
        self.plain.iter_mut().zip(&part.plain).for_each(|(sum, part)| *sum += part);
        self.alone.iter_mut().zip(&part.alone).for_each(|(sum, part)| *sum += part);
    }

    /// Adds points of a patch's functions φψ times the roots of the weights; the first one has ψ = 1.
    fn add(&mut self, shapes: &Shapes, range: Range<usize>, weights: &[f64], half: Vec2) {
        let h2 = 1.0 / (half.x * half.y);
        for (array, factor) in [(&shapes.dx, 1.0), (&shapes.dy, 1.0), (&shapes.value, h2)] {
            let rows = shapes.rows(array, range.clone());
            let sum = self.weighted.as_mut();
            matmul(sum, Accum::Add, rows, rows.transpose(), factor, Par::Seq);
        }
        let is_alone = f64::from(u8::from(range.len() == shapes.functions));
        let rows = shapes.rows(&shapes.value, range);
        for (q, weight) in weights.iter().enumerate().filter(|&(q, _)| rows[(0, q)] > LEAST) {
            for (k, (sum, alone)) in self.plain.iter_mut().zip(&mut self.alone).enumerate() {
                let square = h2 * weight * (rows[(k, q)] / rows[(0, q)]).powi(2);
                *sum += square;
                *alone += is_alone * square;
            }
        }
    }
}

/// φ at which nothing of φψ is left but rounding.
const LEAST: f64 = 1e-280;

/// The Gram matrix of every patch, over the domain: of those that are as they were, the one that they had.
fn grams(
    space: &Space<'_>,
    earlier: Earlier<'_, StableBasis>,
    stage: &Stage<'_>,
) -> Result<Vec<Gram>, Halt> {
    let is_known = |coverers: &[u32]| earlier.is_some_and(|(unchanged, _)| unchanged.all(coverers));
    let quadrature = space.quadrature(0);
    let mut grams: Vec<_> = space.sizes.iter().map(|&n| Gram::zero(n)).collect();
    in_batches(
        stage,
        space.partition().len(),
        || (ShapeEvaluator::new(space), Shapes::default()),
        |(evaluator, shapes), cell| {
            let coverers = &space.coverers[cell];
            if is_known(coverers) {
                return Ok(Vec::new());
            }
            let mut parts: Vec<_> =
                coverers.iter().map(|&p| Gram::zero(space.sizes[p as usize])).collect();
            for rule in space.rules(&quadrature, cell).iter() {
                evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
                shapes.scale(&rule.weights);
                add_grams(space, rule, coverers, shapes, &mut parts);
            }
            Ok(parts)
        },
        |cell, parts| {
            for (&patch, part) in space.coverers[cell].iter().zip(&parts) {
                grams[patch as usize].add_part(part);
            }
        },
    )?;
    if let Some((unchanged, earlier)) = earlier {
        for (patch, gram) in grams.iter_mut().enumerate() {
            unchanged.patch(patch).into_iter().for_each(|k| gram.clone_from(&earlier.grams[k]));
        }
    }
    Ok(grams)
}

/// Adds the points of shapes that carry the roots of the weights.
fn add_grams(
    space: &Space<'_>,
    rule: &Rule,
    coverers: &[u32],
    shapes: &Shapes,
    parts: &mut [Gram],
) {
    let mut first = 0;
    for &patch in &rule.patches {
        let range = first..first + space.sizes[patch as usize];
        first = range.end;
        let k = coverers.binary_search(&patch).expect("a rule's patches meet its cell");
        parts[k].add(shapes, range, &rule.weights, space.partition().half[patch as usize]);
    }
}
