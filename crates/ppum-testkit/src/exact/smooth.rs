//! A smooth manufactured displacement with its body force.

use super::field::{Component, ElasticField, ExactField, number};
use ppum::dataset::Material;
use ppum::vec2::{Vec2, vec2};

/// u = (sin(2x + 0.3) cos(1.5y) + 0.2xy, cos(1.7x) sin(2y − 0.4)).
#[derive(Clone, Copy, Debug)]
pub struct Smooth {
    /// The material.
    pub material: Material,
}

impl Smooth {
    /// The body force f = −div σ = −μ Δu − (λ + μ) grad div u.
    #[must_use]
    pub fn body_force(&self, p: Vec2) -> Vec2 {
        let (mu, lambda) = (self.material.mu(), self.material.lambda());
        let (s, c) = (2.0 * p.x + 0.3).sin_cos();
        let (sy, cy) = (1.5 * p.y).sin_cos();
        let (sx, cx) = (1.7 * p.x).sin_cos();
        let (d, e) = (2.0 * p.y - 0.4).sin_cos();
        let laplace = vec2(-6.25 * s * cy, -6.89 * cx * d);
        let grad_div = vec2(-4.0 * s * cy - 3.4 * sx * e, 0.2 - 3.0 * c * sy - 4.0 * cx * d);
        -(laplace * mu + grad_div * (lambda + mu))
    }

    /// The body force as formulas of x and y.
    #[must_use]
    pub fn body_force_formulas(&self) -> [String; 2] {
        let (mu, lambda) = (self.material.mu(), self.material.lambda());
        let [near, far, unit] = [6.25 * mu, 6.89 * mu, lambda + mu].map(number);
        [
            format!(
                "{near}*sin(2*x + 0.3)*cos(1.5*y) \
                 + {unit}*(4*sin(2*x + 0.3)*cos(1.5*y) + 3.4*sin(1.7*x)*cos(2*y - 0.4))"
            ),
            format!(
                "{far}*cos(1.7*x)*sin(2*y - 0.4) \
                 + {unit}*(3*cos(2*x + 0.3)*sin(1.5*y) + 4*cos(1.7*x)*sin(2*y - 0.4) - 0.2)"
            ),
        ]
    }
}

impl ExactField<2> for Smooth {
    fn evaluate(&self, p: Vec2) -> [Component; 2] {
        let (s, c) = (2.0 * p.x + 0.3).sin_cos();
        let (sy, cy) = (1.5 * p.y).sin_cos();
        let (sx, cx) = (1.7 * p.x).sin_cos();
        let (d, e) = (2.0 * p.y - 0.4).sin_cos();
        [
            Component {
                value: s * cy + 0.2 * p.x * p.y,
                gradient: vec2(2.0 * c * cy + 0.2 * p.y, 0.2 * p.x - 1.5 * s * sy),
            },
            Component { value: cx * d, gradient: vec2(-1.7 * sx * d, 2.0 * cx * e) },
        ]
    }

    fn formulas(&self) -> [String; 2] {
        ["sin(2*x + 0.3)*cos(1.5*y) + 0.2*x*y".to_owned(), "cos(1.7*x)*sin(2*y - 0.4)".to_owned()]
    }
}

impl ElasticField for Smooth {
    fn material(&self) -> Material {
        self.material
    }

    fn stress_formulas(&self) -> [String; 3] {
        let (mu, lambda) = (self.material.mu(), self.material.lambda());
        let [along, across, shear] = [2.0 * mu + lambda, lambda, mu].map(number);
        let ux = "(2*cos(2*x + 0.3)*cos(1.5*y) + 0.2*y)";
        let vy = "2*cos(1.7*x)*cos(2*y - 0.4)";
        [
            format!("{along}*{ux} + {across}*{vy}"),
            format!("{across}*{ux} + {along}*{vy}"),
            format!(
                "{shear}*(0.2*x - 1.5*sin(2*x + 0.3)*sin(1.5*y) \
                 - 1.7*sin(1.7*x)*sin(2*y - 0.4))"
            ),
        ]
    }
}
