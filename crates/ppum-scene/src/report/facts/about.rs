//! Facts that all steps of a dataset have in common, and the cracks of a step.

use std::collections::BTreeMap;
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
    Polygon(EdgeFacts),
    Outside(EdgeFacts),
}

/// The edges of a crack or a rim: vertices, and the bulges behind them unless all are segments.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct EdgeFacts {
    points: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bulges: Vec<f64>,
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
    Anisotropic {
        #[serde(flatten)]
        stiffness: BTreeMap<&'static str, Constant>,
        state: &'static str,
        #[serde(skip_serializing_if = "Option::is_none")]
        eigenstrain: Option<[Constant; 4]>,
    },
    Poisson {
        conductivity: Constant,
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        axisymmetric: bool,
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
    #[serde(flatten)]
    edges: EdgeFacts,
    ends: [&'static str; 2],
}

/// Corners of rims, and vertices of cracks with arcs, that a line has at most.
const CORNERS: usize = 16;

impl EdgeFacts {
    fn new(points: &[Vec2], bulges: &[f64]) -> Self {
        let is_curved = bulges.iter().any(|bulge| *bulge != 0.0);
        let bulges = if is_curved { bulges.to_vec() } else { Vec::new() };
        Self { points: points.iter().copied().map(Vec2::into).collect(), bulges }
    }

    /// The corners of a rim; of many only the first ones.
    fn rim(&self, places: &LocationText) -> String {
        match self.points.len() {
            n @ 0..=CORNERS => self.path(n, places) + &self.edge(n.saturating_sub(1)),
            n => format!("{} … ({n} corners{})", self.path(3, places), self.arcs()),
        }
    }

    /// The vertices of a crack; of many between arcs only the first ones and the last one.
    fn crack(&self, places: &LocationText) -> String {
        match self.points.len() {
            n if n > CORNERS && !self.bulges.is_empty() => {
                let last = places.show(self.points[n - 1].into());
                format!("{} … {last} ({n} vertices{})", self.path(3, places), self.arcs())
            }
            n => self.path(n, places),
        }
    }

    /// The first vertices with what joins them: `(0, 0) – (1, 0) – arc of 90° – (2, 1)`.
    fn path(&self, count: usize, places: &LocationText) -> String {
        let mut text = String::new();
        for (k, &point) in self.points.iter().take(count).enumerate() {
            let join = if k > 0 { self.edge(k - 1) + " – " } else { String::new() };
            text += &(join + &places.show(point.into()));
        }
        text
    }

    /// The sweep of the edge behind a vertex, positive where it turns left; nothing of a segment.
    fn edge(&self, k: usize) -> String {
        match self.bulges.get(k) {
            Some(&bulge) if bulge != 0.0 => {
                format!(" – arc of {}°", trimmed((4.0 * bulge.atan()).to_degrees()))
            }
            _ => String::new(),
        }
    }

    fn arcs(&self) -> String {
        match self.bulges.iter().filter(|bulge| **bulge != 0.0).count() {
            0 => String::new(),
            n => format!(", {n} arcs"),
        }
    }
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
            domain::Hole::Polygon { points, bulges, side: PolygonSide::Inside, .. } => {
                Self::Polygon(EdgeFacts::new(points, bulges))
            }
            domain::Hole::Polygon { points, bulges, side: PolygonSide::Outside, .. } => {
                Self::Outside(EdgeFacts::new(points, bulges))
            }
        }
    }

    fn line(&self, places: &LocationText) -> String {
        match self {
            Self::Circle { center, radius } => {
                let center = places.show((*center).into());
                format!("circle around {center}, radius {}", trimmed(*radius))
            }
            Self::Polygon(edges) => format!("polygon {}", edges.rim(places)),
            Self::Outside(edges) => format!("outside of {}", edges.rim(places)),
        }
    }
}

impl EquationFacts {
    fn new(equation: &dataset::Equation) -> Self {
        match equation {
            dataset::Equation::Elasticity(material) if material.anisotropy.is_some() => {
                Self::Anisotropic {
                    stiffness: equation.stiffness().map(|(name, e)| (name, e.into())).collect(),
                    state: state(material),
                    eigenstrain: eigenstrain(material),
                }
            }
            dataset::Equation::Elasticity(material) => Self::Elasticity {
                young: (&material.young).into(),
                poisson: (&material.poisson).into(),
                state: state(material),
                eigenstrain: eigenstrain(material),
                expansion: equation.expansion().map(Constant::from),
            },
            dataset::Equation::Poisson { conductivity, axisymmetric } => {
                Self::Poisson { conductivity: conductivity.into(), axisymmetric: *axisymmetric }
            }
            dataset::Equation::None => Self::None,
        }
    }
}

fn state(body: &dataset::Elasticity) -> &'static str {
    match body.state {
        StressState::PlaneStrain => "plane-strain",
        StressState::PlaneStress => "plane-stress",
        StressState::Axisymmetric => "axisymmetric",
    }
}

fn eigenstrain(body: &dataset::Elasticity) -> Option<[Constant; 4]> {
    body.eigenstrain.as_ref().map(|given| given.strains.each_ref().map(Constant::from))
}

fn write_strains(f: &mut fmt::Formatter<'_>, given: Option<&[Constant; 4]>) -> fmt::Result {
    let Some([xx, yy, xy, zz]) = given else { return Ok(()) };
    write!(f, ", given strains xx {xx}, yy {yy}, xy {xy}, zz {zz}")
}

impl fmt::Display for EquationFacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elasticity { young, poisson, state, eigenstrain, expansion } => {
                write!(f, "elasticity, E {young}, ν {poisson}, {state}")?;
                write_strains(f, eigenstrain.as_ref())?;
                let Some(alpha) = expansion else { return Ok(()) };
                write!(f, ", and those of the temperature with α {alpha}")
            }
            Self::Anisotropic { stiffness, state, eigenstrain } => {
                write!(f, "anisotropic elasticity, {state}")?;
                stiffness.iter().try_for_each(|(name, value)| write!(f, ", {name} {value}"))?;
                write_strains(f, eigenstrain.as_ref())
            }
            Self::Poisson { conductivity, axisymmetric } => {
                let about = if *axisymmetric { ", axisymmetric" } else { "" };
                write!(f, "Poisson, κ {conductivity}{about}")
            }
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
        Self { edges: EdgeFacts::new(&crack.points, &crack.bulges), ends }
    }

    /// Its vertices between its ends: `mouth (0, 0) – (1, 0) tip`.
    #[must_use]
    pub fn line(&self, places: &LocationText) -> String {
        let [start, end] = self.ends;
        format!("{start} {} {end}", self.edges.crack(places))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::{Rect, vec2};

    /// Arcs say by how much they turn; long curves have only ends and the number of arcs.
    #[test]
    fn arcs_are_told() {
        let (a, b) = (vec2(0.0, 0.0), vec2(1.0, 0.0));
        let places = LocationText::new(&Rect::new(a, vec2(1.0, 1.0)), &[]);
        let points = vec![a, b, vec2(1.0, 1.0)];
        let quarter = std::f64::consts::FRAC_PI_8.tan();
        let crack = crack::Crack { points, bulges: vec![-quarter, 0.0], ..Default::default() };
        let told = CrackFacts::new(&crack).line(&places);
        assert_eq!(told, "tip (0, 0) – arc of -90° – (1, 0) – (1, 1) tip");
        let half = domain::Hole::with_arcs(vec![a, b], vec![0.0, 1.0], PolygonSide::Inside);
        assert_eq!(HoleFacts::new(&half).line(&places), "polygon (0, 0) – (1, 0) – arc of 180°");
        let points = (0..40).map(|k| vec2(f64::from(k), 0.0)).collect();
        let long = crack::Crack { points, bulges: vec![0.1; 39], ..Default::default() };
        let told = CrackFacts::new(&long).line(&places);
        assert!(told.ends_with("… (39, 0) (40 vertices, 39 arcs) tip"), "{told}");
        let json = serde_json::to_string(&CrackFacts::new(&crack)).unwrap();
        assert!(json.contains("\"bulges\":[-0.41"), "{json}");
    }
}
