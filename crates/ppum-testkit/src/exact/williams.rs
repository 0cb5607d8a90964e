//! Williams' eigenfunctions at the tip of a straight crack with free faces.

use super::field::{Component, ElasticField, ExactField, RightHandedFrame, Wirtinger, number};
use num_complex::Complex64;
use ppum::dataset::Material;
use ppum::vec2::Vec2;
use std::f64::consts::TAU;

/// A sum of Williams' eigenfunctions of orders n = 1, 2, …: displacements like r^{n/2}.
///
/// In the tip frame (x along the growth, faces at θ = ±π), with Muskhelishvili's potentials
///
/// ```text
/// φ = A z^λ,  ψ = B z^λ,  λ = n/2,  A = a − i b
/// 2μ (u_x + i u_y) = κ φ − z conj(φ′) − conj(ψ)
/// ```
///
/// the faces are free, φ + z conj(φ′) + conj(ψ) = 0 at θ = ±π, if B = −(λ A + (−1)ⁿ Ā)
/// (Muskhelishvili 1953; Williams 1957). The real amplitudes `a` and `b` belong to the modes I and
/// II: order 1 has a = K_I/√(2π), b = K_II/√(2π); order 2 has a = T/4, and b turns the body.
#[derive(Clone, Debug)]
pub struct Williams {
    axes: RightHandedFrame,
    material: Material,
    terms: Vec<WilliamsTerm>,
}

/// One order.
#[derive(Clone, Copy, Debug)]
struct WilliamsTerm {
    order: u32,
    a: f64,
    b: f64,
}

impl WilliamsTerm {
    fn lambda(&self) -> f64 {
        0.5 * f64::from(self.order)
    }

    /// λ ± (−1)ⁿ
    fn shifted(&self) -> [f64; 2] {
        let sign = if self.order.is_multiple_of(2) { 1.0 } else { -1.0 };
        [self.lambda() + sign, self.lambda() - sign]
    }

    /// 2μ w in the tip frame.
    fn displacement(&self, r: f64, theta: f64, kappa: f64) -> Wirtinger {
        let lambda = self.lambda();
        let a = Complex64::new(self.a, -self.b);
        let [plus, minus] = self.shifted();
        let b = Complex64::new(-plus * self.a, minus * self.b);
        let power = |k: f64| Complex64::from_polar(r.powf(k), k * theta);
        let z = Complex64::from_polar(r, theta);
        let phi_prime = lambda * a * power(lambda - 1.0);
        // At the tip z φ′ is 0 for every order, not 0 · ∞.
        let z_phi_prime = if r == 0.0 { 0.0.into() } else { z * phi_prime.conj() };
        let phi_second = lambda * (lambda - 1.0) * a * power(lambda - 2.0);
        let psi_prime = lambda * b * power(lambda - 1.0);
        Wirtinger {
            w: kappa * a * power(lambda) - z_phi_prime - (b * power(lambda)).conj(),
            dz: kappa * phi_prime - phi_prime.conj(),
            dz_bar: -z * phi_second.conj() - psi_prime.conj(),
        }
    }

    /// 2μ (u_x, u_y) in the tip frame as text of `rho` and `phi`.
    fn displacement_text(&self, kappa: f64) -> [String; 2] {
        let (lambda, a, b) = (self.lambda(), self.a, self.b);
        let [plus, minus] = self.shifted();
        let far = 2.0 - lambda;
        let power = power_text(self.order);
        let [c, s] = angle_text(lambda);
        let [c_far, s_far] = angle_text(far);
        let [x0, x1, x2, x3] =
            [a * (kappa + plus), b * (kappa + minus), a * lambda, b * lambda].map(number);
        let [y0, y1, y2, y3] =
            [a * (kappa - plus), b * (minus - kappa), a * lambda, b * lambda].map(number);
        [
            format!("{power}*({x0}*{c} + {x1}*{s} - {x2}*{c_far} + {x3}*{s_far})"),
            format!("{power}*({y0}*{s} + {y1}*{c} - {y2}*{s_far} - {y3}*{c_far})"),
        ]
    }

    /// σ_xx, σ_yy, σ_xy in the tip frame as text of `rho` and `phi`.
    fn stress_text(&self) -> [String; 3] {
        let (lambda, a, b) = (self.lambda(), self.a, self.b);
        let [plus, minus] = self.shifted();
        let steep = lambda * (lambda - 1.0);
        let [c, s] = angle_text(lambda - 1.0);
        let [c3, s3] = angle_text(lambda - 3.0);
        // σ_xx + σ_yy = 4 Re φ′ and σ_yy − σ_xx + 2i σ_xy = 2 (z̄ φ″ + ψ′), sorted by angles.
        let [xc, xs] = [lambda * a * (2.0 + plus), lambda * b * (2.0 + minus)].map(number);
        let [yc, ys] = [lambda * a * (2.0 - plus), lambda * b * (2.0 - minus)].map(number);
        let [sc, ss] = [lambda * b * minus, -lambda * a * plus].map(number);
        let [fa, fb] = [steep * a, steep * b].map(number);
        // r^(λ − 1): order 1 is 1/√r
        let power = match self.order {
            1 => "1/sqrt(rho)".to_owned(),
            order => power_text(order - 2),
        };
        [
            format!("{power}*({xc}*{c} + {xs}*{s} - {fa}*{c3} - {fb}*{s3})"),
            format!("{power}*({yc}*{c} + {ys}*{s} + {fa}*{c3} + {fb}*{s3})"),
            format!("{power}*({sc}*{c} + {ss}*{s} + {fa}*{s3} - {fb}*{c3})"),
        ]
    }
}

/// r^{order/2} as text.
fn power_text(order: u32) -> String {
    match (order / 2, order % 2) {
        (0, 0) => "1".to_owned(),
        (0, _) => "sqrt(rho)".to_owned(),
        (whole, 0) => format!("rho^{whole}"),
        (whole, _) => format!("rho^{whole}*sqrt(rho)"),
    }
}

/// cos(k θ) and sin(k θ) as text.
fn angle_text(k: f64) -> [String; 2] {
    let k = number(k);
    [format!("cos({k}*phi)"), format!("sin({k}*phi)")]
}

impl Williams {
    /// The zero field at a tip that grows along `direction` (of any length).
    #[must_use]
    pub fn new(material: Material, tip: Vec2, direction: Vec2) -> Self {
        Self { axes: RightHandedFrame::new(tip, direction), material, terms: Vec::new() }
    }

    /// Adds the singular field of order 1.
    #[must_use]
    pub fn with_intensities(self, k1: f64, k2: f64) -> Self {
        self.with_term(1, k1 / TAU.sqrt(), k2 / TAU.sqrt())
    }

    /// Adds σ_xx = T in the tip frame, the mode I field of order 2.
    #[must_use]
    pub fn with_t_stress(self, t: f64) -> Self {
        self.with_term(2, 0.25 * t, 0.0)
    }

    /// Adds the fields of one order ≥ 1 with amplitudes `a` (mode I) and `b` (mode II).
    #[must_use]
    pub fn with_term(mut self, order: u32, a: f64, b: f64) -> Self {
        assert!(order > 0, "orders start at 1");
        self.terms.push(WilliamsTerm { order, a, b });
        self
    }

    /// The field at polar coordinates of the tip, in the tip's axes. This reaches both faces, θ =
    /// ±π.
    #[must_use]
    pub fn at_polar(&self, r: f64, theta: f64) -> [Component; 2] {
        self.local(r, theta).components()
    }

    fn local(&self, r: f64, theta: f64) -> Wirtinger {
        let kappa = self.material.kolosov();
        let scale = 0.5 / self.material.mu();
        let zero = Complex64::ZERO;
        let mut sum = Wirtinger { w: zero, dz: zero, dz_bar: zero };
        for term in &self.terms {
            let part = term.displacement(r, theta, kappa);
            sum.w += part.w * scale;
            sum.dz += part.dz * scale;
            sum.dz_bar += part.dz_bar * scale;
        }
        sum
    }

    /// Text that binds the polar coordinates.
    fn polar_text(&self) -> String {
        format!("{}let rho = hypot(px, py); let phi = atan2(py, px); ", self.axes.text())
    }

    fn sum_text(parts: impl Iterator<Item = String>) -> String {
        let sum = parts.collect::<Vec<_>>().join(" + ");
        if sum.is_empty() { "0".to_owned() } else { sum }
    }
}

impl ExactField<2> for Williams {
    fn evaluate(&self, p: Vec2) -> [Component; 2] {
        let z = self.axes.local(p);
        self.local(z.re.hypot(z.im), z.im.atan2(z.re)).turned(self.axes.turn()).components()
    }

    fn formulas(&self) -> [String; 2] {
        let kappa = self.material.kolosov();
        let [u, v] = [0, 1].map(|k| {
            let sum =
                Self::sum_text(self.terms.iter().map(|t| t.displacement_text(kappa)[k].clone()));
            format!("({sum})*{}", number(0.5 / self.material.mu()))
        });
        let bind = format!("{}let u = {u}; let v = {v}; ", self.polar_text());
        self.axes.vector_text(["u", "v"]).map(|text| bind.clone() + &text)
    }
}

impl ElasticField for Williams {
    fn material(&self) -> Material {
        self.material
    }

    fn stress_formulas(&self) -> [String; 3] {
        let [xx, yy, xy] = [0, 1, 2]
            .map(|k| Self::sum_text(self.terms.iter().map(|t| t.stress_text()[k].clone())));
        let polar = self.polar_text();
        let bind = format!("{polar}let sxx = {xx}; let syy = {yy}; let sxy = {xy}; ");
        self.axes.stress_text(["sxx", "syy", "sxy"]).map(|text| bind.clone() + &text)
    }
}
