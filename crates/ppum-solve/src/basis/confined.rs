//! Jumps that two patches have in common.
//!
//! Where cracks branch, what lies between two arms may belong to two patches only where these
//! overlap. There the sum of their partition functions is one, or nearly, and a function b of the
//! one can be had from the other as well: φ₁ (φ₂ q) = φ₂ (φ₁ q). Jumps *confined* so make the
//! system singular, or nearly so as the branch moves. Each patch leaves out the combinations that
//! earlier patches already represent: with their joint Gram matrix, and N for the functions that
//! earlier patches keep,
//!
//! ```text
//! S = G_ii − G_iN G_NN⁻¹ G_Ni = U Λ Uᵀ,   keep λ > τ        where G_ii = I
//! ```

use super::gram::{Gram, LEAST};
use super::shape::{ShapeEvaluator, Shapes};
use super::transform::{CUT_OFF, FunctionCombinations};
use crate::quadrature::CellRule;
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::crack::Crack;
use ppum::dataset::monomials;
use ppum::function::FunctionKind;
use ppum_linear::{EigenError, SymmetricEigen, inverse_root_diagonal, scaled};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// Part of the square of a jump outside of another patch up to which the other patch confines it.
const OUTSIDE: f64 = 0.1;

/// Square τ of the part of a function that earlier patches must lack. The condition is bounded by
/// 1/τ; smaller ones change no stress intensity factor by more than 1e-6.
const LACKING: f64 = 1e-4;

/// A jump of a patch that no point of its has for itself, or nearly none.
#[derive(Clone, Debug)]
struct Jump {
    patch: usize,
    /// The functions of its block among those of the patch.
    functions: Range<usize>,
    /// ∫ h⁻² ψ² of the first of them.
    square: f64,
}

/// Integrals over what two jumps have in common.
#[derive(Clone, Debug)]
struct JumpIntegrals {
    /// The integrals of ∇(φψ)·∇(φψ′) + h⁻² φ² ψ ψ′.
    gram: Mat<f64>,
    /// The integrals of h⁻² ψ² for the first functions of both, where both patches are.
    squares: [f64; 2],
}

/// Returns, for the patches that lose functions, the combinations of these functions that stay.
///
/// # Errors
/// Functions that are not finite, with their place; cancelled.
pub(super) fn reductions(
    space: &TrialSpace<'_>,
    grams: &[Arc<Gram>],
    stage: &WorkPhase<'_>,
) -> Result<BTreeMap<usize, Vec<FunctionCombinations>>, Halt> {
    let jumps: Vec<Jump> =
        (0..grams.len()).flat_map(|i| sole_support_jumps(space, i, &grams[i], is_jump)).collect();
    let shared = SharedJumps { jumps: &jumps, grams, common: common(space, &jumps, stage)? };
    let mut kept = BTreeMap::new();
    for i in shared.all() {
        let rows = shared.kept(i, &kept);
        let place = || Halt::at(space.partition().support(jumps[i].patch));
        kept.insert(i, rows.map_err(|_| place())?);
    }
    let mut parts: BTreeMap<usize, Vec<FunctionCombinations>> = BTreeMap::new();
    for (i, rows) in kept.into_iter().filter(|(_, kept)| kept.lost > 0) {
        parts.entry(jumps[i].patch).or_default().push((jumps[i].functions.clone(), rows.rows));
    }
    Ok(parts)
}

/// The combinations of a jump's functions that its patch keeps.
struct ReducedJump {
    /// Orthonormal combinations [kept × functions].
    rows: Mat<f64>,
    /// Number of combinations that earlier patches have.
    lost: usize,
}

/// Jumps and what pairs of them have in common.
struct SharedJumps<'a> {
    jumps: &'a [Jump],
    grams: &'a [Arc<Gram>],
    /// By the numbers of two jumps, the smaller one first; only those that confine each other.
    common: BTreeMap<(usize, usize), Mat<f64>>,
}

impl SharedJumps<'_> {
    /// The jumps that share something, ascending.
    fn all(&self) -> BTreeSet<usize> {
        self.common.keys().flat_map(|&(a, b)| [a, b]).collect()
    }

    /// Returns the part of a jump that is kept beside those before it.
    fn kept(
        &self,
        i: usize,
        before: &BTreeMap<usize, ReducedJump>,
    ) -> Result<ReducedJump, EigenError> {
        let rows = self.orthonormal(i)?;
        let partners: Vec<usize> = before.keys().copied().filter(|&n| self.has(n, i)).collect();
        if partners.is_empty() {
            return Ok(ReducedJump { rows, lost: 0 });
        }
        let of = |n: usize| &before[&n].rows;
        let joint = blocks(&partners, &partners, &|a, b| self.product(a, b, of(a), of(b)));
        let mixed = blocks(&partners, &[i], &|n, _| self.product(n, i, of(n), &rows));
        let root = SymmetricEigen::new(joint.as_ref())?.inverse_root(LACKING);
        let projection = root * mixed;
        let lacking =
            Mat::<f64>::identity(rows.nrows(), rows.nrows()) - projection.transpose() * &projection;
        let eigen = SymmetricEigen::new(lacking.as_ref())?;
        let kept = eigen.values.iter().take_while(|&&value| value > LACKING).count();
        let stays = eigen.vectors.subcols(0, kept).transpose() * &rows;
        Ok(ReducedJump { lost: rows.nrows() - kept, rows: stays })
    }

    fn has(&self, a: usize, b: usize) -> bool {
        self.common.contains_key(&(a, b))
    }

    /// The products of combinations of two jumps.
    fn product(&self, a: usize, b: usize, of_a: &Mat<f64>, of_b: &Mat<f64>) -> Mat<f64> {
        if a == b {
            return Mat::identity(of_a.nrows(), of_a.nrows());
        }
        match (self.common.get(&(a, b)), self.common.get(&(b, a))) {
            (Some(gram), _) => of_a * gram * of_b.transpose(),
            (_, Some(gram)) => of_a * gram.transpose() * of_b.transpose(),
            _ => Mat::zeros(of_a.nrows(), of_b.nrows()),
        }
    }

    /// Orthonormal combinations of a jump's functions.
    fn orthonormal(&self, i: usize) -> Result<Mat<f64>, EigenError> {
        let Jump { patch, functions: Range { start, end }, .. } = self.jumps[i].clone();
        let n = end - start;
        let gram = self.grams[patch].weighted.submatrix(start, start, n, n);
        let scale = inverse_root_diagonal(gram, 0.0);
        let root = SymmetricEigen::new(scaled(gram, &scale).as_ref())?.inverse_root(CUT_OFF);
        Ok(Mat::from_fn(root.nrows(), n, |k, j| root[(k, j)] * scale[j]))
    }
}

/// A matrix of blocks.
fn blocks(rows: &[usize], columns: &[usize], block: &dyn Fn(usize, usize) -> Mat<f64>) -> Mat<f64> {
    let all: Vec<Vec<Mat<f64>>> =
        rows.iter().map(|&a| columns.iter().map(|&b| block(a, b)).collect()).collect();
    let height = all.iter().map(|row| row[0].nrows()).sum();
    let width = all.first().map_or(0, |row| row.iter().map(Mat::ncols).sum());
    let (mut matrix, mut top) = (Mat::zeros(height, width), 0);
    for row in &all {
        let mut left = 0;
        for block in row {
            matrix.submatrix_mut(top, left, block.nrows(), block.ncols()).copy_from(block);
            left += block.ncols();
        }
        top += row[0].nrows();
    }
    matrix
}

/// The combinations of a patch's n functions that stay: all those not among the parts, and of these
/// their rows.
pub(super) fn matrix(n: usize, parts: &[FunctionCombinations]) -> Mat<f64> {
    let is_whole = |k: &usize| !parts.iter().any(|(functions, _)| functions.contains(k));
    let whole: Vec<usize> = (0..n).filter(is_whole).collect();
    let rows = whole.len() + parts.iter().map(|(_, rows)| rows.nrows()).sum::<usize>();
    let (mut matrix, mut at) = (Mat::zeros(rows, n), whole.len());
    whole.iter().enumerate().for_each(|(row, &k)| matrix[(row, k)] = 1.0);
    for (functions, part) in parts {
        matrix.submatrix_mut(at, functions.start, part.nrows(), part.ncols()).copy_from(part);
        at += part.nrows();
    }
    matrix
}

/// Turn of a crack at a kink, in radians, from which on what lies in it is a wedge.
const CORNER: f64 = 0.3;

/// The first functions of the jumps of a patch of which nearly nothing lies where it is alone: of
/// the components at junctions, and of the sides of a crack that turns in the patch. Slivers beside
/// straight cracks are none of them.
pub(super) fn sole_support(space: &TrialSpace<'_>, patch: usize, gram: &Gram) -> Vec<usize> {
    let (step, support) = (space.step(), space.partition().support(patch));
    let turn = |crack: &Crack, k: usize| {
        let before = crack.edge(k - 1).end_tangents()[1];
        let after = crack.edge(k).end_tangents()[0];
        before.cross(after).atan2(before.dot(after)).abs()
    };
    let bends = |crack: u32| {
        let crack = &step.cracks[crack as usize];
        let mut inner = 1..crack.points.len() - 1;
        inner.any(|k| support.contains(crack.points[k]) && turn(crack, k) > CORNER)
    };
    let is_wedge = |kind: &FunctionKind| match kind {
        FunctionKind::Component { cuts } => {
            let first = cuts[0].segment.crack;
            cuts.iter().any(|cut| cut.segment.crack != first) || bends(first)
        }
        FunctionKind::Side { crack } => bends(*crack),
        _ => false,
    };
    let jumps = sole_support_jumps(space, patch, gram, is_wedge);
    jumps.into_iter().map(|jump| jump.functions.start).collect()
}

fn is_jump(kind: &FunctionKind) -> bool {
    matches!(kind, FunctionKind::Side { .. } | FunctionKind::Component { .. })
}

/// The jumps of some kinds of a patch of which nearly nothing lies where it is alone.
fn sole_support_jumps(
    space: &TrialSpace<'_>,
    patch: usize,
    gram: &Gram,
    is_meant: impl Fn(&FunctionKind) -> bool,
) -> Vec<Jump> {
    let (data, mut first, mut found) = (space.data(), 0, Vec::new());
    for block in data.blocks(patch) {
        let functions = first..first + monomials(data.block_degree[block].into());
        let kind = &space.step().functions[data.block_function[block] as usize].kind;
        // jumps come before all series, of which fewer functions are evaluated than are stored
        if is_meant(kind) && gram.alone[first] <= OUTSIDE * gram.plain[first] {
            found.push(Jump { patch, functions: functions.clone(), square: gram.plain[first] });
        }
        first = functions.end;
    }
    found
}

/// Returns the integrals of pairs of jumps that confine each other.
fn common(
    space: &TrialSpace<'_>,
    jumps: &[Jump],
    stage: &WorkPhase<'_>,
) -> Result<BTreeMap<(usize, usize), Mat<f64>>, Halt> {
    let mut of_patch: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (k, jump) in jumps.iter().enumerate() {
        of_patch.entry(jump.patch as u32).or_default().push(k);
    }
    let is_shared = |cell: &usize| {
        space.covering_patches[*cell]
            .iter()
            .filter(|patch| of_patch.contains_key(patch))
            .nth(1)
            .is_some()
    };
    let cells: Vec<usize> = (0..space.covering_patches.len()).filter(is_shared).collect();
    let quadrature = space.quadrature(0);
    let mut sums: BTreeMap<(usize, usize), JumpIntegrals> = BTreeMap::new();
    in_batches(
        stage,
        cells.len(),
        || (ShapeEvaluator::new(space), Shapes::default()),
        |(evaluator, shapes), k| {
            let mut parts = Vec::new();
            for rule in space.rules(&quadrature, cells[k]).iter() {
                let here = |patch: &u32| of_patch.get(patch).into_iter().flatten().copied();
                let here: Vec<usize> = rule.patches.iter().flat_map(here).collect();
                if here.len() > 1 {
                    evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
                    shapes.scale(&rule.weights);
                    add_pairs(&WeightedShapes { space, rule, shapes }, jumps, &here, &mut parts);
                }
            }
            Ok(parts)
        },
        |_, parts| {
            for (pair, part) in parts {
                match sums.entry(pair) {
                    Entry::Vacant(new) => drop(new.insert(part)),
                    Entry::Occupied(mut known) => known.get_mut().add(&part),
                }
            }
        },
    )?;
    let confine = |&((a, b), ref common): &((usize, usize), JumpIntegrals)| {
        let within = |k: usize, square: f64| square >= (1.0 - OUTSIDE) * jumps[k].square;
        within(a, common.squares[0]) && within(b, common.squares[1])
    };
    Ok(sums.into_iter().filter(confine).map(|(pair, common)| (pair, common.gram)).collect())
}

impl JumpIntegrals {
    fn add(&mut self, part: &Self) {
        self.gram += &part.gram;
        self.squares.iter_mut().zip(part.squares).for_each(|(sum, part)| *sum += part);
    }
}

/// Shapes times the roots of the weights at the points of a rule.
struct WeightedShapes<'a> {
    space: &'a TrialSpace<'a>,
    rule: &'a CellRule,
    shapes: &'a Shapes,
}

/// Adds the integrals of all pairs of jumps of different patches that are not zero at the
/// same points.
fn add_pairs(
    seen: &WeightedShapes<'_>,
    jumps: &[Jump],
    here: &[usize],
    parts: &mut Vec<((usize, usize), JumpIntegrals)>,
) {
    let pairs = here.iter().enumerate().flat_map(|(k, &b)| here[..k].iter().map(move |&a| (a, b)));
    for (a, b) in pairs.filter(|&(a, b)| jumps[a].patch != jumps[b].patch) {
        let squares = [seen.square(&jumps[a], &jumps[b]), seen.square(&jumps[b], &jumps[a])];
        if squares[0] > 0.0 {
            parts.push(((a, b), JumpIntegrals { gram: seen.gram(&jumps[a], &jumps[b]), squares }));
        }
    }
}

impl WeightedShapes<'_> {
    /// The first function of the patch among those of the rule.
    fn first(&self, patch: usize) -> usize {
        let before = self.rule.patches.iter().take_while(|&&p| p as usize != patch);
        before.map(|&p| self.space.sizes[p as usize]).sum()
    }

    fn functions(&self, jump: &Jump) -> Range<usize> {
        let first = self.first(jump.patch);
        first + jump.functions.start..first + jump.functions.end
    }

    /// ∫ h⁻² ψ² of the first function of a jump, where the other one is not zero.
    fn square(&self, jump: &Jump, other: &Jump) -> f64 {
        let row = |k: usize| self.shapes.row(&self.shapes.value, k);
        let (own, other) = (row(self.functions(jump).start), row(self.functions(other).start));
        let (phi, half) = (row(self.first(jump.patch)), self.space.partition().half[jump.patch]);
        let weights = &self.rule.weights;
        let there = (0..own.len()).filter(|&q| other[q] != 0.0 && phi[q] > LEAST);
        there.map(|q| weights[q] * (own[q] / phi[q]).powi(2)).sum::<f64>() / (half.x * half.y)
    }

    fn gram(&self, a: &Jump, b: &Jump) -> Mat<f64> {
        let half = [a, b].map(|jump| self.space.partition().half[jump.patch]);
        let product = 1.0 / half.iter().map(|h| (h.x * h.y).sqrt()).product::<f64>();
        let (shapes, rows) = (self.shapes, [self.functions(a), self.functions(b)]);
        let mut gram = Mat::zeros(rows[0].len(), rows[1].len());
        for (array, factor) in shapes.gram_terms(product) {
            let [of_a, of_b] = [0, 1].map(|k| shapes.rows(array, rows[k].clone()));
            matmul(gram.as_mut(), Accum::Add, of_a, of_b.transpose(), factor, Par::Seq);
        }
        gram
    }
}
