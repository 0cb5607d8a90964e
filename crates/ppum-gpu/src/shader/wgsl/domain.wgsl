// Holes seen from the view's centre: the twin of LocalHole in ppum::domain.

// True if a point lies inside one of `count` holes, those at `at` in the view's data; not on a rim.
fn holes_contain(at: u32, count: u32, offset: vec2<f32>) -> bool {
    var next = at;
    for (var k = 0u; k < count; k++) {
        // 0 of a circle; 1 if what is outside of a polygon is cut out
        let head = load_view(next);
        let sides = u32(head.x);
        var inside = false;
        if sides == 0u {
            inside = hole_circle(next, offset);
        } else {
            inside = hole_polygon(next + 1u, sides, head.y != 0.0, offset);
        }
        if inside {
            return true;
        }
        next += select(1u + HOLE_SIDE_PAIRS * sides, HOLE_CIRCLE_PAIRS, sides == 0u);
    }
    return false;
}

// (|d|² - r²) / 2r + (d + o/2)·o / r < 0, d being the view's centre minus the circle's.
fn hole_circle(at: u32, offset: vec2<f32>) -> bool {
    let excess = load_view(at).y;
    let half_curvature = load_view(at + 2u).x;
    return excess + dot(load_view(at + 1u) + half_curvature * offset, offset) < 0.0;
}

// The distance from the circle of an arc, but for terms of second order, positive on its left.
fn hole_arc(at: u32, half_curvature: f32, offset: vec2<f32>) -> f32 {
    return load_view(at + 1u).x + dot(load_view(at) - half_curvature * offset, offset);
}

// A ray from the point to the right crosses an odd number of sides, an even one of the outline, and
// the point is on none. Points between an arc and its chord are on the other side than the ray
// says.
fn hole_polygon(at: u32, sides: u32, outside: bool, offset: vec2<f32>) -> bool {
    var inside = outside;
    for (var k = 0u; k < sides; k++) {
        let side = at + HOLE_SIDE_PAIRS * k;
        let a = load_view(side);
        let b = load_view(side + 1u);
        let direction = load_view(side + 2u);
        // distance from the side's line, positive on its left
        let left = load_view(side + 3u).x + (direction.x * offset.y - direction.y * offset.x);
        let up = b.y > offset.y;
        var parts = (up != (a.y > offset.y)) & (up == (left > 0.0));
        let half_curvature = load_view(side + 3u).y;
        if HAS_ARCS && half_curvature != 0.0 {
            let value = hole_arc(side + 4u, half_curvature, offset);
            // points of the chord are with those on its right, and if it is level with those above
            let on_right = (left < 0.0) | ((left == 0.0) & !((a.y == b.y) & (a.x < b.x)));
            let beside = on_right == (half_curvature > 0.0);
            if (value == 0.0) & (beside | all(offset == a) | all(offset == b)) {
                return false;
            }
            parts = parts != (beside & ((value > 0.0) == (half_curvature > 0.0)));
        } else if (left == 0.0) & all(offset >= min(a, b)) & all(offset <= max(a, b)) {
            return false;
        }
        inside = inside != parts;
    }
    return inside;
}
