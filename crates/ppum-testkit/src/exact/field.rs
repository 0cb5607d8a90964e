//! Exact fields, and the parts that solutions in the plane are made of.

use num_complex::Complex64;
use ppum::dataset::Material;
use ppum::vec2::{Vec2, vec2};

/// One component of a field at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// u
    pub value: f64,
    /// (∂u/∂x, ∂u/∂y)
    pub gradient: Vec2,
}

/// An exact field of `N` components.
pub trait ExactField<const N: usize> {
    /// Value and gradient at a point. At a tip the value is finite and the gradient is not. On a
    /// crack the sign of the rounded distance decides on the face.
    fn evaluate(&self, p: Vec2) -> [Component; N];

    /// The components as formulas of x and y.
    fn formulas(&self) -> [String; N];
}

/// An exact displacement.
pub trait ElasticField: ExactField<2> {
    /// The material.
    fn material(&self) -> Material;

    /// σ_xx, σ_yy, σ_xy as formulas of x and y, for tractions σ n.
    fn stress_formulas(&self) -> [String; 3];

    /// σ_xx, σ_yy, σ_xy at a point.
    fn stress(&self, p: Vec2) -> [f64; 3] {
        stress(&self.material(), &self.evaluate(p))
    }
}

/// Hooke's law σ = 2μ ε + λ tr(ε) I: σ_xx, σ_yy, σ_xy of a displacement.
#[must_use]
pub fn stress(material: &Material, [u, v]: &[Component; 2]) -> [f64; 3] {
    let (mu, lambda) = (material.mu(), material.lambda());
    let pressure = lambda * (u.gradient.x + v.gradient.y);
    [
        2.0 * mu * u.gradient.x + pressure,
        2.0 * mu * v.gradient.y + pressure,
        mu * (u.gradient.y + v.gradient.x),
    ]
}

/// A complex displacement w = u_x + i u_y of z and z̄, with ∂w/∂z and ∂w/∂z̄.
#[derive(Clone, Copy)]
pub(super) struct Wirtinger {
    pub(super) w: Complex64,
    pub(super) dz: Complex64,
    pub(super) dz_bar: Complex64,
}

impl Wirtinger {
    /// Components in the same axes: ∂/∂x = ∂/∂z + ∂/∂z̄, ∂/∂y = i (∂/∂z − ∂/∂z̄).
    pub(super) fn components(self) -> [Component; 2] {
        let (dx, dy) = (self.dz + self.dz_bar, Complex64::I * (self.dz - self.dz_bar));
        [
            Component { value: self.w.re, gradient: vec2(dx.re, dy.re) },
            Component { value: self.w.im, gradient: vec2(dx.im, dy.im) },
        ]
    }

    /// The field that is this one in axes turned by the angle of e = e^{iγ}: with ζ = (z − c) / e,
    /// w_world = e w(ζ, ζ̄), where ∂ζ/∂z = ē and ∂ζ̄/∂z̄ = e.
    pub(super) fn turned(self, e: Complex64) -> Self {
        Self { w: e * self.w, dz: self.dz, dz_bar: e * e * self.dz_bar }
    }
}

/// A right-handed frame: origin and direction of its x axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct RightHandedFrame {
    pub(super) origin: Vec2,
    /// Unit vector.
    pub(super) direction: Vec2,
}

impl RightHandedFrame {
    pub(super) fn new(origin: Vec2, direction: Vec2) -> Self {
        Self { origin, direction: direction.unit() }
    }

    /// e^{iγ} of the x axis.
    pub(super) fn turn(self) -> Complex64 {
        Complex64::new(self.direction.x, self.direction.y)
    }

    pub(super) fn local(self, p: Vec2) -> Complex64 {
        let d = p - self.origin;
        Complex64::new(self.direction.dot(d), self.direction.cross(d))
    }

    /// Formula text that binds `px` and `py` to the local coordinates.
    pub(super) fn text(self) -> String {
        let [x, y] = <[f64; 2]>::from(self.origin).map(number);
        let Vec2 { x: c, y: s } = self.direction;
        let [px, py] = [sum(&[(c, "dx"), (s, "dy")]), sum(&[(c, "dy"), (-s, "dx")])];
        format!("let dx = x - {x}; let dy = y - {y}; let px = {px}; let py = {py}; ")
    }

    /// Texts of the world's vector components from those of a vector in this frame.
    pub(super) fn vector_text(self, [u, v]: [&str; 2]) -> [String; 2] {
        let Vec2 { x: c, y: s } = self.direction;
        [sum(&[(c, u), (-s, v)]), sum(&[(s, u), (c, v)])]
    }

    /// Texts of the world's σ_xx, σ_yy, σ_xy from those in this frame.
    pub(super) fn stress_text(self, [xx, yy, xy]: [&str; 3]) -> [String; 3] {
        let Vec2 { x: c, y: s } = self.direction;
        [
            sum(&[(c * c, xx), (s * s, yy), (-2.0 * c * s, xy)]),
            sum(&[(s * s, xx), (c * c, yy), (2.0 * c * s, xy)]),
            sum(&[(c * s, xx), (-c * s, yy), (c * c - s * s, xy)]),
        ]
    }
}

/// A number as formula text, to the last bit, ready to stand after an operator.
pub(super) fn number(v: f64) -> String {
    if v.is_sign_negative() { format!("({v:?})") } else { format!("{v:?}") }
}

/// The sum of multiples as formula text; zeros and factors one are left out.
pub(super) fn sum<T: AsRef<str>>(terms: &[(f64, T)]) -> String {
    let multiple = |(factor, text): &(f64, T)| match (*factor, text.as_ref()) {
        (1.0, text) => text.to_owned(),
        (factor, "1") => number(factor),
        (factor, text) => format!("{}*{text}", number(factor)),
    };
    let terms: Vec<_> = terms.iter().filter(|term| term.0 != 0.0).map(multiple).collect();
    if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
}
