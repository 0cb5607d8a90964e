//! Two equal collinear cracks in the infinite plane under all-round tension.

use super::field::number;
use num_complex::Complex64;
use ppum::vec2::Vec2;
use std::f64::consts::PI;

/// The stress around the cracks l < |x| < h on the line y = 0, under all-round tension σ far away.
///
/// Westergaard's function with λ such that the displacement between the cracks is single-valued is
///
/// ```text
/// Z = σ (z² − λ) / √((z² − l²)(z² − h²))        λ = h² E(m)/K(m),  m = 1 − l²/h²
/// σ_xx = Re Z − y Im Z′    σ_yy = Re Z + y Im Z′    σ_xy = −y Re Z′
/// K_outer = σ√π (h² − λ)/√(h(h² − l²))          K_inner = σ√π (λ − l²)/√(l(h² − l²))
/// ```
///
/// with the complete elliptic integrals of parameter m (Erdogan 1962; Tada, Paris & Irwin).
#[derive(Clone, Copy, Debug)]
pub struct CollinearCracks {
    inner: f64,
    outer: f64,
    sigma: f64,
    lambda: f64,
}

impl CollinearCracks {
    /// The cracks inner < |x| < outer under the tension `sigma`.
    #[must_use]
    pub fn new(inner: f64, outer: f64, sigma: f64) -> Self {
        let (first, second) = elliptic(inner / outer);
        Self { inner, outer, sigma, lambda: outer * outer * second / first }
    }

    /// K_I of the outer and of the inner tips.
    #[must_use]
    pub fn intensities(&self) -> [f64; 2] {
        let (ll, hh) = (self.inner * self.inner, self.outer * self.outer);
        let scale = self.sigma * (PI / (hh - ll)).sqrt();
        let [outer, inner] = [hh - self.lambda, self.lambda - ll];
        [scale * outer / self.outer.sqrt(), scale * inner / self.inner.sqrt()]
    }

    /// σ_xx, σ_yy, σ_xy at a point off the cracks.
    #[must_use]
    pub fn stress(&self, p: Vec2) -> [f64; 3] {
        let z = Complex64::new(p.x, p.y);
        let (l, h) = (self.inner, self.outer);
        // The product of principal roots is cut along the cracks only.
        let root = (z - h).sqrt() * (z + h).sqrt() * (z - l).sqrt() * (z + l).sqrt();
        let (over, square) = (z * z - self.lambda, root * root);
        let value = self.sigma * over / root;
        let slope = self.sigma * z * (2.0 * square - over * (2.0 * z * z - l * l - h * h))
            / (square * root);
        [value.re - p.y * slope.im, value.re + p.y * slope.im, -p.y * slope.re]
    }

    /// σ_xx, σ_yy, σ_xy as formulas of x and y, for tractions σ n.
    #[must_use]
    pub fn stress_formulas(&self) -> [String; 3] {
        let (l, h) = (self.inner, self.outer);
        let [inner, outer, lambda, sigma, squares] =
            [l, h, self.lambda, self.sigma, l * l + h * h].map(number);
        // z² = zr + i zi, z² − λ = ar + i zi; root = √rho e^{i phi}, 1/root = c + i s; 2 root² −
        // (z² − λ)(2z² − l² − h²) = nr + i ni, z times that mr + i mi, root⁻³ = kr + i ki; Re Z =
        // vr, Z′ = sr + i si
        let bind = format!(
            "let zr = x*x - y*y; let zi = 2*x*y; let ar = zr - {lambda}; \
             let rho = hypot(x - {outer}, y)*hypot(x + {outer}, y)\
             *hypot(x - {inner}, y)*hypot(x + {inner}, y); \
             let phi = (atan2(y, x - {outer}) + atan2(y, x + {outer}) \
             + atan2(y, x - {inner}) + atan2(y, x + {inner}))/2; \
             let c = cos(phi)/sqrt(rho); let s = -sin(phi)/sqrt(rho); \
             let vr = {sigma}*(ar*c - zi*s); \
             let br = 2*zr - {squares}; let bi = 2*zi; \
             let nr = 2*rho*cos(2*phi) - (ar*br - zi*bi); \
             let ni = 2*rho*sin(2*phi) - (ar*bi + zi*br); \
             let mr = x*nr - y*ni; let mi = x*ni + y*nr; \
             let kr = cos(3*phi)/(rho*sqrt(rho)); let ki = -sin(3*phi)/(rho*sqrt(rho)); \
             let sr = {sigma}*(mr*kr - mi*ki); let si = {sigma}*(mr*ki + mi*kr); "
        );
        ["vr - y*si", "vr + y*si", "-y*sr"].map(|text| bind.clone() + text)
    }
}

/// Steps of the arithmetic-geometric mean. It converges quadratically: 16 do for any k′ > 1e-300.
const MEANS: usize = 16;

/// The complete elliptic integrals K and E of parameter m = 1 − k′², by the arithmetic-geometric
/// mean: K = π/(2 M), E = K (1 − Σ 2ⁿ⁻¹ cₙ²) (Abramowitz & Stegun 17.6).
fn elliptic(complementary_modulus: f64) -> (f64, f64) {
    let (mut a, mut b) = (1.0, complementary_modulus);
    let (mut weight, mut sum) = (0.5, 0.5 * (1.0 - b * b));
    for _ in 0..MEANS {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        weight *= 2.0;
        sum += weight * c * c;
    }
    let first = PI / (2.0 * a);
    (first, first * (1.0 - sum))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::CrackInPlane;
    use ppum::dataset::{Material, StressState};
    use ppum::formula::{Formula, Scope};
    use ppum::vec2::vec2;

    /// Abramowitz & Stegun, table 17.1.
    #[test]
    fn elliptic_integrals() {
        let (first, second) = elliptic(0.5f64.sqrt());
        assert!((first - 1.854_074_677_301_372).abs() < 1e-14, "{first}");
        assert!((second - 1.350_643_881_047_675).abs() < 1e-14, "{second}");
        assert_eq!(elliptic(1.0), (PI / 2.0, PI / 2.0));
    }

    /// Half-length 0.8, centres ±1: F = 1.08106682 at the outer, 1.22893548 at the inner tips.
    #[test]
    fn intensities_of_the_handbook() {
        let scale = (0.8 * PI).sqrt();
        let [outer, inner] = CollinearCracks::new(0.2, 1.8, 1.0).intensities();
        assert!((outer / scale - 1.08106682).abs() < 1e-8, "{outer}");
        assert!((inner / scale - 1.22893548).abs() < 1e-8, "{inner}");
    }

    #[test]
    fn texts_say_the_same() {
        let field = CollinearCracks::new(0.3, 1.7, 1.3);
        let formulas = field
            .stress_formulas()
            .map(|text| Formula::parse(&text, &Scope::cartesian()).expect("a formula"));
        for p in [vec2(2.0, 0.0), vec2(0.1, 0.4), vec2(-1.0, -0.2), vec2(-3.0, 0.7), vec2(0.9, 2.0)]
        {
            for (formula, expected) in formulas.iter().zip(field.stress(p)) {
                let found = formula.evaluate(&[p.x, p.y]);
                assert!((found - expected).abs() < 1e-12, "{p:?}: {found} instead of {expected}");
            }
        }
    }

    /// Nearly touching inner tips make one crack of half-length h, seen from afar.
    #[test]
    fn one_crack_in_the_limit() {
        let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
        let one = CrackInPlane::biaxial(material, Vec2::ZERO, vec2(1.0, 0.0), 1.0, 1.0);
        let two = CollinearCracks::new(1e-30, 1.0, 1.0);
        let p = vec2(0.6, 0.9);
        let expected = crate::exact::ElasticField::stress(&one, p);
        for (found, expected) in two.stress(p).into_iter().zip(expected) {
            assert!((found - expected).abs() < 0.02, "{found} instead of {expected}");
        }
    }
}
