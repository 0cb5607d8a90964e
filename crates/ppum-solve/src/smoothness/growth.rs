//! Growth of a function near a point at which it is singular.

use crate::quadrature::SingularGrowth;
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::{PI, TAU};

/// Rays along which a function is looked at; the first does not lie on an axis, where kinks would.
const RAYS: u32 = 12;
const FIRST_RAY: f64 = 0.1;

/// Distances between which exponents are measured, in parts of the scale.
const NEAR: [f64; 2] = [1e-6, 1e-9];

/// Part of the scale within which roots of the distance are told from other powers. Small, so that
/// the ray meets nothing else there.
const PART: f64 = 1e-3;

/// Samples along a ray, and the coefficients of their interpolant that vanish for half powers.
const SAMPLES: usize = 32;
const TAIL: usize = 24;

/// Size of those coefficients, relative to the largest one, that counts as rounding.
const ROUNDING: f64 = 1e-10;

/// Exponents of r below this leave no energy to speak of finite.
const LEAST: f64 = 0.02;

/// The findings at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Behaviour {
    /// The function is constant on both sides of jumps.
    Constant,
    /// Its gradient may be infinite, its energy is not.
    Grows(SingularGrowth),
    /// Its energy is infinite.
    Diverges,
}

/// The behaviour of a function near a point. `jet` gives value and gradient at an offset from the
/// point, `scale` is a length of patches.
pub(crate) fn growth(jet: &dyn Fn(Vec2) -> [f64; 3], scale: f64) -> Behaviour {
    let rays = || (0..RAYS).map(|k| FIRST_RAY + TAU * f64::from(k) / f64::from(RAYS));
    let rays = || rays().map(|angle| vec2(angle.cos(), angle.sin()));
    let slope = |ray: Vec2| {
        let [far, near] = NEAR.map(|part| {
            let r = part * scale;
            let [_, x, y] = jet(ray * r);
            r * x.hypot(y)
        });
        (near > 0.0).then(|| (far / near).ln() / (NEAR[0] / NEAR[1]).ln())
    };
    match rays().filter_map(slope).reduce(f64::min) {
        None => Behaviour::Constant,
        Some(least) if least <= LEAST => Behaviour::Diverges,
        Some(_) if rays().all(|ray| has_half_powers(jet, ray, PART * scale)) => {
            Behaviour::Grows(SingularGrowth::HalfPowers)
        }
        Some(least) => Behaviour::Grows(SingularGrowth::Powers { least }),
    }
}

/// True if f and r ∇f are smooth functions of √r along a ray: if their Chebyshev series end.
fn has_half_powers(jet: &dyn Fn(Vec2) -> [f64; 3], ray: Vec2, length: f64) -> bool {
    let samples: [[f64; 3]; SAMPLES] = std::array::from_fn(|k| {
        let t = 0.5 + 0.5 * (PI * (k as f64 + 0.5) / SAMPLES as f64).cos();
        let r = length * t * t;
        let [value, x, y] = jet(ray * r);
        [value, r * x, r * y]
    });
    (0..3).all(|kind| {
        let coefficient = |order: usize| {
            let wave = |k: usize| (PI * order as f64 * (k as f64 + 0.5) / SAMPLES as f64).cos();
            samples.iter().enumerate().map(|(k, s)| s[kind] * wave(k)).sum::<f64>().abs()
        };
        let largest = |orders: std::ops::Range<usize>| orders.map(coefficient).fold(0.0, f64::max);
        largest(TAIL..SAMPLES) <= ROUNDING * largest(0..SAMPLES)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The behaviour of r^λ g(θ) + c, g = cos(mθ).
    fn of_power(lambda: f64, m: f64, c: f64) -> Behaviour {
        let jet = |p: Vec2| {
            let (r, theta) = (p.length(), p.y.atan2(p.x));
            let (g, dg) = ((m * theta).cos(), -m * (m * theta).sin());
            let (radial, around) = (lambda * r.powf(lambda - 1.0) * g, r.powf(lambda - 1.0) * dg);
            let (cos, sin) = (p.x / r, p.y / r);
            [r.powf(lambda) * g + c, radial * cos - around * sin, radial * sin + around * cos]
        };
        growth(&jet, 0.3)
    }

    #[test]
    fn half_powers_and_others() {
        for (lambda, m) in [(0.5, 0.5), (1.5, 2.5), (1.0, 3.0), (2.5, 0.0), (2.0, 2.0)] {
            let found = of_power(lambda, m, 1.0);
            assert_eq!(found, Behaviour::Grows(SingularGrowth::HalfPowers), "{lambda} {m}");
        }
        for (lambda, m) in [(0.6, 0.6), (0.25, 0.25), (0.51, 1.5), (1.2, 0.0), (0.05, 1.0)] {
            let Behaviour::Grows(SingularGrowth::Powers { least }) = of_power(lambda, m, 2.0)
            else {
                panic!("{lambda} {m}: {:?}", of_power(lambda, m, 2.0));
            };
            assert!((least - lambda).abs() < 1e-6, "{least} instead of {lambda}");
        }
    }

    #[test]
    fn sums_grow_like_their_least_power() {
        let jet = |p: Vec2| {
            let r = p.length();
            let slope = 0.3 * r.powf(-0.7) + 0.5 / r.sqrt();
            [r.powf(0.3) + r.sqrt(), slope * p.x / r, slope * p.y / r]
        };
        let Behaviour::Grows(SingularGrowth::Powers { least }) = growth(&jet, 1.0) else {
            panic!("powers")
        };
        assert!((0.3..0.33).contains(&least), "{least}");
    }

    #[test]
    fn logarithms_angles_and_steps() {
        let log = |p: Vec2| [p.length().ln(), p.x / p.dot(p), p.y / p.dot(p)];
        assert_eq!(growth(&log, 1.0), Behaviour::Diverges);
        let angle = |p: Vec2| [p.y.atan2(p.x), -p.y / p.dot(p), p.x / p.dot(p)];
        assert_eq!(growth(&angle, 1.0), Behaviour::Diverges);
        let step = |p: Vec2| [p.y.signum(), 0.0, 0.0];
        assert_eq!(growth(&step, 1.0), Behaviour::Constant);
        let infinite = |_: Vec2| [f64::NAN; 3];
        assert_eq!(growth(&infinite, 1.0), Behaviour::Constant);
    }
}
