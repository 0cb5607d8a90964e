//! Conditions on the border of a cell: Nitsche's method for given values, loads for given tractions.
//!
//! ```text
//! K += −∫_Γ (σ(N) n)·N − transposed + β ∫_Γ N·N       f += −∫_Γ (σ(N) n)·g + β ∫_Γ N·g + ∫_Γt N·t
//! ```
//!
//! Γ is where values are given, component by component. β = 2 λ_max of the cell's own pencil
//! ∫_Γ |σ(N) n|² against K: β > λ_max is just what keeps the system positive definite, and a cell cut
//! into slivers gets the larger value it needs (Griebel & Schweitzer 2003). Where it is much larger, the
//! basis is made to see it: see [`StableBasis::damp`](crate::basis::StableBasis::damp).
//!
//! Where Γ is much shorter than the cell, that β is small: functions of the cell's size carry no traction
//! through a short support, and β ∫_Γ N·N would be a soft spring. So β is C h/ℓ² at least, C the modulus,
//! h the size of the cell, ℓ the length of Γ in it: a spring C h/ℓ times as stiff as the plate.

use super::cell_system::CellSystem;
use super::reaction::Support;
use crate::basis::{BasisEvaluator, Shapes};
use crate::equilibrium::RigidModes;
use crate::law::Law;
use crate::linear::{EigenError, add_at, largest_eigenvalue};
use crate::quadrature::EdgeRule;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::vec2::{Vec2, vec2};

/// β in units of λ_max: below 1 the system is indefinite, 2 to 10 give the same error.
const FACTOR: f64 = 2.0;

/// Data given on a border: position, normal out of the material → values, one a component.
pub(crate) type BorderData<'a> = &'a (dyn Fn(Vec2, Vec2) -> [f64; 2] + Sync);

/// Largest ratio of cell to border that the spring of a short support grows with: it yields a
/// thousandth then, and the condition number does not suffer.
const STIFFEST: f64 = 1e3;

/// Integrals that a rule is for.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Both,
    Stiffness,
    Data,
}

/// A piece of a cell's border with what is given on it.
pub(crate) struct BorderPiece<'a> {
    pub(crate) rules: Vec<EdgeRule>,
    /// Rules for what is given that take the place of those, where they do not resolve it.
    pub(crate) own: Option<&'a [EdgeRule]>,
    /// Components whose value is given.
    pub(crate) held: [bool; 2],
    /// The given values; tractions where not held (zero where free).
    pub(crate) values: BorderData<'a>,
    /// Number of the condition.
    pub(crate) condition: usize,
    /// The modes that reactions do work on.
    pub(crate) modes: RigidModes,
}

impl BorderPiece<'_> {
    /// The given tractions (fluxes) at a place with its normal, zero where a value is given.
    pub(crate) fn loads(&self, x: Vec2, normal: Vec2) -> [f64; 2] {
        let values = (self.values)(x, normal);
        [0, 1].map(|k| if self.held[k] { 0.0 } else { values[k] })
    }
}

/// Sums over the pieces of a cell's border where values are given. Matrices are over the cell's
/// unknowns.
pub(crate) struct Border<'a> {
    law: &'a Law<'a>,
    /// ∫ N·(σ(N) n): rows N, columns σ(N) n.
    consistency: Mat<f64>,
    /// ∫ (σ(N) n)·(σ(N) n)
    traction: Mat<f64>,
    /// ∫ N·N
    mass: Mat<f64>,
    /// ∫ N·g
    value_load: Vec<f64>,
    /// ∫ (σ(N) n)·g
    traction_load: Vec<f64>,
    /// Length on which values are given.
    length: f64,
    /// Largest modulus there.
    modulus: f64,
    /// What the supports exert, one a condition that gives values.
    supports: Vec<Support>,
}

impl<'a> Border<'a> {
    pub(crate) fn new(law: &'a Law<'a>, unknowns: usize) -> Self {
        Self {
            law,
            consistency: Mat::zeros(unknowns, unknowns),
            traction: Mat::zeros(unknowns, unknowns),
            mass: Mat::zeros(unknowns, unknowns),
            value_load: vec![0.0; unknowns],
            traction_load: vec![0.0; unknowns],
            length: 0.0,
            modulus: 0.0,
            supports: Vec::new(),
        }
    }

    /// Adds a piece; tractions go to the system at once.
    pub(crate) fn add(
        &mut self,
        piece: &BorderPiece<'_>,
        evaluator: &mut BasisEvaluator<'_>,
        shapes: &mut Shapes,
        system: &mut CellSystem,
    ) {
        let components = self.law.components;
        let own = piece.own.unwrap_or_default().iter().map(|rule| (rule, Part::Data));
        let part = if piece.own.is_some() { Part::Stiffness } else { Part::Both };
        for (rule, part) in piece.rules.iter().map(|rule| (rule, part)).chain(own) {
            evaluator.evaluate_edge(rule, shapes);
            let numbers = system.functions.numbers(&rule.patches);
            let mut given = Vec::with_capacity(rule.offsets.len());
            for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
                let x = rule.anchor + offset;
                if part != Part::Stiffness {
                    let loads = piece.loads(x, rule.normals[q]);
                    shapes.add_load(q, &numbers, &loads[..components], weight, &mut system.load);
                    let values = (piece.values)(x, rule.normals[q]);
                    given.push(values.map(|v| v * weight.sqrt()));
                }
            }
            shapes.scale(&rule.weights);
            for i in (0..components).filter(|&i| piece.held[i]) {
                if part != Part::Data {
                    self.hold(i, piece, rule, &numbers, shapes);
                }
                if part != Part::Stiffness {
                    let given: Vec<_> = given.iter().map(|values| values[i]).collect();
                    self.give(i, piece, rule, &numbers, shapes, &given);
                }
            }
        }
    }

    /// Adds the points of one component whose value is given to the matrices; shapes carry the roots of
    /// the weights.
    fn hold(
        &mut self,
        i: usize,
        piece: &BorderPiece<'_>,
        rule: &EdgeRule,
        numbers: &[usize],
        shapes: &Shapes,
    ) {
        let length: f64 = rule.weights.iter().sum();
        self.length += length / self.law.components as f64;
        let modulus = |&o: &Vec2| self.law.at(rule.anchor + o).modulus(i);
        self.modulus = rule.offsets.iter().map(modulus).fold(self.modulus, f64::max);
        let tractions = self.tractions(i, rule, shapes);
        let values = shapes.rows(&shapes.value, 0..shapes.functions);
        let product = |left: faer::MatRef<'_, f64>, right: faer::MatRef<'_, f64>| {
            let mut out = Mat::zeros(left.nrows(), right.nrows());
            matmul(out.as_mut(), Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
            out
        };
        let [value_rows, all_rows] = self.unknowns(i, numbers);
        let t = tractions.as_ref();
        add_at(&mut self.mass, &value_rows, &value_rows, &product(values, values));
        add_at(&mut self.consistency, &value_rows, &all_rows, &product(values, t));
        add_at(&mut self.traction, &all_rows, &all_rows, &product(t, t));
        let support = self.support(piece.condition);
        for k in 0..piece.modes.count() {
            let mode = mode(piece, rule, k, i);
            support.add(k, &mode, (t, &all_rows), (values, &value_rows));
        }
    }

    /// Adds the values that are given for one component; shapes and values carry the roots of the
    /// weights.
    fn give(
        &mut self,
        i: usize,
        piece: &BorderPiece<'_>,
        rule: &EdgeRule,
        numbers: &[usize],
        shapes: &Shapes,
        given: &[f64],
    ) {
        let tractions = self.tractions(i, rule, shapes);
        let values = shapes.rows(&shapes.value, 0..shapes.functions);
        let [value_rows, all_rows] = self.unknowns(i, numbers);
        for (q, g) in given.iter().enumerate() {
            for (k, &row) in value_rows.iter().enumerate() {
                self.value_load[row] += values[(k, q)] * g;
            }
            for (k, &row) in all_rows.iter().enumerate() {
                self.traction_load[row] += tractions[(k, q)] * g;
            }
        }
        let support = self.support(piece.condition);
        for k in 0..piece.modes.count() {
            support.give(k, &mode(piece, rule, k, i), given);
        }
    }

    /// The cell's unknowns of component i of some functions, and all of them.
    fn unknowns(&self, i: usize, numbers: &[usize]) -> [Vec<usize>; 2] {
        let c = self.law.components;
        let all = numbers.iter().flat_map(|k| (0..c).map(move |j| k * c + j));
        [numbers.iter().map(|k| k * c + i).collect(), all.collect()]
    }

    /// The sums of a condition.
    fn support(&mut self, condition: usize) -> &mut Support {
        let known = self.supports.iter().position(|s| s.condition == condition);
        let place = known.unwrap_or(self.supports.len());
        if known.is_none() {
            self.supports.push(Support::new(condition, self.value_load.len()));
        }
        &mut self.supports[place]
    }

    /// Component i of σ(N e_j) n, rows (function, j), columns points.
    fn tractions(&self, i: usize, rule: &EdgeRule, shapes: &Shapes) -> Mat<f64> {
        let c = self.law.components;
        let laws: Vec<_> = rule.offsets.iter().map(|&o| self.law.at(rule.anchor + o)).collect();
        Mat::from_fn(shapes.functions * c, shapes.points, |row, q| {
            let at = (row / c) * shapes.points + q;
            laws[q].traction(i, row % c, vec2(shapes.dx[at], shapes.dy[at]), rule.normals[q])
        })
    }

    /// Adds Nitsche's terms to a system whose stiffness is complete; `size` is that of the cell.
    ///
    /// # Errors
    /// Entries that are not finite.
    pub(crate) fn finish(self, size: f64, system: &mut CellSystem) -> Result<(), EigenError> {
        if self.length == 0.0 {
            return Ok(());
        }
        let needed = FACTOR * largest_eigenvalue(system.matrix.as_ref(), self.traction.as_ref())?;
        let ratio = (size / self.length).min(STIFFEST);
        let beta = needed.max(self.modulus * ratio / self.length);
        system.penalty = beta / self.modulus;
        system.matrix -= &self.consistency;
        system.matrix -= self.consistency.transpose();
        system.matrix += faer::Scale(beta) * &self.mass;
        let loads = self.value_load.iter().zip(&self.traction_load);
        for (load, (value, traction)) in system.load.iter_mut().zip(loads) {
            *load += beta * value - traction;
        }
        system.reactions = self.supports.into_iter().map(|s| s.finish(beta)).collect();
        Ok(())
    }
}

/// Component i of the k-th rigid-body mode at the points of a rule, times the roots of the weights.
fn mode(piece: &BorderPiece<'_>, rule: &EdgeRule, k: usize, i: usize) -> Vec<f64> {
    let points = rule.offsets.iter().zip(&rule.weights);
    points.map(|(&o, w)| piece.modes.at(rule.anchor + o)[k][i] * w.sqrt()).collect()
}
