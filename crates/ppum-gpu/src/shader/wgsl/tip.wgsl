// Points in the frames of functions: the twins of TipPoint and LocalTip in ppum::crack.

// A tip seen from the view's centre: centre minus tip, the direction of growth; the distance of the
// centre from the line of the segment it ends, or from the tangent of the arc, and +1 at the last
// vertex of its crack, -1 at the first; which crack and segment these are, by the numbers that
// crack_nearest_segment has for them.
struct Tip {
    from_tip: vec2<f32>,
    axis: vec2<f32>,
    distance: f32,
    orientation: f32,
    crack: u32,
    segment: u32,
}

// A fixed frame: the view's centre minus its origin, and its x axis.
struct Fixed { from_origin: vec2<f32>, axis: vec2<f32> }

// A point in a frame: x ahead, y to the left; the sign of the polar angle before the branch is
// taken; and -1 where the point lies between a kinked crack and the straight extension of its last
// segment, so that θ must be shifted by 2π, else +1.
struct TipPoint { x: f32, y: f32, sign: f32, branch: f32 }

fn tip_point(tip: Tip, offset: vec2<f32>) -> TipPoint {
    let tangent = tip.orientation * tip.axis;
    let distance = tangent.x * offset.y - tangent.y * offset.x + tip.distance;
    let side = crack_sign(distance);
    var branch = 1.0;
    if HAS_KINKS {
        let nearest = crack_nearest_segment(crack_at(tip.crack), offset);
        // where the tip's own segment is the nearest, two roundings of one distance must not decide
        branch = select(side * crack_sign(nearest.distance), 1.0, nearest.segment == tip.segment);
    }
    let x = dot(tip.axis, offset + tip.from_tip);
    return TipPoint(x, tip.orientation * distance, tip.orientation * side, branch);
}

// In a fixed frame the negative x axis belongs to the upper side, θ = +π.
fn fixed_point(frame: Fixed, offset: vec2<f32>) -> TipPoint {
    let d = offset + frame.from_origin;
    let y = frame.axis.x * d.y - frame.axis.y * d.x;
    return TipPoint(dot(frame.axis, d), y, crack_sign(y), 1.0);
}

// r = √(x² + y²), without overflow or underflow.
fn tip_radius(p: TipPoint) -> f32 {
    let large = max(abs(p.x), abs(p.y));
    if large == 0.0 {
        return 0.0;
    }
    let slope = min(abs(p.x), abs(p.y)) / large;
    return large * sqrt(slope * slope + 1.0);
}

// √r cos(θ/2) and √r sin(θ/2) for r = |z|. The larger of the two magnitudes is a root, the smaller
// follows by division, so nothing cancels near θ = ±π. Both are zero at r = 0.
fn tip_half_root(p: TipPoint, r: f32) -> vec2<f32> {
    if r == 0.0 {
        return vec2<f32>();
    }
    let large = sqrt((r + abs(p.x)) * 0.5);
    let small = 0.5 * abs(p.y) / large;
    let root = select(vec2<f32>(small, large), vec2<f32>(large, small), p.x >= 0.0);
    return vec2<f32>(p.branch, p.branch * p.sign) * root;
}

// cos(θ/2) and sin(θ/2); those of θ = 0 on the branch at r = 0.
fn tip_half_angle(p: TipPoint, r: f32) -> vec2<f32> {
    if r == 0.0 {
        return vec2<f32>(p.branch, 0.0);
    }
    return tip_half_root(p, r) / sqrt(r);
}

// θ on the branch that jumps on the crack itself, from cos(θ/2) and sin(θ/2): 4 arctan(tan(θ/4)),
// beyond a half turn by the angle that is missing from a full one.
fn tip_theta(half: vec2<f32>) -> f32 {
    let angle = 4.0 * ppum_atan(abs(half.y) / (1.0 + abs(half.x)));
    let size = select(angle, 6.2831853 - angle, half.x < 0.0);
    return select(size, -size, half.y < 0.0);
}
