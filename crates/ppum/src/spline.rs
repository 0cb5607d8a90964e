//! Cubic splines through points: two continuous derivatives, so that tangent and curvature
//! are continuous.

use crate::vec2::Vec2;

/// A cubic spline through points, over the length of its chords; periodic if closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    points: Vec<Vec2>,
    /// Length of the chord after each point.
    chords: Vec<f64>,
    /// Second derivatives at the points.
    bends: Vec<Vec2>,
}

impl Spline {
    /// From the first point to the last; three points or more, no two successive ones equal. At the
    /// second point and the last but one the third derivative is continuous, too ("not a knot"):
    /// without curvature at its ends, as natural splines are, it would miss the tangents there, and
    /// K with them.
    #[must_use]
    pub fn open(points: &[Vec2]) -> Self {
        let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).length()).collect();
        let inner = points.len() - 2;
        let row = |k: usize| (chords[k], 2.0 * (chords[k] + chords[k + 1]), chords[k + 1]);
        let mut rows: Vec<_> = (0..inner).map(row).collect();
        let right: Vec<Vec2> = (0..inner).map(|k| slope_jump(points, &chords, k)).collect();
        if let [(before, middle, after)] = &mut rows[..] {
            // a parabola
            *middle += *before + *after;
        } else {
            let (before, middle, after) = &mut rows[0];
            (*middle, *after) = run_out(*middle, *after, *before);
            let (before, middle, after) = &mut rows[inner - 1];
            (*middle, *before) = run_out(*middle, *before, *after);
        }
        let own = tridiagonal(&rows, &right);
        let [first, last] = match inner {
            1 => [own[0]; 2],
            _ => [
                beyond([own[0], own[1]], chords[0] / chords[1]),
                beyond([own[inner - 1], own[inner - 2]], chords[inner] / chords[inner - 1]),
            ],
        };
        let bends = [vec![first], own, vec![last]].concat();
        Self { points: points.to_vec(), chords, bends }
    }

    /// Through all points and back to the first one; three points or more, no two successive
    /// ones equal.
    #[must_use]
    pub fn closed(points: &[Vec2]) -> Self {
        let n = points.len();
        let round: Vec<Vec2> = (0..n + 2).map(|k| points[k % n]).collect();
        let chords: Vec<f64> = round.windows(2).map(|p| (p[1] - p[0]).length()).collect();
        // the unknown bend at point 0 couples to both ends of the others: two solutions, and their
        // sum that closes
        let row = |k: usize| (chords[k], 2.0 * (chords[k] + chords[k + 1]), chords[k + 1]);
        let rows: Vec<_> = (0..n - 1).map(row).collect();
        let right: Vec<Vec2> = (0..n - 1).map(|k| slope_jump(&round, &chords, k)).collect();
        let mut unit = vec![Vec2::ZERO; n - 1];
        unit[0] = unit[0] + Vec2 { x: -chords[0], y: -chords[0] };
        unit[n - 2] = unit[n - 2] + Vec2 { x: -chords[n - 1], y: -chords[n - 1] };
        let (own, of_first) = (tridiagonal(&rows, &right), tridiagonal(&rows, &unit));
        let (_, middle, _) = row(n - 1);
        let rest =
            slope_jump(&round, &chords, n - 1) - own[n - 2] * chords[n - 1] - own[0] * chords[n];
        let factor = middle + of_first[n - 2].x * chords[n - 1] + of_first[0].x * chords[n];
        let first = rest / factor;
        let mut bends = vec![first];
        bends.extend((0..n - 1).map(|k| own[k] + first * of_first[k].x));
        bends.push(first);
        Self { points: round[..=n].to_vec(), chords: chords[..n].to_vec(), bends }
    }

    /// Number of its spans, between successive points.
    #[must_use]
    pub fn spans(&self) -> usize {
        self.chords.len()
    }

    /// Place and two derivatives at a parameter, whole numbers at the points; per span, so that
    /// lengths of derivatives jump.
    #[must_use]
    pub fn at(&self, t: f64) -> [Vec2; 3] {
        let k = (t.max(0.0) as usize).min(self.spans() - 1);
        let (s, h) = (t - k as f64, self.chords[k]);
        let ([a, b], [p, q]) =
            ([k, k + 1].map(|k| self.points[k]), [k, k + 1].map(|k| self.bends[k] * (h * h)));
        let r = 1.0 - s;
        let at = a * r + b * s - p * (r * (1.0 - r * r) / 6.0) - q * (s * (1.0 - s * s) / 6.0);
        let first = b - a + p * ((1.0 - 3.0 * r * r) / 6.0) - q * ((1.0 - 3.0 * s * s) / 6.0);
        [at, first, p * r + q * s]
    }
}

/// The bend at an end of the chord in whose other end the bend is `near`, on the line through the
/// next one.
fn beyond([near, next]: [Vec2; 2], ratio: f64) -> Vec2 {
    near + (near - next) * ratio
}

/// The coefficients of an end's first two inner bends, with the end's own, that of `chord`,
/// expressed by them.
fn run_out(middle: f64, next: f64, chord: f64) -> (f64, f64) {
    let ratio = chord / next;
    (middle + chord * (1.0 + ratio), next - chord * ratio)
}

/// Six times the jump of the chords' slopes at the point after number `k`.
fn slope_jump(points: &[Vec2], chords: &[f64], k: usize) -> Vec2 {
    let slope = |k: usize| (points[k + 1] - points[k]) / chords[k];
    (slope(k + 1) - slope(k)) * 6.0
}

/// Solves a diagonally dominant tridiagonal system with rows (below, diagonal, above).
fn tridiagonal(rows: &[(f64, f64, f64)], right: &[Vec2]) -> Vec<Vec2> {
    let mut above = vec![0.0; rows.len()];
    let mut found = vec![Vec2::ZERO; rows.len()];
    let (mut factor, mut value) = (0.0, Vec2::ZERO);
    for (k, (below, diagonal, next)) in rows.iter().enumerate() {
        let pivot = diagonal - below * factor;
        value = (right[k] - value * *below) / pivot;
        factor = next / pivot;
        (above[k], found[k]) = (factor, value);
    }
    for k in (0..rows.len().saturating_sub(1)).rev() {
        found[k] = found[k] - found[k + 1] * above[k];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;

    /// Random points: the spline passes through them; tangent and curvature (by the length of
    /// chords) are continuous.
    #[test]
    fn two_derivatives_are_continuous() {
        let mut random = Random(9);
        for round in 0..40 {
            let points: Vec<Vec2> = (0..3 + round % 5)
                .map(|_| vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0)))
                .collect();
            for (spline, is_closed) in
                [(Spline::open(&points), false), (Spline::closed(&points), true)]
            {
                let n = spline.spans();
                let by_length = |t: f64, k: usize| {
                    let [at, first, second] = spline.at(t);
                    [at, first / spline.chords[k], second / (spline.chords[k] * spline.chords[k])]
                };
                let joints = if is_closed { 0..n } else { 1..n };
                for k in joints {
                    let before = by_length(
                        if k == 0 { n as f64 } else { k as f64 - 1e-12 },
                        (k + n - 1) % n,
                    );
                    let after = by_length(k as f64, k);
                    for (a, b) in before.iter().zip(&after) {
                        let size = 1.0 + b.length();
                        assert!((*a - *b).length() < 1e-8 * size * size, "{k} of {n}: {a:?} {b:?}");
                    }
                }
                assert!((0..n).all(|k| (spline.at(k as f64)[0] - points[k]).length() < 1e-15));
            }
        }
    }

    /// Through points of a circle the tangents at the ends are those of the circle, to third order.
    #[test]
    fn tangents_at_the_ends() {
        let error = |n: u32| {
            let at = |k: u32| 1.7 * f64::from(k) / f64::from(n);
            let points: Vec<_> = (0..=n).map(|k| vec2(at(k).cos(), at(k).sin())).collect();
            let spline = Spline::open(&points);
            let [from, to] = [0.0, f64::from(n)].map(|t| spline.at(t)[1].unit());
            from.x.abs().max(to.dot(points[n as usize]).abs())
        };
        let errors = [3, 6, 12, 24].map(error);
        assert!(errors[3] < 1e-4 && errors.windows(2).all(|e| e[1] < 0.2 * e[0]), "{errors:?}");
    }

    /// Derivatives are those of the places.
    #[test]
    fn derivatives() {
        let points = [[0.0, 0.0], [0.4, 0.3], [1.0, 0.1], [1.2, -0.4]].map(Vec2::from);
        let spline = Spline::open(&points);
        for t in [0.3, 1.1, 1.9, 2.4] {
            let [_, first, second] = spline.at(t);
            let [before, _, after] = [-1e-4, 0.0, 1e-4].map(|d| spline.at(t + d));
            let difference = (after[0] - before[0]) / 2e-4;
            assert!((difference - first).length() < 1e-7, "{difference:?} {first:?}");
            let difference = (after[1] - before[1]) / 2e-4;
            assert!((difference - second).length() < 1e-7, "{difference:?} {second:?}");
        }
    }
}
