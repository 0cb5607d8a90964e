//! Elementary functions of double-double numbers, some 28 digits: series after plain reductions,
//! Newton's method for inverse functions. Slow, and in other terms than what is tested against it.

use super::DoubleDouble;

/// π/2 in parts whose products with whole numbers below 2²⁰ are exact.
const HALF_PI: [f64; 4] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_711_166_5e-21,
    8.478_427_660_368_9e-32,
];

/// ln 2 in parts whose products with exponents are exact.
const LN_2: [f64; 3] =
    [0.693_147_180_559_208_2, 7.371_002_565_161_996e-13, 5.802_988_983_595_690_5e-25];

/// x less n times the sum of some parts, which are added from the largest on.
fn less(x: DoubleDouble, n: f64, parts: &[f64]) -> DoubleDouble {
    parts.iter().fold(x, |rest, &part| rest - DoubleDouble::product(n, part))
}

/// Σ c_k x^k with c_0 = 1 and the ratios of coefficients that follow each other.
fn series(x: DoubleDouble, ratio: impl Fn(f64) -> DoubleDouble) -> DoubleDouble {
    let (mut term, mut sum) = (DoubleDouble::from(1.0), DoubleDouble::from(1.0));
    for k in 1..60 {
        term = term * x * ratio(f64::from(k));
        sum = sum + term;
    }
    sum
}

/// e^x as m and k: e^x = m 2^k with m near 1.
#[must_use]
pub fn exp(x: DoubleDouble) -> (DoubleDouble, i32) {
    let k = (x.to_f64() / std::f64::consts::LN_2).round();
    let r = less(x, k, &LN_2);
    (series(r, |k| DoubleDouble::from(1.0) / k), k as i32)
}

/// The natural logarithm of m 2^k, for m from ½ to 2.
#[must_use]
pub fn log(m: DoubleDouble, k: i32) -> DoubleDouble {
    let s = (m - 1.0) / (m + 1.0);
    // artanh s = s (1 + s²/3 + s⁴/5 + …)
    let artanh = s * series(s * s, |k| DoubleDouble::from(2.0 * k - 1.0) / (2.0 * k + 1.0));
    artanh * 2.0 - less(DoubleDouble::from(0.0), f64::from(k), &LN_2)
}

/// sinh x and cosh x for |x| ≤ 1.
#[must_use]
pub fn sinh_cosh(x: DoubleDouble) -> [DoubleDouble; 2] {
    let z = x * x;
    let even = |k: f64| DoubleDouble::from(1.0) / ((2.0 * k - 1.0) * (2.0 * k));
    let odd = |k: f64| DoubleDouble::from(1.0) / ((2.0 * k + 1.0) * (2.0 * k));
    [x * series(z, odd), series(z, even)]
}

/// sin x and cos x for |x| ≤ 10⁶.
#[must_use]
pub fn sin_cos(x: DoubleDouble) -> [DoubleDouble; 2] {
    let n = (x.to_f64() / std::f64::consts::FRAC_PI_2).round();
    let r = less(x, n, &HALF_PI);
    let z = -(r * r);
    let even = |k: f64| DoubleDouble::from(1.0) / ((2.0 * k - 1.0) * (2.0 * k));
    let odd = |k: f64| DoubleDouble::from(1.0) / ((2.0 * k + 1.0) * (2.0 * k));
    let (sin, cos) = (r * series(z, odd), series(z, even));
    match n.rem_euclid(4.0) as u8 {
        0 => [sin, cos],
        1 => [cos, -sin],
        2 => [-sin, -cos],
        _ => [-cos, sin],
    }
}

/// The angle of (x, y), which is not the origin, and whose lengths are numbers that may
/// be multiplied.
#[must_use]
pub fn angle(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    // turned back by a first guess it is small
    let guess = DoubleDouble::from(y.to_f64().atan2(x.to_f64()));
    let [sin, cos] = sin_cos(guess);
    let rest = (y * cos - x * sin) / (x * cos + y * sin);
    guess + (rest - rest * rest * rest / 3.0)
}

/// The cube root.
#[must_use]
pub fn cbrt(x: DoubleDouble) -> DoubleDouble {
    let y = DoubleDouble::from(x.to_f64().cbrt());
    let step = |y: DoubleDouble| y - (y * y * y - x) / (y * y * 3.0);
    step(step(y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_near(a: DoubleDouble, b: DoubleDouble) {
        let scale = 1.0 + b.to_f64().abs();
        assert!((a - b).to_f64().abs() < 1e-28 * scale, "{a:?} is not {b:?}");
    }

    /// Identities that do not hold by construction.
    #[test]
    fn identities() {
        for k in 1..200 {
            let x = DoubleDouble::from(f64::from(k)) / 37.0;
            let (m, n) = exp(x);
            assert_near(log(m, n), x);
            let [sin, cos] = sin_cos(x);
            assert_near(sin * sin + cos * cos, DoubleDouble::from(1.0));
            let [twice, _] = sin_cos(x + x);
            assert_near(twice, sin * cos * 2.0);
            let turn = DoubleDouble::sum(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);
            let expected = if x > turn { x - turn - turn } else { x };
            assert_near(angle(sin, cos), expected);
            let root = cbrt(x);
            assert_near(root * root * root, x);
            let [sinh, cosh] = sinh_cosh(x / 10.0);
            let (m, n) = exp(x / 10.0);
            assert_near(sinh + cosh, m * 2f64.powi(n));
        }
    }

    /// Digits from tables: e, ln 10, sin 1, π/4.
    #[test]
    fn known_digits() {
        let one = DoubleDouble::from(1.0);
        let (e, k) = exp(one);
        assert_near(
            e * 2f64.powi(k),
            DoubleDouble::sum(std::f64::consts::E, 1.445_646_891_729_250_2e-16),
        );
        let ln_10 = DoubleDouble::sum(std::f64::consts::LN_10, -2.170_756_223_382_249_4e-16);
        assert_near(log(DoubleDouble::from(1.25), 3), ln_10);
        let quarter = DoubleDouble::sum(std::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17);
        assert_near(angle(one, one), quarter);
    }
}
