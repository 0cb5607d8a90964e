// Stand-ins for the functions of points, for straight cracks.
const GEOMETRY_PAIRS = 4u;

struct Functions { v: vec4<f32>, x: vec4<f32>, y: vec4<f32>, xx: vec4<f32>, xy: vec4<f32>, yy: vec4<f32> }
struct TipPoint { x: f32, y: f32, sign: f32, branch: f32 }
struct Crack { first: u32, count: u32 }

fn load_view(at: u32) -> vec2<f32> {
    return bitcast<vec2<f32>>(vec2<u32>(VIEW[2u * at], VIEW[2u * at + 1u]));
}

fn crack_at(k: u32) -> Crack {
    return Crack(CRACKS + 3u * k, 1u);
}

// A pair is a point of the crack, the next its tangent.
fn crack_side(crack: Crack, offset: vec2<f32>) -> f32 {
    let d = offset - load_view(crack.first);
    let tangent = load_view(crack.first + 1u);
    return select(-1.0, 1.0, tangent.x * d.y - tangent.y * d.x >= 0.0);
}

struct Frame { origin: vec2<f32>, axis: vec2<f32> }

fn crack_of(group: u32) -> Crack {
    let pair = bitcast<vec2<u32>>(load_view(GEOMETRY_PAIRS * group));
    return Crack(pair.x, pair.y);
}

fn fixed_at(group: u32) -> Frame {
    let at = GEOMETRY_PAIRS * group;
    return Frame(load_view(at), load_view(at + 1u));
}

fn tip_at(group: u32) -> Frame {
    return fixed_at(group);
}

fn fixed_point(frame: Frame, offset: vec2<f32>) -> TipPoint {
    let d = offset + frame.origin;
    let y = frame.axis.x * d.y - frame.axis.y * d.x;
    return TipPoint(dot(frame.axis, d), y, select(-1.0, 1.0, y >= 0.0), 1.0);
}

fn tip_point(frame: Frame, offset: vec2<f32>) -> TipPoint {
    return fixed_point(frame, offset);
}

fn tip_radius(p: TipPoint) -> f32 {
    return sqrt(p.x * p.x + p.y * p.y);
}

fn tip_half_angle(p: TipPoint, r: f32) -> vec2<f32> {
    let theta = atan2(p.y, p.x);
    return vec2<f32>(cos(0.5 * theta), sin(0.5 * theta));
}

fn tip_theta(half: vec2<f32>) -> f32 {
    return 2.0 * atan2(half.y, half.x);
}

// Values by the formulas, derivatives left out: they are not what is tested.
fn westergaard(p: TipPoint) -> Functions {
    let r = tip_radius(p);
    let half = tip_half_angle(p, r);
    let root = sqrt(r) * half;
    return Functions(vec4<f32>(root, root.yx * p.y / r), vec4<f32>(), vec4<f32>(), vec4<f32>(), vec4<f32>(), vec4<f32>());
}

fn functions_turned(f: Functions, axis: vec2<f32>) -> Functions {
    let c = axis.x;
    let s = axis.y;
    return Functions(
        f.v, c * f.x - s * f.y, s * f.x + c * f.y,
        c * c * f.xx - 2.0 * c * s * f.xy + s * s * f.yy,
        c * s * (f.xx - f.yy) + (c * c - s * s) * f.xy,
        s * s * f.xx + 2.0 * c * s * f.xy + c * c * f.yy,
    );
}
