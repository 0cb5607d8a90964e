//! The cover of a problem, divided where it says so (`manual`), and by itself where cracks and
//! rims need it.
//!
//! - No patch holds two tips, or a tip and a kink of its crack.
//! - The cells around a tip are at most a quarter of the crack length belonging to it, and those at
//!   the tip half its clearance, and half the distance to the next interface of two materials.
//! - Cells at corners of interfaces, and where these meet the boundary or a crack, have an eighth
//!   of the size, unless the problem has functions of its own: the field is singular there.
//! - In no patch with a tip, or near it, does anything mislead the angle at the
//!   tip ([`Jumps::mislead`]).
//! - No patch is crossed twice by the rim of a polygon, down to a part of its size: it has no
//!   functions of their own for the two sides. Cracks may cross it and each other as they like, up
//!   to what [`Jumps`] can look at.
//! - Patches at singular points of known fields reach no farther than these (`KnownField`).
//! - Three cells lie across what is left between a hole and its neighbours.
//!
//! Enrichment does the rest at tips, and at corners that turn inwards between free sides: grading
//! toward them gains nothing once the singular functions are there. Other singular points, and
//! round rims and arcs of cracks, have no such functions: cells are graded towards them.

mod graded;
mod ligament;
mod manual;
mod rim;

use crate::corner::corners;
use crate::smoothness::Interfaces;
use crate::terms::{KnownField, known_fields};
use crate::watched::WorkPhase;
use graded::{GradedDemand, graded};
use ligament::{Ligament, ligaments};
use ppum::border::touch;
use ppum::cover::{Cover, CoverError};
use ppum::crack::{Crack, CrackEnd, End, TipId, tips};
use ppum::dataset::BoxPartition;
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::progress::Cancelled;
use ppum::text::trimmed;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{
    AMPLE_CLEARANCE, BoxList, Jumps, TipClearance, around, bent_part, exceeds, interface_distance,
    rim_crossings, runs_of_rim, wider,
};
use ppum_problem::{BaseCells, DEEPEST, Enrichment, Problem};
pub use rim::{coarsest, rim_error};

/// Part of a hole's size below which cells are not divided to part the sides of its rim; of an
/// outline, whose gaps are slots of the body, a smaller one.
const LEAST_GAP: f64 = 1.0 / 128.0;
const LEAST_SLOT: f64 = 1.0 / 2048.0;

/// Cells that are added without asking, for all but tips; beyond them, and four times the base
/// cover, all is resolved less finely, rims first. A dozen round holes take them at order 2, half a
/// minute on one core.
const FREE_CELLS: usize = 12_000;

/// Largest cells around a tip, in parts of the crack length belonging to it.
const LARGEST: f64 = 0.25;

/// Radius around a tip, in the same measure, within which cells are that small.
const NEAR: f64 = 0.75;

/// Cells at a tip that are not refined further for little clearance, in the same measure: tips
/// nearly at the boundary or an interface would ask for cells without end.
const SMALLEST: f64 = 1.0 / 256.0;

/// Levels by which cells are refined at singular points of interfaces. For r^λ with λ ≈ 0.8, each
/// takes two thirds of the error of the energy away.
const AT_INTERFACES: u8 = 3;

/// Lengths below this part of the domain's size are rounding of the end of a crack on a rim.
const BEYOND: f64 = 1e-8;

/// A place in a message.
fn shown(p: Vec2) -> String {
    format!("[{}, {}]", trimmed(p.x), trimmed(p.y))
}

/// The cover of a problem cannot be built.
#[derive(Debug, thiserror::Error)]
pub enum RefineError {
    /// The cover itself.
    #[error(transparent)]
    Cover(#[from] CoverError),
    /// Refinement at the tips did not end.
    #[error(
        "the cover still does not resolve the cracks around {at} after {DEEPEST} refinements; two tips, or a \
         tip and a kink, are too close together there: move them apart or start from smaller cells",
        at = shown(*.at)
    )]
    Unresolved {
        /// A place where more refinements would be needed.
        at: Vec2,
    },
    /// The size of cells that are divided by hand is none somewhere.
    #[error(
        "the `size` of [[refine]] {refinement}, counted from 0, is {value} at {at}, but must be positive and finite; \
         change the formula, e.g. add a constant",
        at = shown(*.at)
    )]
    Size {
        /// Number of the refinement.
        refinement: usize,
        /// The value.
        value: f64,
        /// The place.
        at: Vec2,
    },
    /// Cells that are divided by hand would be smaller than there may be.
    #[error(
        "the `size` of [[refine]] {refinement}, counted from 0, asks for cells smaller than {longest:.3e} around {at}, \
         which {DEEPEST} divisions of the base cells, the most there may be, do not give; give a larger size, or smaller \
         base cells",
        at = shown(*.at)
    )]
    TooFine {
        /// Number of the refinement.
        refinement: usize,
        /// The place.
        at: Vec2,
        /// Longest side of the cell there.
        longest: f64,
    },
    /// More cells than the memory holds.
    #[error(
        "the cover needs more than {most} cells, and the memory does not hold the system on them; use fewer \
         cells or a lower order, leave out cracks or what asks for small cells, or give more memory"
    )]
    TooMany {
        /// Cells that the memory holds.
        most: usize,
    },
    /// The watcher wanted the work to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The cover of a problem, divided by hand where it says so and, unless it says otherwise, by
/// itself, of at most so many cells.
pub(crate) fn cover(
    problem: &Problem,
    most: usize,
    stage: &WorkPhase<'_>,
) -> Result<Cover, RefineError> {
    let mut cover = base(problem)?;
    let cells = cover.cells();
    at_most(most, &cover)?;
    manual::divide(&mut cover, problem, most, stage)?;
    if !problem.discretization.refine {
        return Ok(cover);
    }
    let needs = TipDemands::new(problem);
    // what is divided by hand takes nothing from what the program may add
    let mut wishes = RefinementRequests::new(problem, &cells);
    wishes.most_cells += cover.n_cells() - cells.len();
    let rims = Rims::new(problem);
    let bounds = &problem.domain().bounds;
    let jumps = Jumps::new(problem.cracks(), problem.domain(), touch(bounds));
    let known = known_fields(problem);
    let must = |cell: &Rect| {
        let patch = patch_of(cell, problem);
        needs.asks(cell, &patch)
            || rims.cross_twice(&patch)
            || jumps.are_too_many(&patch.intersection(bounds))
            || needs.misleads(&patch, &jumps)
    };
    // an adaptation from coarse cells finds by itself where small ones pay; one to an accuracy
    // begins near its end
    let finds_itself = problem.adaptivity.as_ref().is_some_and(|set| set.accuracy.is_none());
    for _ in 0..DEEPEST {
        at_most(most, &cover)?;
        let affordable = !finds_itself && cover.n_cells() < wishes.most_cells;
        // who is to stop asks for nothing
        let asks = |cell: Rect, level: u8| {
            let goes_on = stage.advance(0).is_ok();
            let is_beyond = |field: &KnownField| !field.fits_in(&patch_of(&cell, problem), bounds);
            goes_on
                && (must(&cell)
                    || known.iter().any(is_beyond)
                    || affordable && wishes.asks(&cell, level))
        };
        let divided = cover.refine(asks)?;
        stage.advance(0)?;
        if divided == 0 {
            return Ok(cover);
        }
    }
    // what is only wished for may remain
    let unresolved = cover.cells().iter().map(|(cell, _)| *cell).find(must);
    unresolved.map_or(Ok(cover), |cell| Err(RefineError::Unresolved { at: cell.center() }))
}

fn at_most(most: usize, cover: &Cover) -> Result<(), RefineError> {
    if cover.n_cells() > most { Err(RefineError::TooMany { most }) } else { Ok(()) }
}

/// The needs of tips and of the mouths of cracks, and all tips.
struct TipDemands {
    needs: BoxList<TipDemand>,
    /// With the distance up to which nothing may mislead the angle.
    tips: BoxList<(TipId, Vec2, f64)>,
}

impl TipDemands {
    fn new(problem: &Problem) -> Self {
        let tip = |tip: TipId| problem.cracks()[tip.crack as usize].end_point(tip.end);
        let reach = |id: TipId| {
            let room = TipClearance::among_cracks(problem.cracks(), problem.domain(), id).radius;
            problem.enrichment_radius(id).min(0.5 * room)
        };
        let points: Vec<_> = tips(problem.cracks()).map(|id| (id, tip(id), reach(id))).collect();
        let numbered = problem.cracks().iter().enumerate();
        let cracks = BoxList::new(numbered.map(|crack| (crack.1.bounds(), crack)));
        let at_tips = tips(problem.cracks()).map(|tip| TipDemand::new(problem, &cracks, tip));
        let all = at_tips.chain(problem.cracks().iter().flat_map(|crack| mouths(crack, problem)));
        let place = |need: TipDemand| (wider(&around(&[need.tip]), need.near), need);
        Self {
            needs: BoxList::new(all.map(place)),
            tips: BoxList::new(points.into_iter().map(|t| (wider(&around(&[t.1]), t.2), t))),
        }
    }

    fn asks(&self, cell: &Rect, patch: &Rect) -> bool {
        self.needs.near(patch).any(|need| need.asks(cell, patch)) || self.holds_two_tips(patch)
    }

    fn holds_two_tips(&self, patch: &Rect) -> bool {
        self.tips.near(patch).filter(|tip| patch.contains(tip.1)).nth(1).is_some()
    }

    /// True if a patch is near a tip whose functions would jump in it beside the crack.
    fn misleads(&self, patch: &Rect, jumps: &Jumps<'_>) -> bool {
        let near = |tip: &&(TipId, Vec2, f64)| patch.distance(tip.1) <= tip.2;
        self.tips.near(patch).filter(near).any(|(id, ..)| jumps.mislead(*id, patch))
    }
}

fn patch_of(cell: &Rect, problem: &Problem) -> Rect {
    Rect::around(cell.center(), cell.size() * (0.5 * problem.discretization.overlap))
}

/// Refinement that makes solutions better, as far as it does not cost too much: cells at singular
/// points, rims, in ligaments, and at singular points of interfaces.
struct RefinementRequests<'p> {
    problem: &'p Problem,
    graded: BoxList<GradedDemand>,
    ligaments: BoxList<Ligament<'p>>,
    interfaces: Option<Interfaces<'p>>,
    /// The level of cells at singular points of interfaces.
    at_interfaces: u8,
    /// Cells from which on nothing more is wished for.
    most_cells: usize,
}

impl<'p> RefinementRequests<'p> {
    fn new(problem: &'p Problem, cells: &[(Rect, u8)]) -> Self {
        let size = cells.iter().fold(0.0f64, |m, (c, _)| m.max(c.size().x).max(c.size().y));
        let mut graded = graded(problem, &corners(problem), size);
        let mut ligaments = ligaments(problem, size);
        let budget = FREE_CELLS.max(4 * cells.len());
        let cost = |graded: &[GradedDemand], ligaments: &[Ligament<'_>]| {
            let at_points: f64 = graded.iter().map(|graded| graded.cells(size)).sum();
            at_points + ligaments.iter().map(|ligament| ligament.cells(size)).sum::<f64>()
        };
        while cost(&graded, &ligaments) > budget as f64 {
            let coarser = graded.iter_mut().map(GradedDemand::coarsen_rim).filter(|is| *is).count();
            if coarser == 0 {
                graded.iter_mut().for_each(GradedDemand::coarsen);
                ligaments.iter_mut().for_each(Ligament::coarsen);
            }
        }
        let lowest = cells.iter().map(|(_, level)| *level).min().unwrap_or(0);
        Self {
            problem,
            graded: BoxList::new(graded.into_iter().map(|graded| (graded.place(), graded))),
            ligaments: BoxList::new(ligaments.into_iter().map(|lig| (lig.place(), lig))),
            interfaces: resolves_interfaces(problem)
                .then(|| Interfaces::new(problem.constants(), problem.domain(), problem.cracks())),
            at_interfaces: lowest + AT_INTERFACES,
            most_cells: cells.len() + budget + budget / 2,
        }
    }

    fn asks(&self, cell: &Rect, level: u8) -> bool {
        let around = |reach: f64| wider(cell, reach * cell.size().x.max(cell.size().y));
        self.graded.near(&around(GradedDemand::REACH)).any(|graded| graded.asks(cell))
            || self.ligaments.near(&around(Ligament::REACH)).any(|ligament| ligament.asks(cell))
            || level < self.at_interfaces && self.at_interface(cell)
    }

    /// True if a patch holds a singular point of an interface.
    fn at_interface(&self, cell: &Rect) -> bool {
        let part = patch_of(cell, self.problem).intersection(&self.problem.domain().bounds);
        self.interfaces.as_ref().is_some_and(|all| all.unresolved(&part).is_some())
    }
}

/// True if the program resolves interfaces of materials.
pub(crate) fn resolves_interfaces(problem: &Problem) -> bool {
    let set = &problem.discretization;
    set.interfaces && set.enrichment != Enrichment::None && problem.enrichments.is_empty()
}

fn base(problem: &Problem) -> Result<Cover, CoverError> {
    match &problem.discretization.cells {
        BaseCells::Points(points) => {
            Cover::scattered(problem.domain().bounds, [1, 1], points.clone())
        }
        cells => {
            let bounds = problem.domain().bounds;
            let (roots, halvings) = cells.roots(&bounds).unwrap_or(([1, 1], 0));
            let mut cover = Cover::grid(bounds, roots)?;
            while cover.refine(|_, level| u32::from(level) < halvings)? > 0 {}
            Ok(cover)
        }
    }
}

/// Number of patches that still hold several runs of a rim: two of the parts they are cut into
/// are glued together.
pub fn n_crossed_twice(problem: &Problem, partition: &BoxPartition) -> usize {
    let rims = Rims::new(problem);
    (0..partition.len()).filter(|&patch| rims.cross_twice(&partition.support(patch))).count()
}

/// Rims of polygons, which can cross a patch twice.
struct Rims<'p> {
    domain: Rect,
    overlap: f64,
    /// Them, and sizes of cells that are not divided.
    rims: BoxList<(&'p Hole, f64)>,
}

impl<'p> Rims<'p> {
    fn new(problem: &'p Problem) -> Self {
        let polygons = problem.domain().holes.iter().filter(|hole| hole.edges().next().is_some());
        let rims = polygons.map(|hole| {
            let size = hole.rim_bounds().size();
            let part = if hole.is_outside() { LEAST_SLOT } else { LEAST_GAP };
            (hole.rim_bounds(), (hole, part * size.x.max(size.y)))
        });
        let overlap = problem.discretization.overlap;
        Self { domain: problem.domain().bounds, overlap, rims: BoxList::new(rims) }
    }

    /// True if a patch, as far as the domain reaches, holds several runs of a rim and is larger
    /// than a part of it.
    fn cross_twice(&self, patch: &Rect) -> bool {
        let size = patch.size().x.max(patch.size().y) / self.overlap;
        let inside = patch.intersection(&self.domain);
        let crosses = |hole: &Hole| runs_of_rim(hole, &inside) > 1;
        self.rims.near(patch).any(|(hole, least)| exceeds(size, *least) && crosses(hole))
    }
}

/// The demand of one tip on the cells around it.
struct TipDemand {
    tip: Vec2,
    /// Largest cells at the tip, and near it.
    largest: f64,
    ample: f64,
    /// Radius of what is near.
    near: f64,
    /// The kinks of its own crack, or what is beyond a hole.
    apart: Vec<Vec2>,
}

impl TipDemand {
    fn new(problem: &Problem, cracks: &BoxList<(usize, &Crack)>, id: TipId) -> Self {
        let crack = &problem.cracks()[id.crack as usize];
        let share = crack.length() / crack.tips().count() as f64;
        let tip = crack.end_point(id.end);
        // what is farther away asks for nothing
        let reach = AMPLE_CLEARANCE * LARGEST * share;
        let near = cracks.near(&wider(&around(&[tip]), reach)).copied();
        let clearance = TipClearance::among(near, problem.domain(), (crack, id)).radius.min(reach);
        let elastic = problem.equation.elastic();
        let apart = bent_part(crack, id.end).iter().map(|edge| edge.from).collect();
        let interface = elastic.and_then(|body| interface_distance(body, tip, clearance));
        let clearance = interface.unwrap_or(clearance);
        Self {
            tip,
            largest: (clearance / AMPLE_CLEARANCE).clamp(SMALLEST * share, LARGEST * share),
            ample: LARGEST * share,
            near: NEAR * share,
            apart,
        }
    }

    fn asks(&self, cell: &Rect, patch: &Rect) -> bool {
        let size = cell.size().x.max(cell.size().y);
        (exceeds(self.near, patch.distance(self.tip)) && exceeds(size, self.ample))
            || (patch.contains(self.tip)
                && (exceeds(size, self.largest) || self.apart.iter().any(|&p| patch.contains(p))))
    }
}

/// The demands of a crack's ends at holes: the side of the crack, which jumps on its straight
/// extension too, must not be among the functions beyond the hole.
fn mouths(crack: &Crack, problem: &Problem) -> Vec<TipDemand> {
    let ends = [End::Start, End::Last].into_iter().zip(crack.ends);
    let at_hole = ends.filter_map(|(end, kind)| {
        let p = crack.end_point(end);
        let reach = crack.growth_direction(end) * problem.domain().bounds.size().length();
        let beyond =
            (kind == CrackEnd::Mouth).then(|| behind_holes(p, reach, problem.domain()))??;
        Some(TipDemand {
            tip: p,
            largest: f64::INFINITY,
            ample: f64::INFINITY,
            near: 0.0,
            apart: vec![beyond],
        })
    });
    at_hole.collect()
}

/// The point at which the way from the end of a crack at a hole comes out of it into the body
/// again.
fn behind_holes(from: Vec2, way: Vec2, domain: &Domain) -> Option<Vec2> {
    let ray = Edge::segment([from, from + way]);
    let crossings = domain.holes.iter().flat_map(|hole| rim_crossings(ray, hole));
    let mut all: Vec<f64> = crossings.filter(|t| *t > BEYOND).collect();
    all.sort_by(f64::total_cmp);
    let out = all.into_iter().find(|t| domain.contains(from + way * (t + BEYOND)))?;
    Some(from + way * out)
}
