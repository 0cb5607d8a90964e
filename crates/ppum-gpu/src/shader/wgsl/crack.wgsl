// Cracks seen from the view's centre: the twin of LocalCrack in ppum::crack.

// Where the segments of a crack are in the view's data, and how many.
struct Crack { first: u32, count: u32 }

// The signed distance from the line of the nearest segment, and which segment that is.
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
