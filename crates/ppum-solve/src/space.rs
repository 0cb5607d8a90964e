//! The trial space: a step whose coefficients are still to be found, and the lists the solver needs
//! to walk over it.

use crate::enrichment::{Block, Enrichments};
use crate::inspect::{InspectError, inspect};
use crate::placed::Placed;
use crate::problem::quantities::field_names;
use crate::problem::{OrderError, Problem};
use crate::quadrature::{Geometry, Orders, Quadrature, Rule};
use crate::refine::{RefineError, cover, n_crossed_twice};
use crate::smoothness::Smoothness;
use ppum::box_tree::BoxTree;
use ppum::crack::{LocalCrack, Side};
use ppum::dataset::{Attribute, Equation, FieldData, Partition, Record, Step, monomials};
use ppum::domain::{Domain, Hole};
use ppum::formula::Table;
use ppum::function::{FunctionError, FunctionKind, FunctionTable};
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// Accuracy of the quadrature of products of partition functions, as [`Orders::for_degree`] has it with
/// linear weights.
const WEIGHT_ACCURACY: f64 = 1e-5;

/// A step and its walks. The step may hold a solution: errors and stress intensity are integrated
/// over the same cells as the system.
#[derive(Debug)]
pub struct Space<'d> {
    /// What is cut out of the cells.
    pub holes: &'d [Hole],
    /// The partition of unity.
    pub partition: &'d Partition,
    /// The step.
    pub step: &'d Step,
    /// The field.
    pub data: &'d FieldData,
    /// The step's functions, compiled.
    pub functions: FunctionTable,
    /// Of each cell, the patches whose open supports meet it.
    pub coverers: Vec<Vec<u32>>,
    /// Of each patch, the number of functions of its local space.
    pub sizes: Vec<usize>,
    /// Of each block, the constant σ its function is replaced by f − σ with while solving.
    ///
    /// For the side of a crack σ is the side of the patch's centre, so that f − σ vanishes on the
    /// larger part of the patch: the jump across a sliver is a function of its own, not a small
    /// difference of large ones. Zero for all other functions.
    pub shifts: Vec<f64>,
    smoothness: Smoothness,
    orders: Orders,
    /// Of each cell where formulas are probed, its rules once they are made.
    probed: Vec<OnceLock<Vec<Rule>>>,
}

impl<'d> Space<'d> {
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
        equation: &Equation,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        let (partition, data) = (&step.partition, &step.fields[0]);
        let supports: Vec<_> = (0..partition.len()).map(|i| partition.support(i)).collect();
        let tree = BoxTree::new(&supports);
        let coverers = partition.cell.iter().map(|cell| {
            let mut found = Vec::new();
            tree.query_box(cell, &mut found);
            found
        });
        let size = |patch: usize| data.blocks(patch).map(|b| block_size(data, b)).sum();
        let smoothness = Smoothness::new(step, data, equation, tables)?;
        Ok(Self {
            holes: &domain.holes,
            partition,
            step,
            data,
            functions: FunctionTable::new(&step.functions, step.cracks.len(), tables)?,
            coverers: coverers.collect(),
            sizes: (0..partition.len()).map(size).collect(),
            shifts: shifts(step, data),
            orders: orders(partition, smoothness.degree()),
            probed: vec![OnceLock::new(); partition.len()],
            smoothness,
        })
    }

    /// The quadrature over the cells. `extra` Gauss points in each direction come on top of the
    /// default, for errors.
    #[must_use]
    pub fn quadrature(&self, extra: usize) -> Quadrature<'_> {
        self.quadrature_of(&self.smoothness, extra)
    }

    /// The rules of the default quadrature on a cell. Where formulas are probed they cost up to seconds, and
    /// are made once.
    pub(crate) fn rules(&self, quadrature: &Quadrature<'_>, cell: usize) -> Cow<'_, [Rule]> {
        let coverers = &self.coverers[cell];
        let rules = || quadrature.cell(&self.partition.cell[cell], coverers);
        if self.smoothness.has_probes(coverers) {
            Cow::Borrowed(self.probed[cell].get_or_init(rules))
        } else {
            Cow::Owned(rules())
        }
    }

    /// Operations of all formulas that quadrature looks at.
    pub(crate) fn probe_operations(&self) -> usize {
        self.smoothness.probe_operations()
    }

    /// Where the functions of the space and the coefficients are not smooth.
    pub(crate) fn smoothness(&self) -> &Smoothness {
        &self.smoothness
    }

    /// The quadrature of integrands that are smooth elsewhere.
    pub(crate) fn quadrature_of<'q>(
        &'q self,
        smoothness: &'q Smoothness,
        extra: usize,
    ) -> Quadrature<'q> {
        let geometry = smoothness.geometry(self.partition, &self.step.cracks, self.holes);
        let orders = match extra {
            0 => self.orders,
            _ => orders(self.partition, self.degree() + extra),
        };
        Quadrature::new(geometry, orders)
    }

    /// Largest degree of a polynomial, times its function where that is a piecewise polynomial.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.smoothness.degree()
    }

    /// Number of polynomials of a patch: the functions of its first block.
    #[must_use]
    pub fn n_polynomials(&self, patch: usize) -> usize {
        block_size(self.data, self.data.blocks(patch).start)
    }
}

/// The numbers of Gauss points that polynomials of a degree and the partition's weights need.
fn orders(partition: &Partition, degree: usize) -> Orders {
    let weight = &partition.weight;
    if *weight == WeightFunction::Linear {
        return Orders::for_degree(degree);
    }
    let (half, cell) = (partition.half[0], &partition.cell[0]);
    let value = |xi: f64| {
        let [value, slope, _] = weight.spline(xi);
        [value, slope]
    };
    let stretch = 2.0 * half.x / cell.size().x;
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
            let seen = LocalCrack::new(&step.cracks[*crack as usize], step.partition.center[patch]);
            seen.side([0.0, 0.0], Side::Above)
        }
        _ => 0.0,
    };
    let patches = 0..step.partition.len();
    patches.flat_map(|patch| data.blocks(patch).map(move |b| shift(patch, b))).collect()
}

/// The space of a problem cannot be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// The cover.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// Holes that leave nothing.
    #[error("the holes swallow the whole domain; make them smaller")]
    Nothing,
    /// The order formula.
    #[error(transparent)]
    Order(#[from] OrderError),
    /// A function that cannot be used.
    #[error(transparent)]
    Function(#[from] InspectError),
}

/// The step of a problem with all coefficients zero.
///
/// # Errors
/// A cover that cannot be built or refined, an order formula that gives no order, a function that is
/// not finite on its patches.
pub fn discretise(problem: &Problem) -> Result<Step, SpaceError> {
    discretise_within(problem, usize::MAX)
}

/// The same on a cover of at most so many cells, before those in holes are left out.
///
/// # Errors
/// See [`discretise`]; a cover with more cells.
pub(crate) fn discretise_within(problem: &Problem, most: usize) -> Result<Step, SpaceError> {
    let set = &problem.discretization;
    let partition = cover(problem, most)?
        .partition(set.overlap, set.weight.clone())
        .map_err(RefineError::from)?;
    let partition = solid_part(partition, &problem.domain.holes)?;
    let mut enrichments = Enrichments::new(problem);
    enrichments.add_interfaces(&partition).map_err(InspectError::from)?;
    let mut blocks = Vec::with_capacity(partition.len());
    for patch in 0..partition.len() {
        let degree = set.order.at(partition.center[patch])? as u8;
        blocks.push(enrichments.blocks(&partition, patch, degree));
    }
    let crossed = n_crossed_twice(problem, &partition) as f64;
    let step = Step {
        load: 1.0,
        cracks: problem.cracks.clone(),
        attributes: attributes(&blocks),
        fields: vec![field(problem, &blocks)],
        functions: enrichments.table,
        partition,
        intensities: Vec::new(),
        history: vec![Record { name: "crossed twice".into(), value: crossed, unit: String::new() }],
        warnings: Vec::new(),
        reactions: Vec::new(),
    };
    inspect(&step, &problem.domain, &problem.tables)?;
    Ok(step)
}

/// Cells of which holes leave no more than this part are dropped: it is rounding.
const LEAST_PART: f64 = 1e-12;

/// A partition without the cells in holes and their patches.
fn solid_part(partition: Partition, holes: &[Hole]) -> Result<Partition, SpaceError> {
    if holes.is_empty() {
        return Ok(partition);
    }
    let geometry = Geometry { holes, ..Geometry::new(&partition, &[]) };
    let quadrature = Quadrature::new(geometry, Orders::for_degree(1));
    let placed = Placed::new(holes.iter().map(|hole| (hole.bounds(), hole)));
    let is_solid = |(index, cell): (u32, &Rect)| {
        let size = cell.size();
        let near: Vec<_> = placed.near(cell).copied().collect();
        let area = |rules: Vec<Rule>| rules.iter().flat_map(|r| &r.weights).sum::<f64>();
        near.is_empty()
            || has_room(cell, &near)
            || area(quadrature.cell(cell, &[index])) > LEAST_PART * size.x * size.y
    };
    let solid: Vec<bool> = (0..).zip(&partition.cell).map(is_solid).collect();
    if !solid.contains(&true) {
        return Err(SpaceError::Nothing);
    }
    Ok(Partition {
        center: kept(&partition.center, &solid),
        half: kept(&partition.half, &solid),
        origin: kept(&partition.origin, &solid),
        scale: kept(&partition.scale, &solid),
        cell: kept(&partition.cell, &solid),
        level: kept(&partition.level, &solid),
        point: kept(&partition.point, &solid),
        ..partition
    })
}

/// Places of a cell in each direction that are looked at before its area is integrated.
const LOOKS: u32 = 5;

/// Distance from the rims, in sizes of a cell, of a place that shows enough of the material.
const ROOM: f64 = 1e-5;

/// True if one of some places in a cell lies clearly outside of holes: most cells are seen to be solid so.
fn has_room(cell: &Rect, holes: &[&Hole]) -> bool {
    let size = cell.size();
    let along = |k: u32| (f64::from(k) + 0.5) / f64::from(LOOKS);
    let all = (0..LOOKS * LOOKS).map(|k| vec2(along(k % LOOKS), along(k / LOOKS)));
    let mut places = all.map(|at| cell.min + vec2(at.x * size.x, at.y * size.y));
    let room = ROOM * size.x.min(size.y);
    places.any(|p| holes.iter().all(|hole| !hole.contains(p) && hole.rim_distance(p) > room))
}

/// The entries that are kept.
fn kept<T: Clone>(all: &[T], keep: &[bool]) -> Vec<T> {
    all.iter().zip(keep).filter(|(_, keep)| **keep).map(|(entry, _)| entry.clone()).collect()
}

/// Order of the polynomials, number of blocks with a jump and with a tip function, of each patch.
fn attributes(blocks: &[Vec<Block>]) -> Vec<Attribute> {
    let attribute = |name: &str, value: &dyn Fn(&Vec<Block>) -> usize| Attribute {
        name: name.into(),
        values: blocks.iter().map(|b| value(b) as f64).collect(),
    };
    vec![
        attribute("order", &|b| b[0].1 as usize),
        attribute("blocks", &|b| b.len()),
        attribute("functions", &|b| b.iter().map(|&(_, d)| monomials(d as usize)).sum()),
    ]
}

fn field(problem: &Problem, blocks: &[Vec<Block>]) -> FieldData {
    let (name, components) = field_names(&problem.equation);
    let mut data = FieldData {
        name: name.into(),
        unit: String::new(),
        components: components.iter().map(|&c| c.to_owned()).collect(),
        patch_blocks: vec![0],
        block_function: Vec::new(),
        block_degree: Vec::new(),
        block_offset: Vec::new(),
        coefficients: Vec::new(),
        exact: problem.exact.iter().map(|e| e.text().to_owned()).collect(),
    };
    let mut offset = 0;
    for patch in blocks {
        for &(function, degree) in patch {
            data.block_function.push(function);
            data.block_degree.push(degree);
            data.block_offset.push(offset);
            offset += monomials(degree as usize) as u64;
        }
        data.patch_blocks.push(data.block_function.len() as u32);
    }
    data.coefficients = vec![vec![0.0; offset as usize]; components.len()];
    data
}
