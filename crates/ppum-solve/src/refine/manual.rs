//! Cells divided where a problem says so, whatever else it leaves to the program.

use super::{RefineError, at_most};
use crate::watched::WorkPhase;
use ppum::cover::Cover;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::{BoxList, distance, wider};
use ppum_problem::{DEEPEST, LocalRefinement, Problem, RefinementRegion, nine};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Rounding of sizes: a cell of 0.1 is not larger than 0.1.
const ROUNDING: f64 = 1e-9;

/// Divides the cells of a cover as the problem's refinements say, to at most so many.
pub(super) fn divide(
    cover: &mut Cover,
    problem: &Problem,
    most: usize,
    stage: &WorkPhase<'_>,
) -> Result<(), RefineError> {
    if problem.refinements.is_empty() {
        return Ok(());
    }
    let demands = demands(problem);
    for _ in 0..DEEPEST {
        let mut wrong = None;
        let divided = cover.refine(|cell, _| {
            let goes_on = wrong.is_none() && stage.advance(0).is_ok();
            goes_on
                && any_asks(&demands, &cell).unwrap_or_else(|error| {
                    wrong = Some(error);
                    false
                })
        })?;
        stage.advance(0)?;
        match wrong {
            Some(error) => return Err(error),
            None if divided == 0 => return Ok(()),
            None => at_most(most, cover)?,
        }
    }
    too_fine(&demands, cover).map_or(Ok(()), Err)
}

fn any_asks(demands: &BoxList<ManualRefinement<'_>>, cell: &Rect) -> Result<bool, RefineError> {
    for demand in demands.near(cell) {
        if demand.asks(cell)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The first cell that should be smaller still.
fn too_fine(demands: &BoxList<ManualRefinement<'_>>, cover: &Cover) -> Option<RefineError> {
    let asks = |cell: &Rect| {
        let mut near = demands.near(cell);
        near.find(|demand| demand.asks(cell).unwrap_or(false)).map(|demand| demand.index)
    };
    cover.cells().iter().find_map(|(cell, _)| {
        let (refinement, at) = (asks(cell)?, cell.center());
        Some(RefineError::TooFine { refinement, at, longest: longest(cell) })
    })
}

fn longest(cell: &Rect) -> f64 {
    cell.size().x.max(cell.size().y)
}

/// One refinement and its place.
struct ManualRefinement<'p> {
    index: usize,
    refinement: &'p LocalRefinement,
    /// The box around all that it divides.
    bounds: Rect,
    lines: DistanceOrigin<'p>,
}

/// The object that distances are measured from.
enum DistanceOrigin<'p> {
    Plate,
    Box(Rect),
    Disc(Vec2, f64),
    Rim(&'p Hole, PlacedEdges),
    Crack(PlacedEdges),
}

/// The edges of a rim or a crack, shared by all that name it.
type PlacedEdges = Rc<BoxList<Edge>>;

fn demands(problem: &Problem) -> BoxList<ManualRefinement<'_>> {
    let mut known: BTreeMap<(bool, usize), PlacedEdges> = BTreeMap::new();
    let mut sides = |is_hole: bool, index: usize| {
        let all: &dyn Fn() -> PlacedEdges = &|| match is_hole {
            true => placed(problem.domain().holes[index].edges()),
            false => placed(problem.cracks()[index].edges()),
        };
        known.entry((is_hole, index)).or_insert_with(all).clone()
    };
    let demand = |(index, refinement): (usize, &'_ LocalRefinement)| {
        let lines = match refinement.place {
            RefinementRegion::Plate => DistanceOrigin::Plate,
            RefinementRegion::Box(rect) => DistanceOrigin::Box(rect),
            RefinementRegion::Disc { center, radius } => DistanceOrigin::Disc(center, radius),
            RefinementRegion::Hole(hole) => {
                DistanceOrigin::Rim(&problem.domain().holes[hole], sides(true, hole))
            }
            RefinementRegion::Crack(crack) => DistanceOrigin::Crack(sides(false, crack)),
        };
        let bounds = refinement.bounds(problem.domain(), problem.cracks());
        (bounds, (index, bounds, lines))
    };
    let all: Vec<_> = problem.refinements.iter().enumerate().map(demand).collect();
    BoxList::new(all.into_iter().map(|(rect, (index, bounds, lines))| {
        (rect, ManualRefinement { index, refinement: &problem.refinements[index], bounds, lines })
    }))
}

fn placed(all: impl Iterator<Item = Edge>) -> PlacedEdges {
    Rc::new(BoxList::new(all.map(|edge| (edge.bounds(), edge))))
}

impl ManualRefinement<'_> {
    /// True if a cell is too large.
    fn asks(&self, cell: &Rect) -> Result<bool, RefineError> {
        let longest = longest(cell) * (1.0 - ROUNDING);
        if self.refinement.size.constant().is_some_and(|size| longest <= size) || !self.meets(cell)
        {
            return Ok(false);
        }
        let mut smallest = f64::INFINITY;
        for at in nine(&cell.intersection(&self.bounds)) {
            let wrong = |value| RefineError::Size { refinement: self.index, value, at };
            smallest = smallest.min(self.refinement.size_at(at).map_err(wrong)?);
        }
        Ok(longest > smallest)
    }

    /// True if a cell meets the place, or is nearer to it than said.
    fn meets(&self, cell: &Rect) -> bool {
        let reach = self.refinement.distance;
        match &self.lines {
            DistanceOrigin::Plate => true,
            DistanceOrigin::Box(rect) => rect.overlaps(cell) || gap(rect, cell) < reach,
            DistanceOrigin::Disc(center, radius) => cell.distance(*center) < radius + reach,
            DistanceOrigin::Rim(Hole::Circle { center, radius }, _) => {
                let away = cell.center() - *center;
                let farthest = vec2(away.x.abs(), away.y.abs()) + cell.size() * 0.5;
                // what lies in the hole is dropped
                farthest.length() >= *radius && cell.distance(*center) <= radius + reach
            }
            DistanceOrigin::Rim(hole, sides) => {
                near(sides, cell, reach)
                    && (near(sides, cell, 0.0) || !hole.contains(cell.center()))
            }
            DistanceOrigin::Crack(sides) => near(sides, cell, reach),
        }
    }
}

/// True if one of the edges is no farther from a cell; what touches it up to rounding does.
fn near(sides: &PlacedEdges, cell: &Rect, reach: f64) -> bool {
    let reach = reach + ROUNDING * longest(cell);
    sides.near(&wider(cell, reach)).any(|side| distance(*side, cell) <= reach)
}

/// Distance of two boxes.
fn gap(a: &Rect, b: &Rect) -> f64 {
    let apart = (a.min - b.max).max(b.min - a.max).max(Vec2::ZERO);
    apart.length()
}
