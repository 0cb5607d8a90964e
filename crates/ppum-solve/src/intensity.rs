//! Stress intensity factors by the interaction integral.
//!
//! With the field u, an auxiliary Williams field uᵃ with K = 1 in one mode, both in the tip's frame,
//! and a cut-off q that is 1 at the tip and 0 outside a disc (Yau, Wang & Corten 1980; domain form
//! of Moran & Shih 1987)
//!
//! ```text
//! M = ∫ (σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 − σ_ik εᵃ_ik δ_1j) q_,j − b_i uᵃ_i,1 q dA      K = E′/2 M
//! ```
//!
//! The crack must be straight inside the disc, its faces free, and nothing else may lie in it, no
//! interface of two materials either. The material is taken to be uniform in the disc: where it varies
//! smoothly the values at the radii differ, and tend to the factors with the radius.

use crate::law::{Law, LawAt};
use crate::quadrature::{Kink, Rule};
use crate::space::Space;
use ppum::crack::{Crack, LocalTip, Side, TipId, tips};
use ppum::dataset::{Dataset, Material, Ring, TipIntensity};
use ppum::field::Field;
use ppum::function::westergaard;
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Exponent of the cut-off q = (1 − r²/R²)^m. It is smooth enough for plain Gauss rules across r = R:
/// with m = 4 their error is seen at 1e-7, with more at 1e-10.
const CUT_OFF_POWER: i32 = 6;

/// Gauss points in each direction of cells that are large in the disc, where the cut-off bends.
const ORDER: usize = 12;

/// Part of the radius below which a cell is small and the order of the assembly is enough.
const SMALL: f64 = 0.2;

/// Radii in parts of the largest disc free of borders, kinks and other cracks; the last one is
/// preferred, its integral averages most.
const RADII: [f64; 3] = [0.5, 0.7, 0.9];

/// Part of the free radius below which a tip lies on an interface.
const LEAST_RADIUS: f64 = 1e-6;

/// Rays around a tip and steps along each on which curved interfaces are looked for.
const RAYS: u32 = 64;
const STEPS: u32 = 64;

/// A body force b at a point.
pub type BodyForce<'a> = &'a (dyn Fn(Vec2) -> [f64; 2] + Sync);

/// The stress intensity factors of all tips of a step, each at three radii; none unless the field is
/// a displacement, and none of tips on an interface of two materials.
///
/// # Panics
/// If the field is not of the dataset and step of `space`.
#[must_use]
pub fn intensities(
    dataset: &Dataset,
    field: &Field<'_>,
    space: &Space<'_>,
    force: Option<BodyForce<'_>>,
) -> Vec<TipIntensity> {
    let Some(elasticity) = dataset.equation.elastic() else { return Vec::new() };
    if field.components() != dataset.equation.components() {
        return Vec::new();
    }
    let law = Law::new(&dataset.equation);
    tips(&field.step.cracks)
        .filter_map(|tip| {
            let radius = free_radius(&field.step.cracks, &dataset.domain.bounds, tip);
            // The auxiliary field is that of the material at the tip.
            let at = field.step.cracks[tip.crack as usize].end_point(tip.end);
            let apart = space.interfaces().map(|kink| interface_distance(kink, at, radius));
            let largest = apart.fold(radius, f64::min);
            let (material, law) = (elasticity.at(at), law.at(at));
            let integral = Interaction { field, space, law, material, tip, force };
            (largest > LEAST_RADIUS * radius).then(|| {
                let rings = integral.rings(RADII.map(|part| part * largest));
                let Ring { k1, k2, .. } = rings[RADII.len() - 1];
                TipIntensity { tip, k1, k2, rings: rings.to_vec() }
            })
        })
        .collect()
}

/// Radius of the largest disc around a tip that holds no border and no part of a crack but the last
/// segment of its own.
#[must_use]
pub fn free_radius(cracks: &[Crack], domain: &Rect, tip: TipId) -> f64 {
    let own = &cracks[tip.crack as usize];
    let p = own.end_point(tip.end);
    let border = (p - domain.min).min(domain.max - p);
    let vertices = own.points.iter().filter(|&&v| v != p).map(|&v| (v - p).length());
    let segments = cracks.iter().flat_map(|c| c.points.windows(2));
    let others = segments.filter(|s| !s.contains(&p)).map(|s| segment_distance(s, p));
    vertices.chain(others).fold(border.x.min(border.y), f64::min)
}

/// Distance of a point to an interface, as far as it is below `reach`; of a curve a lower bound, by the
/// sides of points on rays.
fn interface_distance(kink: &Kink, p: Vec2, reach: f64) -> f64 {
    match kink {
        Kink::Line([a, b]) => ((*b - *a).unit().cross(p - *a)).abs(),
        Kink::Segment(ends) => segment_distance(ends, p),
        Kink::Curve(level) => {
            let own = level(p);
            let crosses = |step: &u32| {
                let radius = reach * f64::from(*step) / f64::from(STEPS);
                let ray = |k: u32| TAU * f64::from(k) / f64::from(RAYS);
                let point = |k: u32| p + vec2(ray(k).cos(), ray(k).sin()) * radius;
                (0..RAYS).any(|k| level(point(k)) * own <= 0.0)
            };
            let first = (1..=STEPS).find(crosses).unwrap_or(STEPS + 1);
            reach * f64::from(first - 1) / f64::from(STEPS)
        }
    }
}

fn segment_distance(s: &[Vec2], p: Vec2) -> f64 {
    let (d, e) = (s[1] - s[0], p - s[0]);
    let t = (e.dot(d) / d.dot(d)).clamp(0.0, 1.0);
    (e - d * t).length()
}

struct Interaction<'a> {
    field: &'a Field<'a>,
    space: &'a Space<'a>,
    law: LawAt,
    material: Material,
    tip: TipId,
    force: Option<BodyForce<'a>>,
}

/// Integrals of both modes over each disc.
type Integrals = [[f64; 2]; RADII.len()];

impl Interaction<'_> {
    /// All discs in one pass over the cells; `radii` ascend.
    fn rings(&self, radii: [f64; RADII.len()]) -> [Ring; RADII.len()] {
        let center = self.field.step.cracks[self.tip.crack as usize].end_point(self.tip.end);
        let quadrature = self.space.quadrature(0);
        let (cells, largest) = (&self.space.partition.cell, radii[RADII.len() - 1]);
        let near = (0..cells.len()).filter(|&c| cells[c].distance(center) < largest);
        let near: Vec<_> = near.collect();
        let parts: Vec<Integrals> = near
            .par_iter()
            .map(|&c| {
                let small = cells[c].size().length() < SMALL * radii[0];
                let order = if small { self.space.degree() + 4 } else { ORDER };
                let coverers = &self.space.coverers[c];
                let rules = quadrature.disc(&cells[c], coverers, center, largest, order);
                sum(rules.iter().map(|rule| self.rule(rule, &radii)))
            })
            .collect();
        let factor = 0.5 * self.material.effective_young();
        let integrals = sum(parts.into_iter());
        std::array::from_fn(|k| {
            let [k1, k2] = integrals[k].map(|m| factor * m);
            Ring { r1: 0.0, r2: radii[k], k1, k2 }
        })
    }

    fn rule(&self, rule: &Rule, radii: &[f64; RADII.len()]) -> Integrals {
        let local = self.field.at(rule.anchor);
        let crack = &self.field.step.cracks[self.tip.crack as usize];
        let tip = LocalTip::new(crack, self.tip.end, rule.anchor);
        let points = rule.offsets.iter().zip(&rule.weights);
        sum(points.map(|(&offset, &weight)| {
            let point = tip.point([offset.x, offset.y], Side::Above);
            let square = point.x * point.x + point.y * point.y;
            if square >= radii[RADII.len() - 1].powi(2) {
                return Integrals::default();
            }
            let mut u = [Jet::constant(0.0); 2];
            local.over_patches::<f64, 1>([offset.x, offset.y], Side::Above, &rule.patches, &mut u);
            let u = in_frame(&u, tip.axis);
            let b = self.force.map_or(Vec2::ZERO, |force| force(rule.anchor + offset).into());
            let b = vec2(tip.axis.dot(b), tip.axis.cross(b));
            let aux = auxiliary(&self.material, &westergaard::<f64, 1>(&point));
            radii.map(|radius| {
                let (q, slope) = cut_off(square, radius);
                let dq = vec2(point.x, point.y) * slope;
                aux.map(|a| weight * (self.density(&u, &a, dq) - q * (b.x * a[0].x + b.y * a[1].x)))
            })
        }))
    }

    /// (σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 − σ_ik εᵃ_ik δ_1j) q_,j
    fn density(&self, u: &[Vec2; 2], aux: &[Vec2; 2], dq: Vec2) -> f64 {
        let (s, sa) = (self.law.flux(u), self.law.flux(aux));
        let work = s[0][0] * aux[0].x + s[0][1] * (aux[0].y + aux[1].x) + s[1][1] * aux[1].y;
        let flow = |j: usize| (0..2).map(|i| s[i][j] * aux[i].x + sa[i][j] * u[i].x).sum::<f64>();
        (flow(0) - work) * dq.x + flow(1) * dq.y
    }
}

fn sum(parts: impl Iterator<Item = Integrals>) -> Integrals {
    parts.fold(Integrals::default(), |a, b| {
        std::array::from_fn(|k| [a[k][0] + b[k][0], a[k][1] + b[k][1]])
    })
}

/// q and q′(r)/r for r² = `square`; zero outside the disc.
fn cut_off(square: f64, radius: f64) -> (f64, f64) {
    let base = (1.0 - square / (radius * radius)).max(0.0);
    let slope = -2.0 * f64::from(CUT_OFF_POWER) / (radius * radius);
    (base.powi(CUT_OFF_POWER), slope * base.powi(CUT_OFF_POWER - 1))
}

/// The displacement gradient in a frame with the given x axis.
fn in_frame(u: &[Jet<f64>; 2], axis: Vec2) -> [Vec2; 2] {
    let turned = |g: Vec2| vec2(axis.dot(g), axis.cross(g));
    let (gx, gy) = (turned(vec2(u[0].x, u[0].y)), turned(vec2(u[1].x, u[1].y)));
    [gx * axis.x + gy * axis.y, gy * axis.x - gx * axis.y]
}

/// Displacement gradients of the Williams fields with K_I = 1 and with K_II = 1, in the tip's frame.
///
/// With the Westergaard functions F₁…F₄ and κ of Kolosov, 2μ√(2π) u is
/// ((κ−1)F₁ + F₃, (κ+1)F₂ − F₄) and ((κ+1)F₂ + F₄, −(κ−1)F₁ + F₃).
fn auxiliary(material: &Material, f: &[Jet<f64>; 4]) -> [[Vec2; 2]; 2] {
    let kappa = material.kolosov();
    let scale = 1.0 / (2.0 * material.mu() * std::f64::consts::TAU.sqrt());
    let [f1, f2, f3, f4] = f.map(|jet| vec2(jet.x, jet.y) * scale);
    let (less, more) = (kappa - 1.0, kappa + 1.0);
    [[f1 * less + f3, f2 * more - f4], [f2 * more + f4, f3 - f1 * less]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn interfaces_end_the_disc() {
        let p = vec2(0.1, 0.2);
        let line = Kink::Line([vec2(0.0, 0.5), vec2(1.0, 0.5)]);
        assert!((interface_distance(&line, p, 1.0) - 0.3).abs() < 1e-15);
        let segment = Kink::Segment([vec2(0.5, 0.5), vec2(1.0, 0.5)]);
        assert!((interface_distance(&segment, p, 1.0) - 0.5).abs() < 1e-15);
        let circle = Kink::Curve(Arc::new(|x: Vec2| x.dot(x) - 0.25));
        let found = interface_distance(&circle, p, 1.0);
        let exact = 0.5 - p.length();
        assert!(found <= exact && found > exact - 0.02, "{found} instead of {exact}");
        assert_eq!(interface_distance(&circle, vec2(3.0, 0.0), 1.0), 1.0);
    }
}
