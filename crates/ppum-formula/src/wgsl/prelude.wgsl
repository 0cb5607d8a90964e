// Functions that formulas in WGSL call: what the shading language has not, or defines otherwise
// than the language of formulas. A module needs this text once.
//
// Implementations may assume that there is neither NaN nor infinity. Where they do not, both go
// through these functions as IEEE 754 says; NaN is recognised by its bits, as `a != a` may be
// folded away.

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

// A number of [-9, 9] as it is. Compilers that replace k b + (k c + d) by k (b + c) + d do not
// where this stands around (k c + d).
fn ppum_apart(a: f32) -> f32 {
    return ppum_clamp(a, -9.0, 9.0);
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

// log(a) to two units of the last place, where WGSL promises 2^-21 near 1: a = 2^e (1 + x) with
// 1/sqrt(2) <= 1 + x < sqrt(2), the polynomial is the one of Cephes (Moshier 1992).
fn ppum_log(a: f32) -> f32 {
    if !((a >= 0x1p-126) & (a <= 3.4028234e38)) {
        return log(a);
    }
    // the bits of sqrt(1/2) are 0x3f3504f3
    let bits = bitcast<u32>(a) + (0x3f800000u - 0x3f3504f3u);
    let e = f32(bits >> 23u) - 127.0;
    let x = bitcast<f32>((bits & 0x7fffffu) + 0x3f3504f3u) - 1.0;
    let p = (((((((7.0376836292e-2 * x - 1.1514610310e-1) * x + 1.1676998740e-1) * x - 1.2420140846e-1) * x
        + 1.4249322787e-1) * x - 1.6668057665e-1) * x + 2.0000714765e-1) * x - 2.4999993993e-1) * x
        + 3.3333331174e-1;
    let z = x * x;
    // log(2) in two parts, the product with the first one is exact
    return x + (ppum_apart(x * z * p - e * 2.12194440e-4) - 0.5 * z) + e * 0.693359375;
}

fn ppum_log10(a: f32) -> f32 {
    return ppum_log(a) * 0.4342944819;
}

// e^a 2^n to two units of the last place, where WGSL promises 3 + 2|a|; n is whole, in [-8, 8].
// a = k log(2) + t with |t| <= log(2)/2, the polynomial is the one of Cephes (Moshier 1992).
fn ppum_exp_scaled(a: f32, n: f32) -> f32 {
    // beyond these bounds it is 0 or infinite
    let b = ppum_clamp(a, -110.0, 95.0);
    let k = floor(b * 1.44269504 + 0.5);
    // log(2) in two parts, the product with the first one is exact
    let t = ppum_apart(b - k * 0.693359375) + k * 2.12194440e-4;
    let p = ((((1.9875691500e-4 * t + 1.3981999507e-3) * t + 8.3334519073e-3) * t + 4.1665795894e-2) * t
        + 1.6666665459e-1) * t + 5.0000001201e-1;
    // powers of 2 by their bits, in two factors as one may not be a number
    let exponent = u32(k + n + 254.0);
    let half = exponent / 2u;
    return (p * t * t + t + 1.0) * bitcast<f32>(half << 23u) * bitcast<f32>((exponent - half) << 23u);
}

fn ppum_exp(a: f32) -> f32 {
    return ppum_exp_scaled(a, 0.0);
}

fn ppum_cosh(a: f32) -> f32 {
    let half = ppum_exp_scaled(abs(a), -1.0);
    return half + 0.25 / half;
}

fn ppum_sinh(a: f32) -> f32 {
    if abs(a) <= 1.0 {
        let s = a * a;
        return ((2.03721912945e-4 * s + 8.33028376239e-3) * s + 1.66667160211e-1) * s * a + a;
    }
    let half = ppum_exp_scaled(abs(a), -1.0);
    let size = half - 0.25 / half;
    return select(size, -size, a < 0.0);
}

fn ppum_tanh(a: f32) -> f32 {
    if abs(a) <= 0.625 {
        let s = a * a;
        let p = (((-5.70498872745e-3 * s + 2.06390887954e-2) * s - 5.37397155531e-2) * s + 1.33314422036e-1) * s
            - 3.33332819422e-1;
        return p * s * a + a;
    }
    let size = 1.0 - 2.0 / (ppum_exp(2.0 * ppum_min(abs(a), 10.0)) + 1.0);
    return select(size, -size, a < 0.0);
}

// The number of quarter turns nearest to a >= 2^13, mod 4, and the rest in quarter turns, to 3e-9
// (Payne and Hanek 1983).
fn ppum_far_quarters(a: f32) -> vec2<f32> {
    let bits = bitcast<u32>(a);
    let mantissa = (bits & 0x7fffffu) | 0x800000u;
    // a is mantissa times a power of 2: the digits of 2/pi that matter, from the one of weight 2 on
    let first = (bits >> 23u) - 120u;
    let word = first / 32u;
    // 0 and 192 binary digits of 2/pi behind the point; drivers are slow with arrays
    var digits = vec3<u32>(0u, 0xa2f9836eu, 0x4e441529u);
    if word > 0u { digits = vec3<u32>(0xa2f9836eu, 0x4e441529u, 0xfc2757d1u); }
    if word > 1u { digits = vec3<u32>(0x4e441529u, 0xfc2757d1u, 0xf534ddc0u); }
    if word > 2u { digits = vec3<u32>(0xfc2757d1u, 0xf534ddc0u, 0xdb629599u); }
    if word > 3u { digits = vec3<u32>(0xf534ddc0u, 0xdb629599u, 0x3c439041u); }
    let shift = first % 32u;
    let high = (digits.x << shift) | ((digits.y >> 1u) >> (31u - shift));
    let low = (digits.y << shift) | ((digits.z >> 1u) >> (31u - shift));
    // in units of 2^-30, mod 4
    let product = mantissa * high + u32(f32(mantissa) * (f32(low) * 0x1p-32));
    let count = (product + 0x20000000u) >> 30u;
    let rest = product & 0x3fffffffu;
    let signed = select(f32(rest), -f32(0x40000000u - rest), rest > 0x20000000u);
    return vec2<f32>(f32(count & 3u), signed * 0x1p-30);
}

// Sine and cosine; WGSL promises three digits, and none beyond [-pi, pi]. The angle is reduced to
// [-pi/4, pi/4], the polynomials are those of Cephes (Moshier 1992).
fn ppum_sin_cos(a: f32) -> vec2<f32> {
    let size = abs(a);
    var quarters = floor(size * 0.636619772 + 0.5);
    // pi/2 in three parts, the products with the first two are exact (Cody and Waite 1980)
    var t = ppum_apart(ppum_apart(size - quarters * 1.5703125) - quarters * 4.837512969971e-4)
        - quarters * 7.54978995489e-8;
    if size >= 8192.0 {
        let far = ppum_far_quarters(size);
        quarters = far.x;
        t = far.y * 1.57079633;
    }
    if size > 3.4028234e38 {
        t = ppum_from_bits(0x7fc00000u);
    }
    let s = t * t;
    let sine = ((-1.9515295891e-4 * s + 8.3321608736e-3) * s - 1.6666654611e-1) * s * t + t;
    let cosine = ((2.443315711809948e-5 * s - 1.388731625493765e-3) * s + 4.166664568298827e-2) * s * s
        - 0.5 * s + 1.0;
    let count = u32(quarters);
    let turned = select(vec2<f32>(sine, cosine), vec2<f32>(cosine, -sine), (count & 1u) == 1u);
    let opposite = select(turned, -turned, (count & 2u) == 2u);
    return vec2<f32>(select(opposite.x, -opposite.x, a < 0.0), opposite.y);
}

fn ppum_sin(a: f32) -> f32 {
    return ppum_sin_cos(a).x;
}

fn ppum_cos(a: f32) -> f32 {
    return ppum_sin_cos(a).y;
}

fn ppum_tan(a: f32) -> f32 {
    let sin_cos = ppum_sin_cos(a);
    return sin_cos.x / sin_cos.y;
}

// The arc sine of a in [-1/2, 1/2]: devices may have four digits. The polynomial is the one of
// Cephes (Moshier 1992).
fn ppum_near_asin(a: f32) -> f32 {
    let s = a * a;
    let p = (((4.2163199048e-2 * s + 2.4181311049e-2) * s + 4.5470025998e-2) * s + 7.4953002686e-2) * s
        + 1.6666752422e-1;
    return p * s * a + a;
}

fn ppum_asin(a: f32) -> f32 {
    if abs(a) <= 0.5 {
        return ppum_near_asin(a);
    }
    let angle = 1.57079633 - 2.0 * ppum_near_asin(sqrt(0.5 - 0.5 * abs(a)));
    return select(angle, -angle, a < 0.0);
}

fn ppum_acos(a: f32) -> f32 {
    if abs(a) <= 0.5 {
        return 1.57079633 - ppum_near_asin(a);
    }
    let angle = 2.0 * ppum_near_asin(sqrt(0.5 - 0.5 * abs(a)));
    return select(angle, 3.14159265 - angle, a < 0.0);
}

// The arc tangent to single precision: that of devices may have four digits. tan(3π/8) and tan(π/8)
// part the range; the polynomial is the one of Cephes (Moshier 1992).
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

// sqrt(a^2 + b^2) without overflow; infinite if a or b is. No product of powers of two scales a and
// b: compilers for cards form such constants first, as 2^100 * 2^100, which is infinite.
fn ppum_hypot(a: f32, b: f32) -> f32 {
    if abs(a) > 3.4028234e38 {
        return abs(a);
    }
    if abs(b) > 3.4028234e38 {
        return abs(b);
    }
    let is_wide = abs(a) > abs(b);
    let larger = select(abs(b), abs(a), is_wide);
    let smaller = select(abs(a), abs(b), is_wide);
    // nothing, or not a number
    if !(larger > 0.0) {
        return larger + smaller;
    }
    // quotients by numbers from 2^126 on may be 0
    let scale = select(1.0, 0x1p-60, larger > 0x1p60);
    let slope = (smaller * scale) / (larger * scale);
    return larger * sqrt(1.0 + slope * slope);
}

// a^b as of `pow` of IEEE 754: of a negative number only if b is whole, which pow of WGSL does not
// promise.
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

// The cubic with these coefficients, constant first, and its derivatives at t.
fn ppum_cubic(c: vec4<f32>, t: f32) -> vec4<f32> {
    let value = ((c.w * t + c.z) * t + c.y) * t + c.x;
    return vec4<f32>(value, (3.0 * c.w * t + 2.0 * c.z) * t + c.y, 6.0 * c.w * t + 2.0 * c.z, 6.0 * c.w);
}

// The value and derivatives, these being 0 where the argument is beyond the knots by some distance.
fn ppum_inside(derivatives: vec4<f32>, beyond: f32) -> vec4<f32> {
    let outside = (beyond < 0.0) | (beyond > 0.0);
    return select(derivatives, vec4<f32>(derivatives.x, 0.0, 0.0, 0.0), outside);
}

// A curve: the cubic at a distance from a knot.
fn ppum_curve(c: vec4<f32>, beyond: f32, t: f32) -> vec4<f32> {
    return ppum_inside(ppum_cubic(c, t), beyond);
}

// A surface: the bicubic whose rows belong to powers of the distance in y; [order in y][order
// in x].
fn ppum_surface(rows: array<vec4<f32>, 4>, beyond: vec2<f32>, t: vec2<f32>) -> array<vec4<f32>, 4> {
    let a = ppum_cubic(rows[0], t.x);
    let b = ppum_cubic(rows[1], t.x);
    let c = ppum_cubic(rows[2], t.x);
    let d = ppum_cubic(rows[3], t.x);
    let outside = (beyond.y < 0.0) | (beyond.y > 0.0);
    let y = select((3.0 * d * t.y + 2.0 * c) * t.y + b, vec4<f32>(), outside);
    let yy = select(6.0 * d * t.y + 2.0 * c, vec4<f32>(), outside);
    let yyy = select(6.0 * d, vec4<f32>(), outside);
    return array<vec4<f32>, 4>(
        ppum_inside(((d * t.y + c) * t.y + b) * t.y + a, beyond.x),
        ppum_inside(y, beyond.x),
        ppum_inside(yy, beyond.x),
        ppum_inside(yyy, beyond.x),
    );
}
