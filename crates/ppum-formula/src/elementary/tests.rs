//! Elementary functions against extended precision, and vectors against single numbers.

use ppum_testkit::extended::{DoubleDouble as Extended, elementary as extended};
use ppum_testkit::random::Random;

use super::*;
use crate::real::{LaneJob, Real, levels};

/// Results by the names of instruction sets.
type ResultsBySimd = Vec<(&'static str, Vec<f64>)>;

/// A function of one or two numbers with what it is tested against.
struct ElementaryCase {
    name: &'static str,
    /// Largest error allowed, units in the last place: above what some ten thousand points
    /// have shown.
    bound: f64,
    /// Random and hard arguments.
    points: fn(&mut Random) -> [f64; 2],
    /// The result as m 2^k, if the arguments have one that is no matter of special rules.
    exact: fn([f64; 2]) -> (Extended, i32),
    /// std's function, for rules and for comparison.
    std: fn([f64; 2]) -> f64,
    run: fn(&[[f64; 2]]) -> ResultsBySimd,
}

/// Results on all instruction sets.
#[derive(Clone, Copy)]
struct Apply<'a, F, const N: usize>(F, &'a [[f64; 2]]);

impl<F: DoubleFunction<N>, const N: usize> LaneJob<f64> for Apply<'_, F, N> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) -> Vec<f64> {
        let mut results = vec![0.0; self.1.len().next_multiple_of(8)];
        for (points, results) in self.1.chunks(R::LANES).zip(results.chunks_mut(R::LANES)) {
            let at = |k: usize, i: usize| points[k.min(points.len() - 1)][i];
            let mut operands = [zero; N];
            for (i, operand) in operands.iter_mut().enumerate() {
                *operand = zero.with_lanes(|k| at(k, i));
            }
            R::via_f64(operands, self.0).store(results);
        }
        results.truncate(self.1.len());
        results
    }
}

/// A number of any magnitude between powers of two.
fn any(random: &mut Random, low: f64, high: f64) -> f64 {
    let sign = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
    let exponent = random.between(low, high);
    let whole = exponent.floor();
    let half = (whole / 2.0).floor();
    sign * (1.0 + random.unit()) * half.exp2() * (whole - half).exp2()
}

/// The number some bits further, the last place being the first.
fn beside(x: f64, random: &mut Random) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add(random.bits() % 7).wrapping_sub(3))
}

fn wide(random: &mut Random) -> [f64; 2] {
    [(); 2].map(|()| any(random, -1074.0, 1023.9))
}

fn circular_points(random: &mut Random) -> [f64; 2] {
    let x = match random.below(4) {
        0 => random.between(-10.0, 10.0),
        1 => random.between(-1e5, 1e5),
        2 => any(random, -1074.0, 19.9),
        _ => {
            let turns = random.below(600_000) as f64;
            beside(turns * std::f64::consts::FRAC_PI_2, random)
        }
    };
    [x, 0.0]
}

fn exponential_points(random: &mut Random) -> [f64; 2] {
    let x = match random.below(5) {
        0 => random.between(-745.2, -707.0),
        1 => random.between(-1.0, 1.0),
        2 => random.between(-3.0, 3.0),
        3 => any(random, -1074.0, 9.4),
        _ => random.between(-745.0, 709.78),
    };
    [x, 0.0]
}

fn hyperbolic_points(random: &mut Random) -> [f64; 2] {
    let [x, _] = exponential_points(random);
    [x.clamp(-710.4, 710.4), 0.0]
}

fn logarithm_points(random: &mut Random) -> [f64; 2] {
    let x = match random.below(3) {
        0 => any(random, -1074.0, 1023.9).abs(),
        1 => random.between(0.5, 2.0),
        _ => 1.0 + any(random, -52.0, -1.0) * 0.9,
    };
    [x, 0.0]
}

fn inverse_points(random: &mut Random) -> [f64; 2] {
    let x = match random.below(4) {
        0 => random.between(-1.0, 1.0),
        1 => any(random, -1074.0, -0.1).clamp(-1.0, 1.0),
        2 => 1.0 - any(random, -53.0, -2.0).abs(),
        _ => random.between(0.49, 0.51),
    };
    [x, 0.0]
}

fn tangent_points(random: &mut Random) -> [f64; 2] {
    let x = match random.below(4) {
        0 => random.between(-3.0, 3.0),
        1 => any(random, -1074.0, 1023.9),
        2 => random.between(0.40, 0.43),
        _ => random.between(2.3, 2.5),
    };
    [x, 0.0]
}

fn plane_points(random: &mut Random) -> [f64; 2] {
    match random.below(3) {
        0 => wide(random),
        1 => [(); 2].map(|()| any(random, -10.0, 10.0)),
        _ => [(); 2].map(|()| random.between(-1.0, 1.0)),
    }
}

fn power_points(random: &mut Random) -> [f64; 2] {
    match random.below(5) {
        0 => [any(random, -1074.0, 1023.9).abs(), random.between(-1.0, 1.0)],
        1 => [random.between(0.1, 10.0), random.between(-300.0, 300.0)],
        2 => [1.0 + any(random, -50.0, -2.0) * 0.9, any(random, 0.0, 50.0)],
        3 => [random.between(-10.0, -0.1), random.between(-300.0, 300.0).round()],
        _ => [random.between(0.5, 2.0), random.between(-1000.0, 1000.0)],
    }
}

/// m and k of a positive number m 2^k, m from ½ to 1.
fn parts(x: f64) -> (f64, i32) {
    let (x, shift) = if x < 1e-300 { (x * 2f64.powi(100), -100) } else { (x, 0) };
    let k = ((x.to_bits() >> 52) as i32) - 1022;
    (x * 2f64.powi(-k / 2) * 2f64.powi(-k - (-k / 2)), k + shift)
}

/// A number as it is.
fn plain(x: f64) -> Extended {
    Extended::from(x)
}

fn exact_log(x: f64) -> Extended {
    let (m, k) = parts(x);
    // near 1 the parts would cancel
    if (0.5..2.0).contains(&x) { extended::log(plain(x), 0) } else { extended::log(plain(m), k) }
}

fn exact_exp(x: f64) -> (Extended, i32) {
    extended::exp(plain(x))
}

/// e^x ± e^−x over 2, over e^|x| for large x.
fn exact_hyperbolic(x: f64, sign: f64) -> (Extended, i32) {
    if x.abs() <= 1.0 {
        return (extended::sinh_cosh(plain(x))[usize::from(sign > 0.0)], 0);
    }
    let (m, k) = exact_exp(x.abs());
    let small = if k > 600 { plain(0.0) } else { plain(2f64.powi(-k)) / m * 2f64.powi(-k) };
    let side = if sign > 0.0 { 1.0 } else { x.signum() };
    ((m + small * sign) * side, k - 1)
}

/// An angle of numbers of any size: the ratio is what counts.
fn exact_angle(y: f64, x: f64) -> (Extended, i32) {
    let ((y1, j), (x1, k)) = (parts(y.abs()), parts(x.abs()));
    if x > 0.0 && j - k < -60 {
        // the angle is its tangent; one of less than 2⁻¹⁰⁷⁴ is 0
        return (plain(y1) / x1 * y.signum(), j - k);
    }
    let scale = |m: f64, d: i32| if d < -120 { 0.0 } else { m * 2f64.powi(d) };
    let most = j.max(k);
    let angle =
        extended::angle(plain(scale(y1, j - most)), plain(scale(x1, k - most) * x.signum()));
    (angle * y.signum(), 0)
}

/// √(1 − x²)
fn other_leg(x: f64) -> Extended {
    ((plain(1.0) - x) * (plain(1.0) + x)).sqrt()
}

fn exact_cbrt(x: f64) -> (Extended, i32) {
    let (m, k) = parts(x.abs());
    let third = k.div_euclid(3);
    (extended::cbrt(plain(m * 2f64.powi(k - 3 * third))) * x.signum(), third)
}

fn exact_pow([x, y]: [f64; 2]) -> (Extended, i32) {
    let product = exact_log(x.abs()) * y;
    if product.to_f64().abs() > 800.0 {
        return (plain(1.0), if product.to_f64() > 0.0 { 2000 } else { -2000 });
    }
    let (m, k) = extended::exp(product);
    (if x < 0.0 && y % 2.0 != 0.0 { -m } else { m }, k)
}

fn exact_hypot([a, b]: [f64; 2]) -> (Extended, i32) {
    let (_, k) = parts(a.abs().max(b.abs()));
    let scaled = |x: f64| {
        let (m, j) = parts(x.abs());
        plain(if j - k < -400 { 0.0 } else { m * 2f64.powi(j - k) })
    };
    let (a, b) = (scaled(a), scaled(b));
    ((a * a + b * b).sqrt(), k)
}

/// Name, largest error allowed, arguments, std's function, exact result.
macro_rules! cases {
    ($($function:ident $bound:literal $points:ident, |$x:ident, $y:tt| $std:expr, $exact:expr;)+) => {
        vec![$(ElementaryCase {
            name: stringify!($function),
            bound: $bound,
            points: $points,
            exact: |[$x, $y]| $exact,
            std: |[$x, $y]| $std,
            run: |points| levels::run(Apply($function, points)),
        }),+]
    };
}

fn cases() -> Vec<ElementaryCase> {
    cases! {
        Exp 0.8 exponential_points, |x, _| x.exp(), exact_exp(x);
        Log 0.8 logarithm_points, |x, _| x.ln(), (exact_log(x), 0);
        Log10 0.55 logarithm_points, |x, _| x.log10(), (exact_log(x) / extended::log(plain(1.25), 3), 0);
        Sin 0.8 circular_points, |x, _| x.sin(), (extended::sin_cos(plain(x))[0], 0);
        Cos 0.8 circular_points, |x, _| x.cos(), (extended::sin_cos(plain(x))[1], 0);
        Tan 0.9 circular_points, |x, _| x.tan(), {
            let [sin, cos] = extended::sin_cos(plain(x));
            (sin / cos, 0)
        };
        Asin 0.7 inverse_points, |x, _| x.asin(), (extended::angle(plain(x), other_leg(x)), 0);
        Acos 0.7 inverse_points, |x, _| x.acos(), (extended::angle(other_leg(x), plain(x)), 0);
        Atan 0.85 tangent_points, |x, _| x.atan(), exact_angle(x, 1.0);
        Sinh 0.9 hyperbolic_points, |x, _| x.sinh(), exact_hyperbolic(x, -1.0);
        Cosh 0.9 hyperbolic_points, |x, _| x.cosh(), exact_hyperbolic(x, 1.0);
        Tanh 0.85 hyperbolic_points, |x, _| x.tanh(), {
            let [(sinh, _), (cosh, _)] = [-1.0, 1.0].map(|sign| exact_hyperbolic(x, sign));
            (sinh / cosh, 0)
        };
        Cbrt 0.52 wide, |x, _| x.cbrt(), exact_cbrt(x);
        Pow 0.8 power_points, |x, y| x.powf(y), exact_pow([x, y]);
        Atan2 0.85 plane_points, |y, x| y.atan2(x), exact_angle(y, x);
        Hypot 1.2 plane_points, |a, b| a.hypot(b), exact_hypot([a, b]);
    }
}

/// 2^k m to the nearest double of the given result, in its units in the last place: how far off
/// it is.
fn error(found: f64, (m, k): (Extended, i32)) -> f64 {
    let (_, exponent) = parts(m.to_f64().abs());
    let place = exponent + k - 53;
    if place > 971 {
        // beyond the largest number
        return if found.is_infinite() { 0.0 } else { f64::INFINITY };
    }
    let place = place.max(-1074);
    if m.to_f64() == 0.0 || exponent + k < -1100 {
        return found.abs() / f64::from_bits(1);
    }
    // both over the unit: large numbers, but doubles
    let unit = place - k;
    let scaled = m * 2f64.powi(-unit / 2) * 2f64.powi(-unit - (-unit / 2));
    let found = found * 2f64.powi(-place / 2) * 2f64.powi(-place - (-place / 2));
    (scaled - found).to_f64().abs()
}

/// Numbers with rules of their own.
const SPECIAL: [f64; 31] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    3.0,
    -3.0,
    4.0,
    1e-320,
    -1e-320,
    f64::MIN_POSITIVE,
    1e-300,
    1e300,
    -1e300,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    709.782_712_893_384,
    709.782_712_893_384_1,
    -745.133_219_101_941_1,
    -745.133_219_101_941_2,
    710.475_860_073_943_9,
    710.475_860_073_944,
    1e5,
    9_007_199_254_740_993.0,
    1e22,
];

#[test]
fn errors_are_bounded() {
    let mut wrong = Vec::new();
    for case in cases() {
        let mut random = Random(0x51ab_77c2_09d1_0003);
        let points: Vec<_> = (0..4_000).map(|_| (case.points)(&mut random)).collect();
        let (_, found) = &(case.run)(&points)[0];
        let errors = points.iter().zip(found).map(|(&at, &found)| error(found, (case.exact)(at)));
        let worst = errors
            .enumerate()
            .fold((0, 0.0), |worst, (k, e)| if e > worst.1 { (k, e) } else { worst });
        println!("{:6} {:.3} ulp at {:?}", case.name, worst.1, points[worst.0]);
        if worst.1 > case.bound {
            wrong.push(format!("{} is off by {} at {:?}", case.name, worst.1, points[worst.0]));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn vectors_equal_single_numbers() {
    for case in cases() {
        let mut random = Random(0x7a31_0c5d_e1f2_9981);
        let pairs = SPECIAL.iter().flat_map(|&x| SPECIAL.map(|y| [x, y]));
        let points: Vec<_> = pairs.chain((0..2000).map(|_| (case.points)(&mut random))).collect();
        let results = (case.run)(&points);
        for (level, found) in &results[1..] {
            for (k, (a, b)) in found.iter().zip(&results[0].1).enumerate() {
                let same = a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                assert!(same, "{} on {level} at {:?}: {a:e}, not {b:e}", case.name, points[k]);
            }
        }
    }
}

/// Zeros, infinities, NaN and their signs are those of IEEE 754, which std follows; other results
/// are near.
#[test]
fn special_numbers() {
    for case in cases() {
        let points: Vec<_> = SPECIAL.iter().flat_map(|&x| SPECIAL.map(|y| [x, y])).collect();
        for (&at, &found) in points.iter().zip(&(case.run)(&points)[0].1) {
            let expected = (case.std)(at);
            let near =
                (found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs() + f64::from_bits(2);
            let same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
            let is_plain = expected.is_finite() && expected != 0.0;
            let agree =
                same || is_plain && near && found.is_sign_negative() == expected.is_sign_negative();
            assert!(agree, "{} at {at:?}: {found:e}, not {expected:e}", case.name);
        }
    }
}

/// Arguments beyond the straight text, with sine, cosine and tangent in two parts each, from mpmath
/// with 1400 bits.
const HUGE: [(f64, [[f64; 2]; 3]); 9] = [
    (
        5.319372648326541e255,
        [
            [1.0, -1.098476220074687e-37],
            [-4.687165924254628e-19, 4.3720557429382733e-36],
            [-2.133485385753704e18, 92.32514733665552],
        ],
    ),
    (
        1e22,
        [
            [-0.8522008497671888, -6.7806825896773284e-18],
            [0.523214785395139, -4.7143201076575164e-17],
            [-1.6287782256068988, -1.0114934254126034e-16],
        ],
    ),
    (
        1.7976931348623157e308,
        [
            [0.004961954789184062, -2.5049377676494104e-19],
            [-0.9999876894265599, -2.6032890267216748e-17],
            [-0.004962015874444895, 2.4105865734856495e-19],
        ],
    ),
    (
        1e300,
        [
            [-0.8178819121159085, -4.78135837440326e-17],
            [-0.5753861119575491, 2.6770761918787068e-17],
            [1.4214488238747245, -7.511471696020065e-17],
        ],
    ),
    (
        123456789.0,
        [
            [0.9901147518020355, -8.980618906983069e-18],
            [0.14025968153390964, -5.935903437627408e-18],
            [7.059154426802703, -2.8749984977868213e-16],
        ],
    ),
    (
        100001.0,
        [
            [-0.8216179648371524, -2.2572546253360658e-17],
            [-0.5700385248883234, -1.6188591275987904e-18],
            [1.4413376095907133, 9.044170019812572e-17],
        ],
    ),
    (
        6755399441055744.0,
        [
            [0.024933246553059854, 1.5635316233884817e-18],
            [-0.9996891182844416, -5.561251559556868e-18],
            [-0.024941000254006564, 7.677868639168467e-19],
        ],
    ),
    (
        411774.61,
        [
            [-0.22046514295828498, -1.0997739713337047e-17],
            [0.9753948537594316, 2.2602213962813853e-17],
            [-0.22602655950926295, 9.741232436310414e-18],
        ],
    ),
    (
        1e16,
        [
            [0.7796880066069788, -3.933442259574261e-17],
            [-0.6261681981330862, 4.6130820789045176e-17],
            [-1.2451734357184063, -9.213802844530227e-17],
        ],
    ),
];

#[test]
fn huge_angles() {
    for (x, pairs) in HUGE {
        for (case, [high, low]) in
            cases().iter().filter(|c| ["Sin", "Cos", "Tan"].contains(&c.name)).zip(pairs)
        {
            for sign in [1.0, -1.0] {
                let expected =
                    Extended::sum(high, low) * if case.name == "Cos" { 1.0 } else { sign };
                for (level, found) in (case.run)(&[[sign * x, 0.0], [0.5, 0.0]]) {
                    let e = error(found[0], (expected, 0));
                    assert!(e <= case.bound, "{} of {x:e} on {level} is off by {e}", case.name);
                }
            }
        }
    }
}
