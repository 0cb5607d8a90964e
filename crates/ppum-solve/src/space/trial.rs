//! A step with the lists that the solver needs to walk over it.

use super::congruence::CongruentCells;
use super::known::{KnownFunction, KnownFunctions, known_functions};
use super::williams::{self, SeriesFunctions};
use crate::law::joined;
use crate::quadrature::{CellRule, CoveredCell, Orders, Quadrature};
use crate::smoothness::Smoothness;
use crate::terms::{HeldLine, held_lines};
use ppum::box_tree::BoxTree;
use ppum::crack::{LocalCrack, Side};
use ppum::dataset::{BoxPartition, Equation, FieldData, Step, monomials};
use ppum::domain::{Domain, Hole};
use ppum::formula::Table;
use ppum::function::{FunctionError, FunctionKind, FunctionTable, Role};
use ppum_problem::Problem;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Accuracy of the quadrature of products of partition functions with polynomials of the
/// highest degree.
///
/// The share of the highest degree in a solution falls with the order as the error does, so the
/// same tolerance for it holds at all orders: 2e-5, which changes factors by less than a thousandth
/// of their error (docs/decisions/0030-points.md).
const WEIGHT_ACCURACY: f64 = 2e-5;

/// A step and its walks. Errors, energies and stress intensity factors of a solution are integrated
/// over the same cells as the system, so one space serves from the first estimate to the last
/// warning: what it looks at of its step is everything but the coefficients.
#[derive(Debug)]
pub struct TrialSpace<'d> {
    pub(super) step: Cow<'d, Step>,
    /// The holes that are cut out of the cells.
    pub(crate) holes: &'d [Hole],
    /// The step's functions, compiled.
    pub(crate) functions: FunctionTable,
    /// The patches whose open supports meet a cell, cell by cell.
    pub covering_patches: Vec<Vec<u32>>,
    /// The number of functions of a patch's local space, patch by patch.
    pub sizes: Vec<usize>,
    /// The constant σ that a block's function f is replaced by f − σ with while solving, block
    /// by block.
    ///
    /// For the side of a crack σ is the side of the patch's centre, so that f − σ vanishes on the
    /// larger part of the patch: the jump across a sliver is a function of its own, not a small
    /// difference of large ones. Zero for all other functions.
    pub(crate) shifts: Vec<f64>,
    /// The functions of each patch that represent the series of tips and corners; empty if there
    /// are none anywhere.
    pub(super) series: Vec<Vec<SeriesFunctions>>,
    /// For patches at edges with cracks, the lines on which a component is zero.
    pub(super) held: BTreeMap<u32, Vec<HeldLine>>,
    /// Functions of patches whose coefficients are known: they have no unknowns.
    pub(super) known: KnownFunctions,
    pub(super) equation: &'d Equation,
    pub(super) smoothness: Smoothness,
    pub(super) orders: Orders,
    pub(super) caches: Caches,
}

/// Tables of a space that are computed when they are first asked for.
#[derive(Debug, Default)]
pub(super) struct Caches {
    /// The rules of each cell; none of cells that are alike.
    rules: Vec<OnceLock<Vec<CellRule>>>,
    /// The cells that are alike.
    pub(super) alike: OnceLock<CongruentCells>,
}

impl<'d> TrialSpace<'d> {
    /// The walks over the first field of a step on a domain.
    ///
    /// # Errors
    /// A function of the step that does not compile.
    ///
    /// # Panics
    /// If the step has no field.
    pub fn new(
        step: &'d Step,
        domain: &'d Domain,
        equation: &'d Equation,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        Self::on(Cow::Borrowed(step), None, domain, (equation, tables))
    }

    /// The walks over a step of a problem, with formulas in place of kernels where the problem
    /// wants that. Where a temperature strains the body, quadrature resolves the functions of its
    /// step, `heat`, too.
    ///
    /// # Errors
    /// A function of a step that does not compile.
    pub fn of_problem(
        problem: &'d Problem,
        step: Step,
        heat: Option<&Step>,
    ) -> Result<Self, FunctionError> {
        let body = problem.dataset_equation();
        let heat = heat.map(|heat| (heat, &*body));
        let series = williams::series(problem, &step);
        let held = held_lines(problem, step.partition.boxes());
        let known = known_functions(problem, &step, &series);
        let formulas = (!problem.solver.kernels).then(|| {
            FunctionTable::of_formulas(&step.functions, step.cracks.len(), &problem.tables)
        });
        let constants = (&problem.equation, problem.tables.as_slice());
        let space = Self::on(Cow::Owned(step), heat, problem.domain(), constants)?;
        let functions = formulas.transpose()?.unwrap_or(space.functions);
        Ok(Self { series, held, known, functions, ..space })
    }

    fn on(
        step: Cow<'d, Step>,
        heat: Option<(&Step, &Equation)>,
        domain: &'d Domain,
        (equation, tables): (&'d Equation, &[Arc<Table>]),
    ) -> Result<Self, FunctionError> {
        let smoothness = match heat.map(|(heat, body)| (joined(&step, heat), body)) {
            Some((both, body)) => Smoothness::new(&both, &both.fields[0], body, tables)?,
            // elements are integrated by their own coordinates
            None if step.partition.mesh().is_some() => Smoothness::default(),
            None => Smoothness::new(&step, &step.fields[0], equation, tables)?,
        };
        let partition = step.partition.boxes();
        let (covering_patches, orders) =
            (covering_patches(partition), orders(partition, degree(&smoothness, equation)));
        let space = Self::of_cells(step, (equation, tables), covering_patches, orders)?;
        Ok(Self { holes: &domain.holes, smoothness, ..space })
    }

    /// The space of a step whose cells nothing cuts.
    pub(super) fn of_cells(
        step: Cow<'d, Step>,
        (equation, tables): (&'d Equation, &[Arc<Table>]),
        covering_patches: Vec<Vec<u32>>,
        orders: Orders,
    ) -> Result<Self, FunctionError> {
        let (n, data) = (step.partition.len(), &step.fields[0]);
        let size = |patch: usize| data.blocks(patch).map(|b| block_size(data, b)).sum();
        Ok(Self {
            holes: &[],
            functions: FunctionTable::new(&step.functions, step.cracks.len(), tables)?,
            sizes: (0..n).map(size).collect(),
            shifts: shifts(&step, data),
            series: Vec::new(),
            held: BTreeMap::new(),
            known: KnownFunctions::new(),
            smoothness: Smoothness::default(),
            caches: Caches { rules: vec![OnceLock::new(); n], ..Caches::default() },
            covering_patches,
            orders,
            equation,
            step,
        })
    }

    /// The functions of a patch whose coefficients are known.
    pub fn known(&self, patch: usize) -> &[KnownFunction] {
        self.known.get(&(patch as u32)).map_or(&[], Vec::as_slice)
    }

    /// The lines on which a component is zero that a patch sees.
    pub(crate) fn held_lines(&self, patch: usize) -> &[HeldLine] {
        self.held.get(&(patch as u32)).map_or(&[], Vec::as_slice)
    }

    /// A cell with the patches that meet it.
    pub fn cell(&self, cell: usize) -> CoveredCell<'_> {
        CoveredCell { rect: &self.partition().cell[cell], patches: &self.covering_patches[cell] }
    }

    /// The step, whose coefficients play no part.
    pub(crate) fn step(&self) -> &Step {
        &self.step
    }

    /// The equation of the field.
    pub(crate) fn equation(&self) -> &'d Equation {
        self.equation
    }

    /// The partition of unity.
    pub fn partition(&self) -> &BoxPartition {
        self.step.partition.boxes()
    }

    /// The field, whose coefficients play no part.
    pub fn data(&self) -> &FieldData {
        &self.step.fields[0]
    }

    /// The quadrature over the cells. `extra` Gauss points in each direction come on top of the
    /// default, for errors.
    pub fn quadrature(&self, extra: usize) -> Quadrature<'_> {
        self.quadrature_of(&self.smoothness, extra)
    }

    /// The rules of the default quadrature on a cell. They are made once, for Gram matrices,
    /// stiffness and estimate, since they take a tenth of a solution's time, and seconds where
    /// formulas are probed; on cells that are alike they are moved.
    pub(crate) fn rules(&self, quadrature: &Quadrature<'_>, cell: usize) -> Cow<'_, [CellRule]> {
        if let Some(rules) = self.alike().rules(cell, self.partition().cell[cell].center()) {
            return Cow::Owned(rules);
        }
        Cow::Borrowed(self.caches.rules[cell].get_or_init(|| quadrature.cell(self.cell(cell))))
    }

    /// Operations of all formulas that quadrature looks at.
    pub fn probe_operations(&self) -> usize {
        self.smoothness.probe_operations()
    }

    /// The places at which the functions of the space and the coefficients are not smooth.
    pub(crate) fn smoothness(&self) -> &Smoothness {
        &self.smoothness
    }

    /// The quadrature of integrands that are smooth elsewhere.
    pub(crate) fn quadrature_of<'q>(
        &'q self,
        smoothness: &'q Smoothness,
        extra: usize,
    ) -> Quadrature<'q> {
        let geometry = smoothness.geometry(self.partition(), &self.step.cracks, self.holes);
        let orders = match extra {
            0 => self.orders,
            _ => orders(self.partition(), degree(&self.smoothness, self.equation) + extra),
        };
        Quadrature::new(geometry, orders).around_axis(self.equation.is_axisymmetric())
    }

    /// Largest degree of a polynomial, times its function where that is a piecewise polynomial.
    pub fn degree(&self) -> usize {
        self.smoothness.degree()
    }

    /// True if a patch has user-defined functions.
    pub fn has_user_functions(&self, patch: usize) -> bool {
        let (data, functions) = (self.data(), &self.step().functions);
        let role = |b: usize| functions[data.block_function[b] as usize].kind.role();
        data.blocks(patch).any(|b| role(b) == Some(Role::User))
    }

    /// Degree of the polynomials of a patch.
    pub(crate) fn order(&self, patch: usize) -> usize {
        self.data().block_degree[self.data().blocks(patch).start].into()
    }

    /// Number of polynomials of a patch: the functions of its first block.
    pub(crate) fn n_polynomials(&self, patch: usize) -> usize {
        block_size(self.data(), self.data().blocks(patch).start)
    }
}

impl TrialSpace<'_> {
    /// The series of a patch.
    pub(crate) fn series(&self, patch: usize) -> &[SeriesFunctions] {
        self.series.get(patch).map_or(&[], Vec::as_slice)
    }

    /// Number of functions of a patch that the solver evaluates.
    pub(crate) fn evaluated(&self, patch: usize) -> usize {
        let fewer = |series: &SeriesFunctions| series.functions.len() - series.evaluated();
        self.sizes[patch] - self.series(patch).iter().map(fewer).sum::<usize>()
    }

    /// The series of a patch with the numbers of their functions among those that the
    /// solver evaluates.
    pub(crate) fn evaluated_series(
        &self,
        patch: usize,
    ) -> impl Iterator<Item = (Range<usize>, &SeriesFunctions)> {
        let mut fewer = 0;
        self.series(patch).iter().map(move |series| {
            let (first, n) = (series.functions.start - fewer, series.evaluated());
            fewer += series.functions.len() - n;
            (first..first + n, series)
        })
    }

    /// Number of unknowns of a patch, before any are cut off.
    pub fn unknowns(&self, patch: usize) -> usize {
        let (components, series) = (self.equation.components(), self.series(patch));
        let theirs: usize = series.iter().map(|series| series.functions.len()).sum();
        let unknowns: usize = series.iter().map(|series| series.unknowns(components)).sum();
        components * (self.sizes[patch] - theirs) + unknowns
    }
}

/// Returns for each cell the patches whose open supports meet it.
fn covering_patches(partition: &BoxPartition) -> Vec<Vec<u32>> {
    let supports: Vec<_> = (0..partition.len()).map(|i| partition.support(i)).collect();
    let tree = BoxTree::new(&supports);
    let of_cell = |cell| {
        let mut found = Vec::new();
        tree.query_box(cell, &mut found);
        found
    };
    partition.cell.iter().map(of_cell).collect()
}

/// The degree of polynomials that quadrature resolves: the weight of bodies of revolution, and
/// what stands over x, take one more.
fn degree(smoothness: &Smoothness, equation: &Equation) -> usize {
    smoothness.degree() + usize::from(equation.is_axisymmetric())
}

/// The numbers of Gauss points that polynomials of a degree and the partition's weights need.
fn orders(partition: &BoxPartition, degree: usize) -> Orders {
    let BoxPartition { weight, half, cell, .. } = partition;
    if half.is_empty() {
        return Orders::uniform(degree + 1);
    }
    let value = |xi: f64| {
        let [value, slope, _] = weight.spline(xi);
        [value, slope]
    };
    let stretch = 2.0 * half[0].x / cell[0].size().x;
    Orders::for_weight(degree, stretch, weight.breakpoints(), &value, WEIGHT_ACCURACY).0
}

fn block_size(data: &FieldData, block: usize) -> usize {
    monomials(data.block_degree[block] as usize)
}

fn shifts(step: &Step, data: &FieldData) -> Vec<f64> {
    let shift = |patch: usize, block: usize| match &step.functions
        [data.block_function[block] as usize]
        .kind
    {
        FunctionKind::Side { crack } => {
            let seen = LocalCrack::new(&step.cracks[*crack as usize], step.partition.center(patch));
            seen.side([0.0, 0.0], Side::Above)
        }
        _ => 0.0,
    };
    let patches = 0..step.partition.len();
    patches.flat_map(|patch| data.blocks(patch).map(move |b| shift(patch, b))).collect()
}
