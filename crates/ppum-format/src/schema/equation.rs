//! The equation: its kind, and the constants of the material as numbers or formulas.

use ppum::dataset::{Dataset, EIGENSTRAINS, EXPANSION, Eigenstrain, Elasticity, Equation};
use ppum::expression::Expression;

use crate::content::ObjectKind;
use crate::member::{GroupShape, Member, MemberNames};
use crate::reader::GroupReader;
use crate::stored::{EquationKind, StoredWord as _};
use crate::writer::{EncodeResult, GroupWriter};

pub(super) const EQUATION: Member<Dataset> = Member::<Dataset>::group(
    "equation",
    (GroupShape::Single, || {
        CONSTANTS.map(|name| MemberNames::new(name, ObjectKind::Attribute)).to_vec()
    }),
    |dataset, group, name| put(&dataset.equation, &mut group.group(name)),
    |dataset, group, name, _| dataset.equation = take(&group.group(name)),
);

/// All attributes but the kind.
const CONSTANTS: [&str; 9] = {
    let [xx, yy, xy, zz] = EIGENSTRAINS;
    ["conductivity", "young", "poisson", "state", xx, yy, xy, zz, EXPANSION]
};

/// Those of an equation of a kind.
fn constants(kind: EquationKind) -> &'static [&'static str] {
    match kind {
        EquationKind::Elasticity => &CONSTANTS[1..4],
        EquationKind::Eigenstrain => &CONSTANTS[1..],
        EquationKind::Poisson => &CONSTANTS[..1],
        EquationKind::None => &[],
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
            if is_strained { EquationKind::Eigenstrain } else { EquationKind::Elasticity }
        }
        Equation::Poisson { .. } => EquationKind::Poisson,
        Equation::None => EquationKind::None,
    };
    group.attribute("kind", &kind)
}

fn take(group: &GroupReader) -> Equation {
    let Some(kind) = group.known_attribute("kind") else { return Equation::None };
    let others = CONSTANTS.into_iter().filter(|name| !constants(kind).contains(name));
    let word = kind.word().unwrap_or_default();
    others.for_each(|name| group.refuse(name, ObjectKind::Attribute, word));
    let constant = |name| constant(group, name);
    match kind {
        EquationKind::Elasticity | EquationKind::Eigenstrain => Equation::Elasticity(Elasticity {
            young: constant("young"),
            poisson: constant("poisson"),
            state: group.attribute("state"),
            eigenstrain: (kind == EquationKind::Eigenstrain).then(|| {
                let expansion =
                    group.holds(EXPANSION, ObjectKind::Attribute).then(|| constant(EXPANSION));
                Box::new(Eigenstrain { strains: EIGENSTRAINS.map(constant), expansion })
            }),
        }),
        EquationKind::Poisson => Equation::Poisson { conductivity: constant("conductivity") },
        EquationKind::None => Equation::None,
    }
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
