//! Zeros of a function of one variable.

/// Steps an interval is divided into to find sign changes.
const STEPS: usize = 16;

/// Most evaluations to find a zero that touches or nearly touches between two samples.
const TOUCHES: usize = 8;

/// Most evaluations for one zero. Chandrupatla's method needs about eight for smooth functions,
/// bisection alone 60.
const EVALUATIONS: usize = 120;

/// Values of a level function below this part of its size are zero.
pub(super) const ZERO: f64 = 1e-14;

/// A function value that is a number: what is not, or is infinite, still has a side.
pub(crate) fn clamp_non_finite(value: f64) -> f64 {
    if value.is_nan() { 1.0 } else { value.clamp(-1e100, 1e100) }
}

/// Zeros of `f` in the open interval at which it changes its sign, ascending, as far as samples at
/// equal distances and the extrema between them show them.
pub(crate) fn sign_changes(f: &dyn Fn(f64) -> f64, lo: f64, hi: f64) -> Vec<f64> {
    let at = |k: usize| lo + (hi - lo) * (k as f64 / STEPS as f64);
    let mut samples: Vec<[f64; 2]> =
        (0..=STEPS).map(|k| [at(k), f(at(k))]).filter(|s| s[1] != 0.0).collect();
    let touching: Vec<[f64; 2]> = samples.windows(3).filter_map(|t| beyond_zero(f, t)).collect();
    samples.extend(touching);
    samples.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let changes = samples.windows(2).filter(|s| s[0][1] * s[1][1] < 0.0);
    changes.map(|s| zero(f, s[0], s[1])).collect()
}

/// A point between three samples of one sign at which the function has the other sign: looked for
/// where the samples come nearest to zero, by parabolas through three points.
fn beyond_zero(f: &dyn Fn(f64) -> f64, samples: &[[f64; 2]]) -> Option<[f64; 2]> {
    let sign = samples[1][1].signum();
    let nearest = |s: &[[f64; 2]]| s[1][1].abs() <= s[0][1].abs().min(s[2][1].abs());
    if samples.iter().any(|s| s[1] * sign < 0.0) || !nearest(samples) {
        return None;
    }
    let mut three = [samples[0], samples[1], samples[2]];
    for _ in 0..TOUCHES {
        let x = vertex(&three);
        if !(x > three[0][0] && x < three[2][0]) || x == three[1][0] {
            return None;
        }
        let sample = [x, f(x)];
        if sample[1] * sign < 0.0 {
            return Some(sample);
        }
        three = narrowed(three, sample);
    }
    None
}

/// Abscissa of the extremum of the parabola through three points.
fn vertex(&[[a, fa], [b, fb], [c, fc]]: &[[f64; 2]; 3]) -> f64 {
    let (left, right) = ((b - a) * (fb - fc), (b - c) * (fb - fa));
    b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right)
}

/// The three of four samples around the one nearest to zero.
fn narrowed([a, b, c]: [[f64; 2]; 3], x: [f64; 2]) -> [[f64; 2]; 3] {
    let nearer = x[1].abs() <= b[1].abs();
    match (x[0] < b[0], nearer) {
        (true, true) => [a, x, b],
        (true, false) => [x, b, c],
        (false, true) => [b, x, c],
        (false, false) => [a, b, x],
    }
}

/// The zero between two samples (x, f(x)) of different signs, to rounding: inverse quadratic
/// interpolation where it is safe, else bisection (Chandrupatla, Advances in Engineering Software
/// 28 (1997)).
pub(crate) fn zero(f: &dyn Fn(f64) -> f64, start: [f64; 2], end: [f64; 2]) -> f64 {
    let (mut one, mut two) = (end, start);
    let mut part = 0.5;
    for _ in 0..EVALUATIONS {
        let x = one[0] + part * (two[0] - one[0]);
        let now = [x, f(x)];
        let three;
        if now[1].signum() == one[1].signum() {
            three = one;
        } else {
            (three, two) = (two, one);
        }
        one = now;
        let best = if one[1].abs() < two[1].abs() { one } else { two };
        let least = f64::EPSILON * (best[0].abs() + 0.5 * (end[0] - start[0]).abs());
        let least = least / (two[0] - one[0]).abs();
        if least > 0.5 || best[1] == 0.0 {
            return best[0];
        }
        part = interpolated(one, two, three).unwrap_or(0.5).clamp(least, 1.0 - least);
    }
    one[0]
}

/// Zero of the inverse quadratic interpolation between the first two samples, as a part of
/// the way between them; none where the inverse may have an extremum.
fn interpolated([x1, f1]: [f64; 2], [x2, f2]: [f64; 2], [x3, f3]: [f64; 2]) -> Option<f64> {
    let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
    let part = f1 / (f2 - f1) * (f3 / (f2 - f3))
        + (x3 - x1) / (x2 - x1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2));
    (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi && part.is_finite()).then_some(part)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_zeros(f: &dyn Fn(f64) -> f64, expected: &[f64]) {
        let found = sign_changes(f, 0.0, 1.0);
        assert_eq!(found.len(), expected.len(), "{found:?} instead of {expected:?}");
        for (x, y) in found.iter().zip(expected) {
            assert!((x - y).abs() < 4e-16, "{x} instead of {y}");
        }
    }

    #[test]
    fn zeros_are_found_to_rounding() {
        assert_zeros(&|x| x * x - 0.3, &[0.3_f64.sqrt()]);
        assert_zeros(&|x| (x - 0.4).powi(3), &[0.4]);
        assert_zeros(&|x| (x - 0.5).signum(), &[0.5]);
        assert_zeros(&|x| x.exp() - 2.0, &[2.0_f64.ln()]);
        assert_zeros(&|x| clamp_non_finite(1.0 / (0.7 - x)), &[0.7]);
    }

    #[test]
    fn pairs_between_samples_are_found() {
        let (c, d) = (0.531, 1e-5);
        assert_zeros(&|x| (x - c).powi(2) - d * d, &[c - d, c + d]);
        assert_zeros(&|x| (x - c) * (c + d - x) * (1.0 + x) * x.exp(), &[c, c + d]);
    }

    #[test]
    fn zeros_without_a_change_of_sign_and_at_ends_are_none() {
        assert_zeros(&|x| (x - 0.5).powi(2), &[]);
        assert_zeros(&|x| x * (1.0 - x), &[]);
        assert_zeros(&|_| 0.0, &[]);
        assert_zeros(&|_| clamp_non_finite(f64::NAN), &[]);
    }

    #[test]
    fn few_evaluations_are_needed() {
        let count = std::cell::Cell::new(0);
        let f = |x: f64| {
            count.set(count.get() + 1);
            (x * x - 0.3) * (x + 2.0)
        };
        zero(&f, [0.0, f(0.0)], [1.0, f(1.0)]);
        assert!(count.get() <= 12, "{} evaluations", count.get());
    }
}
