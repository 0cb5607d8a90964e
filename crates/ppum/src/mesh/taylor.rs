//! Polynomials as seen from another point: P(at + δ) in powers of δ, with twice the digits.
//!
//! Near a crack's tip or an edge values are differences of coefficients that nearly cancel; formed
//! once with twice the digits, a view 10⁻¹⁵ of an element wide has no noise.

use crate::compensated::{SumWithError, plus, product};
use crate::dataset::MAX_DEGREE;
use crate::polynomial::PolynomialSpace;

const SIZE: usize = MAX_DEGREE + 1;

/// Coefficients of ξ^a η^b in the rows b and columns a.
pub(super) struct DensePolynomial {
    rows: [[SumWithError; SIZE]; SIZE],
    degree: usize,
}

impl DensePolynomial {
    pub(super) fn new(space: PolynomialSpace, degree: usize, coefficients: &[f64]) -> Self {
        let mut rows = [[(0.0, 0.0); SIZE]; SIZE];
        for ((a, b), &c) in space.exponents(degree).zip(coefficients) {
            rows[b as usize][a as usize] = (c, 0.0);
        }
        Self { rows, degree }
    }

    /// The coefficients in δ = ξ − at.
    pub(super) fn shift(&mut self, at: [f64; 2]) {
        let d = self.degree;
        for row in &mut self.rows[..=d] {
            shift(&mut row[..=d], at[0]);
        }
        for a in 0..=d {
            let mut column = [(0.0, 0.0); SIZE];
            (0..=d).for_each(|b| column[b] = self.rows[b][a]);
            shift(&mut column[..=d], at[1]);
            (0..=d).for_each(|b| self.rows[b][a] = column[b]);
        }
    }

    pub(super) fn constant(&self) -> SumWithError {
        self.rows[0][0]
    }

    pub(super) fn store(&self, space: PolynomialSpace, degree: usize, out: &mut [f64]) {
        for ((a, b), c) in space.exponents(degree).zip(out) {
            let (high, low) = self.rows[b as usize][a as usize];
            *c = high + low;
        }
    }
}

/// Repeated synthetic division (Horner 1819).
fn shift(c: &mut [SumWithError], at: f64) {
    for end in 0..c.len() {
        for k in (end..c.len() - 1).rev() {
            c[k] = plus(c[k], product((at, 0.0), c[k + 1]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::polynomial_in;
    use ppum_testkit::random::Random;

    /// Whole numbers: all sums are exact.
    #[test]
    fn shifted_polynomials_have_the_same_values() {
        let mut random = Random(5);
        for (degree, space) in (0..=8)
            .flat_map(|d| [PolynomialSpace::Total, PolynomialSpace::Tensor].map(|space| (d, space)))
        {
            let mut whole = || (random.unit() * 9.0).floor() - 4.0;
            let c: Vec<f64> = (0..space.size(degree)).map(|_| whole()).collect();
            let mut dense = DensePolynomial::new(space, degree, &c);
            dense.shift([2.0, -1.0]);
            let mut shifted = vec![0.0; c.len()];
            dense.store(space, degree, &mut shifted);
            for p in [[0.0, 0.0], [1.0, 1.0], [-1.0, 2.0]] {
                let value = |c: &[f64], p| polynomial_in::<f64, 0>(space, c, degree, p).v;
                assert_eq!(value(&shifted, p), value(&c, [p[0] + 2.0, p[1] - 1.0]), "{degree}");
            }
        }
    }

    /// (ξ − 1/3)⁸ at 1/3 + 2⁻³⁰, of which the expanded form keeps nothing in f64.
    #[test]
    fn nothing_cancels() {
        let third = 1.0 / 3.0;
        let mut c = [0.0; 9];
        let mut dense = DensePolynomial::new(PolynomialSpace::Tensor, 8, &[0.0; 81]);
        c[8] = 1.0;
        let mut row = c.map(|c| (c, 0.0));
        shift(&mut row, -third);
        dense.rows[0] = row;
        dense.shift([third, 0.0]);
        let largest = dense.rows[0][..8].iter().map(|(high, low)| (high + low).abs());
        assert!(largest.fold(0.0, f64::max) < 1e-28);
    }
}
