//! A round hole in an infinite plane: Kirsch's and Lamé's solutions.

use super::field::{Component, ElasticField, ExactField, Wirtinger, number};
use num_complex::Complex64;
use ppum::dataset::Material;
use ppum::vec2::Vec2;

/// A round hole under uniform stresses far away and a pressure on its rim.
///
/// With Kolosov's functions φ = N/4 z + A/z, ψ = D/2 z + B/z + A a²/z³, where N = σ_xx + σ_yy, D =
/// σ_yy − σ_xx + 2i σ_xy far away, A = −a² D̄/2, B = −a² (N/2 + p); (Kirsch 1898; Muskhelishvili
/// 1953, section 56). On the rim of a plate under σ_yy = S the hoop stress is S (1 + 2 cos 2θ), 3 S
/// at most.
#[derive(Clone, Copy, Debug)]
pub struct RoundHole {
    material: Material,
    center: Vec2,
    radius: f64,
    remote: [f64; 3],
    pressure: f64,
}

impl RoundHole {
    /// A hole without loads.
    #[must_use]
    pub fn new(material: Material, center: Vec2, radius: f64) -> Self {
        Self { material, center, radius, remote: [0.0; 3], pressure: 0.0 }
    }

    /// With σ_xx, σ_yy, σ_xy far away.
    #[must_use]
    pub fn with_remote(self, remote: [f64; 3]) -> Self {
        Self { remote, ..self }
    }

    /// With a pressure in the hole.
    #[must_use]
    pub fn with_pressure(self, pressure: f64) -> Self {
        Self { pressure, ..self }
    }

    /// N, D, A, B.
    fn constants(&self) -> (f64, Complex64, Complex64, f64) {
        let [xx, yy, xy] = self.remote;
        let d = Complex64::new(yy - xx, 2.0 * xy);
        let square = self.radius * self.radius;
        (xx + yy, d, -d.conj() * (0.5 * square), -square * (0.5 * (xx + yy) + self.pressure))
    }

    /// Text that binds the coordinates, powers of z and the constants.
    fn text(&self) -> String {
        let (n, d, a, b) = self.constants();
        let square = self.radius * self.radius;
        let Vec2 { x, y } = self.center;
        let values =
            [x, y, n, d.re, d.im, a.re, a.im, b, square, self.material.kolosov()].map(number);
        let [x, y, n, d1, d2, a1, a2, b, square, kappa] = values;
        format!(
            "let dx = x - {x}; let dy = y - {y}; let q = dx^2 + dy^2; let n = {n}; let d1 = {d1}; \
             let d2 = {d2}; let a1 = {a1}; let a2 = {a2}; let b = {b}; let g = {square}; \
             let k = {kappa}; "
        )
    }
}

impl ExactField<2> for RoundHole {
    fn evaluate(&self, p: Vec2) -> [Component; 2] {
        let (n, d, a, b) = self.constants();
        let (mu, kappa) = (self.material.mu(), self.material.kolosov());
        let z = Complex64::new(p.x - self.center.x, p.y - self.center.y);
        let c = a * (self.radius * self.radius);
        let (phi, psi) = (z * (0.25 * n) + a / z, d * z * 0.5 + b / z + c / z.powi(3));
        let (slope, bend) = (0.25 * n - a / (z * z), a * 2.0 / z.powi(3));
        let psi_slope = d * 0.5 - b / (z * z) - c * 3.0 / z.powi(4);
        let half = 0.5 / mu;
        let field = Wirtinger {
            w: (phi * kappa - z * slope.conj() - psi.conj()) * half,
            dz: (slope * kappa - slope.conj()) * half,
            dz_bar: -(z * bend.conj() + psi_slope.conj()) * half,
        };
        field.components()
    }

    fn formulas(&self) -> [String; 2] {
        let (start, double) = (self.text(), number(2.0 * self.material.mu()));
        let x = "(k - 1)*n/4*dx - (d1*dx - d2*dy)/2 + (k*(a1*dx + a2*dy) - b*dx)/q \
                 + (a1*(dx^3 - 3*dx*dy^2) + a2*(3*dx^2*dy - dy^3))*(1 - g/q)/q^2";
        let y = "(k - 1)*n/4*dy + (d1*dy + d2*dx)/2 + (k*(a2*dx - a1*dy) - b*dy)/q \
                 + (a1*(3*dx^2*dy - dy^3) - a2*(dx^3 - 3*dx*dy^2))*(1 - g/q)/q^2";
        [x, y].map(|component| format!("{start}({component})/{double}"))
    }
}

impl ElasticField for RoundHole {
    fn material(&self) -> Material {
        self.material
    }

    fn stress_formulas(&self) -> [String; 3] {
        let start = self.text()
            + "let c2 = dx^2 - dy^2; let s2 = 2*dx*dy; let c4 = c2^2 - s2^2; let s4 = 2*c2*s2; \
               let f = (4 - 6*g/q)/q^3; let m = n - 4*(a1*c2 + a2*s2)/q^2; \
               let t = d1 - 2*b*c2/q^2 + f*(a1*c4 + a2*s4); ";
        let xy = "(d2 + 2*b*s2/q^2 + f*(a2*c4 - a1*s4))/2";
        ["(m - t)/2", "(m + t)/2", xy].map(|stress| format!("{start}{stress}"))
    }
}
