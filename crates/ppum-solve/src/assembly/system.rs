//! The whole system in the stable basis, summed over the cells.

use super::Assembly;
use super::boundary::CellBoundary;
use super::cell::{CellAssembler, Functionals};
use super::cell_matrix::Stiffness;
use super::cell_system::CellSystem;
use super::prescribed::PrescribedData;
use super::reaction::Reactions;
use super::template::Templates;
use crate::basis::Penalty;
use crate::quadrature::{CellRule, QuadratureErrorEstimate};
use crate::report::UnresolvedIntegrand;
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use ppum::vec2::Rect;
use ppum_linear::{BlockMatrix, BlockPattern};
use std::borrow::Cow;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// The assembled system.
pub struct System {
    /// a(N_i, N_j), symmetric.
    pub matrix: BlockMatrix,
    /// Right-hand side, in the order of the matrix.
    pub load: Vec<f64>,
    /// ∫ N·m of each free mode m, in the same order.
    pub moments: Vec<Vec<f64>>,
    /// ∫ u_s·m of the known part of the field.
    pub known: Vec<f64>,
    /// K(N) of both modes summed over the tips, in the same order; none without tips.
    pub duals: Vec<Vec<f64>>,
    /// The largest Nitsche's β of a cell, times the cell's width over λ + 2μ or the conductivity.
    pub nitsche: f64,
    /// Forces of the restraints on the body.
    pub reactions: Reactions,
    /// The cost of the integrals of each cell, and the errors that they leave.
    cells: Vec<CellFacts>,
    /// Loads and data, functions and coefficients that are not resolved.
    pub unresolved: Vec<UnresolvedIntegrand>,
}

/// Cost and errors of the integrals of a cell.
#[derive(Clone, Copy)]
struct CellFacts {
    /// Number of quadrature points, those of loads that have their own among them.
    points: usize,
    /// Errors that its rules leave.
    doubt: QuadratureErrorEstimate,
    /// Seconds that one core took to find its points and integrate.
    seconds: f64,
    /// Nitsche's β over the modulus.
    penalty: f64,
}

/// Nitsche's β in units of (λ + 2μ) / width from which on a cell's boundary is cut into slivers;
/// whole cells have 3 to 36.
const SLIVER: f64 = 50.0;

/// The penalties of the cells where β is so large that the basis should see it. Advances the stage
/// by the number of cells.
///
/// # Errors
/// Data that are not finite, with their place; cancelled.
pub fn slivers(assembly: Assembly<'_>, stage: &WorkPhase<'_>) -> Result<Vec<Penalty>, Halt> {
    let Assembly { problem, space, .. } = assembly;
    let quadrature = space.quadrature(0);
    let given = PrescribedData::restraints(problem);
    let mut found = Vec::new();
    in_batches(
        stage,
        if given.is_empty() { 0 } else { assembly.n_cells() },
        || CellAssembler::new(assembly, None),
        |assembler, cell| {
            // cells that are alike are whole
            let is_whole = space.alike().cell(cell).is_some();
            let on_boundary = given.boundary(space, &quadrature, cell);
            if is_whole || on_boundary.is_empty() {
                return Ok(None);
            }
            let rect = space.partition().cell[cell];
            let rules = space.rules(&quadrature, cell);
            let part = assembler.assemble(cell, &rules, None, &on_boundary, None);
            let weight = part.map_err(|_| Halt::at(rect))?.0.penalty;
            let rules = on_boundary.into_iter().flat_map(|piece| piece.rules).collect();
            Ok((weight * width(&rect) > SLIVER).then_some(Penalty { rules, weight }))
        },
        |_, penalty| found.extend(penalty),
    )?;
    Ok(found)
}

fn width(cell: &Rect) -> f64 {
    cell.size().x.max(cell.size().y)
}

fn n_cell_points(rules: &[CellRule]) -> usize {
    rules.iter().map(|rule| rule.weights.len()).sum()
}

fn n_boundary_points(pieces: &[CellBoundary<'_>]) -> usize {
    let own = pieces.iter().filter_map(|piece| piece.own).flatten();
    pieces.iter().flat_map(|piece| &piece.rules).chain(own).map(|rule| rule.weights.len()).sum()
}

/// Errors that the rules of a cell and of its boundary leave.
fn doubt_of(rules: &[CellRule], pieces: &[CellBoundary<'_>]) -> QuadratureErrorEstimate {
    let boundary = pieces.iter().flat_map(|piece| &piece.rules).map(|rule| &rule.doubt);
    let mut sum = QuadratureErrorEstimate::default();
    rules.iter().map(|rule| &rule.doubt).chain(boundary).for_each(|doubt| sum.add(doubt));
    sum
}

impl System {
    /// Assembles the system of what is given, and functionals. Advances the stage by the number of
    /// cells.
    ///
    /// # Errors
    /// Data that are not finite, with their place; cancelled.
    pub fn new(
        assembly: Assembly<'_>,
        given: &PrescribedData<'_>,
        functionals: Functionals<'_>,
        stage: &WorkPhase<'_>,
    ) -> Result<Self, Halt> {
        let Assembly { space, .. } = assembly;
        let quadrature = space.quadrature(0);
        let (mut system, templates) =
            (Self::zero(&assembly, functionals), Templates::new(assembly));
        // to ask the system for memory and to return it takes longer than to write there
        let memory = Mutex::new(Vec::new());
        let spare = || memory.lock().unwrap_or_else(PoisonError::into_inner);
        in_batches(
            stage,
            assembly.n_cells(),
            || CellAssembler::new(assembly, Some(functionals)),
            |assembler, cell| {
                let start = Instant::now();
                let pieces = given.boundary(space, &quadrature, cell);
                let source = given.source(cell);
                let template = templates.of(cell);
                let shares_rules = source.is_some_and(|source| source.rules.is_none())
                    || assembly.law.has_initial_stress();
                let rules = match &template {
                    Some(_) if !shares_rules && !functionals.are_of(cell) => Cow::default(),
                    _ => space.rules(&quadrature, cell),
                };
                let own = source.and_then(|source| source.rules).map_or(0, n_cell_points);
                let inside = templates.points(cell).unwrap_or_else(|| n_cell_points(&rules));
                let points = inside + n_boundary_points(&pieces) + own;
                assembler.memory = spare().pop().unwrap_or_default();
                let (part, matrix) = assembler
                    .assemble(cell, &rules, source, &pieces, template.as_ref())
                    .map_err(|_| Halt::at(space.partition().cell[cell]))?;
                let made = matrix.map(|m| Stiffness { matrix: Cow::Owned(m), seats: None });
                let stiffness = made.or(template).expect("it is made unless there is a template");
                let doubt = doubt_of(&rules, &pieces);
                let seconds = start.elapsed().as_secs_f64();
                let facts = CellFacts { points, doubt, seconds, penalty: part.penalty };
                Ok((facts, part, stiffness))
            },
            |cell, (facts, part, stiffness)| {
                system.cells.push(facts);
                let penalty = part.penalty * width(&space.partition().cell[cell]);
                system.nitsche = system.nitsche.max(penalty);
                system.add(part, &stiffness, &assembly);
                if let Cow::Owned(matrix) = stiffness.matrix {
                    spare().push(matrix.into_values());
                }
            },
        )?;
        system.sum_up(given);
        Ok(system)
    }

    /// Collects the unresolved integrands of the data and of all cells.
    fn sum_up(&mut self, given: &PrescribedData<'_>) {
        let mut doubt = QuadratureErrorEstimate::default();
        self.cells.iter().for_each(|cell| doubt.add(&cell.doubt));
        self.unresolved = given.unresolved();
        if doubt.functions > 0.0 {
            let functions =
                UnresolvedIntegrand { load: None, error: doubt.functions, at: doubt.at };
            self.unresolved.push(functions);
        }
    }

    /// Returns the number of quadrature points of each cell.
    pub fn points(&self) -> Vec<f64> {
        self.cells.iter().map(|cell| cell.points as f64).collect()
    }

    /// Returns the seconds that one core took for each cell.
    pub fn seconds(&self) -> Vec<f64> {
        self.cells.iter().map(|cell| cell.seconds).collect()
    }

    /// Returns Nitsche's β of each cell over the largest modulus on its boundary.
    pub fn penalties(&self) -> Vec<f64> {
        self.cells.iter().map(|cell| cell.penalty).collect()
    }

    /// Bytes of the matrix and of all right-hand sides.
    pub fn bytes(&self) -> usize {
        let sides = 1 + self.moments.len() + self.duals.len();
        self.matrix.bytes() + sides * self.load.len() * size_of::<f64>()
    }

    fn zero(assembly: &Assembly<'_>, Functionals { free, duals }: Functionals<'_>) -> Self {
        let sizes = assembly.basis.unknowns(assembly.components());
        let matrix = BlockMatrix::new(&sizes.collect::<Vec<_>>(), pattern(assembly.space));
        Self {
            load: vec![0.0; matrix.n_unknowns()],
            moments: vec![vec![0.0; matrix.n_unknowns()]; free.len()],
            known: vec![0.0; free.len()],
            duals: vec![vec![0.0; matrix.n_unknowns()]; duals.len()],
            matrix,
            nitsche: 0.0,
            reactions: Reactions::default(),
            cells: Vec::new(),
            unresolved: Vec::new(),
        }
    }

    fn add_functionals(&mut self, part: &CellSystem, assembly: &Assembly<'_>) {
        self.known.iter_mut().zip(&part.known).for_each(|(sum, part)| *sum += part);
        let functionals = part.moments.iter().chain(&part.duals);
        for (sum, part_of) in self.moments.iter_mut().chain(&mut self.duals).zip(functionals) {
            let components = assembly.components();
            part.functions.add_to(assembly.basis, &self.matrix, components, part_of, sum);
        }
    }

    fn add(&mut self, part: CellSystem, stiffness: &Stiffness<'_>, assembly: &Assembly<'_>) {
        let (basis, components) = (assembly.basis, assembly.components());
        part.functions.add_to(basis, &self.matrix, components, &part.load, &mut self.load);
        self.add_functionals(&part, assembly);
        let patches = &part.functions.patches;
        for (k, l) in part.functions.pairs(assembly) {
            let [p, q] = [k, l].map(|k| patches[k] as usize);
            self.matrix.add_block(p, q, stiffness.block(k, l));
        }
        self.reactions.push(part.functions, part.reactions);
    }
}

/// Two patches are coupled when their open supports meet.
pub fn pattern(space: &TrialSpace<'_>) -> BlockPattern {
    let support = |p: u32| space.partition().support(p as usize);
    let mut rows = vec![Vec::new(); space.partition().len()];
    for patches in &space.covering_patches {
        for (k, &p) in patches.iter().enumerate() {
            let meets = |q: &&u32| support(p).overlaps(&support(**q));
            rows[p as usize].extend(patches[k..].iter().filter(meets));
        }
    }
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for row in &mut rows {
        row.sort_unstable();
        row.dedup();
        columns.extend_from_slice(row);
        starts.push(columns.len());
    }
    BlockPattern::new(starts, columns)
}
