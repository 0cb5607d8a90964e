//! Cells in ligaments: where little material is left between a hole and an edge, another hole or a
//! crack, the body bends like a beam, and a few cells must lie across.

use super::graded::SMALLEST;
use ppum::crack::Crack;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{BoxList, exceeds, wider};
use ppum_problem::{DomainEdge, Problem};

/// Largest cells in a ligament, in parts of its width: the energy is right to 4e-4 then, with half
/// as many cells across to 4e-3.
const ACROSS: f64 = 1.0 / 3.0;

/// Ligaments below this part of the body's size are as good as broken through.
const THINNEST: f64 = 1e-4;

/// A hole and what is near it.
pub(super) struct Ligament<'p> {
    hole: &'p Hole,
    other: LigamentEnd<'p>,
    finest: f64,
}

/// Most ligaments of a hole, the narrowest ones: what is farther away lies behind others.
const MOST: usize = 16;

/// The end of a ligament.
#[derive(Clone, Copy)]
enum LigamentEnd<'p> {
    Edge(DomainEdge, &'p Rect),
    Hole(&'p Hole),
    Crack(&'p Crack),
}

/// The ligaments of a problem that ask for cells smaller than `size`.
pub(super) fn ligaments(problem: &Problem, size: f64) -> Vec<Ligament<'_>> {
    let (bounds, holes) = (&problem.domain().bounds, &problem.domain().holes);
    let plate = bounds.size();
    let thinnest = THINNEST * plate.x.min(plate.y);
    let mut found = Vec::new();
    for (k, hole) in holes.iter().enumerate() {
        // edges of the box are no boundaries where they are outside of an outline
        let edges = DomainEdge::ALL.into_iter().filter(|_| !hole.is_outside());
        let edges = edges.map(|edge| LigamentEnd::Edge(edge, bounds));
        let others = holes[..k].iter().map(LigamentEnd::Hole);
        let cracks = problem.cracks().iter().map(LigamentEnd::Crack);
        let all = edges.chain(others).chain(cracks);
        let rim = hole.rim_edges();
        let mut own: Vec<_> = all
            .filter_map(|other| {
                let width = width(&rim, other.edges(), size / ACROSS);
                let finest = (ACROSS * width).max(SMALLEST * size);
                (width > thinnest && finest < size).then_some(Ligament { hole, other, finest })
            })
            .collect();
        own.sort_by(|a, b| a.finest.total_cmp(&b.finest));
        own.truncate(MOST);
        found.extend(own);
    }
    found
}

impl Ligament<'_> {
    /// Farthest distance from a cell of a hole whose ligament asks it to be smaller, in sizes of
    /// the cell.
    pub(super) const REACH: f64 = 1.0 / ACROSS;

    /// The box of the rim.
    pub(super) fn place(&self) -> Rect {
        self.hole.rim_bounds()
    }

    /// Asks for half as fine cells.
    pub(super) fn coarsen(&mut self) {
        self.finest *= 2.0;
    }

    /// About how many cells are added to cells of a size: a few across, along where it is about
    /// as thin.
    pub(super) fn cells(&self, size: f64) -> f64 {
        let length = match self.hole {
            Hole::Circle { radius, .. } => 2.0 * (2.0 * radius * self.finest / ACROSS).sqrt(),
            Hole::Polygon { .. } => self.hole.rim_bounds().size().length(),
        };
        if self.finest < size { 2.0 * length / (ACROSS * self.finest) } else { 0.0 }
    }

    /// True if a cell is too large for what is left where it lies.
    pub(super) fn asks(&self, cell: &Rect) -> bool {
        let (size, center) = (cell.size().x.max(cell.size().y), cell.center());
        let width = self.hole.rim_distance(center) + self.other.distance(center);
        exceeds(size, self.finest) && exceeds(size, ACROSS * width)
    }
}

impl LigamentEnd<'_> {
    fn distance(&self, p: Vec2) -> f64 {
        match *self {
            Self::Edge(edge, bounds) => edge.depth(bounds, p).abs(),
            Self::Hole(hole) => hole.rim_distance(p),
            Self::Crack(crack) => crack.distance(p),
        }
    }

    fn edges(&self) -> Vec<Edge> {
        match *self {
            Self::Edge(edge, bounds) => {
                vec![Edge::segment(edge.range(bounds).map(|s| edge.point(bounds, s)))]
            }
            Self::Hole(hole) => hole.rim_edges(),
            Self::Crack(crack) => crack.edges().collect(),
        }
    }
}

/// Width of the material between a rim and other edges, zero where they touch; ∞ if it is more than
/// `reach`.
fn width(rim: &[Edge], others: Vec<Edge>, reach: f64) -> f64 {
    let others = BoxList::new(others.into_iter().map(|edge| (edge.bounds(), edge)));
    let near = |edge: &Edge| {
        let near = others.near(&wider(&edge.bounds(), reach));
        near.map(|other| edge.gap(other)).fold(f64::INFINITY, f64::min)
    };
    rim.iter().map(near).fold(f64::INFINITY, f64::min)
}
