//! Unevaluated sums of two numbers, some 100 bits, where 53 do not do.

use crate::real::Double;

/// a + b exactly, where |a| ≥ |b| or a = 0 (Dekker 1971).
#[inline(always)]
pub(super) fn sum<R: Double>(a: R, b: R) -> [R; 2] {
    let high = a + b;
    [high, (a - high) + b]
}

/// a b exactly (Veltkamp, Dekker 1971).
#[inline(always)]
pub(super) fn product<R: Double>(a: R, b: R) -> [R; 2] {
    let ([a1, a2], [b1, b2]) = (halves(a), halves(b));
    let high = a * b;
    [high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2]
}

/// The product of two pairs.
#[inline(always)]
pub(super) fn product_of_pairs<R: Double>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    let [high, low] = product(a[0], b[0]);
    [high, low + (a[0] * b[1] + a[1] * b[0])]
}

/// The quotient of two pairs.
#[inline(always)]
pub(super) fn quotient<R: Double>(above: [R; 2], below: [R; 2]) -> [R; 2] {
    let q = above[0] / below[0];
    let [back, lost] = product(q, below[0]);
    let rest = ((above[0] - back) - lost) + (above[1] - q * below[1]);
    [q, rest / below[0]]
}

/// A number as the sum of two of 26 bits.
#[inline(always)]
pub(super) fn halves<R: Double>(a: R) -> [R; 2] {
    // 2²⁷ + 1
    let spread = a * a.broadcast(134_217_729.0);
    let high = spread - (spread - a);
    [high, a - high]
}
