//! Bivariate polynomials in the order of the dataset: by total degree, then descending power of ξ.

use crate::jet::Jet;
use ppum_formula::real::{LaneNumber, Real};

/// Highest polynomial degree of a block.
pub const MAX_DEGREE: usize = 8;

/// Number of monomials of total degree at most `degree`: (d + 1)(d + 2)/2.
#[must_use]
pub const fn monomials(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// The monomials of a polynomial.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum PolynomialSpace {
    /// P_d: those of total degree at most d, by total degree, then descending power of ξ.
    #[default]
    Total,
    /// Q_d: those of degree at most d in ξ and in η, powers of ξ fastest.
    Tensor,
}

impl PolynomialSpace {
    /// Number of monomials: (d + 1)(d + 2)/2 or (d + 1)².
    #[must_use]
    #[inline(always)]
    pub const fn size(self, degree: usize) -> usize {
        match self {
            Self::Total => monomials(degree),
            Self::Tensor => (degree + 1) * (degree + 1),
        }
    }
}

/// Σ c_k ξ^a η^b over all monomials of total degree at most `degree`, with derivatives by (ξ, η),
/// by nested Horner schemes: inner in ξ, outer in η.
#[inline(always)]
pub fn polynomial<R: Real, const D: usize>(
    coefficients: &[impl LaneNumber],
    degree: usize,
    xi: [R; 2],
) -> Jet<R> {
    nested::<R, D, false>(coefficients, degree, xi)
}

/// Σ c_k ξ^a η^b over the monomials of a space, with derivatives by (ξ, η): the loops of frequent
/// degrees are unrolled.
#[inline(always)]
pub fn polynomial_in<R: Real, const D: usize>(
    space: PolynomialSpace,
    coefficients: &[impl LaneNumber],
    degree: usize,
    xi: [R; 2],
) -> Jet<R> {
    match space {
        PolynomialSpace::Total => match degree {
            1 => nested::<R, D, false>(coefficients, 1, xi),
            2 => nested::<R, D, false>(coefficients, 2, xi),
            3 => nested::<R, D, false>(coefficients, 3, xi),
            4 => nested::<R, D, false>(coefficients, 4, xi),
            _ => nested::<R, D, false>(coefficients, degree, xi),
        },
        PolynomialSpace::Tensor => nested::<R, D, true>(coefficients, degree, xi),
    }
}

#[inline(always)]
fn nested<R: Real, const D: usize, const TENSOR: bool>(
    coefficients: &[impl LaneNumber],
    degree: usize,
    xi: [R; 2],
) -> Jet<R> {
    let mut jet = Jet::constant(xi[0].broadcast(0.0));
    let mut power = degree + 1;
    while power > 0 {
        power -= 1;
        let [p, px, pxx] = inner::<R, D, TENSOR>(coefficients, degree, power, xi[0]);
        jet = outer::<R, D>(jet, [p, px, pxx], xi[1]);
    }
    jet.yy = jet.yy + jet.yy;
    jet
}

/// The factor of η^`power`: Σ_a c ξ^a with its first two derivatives.
#[inline(always)]
fn inner<R: Real, const D: usize, const TENSOR: bool>(
    c: &[impl LaneNumber],
    degree: usize,
    power: usize,
    xi: R,
) -> [R; 3] {
    let zero = xi.broadcast(0.0);
    let (mut p, mut px, mut pxx) = (zero, zero, zero);
    let mut a = if TENSOR { degree + 1 } else { degree - power + 1 };
    while a > 0 {
        a -= 1;
        let index = if TENSOR { power * (degree + 1) + a } else { monomials(a + power) - 1 - a };
        if D >= 2 {
            pxx = pxx.mul_add(xi, px + px);
        }
        if D >= 1 {
            px = px.mul_add(xi, p);
        }
        p = p.mul_add(xi, zero.broadcast(c[index].to_f64()));
    }
    [p, px, pxx]
}

/// One outer Horner step; `yy` carries half the second derivative until the end.
#[inline(always)]
fn outer<R: Real, const D: usize>(mut j: Jet<R>, [p, px, pxx]: [R; 3], eta: R) -> Jet<R> {
    if D >= 2 {
        j.yy = j.yy.mul_add(eta, j.y);
        j.xy = j.xy.mul_add(eta, j.x);
        j.xx = j.xx.mul_add(eta, pxx);
    }
    if D >= 1 {
        j.y = j.y.mul_add(eta, j.v);
        j.x = j.x.mul_add(eta, px);
    }
    j.v = j.v.mul_add(eta, p);
    j
}

/// The exponents (a, b) of the monomials ξ^a η^b up to `degree`, in the order of the dataset.
pub fn exponents(degree: usize) -> impl Iterator<Item = (i32, i32)> {
    PolynomialSpace::Total.exponents(degree)
}

impl PolynomialSpace {
    /// The exponents (a, b) of the monomials ξ^a η^b up to a degree, in their order.
    pub fn exponents(self, degree: usize) -> impl Iterator<Item = (i32, i32)> {
        let d = degree as i32;
        let (total, tensor) = match self {
            Self::Total => (d, -1),
            Self::Tensor => (-1, d),
        };
        let tensor = (0..=tensor).flat_map(move |b| (0..=tensor).map(move |a| (a, b)));
        (0..=total).flat_map(|k| (0..=k).map(move |b| (k - b, b))).chain(tensor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn against_powers() {
        let (x, y) = (0.7f64, -0.4f64);
        let spaces = [PolynomialSpace::Total, PolynomialSpace::Tensor];
        for (degree, space) in (0..=8).flat_map(|degree| spaces.map(|space| (degree, space))) {
            let c: Vec<f64> = (0..space.size(degree)).map(|k| 1.0 / (k as f64 + 1.5)).collect();
            let jet = polynomial_in::<f64, 2>(space, &c, degree, [x, y]);
            let mut sum = [0.0; 6];
            for ((a, b), c) in space.exponents(degree).zip(&c) {
                let (fa, fb) = (f64::from(a), f64::from(b));
                let m = |da: i32, db: i32| {
                    let power = |z: f64, k: i32| if k < 0 { 0.0 } else { z.powi(k) };
                    c * power(x, a - da) * power(y, b - db)
                };
                for (s, term) in sum.iter_mut().zip([
                    m(0, 0),
                    fa * m(1, 0),
                    fb * m(0, 1),
                    fa * (fa - 1.0) * m(2, 0),
                    fa * fb * m(1, 1),
                    fb * (fb - 1.0) * m(0, 2),
                ]) {
                    *s += term;
                }
            }
            for (p, q) in [jet.v, jet.x, jet.y, jet.xx, jet.xy, jet.yy].into_iter().zip(sum) {
                assert!((p - q).abs() < 1e-13, "degree {degree}: {jet:?} {sum:?}");
            }
        }
    }

    #[test]
    fn order_of_the_monomials() {
        let order: Vec<_> = exponents(2).collect();
        assert_eq!(order, [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]);
        let order: Vec<_> = PolynomialSpace::Tensor.exponents(1).collect();
        assert_eq!(order, [(0, 0), (1, 0), (0, 1), (1, 1)]);
    }
}
