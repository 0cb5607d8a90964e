//! The contribution of one leaf cell to the system, in the stable basis.
//!
//! ```text
//! K = ∫_C ∇N·C·∇N        f = ∫_C N·b + ∇N·C (ε⁰ − ∇u_s)
//! ```
//!
//! with the given strains ε⁰ and the known part u_s of the field.

use super::Assembly;
use super::boundary::{BoundarySums, CellBoundary};
use super::cell_matrix::{CellMatrix, Stiffness};
use super::cell_system::CellSystem;
use super::dual::DualLoads;
use super::functions::CellFunctions;
use super::null_space::FreeModes;
use super::stiffness::PointStrains;
use crate::basis::{BasisEvaluator, Shapes};
use crate::law::{Strain, Stress};
use crate::quadrature::CellRule;
use ppum::vec2::Vec2;
use ppum_linear::EigenError;

/// Data given at a point: position → values, one per component.
pub(crate) type Data<'a> = &'a (dyn Fn(Vec2) -> [f64; 2] + Sync);

/// The source, and rules for it in a cell that take the place of the cell's.
#[derive(Clone, Copy)]
pub(crate) struct SourceTerm<'a> {
    pub(crate) values: Data<'a>,
    pub(crate) rules: Option<&'a [CellRule]>,
}

/// Functionals whose values for all functions are integrated with the system.
#[derive(Clone, Copy)]
pub struct Functionals<'a> {
    /// ∫ N·m of the free modes m of the pieces.
    pub free: &'a FreeModes<'a>,
    /// K(N) of both modes, summed over the tips.
    pub duals: &'a DualLoads<'a>,
}

/// Assembles the systems of cells; keeps what belongs to the last one.
pub(crate) struct CellAssembler<'s> {
    assembly: Assembly<'s>,
    /// The functionals that are wanted, if any are.
    functionals: Option<Functionals<'s>>,
    evaluator: BasisEvaluator<'s>,
    shapes: Shapes,
    strains: PointStrains,
    /// Memory for the next matrix.
    pub(super) memory: Vec<f64>,
}

impl<'s> CellAssembler<'s> {
    pub(crate) fn new(assembly: Assembly<'s>, functionals: Option<Functionals<'s>>) -> Self {
        let evaluator = BasisEvaluator::new(assembly.space, assembly.basis);
        let (shapes, strains) = (Shapes::default(), PointStrains::default());
        let memory = Vec::new();
        Self { assembly, functionals, evaluator, shapes, strains, memory }
    }

    /// The system of one cell, given its quadrature, body forces and the pieces of its boundary. A
    /// stiffness that is `known` needs no rules, and if nothing on the boundary is held it is the
    /// cell's: none is returned then.
    ///
    /// # Errors
    /// Entries that are not finite, which data that are not finite cause.
    pub(crate) fn assemble(
        &mut self,
        cell: usize,
        rules: &[CellRule],
        source: Option<SourceTerm<'_>>,
        boundary: &[CellBoundary<'_>],
        known: Option<&Stiffness<'_>>,
    ) -> Result<(CellSystem, Option<CellMatrix>), EigenError> {
        let is_restrained = boundary.iter().any(|piece| piece.held.contains(&true));
        // what all fields satisfy needs nothing of the matrix
        let is_held = boundary.iter().any(|piece| piece.held.contains(&true) && !piece.is_exact);
        let mut system = self.zero(CellFunctions::new(&self.assembly, cell));
        let memory = std::mem::take(&mut self.memory);
        let zero = || system.functions.zero(&self.assembly, !is_held, memory);
        let mut matrix = known.is_none().then(zero);
        let shared = source.filter(|source| source.rules.is_none()).map(|source| source.values);
        let mut plain = self.zero(CellFunctions::plain(&self.assembly, cell));
        for rule in rules {
            self.evaluator.see(rule);
            self.stiffen(rule, !is_held, matrix.as_mut(), &system.functions);
            self.add_functionals((cell, rule), &mut plain);
            self.load(rule, shared, &mut system);
            self.prestress(rule, &mut system);
        }
        self.add_own_duals(cell, &mut plain);
        system.add_functionals(&plain, self.assembly.basis, self.assembly.components());
        system.known =
            plain.moments.iter().map(|m| self.known_value(&plain.functions, m)).collect();
        for rule in source.and_then(|source| source.rules).unwrap_or_default() {
            self.evaluator.see(rule);
            self.load(rule, source.map(|source| source.values), &mut system);
        }
        if boundary.is_empty() {
            return Ok((system, matrix));
        }
        // where nothing is held there are loads alone, and the matrices stay empty
        let unknowns = if is_restrained { system.load.len() } else { 0 };
        let mut on_boundary = BoundarySums::new(self.assembly, unknowns);
        for piece in boundary {
            on_boundary.add(piece, &mut self.evaluator, &mut self.shapes, &mut system);
        }
        if !is_held {
            system.reactions = on_boundary.reactions(0.0);
            return Ok((system, matrix));
        }
        let block = |k: usize, l: usize| match (&matrix, known) {
            (Some(own), _) => own.block(k, l),
            (None, known) => known.expect("it is made unless it is known").block(k, l),
        };
        let mut free = system.functions.free_matrix(&self.assembly, &block);
        let size = self.assembly.space.partition().cell[cell].size();
        on_boundary.finish(size.x.max(size.y), &mut free, &mut system)?;
        let tied = system.functions.tied_matrix(&self.assembly, &free);
        Ok((system, Some(tied)))
    }

    /// The stiffness of a cell of which nothing on the boundary is held.
    pub(super) fn stiffness(&mut self, cell: usize, rules: &[CellRule]) -> CellMatrix {
        let functions = CellFunctions::new(&self.assembly, cell);
        let mut matrix = functions.zero(&self.assembly, true, Vec::new());
        for rule in rules {
            self.evaluator.see(rule);
            self.stiffen(rule, true, Some(&mut matrix), &functions);
        }
        matrix
    }

    /// A system of a cell of which nothing but the size is known.
    fn zero(&self, functions: CellFunctions) -> CellSystem {
        let unknowns = functions.len() * self.assembly.law.components;
        let zeros = |count: usize| vec![vec![0.0; unknowns]; count];
        CellSystem {
            load: vec![0.0; unknowns],
            moments: zeros(self.functionals.map_or(0, |all| all.free.len())),
            known: Vec::new(),
            duals: zeros(self.functionals.map_or(0, |all| all.duals.len())),
            penalty: 0.0,
            reactions: Vec::new(),
            functions,
        }
    }

    /// Adds a source at the points of the rule that was looked at last.
    fn load(&mut self, rule: &CellRule, source: Option<Data<'_>>, system: &mut CellSystem) {
        let Some(source) = source else { return };
        self.evaluator.apply(&rule.patches, &mut self.shapes);
        let numbers = system.functions.numbers(&rule.patches);
        let load = |(x, weight)| source(x).map(|f| weight * f);
        let loads: Vec<[f64; 2]> = rule.points().map(load).collect();
        self.shapes.add_loads(&loads, &numbers, self.assembly.components(), &mut system.load);
    }

    /// Adds ∫ ∇N·C (ε⁰ − ∇u_s) of the strains that are given, and of the known part of the field,
    /// at the points of the rule that was looked at last.
    fn prestress(&mut self, rule: &CellRule, system: &mut CellSystem) {
        let law = self.assembly.law;
        let known = self.known_strains(rule);
        if !law.has_initial_stress() && known.is_empty() {
            return;
        }
        self.evaluator.apply(&rule.patches, &mut self.shapes);
        let stress = |(q, (x, weight)): (usize, (Vec2, f64))| {
            let strain = known.get(q).copied().unwrap_or_default();
            let Stress(rows) = law.at(x).stress(&strain);
            [Stress(rows.map(|row| row.map(|s| -weight * s)))]
        };
        let stresses: Vec<[Stress; 1]> = rule.points().enumerate().map(stress).collect();
        let numbers = system.functions.numbers(&rule.patches);
        self.shapes.add_stresses(&stresses, &numbers, [&mut system.load]);
    }

    /// The value of a functional of the plain functions for the known part of the field.
    fn known_value(&self, functions: &CellFunctions, functional: &[f64]) -> f64 {
        let Assembly { space, law, .. } = self.assembly;
        let mut sum = 0.0;
        for (k, &patch) in functions.patches.iter().enumerate() {
            for known in space.known(patch as usize) {
                let first = (functions.first[k] + known.evaluated) * law.components;
                let parts = functional[first..].iter().zip(known.coefficients);
                sum += parts.map(|(value, c)| value * c).sum::<f64>();
            }
        }
        sum
    }

    /// The strains of u_s at the points of the rule that was looked at last; none if all of u_s is
    /// zero.
    fn known_strains(&self, rule: &CellRule) -> Vec<Strain> {
        let (space, plain) = (self.assembly.space, self.evaluator.plain());
        let (mut first, mut sum) = (0, Vec::new());
        for &patch in &rule.patches {
            for known in space.known(patch as usize) {
                sum.resize(plain.points, Strain::default());
                for (q, strain) in sum.iter_mut().enumerate() {
                    let slopes = plain.slopes_at(first + known.evaluated, q);
                    (0..).zip(known.coefficients).for_each(|(i, c)| strain.add(i, c, slopes));
                }
            }
            first += space.evaluated(patch as usize);
        }
        sum
    }

    /// Adds the points of the rule that was looked at last to a matrix of fields, or of functions
    /// where they are not tied.
    fn stiffen(
        &mut self,
        rule: &CellRule,
        tied: bool,
        matrix: Option<&mut CellMatrix>,
        functions: &CellFunctions,
    ) {
        let Some(matrix) = matrix else { return };
        let fields = self.assembly.fields(&rule.patches, tied);
        let (places, plain) = (functions.positions(&rule.patches), self.evaluator.plain());
        self.strains.integrate(self.assembly.law, (rule, plain), (&fields, &places), matrix);
    }

    /// Adds these points to the functionals of the plain functions.
    fn add_functionals(&self, (cell, rule): (usize, &CellRule), plain: &mut CellSystem) {
        let Some(all) = self.functionals.filter(|all| all.are_of(cell)) else { return };
        let (numbers, shapes) = (plain.functions.numbers(&rule.patches), self.evaluator.plain());
        all.free.add(rule, shapes, &numbers, self.assembly.components(), &mut plain.moments);
        all.duals.add((cell, rule), shapes, &numbers, &mut plain.duals);
    }
}

impl CellAssembler<'_> {
    /// Adds the functionals of tips that have rules of their own.
    fn add_own_duals(&mut self, cell: usize, plain: &mut CellSystem) {
        let Some(Functionals { duals, .. }) = self.functionals else { return };
        for (tip, rule) in duals.own_rules(cell) {
            self.evaluator.see(&rule);
            let numbers = plain.functions.numbers(&rule.patches);
            duals.add_tip((tip, &rule), self.evaluator.plain(), &numbers, &mut plain.duals);
        }
    }
}

impl Functionals<'_> {
    /// True if some of them have a part in a cell.
    pub(super) fn are_of(&self, cell: usize) -> bool {
        self.free.len() > 0 || !self.duals.is_far(cell)
    }
}
