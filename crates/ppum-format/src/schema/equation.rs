//! The equation: its kind, and the constants of the material as numbers or formulas.

use ppum::anisotropy::{Anisotropy, STIFFNESS};
use ppum::dataset::{
    Dataset, EIGENSTRAINS, EXPANSION, Eigenstrain, Elasticity, Equation, StressState,
};
use ppum::expression::Expression;

use crate::content::ObjectKind;
use crate::member::{GroupShape, Member, MemberNames};
use crate::reader::GroupReader;
use crate::stored::{EquationKind, StoredWord as _};
use crate::writer::{EncodeResult, GroupWriter};

pub(super) const EQUATION: Member<Dataset> = Member::<Dataset>::group(
    "equation",
    (GroupShape::Single, || {
        constants().map(|name| MemberNames::new(name, ObjectKind::Attribute)).collect()
    }),
    |dataset, group, name| put(&dataset.equation, &mut group.group(name)),
    |dataset, group, name, _| dataset.equation = take(&group.group(name)),
);

/// All attributes but the kind.
fn constants() -> impl Iterator<Item = &'static str> {
    let isotropic = ["conductivity", "young", "poisson", "state"].into_iter();
    isotropic.chain(EIGENSTRAINS).chain([EXPANSION]).chain(STIFFNESS)
}

/// True if an equation of a kind may have an attribute.
fn has(kind: EquationKind, name: &str) -> bool {
    let is_isotropic = matches!(name, "young" | "poisson");
    let is_given = EIGENSTRAINS.contains(&name);
    match kind {
        EquationKind::Elasticity => is_isotropic || name == "state",
        EquationKind::Eigenstrain => {
            is_isotropic || is_given || name == "state" || name == EXPANSION
        }
        EquationKind::Anisotropic => is_given || name == "state" || STIFFNESS.contains(&name),
        EquationKind::Poisson | EquationKind::AxisymmetricPoisson => name == "conductivity",
        EquationKind::None => false,
    }
}

fn put(equation: &Equation, group: &mut GroupWriter) -> EncodeResult {
    for (name, expression) in equation.constants() {
        match expression.constant() {
            Some(value) => group.attribute(name, &value)?,
            None => group.attribute(name, &expression.text().to_owned())?,
        }
    }
    let kind = match equation {
        Equation::Elasticity(elasticity) => {
            group.attribute("state", &elasticity.state)?;
            let is_strained = elasticity.eigenstrain.is_some();
            match elasticity.anisotropy {
                Some(_) => EquationKind::Anisotropic,
                None if is_strained => EquationKind::Eigenstrain,
                None => EquationKind::Elasticity,
            }
        }
        Equation::Poisson { axisymmetric: true, .. } => EquationKind::AxisymmetricPoisson,
        Equation::Poisson { .. } => EquationKind::Poisson,
        Equation::None => EquationKind::None,
    };
    group.attribute("kind", &kind)
}

fn take(group: &GroupReader) -> Equation {
    let Some(kind) = group.known_attribute("kind") else { return Equation::None };
    let others = constants().filter(|name| !has(kind, name));
    let word = kind.word().unwrap_or_default();
    others.for_each(|name| group.refuse(name, ObjectKind::Attribute, word));
    let constant = |name| constant(group, name);
    match kind {
        EquationKind::Elasticity | EquationKind::Eigenstrain => Equation::Elasticity(Elasticity {
            young: constant("young"),
            poisson: constant("poisson"),
            state: group.attribute("state"),
            anisotropy: None,
            eigenstrain: (kind == EquationKind::Eigenstrain).then(|| {
                let expansion =
                    group.holds(EXPANSION, ObjectKind::Attribute).then(|| constant(EXPANSION));
                Box::new(Eigenstrain { strains: EIGENSTRAINS.map(constant), expansion })
            }),
        }),
        EquationKind::Anisotropic => anisotropic(group),
        EquationKind::Poisson | EquationKind::AxisymmetricPoisson => Equation::Poisson {
            conductivity: constant("conductivity"),
            axisymmetric: kind == EquationKind::AxisymmetricPoisson,
        },
        EquationKind::None => Equation::None,
    }
}

/// An anisotropic body: σ_zz and the strains that are given need the constants through the plane in
/// plane strain alone.
fn anisotropic(group: &GroupReader) -> Equation {
    let state = group.attribute("state");
    let value = |k: usize| match (k, state) {
        (6..10, StressState::PlaneStress) => Expression::number(0.0),
        _ => constant(group, STIFFNESS[k]),
    };
    let law = Anisotropy {
        plane: std::array::from_fn(value),
        through: std::array::from_fn(|k| value(6 + k)),
        axis: value(10),
    };
    let is_strained = group.holds(EIGENSTRAINS[0], ObjectKind::Attribute);
    let strains = || EIGENSTRAINS.map(|name| constant(group, name));
    Equation::Elasticity(law.body(state, is_strained.then(|| Box::new(strains().into()))))
}

/// A constant of the material: a number, or the text of a formula.
fn constant(group: &GroupReader, name: &str) -> Expression {
    if !group.has_text(name) {
        return Expression::number(group.attribute(name));
    }
    let text: String = group.attribute(name);
    let parsed = group.scopes.and_then(|scopes| {
        let parsed = Expression::parse_in(&text, &scopes.plane);
        parsed.map_err(|error| group.error(&format!("@{name}"), error.to_string())).ok()
    });
    parsed.unwrap_or_else(|| Expression::number(1.0))
}
