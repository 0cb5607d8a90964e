//! The facts of datasets as JSON, which Python reads, and quantities as dictionaries.

use ppum::crack::tips;
use ppum::dataset::Dataset;
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::quantity::{Quantity, available};
use ppum_scene::facts::{CommonFacts, CrackFacts, JsonNumber, ResultFacts, Tip};
use pyo3::prelude::*;
use serde::Serialize;

/// The data that all steps have in common.
#[derive(Serialize)]
struct DatasetFacts<'d> {
    #[serde(flatten)]
    about: CommonFacts,
    problem: Option<&'d str>,
    /// The bulges of the sides of each hole, none of one without arcs.
    bulges: Vec<Vec<f64>>,
}

/// A step, with what is no part of the program's JSON.
#[derive(Serialize)]
struct StepFacts<'d> {
    load: f64,
    patches: usize,
    cracks: Vec<CrackFacts>,
    /// The bulges of the edges of each crack, none of one without arcs.
    bulges: Vec<&'d [f64]>,
    functions: Vec<&'d str>,
    /// Names of the components of the first field.
    components: &'d [String],
    #[serde(flatten)]
    results: &'d ResultFacts,
    tips: &'d [Tip],
    /// The ends of their cracks that the tips are.
    ends: Vec<&'static str>,
    /// Curvature and path of what each tip does next.
    arcs: Vec<(JsonNumber, Vec<[f64; 2]>)>,
}

/// Returns the data that all steps of a dataset have in common.
pub(crate) fn about<'py>(py: Python<'py>, dataset: &Dataset) -> PyResult<Bound<'py, PyAny>> {
    let (about, problem) = (CommonFacts::new(dataset), dataset.problem.as_deref());
    let of_sides = |hole: &Hole| match hole {
        Hole::Polygon { bulges, .. } => bulges.clone(),
        Hole::Circle { .. } => Vec::new(),
    };
    let bulges = dataset.domain.holes.iter().map(of_sides).collect();
    to_python(py, &DatasetFacts { about, problem, bulges })
}

/// Dictionaries, lists, texts and numbers of Python.
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    facts: &impl Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    parsed(py, &json(facts))
}

/// Python's objects of a JSON text.
pub(crate) fn parsed<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (json,))
}

/// Returns the content of an existing step, as JSON.
pub(crate) fn step_json(dataset: &Dataset, number: usize) -> String {
    let step = &dataset.steps[number];
    let results = ResultFacts::new(dataset, number);
    let arcs = step.growth.iter().flat_map(|growth| &growth.tips);
    let path = |tip: &ppum::dataset::TipIncrement| tip.path.iter().map(|&p| p.into()).collect();
    json(&StepFacts {
        load: step.load,
        patches: step.partition.len(),
        cracks: step.cracks.iter().map(CrackFacts::new).collect(),
        bulges: step.cracks.iter().map(|crack| crack.bulges.as_slice()).collect(),
        functions: step.functions.iter().map(|f| f.name.as_str()).collect(),
        components: step.fields.first().map_or(&[], |field| &field.components),
        tips: &results.tips,
        results: &results,
        ends: tips(&step.cracks).map(|tip| tip.end.name()).collect(),
        arcs: arcs.map(|tip| (JsonNumber(tip.curvature), path(tip))).collect(),
    })
}

fn json(facts: &impl Serialize) -> String {
    serde_json::to_string(facts).expect("facts have names as keys")
}

/// A quantity: its name, the symbol of labels, the unit, and the formula if it is one that the
/// dataset names.
pub(crate) type QuantityFacts = (String, String, String, Option<String>);

/// All quantities that a field has, by name.
pub(crate) fn quantities(field: &Field<'_>) -> Vec<QuantityFacts> {
    let of = |name: String| {
        let quantity = Quantity::parse(&name, field).ok()?;
        let named = field.quantities.iter().find(|named| named.name == name);
        let (symbol, unit) = (quantity.symbol(&field.data.components), quantity.unit(field));
        Some((name, symbol, unit.to_owned(), named.map(|named| named.text.clone())))
    };
    available(field).into_iter().filter_map(of).collect()
}
