//! A straight crack in the infinite plane under uniform stress far away.

use super::field::{Component, ElasticField, ExactField, RightHandedFrame, Wirtinger, number, sum};
use num_complex::Complex64;
use ppum::dataset::Material;
use ppum::vec2::Vec2;
use std::f64::consts::PI;

/// The field around the crack |x| < a, y = 0 of its own frame, both tips included.
///
/// With R = √(z² − a²), cut along the crack, and the stresses N_x, N_y, τ far away,
///
/// ```text
/// Φ = ½ (N_y − iτ) z/R − ½ Γ̄′    Ω = ½ (N_y − iτ) z/R + ½ Γ̄′    Γ′ = ½ (N_y − N_x) + iτ
/// σ_xx + σ_yy = 4 Re Φ           σ_yy − i σ_xy = Φ(z) + Ω(z̄) + (z − z̄) conj(Φ′(z))
/// 2μ (u_x + i u_y) = κ φ(z) − ω(z̄) − (z − z̄) conj(Φ(z))         φ′ = Φ, ω′ = Ω
/// ```
///
/// (Muskhelishvili 1953, §120). Westergaard's field has N_x = N_y = σ, τ = 0.
#[derive(Clone, Debug)]
pub struct CrackInPlane {
    axes: RightHandedFrame,
    half_length: f64,
    material: Material,
    /// N_x, N_y, τ in the crack's frame.
    remote: [f64; 3],
}

impl CrackInPlane {
    /// The crack `center` ± `half_length` · `direction` under all-round tension σ.
    #[must_use]
    pub fn biaxial(
        material: Material,
        center: Vec2,
        direction: Vec2,
        half_length: f64,
        sigma: f64,
    ) -> Self {
        let axes = RightHandedFrame::new(center, direction);
        Self { axes, half_length, material, remote: [sigma, sigma, 0.0] }
    }

    /// Returns the crack under other stresses far away: σ_xx, σ_yy, σ_xy in the crack's frame.
    #[must_use]
    pub fn with_remote(mut self, remote: [f64; 3]) -> Self {
        self.remote = remote;
        self
    }

    /// K_I and K_II, the same at both tips: N_y √(πa), τ √(πa).
    #[must_use]
    pub fn intensities(&self) -> [f64; 2] {
        let root = (PI * self.half_length).sqrt();
        [self.remote[1] * root, self.remote[2] * root]
    }

    /// ½ N_y, ½ τ, ¼ (N_y − N_x)
    fn real_strengths(&self) -> [f64; 3] {
        let [nx, ny, tau] = self.remote;
        [0.5 * ny, 0.5 * tau, 0.25 * (ny - nx)]
    }

    fn local(&self, z: Complex64) -> Wirtinger {
        let a = self.half_length;
        let (kappa, scale) = (self.material.kolosov(), 0.5 / self.material.mu());
        let [n, t, g] = self.real_strengths();
        // ½ (N_y − iτ) and ½ Γ̄′
        let [n, g] = [n, g].map(|re| Complex64::new(re, -t));
        // The product of principal roots is cut where one factor is: between the tips.
        let root = (z - a).sqrt() * (z + a).sqrt();
        let phi = n * root - g * z;
        let omega_bar = n * root.conj() + g * z.conj();
        let phi_prime = n * z / root - g;
        let omega_prime_bar = n * (z / root).conj() + g;
        let phi_second = -n * a * a / (root * root * root);
        let z_minus_bar = Complex64::new(0.0, 2.0 * z.im);
        // On the crack's line the last terms vanish up to and with the tips.
        let beside =
            |f: Complex64| if z.im == 0.0 { Complex64::ZERO } else { z_minus_bar * f.conj() };
        Wirtinger {
            w: (kappa * phi - omega_bar - beside(phi_prime)) * scale,
            dz: (kappa * phi_prime - phi_prime.conj()) * scale,
            dz_bar: (phi_prime.conj() - omega_prime_bar - beside(phi_second)) * scale,
        }
    }

    /// Text that binds R = `p` + i `q` and z/R = `zr` + i `zi`.
    fn root_text(&self) -> String {
        let a = number(self.half_length);
        format!(
            "{}let rho = sqrt(hypot(px - {a}, py)*hypot(px + {a}, py)); \
             let phi = (atan2(py, px - {a}) + atan2(py, px + {a}))/2; \
             let p = rho*cos(phi); let q = rho*sin(phi); \
             let zr = (px*p + py*q)/rho^2; let zi = (py*p - px*q)/rho^2; ",
            self.axes.text()
        )
    }

    /// Text that binds Φ = `fr` + i `fi`.
    fn potential_text(&self) -> String {
        let [n, t, g] = self.real_strengths();
        let fr = sum(&[(n, "zr"), (t, "zi"), (-g, "1")]);
        let fi = sum(&[(n, "zi"), (-t, "zr"), (t, "1")]);
        format!("{}let fr = {fr}; let fi = {fi}; ", self.root_text())
    }

    /// 2μ (u_x, u_y) = κ φ − ω(z̄) − (z − z̄) conj(Φ), sorted by its factors.
    fn displacement_text(&self) -> [String; 2] {
        let [n, t, g] = self.real_strengths();
        let kappa = self.material.kolosov();
        let (less, more) = (kappa - 1.0, kappa + 1.0);
        let far_u = [(-more * g, "px"), (-less * t, "py"), (-2.0, "py*fi")];
        let far_v = [(-less * g, "py"), (more * t, "px"), (-2.0, "py*fr")];
        [
            sum(&[[(less * n, "p"), (more * t, "q")].as_slice(), &far_u].concat()),
            sum(&[[(more * n, "q"), (-less * t, "p")].as_slice(), &far_v].concat()),
        ]
    }
}

impl ExactField<2> for CrackInPlane {
    fn evaluate(&self, p: Vec2) -> [Component; 2] {
        self.local(self.axes.local(p)).turned(self.axes.turn()).components()
    }

    fn formulas(&self) -> [String; 2] {
        let scale = number(0.5 / self.material.mu());
        let [u, v] = self.displacement_text();
        let potential = self.potential_text();
        let bind = format!("{potential}let u = {scale}*({u}); let v = {scale}*({v}); ");
        self.axes.vector_text(["u", "v"]).map(|text| bind.clone() + &text)
    }
}

impl ElasticField for CrackInPlane {
    fn material(&self) -> Material {
        self.material
    }

    fn stress_formulas(&self) -> [String; 3] {
        let [n, t, g] = self.real_strengths();
        let aa = number(self.half_length * self.half_length);
        // Φ′ = `hr` + i `hi` = −½ (N_y − iτ) a²/R³; Ω(z̄) = `wr` + i `wi` from conj(z/R)
        let hr = sum(&[(-n, "c3"), (-t, "s3")]);
        let hi = sum(&[(t, "c3"), (-n, "s3")]);
        let wr = sum(&[(n, "zr"), (-t, "zi"), (g, "1")]);
        let wi = sum(&[(-n, "zi"), (-t, "zr"), (-t, "1")]);
        let bind = format!(
            "{}let c3 = cos(3*phi)*{aa}/rho^3; let s3 = -sin(3*phi)*{aa}/rho^3; \
             let hr = {hr}; let hi = {hi}; let wr = {wr}; let wi = {wi}; \
             let syy = fr + wr + 2*py*hi; let sxy = -(fi + wi + 2*py*hr); \
             let sxx = 4*fr - syy; ",
            self.potential_text()
        );
        self.axes.stress_text(["sxx", "syy", "sxy"]).map(|text| bind.clone() + &text)
    }
}
