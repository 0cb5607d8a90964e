//! How fast the Legendre coefficients of a local field decay.
//!
//! ```text
//! v_i = Σ c_kl P_k(x) P_l(y) on the cell        e_d² = Σ_{k+l=d} c_kl²        e_d ~ exp(−σ d)
//! ```
//!
//! Coefficients of analytic fields decay so with a rate σ, those of fields that are not smooth by
//! powers of d (Mavriplis 1994).

use ppum::dataset::{MAX_DEGREE, monomials};
use ppum::polynomial::exponents;

/// Rows a: x^a = Σ_k table\[a\]\[k\] P_k with Legendre polynomials of the norm 1 on \[−1, 1\].
type LegendreTable = [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1];

/// The powers in orthonormal Legendre polynomials: x P_k = b_k P_{k−1} + b_{k+1} P_{k+1} with
/// b_k = k / √(4 k² − 1).
fn powers() -> LegendreTable {
    let mut table = LegendreTable::default();
    table[0][0] = 2f64.sqrt();
    let b = |k: usize| k as f64 / ((4 * k * k) as f64 - 1.0).sqrt();
    for a in 1..=MAX_DEGREE {
        for k in 0..a {
            let c = table[a - 1][k];
            table[a][k + 1] += c * b(k + 1);
            if k > 0 {
                table[a][k - 1] += c * b(k);
            }
        }
    }
    table
}

/// The squares e_d² of a polynomial, d = 0 … degree; its monomials are in the order of the dataset,
/// of coordinates in which the cell is \[−s, s\]².
pub(super) fn squares(coefficients: &[f64], degree: usize, s: f64) -> Vec<f64> {
    let table = powers();
    let mut sums = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    for ((a, b), c) in exponents(degree).zip(&coefficients[..monomials(degree)]) {
        let (a, b) = (a as usize, b as usize);
        let c = c * s.powi((a + b) as i32);
        for (k, row) in sums.iter_mut().enumerate().take(a + 1) {
            for (l, sum) in row.iter_mut().enumerate().take(b + 1) {
                *sum += c * table[a][k] * table[b][l];
            }
        }
    }
    (0..=degree).map(|d| (0..=d).map(|k| sums[k][d - k].powi(2)).sum()).collect()
}

/// The rate σ of the decay of e_d, from their squares without that of degree 0: the slope of the
/// line nearest to ln e_d. Fields that are odd or even in something have small numbers in between,
/// so each one counts as much as the larger of it and the next. None of less than two degrees;
/// infinite of fields that are exact polynomials.
pub(super) fn rate(squares: &[f64]) -> Option<f64> {
    let p = squares.len().checked_sub(1)?;
    let largest = squares[1..].iter().fold(0.0f64, |m, e| m.max(*e));
    let envelope: Vec<f64> = match p {
        0 | 1 => return None,
        2 => squares[1..].to_vec(),
        _ => squares[1..].windows(2).map(|pair| pair[0].max(pair[1])).collect(),
    };
    if envelope.iter().any(|e| *e <= largest * f64::EPSILON) {
        return Some(f64::INFINITY);
    }
    let n = envelope.len() as f64;
    let mean = 0.5 * (n - 1.0);
    let (mut above, mut below) = (0.0, 0.0);
    for (d, e) in envelope.iter().enumerate() {
        above += (d as f64 - mean) * 0.5 * e.ln();
        below += (d as f64 - mean).powi(2);
    }
    Some(-above / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P_3(x) P_1(y) of norm 1: √(7/2) (5x³ − 3x)/2 · √(3/2) y.
    #[test]
    fn a_legendre_polynomial_is_one_number() {
        let norm = (3.5f64 * 1.5).sqrt();
        let mut coefficients = vec![0.0; monomials(4)];
        let at = |a: u32, b: u32| {
            exponents(4).position(|(i, j)| (i as u32, j as u32) == (a, b)).expect("a monomial")
        };
        // in coordinates twice as long
        coefficients[at(3, 1)] = 2.5 * norm * 16.0;
        coefficients[at(1, 1)] = -1.5 * norm * 4.0;
        let found = squares(&coefficients, 4, 0.5);
        for (d, e) in found.iter().enumerate() {
            let expected = if d == 4 { 1.0 } else { 0.0 };
            assert!((e - expected).abs() < 1e-13, "{found:?}");
        }
    }

    /// exp(−0.7 d), also where every other one is missing.
    #[test]
    fn rates_of_decay() {
        let squares = |step: usize| -> Vec<f64> {
            let e = |d: usize| if d.is_multiple_of(step) { (-1.4 * d as f64).exp() } else { 0.0 };
            (0..=8).map(e).collect()
        };
        assert!((rate(&squares(1)).expect("a rate") - 0.7).abs() < 1e-12);
        let found = rate(&squares(2)).expect("a rate");
        assert!((found - 0.7).abs() < 0.1, "{found}");
        assert_eq!(rate(&[1.0, 0.5]), None);
        assert_eq!(rate(&[1.0, 0.5, 0.0]), Some(f64::INFINITY));
    }
}
