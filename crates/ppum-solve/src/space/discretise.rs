//! From a problem to a step with all coefficients zero: cover, enrichment, inspection.

use super::enrichment::{BlockSpec, Enrichments};
use super::error::SpaceError;
use super::inspect::inspect;
use super::mesh::CoverMesh;
use crate::quadrature::{CellRule, CoveredCell, Orders, Quadrature, SmoothnessGeometry};
use crate::refine::RefineError;
use crate::watched::WorkPhase;
use ppum::dataset::{Attribute, BoxPartition, FieldData, MAX_DEGREE, Step, monomials};
use ppum::domain::Hole;
use ppum::progress::{Phase, Watcher};
use ppum::vec2::{Rect, vec2};
use ppum_problem::Problem;
use ppum_problem::geometry::BoxList;
use ppum_problem::quantities::field_names;

/// The step of a problem with all coefficients zero.
///
/// # Errors
/// A cover that cannot be built or refined, an order formula that gives no order, a function that
/// is not finite on its patches; cancelled.
pub fn discretise(problem: &Problem, watcher: &dyn Watcher) -> Result<Step, SpaceError> {
    let stage = WorkPhase::uncounted(watcher, Phase::Cover)?;
    discretise_on(problem, &CoverMesh::new(problem, usize::MAX, &stage)?, &stage)
}

/// Discretises a problem on a given mesh of its cover.
///
/// # Errors
/// See [`discretise`].
pub fn discretise_on(
    problem: &Problem,
    mesh: &CoverMesh,
    stage: &WorkPhase<'_>,
) -> Result<Step, SpaceError> {
    let set = &problem.discretization;
    let partition =
        mesh.cover.partition(set.overlap, set.weight.clone()).map_err(RefineError::from)?;
    let (partition, raised) = inner_part(partition, &mesh.raised, &problem.domain().bounds);
    let (partition, raised) = solid_part(partition, &raised, &problem.domain().holes)?;
    let mut partition = partition;
    if problem.equation.is_axisymmetric() {
        see_from_axis(&mut partition);
    }
    let mut enrichments = Enrichments::new(problem);
    enrichments.add_interfaces(&partition, stage)?;
    enrichments.add_corners(&partition);
    enrichments.add_known(&partition);
    let mut blocks = Vec::with_capacity(partition.len());
    for (patch, raised) in raised.into_iter().enumerate() {
        stage.advance(0)?;
        let order = set.order.at(partition.center[patch])? as u8;
        let degree = (order + raised).min(MAX_DEGREE as u8);
        blocks.push(enrichments.blocks(&partition, patch, degree));
    }
    let mut step = Step::new(partition).with_field(field(problem, &blocks));
    step.cracks = problem.cracks().to_vec();
    step.functions = enrichments.table;
    step.attributes = attributes(&blocks);
    inspect(&step, problem.domain(), &problem.tables)?;
    Ok(step)
}

/// Cells of which holes leave no more than this part are dropped: it is rounding.
const LEAST_PART: f64 = 1e-12;

/// A partition with its cells as far as they lie in the domain, and the raised orders of those of
/// which something does: the last cells of coarser meshes may reach beyond it.
fn inner_part(
    mut partition: BoxPartition,
    raised: &[u8],
    bounds: &Rect,
) -> (BoxPartition, Vec<u8>) {
    let inside = |cell: &Rect| {
        let first = cell.min + cell.size() * ROOM;
        first.x < bounds.max.x && first.y < bounds.max.y
    };
    let is_inner: Vec<bool> = partition.cell.iter().map(inside).collect();
    partition.cell.iter_mut().for_each(|cell| *cell = cell.intersection(bounds));
    if is_inner.contains(&false) {
        some(partition, raised, &is_inner)
    } else {
        (partition, raised.to_vec())
    }
}

/// Counts the polynomials of patches on the axis of a body of revolution from there, so that of
/// those that vanish on it all terms do, and u_x/x keeps its digits beside it.
fn see_from_axis(partition: &mut BoxPartition) {
    for patch in 0..partition.len() {
        let support = partition.support(patch);
        if support.min.x <= 0.0 {
            (partition.origin[patch].x, partition.scale[patch].x) = (0.0, support.max.x);
        }
    }
}

/// Some patches of a partition, with the raised orders of their cells.
fn some(partition: BoxPartition, raised: &[u8], keep: &[bool]) -> (BoxPartition, Vec<u8>) {
    let part = BoxPartition {
        center: kept(&partition.center, keep),
        half: kept(&partition.half, keep),
        origin: kept(&partition.origin, keep),
        scale: kept(&partition.scale, keep),
        cell: kept(&partition.cell, keep),
        level: kept(&partition.level, keep),
        point: kept(&partition.point, keep),
        ..partition
    };
    (part, kept(raised, keep))
}

/// A partition and the raised orders of its cells without the cells in holes and their patches.
fn solid_part(
    partition: BoxPartition,
    raised: &[u8],
    holes: &[Hole],
) -> Result<(BoxPartition, Vec<u8>), SpaceError> {
    if holes.is_empty() {
        return Ok((partition, raised.to_vec()));
    }
    let geometry = SmoothnessGeometry { holes, ..SmoothnessGeometry::new(&partition, &[]) };
    let quadrature = Quadrature::new(geometry, Orders::for_degree(1));
    let all = partition.cell.iter().copied().reduce(|all, cell| all.union(&cell));
    let all = all.ok_or(SpaceError::Nothing)?;
    let placed = BoxList::new(holes.iter().map(|hole| (hole.bounds().intersection(&all), hole)));
    let is_solid = |(index, cell): (u32, &Rect)| {
        let size = cell.size();
        let near: Vec<_> = placed.near(cell).copied().collect();
        let area = |rules: Vec<CellRule>| rules.iter().flat_map(|r| &r.weights).sum::<f64>();
        near.is_empty()
            || has_room(cell, &near)
            || area(quadrature.cell(CoveredCell { rect: cell, patches: &[index] }))
                > LEAST_PART * size.x * size.y
    };
    let solid: Vec<bool> = (0..).zip(&partition.cell).map(is_solid).collect();
    if !solid.contains(&true) {
        return Err(SpaceError::Nothing);
    }
    Ok(some(partition, raised, &solid))
}

/// Places of a cell in each direction that are looked at before its area is integrated.
const LOOKS: u32 = 5;

/// Distance from rims and boundaries, in sizes of a cell, of a place that shows enough of the
/// material.
const ROOM: f64 = 1e-5;

/// True if one of some places in a cell lies clearly outside of holes: most cells are seen to be
/// solid so.
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

/// Order of the polynomials, number of blocks and number of functions of each patch.
fn attributes(blocks: &[Vec<BlockSpec>]) -> Vec<Attribute> {
    let attribute = |name: &str, value: &dyn Fn(&Vec<BlockSpec>) -> usize| Attribute {
        name: name.into(),
        values: blocks.iter().map(|b| value(b) as f64).collect(),
    };
    vec![
        attribute("order", &|b| b[0].1 as usize),
        attribute("blocks", &|b| b.len()),
        attribute("functions", &|b| b.iter().map(|&(_, d)| monomials(d as usize)).sum()),
    ]
}

fn field(problem: &Problem, blocks: &[Vec<BlockSpec>]) -> FieldData {
    let (name, components) = field_names(&problem.equation);
    let mut data = FieldData::new(name, components);
    data.exact = problem.exact.iter().map(|e| e.text().to_owned()).collect();
    blocks.iter().for_each(|blocks| data.push_patch(blocks));
    data
}
