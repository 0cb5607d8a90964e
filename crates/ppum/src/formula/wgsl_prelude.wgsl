// Functions that formulas in WGSL call: what the shading language has not, or defines otherwise than the
// language of formulas. A module needs this text once.
//
// Implementations may assume that there is neither NaN nor infinity. Where they do not, both go through
// these functions as IEEE 754 says; NaN is recognised by its bits, as `a != a` may be folded away.

// The number with these bits. A number that is not finite must not be a constant expression.
fn ppum_from_bits(bits: u32) -> f32 {
    return bitcast<f32>(bits);
}

fn ppum_is_nan(a: f32) -> bool {
    return (bitcast<u32>(a) & 0x7fffffffu) > 0x7f800000u;
}

// -1, 0 or +1; NaN of NaN.
fn ppum_sign(a: f32) -> f32 {
    return select(select(a, -1.0, a < 0.0), 1.0, a > 0.0);
}

// The smaller one; NaN if one is.
fn ppum_min(a: f32, b: f32) -> f32 {
    return select(b, a, (a < b) | ppum_is_nan(a));
}

// The larger one; NaN if one is.
fn ppum_max(a: f32, b: f32) -> f32 {
    return select(b, a, (a > b) | ppum_is_nan(a));
}

// The number of [low, high] nearest to a; NaN of NaN.
fn ppum_clamp(a: f32, low: f32, high: f32) -> f32 {
    return select(select(a, low, a < low), high, a > high);
}

// The real cube root: one step of Newton's method from a guess of single precision.
fn ppum_cbrt(a: f32) -> f32 {
    let size = abs(a);
    if !(size > 0.0) | (size > 3.4028234e38) {
        return a;
    }
    let guess = exp2(log2(size) / 3.0);
    let root = guess - (guess - size / (guess * guess)) / 3.0;
    return select(root, -root, a < 0.0);
}

fn ppum_log10(a: f32) -> f32 {
    return log(a) * 0.4342944819;
}

// tanh; that of devices may overflow where it is 1.
fn ppum_tanh(a: f32) -> f32 {
    if abs(a) > 10.0 {
        return ppum_sign(a);
    }
    return tanh(a);
}

// The arc tangent to single precision: that of devices may have four digits. tan(3π/8) and tan(π/8) part
// the range; the polynomial is the one of Cephes (Moshier 1992).
fn ppum_atan(a: f32) -> f32 {
    let size = abs(a);
    var t = size;
    var base = 0.0;
    if size > 2.4142135 {
        t = -1.0 / size;
        base = 1.5707964;
    } else if size > 0.41421357 {
        t = (size - 1.0) / (size + 1.0);
        base = 0.7853982;
    }
    let s = t * t;
    let p = ((8.05374449538e-2 * s - 1.38776856032e-1) * s + 1.99777106478e-1) * s - 3.33329491539e-1;
    let angle = base + (p * s * t + t);
    return select(angle, -angle, a < 0.0);
}

// The angle of the point (x, y), on the axis y = 0 too: 0 or pi with the sign of y.
fn ppum_atan2(y: f32, x: f32) -> f32 {
    if (y == 0.0) & !ppum_is_nan(x) {
        let half_turn = select(3.14159265, -3.14159265, (bitcast<u32>(y) >> 31u) == 1u);
        return select(y, half_turn, (bitcast<u32>(x) >> 31u) == 1u);
    }
    if ppum_is_nan(x) | ppum_is_nan(y) {
        return x + y;
    }
    let flat = abs(y) <= abs(x);
    let slope = select(abs(x) / abs(y), abs(y) / abs(x), flat);
    // infinities of both are a diagonal
    let octant = ppum_atan(select(slope, 1.0, ppum_is_nan(slope)));
    let steep = select(1.5707964 - octant, octant, flat);
    let angle = select(steep, 3.1415927 - steep, (bitcast<u32>(x) >> 31u) == 1u);
    return select(angle, -angle, y < 0.0);
}

// sqrt(a^2 + b^2) without overflow; infinite if a or b is.
fn ppum_hypot(a: f32, b: f32) -> f32 {
    if abs(a) > 3.4028234e38 {
        return abs(a);
    }
    if abs(b) > 3.4028234e38 {
        return abs(b);
    }
    let larger = max(abs(a), abs(b));
    // powers of two: exact
    if larger > 0x1p60 {
        return sqrt((a * 0x1p-66) * (a * 0x1p-66) + (b * 0x1p-66) * (b * 0x1p-66)) * 0x1p66;
    }
    if larger < 0x1p-40 {
        return sqrt((a * 0x1p100) * (a * 0x1p100) + (b * 0x1p100) * (b * 0x1p100)) * 0x1p-100;
    }
    return sqrt(a * a + b * b);
}

// a^b as of `pow` of IEEE 754: of a negative number only if b is whole, which pow of WGSL does not promise.
fn ppum_pow(a: f32, b: f32) -> f32 {
    let size = abs(a);
    let whole = floor(b) == b;
    // numbers from 2^24 on are even
    let odd = whole & (abs(b) < 0x1p24) & (floor(b * 0.5) != b * 0.5);
    if (a < 0.0) & !whole & (size <= 3.4028234e38) {
        return ppum_from_bits(0x7fc00000u);
    }
    var power = 1.0;
    if (size != 1.0) & (b != 0.0) {
        power = pow(size, b);
    }
    return select(power, -power, odd & ((bitcast<u32>(a) >> 31u) == 1u));
}

// A derivative of the cubic with these coefficients, constant first, at t; the order is at most 3.
fn ppum_cubic(c: vec4<f32>, order: u32, t: f32) -> f32 {
    if order == 0u {
        return ((c.w * t + c.z) * t + c.y) * t + c.x;
    }
    if order == 1u {
        return (3.0 * c.w * t + 2.0 * c.z) * t + c.y;
    }
    if order == 2u {
        return 6.0 * c.w * t + 2.0 * c.z;
    }
    return 6.0 * c.w;
}
