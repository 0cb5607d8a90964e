//! The course of an interface through a box.

use super::interface::{Interface, Interfaces};
use crate::quadrature::{may_meet, zero};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::inside;

/// Steps of the grid on which an interface is looked for. An interface that lies between them cuts
/// at most a corner of a patch, in which its weight vanishes.
const STEPS: usize = 16;

/// Distance beside an interface at which its two sides are looked at, in parts of a box: beyond
/// rounding, and less than a material that varies smoothly changes over.
pub(crate) const BESIDE: f64 = 1e-6;

/// Contrast below which the material counts as continuous: the kink of the solution is of
/// this size.
const LEAST_CONTRAST: f64 = 1e-4;

/// A point of an interface at which the material jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InterfacePoint {
    /// The point.
    pub(crate) at: Vec2,
    /// Unit normal, toward growing ψ.
    pub(crate) normal: Vec2,
    /// Sum of the jumps of λ and 2μ (of κ) over the sum of both sides' moduli, or the jump of the
    /// given strains, or of α, over the largest anywhere, if that is more; between 0 and 1.
    pub(crate) contrast: f64,
}

impl Interfaces<'_> {
    /// Points of an interface inside an open box and the domain at which the material jumps, on the
    /// lines of a grid; none if it does not run there.
    pub(crate) fn places(&self, interface: &Interface, rect: &Rect) -> Vec<InterfacePoint> {
        let level = interface.level.as_ref();
        let size = rect.size();
        if !(size.x > 0.0 && size.y > 0.0 && may_meet(level, rect)) {
            return Vec::new();
        }
        let beside = BESIDE * size.x.min(size.y);
        let zeros = zeros(level, rect).into_iter();
        let inner = zeros.filter(|&at| inside(rect, at) && self.domain.contains(at));
        inner.filter_map(|at| self.place(interface, at, beside)).collect()
    }

    fn place(&self, interface: &Interface, at: Vec2, beside: f64) -> Option<InterfacePoint> {
        let normal = interface.gradient(at).unit();
        let sides = [-1.0, 1.0].map(|sign| at + normal * (sign * beside));
        let contrast = self.law.contrast(sides).max(self.contrast_of_given(sides, at));
        (contrast > LEAST_CONTRAST).then_some(InterfacePoint { at, normal, contrast })
    }

    /// None on a crack, whose faces need no kink to have gradients of their own.
    fn contrast_of_given(&self, sides: [Vec2; 2], at: Vec2) -> f64 {
        let [below, above] = sides.map(|p| self.given(p));
        let contrast = |k: usize| {
            let jumps = below[k].iter().zip(&above[k]).map(|(below, above)| (above - below).abs());
            let jump = jumps.fold(0.0, f64::max);
            if jump > LEAST_CONTRAST * self.largest[k] { jump / self.largest[k] } else { 0.0 }
        };
        let contrast = contrast(0).max(contrast(1)).min(1.0);
        let beside = (sides[1] - sides[0]).length();
        if contrast > 0.0 && self.is_on_crack(at, beside) { 0.0 } else { contrast }
    }

    fn is_on_crack(&self, p: Vec2, beside: f64) -> bool {
        self.cracks.iter().any(|crack| crack.distance(p) <= beside)
    }
}

/// Zeros with a change of sign on the lines of a grid over a box.
fn zeros(level: &dyn Fn(Vec2) -> f64, rect: &Rect) -> Vec<Vec2> {
    let step = rect.size() * (1.0 / STEPS as f64);
    let node = |i: usize, j: usize| rect.min + vec2(step.x * i as f64, step.y * j as f64);
    let row = |j| (0..=STEPS).map(move |i| level(node(i, j)) > 0.0).collect::<Vec<_>>();
    let above: Vec<Vec<bool>> = (0..=STEPS).map(row).collect();
    let mut zeros = Vec::new();
    for j in 0..=STEPS {
        for i in 0..=STEPS {
            for (k, l) in [(i + 1, j), (i, j + 1)] {
                if k <= STEPS && l <= STEPS && above[j][i] != above[l][k] {
                    zeros.push(zero_between(level, node(i, j), node(k, l)));
                }
            }
        }
    }
    zeros
}

/// A change of sign between two points.
fn zero_between(level: &dyn Fn(Vec2) -> f64, a: Vec2, b: Vec2) -> Vec2 {
    let at = |t: f64| a + (b - a) * t;
    at(zero(&|t| level(at(t)), [0.0, level(a)], [1.0, level(b)]))
}
