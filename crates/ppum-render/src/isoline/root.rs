//! Changes of sign by Newton's method in a bracket.

/// Crossings are found to this part of a side.
const ROOT: f64 = 1e-10;

/// Most steps to a crossing; halving alone takes 34.
const STEPS: usize = 100;

/// A change by more than this many times what slopes explain along a side is a jump.
const JUMP: f64 = 10.0;

/// A change of sign on \[0, 1\].
pub(super) struct SignChange {
    pub(super) at: f64,
    /// Where the function jumps, or runs through infinity: the places on both sides.
    pub(super) jump: Option<[f64; 2]>,
}

/// Where a function with values of different signs at 0 and 1 changes its sign. `f` gives value and
/// slope.
pub(super) fn root([at_0, at_1]: [f64; 2], f: &mut impl FnMut(f64) -> (f64, f64)) -> SignChange {
    let (mut lo, mut hi) = ((0.0, at_0), (1.0, at_1));
    let mut t = at_0 / (at_0 - at_1);
    let (mut steepest, mut last) = (0.0f64, 1.0);
    for _ in 0..STEPS {
        if !(t > lo.0 && t < hi.0) {
            t = 0.5 * (lo.0 + hi.0);
        }
        let (value, slope) = f(t);
        // the sign that counts as above is that of the corners
        if (value > 0.0) == (at_0 > 0.0) {
            lo = (t, value)
        } else {
            hi = (t, value)
        }
        steepest = steepest.max(if slope.is_finite() { slope.abs() } else { 0.0 });
        let step = -value / slope;
        // beside a pole the function runs the other way
        let is_turned = slope * (at_1 - at_0) < 0.0;
        // where it is zero and level it changes its sign elsewhere
        if step.abs() <= ROOT || value == 0.0 && slope != 0.0 {
            let is_pole = is_turned && value.abs() > at_0.abs().min(at_1.abs());
            return SignChange { at: t, jump: is_pole.then_some([t - ROOT, t + ROOT]) };
        }
        if hi.0 - lo.0 <= ROOT {
            let jumps = is_turned || (hi.1 - lo.1).abs() > JUMP * steepest;
            return SignChange { at: t, jump: jumps.then_some([lo.0, hi.0]) };
        }
        // Newton's step, if it is at most half of the last one
        let is_good = step.abs() <= 0.5 * last && t + step > lo.0 && t + step < hi.0;
        last = if is_good { step.abs() } else { 0.5 * (hi.0 - lo.0) };
        t = if is_good { t + step } else { 0.5 * (lo.0 + hi.0) };
    }
    SignChange { at: t, jump: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_4, TAU};

    /// A root of `f` with its derivative, and the number of evaluations.
    fn root_and_count(f: impl Fn(f64) -> (f64, f64)) -> (SignChange, usize) {
        let mut count = 0;
        let mut counted = |t| {
            count += 1;
            f(t)
        };
        let root = root([f(0.0).0, f(1.0).0], &mut counted);
        (root, count)
    }

    #[test]
    fn smooth_functions_take_a_few_steps() {
        for a in [0.013, 0.3, 0.71, 0.998] {
            for (f, most) in [
                (&(|t: f64| (t - a, 1.0)) as &dyn Fn(f64) -> (f64, f64), 2),
                (&|t| ((3.0 * t).exp() - (3.0 * a).exp(), 3.0 * (3.0 * t).exp()), 14),
                (&|t| (a * a - t * t, -2.0 * t), 14),
                (&|t| ((t - a).cbrt(), ((t - a).cbrt().powi(-2)) / 3.0), 60),
            ] {
                let (root, count) = root_and_count(f);
                assert!((root.at - a).abs() < 1e-9 && root.jump.is_none(), "{a} {}", root.at);
                assert!(count <= most, "{a}: {count} > {most}");
            }
        }
    }

    #[test]
    fn jumps_and_poles_are_told() {
        let step = |t: f64| (if t < 0.37 { -1.0 } else { 1.0 }, 0.0);
        let pole = |t: f64| (1.0 / (t - 0.37), -1.0 / (t - 0.37).powi(2));
        // an angle that turns slowly and jumps
        let angle = |t: f64| (if t < 0.37 { 1.2 + 0.3 * t } else { 0.3 * t - 1.9 }, 0.3);
        for f in [&step as &dyn Fn(f64) -> (f64, f64), &pole, &angle] {
            let [a, b] = root_and_count(f).0.jump.expect("a jump");
            assert!(a <= 0.37 && 0.37 <= b && b - a < 1e-9, "{a} {b}");
        }
        // a plateau of zeros counts as below
        let plateau = |t: f64| (if t < 0.37 { 0.0 } else { 2.0 }, 0.0);
        assert!((root_and_count(plateau).0.at - 0.37).abs() < 1e-9);
    }

    /// An end at a tip, or a wave with several roots: one of them is found.
    #[test]
    fn infinite_ends_and_many_roots() {
        let tip = |t: f64| (1.0 / t.sqrt() - 3.0, -0.5 * t.powf(-1.5));
        assert!((root_and_count(tip).0.at - 1.0 / 9.0).abs() < 1e-9);
        let wave = |t: f64| {
            ((2.25 * TAU * t - FRAC_PI_4).sin(), 2.25 * TAU * (2.25 * TAU * t - FRAC_PI_4).cos())
        };
        assert!(wave(root_and_count(wave).0.at).0.abs() < 1e-7);
    }
}
