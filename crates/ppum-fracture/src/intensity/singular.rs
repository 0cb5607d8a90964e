//! The singular part of a weight function, as formulas in the frame of its tip.
//!
//! A weight function is E′/2 (z − q 𝓛uᵃ) with the dual solution z of a factor, the auxiliary field
//! uᵃ of its mode and the cut-off q of the functional. At a straight crack 2μ √(2π) 𝓛uᵃ has the
//! derivatives of the Westergaard functions, with ζ = z^½
//!
//! ```text
//! F₁,₁ + i F₂,₁ = 1/(2ζ)    F₄,₁ + i F₃,₁ = (F₁,₁ + i F₂,₁) sin θ − ζ sin θ cos θ / r
//! ```
//!
//! and at one on an arc the potentials that `arc_fields` has of it.

use ppum::crack::TipId;
use ppum::dataset::Material;
use ppum::field::Field;
use ppum::function::{Frame, Function, FunctionKind, NonsmoothPoints, Role};
use ppum::vec2::Vec2;
use ppum_solve::assembly::FACTORS;
use std::f64::consts::TAU;

/// The functions −q 𝓛uᵃ_1 and −q 𝓛uᵃ_2 of each mode, in the frame of a tip with a curvature, with
/// the cut-off of a disc of this radius.
pub(crate) fn singular_functions(
    tip: TipId,
    material: &Material,
    curvature: f64,
    radius: f64,
) -> [[Function; 2]; FACTORS] {
    let texts = if curvature == 0.0 { STRAIGHT } else { ARC };
    let parameters = [
        ("kappa", material.kolosov()),
        ("unit", -0.5 / (material.mu() * TAU.sqrt())),
        ("bend", curvature),
        ("radius", radius),
    ];
    let used = |name: &str| curvature != 0.0 || name != "bend";
    let parameters = parameters.into_iter().filter(|(name, _)| used(name));
    let parameters: Vec<_> = parameters.map(|(name, value)| (name.to_owned(), value)).collect();
    let function = |mode: usize, component: usize| Function {
        name: format!(
            "weight {} {} of crack {} {}",
            MODES[mode],
            component,
            tip.crack,
            tip.end.name()
        ),
        kind: FunctionKind::Formula {
            text: texts[mode][component].into(),
            frame: Frame::Tip(tip),
            parameters: parameters.clone(),
            declared: NonsmoothPoints { singular: vec![Vec2::ZERO], ..NonsmoothPoints::default() },
            role: Role::Tip,
        },
    };
    [0, 1].map(|mode| [0, 1].map(|component| function(mode, component)))
}

/// The beginning of the names of weight functions and of their sums, as fields.
pub(crate) const WEIGHT: &str = "weight-";

/// True if a field is a weight function or a sum of some: its energy is infinite.
pub(crate) fn is_weight(field: &Field<'_>) -> bool {
    field.data.name.starts_with(WEIGHT)
}

/// The names of the modes.
pub(crate) const MODES: [&str; FACTORS] = ["I", "II"];

/// `let`s of the cut-off, and of half the powers of r and θ at a straight crack.
macro_rules! straight {
    ($text:literal) => {
        concat!(
            "let q = (1 - (r/radius)^4)^4;\n",
            "let c = cos(theta/2)/(2*sqrt(r));\nlet s = sin(theta/2)/(2*sqrt(r));\n",
            "let turn = y/r;\nlet change = 2*x*y/r^2;\n",
            "if(r < radius, unit*q*(",
            $text,
            "), 0)"
        )
    };
}

const STRAIGHT: [[&str; 2]; FACTORS] = [
    [
        straight!("(kappa - 1)*c - s*(turn + change)"),
        straight!("-(kappa + 1)*s - c*(turn - change)"),
    ],
    [
        straight!("-(kappa + 1)*s + c*(turn - change)"),
        straight!("(1 - kappa)*c - s*(turn + change)"),
    ],
];

/// `let`s of the cut-off, and at an arc of ζ, 1/ζ = p + io, z̄/z, v, h = v^½ and g = v^(−½) of
/// `arc_fields`, and of the parts of φ, z φ′ and ψ in front of 1/ζ and ζ; then a component of
/// κφ − z φ̄′ − ψ̄.
macro_rules! arc {
    ($mode:expr, $text:literal) => {
        concat!(
            "let q = (1 - (r/radius)^4)^4;\n",
            "let c = sqrt(r)*cos(theta/2);\nlet s = sqrt(r)*sin(theta/2);\n",
            "let p = c/r;\nlet o = -s/r;\n",
            "let tr = (x^2 - y^2)/r^2;\nlet ti = -2*x*y/r^2;\n",
            "let wr = 1 - bend*y;\nlet wi = bend*x;\nlet m = wr^2 + wi^2;\n",
            "let vr = wr/m;\nlet vi = -wi/m;\n",
            "let hr = sqrt((1/sqrt(m) + vr)/2);\nlet hi = vi/(2*hr);\n",
            "let gr = hr*wr - hi*wi;\nlet gi = hr*wi + hi*wr;\n",
            $mode,
            "let zr = tr*br - ti*bi + p*er - o*ei + c*fr - s*fi;\n",
            "let zi = tr*bi + ti*br + p*ei + o*er + c*fi + s*fr;\n",
            "if(r < radius, unit*q*(",
            $text,
            "), 0)"
        )
    };
}

macro_rules! arc_one {
    () => {
        concat!(
            "let ar = (p + bend*s)/2;\nlet ai = (o - bend*c)/2;\n",
            "let br = (bend*s - p)/4;\nlet bi = -(o + bend*c)/4;\n",
            "let er = gr/2 + vr/4;\nlet ei = gi/2 + vi/4;\n",
            "let fr = -bend*(hi/2 + vi/4);\nlet fi = bend*(hr/2 + vr/4);\n"
        )
    };
}

macro_rules! arc_two {
    () => {
        concat!(
            "let ar = (o - bend*c)/2;\nlet ai = -(p + bend*s)/2;\n",
            "let br = -(o + bend*c)/4;\nlet bi = (p - bend*s)/4;\n",
            "let er = vi/4 - gi/2;\nlet ei = gr/2 - vr/4;\n",
            "let fr = bend*(vr/4 - hr/2);\nlet fi = bend*(vi/4 - hi/2);\n"
        )
    };
}

const ARC: [[&str; 2]; FACTORS] = [
    [arc!(arc_one!(), "kappa*ar - zr"), arc!(arc_one!(), "kappa*ai + zi")],
    [arc!(arc_two!(), "kappa*ar - zr"), arc!(arc_two!(), "kappa*ai + zi")],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intensity::auxiliary::TipMaterialBody;
    use crate::intensity::sums::flat_cut_off;
    use ppum::crack::{End, TipPoint};
    use ppum::dataset::StressState;
    use ppum::formula::Formula;
    use ppum::function::function_scope;

    /// The texts give what the fields of the interaction integral give, in units of their size.
    #[test]
    fn formulas_are_those_of_the_fields() {
        let material = Material { young: 2.0, poisson: 0.27, state: StressState::PlaneStrain };
        let tip = TipId { crack: 0, end: End::Last };
        for curvature in [0.0, 0.6, -0.9] {
            let body = TipMaterialBody::new(&material, curvature);
            let functions = singular_functions(tip, &material, curvature, 1.1);
            for (x, y) in [(0.3_f64, 0.4_f64), (-0.7, 0.2), (-0.5, -0.6), (0.2, -0.9), (1.0, 1.0)] {
                let sign = if y >= 0.0 { 1.0 } else { -1.0 };
                let fields = body.fields_at::<2>(&TipPoint { x, y, sign, branch: 1.0 });
                let (q, _) = flat_cut_off(x * x + y * y, 1.1);
                let theta = y.atan2(x);
                let [cos, sin] = [(0.5 * theta).cos(), (0.5 * theta).sin()];
                // the sides of cracks come after these
                let polar = [x, y, x.hypot(y), theta, cos, sin];
                for (functions, field) in functions.iter().zip(&fields) {
                    for (function, expected) in functions.iter().zip(field.derivative) {
                        let FunctionKind::Formula { text, parameters, .. } = &function.kind else {
                            panic!("a formula")
                        };
                        let scope = function_scope(parameters, 1, &[]).expect("names");
                        let formula = Formula::parse(text, &scope).expect("a formula");
                        let mut values = polar.to_vec();
                        values.resize(scope.inputs().count(), 0.0);
                        let found = formula.evaluate(&values);
                        assert!((found + q * expected).abs() < 1e-14, "{found} {expected}");
                    }
                }
            }
        }
    }
}
