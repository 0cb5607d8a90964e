//! Gauss–Legendre rules.

use std::sync::OnceLock;

/// Largest number of points of a [`gauss`] rule.
pub const MAX_POINTS: usize = 40;

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

/// The n-point rule, 1 ≤ n ≤ [`MAX_POINTS`]; all rules are computed once.
///
/// # Panics
/// If n is outside that range.
#[must_use]
pub fn gauss(n: usize) -> &'static GaussRule {
    static RULES: OnceLock<Vec<GaussRule>> = OnceLock::new();
    assert!((1..=MAX_POINTS).contains(&n), "no Gauss rule with {n} points");
    &RULES.get_or_init(|| (1..=MAX_POINTS).map(GaussRule::new).collect())[n - 1]
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
