//! The law of an anisotropic body: engineering constants along its axes, or a stiffness.

use ppum::anisotropy::Anisotropy;
use ppum::dataset::StressState;
use ppum::expression::Expression;

use crate::file::{DocumentValue, FromValue as _, Section, all};

/// Keys that only anisotropic bodies have.
const KEYS: [&str; 3] = ["shear", "stiffness", "out_of_plane"];

/// True if the material is not an isotropic one.
pub(super) fn is_anisotropic(material: &Section<'_>) -> bool {
    let is_list = |key| material.value(key).is_some_and(|value| value.is_list());
    material.mentions_any(&KEYS) || is_list("young") || is_list("poisson")
}

/// The law; values that are missing or wrong are reported.
pub(super) fn anisotropy(material: &Section<'_>, state: StressState) -> Option<Anisotropy> {
    if state == StressState::Axisymmetric {
        return material.value("state")?.error(
            "is for isotropic bodies; give numbers for `young` and `poisson`, or write \"plane-strain\" or \"plane-stress\"",
        );
    }
    let axis = angle(material)?;
    if !material.mentions("stiffness") {
        return engineering(material, state, axis);
    }
    let others = ["young", "poisson", "shear"];
    if let Some(value) = others.iter().find_map(|key| material.value(key)) {
        return value.error("contradicts `stiffness`; give one of them");
    }
    let rows = material.value("stiffness")?;
    let matrix = all(rows.list()?.iter().map(expressions))?;
    let [[c11, c12, c16], [c21, c22, c26], [c61, c62, c66]] = square(&matrix).or_else(|| {
        rows.error(
            "must be [[c11, c12, c16], [c12, c22, c26], [c16, c26, c66]]: three rows of three",
        )
    })?;
    if [(c12, c21), (c16, c61), (c26, c62)].into_iter().any(|(a, b)| a != b) {
        return rows.error("is not symmetric; write each modulus off the diagonal twice");
    }
    let plane = [c11, c12, c16, c22, c26, c66].map(Clone::clone);
    let zeros = || [0.0; 4].map(Expression::number);
    let through = match (material.value("out_of_plane"), state) {
        (None, StressState::PlaneStress) => zeros(),
        (None, _) => {
            return material.error(
                "`out_of_plane` is missing in [material]; plane strain needs [c13, c23, c36, c33] for σ_zz",
            );
        }
        (Some(value), StressState::PlaneStress) => {
            return value.error("has no effect in plane stress; remove it");
        }
        (Some(value), _) => <[Expression; 4]>::try_from(expressions(&value)?)
            .ok()
            .or_else(|| value.error("must be [c13, c23, c36, c33]"))?,
    };
    Some(Anisotropy { plane, through, axis })
}

/// The angle of the first axis in radians.
pub(super) fn angle(material: &Section<'_>) -> Option<Expression> {
    let degrees = material.or("axis", Expression::number(0.0))?;
    match degrees.constant() {
        Some(degrees) => Some(Expression::number(degrees.to_radians())),
        None => {
            Combination { material, of: vec![("degrees", &degrees)] }.formula("degrees*(pi/180)")
        }
    }
}

/// The law of E₁, E₂, E₃, ν₁₂, ν₁₃, ν₂₃ and G₁₂: with ν_ij/E_i = ν_ji/E_j
///
/// ```text
/// a₁₁ = 1/E₁ − E₃(ν₁₃/E₁)²   a₁₂ = −ν₁₂/E₁ − E₃(ν₁₃/E₁)(ν₂₃/E₂)   a₂₂ = 1/E₂ − E₃(ν₂₃/E₂)²
/// ```
///
/// in plane strain and without E₃ in plane stress, and σ_33 = E₃(ν₁₃/E₁ σ_11 + ν₂₃/E₂ σ_22 + ε_33).
fn engineering(material: &Section<'_>, state: StressState, axis: Expression) -> Option<Anisotropy> {
    let (wanted, ratios, form) = match state {
        StressState::PlaneStress => (2, 1, ["must be [E1, E2] in plane stress", "must be [nu12]"]),
        _ => (
            3,
            3,
            ["must be [E1, E2, E3] in plane strain", "must be [nu12, nu13, nu23] in plane strain"],
        ),
    };
    let list = |key: &str, wanted: usize, form: &str| {
        let value = material.required(key)?;
        if !value.is_list() {
            return value.error(&format!("{form}, as the body is anisotropic"));
        }
        let list = expressions(&value)?;
        // the third direction has no effect in plane stress
        let fits = list.len() == wanted || state == StressState::PlaneStress && list.len() == 3;
        if fits { Some(list) } else { value.error(form) }
    };
    let (young, poisson) = (list("young", wanted, form[0]), list("poisson", ratios, form[1]));
    let shear = match material.value("shear") {
        Some(value) => Expression::read(&value),
        None => material
            .error("`shear` is missing in [material]; give the shear modulus, e.g. `shear = 9.66`"),
    };
    let (young, poisson, shear) = (young?, poisson?, shear?);
    let zero = Expression::number(0.0);
    let third = |list: &[Expression], k: usize| match state {
        StressState::PlaneStress => zero.clone(),
        _ => list[k].clone(),
    };
    let (e3, nu13, nu23) = (third(&young, 2), third(&poisson, 1), third(&poisson, 2));
    let of = Combination {
        material,
        of: vec![
            ("young_1", &young[0]),
            ("young_2", &young[1]),
            ("young_3", &e3),
            ("nu_12", &poisson[0]),
            ("nu_13", &nu13),
            ("nu_23", &nu23),
        ],
    };
    let compliance = "let p_1 = nu_13/young_1; let p_2 = nu_23/young_2; \
         let a_11 = 1/young_1 - young_3*p_1*p_1; let a_12 = -nu_12/young_1 - young_3*p_1*p_2; \
         let a_22 = 1/young_2 - young_3*p_2*p_2; let det = a_11*a_22 - a_12*a_12;";
    let formula = |text: &str| of.formula(&format!("{compliance} {text}"));
    let (c11, c12) = (formula("a_22/det")?, formula("-a_12/det")?);
    let plane = [c11, c12, zero.clone(), formula("a_11/det")?, zero.clone(), shear];
    let through = match state {
        StressState::PlaneStress => [0.0; 4].map(Expression::number),
        _ => [
            formula("young_3*(p_1*a_22 - p_2*a_12)/det")?,
            formula("young_3*(p_2*a_11 - p_1*a_12)/det")?,
            zero,
            formula(
                "young_3 + young_3^2*(p_1*(p_1*a_22 - p_2*a_12) + p_2*(p_2*a_11 - p_1*a_12))/det",
            )?,
        ],
    };
    Some(Anisotropy { plane, through, axis })
}

/// A formula of some expressions under names.
struct Combination<'a> {
    material: &'a Section<'a>,
    of: Vec<(&'static str, &'a Expression)>,
}

impl Combination<'_> {
    /// The formula, a number if all of them are.
    fn formula(&self, text: &str) -> Option<Expression> {
        let lets = self.of.iter().map(|(name, e)| format!("let {name} = ({}); ", e.text()));
        let whole = lets.collect::<String>() + text;
        let scope = self.material.document.scope()?;
        match Expression::parse_in(&format!("({whole})"), scope) {
            Ok(whole) => Some(whole.constant().map_or(whole, Expression::number)),
            // the parts are formulas: their combination is too long, or a table has one of the
            // names
            Err(error) => self.material.error(format!("the moduli make no formula: {error}")),
        }
    }
}

fn expressions(value: &DocumentValue<'_>) -> Option<Vec<Expression>> {
    all(value.list()?.iter().map(Expression::read))
}

fn square(rows: &[Vec<Expression>]) -> Option<[[&Expression; 3]; 3]> {
    let row = |k: usize| <[&Expression; 3]>::try_from(rows[k].iter().collect::<Vec<_>>()).ok();
    if rows.len() == 3 { Some([row(0)?, row(1)?, row(2)?]) } else { None }
}
