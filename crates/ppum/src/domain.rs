//! The domain: a box minus holes.
//!
//! Holes are open sets: their rims belong to the domain, as the box's boundary does. They may
//! overlap each other and the boundary, which makes notches and quarter models. A body of any
//! outline is a box minus the outside of a polygon.
//!
//! As everywhere points are `anchor + offset`, and what the anchor has to do with a rim is formed
//! once, without cancellation: a rim in a view 10⁻¹² of the domain wide has no noise.

use crate::compensated::{circle, cross};
use crate::segment;
use crate::vec2::{Rect, Vec2, vec2};

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
    /// One of the sides of a closed polygon that does not cross itself; either orientation. Were it
    /// to cross itself, a point would be inside if a ray from it crosses the rim an odd number
    /// of times.
    Polygon {
        /// The corners, three or more; the last one is joined to the first.
        points: Vec<Vec2>,
        /// The side that is cut out.
        side: PolygonSide,
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
        let bounds = Rect::new(self.bounds.min - anchor, self.bounds.max - anchor);
        LocalDomain { bounds, holes: self.holes.iter().map(|hole| hole.at(anchor)).collect() }
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
        Self::Polygon { points, side: PolygonSide::Inside }
    }

    /// The outside of a polygon, which is the outline of the body.
    #[must_use]
    pub fn outside(points: Vec<Vec2>) -> Self {
        Self::Polygon { points, side: PolygonSide::Outside }
    }

    /// True if it is the outside of an outline, and not bounded.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        matches!(self, Self::Polygon { side: PolygonSide::Outside, .. })
    }

    /// The hole as seen from an anchor.
    #[must_use]
    pub fn at(&self, anchor: Vec2) -> LocalHole {
        LocalHole(match self {
            Self::Circle { center, radius } => {
                LocalRim::Circle { d: anchor - *center, excess: circle(*center, *radius, anchor) }
            }
            Self::Polygon { side, .. } => LocalRim::Polygon(
                self.sides().map(|[a, b]| LocalSide::new(a, b, anchor)).collect(),
                *side,
            ),
        })
    }

    /// True if `p` lies inside; not on the rim.
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        self.at(p).contains(Vec2::ZERO)
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
            Self::Polygon { points, .. } => {
                points.iter().fold(Rect::EMPTY, |all, &p| all.union(&Rect::new(p, p)))
            }
        }
    }

    /// Boxes that together hold the rim, and of a bounded hole its inside.
    pub fn boxes(&self) -> impl Iterator<Item = Rect> + '_ {
        let bounded = (!self.is_outside()).then(|| self.rim_bounds());
        let sides = self.sides().filter(|_| self.is_outside());
        bounded.into_iter().chain(sides.map(|[a, b]| Rect::new(a.min(b), a.max(b))))
    }

    /// The sides of a polygon, in order; nothing for a circle.
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
        let twice: f64 = self.sides().map(|[a, b]| (a - origin).cross(b - origin)).sum();
        if (twice < 0.0) == self.is_outside() { 1.0 } else { -1.0 }
    }

    /// Distance of `p` to the rim, on either side of it.
    #[must_use]
    pub fn rim_distance(&self, p: Vec2) -> f64 {
        match self {
            Self::Circle { center, radius } => ((p - *center).length() - radius).abs(),
            Self::Polygon { .. } => {
                self.sides().map(|side| segment::distance(side, p)).fold(f64::INFINITY, f64::min)
            }
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
pub struct LocalHole(LocalRim);

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

impl LocalHole {
    /// The numbers behind it.
    #[must_use]
    pub fn rim(&self) -> &LocalRim {
        &self.0
    }

    /// True if `anchor + offset` lies inside; not on the rim.
    #[must_use]
    pub fn contains(&self, offset: Vec2) -> bool {
        match &self.0 {
            LocalRim::Circle { d, excess } => excess + (*d * 2.0 + offset).dot(offset) < 0.0,
            LocalRim::Polygon(sides, side) => {
                let crossed = sides.iter().filter(|side| side.crosses(offset)).count();
                let is_in = (crossed % 2 == 1) == (*side == PolygonSide::Inside);
                is_in && !sides.iter().any(|side| side.holds(offset))
            }
        }
    }

    /// The hole as far as points at a height ask for it: without the sides above and below.
    #[must_use]
    pub fn at_height(&self, y: f64) -> Self {
        let meets = |side: &LocalSide| side.a.y.min(side.b.y) <= y && y <= side.a.y.max(side.b.y);
        Self(match &self.0 {
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
        match &self.0 {
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
                    let step = side.direction.unit().left() * (2.0 * reach);
                    offset + if side.left(offset) > 0.0 { -step } else { step }
                };
                near.map(beyond).find(|&p| !self.contains(p)).unwrap_or(offset)
            }
        }
    }
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
}

impl LocalSide {
    fn new(a: Vec2, b: Vec2, anchor: Vec2) -> Self {
        Self { a: a - anchor, b: b - anchor, direction: b - a, cross: cross(a, b, anchor) }
    }

    /// Positive on the left of the side's line.
    fn left(&self, offset: Vec2) -> f64 {
        self.cross + self.direction.cross(offset)
    }

    /// Distance of the point from the side.
    fn distance(&self, offset: Vec2) -> f64 {
        let tangent = self.direction.unit();
        let beyond = tangent.dot(self.a - offset).max(tangent.dot(offset - self.b)).max(0.0);
        beyond.hypot(self.left(offset) / self.direction.length())
    }

    /// True if the ray from the point to the right crosses the side.
    fn crosses(&self, offset: Vec2) -> bool {
        let (up, above) = (self.b.y > offset.y, self.a.y > offset.y);
        up != above && up == (self.left(offset) > 0.0)
    }

    /// True if the point lies on the side.
    fn holds(&self, offset: Vec2) -> bool {
        let hull = Rect::new(self.a.min(self.b), self.a.max(self.b));
        self.left(offset) == 0.0 && hull.contains(offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
