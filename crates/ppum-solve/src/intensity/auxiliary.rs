//! The auxiliary fields in a uniform body of the tip's material: Williams fields of unit intensity, and that of a unit
//! force at the tip.

use super::integral::MODES;
use ppum::crack::TipPoint;
use ppum::dataset::Material;
use ppum::function::westergaard;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::{PI, TAU};

/// Of each component its gradient, in the tip's frame.
pub(super) type Gradients = [Vec2; 2];

/// The field of one mode as the interaction integral takes it, at a point in the tip's frame.
#[derive(Clone, Copy)]
pub(super) struct Auxiliary {
    /// ∇uᵃ_i
    pub(super) gradient: Gradients,
    /// ∇uᵃ_i,1, like r^(−3/2) at the tip, or r^(−2) of the force. Zero unless it was asked for.
    pub(super) along: Gradients,
}

/// The body of the tip's material that the fields are in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// λ and μ of the plane law.
    pub(super) lame: [f64; 2],
    /// Kolosov's κ.
    kappa: f64,
    /// 1 / (2μ √(2π)) and 1 / (8πμ).
    scale: [f64; 2],
}

impl Body {
    pub(super) fn new(material: &Material) -> Self {
        let (lambda, mu) = (material.lambda(), material.mu());
        let scale = [0.5 / (mu * TAU.sqrt()), 0.125 / (PI * mu)];
        Self { lame: [lambda, mu], kappa: material.kolosov(), scale }
    }

    /// The fields with K_I = 1 and with K_II = 1 and that of the force, with derivatives up to `D`: 1 for the gradient alone,
    /// 2 for its derivative along the crack.
    #[inline]
    pub(super) fn fields<const D: usize>(&self, point: &TipPoint<f64>) -> [Auxiliary; MODES] {
        let [f1, f2, f3, f4] = westergaard::<f64, D>(point);
        let first = |f: &Jet<f64>| vec2(f.x, f.y);
        let [one, two] = self.modes(first(&f1), first(&f2), first(&f3), first(&f4));
        let [mut along_one, mut along_two] = [[Vec2::ZERO; 2]; 2];
        if D >= 2 {
            let second = |f: &Jet<f64>| vec2(f.xx, f.xy);
            [along_one, along_two] = self.modes(second(&f1), second(&f2), second(&f3), second(&f4));
        }
        [
            Auxiliary { gradient: one, along: along_one },
            Auxiliary { gradient: two, along: along_two },
            self.point_force::<D>(point),
        ]
    }

    /// Both modes from a derivative of the Westergaard functions F₁…F₄: with κ of Kolosov, 2μ√(2π) u is
    /// ((κ−1)F₁ + F₃, (κ+1)F₂ − F₄) and ((κ+1)F₂ + F₄, −(κ−1)F₁ + F₃).
    #[inline]
    fn modes(&self, f1: Vec2, f2: Vec2, f3: Vec2, f4: Vec2) -> [Gradients; 2] {
        let scale = self.scale[0];
        let (f1, f2) = (f1 * (scale * (self.kappa - 1.0)), f2 * (scale * (self.kappa + 1.0)));
        let (f3, f4) = (f3 * scale, f4 * scale);
        [[f1 + f3, f2 - f4], [f2 + f4, f3 - f1]]
    }

    /// The field of the force 1 along the axis at the tip of a crack, or in the plane without one: a pull in the direction of r,
    ///
    /// ```text
    /// σ_rr = −cos θ / (π r)   σ_θθ = σ_rθ = 0
    /// 8πμ u_x = −(κ + 1) ln r − 2 sin² θ   8πμ u_y = −(κ − 1) θ + 2 sin θ cos θ
    /// ```
    ///
    /// (Kfouri 1986). It loads no ray from the tip, so no face along the axis, and its gradient is that of one angle everywhere.
    #[inline]
    fn point_force<const D: usize>(&self, point: &TipPoint<f64>) -> Auxiliary {
        let (kappa, scale) = (self.kappa, self.scale[1]);
        let square = point.x * point.x + point.y * point.y;
        let inverse = 1.0 / square;
        // cos² θ, sin² θ, sin θ cos θ
        let (cc, ss) = (point.x * point.x * inverse, point.y * point.y * inverse);
        let sc = point.x * point.y * inverse;
        let (a, b, c) = ((kappa + 1.0) * scale, 2.0 * scale, (kappa - 1.0) * scale);
        let gradient = [
            vec2(-a * point.x + 2.0 * b * ss * point.x, -a * point.y - 2.0 * b * cc * point.y)
                * inverse,
            vec2(c + b * (ss - cc), 0.0) * (point.y * inverse)
                + vec2(0.0, b * (cc - ss) - c) * (point.x * inverse),
        ];
        if D < 2 {
            return Auxiliary { gradient, along: [Vec2::ZERO; 2] };
        }
        let along = [
            vec2(
                a * (cc - ss) + 2.0 * b * (ss - 4.0 * sc * sc),
                2.0 * sc * (a + 2.0 * b * (cc - ss)),
            ),
            vec2(
                -2.0 * sc * (c + b + 2.0 * b * (ss - cc)),
                c * (cc - ss) + b * (3.0 * ss - cc - 4.0 * ss * (ss - cc)),
            ),
        ];
        Auxiliary { gradient, along: along.map(|g| g * inverse) }
    }
}

/// σ = λ tr(ε) I + 2μ ε of a gradient.
#[inline]
pub(super) fn stress([lambda, mu]: [f64; 2], u: &Gradients) -> [[f64; 2]; 2] {
    let (trace, shear) = (lambda * (u[0].x + u[1].y), mu * (u[0].y + u[1].x));
    [[trace + 2.0 * mu * u[0].x, shear], [shear, trace + 2.0 * mu * u[1].y]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::StressState;

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
                let at =
                    |dx: f64, dy: f64| Body::new(&material).fields::<2>(&point(x + dx, y + dy));
                let own = at(0.0, 0.0);
                let [e, w, n, s] = [[h, 0.0], [-h, 0.0], [0.0, h], [0.0, -h]];
                let close = |a: Vec2, b: Vec2| assert!((a - b).length() < 1e-7, "{a:?} {b:?}");
                for i in 0..2 {
                    let u = |[dx, dy]: [f64; 2]| displacement(x + dx, y + dy)[i];
                    close(own[2].gradient[i], vec2(u(e) - u(w), u(n) - u(s)) / (2.0 * h));
                }
                for (mode, field) in own.iter().enumerate() {
                    for i in 0..2 {
                        let along = |[dx, dy]: [f64; 2]| at(dx, dy)[mode].gradient[i].x;
                        let difference = vec2(along(e) - along(w), along(n) - along(s)) / (2.0 * h);
                        close(field.along[i], difference);
                    }
                }
            }
        }
    }
}
