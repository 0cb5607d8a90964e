//! The domain: a box minus holes.
//!
//! Holes are open sets: their rims belong to the domain, as the box's boundary does. They may
//! overlap each other and the boundary, which makes notches and quarter models. A body of any
//! outline is a box minus the outside of a polygon.
//!
//! As everywhere points are `anchor + offset`, and what the anchor has to do with a rim is formed
//! once, without cancellation: a rim in a view 10⁻¹² of the domain wide has no noise.

use crate::box_tree::BoxTree;
use crate::compensated::{arc, circle, cross};
use crate::crack::Crack;
use crate::edge::Edge;
use crate::segment;
use crate::side_index::{MANY, SideIndex, SideTree};
use crate::vec2::{Rect, Vec2, vec2};

/// Heights of all points.
pub(crate) const ALL_HEIGHTS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// A box minus holes; outside nothing is defined.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    /// The closed box.
    pub bounds: Rect,
    /// The holes cut out of it.
    pub holes: Vec<Hole>,
}

/// An open set that is cut out of the box.
#[derive(Clone, Debug, PartialEq)]
pub enum Hole {
    /// The points nearer to the centre than the radius.
    Circle {
        /// Centre.
        center: Vec2,
        /// Radius, positive.
        radius: f64,
    },
    /// One of the sides of a closed polygon, whose sides may be arcs, that does not cross itself;
    /// either orientation. Were it to cross itself, a point would be inside if a ray from it
    /// crosses the rim an odd number of times.
    Polygon {
        /// The corners, three or more, or two between arcs; the last one is joined to the first.
        points: Vec<Vec2>,
        /// The [bulge](Edge::bulge) of the side after each corner; empty if all are segments.
        bulges: Vec<f64>,
        /// The side that is cut out.
        side: PolygonSide,
        /// Finds sides where there are many. The others do not change once it was asked.
        index: SideIndex,
    },
}

/// A side of a closed polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PolygonSide {
    /// The region that the polygon encloses: a hole of the body.
    Inside,
    /// The rest of the plane: the polygon is the body's outline.
    Outside,
}

impl From<Rect> for Domain {
    /// The whole box.
    fn from(bounds: Rect) -> Self {
        Self { bounds, holes: Vec::new() }
    }
}

impl Domain {
    /// The domain as seen from an anchor. Linear in the number of rims' corners.
    #[must_use]
    pub fn at(&self, anchor: Vec2) -> LocalDomain {
        self.between(anchor, ALL_HEIGHTS)
    }

    /// The domain as seen from an anchor, as far as points from one height above the anchor to
    /// another ask for it.
    #[must_use]
    pub fn between(&self, anchor: Vec2, heights: [f64; 2]) -> LocalDomain {
        let bounds = Rect::new(self.bounds.min - anchor, self.bounds.max - anchor);
        let holes = self.holes.iter().map(|hole| hole.between(anchor, heights)).collect();
        LocalDomain { bounds, holes }
    }

    /// The index of the hole that is all outside of the body's outline, if there is one.
    #[must_use]
    pub fn outline(&self) -> Option<usize> {
        self.holes.iter().position(Hole::is_outside)
    }

    /// The box around the body: what the bounds and that of the outline have in common.
    #[must_use]
    pub fn body_bounds(&self) -> Rect {
        let outline = self.outline().map(|outline| self.holes[outline].rim_bounds());
        outline.map_or(self.bounds, |outline| outline.intersection(&self.bounds))
    }

    /// True if `p` lies in the closed box and in no hole.
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        self.bounds.contains(p) && !self.holes.iter().any(|hole| hole.contains(p))
    }
}

impl Hole {
    /// The inside of a polygon.
    #[must_use]
    pub fn polygon(points: Vec<Vec2>) -> Self {
        Self::with_arcs(points, Vec::new(), PolygonSide::Inside)
    }

    /// The outside of a polygon, which is the outline of the body.
    #[must_use]
    pub fn outside(points: Vec<Vec2>) -> Self {
        Self::with_arcs(points, Vec::new(), PolygonSide::Outside)
    }

    /// A side of a closed polygon with the bulges of its sides, empty if all are segments.
    #[must_use]
    pub fn with_arcs(points: Vec<Vec2>, bulges: Vec<f64>, side: PolygonSide) -> Self {
        Self::Polygon { points, bulges, side, index: SideIndex::default() }
    }

    /// The inside of a closed chain of edges.
    #[must_use]
    pub fn enclosed(edges: &[Edge]) -> Self {
        let Crack { mut points, bulges, .. } = Crack::along(edges);
        points.pop();
        Self::with_arcs(points, bulges, PolygonSide::Inside)
    }

    /// True if it is the outside of an outline, and not bounded.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        matches!(self, Self::Polygon { side: PolygonSide::Outside, .. })
    }

    /// The hole as seen from an anchor.
    #[must_use]
    pub fn at(&self, anchor: Vec2) -> LocalHole {
        self.between(anchor, ALL_HEIGHTS)
    }

    /// The hole seen from an anchor, as far as points from one height above the anchor to another
    /// ask for it: without the sides below and above.
    #[must_use]
    pub fn between(&self, anchor: Vec2, [low, high]: [f64; 2]) -> LocalHole {
        let meets = |edge: &Edge| {
            let [from, to] = edge.heights();
            from - anchor.y <= high && low <= to - anchor.y
        };
        LocalHole::from(match self {
            Self::Circle { center, radius } => {
                LocalRim::Circle { d: anchor - *center, excess: circle(*center, *radius, anchor) }
            }
            Self::Polygon { side, .. } => {
                // the heights, and what rounding of differences from the anchor adds
                let rounding = 4.0 * f64::EPSILON * anchor.y.abs();
                let [low, high] = [anchor.y + low - rounding, anchor.y + high + rounding];
                let level = Rect::new(vec2(-f64::INFINITY, low), vec2(f64::INFINITY, high));
                let sides = self.edges_near(&level).map(|(_, edge)| edge).filter(meets);
                let sides = sides.map(|edge| LocalSide::new(edge, anchor)).collect();
                LocalRim::Polygon(sides, *side)
            }
        })
    }

    /// True if `p` lies inside; not on the rim.
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        self.between(p, [0.0; 2]).contains(Vec2::ZERO)
    }

    /// The smallest box that holds the hole; that of the outside of a polygon is infinite.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        const FAR: Vec2 = vec2(f64::INFINITY, f64::INFINITY);
        if self.is_outside() { Rect::new(-FAR, FAR) } else { self.rim_bounds() }
    }

    /// The smallest box that holds the rim.
    #[must_use]
    pub fn rim_bounds(&self) -> Rect {
        match self {
            Self::Circle { center, radius } => Rect::around(*center, vec2(*radius, *radius)),
            Self::Polygon { .. } => {
                self.edges().fold(Rect::EMPTY, |all, edge| all.union(&edge.bounds()))
            }
        }
    }

    /// Boxes that together hold the rim, and of a bounded hole its inside.
    pub fn boxes(&self) -> impl Iterator<Item = Rect> + '_ {
        let bounded = (!self.is_outside()).then(|| self.rim_bounds());
        let edges = self.edges().filter(|_| self.is_outside());
        bounded.into_iter().chain(edges.map(|edge| edge.bounds()))
    }

    /// The sides of a polygon, in order; nothing for a circle.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let bulges: &[f64] = if let Self::Polygon { bulges, .. } = self { bulges } else { &[] };
        let bulges = bulges.iter().copied().chain(std::iter::repeat(0.0));
        self.sides().zip(bulges).map(|([from, to], bulge)| Edge { from, to, bulge })
    }

    /// The sides of a polygon with their numbers, in order, without those of many that surely do
    /// not meet a closed box.
    pub fn edges_near(&self, rect: &Rect) -> impl Iterator<Item = (usize, Edge)> + use<'_> {
        let found = self.tree().map(|tree| tree.near(rect));
        let all = found.is_none().then(|| self.edges().enumerate());
        all.into_iter().flatten().chain(found.into_iter().flatten())
    }

    /// The sides of a polygon in a search tree, if they are many.
    fn tree(&self) -> Option<&SideTree> {
        let Self::Polygon { points, index, .. } = self else { return None };
        index.of(self.edges(), points.len())
    }

    /// The edges of the rim, each from where the one before ends; a circle is two half turns.
    #[must_use]
    pub fn rim_edges(&self) -> Vec<Edge> {
        match *self {
            Self::Circle { center, radius } => {
                let [right, left] = [radius, -radius].map(|x| center + vec2(x, 0.0));
                let half = |from, to| Edge { from, to, bulge: 1.0 };
                vec![half(right, left), half(left, right)]
            }
            Self::Polygon { .. } => self.edges().collect(),
        }
    }

    /// The chords of the sides of a polygon, in order; nothing for a circle.
    pub fn sides(&self) -> impl Iterator<Item = [Vec2; 2]> + '_ {
        let points: &[Vec2] = match self {
            Self::Circle { .. } => &[],
            Self::Polygon { points, .. } => points,
        };
        segment::sides(points)
    }

    /// +1 if the hole is on the left of its sides, −1 if it is on their right; +1 for a circle.
    #[must_use]
    pub fn orientation(&self) -> f64 {
        let origin = self.rim_bounds().min;
        let area: f64 = self.edges().map(|edge| edge.area_from(origin)).sum();
        if (area < 0.0) == self.is_outside() { 1.0 } else { -1.0 }
    }

    /// Distance of `p` to the rim, on either side of it.
    #[must_use]
    pub fn rim_distance(&self, p: Vec2) -> f64 {
        match self {
            Self::Circle { center, radius } => ((p - *center).length() - radius).abs(),
            Self::Polygon { .. } => match self.tree() {
                Some(tree) => tree.distance(p),
                None => self.edges().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min),
            },
        }
    }
}

/// A domain seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalDomain {
    bounds: Rect,
    holes: Vec<LocalHole>,
}

impl LocalDomain {
    /// Returns the domain without a hole, which then belongs to it: for points that lie on the rim
    /// of the hole, wherever rounding has put them.
    #[must_use]
    pub(crate) fn without_hole(mut self, hole: Option<usize>) -> Self {
        hole.into_iter().for_each(|hole| drop(self.holes.remove(hole)));
        self
    }

    /// True if `anchor + offset` belongs to the domain; exact also where the sum would round.
    #[must_use]
    pub fn contains(&self, offset: Vec2) -> bool {
        self.bounds.contains(offset) && !self.holes.iter().any(|hole| hole.contains(offset))
    }

    /// The offset itself if its point belongs to the domain; that of a point of the domain beside
    /// it, no farther than a few times `reach`, if the point lies in a hole or outside the box by
    /// no more than `reach`; else none.
    #[must_use]
    pub fn settled(&self, offset: Vec2, reach: f64) -> Option<Vec2> {
        let inside = |p: Vec2| self.bounds.min.max(self.bounds.max.min(p));
        let clamped = inside(offset);
        if (clamped - offset).length() > 2.0 * reach {
            return None;
        }
        let out = self.holes.iter().fold(clamped, |p, hole| hole.left_by(p, reach));
        [out, inside(out)].into_iter().find(|&p| self.contains(p))
    }
}

/// A hole seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalHole {
    rim: LocalRim,
    /// The heights of the sides, if there are many.
    heights: Option<BoxTree>,
}

/// The rim of a hole seen from an anchor.
#[derive(Clone, Debug)]
pub enum LocalRim {
    /// With d = anchor − centre a point is inside if |d|² − r² + 2 d·o + o·o < 0.
    Circle {
        /// Anchor minus centre.
        d: Vec2,
        /// |d|² − r², formed without cancellation.
        excess: f64,
    },
    /// The sides in order, and on which side of them the hole is.
    Polygon(Vec<LocalSide>, PolygonSide),
}

impl From<LocalRim> for LocalHole {
    fn from(rim: LocalRim) -> Self {
        let heights = match &rim {
            LocalRim::Polygon(sides, _) if sides.len() > MANY => {
                let level = |side: &LocalSide| {
                    let [low, high] = side.heights();
                    Rect::new(vec2(-1.0, low), vec2(1.0, high))
                };
                Some(BoxTree::from(sides.iter().map(level).collect::<Vec<_>>()))
            }
            _ => None,
        };
        Self { rim, heights }
    }
}

impl LocalHole {
    /// The numbers behind it.
    #[must_use]
    pub fn rim(&self) -> &LocalRim {
        &self.rim
    }

    /// True if `anchor + offset` lies inside; not on the rim.
    #[must_use]
    pub fn contains(&self, offset: Vec2) -> bool {
        match (&self.rim, &self.heights) {
            (LocalRim::Circle { d, excess }, _) => excess + (*d * 2.0 + offset).dot(offset) < 0.0,
            (LocalRim::Polygon(sides, side), None) => is_within(sides.iter(), *side, offset),
            (LocalRim::Polygon(sides, side), Some(heights)) => {
                let (y, mut found) = (offset.y, Vec::new());
                // the boxes found are open
                let level = Rect::new(vec2(-1.0, y.next_down()), vec2(1.0, y.next_up()));
                heights.query_box(&level, &mut found);
                is_within(found.iter().map(|k| &sides[*k as usize]), *side, offset)
            }
        }
    }

    /// The hole as far as points at a height ask for it: without the sides above and below.
    #[must_use]
    pub fn at_height(&self, y: f64) -> Self {
        let meets = |side: &LocalSide| {
            let [low, high] = side.heights();
            low <= y && y <= high
        };
        Self::from(match &self.rim {
            LocalRim::Polygon(sides, side) => {
                LocalRim::Polygon(sides.iter().copied().filter(meets).collect(), *side)
            }
            round @ LocalRim::Circle { .. } => round.clone(),
        })
    }

    /// A point outside, beyond the rim by about `reach`, for one that lies inside by no more than
    /// that; else the point as it is.
    fn left_by(&self, offset: Vec2, reach: f64) -> Vec2 {
        if !self.contains(offset) {
            return offset;
        }
        match &self.rim {
            LocalRim::Circle { d, excess } => {
                let (out, value) = (*d + offset, excess + (*d * 2.0 + offset).dot(offset));
                let far = out.length();
                // |c|² − r² = (|c| − r) (|c| + r) for the point c from the centre
                let radius = (far * far - value).max(0.0).sqrt();
                let is_near = -value <= reach * (far + radius);
                if is_near { offset + out.unit() * (2.0 * reach) } else { offset }
            }
            LocalRim::Polygon(sides, _) => {
                let near = sides.iter().filter(|side| side.distance(offset) <= reach);
                let beyond = |side: &LocalSide| {
                    let (value, normal) = side.rim(offset);
                    let step = normal.unit() * (2.0 * reach);
                    offset + if value > 0.0 { -step } else { step }
                };
                near.map(beyond).find(|&p| !self.contains(p)).unwrap_or(offset)
            }
        }
    }
}

/// True if a point lies in the part of the plane that these sides bound, by those at its height.
fn is_within<'s>(
    sides: impl Iterator<Item = &'s LocalSide> + Clone,
    of: PolygonSide,
    offset: Vec2,
) -> bool {
    let crossed = sides.clone().filter(|side| side.parts(offset)).count();
    let is_in = (crossed % 2 == 1) == (of == PolygonSide::Inside);
    is_in && !sides.into_iter().any(|side| side.holds(offset))
}

/// A side of a polygon from `a` to `b`, relative to the anchor.
#[derive(Clone, Copy, Debug)]
pub struct LocalSide {
    /// Its beginning.
    pub a: Vec2,
    /// Its end.
    pub b: Vec2,
    /// From the begin to the end.
    pub direction: Vec2,
    /// direction × (anchor − a), formed without cancellation.
    pub cross: f64,
    /// The circle of an arc; the side is its chord then.
    pub arc: Option<LocalArc>,
}

/// The arc of a side: its edge relative to the anchor, and S at the anchor, formed without
/// cancellation, of which S(o) = S + g·o − 2β o·o is positive on the left of the circle.
#[derive(Clone, Copy, Debug)]
pub struct LocalArc {
    /// The arc.
    pub edge: Edge,
    /// S at the anchor.
    pub value: f64,
    /// The gradient g of S at the anchor.
    pub gradient: Vec2,
}

impl LocalArc {
    /// S and its gradient at a point.
    fn left(&self, offset: Vec2) -> (f64, Vec2) {
        let slope = self.gradient - offset * (2.0 * self.edge.bulge);
        (self.value + slope.dot(offset), slope - offset * (2.0 * self.edge.bulge))
    }

    /// True if a point lies on the arc's left, where its circle is if it turns left.
    fn is_inside(&self, offset: Vec2) -> bool {
        (self.left(offset).0 > 0.0) == (self.edge.bulge > 0.0)
    }
}

impl LocalSide {
    fn new(edge: Edge, anchor: Vec2) -> Self {
        let Edge { from, to, bulge } = edge;
        let (a, b) = (from - anchor, to - anchor);
        let arc = edge.is_arc().then(|| LocalArc {
            edge: Edge { from: a, to: b, bulge },
            value: arc(from, to, bulge, anchor),
            gradient: (to - from).left() * (1.0 - bulge * bulge) + (a + b) * (2.0 * bulge),
        });
        Self { a, b, direction: to - from, cross: cross(from, to, anchor), arc }
    }

    /// Heights between which the side surely lies.
    fn heights(&self) -> [f64; 2] {
        let chord = || Edge::segment([self.a, self.b]);
        self.arc.map_or_else(chord, |arc| arc.edge).heights()
    }

    /// Positive on the left of the chord's line.
    fn left(&self, offset: Vec2) -> f64 {
        self.cross + self.direction.cross(offset)
    }

    /// A number that is positive on the left of the side's line or circle, and its gradient.
    fn rim(&self, offset: Vec2) -> (f64, Vec2) {
        let line = (self.left(offset), self.direction.left());
        self.arc.map_or(line, |arc| arc.left(offset))
    }

    /// Distance of the point from the side.
    fn distance(&self, offset: Vec2) -> f64 {
        if let Some(arc) = self.arc {
            return arc.edge.distance(offset);
        }
        let tangent = self.direction.unit();
        let beyond = tangent.dot(self.a - offset).max(tangent.dot(offset - self.b)).max(0.0);
        beyond.hypot(self.left(offset) / self.direction.length())
    }

    /// True if the side changes whether the point is inside: if the ray from the point to the right
    /// crosses the chord, or else the point lies between chord and arc.
    fn parts(&self, offset: Vec2) -> bool {
        let (up, above) = (self.b.y > offset.y, self.a.y > offset.y);
        let left = self.left(offset);
        let crosses = up != above && up == (left > 0.0);
        // points of the chord are with those on its right, and if it is level with those above
        let is_on_right =
            left < 0.0 || (left == 0.0 && !(self.a.y == self.b.y && self.a.x < self.b.x));
        let is_between =
            |arc: LocalArc| arc.is_inside(offset) && is_on_right == (arc.edge.bulge > 0.0);
        crosses != self.arc.is_some_and(is_between)
    }

    /// True if the point lies on the side.
    fn holds(&self, offset: Vec2) -> bool {
        if let Some(arc) = self.arc {
            let is_beside = (self.left(offset) < 0.0) == (arc.edge.bulge > 0.0);
            return arc.left(offset).0 == 0.0
                && (is_beside || offset == self.a || offset == self.b);
        }
        let hull = Rect::new(self.a.min(self.b), self.a.max(self.b));
        self.left(offset) == 0.0 && hull.contains(offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;
    use std::f64::consts::TAU;

    const BOX: Rect = Rect::new(vec2(-2.0, -1.0), vec2(2.0, 1.0));

    fn polygon(points: &[[f64; 2]]) -> Hole {
        Hole::polygon(points.iter().copied().map(Vec2::from).collect())
    }

    #[test]
    fn rims_belong_to_the_domain() {
        // 3-4-5: points of the circle that f64 holds exactly.
        let round = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.625 };
        let square = polygon(&[[-1.0, -0.5], [-0.5, -0.5], [-0.5, 0.0], [-1.0, 0.0]]);
        let domain = Domain { bounds: BOX, holes: vec![round, square] };
        let on_rims = [[0.875, 0.75], [1.125, 0.25], [-1.0, -0.25], [-0.5, -0.5], [-0.75, 0.0]];
        for p in on_rims.map(Vec2::from) {
            assert!(domain.contains(p), "{p:?}");
        }
        for p in [[0.5, 0.25], [0.87, 0.74], [-0.75, -0.25], [-0.51, -0.01]].map(Vec2::from) {
            assert!(!domain.contains(p), "{p:?}");
        }
        assert!(domain.contains(vec2(2.0, 1.0)) && !domain.contains(vec2(2.1, 0.0)));
    }

    /// A star-shaped polygon, both orientations, against the sum of the angles its sides are seen
    /// under: ±2π inside, 0 outside.
    #[test]
    fn polygons_agree_with_winding_angles() {
        let corners: Vec<Vec2> = (0..9)
            .map(|k| {
                let (r, t) = ([0.9, 0.35, 0.7][k % 3], std::f64::consts::TAU * k as f64 / 9.0);
                vec2(r * t.cos(), r * t.sin())
            })
            .collect();
        let turned: Vec<Vec2> = corners.iter().rev().copied().collect();
        let holes = [corners.clone(), turned.clone()].map(Hole::polygon);
        let outsides = [corners, turned].map(Hole::outside);
        for k in 0..1600 {
            let p = vec2(f64::from(k % 40) / 20.0 - 0.983, f64::from(k / 40) / 20.0 - 0.977);
            let seen = |[a, b]: [Vec2; 2]| (a - p).cross(b - p).atan2((a - p).dot(b - p));
            for hole in &holes {
                let angle: f64 = hole.sides().map(seen).sum();
                assert_eq!(hole.contains(p), angle.abs() > 3.0, "{p:?}");
                assert_eq!(hole.at(p).at_height(0.0).contains(Vec2::ZERO), angle.abs() > 3.0);
            }
            let in_body = !holes[0].contains(p);
            assert!(outsides.iter().all(|hole| hole.contains(p) == in_body), "{p:?}");
        }
    }

    /// Along a line through the rim the boundary lies between the same two of 10⁶ steps of 10⁻¹⁸
    /// that the rational equation says: anchors are exact points of the rims.
    #[test]
    fn rims_are_sharp_at_a_width_of_1e_12() {
        let round = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.625 };
        let slanted = polygon(&[[0.0, 0.0], [0.75, 1.0], [-1.0, 1.0]]);
        // Outward directions at an exact point of each rim.
        for (hole, anchor, out) in [
            (round, vec2(0.875, 0.75), vec2(0.6, 0.8)),
            (slanted, vec2(0.375, 0.5), vec2(0.8, -0.6)),
        ] {
            let (local, across) = (hole.at(anchor), out.left());
            for k in -500..500 {
                let height = 1e-18 * f64::from(k) + 5e-19;
                for along in [-1e-12, 0.0, 3e-13] {
                    // A circle's rim falls back by s²/(2 r) beside the point: 10⁻²⁴.
                    let inside = local.contains(out * height + across * along);
                    assert_eq!(inside, height < 0.0, "{k} {along}");
                }
            }
        }
    }

    /// Rims with many sides answer as their sides one by one do.
    #[test]
    fn many_sides_are_looked_up() {
        let mut random = Random(17);
        for n in [33, 100, 1000] {
            let at = |k: usize| TAU * k as f64 / n as f64;
            let radius = |k: usize| [0.8, 0.79, 0.7][k % 3];
            let points = (0..n).map(|k| vec2(at(k).cos(), at(k).sin()) * radius(k)).collect();
            let bulges = (0..n).map(|_| random.between(-0.2, 0.2)).collect();
            let hole = Hole::with_arcs(points, bulges, PolygonSide::Inside);
            let sides: Vec<Edge> = hole.edges().collect();
            for _ in 0..300 {
                let p = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                let distances = sides.iter().map(|side| side.distance(p));
                assert_eq!(hole.rim_distance(p), distances.fold(f64::INFINITY, f64::min));
                let (anchor, heights) = (vec2(0.3, p.y + 0.1), [-0.15, -0.05]);
                assert_eq!(hole.contains(p), hole.at(p).contains(Vec2::ZERO));
                let near = hole.between(anchor, heights);
                assert_eq!(near.contains(p - anchor), hole.at(anchor).contains(p - anchor));
                let rect = Rect::around(p, vec2(0.05, 0.02));
                let near: Vec<_> = hole.edges_near(&rect).map(|(k, _)| k).collect();
                let meets = |k: &usize| !sides[*k].within(&rect).is_empty();
                assert!((0..n).filter(meets).all(|k| near.contains(&k)) && near.len() < n / 2);
            }
        }
    }

    #[test]
    fn bounds_and_distances() {
        let round = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.5 };
        assert_eq!(round.bounds(), Rect::new(vec2(0.0, -0.25), vec2(1.0, 0.75)));
        assert_eq!(round.rim_distance(vec2(0.5, 0.25)), 0.5);
        assert_eq!(round.rim_distance(vec2(2.5, 0.25)), 1.5);
        let triangle = polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangle.bounds(), Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0)));
        let outside = Hole::outside([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vec2::from).to_vec());
        assert_eq!((outside.rim_bounds(), outside.boxes().count()), (triangle.bounds(), 3));
        assert!(outside.bounds().contains(vec2(-1e300, 1e300)));
        // the corners run counter-clockwise: the triangle is on their left
        assert_eq!([&triangle, &outside].map(Hole::orientation), [1.0, -1.0]);
        assert_eq!(triangle.rim_distance(vec2(0.25, 0.125)), 0.125);
        assert_eq!(triangle.rim_distance(vec2(-3.0, -4.0)), 5.0);
    }

    /// Slots, lenses and rims of arcs that bend in and out, both ways round, beside polygons of
    /// many corners on them.
    #[test]
    fn rims_of_arcs_agree_with_polygons() {
        let mut random = Random(91);
        for case in 0..60 {
            let n = 2 + case % 5;
            let turn = random.between(0.0, TAU);
            let points: Vec<Vec2> = (0..n)
                .map(|k| {
                    let angle = turn + TAU * k as f64 / n as f64;
                    vec2(angle.cos(), angle.sin()) * random.between(0.5, 0.9)
                })
                .collect();
            let least = if n == 2 { 0.2 } else { -0.25 };
            let bulges: Vec<f64> = (0..n).map(|_| random.between(least, 0.8)).collect();
            let hole = |points, bulges| Hole::with_arcs(points, bulges, PolygonSide::Inside);
            let own = hole(points.clone(), bulges.clone());
            let mut turned = (points.clone(), bulges.iter().map(|b| -b).collect::<Vec<_>>());
            turned.0.reverse();
            turned.1.reverse();
            turned.1.rotate_left(1);
            let reversed = hole(turned.0, turned.1);
            let fine = own.edges().flat_map(|edge| edge.flattened(1e-7).split_off(1)).collect();
            let fine = Hole::polygon(fine);
            assert_eq!([own.orientation(), reversed.orientation()], [1.0, -1.0]);
            let (bounds, all) = (own.rim_bounds(), fine.rim_bounds());
            assert!((bounds.min - all.min).length() + (bounds.max - all.max).length() < 1e-6);
            for _ in 0..100 {
                let p = vec2(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
                let off = own.rim_distance(p);
                assert!((off - fine.rim_distance(p)).abs() < 2e-7);
                if off > 1e-6 {
                    let expected = fine.contains(p);
                    assert_eq!([&own, &reversed].map(|hole| hole.contains(p)), [expected; 2]);
                    assert_eq!(own.at(p).at_height(0.0).contains(Vec2::ZERO), expected);
                    let outside = Domain { bounds: BOX, holes: vec![own.clone()] };
                    let settled = outside.at(p).settled(Vec2::ZERO, 1.01 * off);
                    assert!(
                        settled.is_none_or(|o| outside.contains(p + o) && o.length() < 4.1 * off)
                    );
                }
            }
        }
    }

    /// Beside an exact point of an arc, (3, 4) of the circle of radius 5 about the origin, the rim
    /// is sharp at 10⁻¹⁸ of a view of 10⁻¹².
    #[test]
    fn arcs_are_sharp_at_a_width_of_1e_12() {
        let points = vec![vec2(5.0, 0.0), vec2(-5.0, 0.0)];
        let half = Hole::with_arcs(points, vec![1.0, 0.0], PolygonSide::Inside);
        let anchor = vec2(3.0, 4.0);
        let local = half.at(anchor);
        for k in -500..500 {
            let height = 1e-18 * f64::from(k) + 5e-19;
            for along in [-1e-12, 0.0, 3e-13] {
                let p = vec2(0.6, 0.8) * height + vec2(-0.8, 0.6) * along;
                assert_eq!(local.contains(p), height < 0.0, "{k} {along}");
            }
        }
        assert!(!half.contains(anchor) && half.contains(vec2(0.0, 1.0)));
        assert!(!half.contains(vec2(0.0, -1.0)) && !half.contains(vec2(1.0, 0.0)), "on a side");
        for (turned, end) in [1.0, -1.0].into_iter().flat_map(|turned| {
            [vec2(5.0, 0.0), vec2(0.0, 5.0), vec2(3.0, 4.0), vec2(-4.0, 3.0)]
                .map(|end| (turned, end))
        }) {
            let disc = Hole::with_arcs(vec![end, -end], vec![turned; 2], PolygonSide::Inside);
            for k in -9_i32..10 {
                let p = end * (0.125 * f64::from(k));
                assert_eq!(disc.contains(p), k.abs() < 8, "on the chord of both, {end:?} {k}");
            }
        }
    }
}
