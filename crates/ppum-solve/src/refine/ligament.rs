//! Cells in ligaments: where little material is left between a hole and an edge, another hole or a
//! crack, the body bends like a beam, and a few cells must lie across.

use super::graded::SMALLEST;
use ppum::domain::Hole;
use ppum::segment::polyline_distance;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::exceeds;
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
    Crack(&'p [Vec2]),
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
        let cracks = problem.cracks().iter().map(|crack| LigamentEnd::Crack(&crack.points));
        let all = edges.chain(others).chain(cracks);
        let mut own: Vec<_> = all
            .filter_map(|other| {
                let width = width(hole, other);
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
            Self::Crack(points) => polyline_distance(points, p),
        }
    }

    /// Points of which one is nearest to a circle or to a polygon that keeps apart, beside the
    /// polygon's own.
    fn corners(&self) -> Vec<Vec2> {
        match self {
            Self::Edge(..) | Self::Hole(Hole::Circle { .. }) => Vec::new(),
            Self::Hole(Hole::Polygon { points, .. }) => points.clone(),
            Self::Crack(points) => points.to_vec(),
        }
    }
}

/// Width of the material between a hole and something else; zero or less where they touch.
fn width(hole: &Hole, other: LigamentEnd<'_>) -> f64 {
    match (hole, other) {
        (Hole::Circle { center, radius }, LigamentEnd::Edge(edge, bounds)) => {
            edge.depth(bounds, *center) - radius
        }
        (
            Hole::Circle { center, radius },
            LigamentEnd::Hole(Hole::Circle { center: c, radius: r }),
        ) => (*c - *center).length() - radius - r,
        (Hole::Circle { center, radius }, _) => other.distance(*center) - radius,
        (Hole::Polygon { .. }, LigamentEnd::Hole(Hole::Circle { center, radius })) => {
            hole.rim_distance(*center) - radius
        }
        (Hole::Polygon { points, .. }, LigamentEnd::Edge(edge, bounds)) => {
            points.iter().map(|p| edge.depth(bounds, *p)).fold(f64::INFINITY, f64::min)
        }
        (Hole::Polygon { points, .. }, _) => {
            let there = points.iter().map(|p| other.distance(*p));
            let back = other.corners().into_iter().map(|p| hole.rim_distance(p));
            there.chain(back).fold(f64::INFINITY, f64::min)
        }
    }
}
