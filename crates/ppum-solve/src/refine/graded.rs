//! Cells that shrink towards what polynomials see badly: singular points of the boundary, and round
//! rims. Corners with functions ask for a few small cells that leave these the room they need.
//!
//! A cell at a distance d is at most slope · d large, down to a finest size. At a singular point u
//! ~ r^λ the energy that cells of size h miss is C (1 − λ) (h/R)^{2λ} of that of the surroundings,
//! R away from the nearest other feature: it vanishes with the singularity. The remaining error
//! comes from the rings of cells, the same part from each, and does not depend on the finest size.

use super::rim::{FOR_ENERGY, RimCorner, bends, finest};
use crate::corner::{SingularCause, SingularCorner};
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::Problem;
use ppum_problem::geometry::{around, distance, exceeds, wider};
use std::collections::BTreeSet;

/// Part of the energy around a singular point that its cells may miss.
const MISSED: f64 = 1e-4;

/// Largest cells at a distance, in parts of it.
const SLOPE: f64 = 1.0;

/// That ratio where a restraint ends within an edge and the exponent is below [`STRONG`]: reactions
/// concentrate there, and the energy with them.
const STEEP: f64 = 0.35;

/// Exponents of a restraint below this one are near 1/2.
const STRONG: f64 = 0.6;

/// Radius around a corner with functions within which cells are small, and their size, in parts of
/// the corner's room: most of the patches in the room then have the functions.
const WITH_FUNCTIONS: f64 = 0.5;
const CELLS_OF_FUNCTIONS: f64 = 0.25;

/// Largest cells on an arc of a crack, in its radii. Continued across the arc, the field on one
/// side of it is singular at the centre, so that polynomials of order p leave (h/R)^p: an arc of
/// 170° has K to 6e-8 in cells of 0.2 radii and to 4e-10 in cells of 0.1, at order 6.
const ON_CRACK: f64 = 0.125;

/// Smallest cells that are asked for, in parts of the base cover's: what is smaller is
/// not resolved.
pub(super) const SMALLEST: f64 = 1.0 / 16_384.0;

/// Cells of a ring around a point, at slope 1.
const RING: f64 = 12.0;

/// Cells along a rim, times their size over its length: two to three layers, and what they take to
/// the size of the others. Rims in cells of 1/4 to 20 radii had 5 to 8.
const ON_RIM: f64 = 8.0;

/// Step by which rims are coarsened: less than the factor of two between cells, as they are of
/// different radii.
const STEP: f64 = 1.25;

/// The demand of one point or rim on the cells.
pub(super) struct GradedDemand {
    from: GradedShape,
    /// Size below which cells stay as they are.
    finest: f64,
    /// Largest size over distance.
    slope: f64,
}

enum GradedShape {
    Point(Vec2),
    Circle(Vec2, f64),
    Bend(RimCorner),
    Arc(Edge),
}

/// The demands of the singular points, the round rims and the arcs of cracks of a problem on a base
/// cover with cells of the given size.
pub(super) fn graded(
    problem: &Problem,
    corners: &[SingularCorner],
    size: f64,
) -> Vec<GradedDemand> {
    let plate = problem.domain().bounds.size();
    let bits = |p: Vec2| [p.x.to_bits(), p.y.to_bits()];
    let rims = problem.domain().holes.iter();
    let on_curves: BTreeSet<_> =
        rims.flat_map(|hole| bends(hole, 1.0)).map(|bend| bits(bend.at)).collect();
    // what follows a curve has its radius, and is no corner; what is given may end there
    let sharp = corners.iter().filter(|corner| {
        corner.nature != SingularCause::Corner || !on_curves.contains(&bits(corner.at))
    });
    let at_corners = sharp.filter_map(|c| GradedDemand::corner(c, plate.x.min(plate.y)));
    let rims = problem.domain().holes.iter().flat_map(|hole| GradedDemand::rim(hole, problem));
    let arcs = problem.cracks().iter().flat_map(|crack| crack.edges().filter(Edge::is_arc));
    let mut all: Vec<_> = at_corners.chain(rims).chain(arcs.map(GradedDemand::on_arc)).collect();
    all.iter_mut().for_each(|graded| graded.finest = graded.finest.max(SMALLEST * size));
    all
}

impl GradedDemand {
    /// The demand of a singular point on a body of the given size; none where it is gentle.
    fn corner(corner: &SingularCorner, plate: f64) -> Option<Self> {
        let SingularCorner { at, exponent, room, nature, .. } = *corner;
        // cells of any size see the same of a field of infinite energy
        if corner.is_gentle() || nature == SingularCause::Jump {
            return None;
        }
        if corner.wedge.is_some() {
            let from = GradedShape::Circle(at, WITH_FUNCTIONS * room);
            return Some(Self { from, finest: CELLS_OF_FUNCTIONS * room, slope: SLOPE });
        }
        // a small room holds a small part of the energy
        let missed = MISSED * plate / (room * corner.weakness());
        let finest = room * missed.powf(0.5 / exponent).min(1.0);
        let is_steep = nature == SingularCause::Support && exponent < STRONG;
        let slope = if is_steep { STEEP } else { SLOPE };
        Some(Self { from: GradedShape::Point(at), finest, slope })
    }

    /// The demands of the rim of a hole where it is curved.
    fn rim(hole: &Hole, problem: &Problem) -> Vec<Self> {
        let part = finest(&problem.discretization.order, &hole.rim_bounds());
        let of = |from, radius: f64| Self { from, finest: part * radius, slope: SLOPE };
        match *hole {
            Hole::Circle { center, radius } => {
                vec![of(GradedShape::Circle(center, radius), radius)]
            }
            Hole::Polygon { .. } => {
                let all = bends(hole, part).into_iter();
                all.map(|bend| of(GradedShape::Bend(bend), bend.radius)).collect()
            }
        }
    }

    /// The demand of an arc of a crack.
    fn on_arc(arc: Edge) -> Self {
        let finest = ON_CRACK / arc.curvature().abs();
        Self { from: GradedShape::Arc(arc), finest, slope: SLOPE }
    }

    /// Farthest distance from a cell of something that asks it to be smaller, in sizes of the cell.
    pub(super) const REACH: f64 = 1.0 / STEEP;

    /// The box of what cells are graded towards.
    pub(super) fn place(&self) -> Rect {
        match self.from {
            GradedShape::Point(p) | GradedShape::Bend(RimCorner { at: p, .. }) => around(&[p]),
            GradedShape::Circle(center, radius) => wider(&around(&[center]), radius),
            GradedShape::Arc(arc) => arc.bounds(),
        }
    }

    /// True if a cell is too large.
    pub(super) fn asks(&self, cell: &Rect) -> bool {
        let size = cell.size().x.max(cell.size().y);
        exceeds(size, self.finest) && exceeds(size, self.slope * self.from.distance(cell))
    }

    /// Asks for half as fine cells.
    pub(super) fn coarsen(&mut self) {
        self.finest *= 2.0;
    }

    /// Asks for coarser cells at a rim, as far as its energy bears them; false if it bears no
    /// coarser ones.
    pub(super) fn coarsen_rim(&mut self) -> bool {
        let radius = match self.from {
            GradedShape::Point(_) => return false,
            GradedShape::Circle(_, radius) | GradedShape::Bend(RimCorner { radius, .. }) => radius,
            GradedShape::Arc(arc) => arc.curvature().abs().recip(),
        };
        let is_finer = self.finest * STEP <= FOR_ENERGY * radius;
        self.finest *= if is_finer { STEP } else { 1.0 };
        is_finer
    }

    /// About how many cells are added to cells of a size.
    pub(super) fn cells(&self, size: f64) -> f64 {
        let rings = (size / self.finest).log2().max(0.0);
        let length = match self.from {
            _ if rings == 0.0 => 0.0,
            GradedShape::Point(_) => return RING * rings / (self.slope * self.slope),
            GradedShape::Circle(_, radius) => std::f64::consts::TAU * radius,
            GradedShape::Bend(bend) => bend.length,
            GradedShape::Arc(arc) => arc.length(),
        };
        ON_RIM * length / self.finest
    }
}

impl GradedShape {
    fn distance(&self, cell: &Rect) -> f64 {
        match *self {
            Self::Point(p) | Self::Bend(RimCorner { at: p, .. }) => cell.distance(p),
            Self::Arc(arc) => distance(arc, cell),
            Self::Circle(center, radius) => {
                let away = cell.center() - center;
                let farthest = vec2(away.x.abs(), away.y.abs()) + cell.size() * 0.5;
                (cell.distance(center) - radius).max(radius - farthest.length()).max(0.0)
            }
        }
    }
}
