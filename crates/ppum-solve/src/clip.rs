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

/// Length of a segment inside an open box, by clipping its parameter range (Liang & Barsky 1984).
pub(crate) fn segment_inside(a: Vec2, b: Vec2, open: &Rect) -> f64 {
    let d = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (start, step, lo, hi) in
        [(a.x, d.x, open.min.x, open.max.x), (a.y, d.y, open.min.y, open.max.y)]
    {
        if step == 0.0 {
            if start <= lo || start >= hi {
                return 0.0;
            }
        } else {
            let (s, t) = ((lo - start) / step, (hi - start) / step);
            (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
        }
    }
    (to - from).max(0.0) * d.length()
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
