//! Cube roots and hypotenuses.

use super::{polynomial, whole};
use crate::real::Double;

/// ∛m for 1 ≤ m ≤ 2, to 2⁻¹⁶.
const ROUGH: [f64; 5] = [
    0.506_979_406_179_682_8,
    0.718_153_856_168_756_3,
    -0.300_611_468_112_740_7,
    0.086_091_302_107_510_06,
    -0.010_603_888_355_016_066,
];

/// 2^⅓
const CUBE_ROOT_2: f64 = 1.259_921_049_894_873_2;

/// The cube root: a short number y near it, whose cube c is exact, and y (1 + d)^⅓ with d = (x −
/// c)/c.
#[inline(always)]
pub(super) fn cbrt<R: Double>(x: R) -> R {
    let (zero, one, third) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(1.0 / 3.0));
    let a = x.abs();
    let tiny = x.broadcast(1e-300).gt(a);
    let scaled = R::select(tiny, a * x.broadcast(f64::from_bits(0x4350_0000_0000_0000)), a);
    let e = scaled.exponent();
    let m = scaled * x.broadcast(0.5) * (one - e).power_of_two();
    // e = 3q + j
    let q = whole(e * third);
    let j = e - q * x.broadcast(3.0);
    let of_j = |up: f64, down: f64| {
        R::select(j.gt(zero), x.broadcast(up), R::select(zero.gt(j), x.broadcast(down), one))
    };
    let rough = polynomial(m, ROUGH) * of_j(CUBE_ROOT_2, 1.0 / CUBE_ROOT_2);
    // 2³⁶ + 1 leaves 17 bits
    let spread = rough * x.broadcast(68_719_476_737.0);
    let y = spread - (spread - rough);
    let cube = y * y * y;
    let d = (m * of_j(2.0, 0.5) - cube) / cube;
    let more = d * (third - d * (x.broadcast(1.0 / 9.0) - d * x.broadcast(5.0 / 81.0)));
    let q = q - R::select(tiny, x.broadcast(18.0), zero);
    let root = (y + y * more) * q.power_of_two();
    let is_plain = R::select(x.broadcast(f64::INFINITY).gt(a), one, zero);
    R::select(a.gt(zero), R::select(is_plain.gt(zero), root, a), a).copysign(x)
}

/// √(a² + b²) without overflow; ∞ if one is infinite, whatever the other.
#[inline(always)]
pub(super) fn hypot<R: Double>(a: R, b: R) -> R {
    let (one, infinity) = (a.broadcast(1.0), a.broadcast(f64::INFINITY));
    let (up, down) = (
        a.broadcast(f64::from_bits(0x6570_0000_0000_0000)),
        a.broadcast(f64::from_bits(0x1A70_0000_0000_0000)),
    );
    let (x, y) = (a.abs(), b.abs());
    let larger = x.max(y);
    let (large, small) = (larger.gt(a.broadcast(1e150)), a.broadcast(1e-150).gt(larger));
    let scale = R::select(large, down, R::select(small, up, one));
    let back = R::select(large, up, R::select(small, down, one));
    let (p, q) = (x * scale, y * scale);
    let root = (p * p + q * q).sqrt() * back;
    let root = R::select(x.ge(infinity), x, root);
    R::select(y.ge(infinity), y, root)
}
