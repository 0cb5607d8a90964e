//! Rules on cells.

use super::arcs::{ArcRun, EdgeCuts};
use super::geometry::{KinkLine, LevelFunction, Singularity, SmoothnessGeometry};
use super::holes::PlacedHole;
use super::orders::{ActiveFunctions, Orders};
use super::polygon::{ConvexPolygon, SegmentCut, line_side};
use super::rule::{CellRule, Rules};
use super::singular::PieceQuadrature;
use super::split::TOLERANCE;
use super::{adapt, arcs, curve, holes, split};
use ppum::crack::Crack;
use ppum::dataset::BoxPartition;
use ppum::domain::Domain;
use ppum::segment::Segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::is_on_rim;
use std::cell::Cell;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Pieces smaller than this part of their cell are dropped. Slivers that have an area are kept.
const LEAST_AREA: f64 = TOLERANCE * TOLERANCE;

/// Singular points nearer than this part of a rectangle's diameter to each other count as one.
pub(super) const SAME_POINT: f64 = 1e-9;

/// A cell of a cover, and the patches whose open supports meet it; more of them do no harm.
#[derive(Clone, Copy, Debug)]
pub struct CoveredCell<'a> {
    /// The cell.
    pub rect: &'a Rect,
    /// The patches.
    pub patches: &'a [u32],
}

/// The rules of a step's cells.
#[derive(Clone)]
pub struct Quadrature<'a> {
    pub(super) geometry: SmoothnessGeometry<'a>,
    pub(super) orders: Orders,
    /// The cuts of cracks and holes.
    cuts: EdgeCuts,
    /// Segments of cracks on the boundary, which is no other part where it is a face of a crack.
    pub(super) faces: Vec<Segment>,
    pub(super) holes: Arc<[PlacedHole<'a>]>,
    /// Most divisions in one cell, or along one line through it.
    pub(super) divisions: usize,
    /// True if the weights are those of bodies of revolution, times 2πx.
    is_axisymmetric: bool,
}

/// A disc around a point at which the integrand is singular.
#[derive(Clone, Copy)]
pub struct Disc {
    /// The singular point.
    pub center: Vec2,
    /// Its radius.
    pub radius: f64,
    /// Length on which the integrand's factor of the disc varies.
    pub scale: f64,
    /// Gauss points in each direction of pieces as large as that, and at the centre.
    pub order: usize,
    /// Gauss points of pieces that are next to nothing against it, enough for what else is in
    /// the integrand.
    pub least: usize,
}

impl Disc {
    /// Makes a rule with the same number of points on all pieces.
    #[cfg(test)]
    pub(super) fn even(center: Vec2, radius: f64, order: usize) -> Self {
        Self { center, radius, scale: radius, order, least: order }
    }

    /// Gauss points of a rectangle that is at least its diameter away from singular points.
    fn order(&self, diameter: f64) -> usize {
        let more = self.order.saturating_sub(self.least) as f64 * (diameter / self.scale).min(1.0);
        self.least.min(self.order) + more.ceil() as usize
    }
}

/// The box around all cells.
fn box_around(partition: &BoxPartition) -> Option<Domain> {
    partition.cell.iter().copied().reduce(|all, cell| all.union(&cell)).map(Domain::from)
}

impl<'a> Quadrature<'a> {
    /// The quadrature for a geometry.
    #[must_use]
    pub(crate) fn new(geometry: SmoothnessGeometry<'a>, orders: Orders) -> Self {
        let (on_rims, inside): (Vec<&Crack>, Vec<&Crack>) =
            geometry.cracks.iter().partition(|c| !c.is_curved() && is_on_rim(c, geometry.holes));
        let edges = box_around(geometry.partition);
        let is_on_edge =
            |crack: &&Crack| edges.as_ref().is_some_and(|all| all.line_along(crack).is_some());
        let on_edges = inside.iter().copied().filter(is_on_edge);
        let faces = on_rims.into_iter().chain(on_edges).flat_map(|crack| crack.points.windows(2));
        let faces = faces.map(|ends| [ends[0], ends[1]]).collect();
        let cuts = EdgeCuts::new(&inside, geometry.holes);
        let holes = geometry.holes.iter().map(PlacedHole::new).collect();
        let divisions = adapt::MOST_DIVISIONS;
        Self { geometry, orders, cuts, faces, holes, divisions, is_axisymmetric: false }
    }

    /// Returns the quadrature with fewer divisions of a cell where formulas are probed.
    #[must_use]
    pub fn with_divisions(self, most: usize) -> Self {
        Self { divisions: most.min(self.divisions), ..self }
    }

    /// Returns the quadrature of the body of revolution about x = 0 if there is one: a point
    /// stands for the circle through it.
    #[must_use]
    pub(crate) fn around_axis(self, is_axisymmetric: bool) -> Self {
        Self { is_axisymmetric, ..self }
    }

    /// Multiplies the weights of points by the lengths of their circles.
    pub(super) fn revolve(&self, anchor: Vec2, offsets: &[Vec2], weights: &mut [f64]) {
        if self.is_axisymmetric {
            let points = offsets.iter().zip(weights);
            points.for_each(|(offset, weight)| *weight *= circumference(anchor + *offset));
        }
    }

    /// The rules on a cell.
    #[must_use]
    pub(crate) fn cell(&self, cell: CoveredCell<'_>) -> Vec<CellRule> {
        self.rules(cell, self.orders, None)
    }

    /// True if nothing but boundaries of patches cuts a cell, and all factors of their weights are
    /// smooth there.
    #[must_use]
    pub(crate) fn is_whole(&self, cell: CoveredCell<'_>) -> bool {
        let SmoothnessGeometry { common_kinks, common_probes, .. } = self.geometry;
        !self.is_axisymmetric
            && common_kinks.is_empty()
            && common_probes.is_empty()
            && self.geometry.is_smooth(cell.patches)
            && self.cuts_near(cell.rect).next().is_none()
            && self.runs_near(cell.rect).next().is_none()
            && !self.holes.iter().any(|hole| hole.bounds.overlaps(cell.rect))
    }

    /// The rules on the pieces of a cell that meet a disc, with more points than the disc asks for
    /// where the weight function needs them.
    ///
    /// The integrand may be singular like r⁻¹ at the disc's centre, whichever functions are active,
    /// and must vanish outside the disc: of the cell the part inside the disc's bounding square is
    /// integrated. The anchor is the centre wherever no other singular point is near.
    #[must_use]
    pub fn disc(&self, cell: CoveredCell<'_>, disc: Disc) -> Vec<CellRule> {
        let square = Rect::around(disc.center, vec2(disc.radius, disc.radius));
        let part = cell.rect.intersection(&square);
        let size = part.size();
        if size.x <= 0.0 || size.y <= 0.0 {
            return Vec::new();
        }
        let overlap = disc.order.max(self.orders.overlap);
        let orders = Orders { overlap, parts: self.orders.parts, ..Orders::uniform(disc.order) };
        self.rules(CoveredCell { rect: &part, ..cell }, orders, Some(disc))
    }

    fn rules(
        &self,
        CoveredCell { rect: cell, patches }: CoveredCell<'_>,
        orders: Orders,
        disc: Option<Disc>,
    ) -> Vec<CellRule> {
        let (segments, runs) = (self.cuts_near(cell).collect(), self.runs_near(cell).collect());
        let holes = self.holes.iter().filter(|hole| hole.bounds.overlaps(cell)).collect();
        let size = cell.size();
        let least = LEAST_AREA * size.x * size.y;
        let (rules, left) = (Rules::default(), Cell::new(self.divisions));
        let quadrature = self;
        let mut run = CellIntegration {
            quadrature,
            cell,
            orders,
            disc,
            segments,
            runs,
            holes,
            least,
            rules,
            left,
        };
        let mut sorted = patches.to_vec();
        sorted.sort_unstable();
        let partition = self.geometry.partition;
        split::rectangles(partition, orders.parts, cell, &sorted, &mut |rect, patches| {
            run.add(rect, patches);
        });
        // Nothing is left where all pieces lie in holes.
        run.rules.0.retain(|rule| !rule.offsets.is_empty());
        let mut singular: Vec<Vec2> = self.geometry.singular.iter().map(|s| s.point).collect();
        singular.extend(disc.map(|d| d.center));
        run.rules.0.iter().for_each(|rule| rule.check(&singular));
        let mut rules = run.rules.0;
        for CellRule { anchor, offsets, weights, .. } in &mut rules {
            self.revolve(*anchor, offsets, weights);
        }
        rules
    }

    /// The segments of cracks and sides of holes that meet the closed box.
    pub(super) fn cuts_near(&self, rect: &Rect) -> impl Iterator<Item = SegmentCut> {
        self.cuts.segments.iter().copied().filter(|cut| meets(rect, cut.ends[0], cut.ends[1]))
    }

    /// The arcs that may meet a box, in runs.
    pub(super) fn runs_near(&self, rect: &Rect) -> impl Iterator<Item = &ArcRun> {
        self.cuts.runs.iter().filter(|run| run.near(rect).next().is_some())
    }
}

/// The length of the circle that a point of a body of revolution stands for, 2πx.
#[must_use]
pub fn circumference(x: Vec2) -> f64 {
    TAU * x.x
}

/// True if the segment meets the closed box, up to rounding.
fn meets(rect: &Rect, a: Vec2, b: Vec2) -> bool {
    let slack = rect.size() * TOLERANCE;
    let near = Rect::new(rect.min - slack, rect.max + slack);
    near.overlaps(&Rect::new(a.min(b), a.max(b))) && {
        let side = near.corners().map(|p| line_side(a, b, p));
        !(side.iter().all(|&s| s > 0.0) || side.iter().all(|&s| s < 0.0))
    }
}

/// One cell's work.
struct CellIntegration<'a> {
    quadrature: &'a Quadrature<'a>,
    cell: &'a Rect,
    orders: Orders,
    disc: Option<Disc>,
    segments: Vec<SegmentCut>,
    runs: Vec<&'a ArcRun>,
    /// The holes whose boxes meet the cell.
    holes: Vec<&'a PlacedHole<'a>>,
    least: f64,
    rules: Rules,
    /// Divisions that are left.
    left: Cell<usize>,
}

impl CellIntegration<'_> {
    /// Adds a rectangle on which the partition functions of `patches` are smooth.
    fn add(&mut self, rect: &Rect, patches: &[u32]) {
        if self.disc.is_some_and(|d| rect.distance(d.center) >= d.radius) {
            return;
        }
        let geometry = self.quadrature.geometry;
        let runs: Vec<&ArcRun> = self.runs.iter().copied().filter(|run| run.meets(rect)).collect();
        let is_cut = !runs.is_empty() || self.cuts(rect).next().is_some();
        let mut holes = holes::near(&self.holes, rect);
        if !is_cut {
            // all of it is on one side of each rim
            holes.retain(|placed| placed.hole.contains(rect.center()));
            if holes.iter().any(|placed| placed.is_curved) {
                return;
            }
        }
        let diameter = rect.size().length();
        let mut singular = self.singular_points(rect, patches);
        let nearest = singular.first().map_or(f64::INFINITY, |s| rect.distance(s.point));
        singular.retain(|s| rect.distance(s.point) < diameter);
        let elsewhere = self.disc.map_or_else(|| self.cell.center(), |d| d.center);
        let anchor = singular.first().map_or(elsewhere, |s| s.point);

        let kinks = geometry.active_kinks(patches);
        let active = geometry.active_probes(patches);
        let levels = levels_near(&kinks, rect);
        let order = self.orders.choose(&ActiveFunctions {
            patches: patches.len(),
            distance: nearest / diameter,
            kinks: geometry.has_kinks(patches) || !levels.is_empty() || !runs.is_empty(),
            probes: !active.is_empty(),
        });
        let order = match self.disc {
            Some(disc) if nearest >= diameter && active.is_empty() => {
                order.min(disc.order(diameter).max(self.quadrature.orders.overlap))
            }
            _ => order,
        };
        let polygons = self.cut(rect, anchor, &kinks);
        // where a disc asks for fewer points, half of them are compared
        let reserve = self.orders.reserve.min(self.disc.map_or(usize::MAX, |_| order / 2));
        let orders = Orders { reserve, ..self.orders };
        let mut pieces = PieceQuadrature {
            demand: geometry.demand(&active, order, orders, (self.cell, &self.left)),
            rules: &mut self.rules,
            patches,
            least: self.least,
            levels: &levels,
            runs: &runs,
            rect,
            holes: &holes,
        };
        for polygon in polygons.into_iter().flat_map(|p| arcs::resolved(p, anchor, &runs)) {
            pieces.add(anchor, &polygon, &singular);
        }
    }

    /// The rectangle cut by the segments that meet it and by straight kinks, relative to
    /// the anchor.
    fn cut(&self, rect: &Rect, anchor: Vec2, kinks: &[&KinkLine]) -> Vec<ConvexPolygon> {
        let straight = kinks.iter().filter_map(|kink| straight_cut(kink, rect));
        let cuts: Vec<_> =
            self.cuts(rect).chain(straight).map(|cut| cut.seen_from(anchor)).collect();
        ConvexPolygon(rect.corners().map(|p| p - anchor).to_vec()).pieces(&cuts, self.least)
    }

    /// The straight cuts that meet a rectangle.
    fn cuts(&self, rect: &Rect) -> impl Iterator<Item = SegmentCut> {
        self.segments.iter().copied().filter(|cut| meets(rect, cut.ends[0], cut.ends[1]))
    }

    /// The distinct singular points, the nearest first.
    fn singular_points(&self, rect: &Rect, patches: &[u32]) -> Vec<Singularity> {
        let mut points = self.quadrature.geometry.singular_points(patches);
        points.extend(self.disc.map(|d| Singularity::tip(d.center)));
        points.sort_by(|a, b| rect.distance(a.point).total_cmp(&rect.distance(b.point)));
        distinct(points, SAME_POINT * rect.size().length())
    }
}

/// Points without those that are not apart from one before them, which takes their traits.
pub(super) fn distinct(points: Vec<Singularity>, apart: f64) -> Vec<Singularity> {
    let mut distinct: Vec<Singularity> = Vec::new();
    for p in points {
        match distinct.iter_mut().find(|q| (p.point - q.point).length() <= apart) {
            Some(known) => {
                known.growth = known.growth.and(p.growth);
                known.branches = known.branches.or(p.branches);
            }
            None => distinct.push(p),
        }
    }
    distinct
}

/// The cut of a straight kink through a rectangle, if it meets that.
pub(super) fn straight_cut(kink: &KinkLine, rect: &Rect) -> Option<SegmentCut> {
    match *kink {
        KinkLine::Line(line) => Some(SegmentCut::line(line)),
        KinkLine::Segment([a, b]) => meets(rect, a, b).then_some(SegmentCut::segment([a, b])),
        KinkLine::Curve(_) => None,
    }
}

impl KinkLine {
    /// False if it certainly stays away from a rectangle.
    pub(crate) fn may_meet(&self, rect: &Rect) -> bool {
        match self {
            Self::Line([a, b]) => {
                let side = rect.corners().map(|p| line_side(*a, *b, p));
                !(side.iter().all(|&s| s > 0.0) || side.iter().all(|&s| s < 0.0))
            }
            Self::Segment([a, b]) => meets(rect, *a, *b),
            Self::Curve(level) => curve::may_meet(level.as_ref(), rect),
        }
    }
}

/// The level functions of the curved kinks that may meet a rectangle.
fn levels_near<'k>(kinks: &[&'k KinkLine], rect: &Rect) -> Vec<&'k LevelFunction> {
    let levels = kinks.iter().filter_map(|kink| match *kink {
        KinkLine::Curve(level) => Some(level.as_ref()),
        _ => None,
    });
    levels.filter(|&level| curve::may_meet(level, rect)).collect()
}
