//! The part of the interaction integral that comes from loads on the faces of a crack. Their part
//! of J needs the field there: `face_integrals` has it.

use super::auxiliary::TipMaterialBody;
use super::loads::TipLoads;
use super::path::{PathSegment, TipPath};
use super::sums::{Modes, cut_off, square, turned};
use ppum::crack::{LocalTip, Side};
use ppum::edge::Edge;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::Symmetry;
use ppum_solve::quadrature::{GaussRule, circumference, closed, gauss};

/// Gauss points of a panel.
const ORDER: usize = 8;

/// Panels that a face is looked at with before it is known where its load varies, and most
/// divisions of each: a jump of the load is then placed to 1e-11 of the disc.
const PANELS: u32 = 8;
const DIVISIONS: u32 = 45;

/// The place at which panels are divided. Not the middle: the rules of a panel and of its halves
/// give the same for a jump beside it.
const SHARE: f64 = 0.4;

/// Most panels that are divided at a time: loads that vary everywhere are noise.
const MOST: usize = 256;

/// Difference of rules on a panel that is rounding, in parts of the integral of the magnitude.
const ACCURACY: f64 = 1e-11;

/// Places along the segment at the tip, in parts of it, at which loads are looked at. At the first
/// they are those at the tip: what grows like √r is 1e-6 there.
const LOOKS: [f64; 5] = [1e-12, 1e-3, 0.03, 0.3, 1.0];

/// Part of the segment at the tip on which a resultant of the loads is rounding of their places,
/// which the field of the force, like 1/r, would blow up.
const AT_TIP: f64 = 1e-10;

/// Most places at which a part is divided for its loads: those that vary everywhere are noise.
const MOST_BREAKS: usize = 512;

/// Resultant of the loads at a tip that is none, in parts of the largest load that was seen.
const BALANCED: f64 = 1e-5;

/// An interval of the face's coordinate with the integral over it.
type FaceInterval = ([f64; 2], Modes);

/// A part of the crack, and the tip as seen from it.
type SegmentAtTip<'s> = (&'s PathSegment, &'s LocalTip<'s>);

/// The faces of a crack behind one tip, in the discs around it.
pub(super) struct TipFaces<'a> {
    pub(super) path: &'a TipPath,
    pub(super) body: &'a TipMaterialBody,
    /// Radii of the discs, ascending.
    pub(super) radii: &'a [f64],
    pub(super) load: &'a dyn TipLoads,
    /// False if the loads have a resultant at the tip: the integral for T has no value then, and is
    /// left out.
    pub(super) is_balanced: bool,
    /// True if only the face above is in the body.
    pub(super) is_half: bool,
    /// True if a point stands for the circle through it.
    pub(super) is_axisymmetric: bool,
}

impl TipFaces<'_> {
    /// −∫ t_i 𝓛uᵃ_i q ds over both faces, or over the one in the body. Panels are divided until
    /// they resolve the load, which may bend or jump anywhere.
    pub(super) fn integrals(&self) -> Modes {
        self.path.parts().map(|part| self.part(&part)).fold(zero(), plus)
    }

    fn part(&self, part: &PathSegment) -> Modes {
        self.resolved(part).into_iter().fold(zero(), |sum, (_, modes)| plus(sum, modes))
    }

    /// The distances to the tip at which a part has to be divided for its loads.
    pub(super) fn breaks(&self, part: &PathSegment) -> Vec<f64> {
        let edge = self.relative(part);
        let along = |s: f64| if part.is_first { s * s } else { s };
        let panels = self.resolved(part);
        let thinned = panels.len() / MOST_BREAKS + 1;
        let panels = panels.into_iter().step_by(thinned);
        panels.map(|([start, _], _)| (edge.from + edge.way(along(start))).length()).collect()
    }

    /// The edge of a part as seen from the tip.
    fn relative(&self, part: &PathSegment) -> Edge {
        let Edge { from, to, bulge } = part.edge;
        let center = self.path.center();
        Edge { from: from - center, to: to - center, bulge }
    }

    /// Panels that resolve the loads on a part.
    fn resolved(&self, part: &PathSegment) -> Vec<FaceInterval> {
        let tip = &self.path.on(part, self.path.center());
        let at = |k: u32| f64::from(k) / f64::from(PANELS);
        let mut open: Vec<_> =
            (0..PANELS).map(|k| self.panel((part, tip), [at(k), at(k + 1)])).collect();
        let allowed = ACCURACY * open.iter().map(|(_, whole)| magnitude(whole)).sum::<f64>();
        let mut done = Vec::new();
        for _ in 0..DIVISIONS {
            let mut next = Vec::new();
            for (ends, whole) in open {
                let parts = self.halves((part, tip), ends);
                let both = plus(parts[0].1, parts[1].1);
                // what happens beside an end is seen by points there alone
                let other = self.integral((part, tip), ends, closed(ORDER));
                let change = magnitude(&minus(both, whole)).max(magnitude(&minus(other, whole)));
                if change > allowed {
                    next.extend(parts);
                } else {
                    done.push((ends, both));
                }
            }
            open = next;
            if open.len() > MOST {
                break;
            }
        }
        done.extend(open);
        done
    }

    fn halves(&self, of: SegmentAtTip<'_>, [from, to]: [f64; 2]) -> [FaceInterval; 2] {
        let between = from + SHARE * (to - from);
        [[from, between], [between, to]].map(|ends| self.panel(of, ends))
    }

    fn panel(&self, of: SegmentAtTip<'_>, ends: [f64; 2]) -> FaceInterval {
        (ends, self.integral(of, ends, gauss(ORDER)))
    }

    /// A rule on an interval of the unit interval. At the tip the square of its coordinate goes
    /// along the part: then the integrand has no singularity.
    fn integral(
        &self,
        (part, tip): SegmentAtTip<'_>,
        [from, to]: [f64; 2],
        rule: &GaussRule,
    ) -> Modes {
        let length = part.edge.length();
        let node = |(s, ds): (f64, f64)| {
            let (along, slope) = if part.is_first { (s * s, 2.0 * s) } else { (s, 1.0) };
            self.at((part, tip), along).map(|modes| modes.map(|m| length * slope * ds * m))
        };
        rule.on(from, to).map(node).fold(zero(), plus)
    }

    /// −t_i 𝓛uᵃ_i q of both faces, `along` going from 0 to 1 along the part.
    fn at(&self, (part, tip): SegmentAtTip<'_>, along: f64) -> Modes {
        let offset = (part.edge.from - self.path.center()) + part.edge.way(along);
        let of_side = |side: Side| {
            let point = tip.point([offset.x, offset.y], side);
            let (crack, at) = (self.path.tip().crack, self.path.center() + offset);
            let traction = self.load.traction(crack, side, at).unwrap_or_default();
            let t = turned(tip.axis, traction);
            let auxiliary = self.body.fields_at::<1>(&point);
            let work = auxiliary.map(|a| t.x * a.derivative[0] + t.y * a.derivative[1]);
            let q = |k: usize| cut_off(square(&point), self.radii[k]).0;
            let circle = if self.is_axisymmetric { circumference(at) } else { 1.0 };
            std::array::from_fn(|k| work.map(|w| -q(k) * w * circle))
        };
        let mut both = of_side(Side::Above);
        if !self.is_half {
            both = plus(both, of_side(Side::Below));
        }
        let is_at_tip = part.is_first && along < AT_TIP;
        if is_at_tip || !self.is_balanced {
            both.iter_mut().for_each(|modes| modes[2] = 0.0);
        }
        both
    }
}

/// σ_12 and σ_22 in the tip's frame that the loads on the faces at a tip stand for, or those on one
/// face and their image; none if these have a resultant, under which stresses grow like log r.
pub(super) fn pressed(path: &TipPath, load: &dyn TipLoads, half: Option<Symmetry>) -> Option<Vec2> {
    let first = path.parts().next()?;
    let loads = LOOKS.map(|part| {
        let at = first.edge.from + first.edge.way(part);
        let tip = path.on(&first, at);
        [Side::Above, Side::Below].map(|side| {
            let traction = load.traction(path.tip().crack, side, at).unwrap_or_default();
            turned(tip.axis, traction) * tip.orientation
        })
    });
    let size = loads.as_flattened().iter().map(|t| t.length()).fold(0.0, f64::max);
    let [above, below] = match (loads[0], half) {
        (loads, None) => loads,
        ([above, _], Some(Symmetry::Symmetric)) => [above, vec2(above.x, -above.y)],
        ([above, _], Some(Symmetry::Antisymmetric)) => [above, vec2(-above.x, above.y)],
    };
    ((above + below).length() <= BALANCED * size).then_some((below - above) * 0.5)
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
    use ppum::crack::{Crack, CrackEnd, End, TipId};
    use ppum::dataset::{Material, StressState};

    const RADII: [f64; 3] = [0.3, 0.4, 0.5];

    /// A pressure by the distance to the tip.
    struct Pressure<'p>(&'p (dyn Fn(f64) -> f64 + Sync));

    impl TipLoads for Pressure<'_> {
        fn traction(&self, _: u32, side: Side, x: Vec2) -> Option<[f64; 2]> {
            let sign = if side == Side::Above { 1.0 } else { -1.0 };
            Some([0.0, sign * (self.0)(0.3 - x.x)])
        }
    }

    /// The integrals for a tip at (0.3, 0) at the right end of a crack.
    fn integrals(load: &dyn TipLoads) -> Modes {
        let points = vec![vec2(-0.5, 0.0), vec2(0.3, 0.0)];
        let crack = Crack::polyline(points, [CrackEnd::Tip; 2]);
        let material = Material { young: 2.0, poisson: 0.2, state: StressState::PlaneStress };
        let tip = TipId { crack: 0, end: End::Last };
        let path = TipPath::new(&crack, tip, RADII[2]);
        TipFaces {
            path: &path,
            body: &TipMaterialBody::new(&material, 0.0),
            radii: &RADII,
            load,
            is_balanced: true,
            is_half: false,
            is_axisymmetric: false,
        }
        .integrals()
    }

    /// A pressure p on both faces gives E′/2 M = √(2/π) ∫ p q/√r dr, with r = s²: loads that jump
    /// at r = c, have a kink there, and a layer. Gauss rules up to c and from there are
    /// the reference.
    #[test]
    fn loads_that_jump_and_bend() {
        let exact = |p: &dyn Fn(f64) -> f64, radius: f64, from: f64, to: f64| {
            let node = |(s, ds): (f64, f64)| 2.0 * ds * p(s * s) * cut_off(s.powi(4), radius).0;
            let sum: f64 = gauss(40).on(from.sqrt(), to.min(radius).sqrt()).map(node).sum();
            (2.0 / std::f64::consts::PI).sqrt() * sum
        };
        let check = |p: &(dyn Fn(f64) -> f64 + Sync), breaks: &[f64]| {
            for ([k1, k2, _], radius) in integrals(&Pressure(p)).into_iter().zip(RADII) {
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
