//! Quadrature: where the solver looks at the fields.
//!
//! The leaf cells of a cover tile the domain. [`Quadrature::cell`] divides a cell into pieces on
//! which all integrands of the method are smooth and gives each a Gauss rule:
//!
//! 1. rectangles with a constant set of covering patches;
//! 2. cut at kinks of the partition functions, where these do not cancel;
//! 3. cut by the lines of the crack segments that meet the rectangle, extended through it (harmless,
//!    and all pieces are convex and on one side of each segment);
//! 4. near a tip whose functions are active, triangles with their apex at the tip and a rule for
//!    r^{k/2} g(θ), k ≥ −2, and bisection of pieces that are closer to it than their diameter.
//!
//! Points are an anchor plus offsets. Near a singular point the anchor is that point itself, so that
//! the distance to it carries no rounding of the coordinates. [`Quadrature::edge`] does the same along
//! segments, [`Quadrature::disc`] for the domain integrals of stress intensity.
//!
//! Nothing here knows fields or basis functions.

mod edge;
mod gauss;
mod polygon;
mod singular;
mod split;
#[cfg(test)]
mod tests;

pub use edge::EdgeRule;
pub use gauss::{GaussRule, MAX_POINTS, gauss};

use polygon::{Polygon, line_side};
use ppum::crack::Crack;
use ppum::dataset::Partition;
use ppum::vec2::{Rect, Vec2, vec2};
use singular::Pieces;

/// Lengths below this part of a cell are rounding.
const TOLERANCE: f64 = 1e-12;

/// Pieces smaller than this part of their cell are dropped. Slivers that have an area are kept.
const LEAST_AREA: f64 = 1e-24;

/// Singular points nearer than this part of a rectangle's diameter to each other count as one.
const SAME_POINT: f64 = 1e-9;

/// Rectangles farther from a singular point than this many diameters do not feel it: n Gauss points
/// then err by about 18^(−2n).
const FAR: f64 = 4.0;

/// What decides where integrands are smooth.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'a> {
    /// The partition of unity.
    pub partition: &'a Partition,
    /// The cracks: across their segments functions may jump.
    pub cracks: &'a [Crack],
    /// Points at which functions are singular: the tips, usually.
    pub singular: &'a [Vec2],
    /// Of each patch, the points (indices into `singular`) at which one of its functions is
    /// singular, be the point inside the patch or not.
    pub patch_singular: &'a [Vec<u32>],
}

impl Geometry<'_> {
    /// The distinct points at which a function of one of these patches is singular.
    fn singular_points(&self, patches: &[u32]) -> Vec<Vec2> {
        let mut indices: Vec<u32> =
            patches.iter().flat_map(|&p| &self.patch_singular[p as usize]).copied().collect();
        indices.sort_unstable();
        indices.dedup();
        indices.iter().map(|&i| self.singular[i as usize]).collect()
    }
}

/// Numbers of Gauss points in each direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Orders {
    /// Where several patches overlap.
    pub overlap: usize,
    /// Where one patch is alone, φ = 1, and the integrand a polynomial.
    pub flat: usize,
    /// Near points where a function is singular.
    pub singular: usize,
}

impl Orders {
    /// The default for polynomials of degree p: p + 4, p + 1 and max(p + 5, 8), which keep the
    /// quadrature's share of the energy below 1e-8. A product of two polynomials is exact where one
    /// patch is alone, cracks or not.
    #[must_use]
    pub const fn for_degree(p: usize) -> Self {
        let singular = if p + 5 > 8 { p + 5 } else { 8 };
        Self { overlap: p + 4, flat: p + 1, singular }
    }

    /// The same number everywhere.
    #[must_use]
    pub const fn uniform(n: usize) -> Self {
        Self { overlap: n, flat: n, singular: n }
    }

    /// The number for a piece covered by `patches` patches, whose distance to the nearest singular
    /// point is `distance` times its size (infinite if no function is singular).
    fn choose(self, patches: usize, distance: f64) -> usize {
        if distance < FAR {
            self.singular
        } else if distance < f64::INFINITY {
            self.overlap.max(self.flat)
        } else if patches == 1 {
            self.flat
        } else {
            self.overlap
        }
    }
}

/// A rule on a part of a cell on which one set of patches is active.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// What the offsets are measured from: a singular point near it, else the centre of the cell.
    pub anchor: Vec2,
    /// Points, relative to the anchor; inside the part, never on its border or on a crack.
    pub offsets: Vec<Vec2>,
    /// Quadrature weights, positive; they sum to the area.
    pub weights: Vec<f64>,
    /// The patches whose open supports hold the points, ascending.
    pub patches: Vec<u32>,
}

impl Rule {
    /// Adds a point. Weights that rounding leaves without area are dropped.
    fn push(&mut self, offset: Vec2, weight: f64) {
        if weight > 0.0 {
            self.offsets.push(offset);
            self.weights.push(weight);
        }
    }

    /// Holds what every user relies on.
    fn check(&self, singular: &[Vec2]) {
        let finite = self.offsets.iter().all(|x| x.is_finite())
            && self.weights.iter().all(|w| w.is_finite());
        assert!(finite, "quadrature points must be finite");
        let at_point = singular.contains(&self.anchor) && self.offsets.contains(&Vec2::ZERO);
        assert!(!at_point, "a quadrature point lies on the singular point {:?}", self.anchor);
    }
}

/// The rules of a cell, one for each set of patches and anchor.
#[derive(Default)]
struct Rules(Vec<Rule>);

impl Rules {
    fn rule(&mut self, patches: &[u32], anchor: Vec2) -> &mut Rule {
        let same = |r: &Rule| r.anchor == anchor && r.patches == patches;
        let at = self.0.iter().position(same).unwrap_or_else(|| {
            let (offsets, weights) = (Vec::new(), Vec::new());
            self.0.push(Rule { anchor, offsets, weights, patches: patches.to_vec() });
            self.0.len() - 1
        });
        &mut self.0[at]
    }
}

/// The rules of a step's cells.
#[derive(Clone, Debug)]
pub struct Quadrature<'a> {
    geometry: Geometry<'a>,
    orders: Orders,
    segments: Vec<[Vec2; 2]>,
}

/// A disc around a point at which the integrand is singular.
#[derive(Clone, Copy)]
struct Disc {
    center: Vec2,
    radius: f64,
}

impl<'a> Quadrature<'a> {
    /// The quadrature for a geometry.
    #[must_use]
    pub fn new(geometry: Geometry<'a>, orders: Orders) -> Self {
        let of_crack = |c: &Crack| c.points.windows(2).map(|s| [s[0], s[1]]).collect::<Vec<_>>();
        let segments = geometry.cracks.iter().flat_map(of_crack).collect();
        Self { geometry, orders, segments }
    }

    /// The rules on a cell. `coverers` are the patches whose open supports meet the cell; more of
    /// them do no harm.
    #[must_use]
    pub fn cell(&self, cell: &Rect, coverers: &[u32]) -> Vec<Rule> {
        self.rules(cell, coverers, self.orders, None)
    }

    /// The rules on the pieces of a cell that meet a disc, with `order` points in each direction.
    ///
    /// The integrand may be singular like r⁻¹ at the disc's `center`, whichever functions are active,
    /// and must vanish outside the disc: of the cell the part inside the disc's bounding square is
    /// integrated. The anchor is the centre wherever no other singular point is near.
    #[must_use]
    pub fn disc(
        &self,
        cell: &Rect,
        coverers: &[u32],
        center: Vec2,
        radius: f64,
        order: usize,
    ) -> Vec<Rule> {
        let part = cell.intersection(&Rect::around(center, vec2(radius, radius)));
        let size = part.size();
        if size.x <= 0.0 || size.y <= 0.0 {
            return Vec::new();
        }
        self.rules(&part, coverers, Orders::uniform(order), Some(Disc { center, radius }))
    }

    fn rules(
        &self,
        cell: &Rect,
        coverers: &[u32],
        orders: Orders,
        disc: Option<Disc>,
    ) -> Vec<Rule> {
        let segments = self.segments_near(cell).collect();
        let size = cell.size();
        let least = LEAST_AREA * size.x * size.y;
        let rules = Rules::default();
        let mut run = Run { quadrature: self, cell, orders, disc, segments, least, rules };
        let mut sorted = coverers.to_vec();
        sorted.sort_unstable();
        split::rectangles(self.geometry.partition, cell, &sorted, &mut |rect, patches| {
            run.add(rect, patches);
        });
        let mut singular = self.geometry.singular.to_vec();
        singular.extend(disc.map(|d| d.center));
        run.rules.0.iter().for_each(|rule| rule.check(&singular));
        run.rules.0
    }

    /// The crack segments that meet the closed box.
    fn segments_near(&self, rect: &Rect) -> impl Iterator<Item = [Vec2; 2]> {
        self.segments.iter().copied().filter(|&[a, b]| meets(rect, a, b))
    }
}

/// True if the segment meets the closed box, up to rounding.
fn meets(rect: &Rect, a: Vec2, b: Vec2) -> bool {
    let slack = rect.size() * TOLERANCE;
    let near = Rect::new(rect.min - slack, rect.max + slack);
    near.overlaps(&Rect::new(a.min(b), a.max(b))) && {
        let side = corners(&near).map(|p| line_side(a, b, p));
        !(side.iter().all(|&s| s > 0.0) || side.iter().all(|&s| s < 0.0))
    }
}

/// Corners in counter-clockwise order.
fn corners(rect: &Rect) -> [Vec2; 4] {
    let (min, max) = (rect.min, rect.max);
    [min, vec2(max.x, min.y), max, vec2(min.x, max.y)]
}

/// One cell's work.
struct Run<'a> {
    quadrature: &'a Quadrature<'a>,
    cell: &'a Rect,
    orders: Orders,
    disc: Option<Disc>,
    segments: Vec<[Vec2; 2]>,
    least: f64,
    rules: Rules,
}

impl Run<'_> {
    /// Adds a rectangle on which the partition functions of `patches` are smooth.
    fn add(&mut self, rect: &Rect, patches: &[u32]) {
        if self.disc.is_some_and(|d| rect.distance(d.center) >= d.radius) {
            return;
        }
        let diameter = rect.size().length();
        let mut singular = self.singular_points(rect, patches);
        let distance = singular.first().map_or(f64::INFINITY, |&p| rect.distance(p)) / diameter;
        singular.retain(|&p| rect.distance(p) < diameter);
        let elsewhere = self.disc.map_or_else(|| self.cell.center(), |d| d.center);
        let anchor = singular.first().copied().unwrap_or(elsewhere);

        let order = self.orders.choose(patches.len(), distance);
        let polygons = self.cut(rect, anchor);
        let mut pieces = Pieces { rules: &mut self.rules, patches, order, least: self.least };
        for polygon in polygons {
            pieces.add(anchor, &polygon, &singular);
        }
    }

    /// The rectangle cut by the lines of the crack segments that meet it, relative to the anchor.
    fn cut(&self, rect: &Rect, anchor: Vec2) -> Vec<Polygon> {
        let meeting = self.segments.iter().filter(|[a, b]| meets(rect, *a, *b));
        let segments: Vec<_> = meeting.map(|s| s.map(|p| p - anchor)).collect();
        Polygon(corners(rect).map(|p| p - anchor).to_vec()).pieces(&segments, self.least)
    }

    /// The distinct singular points, the nearest first.
    fn singular_points(&self, rect: &Rect, patches: &[u32]) -> Vec<Vec2> {
        let mut points = self.quadrature.geometry.singular_points(patches);
        points.extend(self.disc.map(|d| d.center));
        points.sort_by(|&a, &b| rect.distance(a).total_cmp(&rect.distance(b)));
        let apart = SAME_POINT * rect.size().length();
        let mut distinct: Vec<Vec2> = Vec::new();
        for p in points {
            if distinct.iter().all(|&q| (p - q).length() > apart) {
                distinct.push(p);
            }
        }
        distinct
    }
}
