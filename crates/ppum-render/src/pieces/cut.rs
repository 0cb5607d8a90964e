//! Convex polygons cut by lines.

use ppum::line::Line;
use ppum::vec2::{Rect, Vec2, vec2};

/// Rounding of offsets and of distances from lines, in parts of their size.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Ends of a face nearer to a corner than this part of a side are the corner.
const SAME: f64 = 1e-7;

/// Largest part of the way to a centre for what is seen from inside.
const MOST_INSET: f64 = 0.3;

/// The range of a face that is a whole line.
const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The range of a line without faces.
const NOWHERE: [f64; 2] = [f64::NAN; 2];

/// Largest distance of a piece's straight side from the curve it stands for, in parts of the
/// square's side.
pub const SAGITTA: f64 = 0.01;

/// A line that cuts polygons, and the part of it that the field jumps on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PolygonCut {
    /// Unit vector along the line.
    pub(crate) tangent: Vec2,
    /// Distance of the anchor from the line, positive on its left.
    distance: f64,
    /// The part of the line that is a face, along it from the anchor.
    range: [f64; 2],
    /// True if what lies on both sides may be one material.
    pub(super) is_interface: bool,
    /// Distance of the curve that the line stands for; 0 if it is straight.
    pub(super) sagitta: f64,
}

/// A convex polygon; points are offsets from the anchor.
#[derive(Clone, Debug)]
pub(crate) struct AnchoredPolygon {
    /// Counter-clockwise.
    pub(super) corners: Vec<Vec2>,
    /// For the side from each corner to the next the line it was cut along.
    pub(super) sides: Vec<Option<PolygonCut>>,
}

impl PolygonCut {
    /// Along a line whose left has positive distances.
    pub(super) fn along(tangent: Vec2, distance: f64, range: [f64; 2]) -> Self {
        Self { tangent, distance, range, is_interface: false, sagitta: 0.0 }
    }

    /// The line as what stands for a curve within a distance of it.
    pub(super) fn with_sagitta(self, sagitta: f64) -> Self {
        Self { sagitta, ..self }
    }

    /// The interface a x + b y + c = 0.
    pub(super) fn interface(form: [f64; 3], anchor: Vec2) -> Option<Self> {
        let line = Line::of_equation(form, anchor);
        let (tangent, distance) = (-line.along, line.along.cross(line.from));
        let cut = Self { is_interface: true, ..Self::along(tangent, distance, EVERYWHERE) };
        (tangent.is_finite() && distance.is_finite()).then_some(cut)
    }

    /// The chord between two points of a curve that stays within a distance of it.
    pub(super) fn chord([a, b]: [Vec2; 2], sagitta: f64, is_face: bool) -> Self {
        let tangent = (b - a).unit();
        let range = if is_face { EVERYWHERE } else { NOWHERE };
        let cut = Self::along(tangent, -tangent.cross(a), range);
        Self { is_interface: true, ..cut.with_sagitta(sagitta) }
    }

    /// A line in a direction through a point on which nothing happens.
    pub(super) fn through(p: Vec2, tangent: Vec2) -> Self {
        Self::along(tangent, -tangent.cross(p), NOWHERE)
    }

    /// The border of a box; the box is on the left.
    pub(super) fn borders(bounds: &Rect) -> [Self; 4] {
        let Rect { min, max } = *bounds;
        let border = |tangent, distance| Self::along(tangent, distance, EVERYWHERE);
        [
            border(vec2(1.0, 0.0), -min.y),
            border(vec2(0.0, 1.0), max.x),
            border(vec2(-1.0, 0.0), max.y),
            border(vec2(0.0, -1.0), -min.x),
        ]
    }

    /// Distance of a point from the line, positive on its left; zero if it is rounding.
    fn side(&self, p: Vec2) -> f64 {
        let distance = self.distance + self.tangent.cross(p);
        let rounding = ROUNDING * p.x.abs().max(p.y.abs());
        if distance.abs() <= rounding { 0.0 } else { distance }
    }

    /// True if the foot of a point lies on the part that is a face.
    pub(super) fn holds(&self, p: Vec2) -> bool {
        let along = self.tangent.dot(p);
        self.range[0] <= along && along <= self.range[1]
    }

    /// True if the face meets a closed rectangle, or comes within rounding of it.
    pub(super) fn meets(&self, rect: &Rect) -> bool {
        let size = [rect.min.x, rect.min.y, rect.max.x, rect.max.y];
        let reach = 2.0 * ROUNDING * size.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let beyond = vec2(reach, reach);
        let near = Rect::new(rect.min - beyond, rect.max + beyond);
        self.line().within(&near, [self.range[0] - reach, self.range[1] + reach]).is_some()
    }

    fn line(&self) -> Line {
        Line { from: self.tangent.left() * -self.distance, along: self.tangent }
    }

    /// Part of the way to a centre that leads away from a curve.
    pub(super) fn inset(&self, center: Vec2) -> f64 {
        let way = self.side(center).abs();
        if self.sagitta > 0.0 { (3.0 * self.sagitta / way).min(MOST_INSET) } else { 0.0 }
    }

    /// True if that part of the way does not lead past an arc.
    pub(super) fn is_too_near(&self, center: Vec2) -> bool {
        !self.is_interface && MOST_INSET * self.side(center).abs() < self.sagitta
    }
}

impl AnchoredPolygon {
    /// A polygon that nothing cuts.
    pub(super) fn uncut(corners: &[Vec2]) -> Self {
        Self { corners: corners.to_vec(), sides: vec![None; corners.len()] }
    }

    /// The middle of a side.
    pub(super) fn middle(&self, side: usize) -> Vec2 {
        (self.corners[side] + self.next(side)) * 0.5
    }

    pub(super) fn next(&self, side: usize) -> Vec2 {
        self.corners[(side + 1) % self.corners.len()]
    }

    /// The parts on the right and on the left of a line; a part is left out if it has no area, or
    /// is thinner than `least` while the other is not.
    pub(super) fn split(self, cut: &PolygonCut, least: f64) -> [Option<Self>; 2] {
        let distances: Vec<f64> = self.corners.iter().map(|&corner| cut.side(corner)).collect();
        let thickness = |sign: f64| distances.iter().fold(0.0, |a: f64, d| a.max(sign * d));
        let (right, left) = (thickness(-1.0), thickness(1.0));
        let keep = |own: f64, other: f64| own > 0.0 && (own >= least || own >= other);
        let part =
            |sign: f64, own, other| keep(own, other).then(|| self.part(cut, &distances, sign));
        [part(-1.0, right, left), part(1.0, left, right)]
    }

    /// The part where sign · distance ≥ 0.
    fn part(&self, cut: &PolygonCut, distances: &[f64], sign: f64) -> Self {
        let (mut corners, mut sides) = (Vec::new(), Vec::new());
        let n = self.corners.len();
        for k in 0..n {
            let (here, there) = (sign * distances[k], sign * distances[(k + 1) % n]);
            let on_line = || Some(*cut);
            if here >= 0.0 {
                corners.push(self.corners[k]);
                // the side goes on, runs along the line, or leaves it behind
                let side = if here == 0.0 && there <= 0.0 { on_line() } else { self.sides[k] };
                sides.push(side);
            }
            if here * there < 0.0 {
                corners.push(crossing(self.corners[k], self.next(k), [here, there]));
                sides.push(if here > 0.0 { on_line() } else { self.sides[k] });
            }
        }
        Self { corners, sides }
    }

    /// Returns the polygon without sides shorter than `shortest`; none if fewer than three are
    /// left.
    pub(super) fn without_short_sides(self, shortest: f64) -> Option<Self> {
        let is_long = |k: &usize| (self.next(*k) - self.corners[*k]).length() >= shortest;
        let long: Vec<usize> = (0..self.corners.len()).filter(is_long).collect();
        if long.len() == self.corners.len() {
            return Some(self);
        }
        let corners = long.iter().map(|&k| self.corners[k]).collect();
        let sides = long.iter().map(|&k| self.sides[k]).collect();
        (long.len() > 2).then_some(Self { corners, sides })
    }

    /// Returns the polygon with a corner at each end of a face inside a side: at a tip.
    pub(super) fn with_ends(self) -> Self {
        let (mut corners, mut sides) = (Vec::new(), Vec::new());
        for k in 0..self.corners.len() {
            let (a, b, side) = (self.corners[k], self.next(k), &self.sides[k]);
            corners.push(a);
            sides.push(*side);
            let Some(cut) = side else { continue };
            let along = [a, b].map(|p| cut.tangent.dot(p));
            let mut ends: Vec<f64> = cut.range.iter().map(|end| part(along, *end)).collect();
            ends.retain(|t| *t > SAME && *t < 1.0 - SAME);
            ends.sort_by(f64::total_cmp);
            for t in ends {
                corners.push(a + (b - a) * t);
                sides.push(*side);
            }
        }
        Self { corners, sides }
    }

    /// True for a sliver beside an arc, of which nothing is seen from inside.
    pub(super) fn is_sliver(&self, center: Vec2) -> bool {
        self.sides.iter().flatten().any(|cut| cut.is_too_near(center))
    }

    /// Part of the way to the centre for what is seen from inside.
    pub(super) fn inset(&self, center: Vec2, least: f64) -> f64 {
        self.sides.iter().flatten().map(|cut| cut.inset(center)).fold(least, f64::max)
    }
}

/// The part of the way from one number to another at which a third lies; NaN if it lies
/// at infinity.
fn part([a, b]: [f64; 2], c: f64) -> f64 {
    if c.is_finite() { (c - a) / (b - a) } else { f64::NAN }
}

/// The point between two at which distances of different signs are zero, whichever of them
/// comes first.
fn crossing(a: Vec2, b: Vec2, [at_a, at_b]: [f64; 2]) -> Vec2 {
    if (b.x, b.y) < (a.x, a.y) {
        return crossing(b, a, [at_b, at_a]);
    }
    a + (b - a) * (at_a / (at_a - at_b))
}

/// The mean of the corners of a convex polygon.
pub(super) fn centroid(corners: &[Vec2]) -> Vec2 {
    let origin = corners[0];
    let sum = corners.iter().fold(Vec2::ZERO, |sum, &corner| sum + (corner - origin));
    origin + sum / corners.len() as f64
}
