//! Straight lines, where they meet each other, circles and boxes.

use crate::segment::Segment;
use crate::vec2::{Rect, Vec2, vec2};

/// A straight line: the points from + t along. The length of `along` is the unit of t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The point at t = 0.
    pub from: Vec2,
    /// The direction.
    pub along: Vec2,
}

impl Line {
    /// The line of a segment, whose ends are at t = 0 and 1.
    #[must_use]
    pub fn through([a, b]: Segment) -> Self {
        Self { from: a, along: b - a }
    }

    /// The line a x + b y + c = 0 seen from an anchor, with t as a length from the point next to
    /// the anchor; the form is positive on the right. Not finite if a and b are zero.
    #[must_use]
    pub fn of_equation([a, b, c]: [f64; 3], anchor: Vec2) -> Self {
        let normal = vec2(a, b);
        let distance = a.mul_add(anchor.x, b.mul_add(anchor.y, c)) / normal.length();
        let normal = normal.unit();
        Self { from: normal * -distance, along: normal.left() }
    }

    /// Returns the line with arc length as its parameter t.
    #[must_use]
    pub fn unit(self) -> Self {
        Self { along: self.along.unit(), ..self }
    }

    /// The point at t.
    #[must_use]
    pub fn at(&self, t: f64) -> Vec2 {
        self.from + self.along * t
    }

    /// t of the foot of a point.
    #[must_use]
    pub fn foot(&self, p: Vec2) -> f64 {
        self.along.dot(p - self.from) / self.along.dot(self.along)
    }

    /// |along| times the distance of a point, positive on the left.
    #[must_use]
    pub fn side(&self, p: Vec2) -> f64 {
        self.along.cross(p - self.from)
    }

    /// t on this line and on another one of the point where they meet; none if they are parallel
    /// to rounding.
    #[must_use]
    pub fn meets(&self, other: &Self) -> Option<[f64; 2]> {
        let (area, way) = (self.along.cross(other.along), other.from - self.from);
        let at = [way.cross(other.along) / area, way.cross(self.along) / area];
        at.iter().all(|t| t.is_finite()).then_some(at)
    }

    /// t of the two points of a circle, in order; none of a line that misses or touches it. Nothing
    /// cancels where the line nearly touches.
    #[must_use]
    pub fn meets_circle(&self, center: Vec2, radius: f64) -> Option<[f64; 2]> {
        let length = self.along.length();
        let height = self.side(center) / length;
        let half = ((radius - height) * (radius + height)).sqrt() / length;
        let middle = self.foot(center);
        (half > 0.0).then_some([middle - half, middle + half])
    }

    /// The part of a range of t in a closed box; none if it misses the box (Liang and Barsky 1984).
    #[must_use]
    pub fn within(&self, bounds: &Rect, [mut low, mut high]: [f64; 2]) -> Option<[f64; 2]> {
        let Self { from, along } = self;
        for (from, step, min, max) in [
            (from.x, along.x, bounds.min.x, bounds.max.x),
            (from.y, along.y, bounds.min.y, bounds.max.y),
        ] {
            if step != 0.0 {
                let (a, b) = ((min - from) / step, (max - from) / step);
                (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
            } else if !(min..=max).contains(&from) {
                return None;
            }
        }
        (low <= high).then_some([low, high])
    }

    /// The ends of that part; none if they are not finite.
    #[must_use]
    pub fn clipped(&self, bounds: &Rect, range: [f64; 2]) -> Option<Segment> {
        let ends = self.within(bounds, range)?.map(|t| self.at(t));
        ends.iter().all(|p| p.is_finite()).then_some(ends)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;

    /// Common points of a line and another curve lie on both, for lines of every length.
    #[test]
    fn common_points_lie_on_both() {
        let mut random = Random(9);
        let mut found = [0; 3];
        for _ in 0..1000 {
            let [a, b, c, d] =
                [(); 4].map(|()| vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0)));
            let scale = 10f64.powf(random.between(-6.0, 6.0));
            let (line, other) =
                (Line { from: a, along: (b - a) * scale }, Line::through([c, d]).unit());
            let near = |p: Vec2, q: Vec2| (p - q).length() < 1e-9;
            if let Some([t, u]) = line.meets(&other) {
                let size = 1.0 + line.at(t).length();
                assert!((line.at(t) - other.at(u)).length() < 1e-9 * size * size);
                found[0] += 1;
            }
            let radius = random.between(0.0, 1.0);
            let ends = line.meets_circle(c, radius);
            let height = line.side(c).abs() / line.along.length();
            assert_eq!(ends.is_some(), height < radius);
            for t in ends.into_iter().flatten() {
                assert!(((line.at(t) - c).length() - radius).abs() < 1e-9);
                found[1] += 1;
            }
            let bounds = Rect::new(c.min(d), c.max(d));
            let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
            let part = line.clipped(&bounds, everywhere);
            let corners = bounds.corners().map(|p| line.side(p));
            let divides = corners.iter().any(|s| *s > 0.0) && corners.iter().any(|s| *s < 0.0);
            assert_eq!(part.is_some(), divides);
            if let Some([p, q]) = part {
                for p in [p, q] {
                    assert!(bounds.distance(p) < 1e-9 && line.side(p).abs() < 1e-9 * scale);
                    found[2] += usize::from(near(p, p.max(bounds.min).min(bounds.max)));
                }
            }
        }
        assert!(found.iter().all(|n| *n > 300), "{found:?}");
    }

    #[test]
    fn ties() {
        let bounds = Rect::new(vec2(0.0, 0.0), vec2(2.0, 1.0));
        let line = |a: [f64; 2], b: [f64; 2]| Line::through([a.into(), b.into()]);
        let along = line([-1.0, 1.0], [3.0, 1.0]);
        assert_eq!(along.within(&bounds, [0.0, 1.0]), Some([0.25, 0.75]), "along the border");
        assert_eq!(along.meets(&line([0.0, 0.0], [1.0, 0.0])), None, "parallel");
        assert_eq!(along.meets_circle(vec2(0.0, 0.0), 1.0), None, "it touches");
        assert_eq!(line([3.0, 0.0], [3.0, 1.0]).within(&bounds, [0.0, 1.0]), None);
        let corner = line([1.0, 2.0], [3.0, 0.0]).within(&bounds, [0.0, 1.0]);
        assert_eq!(corner, Some([0.5, 0.5]), "at a corner");
        let [a, b] = Line::of_equation([2.0, -2.0, 0.0], vec2(1.0, 0.5))
            .clipped(
                &Rect::new(vec2(-1.0, -0.5), vec2(1.0, 0.5)),
                [f64::NEG_INFINITY, f64::INFINITY],
            )
            .unwrap();
        assert!((a - vec2(-1.0, -0.5)).length() + (b - vec2(0.0, 0.5)).length() < 1e-15);
        assert_eq!(line([f64::NAN, 0.0], [1.0, 1.0]).clipped(&bounds, [0.0, 1.0]), None);
    }
}
