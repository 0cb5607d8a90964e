//! The stable basis: shape functions transformed patch by patch before anything is integrated.
//!
//! The system could be assembled in the plain functions and transformed afterwards, T K Tᵀ. That
//! multiplies the rounding errors of K by up to 1/ε, which forces a cut-off ε of 1e-9; a cut-off
//! that large drops jumps across slivers and leaves an error floor at 1e-4 (see
//! `docs/decisions/0002-stable-basis.md`). Functions transformed at the quadrature points have no
//! such amplification.

mod confined;
mod gram;
mod held;
mod local;
mod shape;
mod tie;
mod transform;
mod williams;

use crate::quadrature::{CellRule, EdgeRule};
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use confined::{reductions, sole_support};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use gram::grams;
use local::LocalBasis;
pub(crate) use local::PatchFields;
use ppum::dataset::monomials;
pub(crate) use shape::{ShapeEvaluator, Shapes};
use std::collections::BTreeMap;
use std::sync::Arc;
use williams::stored;

/// A penalty on values at a part of the boundary, β ∫ N Nᵀ: what Nitsche's method adds to a
/// cell's system.
pub struct Penalty {
    /// Rules on the boundary of one cell where values are given.
    pub(crate) rules: Vec<EdgeRule>,
    /// β over λ + 2μ or the conductivity \[1/L\].
    pub(crate) weight: f64,
}

/// The stable basis of every patch.
#[derive(Debug)]
pub struct StableBasis {
    patches: Vec<Arc<LocalBasis>>,
    /// The kind of each patch that has the functions of all of its kind.
    kinds: Vec<Option<usize>>,
    /// The number of functions kept in each patch.
    pub(crate) sizes: Vec<usize>,
    /// For each patch, the first functions of the jumps around corners and junctions of cracks
    /// whose support lies almost entirely under other patches.
    pub sole_support: Vec<Vec<usize>>,
}

impl StableBasis {
    /// The basis of a space, from the Gram matrices of its patches. Advances the stage by twice the
    /// number of cells.
    ///
    /// # Errors
    /// Functions that are not finite, with their place; cancelled.
    pub fn new(space: &TrialSpace<'_>, stage: &WorkPhase<'_>) -> Result<Self, Halt> {
        let grams = grams(space, stage)?;
        let reductions = reductions(space, &grams, stage)?;
        let (alike, none) = (space.alike(), Vec::new());
        let mut of_kinds: Vec<Option<Arc<LocalBasis>>> = vec![None; alike.patch_kinds.len()];
        let mut first = vec![usize::MAX; of_kinds.len()];
        let is_free = |i: usize| space.held_lines(i).is_empty();
        let kinds: Vec<_> =
            (0..grams.len()).map(|i| alike.patch(i).filter(|_| is_free(i))).collect();
        (0..).zip(&kinds).for_each(|(i, kind)| {
            kind.iter().for_each(|&kind| first[kind] = first[kind].min(i));
        });
        let mut patches = Vec::with_capacity(grams.len());
        in_batches(
            stage,
            grams.len(),
            || (),
            |(), i| {
                if kinds[i].is_some_and(|kind| first[kind] != i) {
                    return Ok(None);
                }
                LocalBasis::new(space, i, &grams[i], reductions.get(&i).unwrap_or(&none))
                    .map(|basis| Some(Arc::new(basis)))
                    .map_err(|_| Halt::at(space.partition().support(i)))
            },
            |i, basis| {
                let known = kinds[i].map(|kind| &mut of_kinds[kind]);
                patches.push(match (basis, known) {
                    (Some(new), None) => new,
                    (Some(new), Some(known)) => Arc::clone(known.insert(new)),
                    (None, known) => Arc::clone(
                        known.and_then(|known| known.as_ref()).expect("the first of a kind"),
                    ),
                });
            },
        )?;
        let sole_support = (0..patches.len()).map(|i| sole_support(space, i, &grams[i])).collect();
        Ok(Self { sizes: sizes(&patches), patches, kinds, sole_support })
    }

    /// The basis of some patches of kinds alone, as of a space that has no others.
    pub(crate) fn of_patches(&self, patches: &[u32]) -> Self {
        let patches: Vec<_> =
            patches.iter().map(|&p| Arc::clone(&self.patches[p as usize])).collect();
        let n = patches.len();
        let (kinds, sole_support) = (vec![None; n], vec![Vec::new(); n]);
        Self { sizes: sizes(&patches), patches, kinds, sole_support }
    }

    /// The kind of a patch, if it has the functions that all of its kind have.
    pub(crate) fn kind(&self, patch: u32) -> Option<usize> {
        self.kinds[patch as usize]
    }

    /// Returns the unknowns of a patch as fields: vector fields, or all functions in each component
    /// where `tied` is false.
    pub(crate) fn fields(&self, patch: u32, tied: bool) -> PatchFields<'_> {
        self.patches[patch as usize].fields(tied)
    }

    /// Makes the basis of patches orthonormal in I + Σ w ∫ N Nᵀ, the sum over penalties with
    /// weights w: functions that a large penalty acts on become small, and no row of the matrix is
    /// much larger than others. Nothing is cut off.
    ///
    /// # Errors
    /// Functions that are not finite, with their place; cancelled.
    pub fn rescale(&mut self, space: &TrialSpace<'_>, penalties: &[Penalty]) -> Result<(), Halt> {
        for (patch, gram) in self.boundary_grams(space, penalties) {
            self.kinds[patch as usize] = None;
            Arc::make_mut(&mut self.patches[patch as usize])
                .rescale(gram.as_ref())
                .map_err(|_| Halt::at(space.partition().support(patch as usize)))?;
        }
        Ok(())
    }

    /// I + Σ w ∫ N Nᵀ of the patches that rules on the boundary see.
    fn boundary_grams(
        &self,
        space: &TrialSpace<'_>,
        penalties: &[Penalty],
    ) -> BTreeMap<u32, Mat<f64>> {
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

    /// Returns the number of unknowns of each patch.
    pub fn unknowns(&self, components: usize) -> impl Iterator<Item = usize> + '_ {
        self.patches.iter().map(move |patch| patch.unknowns(components))
    }

    /// Returns the number of unknowns cut off in each patch.
    pub fn cut_off(&self, components: usize) -> impl Iterator<Item = usize> + '_ {
        self.patches.iter().map(move |patch| patch.cut_off(components))
    }

    /// Returns the least eigenvalue of each patch's Gram matrix that was kept, see
    /// `LocalBasis::least`.
    pub fn least(&self) -> Vec<f64> {
        self.patches.iter().map(|patch| patch.least).collect()
    }

    /// Bytes of all transformations.
    pub fn bytes(&self) -> usize {
        let values = |m: &Mat<f64>| m.nrows() * m.ncols();
        let of = |patch: &LocalBasis| values(&patch.matrix) + patch.tie.as_ref().map_or(0, values);
        self.patches.iter().map(|patch| of(patch)).sum::<usize>() * size_of::<f64>()
    }

    /// The transformation T of a patch \[kept, functions\].
    pub(crate) fn transform(&self, patch: u32) -> MatRef<'_, f64> {
        self.patches[patch as usize].matrix.as_ref()
    }

    /// Returns the unknowns of a patch whose components share some, in terms of each function in
    /// each component: [unknowns, components · functions], component by component.
    pub(crate) fn tie(&self, patch: u32) -> Option<&Mat<f64>> {
        self.patches[patch as usize].tie.as_ref()
    }

    /// Returns the matrix that takes the functions of a field to the unknowns of a patch with a
    /// tie.
    pub(crate) fn inverse_tie(&self, patch: u32) -> Option<&Mat<f64>> {
        self.patches[patch as usize].inverse.as_ref().or(self.tie(patch))
    }

    /// Replaces plain shape functions of some patches by those of the basis.
    pub(crate) fn apply(&self, patches: &[u32], plain: &Shapes, out: &mut Shapes) {
        let kept = patches.iter().map(|&p| self.sizes[p as usize]).sum();
        out.resize(kept, plain.points, plain.slopes.len());
        let (mut from, mut to) = (0, 0);
        for &patch in patches {
            let t = &self.patches[patch as usize].matrix;
            for (source, target) in plain.arrays().zip(out.arrays_mut()) {
                let source = plain.rows(source, from..from + t.ncols());
                let range = to * plain.points..(to + t.nrows()) * plain.points;
                let target =
                    MatMut::from_row_major_slice_mut(&mut target[range], t.nrows(), plain.points);
                matmul(target, Accum::Replace, t, source, 1.0, Par::Seq);
            }
            (from, to) = (from + t.ncols(), to + t.nrows());
        }
    }

    /// Returns the coefficients of the functions that the solver evaluates from those of the basis,
    /// for each patch: a row for each component of each of some solutions.
    pub fn local_coefficients(&self, solutions: &[Vec<f64>], components: usize) -> Vec<Mat<f64>> {
        let mut first = 0;
        let of_patch = |basis: &Arc<LocalBasis>| {
            let own = first..first + basis.unknowns(components);
            first = own.end;
            let rows: Vec<_> =
                solutions.iter().flat_map(|u| basis.plain(&u[own.clone()], components)).collect();
            Mat::from_fn(rows.len(), basis.matrix.ncols(), |i, k| rows[i][k])
        };
        self.patches.iter().map(of_patch).collect()
    }

    /// Plain coefficients from those of the basis, patch by patch and component by component.
    pub fn plain(&self, space: &TrialSpace<'_>, solution: &[f64], components: usize) -> Vec<f64> {
        let mut rest = solution;
        let mut out = Vec::new();
        for (patch, basis) in self.patches.iter().enumerate() {
            let (part, tail) = rest.split_at(basis.unknowns(components));
            rest = tail;
            for component in basis.plain(part, components) {
                let mut component = stored(space, patch, &component);
                undo_shifts(space, patch, &mut component);
                out.append(&mut component);
            }
        }
        out
    }
}

fn sizes(patches: &[Arc<LocalBasis>]) -> Vec<usize> {
    patches.iter().map(|patch| patch.len()).collect()
}

/// c (f − σ) = c f − σ c: takes the constant parts of a patch's functions to its polynomials. Jumps
/// have the degree of the polynomials, which come first.
fn undo_shifts(space: &TrialSpace<'_>, patch: usize, coefficients: &mut [f64]) {
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
    pub(crate) fn new(space: &'s TrialSpace<'s>, basis: &'s StableBasis) -> Self {
        Self { basis, evaluator: ShapeEvaluator::of_series(space), plain: Shapes::default() }
    }

    /// The plain functions at the points of a rule.
    pub(crate) fn see(&mut self, rule: &CellRule) -> &Shapes {
        self.evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, &mut self.plain);
        &self.plain
    }

    /// The plain functions at the points that were looked at last.
    pub(crate) fn plain(&self) -> &Shapes {
        &self.plain
    }

    /// The basis functions at the points that were looked at last, of a rule with these patches.
    pub(crate) fn apply(&self, patches: &[u32], out: &mut Shapes) {
        self.basis.apply(patches, &self.plain, out);
    }

    /// The basis functions at the points of a rule along an edge; on a face of a crack its side.
    pub(crate) fn evaluate_edge(&mut self, rule: &EdgeRule, out: &mut Shapes) {
        self.evaluator.evaluate_edge(rule, &mut self.plain);
        self.basis.apply(&rule.patches, &self.plain, out);
    }
}
