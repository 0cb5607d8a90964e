//! Points, segments and cracks against boxes.

use ppum::crack::Crack;
use ppum::vec2::{Rect, Vec2, vec2};

/// True if `p` lies in the open box.
pub(crate) fn inside(open: &Rect, p: Vec2) -> bool {
    p.x > open.min.x && p.x < open.max.x && p.y > open.min.y && p.y < open.max.y
}

/// Length of a crack inside an open box; a segment along the box's border does not count.
pub(crate) fn length_inside(crack: &Crack, open: &Rect) -> f64 {
    crack.points.windows(2).map(|s| segment_inside(s[0], s[1], open)).sum()
}

/// Number of connected parts of a crack inside an open box.
pub(crate) fn runs_inside(crack: &Crack, open: &Rect) -> usize {
    let (mut runs, mut goes_on) = (0, false);
    for pair in crack.points.windows(2) {
        let Some((_, to)) = part_inside(pair[0], pair[1], open) else {
            goes_on = false;
            continue;
        };
        runs += usize::from(!goes_on);
        goes_on = to == 1.0 && inside(open, pair[1]);
    }
    runs
}

/// Length of a segment inside an open box.
pub(crate) fn segment_inside(a: Vec2, b: Vec2, open: &Rect) -> f64 {
    part_inside(a, b, open).map_or(0.0, |(from, to)| (to - from) * (b - a).length())
}

/// The part of a segment inside an open box, as parameters from 0 at `a` to 1 at `b`; by clipping (Liang
/// & Barsky 1984).
fn part_inside(a: Vec2, b: Vec2, open: &Rect) -> Option<(f64, f64)> {
    let d = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (start, step, lo, hi) in
        [(a.x, d.x, open.min.x, open.max.x), (a.y, d.y, open.min.y, open.max.y)]
    {
        if step == 0.0 {
            if start <= lo || start >= hi {
                return None;
            }
        } else {
            let (s, t) = ((lo - start) / step, (hi - start) / step);
            (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
        }
    }
    (from < to).then_some((from, to))
}

/// True if a part of a segment lies inside an open box or on its border.
pub(crate) fn meets([a, b]: [Vec2; 2], rect: &Rect) -> bool {
    distance([a, b], rect) == 0.0
}

/// Distance of a segment of positive length to a box, zero if they meet.
pub(crate) fn distance([a, b]: [Vec2; 2], rect: &Rect) -> f64 {
    if segment_inside(a, b, rect) > 0.0 {
        return 0.0;
    }
    let (min, max) = (rect.min, rect.max);
    let corners = [min, vec2(max.x, min.y), max, vec2(min.x, max.y)];
    let of_corners = corners.into_iter().map(|p| {
        let along = b - a;
        let s = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
        (p - a - along * s).length()
    });
    of_corners.chain([rect.distance(a), rect.distance(b)]).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::crack;

    #[test]
    fn runs_of_a_crack_in_a_box() {
        let domain = Rect::new(vec2(-9.0, -9.0), vec2(9.0, 9.0));
        let unit = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        let runs = |points: &[[f64; 2]]| {
            let points = points.iter().map(|&p| p.into()).collect();
            runs_inside(&crack(points, &domain), &unit)
        };
        assert_eq!(runs(&[[-1.0, 0.5], [2.0, 0.6]]), 1);
        assert_eq!(runs(&[[-1.0, 0.5], [0.4, 0.5], [2.0, 0.6]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, -1.0], [0.6, 2.0]]), 2, "a kink below");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, 0.1], [0.6, 2.0]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.2, 0.5], [3.0, 0.5], [3.0, 0.2], [-1.0, 0.2]]), 2);
        assert_eq!(runs(&[[-1.0, 0.0], [2.0, 0.0]]), 0, "along the border");
        assert_eq!(runs(&[[-1.0, 0.5], [0.0, 0.5], [-1.0, 0.6]]), 0, "up to the border");
    }
}
