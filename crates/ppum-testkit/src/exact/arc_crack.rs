//! A crack along an arc of a circle in the infinite plane under uniform stress far away.

use super::field::{Component, ExactField, RightHandedFrame, Wirtinger, number};
use num_complex::Complex64;
use ppum::crack::End;
use ppum::dataset::Material;
use ppum::edge::Edge;
use ppum::vec2::Vec2;
use std::f64::consts::PI;

/// The field around a crack that is the arc |arg z| < h of the unit circle in its own frame, in
/// units of the radius.
///
/// With X = √((z − a)(z − ā)), a = e^{ih}, cut along the arc, X ≈ z far away, and m = cos h
///
/// ```text
/// φ = ½ (X (α − g/z) + (2Γ − α) z − g/z)     ω = ½ (X (α − g/z) − (2Γ − α) z + g/z)
/// 2μ (u_x + i u_y) = κ φ(z) − ω(1/z̄) − (z − 1/z̄) conj(φ′(z))
/// Γ = ¼ (N_x + N_y)    Γ′ = ½ (N_y − N_x) + iτ    g = Γ̄′    2α + ᾱ (1 − m) = 4Γ + ½ Γ′ (1 − m²)
/// K_I − iK_II = √(πR sin h) (α − g e^{∓ih}) e^{∓ih/2}    T = 2 Re (2Γ − α + g e^{∓2ih})
/// ```
///
/// at the end e^{±ih}, where x points out of the crack (Muskhelishvili 1953, §124). φ′ + ω′ is
/// X^(−1) times a function without a cut and φ′ − ω′ has none, so that the arc is free; α is what
/// makes ψ regular at 0. A pressure on both faces is all-round tension far away without a uniform
/// one.
#[derive(Clone, Debug)]
pub struct ArcCrack {
    axes: RightHandedFrame,
    radius: f64,
    half_angle: f64,
    material: Material,
    /// N_x, N_y, τ in the crack's frame.
    remote: [f64; 3],
    pressure: f64,
}

/// α, g, d = 2Γ − α.
type Strengths = [Complex64; 3];

impl ArcCrack {
    /// The arc of a circle that begins at the angle −h from a direction, and ends at h.
    #[must_use]
    pub fn new(
        material: Material,
        center: Vec2,
        radius: f64,
        direction: Vec2,
        half_angle: f64,
    ) -> Self {
        let axes = RightHandedFrame::new(center, direction);
        Self { axes, radius, half_angle, material, remote: [0.0; 3], pressure: 0.0 }
    }

    /// The crack under stresses far away: σ_xx, σ_yy, σ_xy in the frame of the direction.
    #[must_use]
    pub fn with_remote(self, remote: [f64; 3]) -> Self {
        Self { remote, ..self }
    }

    /// The crack with a pressure on both faces.
    #[must_use]
    pub fn with_pressure(self, pressure: f64) -> Self {
        Self { pressure, ..self }
    }

    /// The edge that the crack is, counter-clockwise.
    #[must_use]
    pub fn edge(&self) -> Edge {
        let Vec2 { x, y } = self.axes.direction;
        let (middle, h) = (y.atan2(x), self.half_angle);
        Edge::around(self.axes.origin, self.radius, [middle - h, middle + h])
    }

    /// K_I and K_II of the first or the last end.
    #[must_use]
    pub fn intensities(&self, end: End) -> [f64; 2] {
        let [alpha, g, _] = self.strengths();
        let turn = Complex64::new(0.0, -self.signed_angle(end));
        let root = (PI * self.radius * self.half_angle.sin()).sqrt();
        let k = (alpha - g * turn.exp()) * (0.5 * turn).exp() * root;
        [k.re, -k.im]
    }

    /// T of the first or the last end.
    #[must_use]
    pub fn t_stress(&self, end: End) -> f64 {
        let [_, g, d] = self.strengths();
        let turn = Complex64::new(0.0, -2.0 * self.signed_angle(end));
        2.0 * (d + g * turn.exp()).re - self.pressure
    }

    fn signed_angle(&self, end: End) -> f64 {
        if end == End::Last { self.half_angle } else { -self.half_angle }
    }

    fn strengths(&self) -> Strengths {
        let [nx, ny, tau] = self.remote;
        let m = self.half_angle.cos();
        let (gamma, shear) =
            (0.25 * (nx + ny) + 0.5 * self.pressure, Complex64::new(0.5 * (ny - nx), tau));
        let right = 4.0 * gamma + shear * (0.5 * (1.0 - m * m));
        let alpha = Complex64::new(right.re / (3.0 - m), right.im / (1.0 + m));
        [alpha, shear.conj(), 2.0 * gamma - alpha]
    }

    /// X: on the arc (z − a)/(z − ā) has the angle h, by which the cut of the root is placed.
    fn root(&self, z: Complex64) -> Complex64 {
        let a = Complex64::new(0.0, self.half_angle).exp();
        if z == a.conj() {
            return Complex64::ZERO;
        }
        let ratio = |z: Complex64| -(z - a) / (z - a.conj()) * self.on_arc().conj();
        let far = -self.on_arc().conj();
        (z - a.conj()) * (ratio(z).sqrt() / far.sqrt())
    }

    /// (z − a)/(z − ā) at z = 1.
    fn on_arc(&self) -> Complex64 {
        let a = Complex64::new(0.0, self.half_angle).exp();
        (1.0 - a) / (1.0 - a.conj())
    }

    /// 2μ times the field in units of the radius.
    fn local(&self, z: Complex64) -> Wirtinger {
        let ([alpha, g, d], kappa) = (self.strengths(), self.material.kolosov());
        let (x, m, inverse) = (self.root(z), self.half_angle.cos(), 1.0 / z);
        let (part, h) = (alpha - g * inverse, g * inverse);
        let slope = |x: Complex64, z: Complex64| (z - m) / x * (alpha - g / z) + x * g / (z * z);
        let phi = 0.5 * (x * part + d * z - h);
        let phi_prime = 0.5 * (slope(x, z) + d + h * inverse);
        let root_slope = (z - m) / x;
        let root_bend = (1.0 - root_slope * root_slope) / x;
        let second = root_bend * part + 2.0 * (root_slope - x * inverse) * h * inverse;
        let phi_second = 0.5 * second - h * inverse * inverse;
        // the image of z in the circle lies beside the other face
        let image = 1.0 / z.conj();
        let x_image = -x.conj() * image;
        let omega = 0.5 * (x_image * (alpha - g / image) - d * image + g / image);
        let omega_prime = 0.5 * (slope(x_image, image) - d - g / (image * image));
        let beside = z - image;
        // a tip is its own image, and φ′ is infinite there
        let turned = if x == Complex64::ZERO { x } else { beside * phi_prime.conj() };
        let uniform = 0.5 * self.pressure * (kappa - 1.0);
        Wirtinger {
            w: kappa * phi - omega - turned - uniform * z,
            dz: kappa * phi_prime - phi_prime.conj() - uniform,
            dz_bar: (omega_prime - phi_prime.conj()) * image * image - beside * phi_second.conj(),
        }
    }

    /// Text that binds z = `zx` + i `zy`, X = `xr` + i `xi` and the strengths.
    fn text(&self) -> String {
        let ([alpha, g, d], far) = (self.strengths(), -self.on_arc().conj());
        let (sin, cos) = self.half_angle.sin_cos();
        let kappa = self.material.kolosov();
        let given = [("m", cos), ("n", sin), ("k", kappa), ("p", self.pressure)];
        let complex = [("a", alpha), ("g", g), ("d", d)];
        let parts = complex.map(|(name, z)| [(name, "r", z.re), (name, "i", z.im)]);
        let all = given.map(|(name, x)| (name, "", x)).into_iter().chain(parts.concat());
        let bind = |(name, part, x)| format!("let {name}{part} = {}; ", number(x));
        let [radius, fr, fi, turn] = [self.radius, far.re, far.im, far.arg()].map(number);
        format!(
            "{}let zx = px/{radius}; let zy = py/{radius}; {}\
             let qr = (zx - m)^2 + zy^2 - n^2; let qi = -2*n*(zx - m); \
             let angle = atan2(zy + n, zx - m) \
             + (atan2(qr*{fi} + qi*{fr}, qr*{fr} - qi*{fi}) - {turn})/2; \
             let rho = sqrt(hypot(zx - m, zy - n)*hypot(zx - m, zy + n)); \
             let xr = rho*cos(angle); let xi = rho*sin(angle); ",
            self.axes.text(),
            all.map(bind).collect::<String>()
        )
    }
}

impl ExactField<2> for ArcCrack {
    fn evaluate(&self, p: Vec2) -> [Component; 2] {
        let Wirtinger { w, dz, dz_bar } = self.local(self.axes.local(p) / self.radius);
        let half = 0.5 / self.material.mu();
        let field = Wirtinger { w: w * (half * self.radius), dz: dz * half, dz_bar: dz_bar * half };
        field.turned(self.axes.turn()).components()
    }

    fn formulas(&self) -> [String; 2] {
        // g/z = hr + i hi; X/z = vr + i vi; X′ = ur + i ui; φ′ = er + i ei
        let bind = format!(
            "{}let s = zx^2 + zy^2; let hr = (gr*zx + gi*zy)/s; let hi = (gi*zx - gr*zy)/s; \
             let br = ar - hr; let bi = ai - hi; let cr = ar - s*hr; let ci = ai - s*hi; \
             let vr = (xr*zx + xi*zy)/s; let vi = (xi*zx - xr*zy)/s; \
             let ur = ((zx - m)*xr + zy*xi)/rho^2; let ui = (zy*xr - (zx - m)*xi)/rho^2; \
             let wr = dr*zx - di*zy; let wi = dr*zy + di*zx; \
             let fr = (xr*br - xi*bi + wr - hr)/2; let fi = (xr*bi + xi*br + wi - hi)/2; \
             let sr = (s*hr - vr*cr - vi*ci - wr/s)/2; let si = (s*hi - vr*ci + vi*cr - wi/s)/2; \
             let er = (ur*br - ui*bi + vr*hr - vi*hi + dr + (hr*zx + hi*zy)/s)/2; \
             let ei = (ur*bi + ui*br + vr*hi + vi*hr + di + (hi*zx - hr*zy)/s)/2; \
             let t = 1 - 1/s; let c = {}; let q = p*(k - 1)/2; \
             let u = c*(k*fr - sr - t*(zx*er + zy*ei) - q*zx); \
             let v = c*(k*fi - si - t*(zy*er - zx*ei) - q*zy); ",
            self.text(),
            number(0.5 * self.radius / self.material.mu())
        );
        self.axes.vector_text(["u", "v"]).map(|text| bind.clone() + &text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Williams, stress};
    use ppum::dataset::StressState;
    use ppum::formula::{Formula, Scope};
    use ppum::vec2::vec2;

    const MATERIAL: Material =
        Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStrain };

    fn arc(half_angle: f64) -> ArcCrack {
        let direction = vec2(0.3, 0.8);
        let arc = ArcCrack::new(MATERIAL, vec2(0.2, -0.1), 0.7, direction, half_angle);
        arc.with_remote([0.7, 1.0, 0.6]).with_pressure(0.4)
    }

    const HALF_ANGLES: [f64; 4] = [0.13, 0.6, 1.48, 2.4];

    fn points() -> impl Iterator<Item = Vec2> {
        (0..24).map(|k| {
            let (angle, r) = (0.7 * f64::from(k), 0.25 + 0.09 * f64::from(k));
            vec2(0.2, -0.1) + vec2(angle.cos(), angle.sin()) * r
        })
    }

    #[test]
    fn texts_say_the_same() {
        for field in HALF_ANGLES.map(arc) {
            let texts = field.formulas();
            let formulas =
                texts.map(|text| Formula::parse(&text, &Scope::cartesian()).expect("a formula"));
            for p in points() {
                for (formula, expected) in formulas.iter().zip(field.evaluate(p)) {
                    let found = formula.evaluate(&[p.x, p.y]);
                    assert!((found - expected.value).abs() < 1e-13, "{found} {expected:?}");
                }
            }
        }
    }

    /// Gradients by differences, and equilibrium of their stresses.
    #[test]
    fn gradients_and_equilibrium() {
        let step = 1e-5;
        for field in HALF_ANGLES.map(arc) {
            for p in points().filter(|p| field.edge().distance(*p) > 0.01) {
                let at = |d: Vec2| field.evaluate(p + d * step);
                let [e, w, n, s] =
                    [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)].map(at);
                for (k, own) in field.evaluate(p).into_iter().enumerate() {
                    let x = (e[k].value - w[k].value) / (2.0 * step);
                    let y = (n[k].value - s[k].value) / (2.0 * step);
                    assert!((own.gradient - vec2(x, y)).length() < 1e-5, "{own:?} {x} {y}");
                }
                let [e, w, n, s] = [e, w, n, s].map(|u| stress(&MATERIAL, &u));
                let force = [e[0] - w[0] + n[2] - s[2], e[2] - w[2] + n[1] - s[1]];
                assert!(force.iter().all(|f| f.abs() / (2.0 * step) < 1e-3), "{force:?}");
            }
        }
    }

    /// Displacements are finite at both tips, and those of points beside them.
    #[test]
    fn displacements_of_tips() {
        for field in HALF_ANGLES.map(arc) {
            for sign in [1.0, -1.0] {
                let tip = Complex64::new(0.0, sign * field.half_angle).exp();
                let [at, beside] = [tip, tip * (1.0 + 1e-14)].map(|z| field.local(z).w);
                assert!((at - beside).norm() < 1e-6, "{at} {beside}");
            }
        }
    }

    /// Both faces carry the pressure alone, and far away are the stresses that are given there.
    #[test]
    fn faces_and_infinity() {
        for field in HALF_ANGLES.map(arc) {
            for (part, side) in (1..10).flat_map(|k| [(k, 1.0), (k, -1.0)]) {
                let n = field.edge().tangent(0.1 * f64::from(part)).left() * side;
                let p = field.edge().at(0.1 * f64::from(part)) + n * 1e-13;
                let [xx, yy, xy] = stress(&MATERIAL, &field.evaluate(p));
                let traction = vec2(xx * n.x + xy * n.y, xy * n.x + yy * n.y);
                assert!((traction + n * 0.4).length() < 1e-10, "{traction:?}");
            }
            let far = stress(&MATERIAL, &field.evaluate(vec2(3e5, -5e5)));
            let (sin, cos) = (vec2(0.3, 0.8).unit().y, vec2(0.3, 0.8).unit().x);
            let expected = [
                0.7 * cos * cos + sin * sin - 1.2 * sin * cos,
                0.7 * sin * sin + cos * cos + 1.2 * sin * cos,
                -0.3 * sin * cos + 0.6 * (cos * cos - sin * sin),
            ];
            for (found, expected) in far.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{found} {expected}");
            }
        }
    }

    /// Stresses at both tips are those of K, and without the ones of half powers those of T; K
    /// under all-round tension is that of Cotterell & Rice (1980).
    #[test]
    fn intensities_and_t() {
        for field in HALF_ANGLES.map(arc) {
            let edge = field.edge();
            for (end, tip, direction) in [
                (End::Last, edge.to, edge.end_tangents()[1]),
                (End::Start, edge.from, -edge.end_tangents()[0]),
            ] {
                let [k1, k2] = field.intensities(end);
                let singular = Williams::new(MATERIAL, tip, direction).with_intensities(k1, k2);
                for angle in [-2.5f64, -1.0, 0.0, 0.7, 2.0] {
                    let way = direction * angle.cos() + direction.left() * angle.sin();
                    let p = tip + way * 1e-10;
                    let [found, part] =
                        [field.evaluate(p), singular.evaluate(p)].map(|u| stress(&MATERIAL, &u));
                    let size = 1e5 * k1.hypot(k2);
                    let off =
                        found.iter().zip(part).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(off < 1e-4 * size, "{found:?} {part:?}");
                }
                // half powers change their sign from one face to the other
                let n = direction.left();
                let along = |side: f64| {
                    let part = if end == End::Last { 1.0 - 1e-5 } else { 1e-5 };
                    let (t, p) = (edge.tangent(part), edge.at(part) + n * (side * 1e-14));
                    let [xx, yy, xy] = stress(&MATERIAL, &field.evaluate(p));
                    xx * t.x * t.x + 2.0 * xy * t.x * t.y + yy * t.y * t.y
                };
                let (found, t) = (0.5 * (along(1.0) + along(-1.0)), field.t_stress(end));
                assert!((found - t).abs() < 1e-4, "{found} {t}");
            }
            let plain = ArcCrack { remote: [1.0, 1.0, 0.0], pressure: 0.0, ..field };
            let h = plain.half_angle;
            let size = (PI * 0.7 * h.sin()).sqrt() / (1.0 + (0.5 * h).sin().powi(2));
            let [k1, k2] = plain.intensities(End::Last);
            assert!((k1 - size * (0.5 * h).cos()).abs() < 1e-14);
            assert!((k2 - size * (0.5 * h).sin()).abs() < 1e-14);
        }
    }
}
