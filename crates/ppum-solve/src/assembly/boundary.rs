//! Conditions on the boundary of a cell: Nitsche's method for given values, loads for given
//! tractions.
//!
//! If component i of u is given, u_i = g_i on Γ, the traction t_i(u) = (σ(u) n)_i is unknown.
//! Multiplying −div σ(u) = b by a test function v and integrating by parts leaves it in the
//! equation; Nitsche adds two terms that vanish for the solution, the first for symmetry, the
//! second so that the system is positive definite:
//!
//! ```text
//! a(u, v) − ∫_Γ t_i(u) v_i − ∫_Γ t_i(v) (u_i − g_i) + β ∫_Γ (u_i − g_i) v_i = ∫ b·v + ∫_Γt t·v
//! ```
//!
//! In the functions N_a e_j of a cell, unknown (a, j), that is K u = f with
//!
//! ```text
//! consistency   C_(a,i)(b,j) = ∫_Γ N_a t_i(N_b e_j)                       K −= C + Cᵀ
//! mass          M_(a,i)(b,i) = ∫_Γ N_a N_b                                K += β M
//! given         p_(a,i) = ∫_Γ N_a g_i,    q_(b,j) = ∫_Γ t_i(N_b e_j) g_i  f += β p − q
//! traction      B_(a,j)(b,k) = ∫_Γ t_i(N_a e_j) t_i(N_b e_k)
//! ```
//!
//! summed over the components i that are held. The part of t_i(u) where the body does not deform
//! goes to the load. β must be chosen so that v·K v > 0. By Cauchy's
//! inequality 2 ∫ t_i(v) v_i ≤ ε ∫ t_i(v)² + ε⁻¹ ∫ v_i², and ∫ t_i(v)² ≤ λ a(v, v) with the largest
//! λ of the pencil B x = λ A x, A the cell's stiffness before the terms above: any β > λ will do.
//! β = 2 λ, and a cell cut into slivers so gets the larger value it needs (Griebel & Schweitzer
//! 2003). Where β is much larger than elsewhere, the basis is made to see it:
//! see [`StableBasis::rescale`](crate::basis::StableBasis::rescale).
//!
//! Where u yields to the values g of its surroundings, t(u) = h (g − u), there is no unknown
//! traction, and no β:
//!
//! ```text
//! exchange      H_(a)(b) = ∫_Γ h N_a N_b                                  K += H,   f += ∫ h g N_a
//! ```
//!
//! If Γ is much shorter than the cell, that β is small: functions of the cell's size carry no
//! traction through a short restraint, and β M would be a soft spring. So β is C h/ℓ² at least, C
//! the modulus, h the size of the cell, ℓ the length of Γ in it: a spring C h/ℓ times as stiff as
//! the body.

use super::Assembly;
use super::cell_system::CellSystem;
use super::reaction::{CellReaction, Restraint};
use crate::basis::{BasisEvaluator, Shapes};
use crate::law::RigidModes;
use crate::quadrature::EdgeRule;
use faer::{Mat, MatRef};
use ppum::expression::Expression;
use ppum::vec2::Vec2;
use ppum_linear::{EigenError, add_at, largest_eigenvalue, product};
use ppum_problem::in_plane;

/// β in units of λ_max: below 1 the system is indefinite, 2 to 10 give the same error.
const FACTOR: f64 = 2.0;

/// Data given on a boundary: position, normal out of the material → values, one per component.
pub(crate) type BoundaryData<'a> = &'a (dyn Fn(Vec2, Vec2) -> [f64; 2] + Sync);

/// Largest ratio of cell to boundary that the spring of a short restraint grows with: it yields a
/// thousandth then, and the condition number does not suffer.
const STIFFEST: f64 = 1e3;

/// The terms that a rule is for: the matrices, what is given, or both.
#[derive(Clone, Copy, PartialEq)]
enum BoundaryTerms {
    Both,
    Stiffness,
    Data,
}

/// A piece of a cell's boundary with what is given on it.
pub(crate) struct CellBoundary<'a> {
    pub(crate) rules: Vec<EdgeRule>,
    /// Rules for what is given that take the place of those, where they do not resolve it.
    pub(crate) own: Option<&'a [EdgeRule]>,
    /// Components whose value is given.
    pub(crate) held: [bool; 2],
    /// The directions of the components.
    pub(crate) axes: [Vec2; 2],
    /// The coefficient h with which the field yields to the values, if it does.
    pub(crate) exchange: Option<&'a Expression>,
    /// True if all fields have these values.
    pub(crate) is_exact: bool,
    /// The given values along the axes; tractions where not held (zero where free).
    pub(crate) values: BoundaryData<'a>,
    /// Number of the condition.
    pub(crate) condition: usize,
    /// The modes that reactions do work on.
    pub(crate) modes: RigidModes,
}

impl CellBoundary<'_> {
    /// The given tractions (fluxes) at a place with its normal, zero where a value is given.
    pub(crate) fn loads(&self, x: Vec2, normal: Vec2) -> [f64; 2] {
        let values = (self.values)(x, normal);
        in_plane([0, 1].map(|k| if self.held[k] { 0.0 } else { values[k] }), self.axes)
    }
}

/// Sums over the pieces of a cell's boundary where values are given. Matrices are over the cell's
/// unknowns.
pub(crate) struct BoundarySums<'a> {
    assembly: Assembly<'a>,
    /// C = ∫ N_a t_i(N_b e_j)
    consistency: Mat<f64>,
    /// t_i(N_a e_j) times the roots of the weights, a column of all unknowns for each point and
    /// component that is held: B is its product with its transpose.
    tractions: Vec<f64>,
    /// M = ∫ N_a N_b
    mass: Mat<f64>,
    /// H = ∫ h N_a N_b, where there is an exchange.
    exchange: Option<Mat<f64>>,
    /// p = ∫ N_a g_i
    value_load: Vec<f64>,
    /// q = ∫ t_i(N_b e_j) g_i
    traction_load: Vec<f64>,
    /// ℓ: the length on which values are given.
    length: f64,
    /// C: the largest modulus there.
    modulus: f64,
    /// Forces of the restraints, one entry per condition that gives values.
    restraints: Vec<Restraint>,
}

/// The functions of a cell at the points of a rule, as one held component i sees them. All carry
/// the roots of the weights, so that products of rows are integrals.
struct Trace {
    component: usize,
    /// The direction d of the component.
    axis: Vec2,
    /// m_k·d of the rigid-body modes that reactions do work on.
    modes: Vec<Vec<f64>>,
    /// N_a d_j [functions · components with d_j ≠ 0 × points].
    values: Mat<f64>,
    /// The unknowns (a, j) of these rows.
    value_rows: Vec<usize>,
    /// t_i(N_a e_j) [functions · components × points].
    tractions: Mat<f64>,
    /// The unknowns (a, j) of these rows.
    traction_rows: Vec<usize>,
}

impl<'a> BoundarySums<'a> {
    pub(crate) fn new(assembly: Assembly<'a>, unknowns: usize) -> Self {
        let zero = || Mat::zeros(unknowns, unknowns);
        Self {
            assembly,
            consistency: zero(),
            tractions: Vec::new(),
            mass: zero(),
            exchange: None,
            value_load: vec![0.0; unknowns],
            traction_load: vec![0.0; unknowns],
            length: 0.0,
            modulus: 0.0,
            restraints: Vec::new(),
        }
    }

    /// Adds a piece; tractions go to the system at once.
    pub(crate) fn add(
        &mut self,
        piece: &CellBoundary<'_>,
        evaluator: &mut BasisEvaluator<'_>,
        shapes: &mut Shapes,
        system: &mut CellSystem,
    ) {
        if piece.exchange.is_some() {
            return self.exchange(piece, evaluator, shapes, system);
        }
        let own = piece.own.unwrap_or_default().iter().map(|rule| (rule, BoundaryTerms::Data));
        let terms =
            if piece.own.is_some() { BoundaryTerms::Stiffness } else { BoundaryTerms::Both };
        for (rule, terms) in piece.rules.iter().map(|rule| (rule, terms)).chain(own) {
            evaluator.evaluate_edge(rule, shapes);
            let numbers = system.functions.numbers(&rule.patches);
            if terms != BoundaryTerms::Stiffness {
                self.load(piece, rule, &numbers, shapes, &mut system.load);
            }
            shapes.scale(&rule.weights);
            for i in (0..self.assembly.components()).filter(|&i| piece.held[i]) {
                let trace = self.trace(piece, i, rule, &numbers, shapes);
                if terms != BoundaryTerms::Data {
                    let Trace { values, tractions, .. } = &trace;
                    let tractions = (tractions.as_ref(), trace.traction_rows.as_slice());
                    let values = (values.as_ref(), trace.value_rows.as_slice());
                    self.restraint(piece.condition).add(&trace.modes, tractions, values);
                }
                if terms != BoundaryTerms::Data && !piece.is_exact {
                    self.hold(&trace, rule);
                }
                if terms != BoundaryTerms::Stiffness {
                    self.give(&trace, piece, rule);
                }
            }
        }
    }

    /// Adds a piece where the field yields to the values: all that a function does there is the
    /// traction −h N.
    fn exchange(
        &mut self,
        piece: &CellBoundary<'_>,
        evaluator: &mut BasisEvaluator<'_>,
        shapes: &mut Shapes,
        system: &mut CellSystem,
    ) {
        let coefficient = |x: Vec2| piece.exchange.map_or(0.0, |exchange| exchange.value(x));
        for rule in piece.own.unwrap_or(&piece.rules) {
            evaluator.evaluate_edge(rule, shapes);
            let numbers = system.functions.numbers(&rule.patches);
            shapes.scale(&rule.weights);
            let h: Vec<f64> = rule.points().map(|(x, ..)| coefficient(x)).collect();
            for i in (0..self.assembly.components()).filter(|&i| piece.held[i]) {
                let mut trace = self.trace(piece, i, rule, &numbers, shapes);
                let values = &trace.values;
                trace.tractions =
                    Mat::from_fn(values.nrows(), h.len(), |a, q| -h[q] * values[(a, q)]);
                trace.traction_rows.clone_from(&trace.value_rows);
                self.yield_to(&trace, piece, rule, &h, system);
            }
        }
    }

    /// Adds the points of a component that yields to H, to the load and to the reaction.
    fn yield_to(
        &mut self,
        trace: &Trace,
        piece: &CellBoundary<'_>,
        rule: &EdgeRule,
        h: &[f64],
        system: &mut CellSystem,
    ) {
        let Trace { values, value_rows, tractions, .. } = trace;
        let values = values.as_ref();
        let (n, minus) = (self.value_load.len(), product(values, tractions.transpose()));
        let exchange = self.exchange.get_or_insert_with(|| Mat::zeros(n, n));
        add_at(exchange, value_rows, value_rows, &(faer::Scale(-1.0) * minus));
        let given = given(piece, rule, trace.component);
        for (q, g) in given.iter().enumerate() {
            for (k, &row) in value_rows.iter().enumerate() {
                system.load[row] -= tractions[(k, q)] * g;
            }
        }
        let given: Vec<f64> = given.iter().zip(h).map(|(g, h)| -h * g).collect();
        let restraint = self.restraint(piece.condition);
        restraint.add(&trace.modes, (tractions.as_ref(), value_rows), (values, &[]));
        restraint.give(&trace.modes, &[], &given);
    }

    /// Adds ∫ N·t of given tractions to the load of the cell; shapes carry no weights yet.
    fn load(
        &self,
        piece: &CellBoundary<'_>,
        rule: &EdgeRule,
        numbers: &[usize],
        shapes: &Shapes,
        load: &mut [f64],
    ) {
        let at = |(x, normal, weight): (Vec2, Vec2, f64)| {
            let values = (piece.values)(x, normal);
            // where a value is held stands the traction of the unknown, of which this is known
            let initial = self.assembly.law.initial_stress(x).traction(normal);
            let initial = piece.axes.map(|axis| axis.dot(initial));
            let load = |i: usize| weight * if piece.held[i] { initial[i] } else { values[i] };
            in_plane([0, 1].map(load), piece.axes)
        };
        let loads: Vec<[f64; 2]> = rule.points().map(at).collect();
        shapes.add_loads(&loads, numbers, self.assembly.components(), load);
    }

    /// The functions as component i sees them; shapes carry the roots of the weights.
    fn trace(
        &self,
        piece: &CellBoundary<'_>,
        component: usize,
        rule: &EdgeRule,
        numbers: &[usize],
        shapes: &Shapes,
    ) -> Trace {
        let (c, axis) = (self.assembly.components(), piece.axes[component]);
        let parts = parts_of(axis);
        let mode = |k: usize| {
            let along = |x: Vec2| axis.dot(piece.modes.at(x)[k].into());
            rule.points().map(|(x, _, w)| along(x) * w.sqrt()).collect()
        };
        let row = |a: usize, q: usize| shapes.value[a * shapes.points + q];
        Trace {
            component,
            axis,
            modes: (0..piece.modes.count()).map(mode).collect(),
            values: Mat::from_fn(shapes.functions * parts.len(), shapes.points, |k, q| {
                parts[k % parts.len()].1 * row(k / parts.len(), q)
            }),
            value_rows: numbers
                .iter()
                .flat_map(|a| parts.iter().map(move |(j, _)| a * c + j))
                .collect(),
            tractions: self.tractions(&parts, rule, shapes),
            traction_rows: numbers.iter().flat_map(|a| (0..c).map(move |j| a * c + j)).collect(),
        }
    }

    /// t_i(N_a e_j), rows (a, j), columns points, for a component with these parts.
    fn tractions(&self, parts: &[(usize, f64)], rule: &EdgeRule, shapes: &Shapes) -> Mat<f64> {
        let (c, law) = (self.assembly.components(), self.assembly.law);
        let laws: Vec<_> = rule.points().map(|(x, ..)| law.at(x)).collect();
        Mat::from_fn(shapes.functions * c, shapes.points, |row, q| {
            let (slopes, n) = (shapes.slopes_at(row / c, q), rule.normals[q]);
            parts.iter().map(|&(i, part)| part * laws[q].traction(i, row % c, slopes, n)).sum()
        })
    }

    /// Adds the points of a component whose value is given to the matrices M, C, B, and to length
    /// and modulus of Γ.
    fn hold(&mut self, trace: &Trace, rule: &EdgeRule) {
        self.measure(trace.component, rule);
        let Trace { values, value_rows, tractions, traction_rows, .. } = trace;
        let (values, tractions) = (values.as_ref(), tractions.as_ref());
        add_at(&mut self.mass, value_rows, value_rows, &product(values, values.transpose()));
        add_at(
            &mut self.consistency,
            value_rows,
            traction_rows,
            &product(values, tractions.transpose()),
        );
        for column in tractions.col_iter() {
            let first = self.tractions.len();
            self.tractions.resize(first + self.value_load.len(), 0.0);
            let rows = traction_rows.iter().zip(column.iter());
            rows.for_each(|(&row, t)| self.tractions[first + row] = *t);
        }
    }

    /// ℓ and the modulus C of the points where component i is given. A length counts once for
    /// all components.
    fn measure(&mut self, i: usize, rule: &EdgeRule) {
        let Assembly { law, .. } = self.assembly;
        let length: f64 = rule.weights.iter().sum();
        self.length += length / law.components as f64;
        let moduli = rule.points().map(|(x, ..)| law.at(x).modulus(i));
        self.modulus = moduli.fold(self.modulus, f64::max);
    }

    /// Adds the values that are given for a component to p and q, and to the restraint's reaction.
    fn give(&mut self, trace: &Trace, piece: &CellBoundary<'_>, rule: &EdgeRule) {
        let Trace { values, value_rows, tractions, traction_rows, .. } = trace;
        let given = given(piece, rule, trace.component);
        for (q, g) in given.iter().enumerate() {
            for (k, &row) in value_rows.iter().enumerate() {
                self.value_load[row] += values[(k, q)] * g;
            }
            for (k, &row) in traction_rows.iter().enumerate() {
                self.traction_load[row] += tractions[(k, q)] * g;
            }
        }
        let prestress = |(x, normal, w): (Vec2, Vec2, f64)| {
            -self.assembly.law.initial_stress(x).traction(normal).dot(trace.axis) * w.sqrt()
        };
        let prestress: Vec<f64> = rule.points().map(prestress).collect();
        self.restraint(piece.condition).give(&trace.modes, &given, &prestress);
    }

    /// The sums of a condition.
    fn restraint(&mut self, condition: usize) -> &mut Restraint {
        let known = self.restraints.iter().position(|r| r.condition == condition);
        let place = known.unwrap_or(self.restraints.len());
        if known.is_none() {
            self.restraints.push(Restraint::new(condition, self.value_load.len()));
        }
        &mut self.restraints[place]
    }

    /// β = max(2 λ_max, C h/ℓ²) for a cell of size h with the stiffness A.
    fn penalty(&self, stiffness: &Mat<f64>, size: f64) -> Result<f64, EigenError> {
        let (n, points) = (stiffness.nrows(), self.tractions.len() / stiffness.nrows());
        let tractions = MatRef::from_column_major_slice(&self.tractions, n, points);
        let needed = FACTOR * largest_eigenvalue(stiffness.as_ref(), tractions)?;
        let ratio = (size / self.length).min(STIFFEST);
        Ok(needed.max(self.modulus * ratio / self.length))
    }

    /// Adds Nitsche's terms to the stiffness of the cell, which is complete, and to its system;
    /// `size` is that of the cell.
    ///
    /// # Errors
    /// Entries that are not finite.
    pub(crate) fn finish(
        self,
        size: f64,
        stiffness: &mut Mat<f64>,
        system: &mut CellSystem,
    ) -> Result<(), EigenError> {
        if let Some(exchange) = &self.exchange {
            *stiffness += exchange;
        }
        if self.length == 0.0 {
            system.reactions = self.reactions(0.0);
            return Ok(());
        }
        let beta = self.penalty(stiffness, size)?;
        system.penalty = beta / self.modulus;
        *stiffness -= &self.consistency;
        *stiffness -= self.consistency.transpose();
        *stiffness += faer::Scale(beta) * &self.mass;
        let loads = self.value_load.iter().zip(&self.traction_load);
        for (load, (value, traction)) in system.load.iter_mut().zip(loads) {
            *load += beta * value - traction;
        }
        system.reactions = self.reactions(beta);
        Ok(())
    }

    /// The reactions of the restraints with a penalty β.
    pub(crate) fn reactions(self, beta: f64) -> Vec<CellReaction> {
        self.restraints.into_iter().map(|restraint| restraint.finish(beta)).collect()
    }
}

/// The values g_i at the points of a rule, times the roots of the weights.
fn given(piece: &CellBoundary<'_>, rule: &EdgeRule, i: usize) -> Vec<f64> {
    rule.points().map(|(x, normal, w)| (piece.values)(x, normal)[i] * w.sqrt()).collect()
}

/// The coordinates of a direction that are not zero, with their numbers.
fn parts_of(axis: Vec2) -> Vec<(usize, f64)> {
    let all = <[f64; 2]>::from(axis).into_iter().enumerate();
    all.filter(|(_, part)| *part != 0.0).collect()
}
