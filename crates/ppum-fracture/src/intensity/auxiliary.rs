//! The auxiliary fields in a uniform body of the tip's material: Williams fields of unit intensity,
//! and that of a unit force at the tip.

use super::sums::{Gradients, MODES};
use ppum::anisotropy::{PlaneStiffness, TipFields, turned};
use ppum::crack::TipPoint;
use ppum::dataset::{Elasticity, Material};
use ppum::function::westergaard;
use ppum::real::Real;
use ppum::vec2::Vec2;
use ppum_solve::law::Coefficients;
use std::f64::consts::{PI, TAU};

/// The field of one mode as the interaction integral takes it, at a point in the tip's frame.
#[derive(Clone, Copy)]
pub(super) struct Auxiliary<R = f64> {
    /// 𝓛uᵃ: uᵃ_,1 of a straight crack.
    pub(super) derivative: [R; 2],
    /// ∇uᵃ_i
    pub(super) gradient: Gradients<R>,
    /// ∇𝓛uᵃ, like r^(−3/2) at the tip, or r^(−2) of the force. Zero unless it was asked for.
    pub(super) along: Gradients<R>,
}

impl<R: Real> Auxiliary<R> {
    /// The field of a straight crack.
    #[inline(always)]
    fn new(gradient: Gradients<R>, along: Gradients<R>) -> Self {
        Self { derivative: [gradient[0][0], gradient[1][0]], gradient, along }
    }
}

/// The body of the tip's material that the fields are in, and the crack's curvature there.
#[derive(Clone, Copy, Debug)]
pub(super) struct TipMaterialBody {
    /// The coefficients of the law, in the frame of the tip.
    pub(super) moduli: Coefficients,
    /// Kolosov's κ.
    pub(super) kolosov: f64,
    /// The curvature of the crack at the tip, positive to the left.
    pub(super) curvature: f64,
    /// E′; 1/a₁₁ of an anisotropic body.
    pub(super) modulus: f64,
    /// The parts of σ_12 and σ_22 at the tip in T.
    pub(super) faces: [f64; 2],
    /// C₁₂/C₁₁: faces stay closed where K_I is −C₁₂/C₁₁ K_II. Zero of an isotropic body.
    pub(super) coupling: f64,
    /// The fields of an anisotropic body.
    anisotropic: Option<TipFields>,
    /// 1 / (2μ √(2π)) and 1 / (8πμ).
    scale: [f64; 2],
}

impl TipMaterialBody {
    pub(super) fn new(material: &Material, curvature: f64) -> Self {
        let (lambda, mu) = (material.lambda(), material.mu());
        let scale = [0.5 / (mu * TAU.sqrt()), 0.125 / (PI * mu)];
        let (kolosov, modulus) = (material.kolosov(), material.effective_young());
        let moduli = [lambda, mu, 0.0, 0.0, 0.0, 0.0];
        let (faces, anisotropic) = ([0.0, 1.0], None);
        let coupling = 0.0;
        Self { moduli, kolosov, curvature, modulus, faces, coupling, anisotropic, scale }
    }

    /// The body at a tip with a direction of growth.
    pub(super) fn at(body: &Elasticity, [tip, axis]: [Vec2; 2], curvature: f64) -> Self {
        let isotropic = Self::new(&body.at(tip), curvature);
        let Some(anisotropy) = &body.anisotropy else { return isotropic };
        let law = anisotropy.at_tip(tip, axis);
        Self {
            moduli: coefficients(law.stiffness()),
            modulus: 1.0 / law.compliance()[0],
            faces: law.faces(),
            coupling: law.opening([0.0, 1.0]),
            anisotropic: Some(law.fields()),
            ..isotropic
        }
    }

    /// The coefficients of the law in the frame of the tip, from those in the world's.
    pub(super) fn in_frame(&self, world: Coefficients, axis: Vec2) -> Coefficients {
        if self.anisotropic.is_none() {
            return world;
        }
        let [c12, c66, xx, yy, c16, c26] = world;
        let both = c12 + 2.0 * c66;
        coefficients(turned([xx + both, c12, c16, yy + both, c26, c66], [axis.x, -axis.y]))
    }

    /// ν of plane strain, by λ and μ.
    pub(super) fn poisson(&self) -> f64 {
        let [lambda, mu, ..] = self.moduli;
        0.5 * lambda / (lambda + mu)
    }

    /// The fields at a point, with derivatives up to `D`.
    pub(super) fn fields_at<const D: usize>(&self, point: &TipPoint<f64>) -> [Auxiliary; MODES] {
        if self.curvature == 0.0 {
            self.fields::<f64, D>(point)
        } else {
            self.arc_fields::<f64, D>(point)
        }
    }

    /// The fields of a straight crack with K_I = 1 and with K_II = 1 and that of the force, with
    /// derivatives up to `D`: 1 for the gradient alone, 2 for its derivative along the crack.
    #[inline(always)]
    pub(super) fn fields<R: Real, const D: usize>(
        &self,
        point: &TipPoint<R>,
    ) -> [Auxiliary<R>; MODES] {
        if let Some(fields) = &self.anisotropic {
            let [[one, a], [two, b], [force, c]] = fields.gradients(point);
            return [Auxiliary::new(one, a), Auxiliary::new(two, b), Auxiliary::new(force, c)];
        }
        let [f1, f2, f3, f4] = westergaard::<R, D>(point);
        let [one, two] = self.modes([f1.x, f1.y], [f2.x, f2.y], [f3.x, f3.y], [f4.x, f4.y]);
        let mut along = [[[point.x.broadcast(0.0); 2]; 2]; 2];
        if D >= 2 {
            along = self.modes([f1.xx, f1.xy], [f2.xx, f2.xy], [f3.xx, f3.xy], [f4.xx, f4.xy]);
        }
        [
            Auxiliary::new(one, along[0]),
            Auxiliary::new(two, along[1]),
            self.point_force::<R, D>(point),
        ]
    }

    /// Both modes from a derivative of the Westergaard functions F₁…F₄: with κ of Kolosov, 2μ√(2π)
    /// u is ((κ−1)F₁ + F₃, (κ+1)F₂ − F₄) and ((κ+1)F₂ + F₄, −(κ−1)F₁ + F₃).
    #[inline(always)]
    fn modes<R: Real>(&self, f1: [R; 2], f2: [R; 2], f3: [R; 2], f4: [R; 2]) -> [Gradients<R>; 2] {
        let scale = self.scale[0];
        let (a, b) = (scale * (self.kolosov - 1.0), scale * (self.kolosov + 1.0));
        let (f1, f2) = (times(f1, a), times(f2, b));
        let (f3, f4) = (times(f3, scale), times(f4, scale));
        [[plus(f1, f3), minus(f2, f4)], [plus(f2, f4), minus(f3, f1)]]
    }

    /// The field of the force 1 along the axis at the tip of a crack, or in the plane without one:
    /// a pull in the direction of r,
    ///
    /// ```text
    /// σ_rr = −cos θ / (π r)   σ_θθ = σ_rθ = 0
    /// 8πμ u_x = −(κ + 1) ln r − 2 sin² θ   8πμ u_y = −(κ − 1) θ + 2 sin θ cos θ
    /// ```
    ///
    /// (Kfouri 1986). It loads no ray from the tip, so no face along the axis, and its gradient is
    /// that of one angle everywhere.
    #[inline(always)]
    fn point_force<R: Real, const D: usize>(&self, point: &TipPoint<R>) -> Auxiliary<R> {
        let (kappa, scale, one) = (self.kolosov, self.scale[1], point.x.broadcast(1.0));
        let inverse = one / (point.x * point.x + point.y * point.y);
        let (x, y) = (point.x * inverse, point.y * inverse);
        // cos² θ, sin² θ, sin θ cos θ
        let (cc, ss, sc) = (point.x * x, point.y * y, point.x * y);
        let (two, four) = (one.broadcast(2.0), one.broadcast(4.0));
        let (a, b) = (one.broadcast((kappa + 1.0) * scale), one.broadcast(2.0 * scale));
        let c = one.broadcast((kappa - 1.0) * scale);
        let gradient = [
            [(two * b * ss - a) * x, -((a + two * b * cc) * y)],
            [(c + b * (ss - cc)) * y, (b * (cc - ss) - c) * x],
        ];
        let mut along = [[one.broadcast(0.0); 2]; 2];
        if D >= 2 {
            let [first, second] = [
                [
                    a * (cc - ss) + two * b * (ss - four * sc * sc),
                    two * sc * (a + two * b * (cc - ss)),
                ],
                [
                    -(two * sc * (c + b + two * b * (ss - cc))),
                    c * (cc - ss) + b * (one.broadcast(3.0) * ss - cc - four * ss * (ss - cc)),
                ],
            ];
            along = [
                [first[0] * inverse, first[1] * inverse],
                [second[0] * inverse, second[1] * inverse],
            ];
        }
        Auxiliary::new(gradient, along)
    }
}

/// The coefficients of a stiffness.
fn coefficients([c11, c12, c16, c22, c26, c66]: PlaneStiffness) -> Coefficients {
    let both = c12 + 2.0 * c66;
    [c12, c66, c11 - both, c22 - both, c16, c26]
}

#[inline(always)]
fn times<R: Real>(a: [R; 2], factor: f64) -> [R; 2] {
    let factor = a[0].broadcast(factor);
    [a[0] * factor, a[1] * factor]
}

#[inline(always)]
fn plus<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
fn minus<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// σ = λ tr(ε) I + 2μ ε of a gradient, and what the coefficients of an anisotropic body add, which
/// are zero of others.
#[inline(always)]
pub(super) fn stress<R: Real>(of: Coefficients<R>, u: &Gradients<R>) -> Gradients<R> {
    let [lambda, mu, xx, yy, along, across] = of;
    let (two_mu, angle) = (mu + mu, u[0][1] + u[1][0]);
    let (trace, shear) = (lambda * (u[0][0] + u[1][1]), mu * angle);
    let shear = shear + (along * u[0][0] + across * u[1][1]);
    [
        [trace + two_mu * u[0][0] + (xx * u[0][0] + along * angle), shear],
        [shear, trace + two_mu * u[1][1] + (yy * u[1][1] + across * angle)],
    ]
}

/// The difference of two gradients.
#[inline(always)]
pub(super) fn difference<R: Real>(g: &Gradients<R>, other: &Gradients<R>) -> Gradients<R> {
    [minus(g[0], other[0]), minus(g[1], other[1])]
}

/// σ_ij g_i,j of a symmetric stress.
#[inline(always)]
pub(super) fn work<R: Real>(s: &Gradients<R>, g: &Gradients<R>) -> R {
    s[0][0] * g[0][0] + s[0][1] * (g[0][1] + g[1][0]) + s[1][1] * g[1][1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::StressState;
    use ppum::vec2::{Vec2, vec2};

    fn point(x: f64, y: f64) -> TipPoint<f64> {
        TipPoint { x, y, sign: if y >= 0.0 { 1.0 } else { -1.0 }, branch: 1.0 }
    }

    /// Derivatives by differences, and the displacement of the force itself.
    #[test]
    fn derivatives_of_the_fields() {
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            let material = Material { young: 2.0, poisson: 0.27, state };
            let (kappa, scale) = (material.kolosov(), 8.0 * PI * material.mu());
            let displacement = |x: f64, y: f64| {
                let (r, theta) = (x.hypot(y), y.atan2(x));
                let (s, c) = theta.sin_cos();
                [-(kappa + 1.0) * r.ln() - 2.0 * s * s, 2.0 * s * c - (kappa - 1.0) * theta]
                    .map(|u| u / scale)
            };
            for (x, y) in [(0.3, 0.4), (-0.7, 0.2), (-0.5, -0.6), (0.2, -0.9), (0.6, 0.0)] {
                let h = 1e-5;
                let at = |dx: f64, dy: f64| {
                    TipMaterialBody::new(&material, 0.0).fields::<f64, 2>(&point(x + dx, y + dy))
                };
                let own = at(0.0, 0.0);
                let [e, w, n, s] = [[h, 0.0], [-h, 0.0], [0.0, h], [0.0, -h]];
                let close = |a: Vec2, b: Vec2| assert!((a - b).length() < 1e-7, "{a:?} {b:?}");
                for i in 0..2 {
                    let u = |[dx, dy]: [f64; 2]| displacement(x + dx, y + dy)[i];
                    close(own[2].gradient[i].into(), vec2(u(e) - u(w), u(n) - u(s)) / (2.0 * h));
                }
                for (mode, field) in own.iter().enumerate() {
                    for i in 0..2 {
                        let along = |[dx, dy]: [f64; 2]| at(dx, dy)[mode].gradient[i][0];
                        let difference = vec2(along(e) - along(w), along(n) - along(s)) / (2.0 * h);
                        close(field.along[i].into(), difference);
                    }
                }
            }
        }
    }
}
