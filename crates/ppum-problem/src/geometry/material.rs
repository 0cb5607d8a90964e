//! Jumps of the material, seen from a tip.

use std::f64::consts::TAU;

use ppum::dataset::Elasticity;
use ppum::vec2::{Vec2, vec2};

/// Directions in which interfaces are looked for, and steps in each: one that passes at the
/// distance d is found at 1.002 d.
const RAYS: u32 = 64;
const STEPS: u32 = 64;

/// Halvings of a step in which the material changes, to the rounding of its length.
const HALVINGS: u32 = 40;

/// Change of the material at a tip that is a jump there: relative change of E, or change of ν.
const JUMP: f64 = 1e-6;

/// Change across an interface that is seen in the factors of a tip near it, in the same measure.
const NOTABLE: f64 = 0.01;

/// True if the material jumps at a point: if it differs at a distance that is next to nothing.
pub(super) fn jumps(body: &Elasticity, p: Vec2, distance: f64) -> bool {
    let own = constants(body, p);
    rays().any(|ray| change(&own, &constants(body, p + ray * distance)) > JUMP)
}

/// Distance of a point to the nearest interface across which the material jumps notably, if it is
/// below `reach`.
pub fn interface_distance(body: &Elasticity, p: Vec2, reach: f64) -> Option<f64> {
    if body.uniform().is_some() {
        return None;
    }
    let along = |ray: Vec2| first_jump(&|r| constants(body, p + ray * r), &change, reach);
    rays().filter_map(along).reduce(f64::min)
}

/// True if some numbers jump within `reach` of a point, as seen from there: across a straight crack
/// that ends at the point they may.
pub fn jumps_within<const N: usize>(at: &dyn Fn(Vec2) -> [f64; N], p: Vec2, reach: f64) -> bool {
    let difference = |a: &[f64; N], b: &[f64; N]| {
        a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
    };
    let size = rays().map(|ray| difference(&at(p), &at(p + ray * reach))).fold(0.0, f64::max);
    let change = |a: &[f64; N], b: &[f64; N]| difference(a, b) / size;
    let jumps = |ray: Vec2| first_jump(&|r| at(p + ray * r), &change, reach).is_some();
    size > 0.0 && rays().any(jumps)
}

fn rays() -> impl Iterator<Item = Vec2> {
    let angle = |k: u32| TAU * f64::from(k) / f64::from(RAYS);
    (0..RAYS).map(move |k| vec2(angle(k).cos(), angle(k).sin()))
}

/// E and ν; of an anisotropic body the sum of its stiffnesses in the world's axes, and the parts of
/// each in it.
fn constants(body: &Elasticity, p: Vec2) -> [f64; 7] {
    let Some(law) = &body.anisotropy else {
        return [body.young.value(p), body.poisson.value(p), 0.0, 0.0, 0.0, 0.0, 0.0];
    };
    let plane @ [c11, _, _, c22, _, c66] = law.plane_at(p);
    let sum = c11 + c22 + c66;
    let [a, b, c, d, e, f] = plane.map(|entry| entry / sum);
    [sum, a, b, c, d, e, f]
}

/// Relative change of the first constant or change of the others, the largest one.
fn change(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    let first = (a[0] - b[0]).abs() / a[0].max(b[0]);
    (1..7).map(|k| (a[k] - b[k]).abs()).fold(first, f64::max)
}

/// The least distance below `reach` at which there is a jump. A change over a step that vanishes as
/// the step is halved again and again is a smooth variation.
fn first_jump<T: Copy>(
    at: &dyn Fn(f64) -> T,
    change: &dyn Fn(&T, &T) -> f64,
    reach: f64,
) -> Option<f64> {
    let r = |k: u32| reach * f64::from(k) / f64::from(STEPS);
    (0..STEPS).find_map(|k| {
        let [mut near, mut far] = [r(k), r(k + 1)].map(|r| (r, at(r)));
        for _ in 0..HALVINGS {
            if change(&near.1, &far.1) <= NOTABLE {
                return None;
            }
            let mid = 0.5 * (near.0 + far.0);
            let mid = (mid, at(mid));
            if change(&near.1, &mid.1) >= change(&mid.1, &far.1) { far = mid } else { near = mid }
        }
        Some(near.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::StressState;

    fn body(young: &str, poisson: &str) -> Elasticity {
        let [young, poisson] = [young, poisson].map(|text| text.parse().expect("a formula"));
        let state = StressState::PlaneStrain;
        Elasticity { young, poisson, state, eigenstrain: None, anisotropy: None }
    }

    #[test]
    fn materials_jump_on_interfaces_alone() {
        let jump = |young: &str, p: Vec2| jumps(&body(young, "0.3"), p, 1e-10);
        // the point lies on these lines except for rounding
        for (p, young) in [
            (vec2(0.2, 0.16), "if(y > 0.3*x + 0.1, 2, 1)"),
            (vec2(0.2, 0.16), "if(y >= 0.3*x + 0.1, 2, 1)"),
            (vec2(0.3, 0.4), "if(x^2 + y^2 < 0.25, 1.001, 1)"),
        ] {
            assert!(jump(young, p), "{young}");
            assert!(!jump(young, p + vec2(1e-6, -2e-6)), "{young} beside");
        }
        // kinks and steep slopes are no jumps
        for young in ["1 + 5*abs(x - 0.2)", "exp(40*x)", "max(1, 10*y)", "1e3 + sin(100*x)"] {
            assert!(!jump(young, vec2(0.2, 0.1)), "{young}");
        }
    }

    #[test]
    fn interfaces_at_a_distance() {
        let p = vec2(0.1, 0.2);
        let apart = |young: &str, poisson: &str| interface_distance(&body(young, poisson), p, 1.0);
        let near = |found: Option<f64>, exact: f64| {
            let found = found.expect("an interface");
            assert!(found >= exact * (1.0 - 1e-9) && found < 1.002 * exact, "{found} {exact}");
        };
        near(apart("if(y > 0.5, 2, 1)", "0.3"), 0.3);
        near(apart("exp(3*x)", "if(x - y > 0.7, 0.3, 0.2)"), 0.8 / 2f64.sqrt());
        near(apart("if(x^2 + y^2 < 0.25, 1, 1.1)", "0.3"), 0.5 - p.length());
        near(apart("if(abs(y - 0.3) < 0.02, 9, 1)", "0.3"), 0.08);
        // none, too far away, next to no jump, and what is only steep
        for young in ["1", "if(y > 1.3, 2, 1)", "if(y > 0.5, 1.001, 1)", "2 + tanh(1e5*(y - 0.5))"]
        {
            assert_eq!(apart(young, "0.3"), None, "{young}");
        }
    }
}
