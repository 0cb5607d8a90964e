//! Anisotropic elasticity in the plane: a stiffness in axes that may turn from place to place, and
//! the fields at a tip in it.
//!
//! Stresses are σ = c e with σ = (σ_11, σ_22, σ_12) and e = (ε_11, ε_22, 2ε_12); plane strain has
//! beside it σ_33 = c_13 e_1 + c_23 e_2 + c_36 e_3 + c_33 ε_33. In the frame of a tip, with the
//! compliance a = c⁻¹, fields without body forces are made of functions of z_k = x + s_k y with the
//! roots of
//!
//! ```text
//! a₁₁ s⁴ − 2a₁₆ s³ + (2a₁₂ + a₆₆) s² − 2a₂₆ s + a₂₂ = 0      Im s > 0
//! ```
//!
//! (Lekhnitskii 1963; Sih, Paris & Irwin 1965). Those at a tip are w_k = √z_k and, instead of the
//! difference of both, which says nothing where s₁ = s₂, the divided difference
//! D = (w₁ − w₂)/(s₁ − s₂) = y/(w₁ + w₂), which has a value there.

mod stiffness;
mod tip;

use crate::expression::Expression;
use crate::vec2::Vec2;
use stiffness::{PLANE, inverse, least_eigenvalue, times, turned_through};
pub use stiffness::{PlaneStiffness, turned};
pub use tip::{TIP_FUNCTIONS, TipFields, TipGradients, TipLaw, weakest_direction};

/// The names of the constants in files and in formulas: of the plane, of plane strain, and the
/// angle of the first axis.
pub const STIFFNESS: [&str; 11] =
    ["c11", "c12", "c16", "c22", "c26", "c66", "c13", "c23", "c36", "c33", "axis"];

/// Numbers that the moduli of a point are made of.
pub(crate) const MODULI: usize = 11;

/// The law of an anisotropic body.
#[derive(Clone, Debug, PartialEq)]
pub struct Anisotropy {
    /// c₁₁, c₁₂, c₁₆, c₂₂, c₂₆, c₆₆ in the material's axes.
    pub plane: [Expression; PLANE],
    /// c₁₃, c₂₃, c₃₆, c₃₃ of plane strain; zero in plane stress, where they have no effect.
    pub through: [Expression; 4],
    /// The angle of the material's first axis from the x axis, radians.
    pub axis: Expression,
}

impl Anisotropy {
    /// The expressions with their names, those through the plane if it is one of plane strain.
    pub fn constants(&self, is_strain: bool) -> impl Iterator<Item = (&'static str, &Expression)> {
        let through = self.through.iter().filter(move |_| is_strain);
        let names = STIFFNESS.into_iter();
        let (of_plane, rest) = (names.clone().take(PLANE), names.skip(PLANE));
        let through = rest.zip(through);
        of_plane.zip(&self.plane).chain(through).chain([(STIFFNESS[10], &self.axis)])
    }

    /// The plane's constants in the world's axes.
    #[must_use]
    pub fn plane_at(&self, p: Vec2) -> PlaneStiffness {
        let (s, c) = self.axis.value(p).sin_cos();
        turned(self.plane.each_ref().map(|e| e.value(p)), [c, s])
    }

    /// The law in the frame of a tip, whose direction of growth is `axis`.
    #[must_use]
    pub fn at_tip(&self, tip: Vec2, axis: Vec2) -> TipLaw {
        TipLaw::new(&turned(self.plane_at(tip), [axis.x, -axis.y]))
    }

    /// c₁₂, c₁₆, c₂₆ and c₆₆ in the world's axes, c₁₁ − c₁₂ − 2c₆₆ and c₂₂ − c₁₂ − 2c₆₆, the
    /// modulus of the third direction, and the given strains: those of the plane under which its
    /// stresses vanish, and ε⁰_zz.
    pub(crate) fn moduli_at(&self, p: Vec2, [xx, yy, xy, zz]: [f64; 4]) -> [f64; MODULI] {
        let plane = self.plane_at(p);
        let [c11, c12, c16, c22, c26, c66] = plane;
        let (s, c) = self.axis.value(p).sin_cos();
        let [c13, c23, c36, c33] = self.through.each_ref().map(|e| e.value(p));
        let through = turned_through([c13, c23, c36], [c, s]);
        let ratio = times(&inverse(&plane), through);
        let young = c33 - (0..3).map(|k| ratio[k] * through[k]).sum::<f64>();
        let [xx, yy, xy] = [xx + ratio[0] * zz, yy + ratio[1] * zz, xy + 0.5 * ratio[2] * zz];
        let apart = [c11 - c12 - 2.0 * c66, c22 - c12 - 2.0 * c66];
        [c12, c16, c26, c66, apart[0], apart[1], young, xx, yy, xy, zz]
    }

    /// a·(c₁₃, c₂₃, c₃₆) in the world's axes: the strains under which the stresses of the plane
    /// vanish where ε_33 = −1.
    pub(crate) fn ratio_at(&self, p: Vec2) -> [f64; 3] {
        let (s, c) = self.axis.value(p).sin_cos();
        let [c13, c23, c36, _] = self.through.each_ref().map(|e| e.value(p));
        times(&inverse(&self.plane_at(p)), turned_through([c13, c23, c36], [c, s]))
    }

    /// The change of the law along a line on which each constant changes by a slope.
    pub(crate) fn slopes(&self, p: Vec2, slope: impl Fn(usize) -> f64) -> LawSlopes {
        let (s, c) = self.axis.value(p).sin_cos();
        let (own, turn) = (self.plane_at(p), slope(STIFFNESS.len() - 1));
        let [c11, c12, c16, c22, c26, c66] = own;
        let apart = 2.0 * (c16 - c26);
        // those of the axes, as a turn changes the constants in the world's
        let turning =
            [-4.0 * c16, apart, c11 - c12 - 2.0 * c66, 4.0 * c26, c12 + 2.0 * c66 - c22, apart];
        let mut plane = turned(std::array::from_fn(&slope), [c, s]);
        plane.iter_mut().zip(turning).for_each(|(sum, part)| *sum += turn * part);
        let ratio = self.ratio_at(p);
        let [c13, c23, c36, _] = self.through.each_ref().map(|e| e.value(p));
        let [a, b, shear] = turned_through([c13, c23, c36], [c, s]);
        let mut through = turned_through(std::array::from_fn(|k| slope(PLANE + k)), [c, s]);
        let turning = [-2.0 * shear, 2.0 * shear, a - b];
        let change = times(&plane, ratio);
        for (k, sum) in through.iter_mut().enumerate() {
            *sum += turn * turning[k] - change[k];
        }
        LawSlopes { plane, ratio: times(&inverse(&own), through) }
    }

    /// The error in the constants at a point, if there is one: the name, and the reason.
    pub(crate) fn invalid(&self, is_strain: bool, p: Vec2) -> Option<(&'static str, String)> {
        let values = self.constants(is_strain).map(|(name, e)| (name, e.value(p)));
        let infinite = values.into_iter().find(|(_, value)| !value.is_finite());
        if let Some((name, value)) = infinite {
            return Some((name, format!("is {value}, but must be finite")));
        }
        let [c11, c12, c16, c22, c26, c66] = self.plane.each_ref().map(|e| e.value(p));
        let [c13, c23, c36, c33] = self.through.each_ref().map(|e| e.value(p));
        let least = |matrix: &[f64], n| least_eigenvalue(matrix, n);
        let plane = least(&[c11, c12, c16, c12, c22, c26, c16, c26, c66], 3);
        let (what, least) = match is_strain {
            false => ("the stiffness", plane),
            true => {
                let whole = [
                    [c11, c12, c16, c13],
                    [c12, c22, c26, c23],
                    [c16, c26, c66, c36],
                    [c13, c23, c36, c33],
                ];
                ("the stiffness with the third direction", least(whole.as_flattened(), 4))
            }
        };
        let size = c11.abs() + c22.abs() + c66.abs();
        let message = format!("makes {what} indefinite: its least eigenvalue is {least:.3e}");
        (least.is_nan() || least <= 1e-12 * size).then_some(("c11", message))
    }
}

/// How a law changes along a line, in the world's axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LawSlopes {
    pub(crate) plane: PlaneStiffness,
    pub(crate) ratio: [f64; 3],
}
