//! The Westergaard functions against derivatives found by hand.

use std::f64::consts::PI;

use super::{Formula, Scope, WESTERGAARD, assert_near, at_angle, jet_at, jets};

/// Value, gradient and Hessian of r^p cos(mθ + φ), by the rules of polar coordinates:
/// f_x = c f_r − s f_θ/r, f_y = s f_r + c f_θ/r, and so on.
pub(super) fn polar_jet(p: f64, [r, theta]: [f64; 2], m: f64, phase: f64) -> [f64; 6] {
    let (s, c) = theta.sin_cos();
    let (sin, cos) = (m * theta + phase).sin_cos();
    let f = r.powf(p) * cos;
    let (fr, ft) = (p * f / r, -m * r.powf(p) * sin);
    let (frr, frt, ftt) = (p * (p - 1.0) * f / (r * r), p * ft / r, -m * m * f);
    let (radial, turning, mixed) = (frr, fr / r + ftt / (r * r), frt / r - ft / (r * r));
    [
        f,
        c * fr - s * ft / r,
        s * fr + c * ft / r,
        c * c * radial + s * s * turning - 2.0 * s * c * mixed,
        s * c * (radial - turning) + (c * c - s * s) * mixed,
        s * s * radial + c * c * turning + 2.0 * s * c * mixed,
    ]
}

/// The four functions as sums of r^½ cos and sin of θ/2 and 3θ/2:
/// sin θ sin(θ/2) = (cos(θ/2) − cos(3θ/2))/2, sin θ cos(θ/2) = (sin(θ/2) + sin(3θ/2))/2.
fn by_hand(k: usize, r: f64, theta: f64) -> [f64; 6] {
    let cos = |m| polar_jet(0.5, [r, theta], m, 0.0);
    let sin = |m| polar_jet(0.5, [r, theta], m, -PI / 2.0);
    let mean =
        |a: [f64; 6], b: [f64; 6], sign: f64| std::array::from_fn(|i| 0.5 * (a[i] + sign * b[i]));
    match k {
        0 => cos(0.5),
        1 => sin(0.5),
        2 => mean(cos(0.5), cos(1.5), -1.0),
        _ => mean(sin(0.5), sin(1.5), 1.0),
    }
}

/// Angles all around, also close to the faces of the crack.
fn angles() -> impl Iterator<Item = f64> {
    let near = [0.0, 1e-9, 1e-4].map(|d| PI - d);
    (-15..=15).map(|i| f64::from(i) * 0.2).chain(near).chain(near.map(|t| -t))
}

#[test]
fn jets_agree_with_hand_derivation() {
    for (k, text) in WESTERGAARD.iter().enumerate() {
        let jet = jets(&Formula::parse(text, &Scope::polar()).expect("valid"));
        for theta in angles() {
            for r in [1e-13, 1e-3, 0.7, 1.0, 40.0] {
                let inputs = at_angle([r * theta.cos(), r * theta.sin()], r, theta);
                let (found, hand) = (jet_at(&jet, &inputs), by_hand(k, r, theta));
                for i in 0..6 {
                    // the natural size of a derivative of order n is r^(½ − n)
                    let order = [0, 1, 1, 2, 2, 2][i];
                    let scale = r.sqrt() / r.powi(order);
                    let what = format!("{text}, component {i} at r = {r:e}, theta = {theta}");
                    assert_near(found[i], hand[i], 5e-15, scale, &what);
                }
            }
        }
    }
}

/// Componentwise, also where a component all but vanishes:
/// ∇ √r sin(θ/2) = (−sin(θ/2), cos(θ/2)) / (2√r).
#[test]
fn gradients_keep_relative_accuracy() {
    let f = Formula::parse(WESTERGAARD[1], &Scope::polar()).expect("valid");
    let (dx, dy) = (f.derivative("x").expect("small"), f.derivative("y").expect("small"));
    for theta in angles().chain([1e-12, -1e-7]) {
        for r in [1e-160, 1e-13, 0.3, 1e5] {
            let inputs = at_angle([r * theta.cos(), r * theta.sin()], r, theta);
            let (gx, gy) =
                (-(theta / 2.0).sin() / (2.0 * r.sqrt()), (theta / 2.0).cos() / (2.0 * r.sqrt()));
            let what = format!("r = {r:e}, theta = {theta}");
            assert_near(dx.evaluate(&inputs), gx, 2e-15, gx.abs(), &what);
            assert_near(dy.evaluate(&inputs), gy, 2e-15, gy.abs(), &what);
        }
    }
}

/// The branch of θ is the caller's: θ beyond π continues the functions, it does not wrap.
#[test]
fn angle_is_taken_as_given() {
    let f = Formula::parse(WESTERGAARD[1], &Scope::polar()).expect("valid");
    let theta = PI + 0.1;
    let (x, y) = (theta.cos(), theta.sin());
    let above = f.evaluate(&at_angle([x, y], 1.0, theta));
    let below = f.evaluate(&at_angle([x, y], 1.0, theta - 2.0 * PI));
    assert_near(above, (theta / 2.0).sin(), 1e-15, 1.0, "continued");
    assert_near(above, -below, 1e-15, 1.0, "the other face");
}
