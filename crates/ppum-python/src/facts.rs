//! What stands in datasets, as dictionaries.

use std::collections::BTreeMap;

use ppum::crack::{Crack, CrackEnd, TipId, tips};
use ppum::dataset::{Dataset, Growth, Reaction, Step, TipIntensity, Warning};
use ppum::domain::Hole;
use ppum::equation::Equation;
use ppum::field::Field;
use ppum::quantity::{Quantity, available};
use ppum::vec2::Vec2;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

type Pair = (f64, f64);

fn pair(p: Vec2) -> Pair {
    (p.x, p.y)
}

fn pairs(points: &[Vec2]) -> Vec<Pair> {
    points.iter().copied().map(pair).collect()
}

/// What all steps have in common.
#[derive(IntoPyObject)]
pub(crate) struct About {
    title: String,
    program: String,
    problem: Option<String>,
    equation: &'static str,
    domain: (Pair, Pair),
    holes: Vec<HoleFacts>,
    steps: usize,
}

/// A circle, or a polygon.
#[derive(IntoPyObject)]
struct HoleFacts {
    center: Option<Pair>,
    radius: Option<f64>,
    points: Option<Vec<Pair>>,
}

impl About {
    pub(crate) fn new(dataset: &Dataset) -> Self {
        let bounds = dataset.domain.bounds;
        Self {
            title: dataset.title.clone(),
            program: dataset.program.clone(),
            problem: dataset.problem.clone(),
            equation: match dataset.equation {
                Equation::Elasticity(_) => "elasticity",
                _ => "poisson",
            },
            domain: (pair(bounds.min), pair(bounds.max)),
            holes: dataset.domain.holes.iter().map(HoleFacts::new).collect(),
            steps: dataset.steps.len(),
        }
    }
}

impl HoleFacts {
    fn new(hole: &Hole) -> Self {
        match hole {
            Hole::Circle { center, radius } => {
                Self { center: Some(pair(*center)), radius: Some(*radius), points: None }
            }
            Hole::Polygon { points } => {
                Self { center: None, radius: None, points: Some(pairs(points)) }
            }
        }
    }
}

/// What stands in a step.
#[derive(IntoPyObject)]
pub(crate) struct StepFacts {
    load: f64,
    patches: usize,
    unknowns: usize,
    cracks: Vec<CrackFacts>,
    tips: Vec<TipFacts>,
    functions: Vec<String>,
    fields: Vec<(String, Vec<String>, String)>,
    history: Vec<(String, f64, String)>,
    warnings: Vec<WarningFacts>,
    reactions: Vec<ReactionFacts>,
    growth: Option<GrowthFacts>,
}

#[derive(IntoPyObject)]
struct CrackFacts {
    points: Vec<Pair>,
    ends: (&'static str, &'static str),
}

#[derive(IntoPyObject)]
struct WarningFacts {
    kind: String,
    at: Option<Pair>,
    value: f64,
    limit: f64,
    message: String,
}

#[derive(IntoPyObject)]
struct ReactionFacts {
    on: String,
    held: Vec<bool>,
    force: Vec<f64>,
    moment: f64,
}

#[derive(IntoPyObject)]
struct GrowthFacts {
    cycles: Option<f64>,
    stop: Option<&'static str>,
    tips: Vec<AdvanceFacts>,
}

#[derive(IntoPyObject)]
struct AdvanceFacts {
    crack: u32,
    end: &'static str,
    fate: String,
    strength: f64,
    direction: f64,
    curvature: f64,
    path: Vec<Pair>,
    length: f64,
    extension: f64,
}

impl StepFacts {
    /// The step of a number.
    ///
    /// # Errors
    /// `IndexError`.
    pub(crate) fn step(dataset: &Dataset, number: usize) -> PyResult<&Step> {
        let count = dataset.steps.len();
        let missing = || {
            PyIndexError::new_err(format!(
                "there is no step {number}; the dataset has {count} (numbered from 0)"
            ))
        };
        dataset.steps.get(number).ok_or_else(missing)
    }

    pub(crate) fn new(dataset: &Dataset, number: usize) -> PyResult<Self> {
        let step = Self::step(dataset, number)?;
        let records = step.history.iter();
        let fields = step.fields.iter();
        Ok(Self {
            load: step.load,
            patches: step.partition.len(),
            unknowns: step.unknowns(),
            cracks: step.cracks.iter().map(CrackFacts::new).collect(),
            tips: TipFacts::all(dataset, step),
            functions: step.functions.iter().map(|f| f.name.clone()).collect(),
            fields: fields
                .map(|f| (f.name.clone(), f.components.clone(), f.unit.clone()))
                .collect(),
            history: records.map(|r| (r.name.clone(), r.value, r.unit.clone())).collect(),
            warnings: step.warnings.iter().map(WarningFacts::new).collect(),
            reactions: step.reactions.iter().map(ReactionFacts::new).collect(),
            growth: step.growth.as_ref().map(GrowthFacts::new),
        })
    }
}

impl CrackFacts {
    fn new(crack: &Crack) -> Self {
        let word = |end| match end {
            CrackEnd::Tip => "tip",
            CrackEnd::Mouth => "mouth",
            CrackEnd::Junction => "junction",
        };
        let [start, last] = crack.ends;
        Self { points: pairs(&crack.points), ends: (word(start), word(last)) }
    }
}

impl WarningFacts {
    fn new(warning: &Warning) -> Self {
        Self {
            kind: warning.kind.clone(),
            at: warning.at.map(pair),
            value: warning.value,
            limit: warning.limit,
            message: warning.message.clone(),
        }
    }
}

impl ReactionFacts {
    fn new(reaction: &Reaction) -> Self {
        let Reaction { on, held, force, moment } = reaction.clone();
        Self { on, held, force, moment }
    }
}

impl GrowthFacts {
    fn new(growth: &Growth) -> Self {
        let advance = |tip: &ppum::dataset::Advance| AdvanceFacts {
            crack: tip.tip.crack,
            end: tip.tip.end.name(),
            fate: tip.fate.words(),
            strength: tip.strength,
            direction: tip.direction,
            curvature: tip.curvature,
            path: pairs(&tip.path),
            length: tip.length,
            extension: tip.extension,
        };
        Self {
            cycles: growth.cycles,
            stop: growth.stop.map(ppum::dataset::GrowthStop::words),
            tips: growth.tips.iter().map(advance).collect(),
        }
    }
}

/// A tip with its factors; those that are not known are NaN.
#[derive(IntoPyObject)]
struct TipFacts {
    crack: u32,
    end: &'static str,
    xy: Pair,
    angle: f64,
    k1: f64,
    k2: f64,
    t_stress: f64,
    j: f64,
    g: f64,
    growth_angle: f64,
    error: f64,
    spread: f64,
    rings: Vec<(f64, f64, f64, f64)>,
}

impl TipFacts {
    /// All tips in their order, with the factors that the solver stored.
    fn all(dataset: &Dataset, step: &Step) -> Vec<Self> {
        // of several factors of a tip the first ones count
        let known: BTreeMap<TipId, &TipIntensity> =
            step.intensities.iter().rev().map(|factors| (factors.tip, factors)).collect();
        tips(&step.cracks).map(|id| Self::new(dataset, step, id, known.get(&id).copied())).collect()
    }

    fn new(dataset: &Dataset, step: &Step, id: TipId, known: Option<&TipIntensity>) -> Self {
        let crack = &step.cracks[id.crack as usize];
        let (at, axis) = (crack.end_point(id.end), crack.growth_direction(id.end));
        let unknown = TipIntensity::new(id, f64::NAN, f64::NAN);
        let factors = known.unwrap_or(&unknown);
        let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let elastic = dataset.equation.elastic();
        Self {
            crack: id.crack,
            end: id.end.name(),
            xy: pair(at),
            angle: axis.y.atan2(axis.x),
            k1: factors.k1,
            k2: factors.k2,
            t_stress: number(factors.t_stress),
            j: number(factors.j),
            g: number(elastic.map(|body| factors.energy_release(&body.at(at)))),
            growth_angle: number(factors.growth_angle()),
            error: number(factors.error),
            spread: factors.spread(),
            rings: factors.rings.iter().map(|r| (r.r1, r.r2, r.k1, r.k2)).collect(),
        }
    }
}

/// A quantity: its name, the symbol of labels, the unit, and the formula if it is one that the dataset names.
#[derive(IntoPyObject)]
pub(crate) struct QuantityFacts {
    name: String,
    symbol: String,
    unit: String,
    formula: Option<String>,
}

impl QuantityFacts {
    /// All that the field has, by name.
    pub(crate) fn all(field: &Field<'_>) -> Vec<Self> {
        let of = |name: String| {
            let quantity = Quantity::parse(&name, field).ok()?;
            let named = field.quantities.iter().find(|named| named.name == name);
            Some(Self {
                symbol: quantity.symbol(&field.data.components),
                unit: quantity.unit(field).to_owned(),
                formula: named.map(|named| named.text.clone()),
                name,
            })
        };
        available(field).into_iter().filter_map(of).collect()
    }
}
