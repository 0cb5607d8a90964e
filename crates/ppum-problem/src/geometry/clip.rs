//! Points, segments and cracks against boxes.

use ppum::crack::Crack;
use ppum::domain::Hole;
use ppum::line::Line;
use ppum::segment;
use ppum::vec2::{Rect, Vec2};

/// True if `p` lies in the open box.
pub fn inside(open: &Rect, p: Vec2) -> bool {
    p.x > open.min.x && p.x < open.max.x && p.y > open.min.y && p.y < open.max.y
}

/// Length of a crack inside an open box and outside of holes; a segment along the box's boundary
/// does not count.
pub fn length_inside(crack: &Crack, open: &Rect, holes: &[Hole]) -> f64 {
    let length = |s: &[Vec2]| match clipped(s[0], s[1], open) {
        Some(range) => solid_part(s[0], s[1], range, holes.iter()) * (s[1] - s[0]).length(),
        None => 0.0,
    };
    crack.points.windows(2).map(length).sum()
}

/// Part of a range of a segment's parameter that lies outside of holes.
pub fn solid_part<'h>(
    a: Vec2,
    b: Vec2,
    [from, to]: [f64; 2],
    holes: impl Iterator<Item = &'h Hole> + Clone,
) -> f64 {
    let crossings = holes.clone().flat_map(|hole| rim_crossings(a, b, hole));
    let mut breaks: Vec<f64> = crossings.filter(|t| *t > from && *t < to).collect();
    breaks.extend([from, to]);
    breaks.sort_by(f64::total_cmp);
    let is_solid = |t: f64| !holes.clone().any(|hole| hole.contains(a + (b - a) * t));
    let parts = breaks.windows(2).filter(|t| is_solid(0.5 * (t[0] + t[1])));
    parts.map(|t| t[1] - t[0]).sum()
}

/// The parameters, 0 at `a` and 1 at `b`, at which the line through two points meets a rim.
pub fn rim_crossings(a: Vec2, b: Vec2, hole: &Hole) -> Vec<f64> {
    let line = Line::through([a, b]);
    match *hole {
        Hole::Circle { center, radius } => {
            line.meets_circle(center, radius).map_or_else(Vec::new, Vec::from)
        }
        Hole::Polygon { .. } => {
            let crossing = |[p, q]: [Vec2; 2]| {
                let (s, t) = (line.side(p), line.side(q));
                (s * t <= 0.0 && s != t).then(|| line.foot(p + (q - p) * (s / (s - t))))
            };
            hole.sides().filter_map(crossing).collect()
        }
    }
}

/// True for a crack that lies on a straight line of a rim: it is a face of the body, and cuts
/// nothing.
pub fn is_on_rim(crack: &Crack, holes: &[Hole]) -> bool {
    holes.iter().any(|hole| hole.line_along(&crack.points).is_some())
}

/// Returns the parts of a range that lie outside of others.
pub fn without(range: [f64; 2], others: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let beside = |parts: Vec<[f64; 2]>, &[a, b]: &[f64; 2]| {
        let (a, b) = (a.min(b), a.max(b));
        let both = |[from, to]: [f64; 2]| [[from, to.min(a)], [from.max(b), to]];
        parts.into_iter().flat_map(both).filter(|[from, to]| from < to).collect()
    };
    others.iter().fold(vec![range], beside)
}

/// Number of connected parts of a polyline inside an open box.
pub(crate) fn runs_inside(points: &[Vec2], open: &Rect) -> usize {
    let (mut runs, mut goes_on) = (0, false);
    for pair in points.windows(2) {
        let Some([_, to]) = clipped(pair[0], pair[1], open) else {
            goes_on = false;
            continue;
        };
        runs += usize::from(!goes_on);
        goes_on = to == 1.0 && inside(open, pair[1]);
    }
    runs
}

/// Number of connected parts of a closed polygon, whose last corner is joined to the first, inside
/// an open box.
pub fn runs_of_rim(corners: &[Vec2], open: &Rect) -> usize {
    let start = corners.iter().position(|p| !inside(open, *p));
    let Some(start) = start else { return 1 };
    let n = corners.len();
    let round: Vec<_> = (0..=n).map(|k| corners[(start + k) % n]).collect();
    runs_inside(&round, open)
}

/// Length of a segment inside an open box.
pub fn segment_inside(a: Vec2, b: Vec2, open: &Rect) -> f64 {
    clipped(a, b, open).map_or(0.0, |[from, to]| (to - from) * (b - a).length())
}

/// The range of a segment's parameter inside an open box.
pub fn clipped(a: Vec2, b: Vec2, open: &Rect) -> Option<[f64; 2]> {
    // along an edge of the box nothing is inside
    let is_off = |a: f64, b: f64, min: f64, max: f64| a == b && (a <= min || a >= max);
    if is_off(a.x, b.x, open.min.x, open.max.x) || is_off(a.y, b.y, open.min.y, open.max.y) {
        return None;
    }
    Line::through([a, b]).within(open, [0.0, 1.0]).filter(|[from, to]| to > from)
}

/// True if a part of a segment lies inside an open box or on its boundary.
pub fn meets([a, b]: [Vec2; 2], rect: &Rect) -> bool {
    distance([a, b], rect) == 0.0
}

/// Distance of a segment of positive length to a box, zero if they meet.
pub fn distance([a, b]: [Vec2; 2], rect: &Rect) -> f64 {
    if segment_inside(a, b, rect) > 0.0 {
        return 0.0;
    }
    let of_corners = rect.corners().into_iter().map(|p| segment::distance([a, b], p));
    of_corners.chain([rect.distance(a), rect.distance(b)]).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn runs_of_a_crack_in_a_box() {
        let unit = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        let runs = |points: &[[f64; 2]]| {
            let points: Vec<Vec2> = points.iter().map(|&p| p.into()).collect();
            runs_inside(&points, &unit)
        };
        assert_eq!(runs(&[[-1.0, 0.5], [2.0, 0.6]]), 1);
        assert_eq!(runs(&[[-1.0, 0.5], [0.4, 0.5], [2.0, 0.6]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, -1.0], [0.6, 2.0]]), 2, "a kink below");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, 0.1], [0.6, 2.0]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.2, 0.5], [3.0, 0.5], [3.0, 0.2], [-1.0, 0.2]]), 2);
        assert_eq!(runs(&[[-1.0, 0.0], [2.0, 0.0]]), 0, "along the border");
        assert_eq!(runs(&[[-1.0, 0.5], [0.0, 0.5], [-1.0, 0.6]]), 0, "up to the border");
    }

    #[test]
    fn runs_of_a_rim_in_a_box() {
        let unit = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        let runs = |points: &[[f64; 2]]| {
            let turns = points.len();
            let mut points: Vec<Vec2> = points.iter().map(|&p| p.into()).collect();
            let mut turned = || {
                points.rotate_left(1);
                runs_of_rim(&points, &unit)
            };
            let all: Vec<_> = (0..turns).map(|_| turned()).collect();
            assert!(all.iter().all(|n| *n == all[0]), "wherever it begins: {all:?}");
            all[0]
        };
        assert_eq!(runs(&[[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]), 1, "inside");
        assert_eq!(runs(&[[0.2, -1.0], [0.4, -1.0], [0.3, 0.5]]), 1, "an apex inside");
        assert_eq!(runs(&[[0.2, -1.0], [0.4, -1.0], [0.3, 2.0]]), 2, "a strip through");
        assert_eq!(runs(&[[-1.0, -1.0], [0.5, -1.0], [0.5, 3.0], [-1.0, 3.0]]), 1, "one side");
        assert_eq!(runs(&[[-1.0, -1.0], [2.0, -1.0], [2.0, 3.0], [-1.0, 3.0]]), 0, "all of it");
    }
}
