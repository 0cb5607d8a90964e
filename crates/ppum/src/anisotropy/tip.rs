//! The fields at a tip of an anisotropic body, in the frame of the tip.

use super::stiffness::{PlaneStiffness, inverse, times};
use crate::complex::Complex;
use crate::crack::TipPoint;
use ppum_formula::real::Real;
use std::f64::consts::{PI, TAU};

/// The functions of a tip: Re w₁, Im w₁, Re D and Im D with the roots s_k = a_k + i b_k, by
/// √((c + s_k s) e^{−iθ}), whose radicand is never negative: so w_k is right on both faces.
pub const TIP_FUNCTIONS: [&str; 4] = [
    "let c = cos(theta); let s = sin(theta); let p = c*c + a1*s*c + b1*s*s; let q = (b1 - 1)*s*c - a1*s*s; \
     let g = sqrt((hypot(p, q) + p)/2); sqrt(r)*(cos(theta/2)*g - sin(theta/2)*q/(2*g))",
    "let c = cos(theta); let s = sin(theta); let p = c*c + a1*s*c + b1*s*s; let q = (b1 - 1)*s*c - a1*s*s; \
     let g = sqrt((hypot(p, q) + p)/2); sqrt(r)*(cos(theta/2)*q/(2*g) + sin(theta/2)*g)",
    "let c = cos(theta); let s = sin(theta); let p = c*c + a1*s*c + b1*s*s; let q = (b1 - 1)*s*c - a1*s*s; \
     let t = c*c + a2*s*c + b2*s*s; let u = (b2 - 1)*s*c - a2*s*s; \
     let g = sqrt((hypot(p, q) + p)/2); let h = sqrt((hypot(t, u) + t)/2); let v = q/(2*g) + u/(2*h); \
     sqrt(r)*s*(cos(theta/2)*(g + h) - sin(theta/2)*v)/((g + h)^2 + v^2)",
    "let c = cos(theta); let s = sin(theta); let p = c*c + a1*s*c + b1*s*s; let q = (b1 - 1)*s*c - a1*s*s; \
     let t = c*c + a2*s*c + b2*s*s; let u = (b2 - 1)*s*c - a2*s*s; \
     let g = sqrt((hypot(p, q) + p)/2); let h = sqrt((hypot(t, u) + t)/2); let v = q/(2*g) + u/(2*h); \
     -sqrt(r)*s*(cos(theta/2)*v + sin(theta/2)*(g + h))/((g + h)^2 + v^2)",
];

/// A gradient ∂u_i/∂x_j.
type Gradient<R> = [[R; 2]; 2];

/// Gradients of the fields K_I = 1, K_II = 1 and of the force, and their derivatives along x.
pub type TipGradients<R> = [[Gradient<R>; 2]; 3];

/// The law in the frame of a tip, and the roots of its equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipLaw {
    /// The roots s₁ and s₂.
    pub roots: [Complex<f64>; 2],
    stiffness: PlaneStiffness,
    compliance: PlaneStiffness,
    /// s₁ + s₂ and s₁ s₂, which are exact where the roots are not: where these are equal.
    sum: Complex<f64>,
    product: Complex<f64>,
}

impl TipLaw {
    /// The law of a stiffness in the frame of the tip.
    #[must_use]
    pub fn new(stiffness: &PlaneStiffness) -> Self {
        let compliance = inverse(stiffness);
        let [sum, product] = symmetric(&compliance);
        let half = sum.scaled(0.5);
        let apart = half.times(half).minus(product);
        let size = apart.0.hypot(apart.1);
        // √ with a positive real part, or a positive imaginary one beside it
        let (re, im) =
            (((size + apart.0) / 2.0).max(0.0).sqrt(), ((size - apart.0) / 2.0).max(0.0).sqrt());
        let root = Complex(re, if apart.1 < 0.0 { -im } else { im });
        let roots = [half.minus(root), half.plus(root)];
        Self { roots, stiffness: *stiffness, compliance, sum, product }
    }

    /// The parameters of [`TIP_FUNCTIONS`].
    #[must_use]
    pub fn parameters(&self) -> Vec<(String, f64)> {
        let [Complex(a1, b1), Complex(a2, b2)] = self.roots;
        let all = [("a1", a1), ("b1", b1), ("a2", a2), ("b2", b2)];
        all.map(|(name, value)| (name.to_owned(), value)).into()
    }

    /// c₁₁, c₁₂, c₁₆, c₂₂, c₂₆ and c₆₆.
    #[must_use]
    pub fn stiffness(&self) -> PlaneStiffness {
        self.stiffness
    }

    /// a₁₁, a₁₂, a₁₆, a₂₂, a₂₆ and a₆₆.
    #[must_use]
    pub fn compliance(&self) -> &PlaneStiffness {
        &self.compliance
    }

    /// The factors of σ_12 and σ_22 at the faces in T = M/a₁₁ − (a₁₆/a₁₁) σ_12 − Re(s₁s₂) σ_22: of
    /// a stress that is the same everywhere M is ε_11 and the work of the loads on the opening that
    /// the force's own field has.
    #[must_use]
    pub fn faces(&self) -> [f64; 2] {
        [-self.compliance[2] / self.compliance[0], -self.product.0]
    }

    /// C of G = ½ KᵀCK and M = KᵀCKᵃ: C₁₁, C₁₂, C₂₂.
    #[must_use]
    pub fn energy(&self) -> [f64; 3] {
        let a11 = self.compliance[0];
        let mixed = self.sum.times(self.product.conjugate());
        [-a11 * mixed.1, a11 * self.product.1, a11 * self.sum.1]
    }

    /// G of factors.
    #[must_use]
    pub fn energy_release(&self, [k1, k2]: [f64; 2]) -> f64 {
        let [a, b, c] = self.energy();
        0.5 * (a * k1 * k1 + 2.0 * b * k1 * k2 + c * k2 * k2)
    }

    /// The factor of the opening of the faces, K_I + C₁₂/C₁₁ K_II: they are closed where it is
    /// zero.
    #[must_use]
    pub fn opening(&self, [k1, k2]: [f64; 2]) -> f64 {
        let [along, across, _] = self.energy();
        k1 + across / along * k2
    }

    /// True unless the faces overlap by more than an error of the factors.
    #[must_use]
    pub fn opens(&self, k: [f64; 2], error: f64) -> bool {
        self.opening(k) >= -error && k[0].hypot(k[1]) > 0.0
    }

    /// √(2πr) σ_θθ in a direction, of factors.
    #[must_use]
    pub fn hoop_stress(&self, [k1, k2]: [f64; 2], theta: f64) -> f64 {
        let (s, c) = theta.sin_cos();
        let sign = if theta >= 0.0 { 1.0 } else { -1.0 };
        let point = TipPoint { x: c, y: s, sign, branch: 1.0 };
        let [first, divided] = half_powers(&point, self.roots);
        let modes = self.modes();
        let row = |i: usize, k: usize| {
            let part = |m: usize| twice_real(&modes[m][i], first[k], divided[k]);
            k1 * part(0) + k2 * part(1)
        };
        let strain = [row(0, 0), row(1, 1), row(0, 1) + row(1, 0)];
        let [xx, yy, xy] = times(&self.stiffness, strain);
        xx * s * s + yy * c * c - 2.0 * xy * s * c
    }

    /// The factors A and B of the components u_i = 2 Re(A_i w₁ + B_i D) of the fields whose
    /// stresses (σ_22, σ_12) ahead are (1, 0)/√r and (0, 1)/√r; of the next orders they are the
    /// same.
    #[must_use]
    pub fn modes(&self) -> [[[Complex<f64>; 2]; 2]; 2] {
        let [one, two] = [self.potentials(0), self.potentials(1)];
        let joint = self.joint();
        let s1 = self.roots[0];
        let component = |i: usize| {
            let sliding = [joint[i], two[i]].map(|c| c.scaled(-1.0));
            let opening = [one[i].minus(s1.times(joint[i])), s1.times(two[i]).scaled(-1.0)];
            [opening, sliding]
        };
        let [x, y] = [component(0), component(1)];
        [[x[0], y[0]], [x[1], y[1]]]
    }

    /// p_k and q_k: the displacement of φ_k′ = 1.
    fn potentials(&self, k: usize) -> [Complex<f64>; 2] {
        let [a11, a12, a16, a22, a26, _] = self.compliance;
        let s = self.roots[k];
        let p = s.times(s).scaled(a11).minus(s.scaled(a16));
        let q = s.scaled(a12).plus(s.inverse().scaled(a22));
        [Complex(p.0 + a12, p.1), Complex(q.0 - a26, q.1)]
    }

    /// Their divided differences p₁₂ and q₁₂.
    fn joint(&self) -> [Complex<f64>; 2] {
        let [a11, a12, a16, a22, ..] = self.compliance;
        let (p, q) = (self.sum.scaled(a11), self.product.inverse().scaled(-a22));
        [Complex(p.0 - a16, p.1), Complex(q.0 + a12, q.1)]
    }

    /// The fields of the interaction integral, in such combinations that K = E′/2 M and T = E′M + …
    /// hold as in an isotropic body, with E′ = 1/a₁₁: those of Kᵃ = 2a₁₁ C⁻¹.
    #[must_use]
    pub fn fields(&self) -> TipFields {
        let ([one, two], [c11, c12, c22]) = (self.modes(), self.energy());
        let scale = 2.0 * self.compliance[0] / ((c11 * c22 - c12 * c12) * TAU.sqrt());
        let mixed = |a: f64, b: f64| {
            let part =
                |i: usize, k: usize| one[i][k].scaled(scale * a).plus(two[i][k].scaled(scale * b));
            [0, 1].map(|i| [part(i, 0), part(i, 1)])
        };
        let (first, joint) = (self.potentials(0), self.joint());
        let force = |i: usize| [joint[i], first[i]].map(|c| c.turned().scaled(0.5 / TAU));
        TipFields {
            roots: self.roots,
            modes: [mixed(c22, -c12), mixed(-c12, c11)],
            force: [force(0), force(1)],
        }
    }
}

/// Directions that are looked at on each side of a crack.
const LOOKS: u32 = 720;

/// The direction in which a hoop stress over a strength is largest: of those that are looked at the
/// best, and between its neighbours by golden sections.
pub fn weakest_direction(hoop: impl Fn(f64) -> f64, strength: impl Fn(f64) -> f64) -> f64 {
    let ratio = |theta: f64| hoop(theta) / strength(theta);
    let step = PI / f64::from(LOOKS);
    let looks = (1..2 * LOOKS).map(|k| f64::from(k) * step - PI);
    let best = looks.max_by(|a, b| ratio(*a).total_cmp(&ratio(*b))).unwrap_or(0.0);
    let (mut low, mut high) = (best - step, best + step);
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let width = golden * (high - low);
        let (a, b) = (high - width, low + width);
        if ratio(a) >= ratio(b) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}

/// s₁ + s₂ and s₁s₂ = u + iv of the roots in the upper half-plane. They are well conditioned even
/// where the roots are equal, as the factors of a polynomial into two that have no common root:
///
/// ```text
/// s₁ + s₂ = r + it   u = (A − r² − t²)/2   v = (B − ru)/t   u² + v² = Q
/// r = a₁₆/a₁₁   A = (2a₁₂ + a₆₆)/a₁₁   B = a₂₆/a₁₁   Q = a₂₂/a₁₁
/// ```
///
/// t² is the largest root of a cubic, the others being those of other pairs of roots: Newton's
/// method falls onto it from above.
fn symmetric(&[a11, a12, a16, a22, a26, a66]: &PlaneStiffness) -> [Complex<f64>; 2] {
    let [r, a, b, q] = [a16, 2.0 * a12 + a66, a26, a22].map(|entry| entry / a11);
    let at = |t: f64| {
        let u = 0.5 * (a - r * r - t);
        let rest = b - r * u;
        [t * u * u + rest * rest - q * t, u * u - t * u + r * rest - q]
    };
    // |s_k| is at most 1 + the largest coefficient
    let mut t = (2.0
        + 2.0 * [2.0 * r, a, 2.0 * b, q].map(f64::abs).into_iter().fold(1.0, f64::max))
    .powi(2);
    for _ in 0..200 {
        let [value, slope] = at(t);
        let next = t - value / slope;
        // monotonous but for rounding
        if next.is_nan() || next >= t {
            break;
        }
        t = next;
    }
    let (u, root) = (0.5 * (a - r * r - t), t.sqrt());
    [Complex(r, root), Complex(u, (b - r * u) / root)]
}

/// The fields of the interaction integral at a tip.
#[derive(Clone, Copy, Debug)]
pub struct TipFields {
    roots: [Complex<f64>; 2],
    /// Factors of w₁ and D in both components of both modes.
    modes: [[[Complex<f64>; 2]; 2]; 2],
    /// Factors of ln z₂ and (ln z₁ − ln z₂)/(s₁ − s₂) in both components.
    force: [[Complex<f64>; 2]; 2],
}

/// Derivatives of a potential: along x, along y, along x twice, and along both.
type Slopes<R> = [Complex<R>; 4];

impl TipFields {
    /// The gradients of the fields K = 1 and of the force 1 along the axis, and their derivatives
    /// along it.
    #[inline(always)]
    pub fn gradients<R: Real>(&self, point: &TipPoint<R>) -> TipGradients<R> {
        let like = point.x;
        let s = [self.roots[0].broadcast(like), self.roots[1].broadcast(like)];
        let [first, divided] = half_powers(point, s);
        let [logarithm, quotient] = logarithms(point, s);
        [
            self.field(&self.modes[0], &first, &divided),
            self.field(&self.modes[1], &first, &divided),
            self.field(&self.force, &logarithm, &quotient),
        ]
    }

    #[inline(always)]
    fn field<R: Real>(
        &self,
        factors: &[[Complex<f64>; 2]; 2],
        first: &Slopes<R>,
        second: &Slopes<R>,
    ) -> [Gradient<R>; 2] {
        let ([x, y], zero) = (factors, first[0].0.broadcast(0.0));
        let mut all = [[[zero; 2]; 2]; 2];
        let mut k = 0;
        while k < 4 {
            all[k / 2][0][k % 2] = twice_real(x, first[k], second[k]);
            all[k / 2][1][k % 2] = twice_real(y, first[k], second[k]);
            k += 1;
        }
        all
    }
}

/// 2 Re(A f + B g).
#[inline(always)]
fn twice_real<R: Real>(factors: &[Complex<f64>; 2], f: Complex<R>, g: Complex<R>) -> R {
    let [a, b] = [factors[0].broadcast(f.0), factors[1].broadcast(f.0)];
    let sum = a.times(f).plus(b.times(g)).0;
    sum + sum
}

/// w₁ and D = (w₁ − w₂)/(s₁ − s₂) by their derivatives.
#[inline(always)]
fn half_powers<R: Real>(point: &TipPoint<R>, s: [Complex<R>; 2]) -> [Slopes<R>; 2] {
    let r = point.radius();
    let inverse = point.x.broadcast(1.0) / r;
    let (c, sine) = (point.x * inverse, point.y * inverse);
    let [re, im] = point.half_root(r);
    let root = Complex(re, im);
    let w1 = root.times(direction(s[0], c, sine).root());
    let w2 = root.times(direction(s[1], c, sine).root());
    let sum = w1.plus(w2).inverse();
    let d = Complex(sum.0 * point.y, sum.1 * point.y);
    let (v1, v2) = (w1.inverse(), w2.inverse());
    let (x1, x2) = (v1.scaled(0.5), v2.scaled(0.5));
    // 1/(2 z_k), and m = 1/(2 w₁ w₂)
    let (h1, h2, m) = (x1.times(v1), x2.times(v2), x1.times(v2));
    let xx = x1.times(h1).scaled(-1.0);
    let along = d.times(m).scaled(-1.0);
    let rest = w2.minus(s[1].times(d));
    let h = h1.plus(h2);
    let mixed = x2.minus(s[1].times(along)).times(m).minus(rest.times(m).times(h));
    [
        [x1, s[0].times(x1), xx, s[0].times(xx)],
        [along, rest.times(m), along.times(m.plus(h)).scaled(-1.0), mixed],
    ]
}

/// (cos θ + s sin θ) e^{−iθ}, which is never a negative number.
#[inline(always)]
fn direction<R: Real>(s: Complex<R>, c: R, sine: R) -> Complex<R> {
    let z = Complex(c + s.0 * sine, s.1 * sine);
    z.times(Complex(c, -sine))
}

/// ln z₂ and (ln z₁ − ln z₂)/(s₁ − s₂) by their derivatives: no face sees a branch of them.
#[inline(always)]
fn logarithms<R: Real>(point: &TipPoint<R>, s: [Complex<R>; 2]) -> [Slopes<R>; 2] {
    let (x, y) = (point.x, point.y);
    let z1 = Complex(x + s[0].0 * y, s[0].1 * y).inverse();
    let z2 = Complex(x + s[1].0 * y, s[1].1 * y).inverse();
    let both = z1.times(z2);
    let (sum, square) = (z1.plus(z2), z2.times(z2).scaled(-1.0));
    let across = Complex(both.0 * x, both.1 * x);
    let along = Complex(-(both.0 * y), -(both.1 * y));
    [
        [z2, s[1].times(z2), square, s[1].times(square)],
        [along, across, along.times(sum).scaled(-1.0), both.minus(across.times(sum))],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::stiffness::turned;
    use super::*;
    use crate::vec2::{Vec2, vec2};
    use ppum_formula::{Formula, Scope};
    use ppum_testkit::random::Random;

    /// A stiffness with random eigenvalues, up to a ratio of 100.
    fn random_stiffness(random: &mut Random) -> PlaneStiffness {
        let mut rows = [[0.0; 3]; 3];
        rows.iter_mut().flatten().for_each(|entry| *entry = random.between(-1.0, 1.0));
        let scale: [f64; 3] = std::array::from_fn(|_| 10f64.powf(random.between(-1.0, 1.0)));
        let entry = |i: usize, j: usize| {
            let product: f64 = (0..3).map(|k| scale[k] * rows[k][i] * rows[k][j]).sum();
            product + if i == j { 0.05 } else { 0.0 }
        };
        [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)]
    }

    fn point(at: Vec2) -> TipPoint<f64> {
        let sign = if at.y.is_sign_positive() { 1.0 } else { -1.0 };
        TipPoint { x: at.x, y: at.y, sign, branch: 1.0 }
    }

    fn stress(c: &PlaneStiffness, g: &Gradient<f64>) -> [f64; 3] {
        times(c, [g[0][0], g[1][1], g[0][1] + g[1][0]])
    }

    fn close(found: f64, expected: f64, size: f64) {
        assert!((found - expected).abs() < size, "{found} instead of {expected}");
    }

    /// The roots satisfy their equation, also where they are equal, and C has half the roots' sums.
    #[test]
    fn roots_of_random_laws() {
        let mut random = Random(7);
        let isotropic = |nu: f64| [1.0, nu, 0.0, 1.0, 0.0, 0.5 * (1.0 - nu)];
        let laws = (0..50).map(|_| random_stiffness(&mut random)).collect::<Vec<_>>();
        for c in laws.iter().copied().chain([isotropic(0.3), isotropic(-0.5)]) {
            let law = TipLaw::new(&c);
            let [a11, a12, a16, a22, a26, a66] = *law.compliance();
            for s in law.roots {
                let factors = [a11, -2.0 * a16, 2.0 * a12 + a66, -2.0 * a26, a22];
                let (mut sum, mut size) = (Complex(0.0, 0.0), 0.0);
                for factor in factors {
                    sum = sum.times(s);
                    sum.0 += factor;
                    size = size * s.0.hypot(s.1) + factor.abs();
                }
                assert!(s.1 > 0.0 && sum.0.hypot(sum.1) < 1e-12 * size, "{c:?} {s:?} {sum:?}");
            }
            let [e11, e12, e22] = law.energy();
            assert!(e11 > 0.0 && e11 * e22 > e12 * e12);
        }
    }

    /// Equilibrium, free faces, the factors ahead, and derivatives by differences, of 50 laws.
    #[test]
    fn fields_of_random_laws() {
        let mut random = Random(11);
        for _ in 0..50 {
            let c = random_stiffness(&mut random);
            let law = TipLaw::new(&c);
            let fields = law.fields();
            let [e11, e12, e22] = law.energy();
            let (a11, root) = (law.compliance()[0], (2.0 * PI * 0.7).sqrt());
            let ahead = [0, 1].map(|m| stress(&c, &fields.gradients(&point(vec2(0.7, 0.0)))[m][0]));
            // C Kᵃ = 2 a₁₁ I
            let factors = ahead.map(|s| [s[1] * root, s[2] * root]);
            for (m, [k1, k2]) in factors.into_iter().enumerate() {
                let unit = [e11 * k1 + e12 * k2, e12 * k1 + e22 * k2];
                let expected = |k: usize| if k == m { 2.0 * a11 } else { 0.0 };
                (0..2).for_each(|k| close(unit[k], expected(k), 1e-9 * a11));
            }
            for side in [0.0, -0.0] {
                let at = fields.gradients(&point(vec2(-0.4, side)));
                let size = ahead.as_flattened().iter().map(|s| s.abs()).fold(1.0, f64::max);
                for field in at {
                    let [_, across, shear] = stress(&c, &field[0]);
                    assert!(across.abs().max(shear.abs()) < 1e-10 * size, "{across} {shear}");
                }
            }
            for at in [vec2(0.3, 0.4), vec2(-0.5, 0.2), vec2(-0.2, -0.6)] {
                let h = 1e-5;
                let (own, east) = (fields.gradients(&point(at)), vec2(h, 0.0));
                let along = |p: Vec2| fields.gradients(&point(p));
                let [e, w] = [along(at + east), along(at - east)];
                let [n, s] = [along(at + east.left()), along(at - east.left())];
                for (m, field) in own.iter().enumerate() {
                    let size = 1.0
                        + field.as_flattened().as_flattened().iter().map(|v| v.abs()).sum::<f64>();
                    let size = size * c.iter().map(|v| v.abs()).fold(1.0, f64::max);
                    let slope = |a: &[f64; 3], b: &[f64; 3], k: usize| (a[k] - b[k]) / (2.0 * h);
                    let [e, w, n, s] = [e, w, n, s].map(|all| all[m]);
                    let [se, sw, sn, ss] = [&e, &w, &n, &s].map(|g| stress(&c, &g[0]));
                    close(slope(&se, &sw, 0) + slope(&sn, &ss, 2), 0.0, 1e-5 * size);
                    close(slope(&se, &sw, 2) + slope(&sn, &ss, 1), 0.0, 1e-5 * size);
                    for i in 0..2 {
                        close(field[1][i][0], (e[0][i][0] - w[0][i][0]) / (2.0 * h), 1e-5 * size);
                        close(field[1][i][1], (n[0][i][0] - s[0][i][0]) / (2.0 * h), 1e-5 * size);
                    }
                }
            }
        }
    }

    /// The texts are the functions of the fields: their gradients have the modes' factors.
    #[test]
    fn texts_of_the_functions() {
        let mut random = Random(23);
        for _ in 0..20 {
            let c = turned(random_stiffness(&mut random), [0.6, 0.8]);
            let law = TipLaw::new(&c);
            let mut scope = Scope::polar();
            for (name, value) in law.parameters() {
                scope = scope.with_parameter(&name, value).expect("a new name");
            }
            let texts = TIP_FUNCTIONS.map(|text| Formula::parse(text, &scope).expect("a formula"));
            for theta in [-PI, -3.0, -2.0, -0.7, 0.0, 0.4, 1.5, 2.9, PI] {
                let r = 0.8_f64;
                let (s, co) = theta.sin_cos();
                let half = (0.5 * theta).sin_cos();
                let inputs = [r * co, r * s, r, theta, half.1, half.0];
                let found = texts.each_ref().map(|text| text.evaluate(&inputs));
                let w = law.roots.map(|root| {
                    let angle = theta + direction(root, co, s).angle();
                    let size = (r * (co + root.0 * s).hypot(root.1 * s)).sqrt();
                    Complex(size * (0.5 * angle).cos(), size * (0.5 * angle).sin())
                });
                let d = w[0].plus(w[1]).inverse().scaled(r * s);
                for (found, expected) in found.into_iter().zip([w[0].0, w[0].1, d.0, d.1]) {
                    close(found, expected, 1e-12);
                }
                // y = (w₁ + w₂) D, (s₁ − s₂) D = w₁ − w₂
                let [s1, s2] = law.roots;
                let product = s1.minus(s2).times(d).minus(w[0].minus(w[1]));
                assert!(
                    product.0.hypot(product.1)
                        < 1e-12 * (1.0 + s1.0.abs() + s1.1 + s2.0.abs() + s2.1)
                );
            }
        }
    }

    /// Turned back, and against the sum over both transformations of strain.
    #[test]
    fn turned_laws() {
        let mut random = Random(31);
        for _ in 0..50 {
            let c = random_stiffness(&mut random);
            let angle = random.between(-3.0, 3.0);
            let (s, co) = angle.sin_cos();
            let other = turned(c, [co, s]);
            for (k, back) in turned(other, [co, -s]).into_iter().enumerate() {
                close(back, c[k], 1e-11);
            }
            let strain =
                [random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
            let own = [
                co * co * strain[0] + s * s * strain[1] + s * co * strain[2],
                s * s * strain[0] + co * co * strain[1] - s * co * strain[2],
                2.0 * s * co * (strain[1] - strain[0]) + (co * co - s * s) * strain[2],
            ];
            let energy = |c: &PlaneStiffness, e: [f64; 3]| {
                times(c, e).iter().zip(e).map(|(s, e)| s * e).sum::<f64>()
            };
            close(energy(&other, strain), energy(&c, own), 1e-10);
        }
    }

    /// C of carbon fibres at 0 and 30 degrees (E₁ 144.8, E₂ 11.7, ν₁₂ 0.21, G₁₂ 9.66).
    #[test]
    fn energy_of_known_laws() {
        let (e1, e2, nu, g) = (144.8, 11.7, 0.21, 9.66);
        let factor = 1.0 / (1.0 - nu * nu * e2 / e1);
        let c = [e1 * factor, nu * e2 * factor, 0.0, e2 * factor, 0.0, g];
        for (angle, expected) in [
            (0.0_f64, [1.129_290_58e-1, 0.0, 3.210_068_92e-2]),
            (30.0, [0.092_721_97, -0.034_999_71, 0.052_307_78]),
        ] {
            let (s, co) = angle.to_radians().sin_cos();
            let found = TipLaw::new(&turned(c, [co, s])).energy();
            for (found, expected) in found.into_iter().zip(expected) {
                close(found, expected, 1e-8);
            }
        }
    }
}
