//! The part of the interaction integral that comes from loads on the faces of a crack.

use super::FaceLoad;
use super::auxiliary::auxiliary;
use super::integral::{Modes, cut_off, turned};
use crate::quadrature::{GaussRule, closed, gauss};
use ppum::crack::{Crack, End, Side, TipId, TipPoint};
use ppum::dataset::Material;

/// Gauss points of a panel.
const ORDER: usize = 8;

/// Panels that a face is looked at with before it is known where its load varies, and most divisions of
/// each: a jump of the load is then placed to 1e-11 of the disc.
const PANELS: u32 = 8;
const DIVISIONS: u32 = 45;

/// The place at which panels are divided. Not the middle: the rules of a panel and of its halves give the same for a jump
/// beside it.
const SHARE: f64 = 0.4;

/// Most panels that are divided at a time: loads that vary everywhere are noise.
const MOST: usize = 256;

/// Difference of rules on a panel that is rounding, in parts of the integral of the magnitude.
const ACCURACY: f64 = 1e-11;

/// An interval of the face's coordinate with the integral over it.
type Panel = ([f64; 2], Modes);

/// The faces of a crack behind one tip, in the discs around it.
pub(super) struct Faces<'a> {
    pub(super) crack: &'a Crack,
    pub(super) tip: TipId,
    pub(super) material: &'a Material,
    /// Radii of the discs, ascending.
    pub(super) radii: &'a [f64],
    pub(super) load: FaceLoad<'a>,
}

impl Faces<'_> {
    /// −∫ t_i uᵃ_i,1 q ds over both faces. Panels are divided until they resolve the load, which may bend
    /// or jump anywhere.
    pub(super) fn integrals(&self) -> Modes {
        [Side::Above, Side::Below].map(|side| self.face(side)).into_iter().fold(zero(), plus)
    }

    fn face(&self, side: Side) -> Modes {
        let at = |k: u32| f64::from(k) / f64::from(PANELS);
        let mut open: Vec<_> = (0..PANELS).map(|k| self.panel(side, [at(k), at(k + 1)])).collect();
        let allowed = ACCURACY * open.iter().map(|(_, whole)| magnitude(whole)).sum::<f64>();
        let mut sum = zero();
        for _ in 0..DIVISIONS {
            let mut next = Vec::new();
            for (ends, whole) in open {
                let parts = self.parts(side, ends);
                let both = plus(parts[0].1, parts[1].1);
                // what happens beside an end is seen by points there alone
                let other = self.integral(side, ends, closed(ORDER));
                let change = magnitude(&minus(both, whole)).max(magnitude(&minus(other, whole)));
                if change > allowed {
                    next.extend(parts);
                } else {
                    sum = plus(sum, both);
                }
            }
            open = next;
            if open.len() > MOST {
                break;
            }
        }
        open.into_iter().fold(sum, |sum, (_, rest)| plus(sum, rest))
    }

    fn parts(&self, side: Side, [from, to]: [f64; 2]) -> [Panel; 2] {
        let between = from + SHARE * (to - from);
        [[from, between], [between, to]].map(|ends| self.panel(side, ends))
    }

    fn panel(&self, side: Side, ends: [f64; 2]) -> Panel {
        (ends, self.integral(side, ends, gauss(ORDER)))
    }

    /// A rule on an interval of the unit interval: with r = R s² the integrand has no singularity.
    fn integral(&self, side: Side, [from, to]: [f64; 2], rule: &GaussRule) -> Modes {
        let largest = self.radii[self.radii.len() - 1];
        let node = |(s, ds): (f64, f64)| {
            self.at(side, largest * s * s).map(|modes| modes.map(|m| 2.0 * largest * s * ds * m))
        };
        rule.on(from, to).map(node).fold(zero(), plus)
    }

    /// −t_i uᵃ_i,1 q at the distance `r` behind the tip.
    fn at(&self, side: Side, r: f64) -> Modes {
        let Self { crack, tip, material, .. } = self;
        let axis = crack.growth_direction(tip.end);
        let traction = (self.load)(tip.crack, side, crack.end_point(tip.end) - axis * r);
        let t = turned(axis, traction);
        let auxiliary = auxiliary::<1>(material, &on_face(r, tip.end, side));
        let work = auxiliary.map(|a| t.x * a.gradient[0].x + t.y * a.gradient[1].x);
        std::array::from_fn(|k| work.map(|w| -cut_off(r * r, self.radii[k]).0 * w))
    }
}

/// The point of a face at the distance `r` behind the tip. *Above* is the tip's left at the last
/// vertex and its right at the first.
fn on_face(r: f64, end: End, side: Side) -> TipPoint<f64> {
    let left = (end == End::Last) == (side == Side::Above);
    TipPoint { x: -r, y: 0.0, sign: if left { 1.0 } else { -1.0 }, branch: 1.0 }
}

fn zero() -> Modes {
    Modes::default()
}

fn plus(a: Modes, b: Modes) -> Modes {
    std::array::from_fn(|k| std::array::from_fn(|mode| a[k][mode] + b[k][mode]))
}

fn minus(a: Modes, b: Modes) -> Modes {
    plus(a, b.map(|modes| modes.map(|m| -m)))
}

fn magnitude(modes: &Modes) -> f64 {
    modes.as_flattened().iter().map(|m| m.abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::dataset::StressState;
    use ppum::vec2::{Vec2, vec2};

    const RADII: [f64; 3] = [0.3, 0.4, 0.5];

    /// The integrals for a tip at (0.3, 0) at the right end of a crack.
    fn integrals(load: FaceLoad<'_>) -> Modes {
        let points = vec![vec2(-0.5, 0.0), vec2(0.3, 0.0)];
        let crack = Crack { points, ends: [CrackEnd::Tip; 2] };
        let material = Material { young: 2.0, poisson: 0.2, state: StressState::PlaneStress };
        let tip = TipId { crack: 0, end: End::Last };
        Faces { crack: &crack, tip, material: &material, radii: &RADII, load }.integrals()
    }

    /// A pressure p on both faces gives E′/2 M = √(2/π) ∫ p q/√r dr, with r = s²: loads that jump at r = c,
    /// have a kink there, and a layer. Gauss rules up to c and from there are the reference.
    #[test]
    fn loads_that_jump_and_bend() {
        let exact = |p: &dyn Fn(f64) -> f64, radius: f64, from: f64, to: f64| {
            let node = |(s, ds): (f64, f64)| 2.0 * ds * p(s * s) * cut_off(s.powi(4), radius).0;
            let sum: f64 = gauss(40).on(from.sqrt(), to.min(radius).sqrt()).map(node).sum();
            (2.0 / std::f64::consts::PI).sqrt() * sum
        };
        let check = |p: &(dyn Fn(f64) -> f64 + Sync), breaks: &[f64]| {
            let load = |_: u32, side: Side, x: Vec2| {
                let sign = if side == Side::Above { 1.0 } else { -1.0 };
                [0.0, sign * p(0.3 - x.x)]
            };
            for ([k1, k2], radius) in integrals(&load).into_iter().zip(RADII) {
                let expected: f64 =
                    breaks.windows(2).map(|b| exact(p, radius, b[0].min(radius), b[1])).sum();
                // E′ = 2
                assert!((k1 - expected).abs() < 1e-9, "{k1} instead of {expected}");
                assert!(k2.abs() < 1e-12, "{k2}");
            }
        };
        // the last beside the middle of a panel
        for c in [0.0123, 0.1, 0.2718, 0.5 * (1.503f64 / 8.0).powi(2)] {
            check(&|r| if r < c { 1.0 } else { 0.0 }, &[0.0, c]);
            check(&|r| if r < c { 0.5 } else { -2.0 + r }, &[0.0, c, 1.0]);
            check(&|r| (r - c).abs(), &[0.0, c, 1.0]);
        }
        check(&|r| (-r / 1e-3).exp(), &[0.0, 1e-3, 4e-3, 1e-2, 3e-2]);
    }
}
