//! Gauss–Legendre rules, and rules with points at the ends to compare them with.

use std::sync::OnceLock;

/// Largest number of points of a [`gauss`] rule.
pub(crate) const MAX_POINTS: usize = 40;

/// The n-point Gauss–Legendre rule on \[−1, 1\], exact for polynomials of degree 2n − 1.
#[derive(Clone, Debug)]
pub struct GaussRule {
    /// Nodes in ascending order, zeros of the Legendre polynomial P_n.
    pub nodes: Vec<f64>,
    /// Quadrature weights w = 2 / ((1 − x²) P_n′(x)²).
    pub weights: Vec<f64>,
}

impl GaussRule {
    /// Newton iteration from Tricomi's starting values; the rule is symmetric to the last bit.
    fn new(n: usize) -> Self {
        let (mut nodes, mut weights) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n.div_ceil(2) {
            let (mut x, w) = zero(n, i);
            if 2 * i + 1 == n {
                x = 0.0;
            }
            (nodes[i], nodes[n - 1 - i]) = (-x, x);
            (weights[i], weights[n - 1 - i]) = (w, w);
        }
        Self { nodes, weights }
    }

    /// Nodes and weights of the rule moved to \[lo, hi\].
    pub fn on(&self, lo: f64, hi: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (mid, half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
        self.nodes.iter().zip(&self.weights).map(move |(x, w)| (mid + half * x, half * w))
    }
}

/// Rules by the number of points of the Gauss rule that is as exact: [`gauss`] or [`closed`].
pub(super) type Rules1d = fn(usize) -> &'static GaussRule;

/// The i-th largest zero of P_n and its Gauss weight.
fn zero(n: usize, i: usize) -> (f64, f64) {
    let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    let mut slope = 0.0;
    for _ in 0..8 {
        let value;
        (value, slope) = legendre(n, x);
        x -= value / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n(x) and P_n′(x) by the three-term recurrence, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    (value, n as f64 * (before - x * value) / (1.0 - x * x))
}

/// The n-point rule, 1 ≤ n ≤ `MAX_POINTS`; all rules are computed once.
///
/// # Panics
/// If n is outside that range.
#[must_use]
pub fn gauss(n: usize) -> &'static GaussRule {
    static RULES: OnceLock<Vec<GaussRule>> = OnceLock::new();
    assert!((1..=MAX_POINTS).contains(&n), "no Gauss rule with {n} points");
    &RULES.get_or_init(|| (1..=MAX_POINTS).map(GaussRule::new).collect())[n - 1]
}

/// Distance of the outermost points of a closed rule from the ends, as a part of the interval: on
/// the right side of a jump at the end, whatever rounding does to coordinates.
const INSET: f64 = 1e-6;

/// A rule with n + 1 points, 1 ≤ n ≤ `MAX_POINTS`, two of them as good as at the ends, and exact
/// to 1e-12 where the Gauss rule with n points is exact. It sees what happens there, which Gauss
/// rules do not.
///
/// The Lobatto rule on the interval without its outermost millionths, whose share is given to the
/// points at their inner ends.
pub fn closed(n: usize) -> &'static GaussRule {
    static RULES: OnceLock<Vec<GaussRule>> = OnceLock::new();
    assert!((1..=MAX_POINTS).contains(&n), "no closed rule for {n} points");
    &RULES.get_or_init(|| (1..=MAX_POINTS).map(lobatto_inside).collect())[n - 1]
}

fn lobatto_inside(n: usize) -> GaussRule {
    let GaussRule { mut nodes, mut weights } = lobatto(n);
    let part = 1.0 - 2.0 * INSET;
    nodes.iter_mut().for_each(|x| *x *= part);
    weights.iter_mut().for_each(|w| *w *= part);
    weights[0] += 2.0 * INSET;
    weights[n] += 2.0 * INSET;
    GaussRule { nodes, weights }
}

/// The Lobatto rule on \[−1, 1\] with n + 1 points, ±1 and the zeros of P_n′, and the weights 2 /
/// (n (n + 1) P_n(x)²). Newton iteration from the extrema of the Chebyshev polynomial, with P_n″
/// from Legendre's equation.
fn lobatto(n: usize) -> GaussRule {
    let order = n as f64;
    let mut nodes: Vec<f64> =
        (0..=n).map(|i| -(std::f64::consts::PI * i as f64 / order).cos()).collect();
    for x in &mut nodes[1..n] {
        for _ in 0..8 {
            let (value, slope) = legendre(n, *x);
            let bend = (2.0 * *x * slope - order * (order + 1.0) * value) / (1.0 - *x * *x);
            *x -= slope / bend;
        }
    }
    let value = |&x: &f64| if x.abs() < 1.0 { legendre(n, x).0 } else { 1.0 };
    let weights = nodes.iter().map(|x| 2.0 / (order * (order + 1.0) * value(x).powi(2))).collect();
    GaussRule { nodes, weights }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_exact_to_rounding() {
        for n in 1..=MAX_POINTS {
            for degree in 0..2 * n {
                let sum: f64 = gauss(n).on(0.0, 1.0).map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = 1.0 / (degree as f64 + 1.0);
                assert!((sum - exact).abs() < 2e-15, "n = {n}, degree {degree}: {sum} {exact}");
            }
        }
    }

    #[test]
    fn closed_rules_have_the_degree_of_gauss_rules_and_points_at_the_ends() {
        for n in 1..=MAX_POINTS {
            let rule = closed(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.on(0.0, 1.0).map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = 1.0 / (degree as f64 + 1.0);
                let tolerance = 2e-15 + INSET * INSET * degree as f64;
                assert!((sum - exact).abs() < tolerance, "n = {n}, degree {degree}: {sum} {exact}");
            }
            assert!(rule.nodes[0] < -1.0 + 3e-6 && rule.nodes[n] > 1.0 - 3e-6);
            assert!(rule.nodes[0] > -1.0 && rule.nodes[n] < 1.0);
        }
    }

    #[test]
    fn degree_2n_is_not_exact() {
        let sum: f64 = gauss(3).on(-1.0, 1.0).map(|(x, w)| w * x.powi(6)).sum();
        assert!((sum - 2.0 / 7.0).abs() > 1e-3);
    }

    #[test]
    fn five_point_nodes_are_the_closed_form() {
        let inner = (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
        assert!((gauss(5).nodes[3] - inner).abs() < 1e-16);
        assert!((gauss(5).weights[2] - 128.0 / 225.0).abs() < 1e-15);
    }
}
