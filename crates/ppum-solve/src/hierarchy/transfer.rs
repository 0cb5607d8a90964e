//! From the unknowns of a coarse level to those of the next finer one: a fine patch takes the local
//! field of its parent, the coarse patch whose cell holds the middle of its own.
//!
//! ```text
//! min over u_i of ∫ |∇(φ_i (u_i − u_k))|² + h⁻² φ_i² (u_i − u_k)²
//! ```
//!
//! Polynomials are only written in the frame of the finer patch,
//!
//! ```text
//! B = T_i⁻ᵀ E T_kᵀ        ξ_k^m = Σ_n E_nm ξ_i^n
//! ```
//!
//! and where there are other functions the minimum is found with the quadrature of the finer level:
//!
//! ```text
//! B = G⁻¹ R        G = ⟨φ_i N_i, φ_i N_i⟩,  R = ⟨φ_i N_i, φ_i N_k⟩
//! ```
//!
//! B is the same for each component; patches whose components share unknowns have C_i (I ⊗ B) C_kᵀ.

use crate::basis::{ShapeEvaluator, Shapes, StableBasis};
use crate::quadrature::CellRule;
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::{Accum, Mat, MatRef, Par, Side};
use ppum::box_tree::BoxTree;
use ppum::polynomial::exponents;
use ppum::vec2::Vec2;
use ppum_linear::{Transfer, product};
use std::collections::BTreeMap;
use std::ops::Range;

/// The space and the stable basis of a level.
pub(super) type SpaceWithBasis<'a> = (&'a TrialSpace<'a>, &'a StableBasis);

/// The transfer between two levels.
///
/// # Errors
/// Cancelled.
pub(super) fn transfer(
    fine: SpaceWithBasis<'_>,
    coarse: SpaceWithBasis<'_>,
    stage: &WorkPhase<'_>,
) -> Result<Transfer, Halt> {
    let between = LevelTransfer { fine, coarse, parents: parents(fine.0, coarse.0) };
    let integrated = between.integrated(stage)?;
    let components = fine.0.equation().components();
    let mut transfer = Transfer::from_blocks(coarse.0.sizes.len());
    for (i, parent) in between.parents.iter().enumerate() {
        let Some(k) = *parent else {
            transfer.push(None);
            continue;
        };
        let b = match integrated.get(&(i as u32)) {
            Some(sums) => sums.solved(),
            None => between.of_polynomials(i, k as usize),
        };
        match between.tied(i as u32, k, &b) {
            Some(tied) => transfer.push(Some((k, &tied, 1))),
            None => transfer.push(Some((k, &b, components as u8))),
        }
    }
    Ok(transfer)
}

/// Returns for each fine patch the coarse one whose cell holds the middle of its own.
fn parents(fine: &TrialSpace<'_>, coarse: &TrialSpace<'_>) -> Vec<Option<u32>> {
    let tree = BoxTree::new(&coarse.partition().cell);
    let mut found = Vec::new();
    let parent = |middle: Vec2| {
        found.clear();
        tree.query_point(middle, &mut found);
        found.first().copied()
    };
    fine.partition().cell.iter().map(|cell| cell.center()).map(parent).collect()
}

/// Two levels.
struct LevelTransfer<'a> {
    fine: SpaceWithBasis<'a>,
    coarse: SpaceWithBasis<'a>,
    parents: Vec<Option<u32>>,
}

/// Integrals over a fine patch.
#[derive(Clone, Debug)]
struct PatchIntegrals {
    gram: Mat<f64>,
    mixed: Mat<f64>,
}

impl PatchIntegrals {
    fn add(&mut self, part: &Self) {
        self.gram += &part.gram;
        self.mixed += &part.mixed;
    }

    /// G⁻¹ R. G is the unit matrix but where the boundary has damped functions.
    fn solved(&self) -> Mat<f64> {
        match self.gram.llt(Side::Lower) {
            Ok(factor) => factor.solve(&self.mixed),
            Err(_) => self.mixed.clone(),
        }
    }
}

impl LevelTransfer<'_> {
    /// True if polynomials are all that there is on both sides, and the fine ones hold the
    /// coarse ones.
    fn is_polynomial(&self, i: usize, k: usize) -> bool {
        let (fine, basis) = self.fine;
        let plain =
            |space: &TrialSpace<'_>, patch: usize| space.sizes[patch] == space.n_polynomials(patch);
        plain(fine, i)
            && plain(self.coarse.0, k)
            && basis.sizes[i] == fine.sizes[i]
            && self.coarse.0.order(k) <= fine.order(i)
    }

    /// T_i⁻ᵀ E T_kᵀ
    fn of_polynomials(&self, i: usize, k: usize) -> Mat<f64> {
        let e = self.reexpanded(i, k);
        let in_fine = product(e.as_ref(), self.coarse.1.transform(k as u32).transpose());
        self.fine.1.transform(i as u32).transpose().partial_piv_lu().solve(in_fine)
    }

    /// E: the monomials of a coarse patch, one a column, in those of a fine one.
    fn reexpanded(&self, i: usize, k: usize) -> Mat<f64> {
        let (fine, coarse) = (self.fine.0, self.coarse.0);
        let (from, to) = (coarse.partition(), fine.partition());
        let shift = to.origin[i] - from.origin[k];
        let axis =
            |shift: f64, scale: f64, wide: f64| powers(shift / wide, scale / wide, coarse.order(k));
        let x = axis(shift.x, to.scale[i].x, from.scale[k].x);
        let y = axis(shift.y, to.scale[i].y, from.scale[k].y);
        let rows: Vec<_> = exponents(fine.order(i)).collect();
        let columns: Vec<_> = exponents(coarse.order(k)).collect();
        let entry = |power: &[Vec<f64>], of: u32, n: u32| {
            power[of as usize].get(n as usize).copied().unwrap_or(0.0)
        };
        Mat::from_fn(rows.len(), columns.len(), |row, column| {
            let ((a, b), (m, n)) = (rows[row], columns[column]);
            entry(&x, m as u32, a as u32) * entry(&y, n as u32, b as u32)
        })
    }

    /// C_i (I ⊗ B) C_kᵀ; none if no components share unknowns.
    fn tied(&self, i: u32, k: u32, b: &Mat<f64>) -> Option<Mat<f64>> {
        let (left, right) = (self.fine.1.inverse_tie(i), self.coarse.1.tie(k));
        if left.is_none() && right.is_none() {
            return None;
        }
        let (n, m) = (b.nrows(), b.ncols());
        let twice =
            Mat::from_fn(2 * n, 2 * m, |a, c| if a / n == c / m { b[(a % n, c % m)] } else { 0.0 });
        let half = left.map_or(twice.clone(), |tie| product(tie.as_ref(), twice.as_ref()));
        Some(right.map_or(half.clone(), |tie| product(half.as_ref(), tie.transpose())))
    }

    /// The integrals of all fine patches that need them.
    fn integrated(&self, stage: &WorkPhase<'_>) -> Result<BTreeMap<u32, PatchIntegrals>, Halt> {
        let (space, basis) = self.fine;
        let needs = |i: usize| self.parents[i].is_some_and(|k| !self.is_polynomial(i, k as usize));
        let needs: Vec<bool> = (0..self.parents.len()).map(needs).collect();
        let has = |cell: &usize| space.covering_patches[*cell].iter().any(|&i| needs[i as usize]);
        let cells: Vec<usize> = (0..space.covering_patches.len()).filter(has).collect();
        let quadrature = space.quadrature(0);
        let mut sums: BTreeMap<u32, PatchIntegrals> = BTreeMap::new();
        in_batches(
            stage,
            cells.len(),
            || Integrator::new(self, &needs),
            |integrator, k| {
                let mut parts: BTreeMap<u32, PatchIntegrals> = BTreeMap::new();
                for rule in space.rules(&quadrature, cells[k]).iter() {
                    integrator.add(rule, &mut parts);
                }
                Ok(parts)
            },
            |_, parts| {
                for (patch, part) in parts {
                    let zero = || self.no_sums(patch, basis);
                    sums.entry(patch).or_insert_with(zero).add(&part);
                }
            },
        )?;
        // where all rules are empty
        for i in (0..needs.len()).filter(|&i| needs[i]) {
            sums.entry(i as u32).or_insert_with(|| self.no_sums(i as u32, basis));
        }
        Ok(sums)
    }

    fn no_sums(&self, i: u32, basis: &StableBasis) -> PatchIntegrals {
        let n = basis.sizes[i as usize];
        let parent = self.parents[i as usize].expect("only patches with parents are integrated");
        let m = self.coarse.1.sizes[parent as usize];
        PatchIntegrals { gram: Mat::zeros(n, n), mixed: Mat::zeros(n, m) }
    }
}

/// Coefficients of (a + b ξ)^m for m up to a degree.
fn powers(a: f64, b: f64, degree: usize) -> Vec<Vec<f64>> {
    let next = |last: &Vec<f64>| {
        let mut product = vec![0.0; last.len() + 1];
        for (n, c) in last.iter().enumerate() {
            product[n] += a * c;
            product[n + 1] += b * c;
        }
        Some(product)
    };
    std::iter::successors(Some(vec![1.0]), next).take(degree + 1).collect()
}

/// Integrates over rules.
struct Integrator<'a> {
    between: &'a LevelTransfer<'a>,
    /// Whether each fine patch is to be integrated.
    needs: &'a [bool],
    fine: ShapeEvaluator<'a>,
    coarse: ShapeEvaluator<'a>,
    /// φψ of the fine patches, and φN.
    plain: Shapes,
    own: Shapes,
    /// ψ of a coarse patch, and N.
    local: Shapes,
    parent: Shapes,
}

impl<'a> Integrator<'a> {
    fn new(between: &'a LevelTransfer<'a>, needs: &'a [bool]) -> Self {
        Self {
            between,
            needs,
            fine: ShapeEvaluator::of_series(between.fine.0),
            coarse: ShapeEvaluator::of_series(between.coarse.0),
            plain: Shapes::default(),
            own: Shapes::default(),
            local: Shapes::default(),
            parent: Shapes::default(),
        }
    }

    fn add(&mut self, rule: &CellRule, parts: &mut BTreeMap<u32, PatchIntegrals>) {
        let LevelTransfer { fine: (space, basis), ref parents, .. } = *self.between;
        if !rule.patches.iter().any(|&i| self.needs[i as usize]) {
            return;
        }
        self.fine.evaluate(rule.anchor, &rule.offsets, &rule.patches, &mut self.plain);
        self.plain.scale(&rule.weights);
        basis.apply(&rule.patches, &self.plain, &mut self.own);
        let (mut phi, mut first, mut seen) = (0, 0, None);
        for &i in &rule.patches {
            let n = basis.sizes[i as usize];
            if let Some(k) = parents[i as usize].filter(|_| self.needs[i as usize]) {
                if seen != Some(k) {
                    self.see(k, rule);
                    seen = Some(k);
                }
                let half = space.partition().half[i as usize];
                let zero = || self.between.no_sums(i, basis);
                let sums = parts.entry(i).or_insert_with(zero);
                add_products(
                    &self.own,
                    first..first + n,
                    &self.plain,
                    phi,
                    &self.parent,
                    half,
                    sums,
                );
            }
            phi += space.evaluated(i as usize);
            first += n;
        }
    }

    /// Evaluates the functions of a coarse patch, without its φ.
    fn see(&mut self, k: u32, rule: &CellRule) {
        // the φ of a patch that is alone is 1
        self.coarse.evaluate(rule.anchor, &rule.offsets, &[k], &mut self.local);
        self.between.coarse.1.apply(&[k], &self.local, &mut self.parent);
    }
}

/// Adds the products of rows of `own` with each other and with φ times `parent`, φ being a row of
/// `plain` that has the roots of the weights.
fn add_products(
    own: &Shapes,
    rows: Range<usize>,
    plain: &Shapes,
    phi: usize,
    parent: &Shapes,
    half: Vec2,
    sums: &mut PatchIntegrals,
) {
    let weighted = parent.times_row(plain, phi);
    let h2 = 1.0 / (half.x * half.y);
    let all = 0..weighted.functions;
    for ((mine, factor), (theirs, _)) in own.gram_terms(h2).zip(weighted.gram_terms(h2)) {
        let mine: MatRef<'_, f64> = own.rows(mine, rows.clone());
        let theirs = weighted.rows(theirs, all.clone());
        matmul(sums.gram.as_mut(), Accum::Add, mine, mine.transpose(), factor, Par::Seq);
        matmul(sums.mixed.as_mut(), Accum::Add, mine, theirs.transpose(), factor, Par::Seq);
    }
}
