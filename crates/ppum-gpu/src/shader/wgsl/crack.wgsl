// Cracks seen from the view's centre: the twin of LocalCrack in ppum::crack.

// Where the edges of a crack are in the view's data, and how many; if some are arcs, its vertices
// and groups of edges follow.
struct Crack { first: u32, count: u32, is_curved: bool }

// The signed distance from the line of the nearest segment, and which segment that is; of a crack
// with arcs 0 if it is the line that goes on beyond the start, 1 beyond the end, 2 any other.
struct Nearest { distance: f32, segment: u32 }

// +1 on the left of the crack, -1 on its right, +1 on it.
fn crack_side(crack: Crack, offset: vec2<f32>) -> f32 {
    return crack_sign(crack_nearest(crack, offset));
}

// +1 or -1 by a signed distance; zero counts as above.
fn crack_sign(distance: f32) -> f32 {
    return select(-1.0, 1.0, distance >= 0.0);
}

// Distance from the line of the nearest segment, positive on its left.
fn crack_nearest(crack: Crack, offset: vec2<f32>) -> f32 {
    return crack_nearest_segment(crack, offset).distance;
}

// The nearest segment; where its nearest point is a vertex (the sector behind a kink), that of the
// two segments there with the larger line distance. Both name the same one, so rounding may choose
// between them.
fn crack_nearest_segment(crack: Crack, offset: vec2<f32>) -> Nearest {
    var nearest = Nearest(crack_line_distance(crack, 0u, offset), 0u);
    if !HAS_KINKS {
        return nearest;
    }
    if HAS_ARCS && crack.is_curved {
        return crack_nearest_edge(crack, offset);
    }
    var closest = vec2<f32>(0.0, 0.0);
    for (var k = 0u; k < crack.count; k++) {
        let vector = crack_vector(crack, k, offset);
        let scale = crack_scale(max(abs(closest), abs(vector)));
        if k == 0u || dot(closest * scale, closest * scale) > dot(vector * scale, vector * scale) {
            closest = vector;
            nearest = Nearest(vector.y, k);
            if vector.x != 0.0 {
                let other = select(k - 1u, k + 1u, vector.x > 0.0);
                let distance = crack_line_distance(crack, other, offset);
                if abs(distance) > abs(vector.y) {
                    nearest = Nearest(distance, other);
                }
            }
        }
    }
    return nearest;
}

// A power of two that makes the larger of two positive numbers about 1, so that squares neither
// vanish nor overflow.
fn crack_scale(size: vec2<f32>) -> f32 {
    let exponent = clamp(bitcast<u32>(max(size.x, size.y)) >> 23u, 1u, 253u);
    return bitcast<f32>((254u - exponent) << 23u);
}

// Distance from the line of a segment, positive on its left.
fn crack_line_distance(crack: Crack, k: u32, offset: vec2<f32>) -> f32 {
    let at = crack.first + SEGMENT_PAIRS * k;
    let tangent = load_view(at);
    return tangent.x * offset.y - tangent.y * offset.x + load_view(at + 1u).x;
}

// How far a point lies beyond the ends of a segment, along it, and how far from its line. The first
// and the last segment of a crack have no end.
fn crack_vector(crack: Crack, k: u32, offset: vec2<f32>) -> vec2<f32> {
    let at = crack.first + SEGMENT_PAIRS * k;
    let along = dot(load_view(at), offset);
    let ends = load_view(at + 2u);
    return vec2<f32>(along - clamp(along, ends.x, ends.y), crack_line_distance(crack, k, offset));
}

// Distance from the line or the circle of an edge, positive on its left.
fn crack_edge_distance(crack: Crack, k: u32, offset: vec2<f32>) -> f32 {
    let v = crack_line_distance(crack, k, offset);
    let at = crack.first + SEGMENT_PAIRS * k;
    let curvature = load_view(at + 1u).y;
    if !HAS_ARCS || curvature == 0.0 {
        return v;
    }
    let u = dot(load_view(at), offset);
    let p = v + v - curvature * (u * u + v * v);
    return p / (1.0 + sqrt(max(1.0 - curvature * p, 0.0)));
}

// A vertex seen from a point: how far along the tangent of the edge behind it (0) or before it (1)
// the point lies, how far beside it, and how far away.
struct Vertex { along: f32, beside: f32, distance: f32 }

fn crack_vertex(crack: Crack, k: u32, tangent: u32, offset: vec2<f32>) -> Vertex {
    let at = crack.first + SEGMENT_PAIRS * crack.count + VERTEX_PAIRS * k;
    let way = offset - load_view(at);
    let t = load_view(at + 1u + tangent);
    return Vertex(dot(t, way), t.x * way.y - t.y * way.x, crack_length(way));
}

fn crack_length(way: vec2<f32>) -> f32 {
    let scale = crack_scale(abs(way));
    return length(way * scale) / scale;
}

// The larger of the distances from both tangents of a vertex.
fn crack_corner(crack: Crack, k: u32, offset: vec2<f32>) -> f32 {
    let before = crack_vertex(crack, k, 0u, offset).beside;
    let after = crack_vertex(crack, k, 1u, offset).beside;
    return select(before, after, abs(after) > abs(before));
}

// The distance from the line on which a crack with arcs goes on beyond an end: that of its segment
// there, or the tangent of the arc.
fn crack_ray_distance(crack: Crack, end: u32, beside: f32, offset: vec2<f32>) -> f32 {
    let k = end * (crack.count - 1u);
    let curvature = load_view(crack.first + SEGMENT_PAIRS * k + 1u).y;
    if curvature == 0.0 {
        return crack_line_distance(crack, k, offset);
    }
    return beside;
}

// The nearest edge of a crack with arcs, see LocalChain::nearest_distance. Groups of edges are
// passed over that are farther away than the nearest centre of one.
fn crack_nearest_edge(crack: Crack, offset: vec2<f32>) -> Nearest {
    var nearest = Nearest(0.0, 2u);
    var closest = CRACK_FAR;
    let groups = crack.first + SEGMENT_PAIRS * crack.count + VERTEX_PAIRS * (crack.count + 1u);
    var reach = CRACK_FAR;
    var group = groups;
    for (var k = 0u; k < crack.count; k = u32(load_view(group - 1u).y)) {
        reach = min(reach, crack_length(offset - load_view(group)));
        group += EDGE_GROUP_PAIRS;
    }
    group = groups;
    var group_end = 0u;
    for (var k = 0u; k < crack.count; k++) {
        if k == group_end {
            let away = crack_length(offset - load_view(group)) - 1.01 * reach;
            let disc = load_view(group + 1u);
            group += EDGE_GROUP_PAIRS;
            group_end = u32(disc.y);
            if away > disc.x {
                k = group_end - 1u;
                continue;
            }
        }
        let at = crack.first + SEGMENT_PAIRS * k;
        let start = crack_vertex(crack, k, 1u, offset);
        let end = crack_vertex(crack, k + 1u, 0u, offset);
        let is_first = k == 0u;
        let is_last = k + 1u == crack.count;
        let along = vec2<f32>(start.along, -end.along);
        let is_major = load_view(at + 2u).x != 0.0;
        let depth = select(min(along.x, along.y), max(along.x, along.y), is_major);
        var own = Nearest(crack_edge_distance(crack, k, offset), 2u);
        var distance = abs(own.distance);
        if load_view(at + 1u).y == 0.0 {
            own.segment = select(select(2u, 1u, is_last), 0u, is_first);
        }
        if depth < 0.0 {
            var before = start.distance;
            var behind = end.distance;
            if is_first {
                before = select(CRACK_FAR, abs(start.beside), start.along < 0.0);
            }
            if is_last {
                behind = select(CRACK_FAR, abs(end.beside), end.along > 0.0);
            }
            distance = min(before, behind);
            let vertex = select(k, k + 1u, before > behind);
            if vertex == 0u {
                own = Nearest(crack_ray_distance(crack, 0u, start.beside, offset), 0u);
            } else if vertex == crack.count {
                own = Nearest(crack_ray_distance(crack, 1u, end.beside, offset), 1u);
            } else {
                own = Nearest(crack_corner(crack, vertex, offset), 2u);
            }
        }
        if distance < closest {
            closest = distance;
            nearest = own;
        }
    }
    return nearest;
}
