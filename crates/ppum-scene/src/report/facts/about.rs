//! Facts that all steps of a dataset have in common, and the cracks of a step.

use std::fmt;

use ppum::crack::{self, CrackEnd};
use ppum::dataset::{self, Dataset, StressState};
use ppum::domain::{self, PolygonSide};
use ppum::expression::Expression;
use ppum::text::{LocationText, trimmed};
use ppum::vec2::Vec2;
use serde::Serialize;

/// Facts that all steps have in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CommonFacts {
    title: String,
    program: String,
    domain: DomainFacts,
    equation: EquationFacts,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct DomainFacts {
    min: [f64; 2],
    max: [f64; 2],
    holes: Vec<HoleFacts>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum HoleFacts {
    Circle { center: [f64; 2], radius: f64 },
    Polygon { points: Vec<[f64; 2]> },
    Outside { points: Vec<[f64; 2]> },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum EquationFacts {
    Elasticity {
        young: Constant,
        poisson: Constant,
        state: &'static str,
        #[serde(skip_serializing_if = "Option::is_none")]
        eigenstrain: Option<[Constant; 4]>,
        #[serde(skip_serializing_if = "Option::is_none")]
        expansion: Option<Constant>,
    },
    Poisson {
        conductivity: Constant,
    },
    None,
}

/// A constant of the material: a number, or the text of a formula.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Constant {
    Number(f64),
    Formula(String),
}

/// A crack.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CrackFacts {
    points: Vec<[f64; 2]>,
    ends: [&'static str; 2],
}

fn arrays(points: &[Vec2]) -> Vec<[f64; 2]> {
    points.iter().copied().map(Vec2::into).collect()
}

/// Corners of rims that a line has at most.
const CORNERS: usize = 16;

fn rim(points: &[[f64; 2]], places: &LocationText) -> String {
    match points.len() {
        0..=CORNERS => path(points, places),
        n => format!("{} … ({n} corners)", path(&points[..3], places)),
    }
}

fn path(points: &[[f64; 2]], places: &LocationText) -> String {
    let points: Vec<_> = points.iter().map(|&p| places.show(p.into())).collect();
    points.join(" – ")
}

impl CommonFacts {
    /// The facts of a dataset.
    #[must_use]
    pub fn new(dataset: &Dataset) -> Self {
        let bounds = dataset.domain.bounds;
        let holes = dataset.domain.holes.iter().map(HoleFacts::new).collect();
        Self {
            title: dataset.title.clone(),
            program: dataset.program.clone(),
            domain: DomainFacts { min: bounds.min.into(), max: bounds.max.into(), holes },
            equation: EquationFacts::new(&dataset.equation),
        }
    }

    /// Title, program, equation, domain and holes in words behind their names.
    #[must_use]
    pub fn lines(&self, places: &LocationText) -> Vec<(&'static str, String)> {
        let DomainFacts { min, max, holes } = &self.domain;
        let [min, max] = [min, max].map(|&p| places.show(p.into()));
        let mut lines = vec![
            ("title", self.title.clone()),
            ("program", self.program.clone()),
            ("equation", self.equation.to_string()),
            ("domain", format!("{min} to {max}")),
        ];
        let name = |k| if k == 0 { "holes" } else { "" };
        lines.extend(holes.iter().enumerate().map(|(k, hole)| (name(k), hole.line(places))));
        lines
    }
}

impl HoleFacts {
    fn new(hole: &domain::Hole) -> Self {
        match hole {
            domain::Hole::Circle { center, radius } => {
                Self::Circle { center: (*center).into(), radius: *radius }
            }
            domain::Hole::Polygon { points, side: PolygonSide::Inside } => {
                Self::Polygon { points: arrays(points) }
            }
            domain::Hole::Polygon { points, side: PolygonSide::Outside } => {
                Self::Outside { points: arrays(points) }
            }
        }
    }

    fn line(&self, places: &LocationText) -> String {
        match self {
            Self::Circle { center, radius } => {
                let center = places.show((*center).into());
                format!("circle around {center}, radius {}", trimmed(*radius))
            }
            Self::Polygon { points } => format!("polygon {}", rim(points, places)),
            Self::Outside { points } => format!("outside of {}", rim(points, places)),
        }
    }
}

impl EquationFacts {
    fn new(equation: &dataset::Equation) -> Self {
        match equation {
            dataset::Equation::Elasticity(material) => Self::Elasticity {
                young: (&material.young).into(),
                poisson: (&material.poisson).into(),
                state: match material.state {
                    StressState::PlaneStrain => "plane-strain",
                    StressState::PlaneStress => "plane-stress",
                },
                eigenstrain: material
                    .eigenstrain
                    .as_ref()
                    .map(|given| given.strains.each_ref().map(Constant::from)),
                expansion: equation.expansion().map(Constant::from),
            },
            dataset::Equation::Poisson { conductivity } => {
                Self::Poisson { conductivity: conductivity.into() }
            }
            dataset::Equation::None => Self::None,
        }
    }
}

impl fmt::Display for EquationFacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elasticity { young, poisson, state, eigenstrain, expansion } => {
                write!(f, "elasticity, E {young}, ν {poisson}, {state}")?;
                let Some([xx, yy, xy, zz]) = eigenstrain else { return Ok(()) };
                write!(f, ", given strains xx {xx}, yy {yy}, xy {xy}, zz {zz}")?;
                let Some(alpha) = expansion else { return Ok(()) };
                write!(f, ", and those of the temperature with α {alpha}")
            }
            Self::Poisson { conductivity } => write!(f, "Poisson, κ {conductivity}"),
            Self::None => f.write_str("none"),
        }
    }
}

impl From<&Expression> for Constant {
    fn from(expression: &Expression) -> Self {
        match expression.constant() {
            Some(value) => Self::Number(value),
            None => Self::Formula(expression.text().to_owned()),
        }
    }
}

impl fmt::Display for Constant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => f.write_str(&trimmed(*value)),
            Self::Formula(text) => f.write_str(text),
        }
    }
}

impl CrackFacts {
    /// The facts of a crack.
    #[must_use]
    pub fn new(crack: &crack::Crack) -> Self {
        let ends = crack.ends.map(|end| match end {
            CrackEnd::Tip => "tip",
            CrackEnd::Mouth => "mouth",
            CrackEnd::Junction => "junction",
        });
        Self { points: arrays(&crack.points), ends }
    }

    /// Its vertices between its ends: `mouth (0, 0) – (1, 0) tip`.
    #[must_use]
    pub fn line(&self, places: &LocationText) -> String {
        let [start, end] = self.ends;
        format!("{start} {} {end}", path(&self.points, places))
    }
}
