//! Content → dataset: the layout of FORMAT.md, group by group, every name and shape checked.

mod functions;
mod group;
mod growth;
mod tables;

use std::sync::Arc;

use ppum::crack::{Crack, CrackEnd, TipId};
use ppum::dataset::{
    Attribute, Dataset, Elasticity, Equation, FieldData, Growth, NamedQuantity, Partition,
    Reaction, Record, Ring, Step, TipIntensity, Warning,
};
use ppum::domain::{Domain, Hole};
use ppum::expression::Expression;
use ppum::formula::Table;
use ppum::vec2::{Rect, vec2};
use ppum::weight::{WeightError, WeightFunction};

use crate::content::{Array, Content, Form, Values};
use crate::error::ReadError;
use crate::limits::FORMAT_VERSION;
use crate::names::{BOX_WITH_HOLES, CIRCLE, CRACK_ENDS, ENDS, PLAIN_BOX, POLYGON, STRESS_STATES};
use functions::functions;
pub(crate) use group::missing;
use group::{Extent, Group, numbered, optional};
use growth::growth;
use tables::{Scopes, tables};

type Read<T> = Result<T, ReadError>;

/// The minor version, if this is a dataset and of a major version that can be read here.
pub(crate) fn check_version(content: &Content) -> Read<u32> {
    if content.get("@format") != Some(&Array::scalar("ppum".to_owned())) {
        return Err(ReadError::NotADataset);
    }
    match content.get("@format_version").map(|a| &a.values) {
        Some(Values::U32(v)) if v.len() == 2 => match v[0] {
            0 => Err(ReadError::object("@format_version", "the major version is at least 1")),
            major if major > FORMAT_VERSION.0 => {
                Err(ReadError::TooNew { major: major.into(), minor: v[1].into() })
            }
            _ => Ok(v[1]),
        },
        _ => Err(ReadError::object("@format_version", "expected two u32: major, minor")),
    }
}

/// The dataset in a content. Shapes and words are right afterwards, meaning is not yet checked.
pub(crate) fn dataset(content: &Content) -> Read<Dataset> {
    let mut dataset = head(content)?;
    let root = Group { path: String::new(), content };
    let scopes = Scopes::new(&dataset.tables)?;
    dataset.steps = numbered(&root, "steps", |group| step(group, &scopes))?;
    Ok(dataset)
}

/// A step of the dataset with these tables, in a content that holds nothing else.
pub(crate) fn one_step(content: &Content, path: &str, tables: &[Arc<Table>]) -> Read<Step> {
    let root = Group { path: String::new(), content };
    step(&root.group(path)?, &Scopes::new(tables)?)
}

/// The members of a step that hold [`results`].
pub(crate) const RESULTS: &[&str] = &["cracks", "intensities", "history", "warnings", "growth"];

/// The cracks of a step, and what its solver tells of it, in a content that holds this alone. The step has no
/// patches.
pub(crate) fn results(content: &Content, path: &str) -> Read<Step> {
    let mut step = empty(content, path)?;
    let root = Group { path: String::new(), content };
    let group = &root.group(path)?;
    step.cracks = cracks(&group.group("cracks")?)?;
    step.intensities = optional(group, "intensities", intensities)?;
    step.history = optional(group, "history", history)?;
    step.warnings = optional(group, "warnings", warnings)?;
    step.growth = of_growth(group)?;
    Ok(step)
}

/// A step with its load alone.
pub(crate) fn empty(content: &Content, path: &str) -> Read<Step> {
    let root = Group { path: String::new(), content };
    Ok(empty_step(root.group(path)?.attribute("load")?))
}

/// A step of this load, without patches.
pub(crate) fn empty_step(load: f64) -> Step {
    let mut step = Step::new(Partition {
        weight: WeightFunction::Linear,
        center: Vec::new(),
        half: Vec::new(),
        origin: Vec::new(),
        scale: Vec::new(),
        cell: Vec::new(),
        level: Vec::new(),
        point: Vec::new(),
        points: Vec::new(),
    });
    step.load = load;
    step
}

fn of_growth(group: &Group) -> Read<Option<Growth>> {
    group.holds("growth", Form::Group)?.then(|| growth(&group.group("growth")?)).transpose()
}

/// The dataset without its steps.
pub(crate) fn head(content: &Content) -> Read<Dataset> {
    let root = Group { path: String::new(), content };
    let tables = tables(&root)?;
    let scopes = Scopes::new(&tables)?;
    let title = root.attribute("title")?;
    let program = root.attribute("program")?;
    let problem = problem(&root)?;
    let domain = domain(&root.group("domain")?)?;
    let mut dataset = Dataset::new(domain, equation(&root.group("equation")?, &scopes)?);
    (dataset.title, dataset.program, dataset.problem) = (title, program, problem);
    dataset.quantities = optional(&root, "quantities", quantities)?;
    dataset.tables = tables;
    Ok(dataset)
}

fn problem(root: &Group) -> Read<Option<String>> {
    root.holds("problem", Form::Dataset)?.then(|| root.scalar("problem")).transpose()
}

fn domain(group: &Group) -> Read<Domain> {
    let kind: String = group.attribute("kind")?;
    let with_holes = group.word(&[(false, PLAIN_BOX), (true, BOX_WITH_HOLES)], &kind, "@kind")?;
    let bounds = Rect::new(group.attribute_point("min")?, group.attribute_point("max")?);
    if !with_holes {
        group.refuse("holes", Form::Group, &kind)?;
        return Ok(Domain { bounds, holes: Vec::new() });
    }
    Ok(Domain { bounds, holes: holes(&group.group("holes")?)? })
}

fn holes(group: &Group) -> Read<Vec<Hole>> {
    let kinds = group.vector::<String>("kind")?;
    let points = group.points("points")?;
    let parts = group.offsets("offsets", kinds.len(), points.len())?;
    let radii = group.column::<f64>("radius", kinds.len())?;
    let rows = kinds.iter().zip(parts).zip(radii);
    rows.map(|((kind, part), radius)| {
        let is_circle = group.word(&[(true, CIRCLE), (false, POLYGON)], kind, "kind")?;
        match (is_circle, &points[part]) {
            (true, &[center]) => Ok(Hole::Circle { center, radius }),
            (true, other) => {
                Err(group.error("offsets", format!("a circle has 1 point, not {}", other.len())))
            }
            (false, points) if radius == 0.0 => Ok(Hole::Polygon { points: points.to_vec() }),
            (false, _) => {
                Err(group.error("radius", format!("is {radius} of a polygon, must be 0")))
            }
        }
    })
    .collect()
}

fn expect_kind(group: &Group, expected: &'static str) -> Read<()> {
    let kind: String = group.attribute("kind")?;
    group.word(&[((), expected)], &kind, "@kind")
}

fn equation(group: &Group, scopes: &Scopes) -> Read<Equation> {
    let kind: String = group.attribute("kind")?;
    match kind.as_str() {
        "elasticity" => {
            group.refuse("conductivity", Form::Attribute, &kind)?;
            let state: String = group.attribute("state")?;
            Ok(Equation::Elasticity(Elasticity {
                young: constant(group, "young", scopes)?,
                poisson: constant(group, "poisson", scopes)?,
                state: group.word(STRESS_STATES, &state, "@state")?,
            }))
        }
        "poisson" => {
            for name in ["young", "poisson", "state"] {
                group.refuse(name, Form::Attribute, &kind)?;
            }
            Ok(Equation::Poisson { conductivity: constant(group, "conductivity", scopes)? })
        }
        _ => Err(group.error("@kind", format!("unknown equation `{kind}`"))),
    }
}

/// A constant of the material: a number, or the text of a formula.
fn constant(group: &Group, name: &str, scopes: &Scopes) -> Read<Expression> {
    if !group.has_text(name) {
        return group.attribute(name).map(Expression::number);
    }
    let text: String = group.attribute(name)?;
    Expression::parse_in(&text, &scopes.plane)
        .map_err(|error| group.error(&format!("@{name}"), error.to_string()))
}

fn quantities(group: &Group) -> Read<Vec<NamedQuantity>> {
    let names = group.vector::<String>("name")?;
    let formulas = group.column::<String>("formula", names.len())?;
    let units = group.column::<String>("unit", names.len())?;
    let all = names.into_iter().zip(formulas).zip(units);
    Ok(all.map(|((name, text), unit)| NamedQuantity { name, text, unit }).collect())
}

fn step(group: &Group, scopes: &Scopes) -> Read<Step> {
    let load = group.attribute("load")?;
    let mut step = Step::new(partition(&group.group("partition")?, scopes)?);
    step.load = load;
    step.cracks = cracks(&group.group("cracks")?)?;
    step.functions = functions(&group.group("functions")?)?;
    step.fields = numbered(group, "fields", field)?;
    step.attributes = optional(group, "attributes", attributes)?;
    step.intensities = optional(group, "intensities", intensities)?;
    step.history = optional(group, "history", history)?;
    step.warnings = optional(group, "warnings", warnings)?;
    step.reactions = optional(group, "reactions", reactions)?;
    step.growth = of_growth(group)?;
    Ok(step)
}

fn partition(group: &Group, scopes: &Scopes) -> Read<Partition> {
    expect_kind(group, "shepard-box")?;
    let weight = weight(group, scopes)?;
    let center = group.points("center")?;
    let point = group
        .column::<i64>("point", center.len())?
        .into_iter()
        .map(|p| point_index(group, p))
        .collect::<Read<_>>()?;
    Ok(Partition {
        weight,
        half: group.points("half")?,
        origin: group.points("origin")?,
        scale: group.points("scale")?,
        cell: group
            .rows("cell")?
            .iter()
            .map(|&[x0, y0, x1, y1]| Rect::new(vec2(x0, y0), vec2(x1, y1)))
            .collect(),
        level: group.vector("level")?,
        point,
        points: group.points("points")?,
        center,
    })
}

fn weight(group: &Group, scopes: &Scopes) -> Read<WeightFunction> {
    let word: String = group.attribute("weight")?;
    let breakpoints = group.vector::<f64>("weight_breakpoints")?;
    if word == "formula" {
        if !breakpoints.is_sorted_by(|a, b| a < b) {
            return Err(group.error("weight_breakpoints", "must increase from each to the next"));
        }
        let text: String = group.attribute("weight_formula")?;
        return WeightFunction::formula_with_breakpoints(&text, &scopes.weight, &breakpoints)
            .map_err(|error| match error {
                WeightError::Breakpoint(_) => group.error("weight_breakpoints", error.to_string()),
                _ => group.error("@weight_formula", error.to_string()),
            });
    }
    let weight = WeightFunction::from_name(&word)
        .ok_or_else(|| group.error("@weight", format!("unknown weight function `{word}`")))?;
    group.refuse("weight_formula", Form::Attribute, &word)?;
    if breakpoints != weight.breakpoints() {
        return Err(group.error("weight_breakpoints", format!("are not those of `{word}`")));
    }
    Ok(weight)
}

fn point_index(group: &Group, p: i64) -> Read<Option<u32>> {
    match p {
        -1 => Ok(None),
        _ => u32::try_from(p)
            .map(Some)
            .map_err(|_| group.error("point", format!("{p} is neither an index nor -1"))),
    }
}

fn cracks(group: &Group) -> Read<Vec<Crack>> {
    let points = group.points("points")?;
    let ends = group.rows::<String, 2>("ends")?;
    let parts = group.offsets("offsets", ends.len(), points.len())?;
    let kind = |word: &str| -> Read<CrackEnd> { group.word(CRACK_ENDS, word, "ends") };
    std::iter::zip(parts, ends)
        .map(|(part, [start, last])| {
            Ok(Crack { points: points[part].to_vec(), ends: [kind(start)?, kind(last)?] })
        })
        .collect()
}

fn field(group: &Group) -> Read<FieldData> {
    let components = group.vector::<String>("components")?;
    let mut data = FieldData::new(&group.attribute::<String>("name")?, &[]);
    data.unit = group.attribute("unit")?;
    data.exact = exact(group)?;
    data.patch_blocks = group.vector("patch_blocks")?;
    data.block_function = group.vector("block_function")?;
    data.block_degree = group.vector("block_degree")?;
    data.block_offset = group.vector("block_offset")?;
    data.coefficients = group.matrix("coefficients", components.len())?;
    data.components = components;
    Ok(data)
}

fn exact(group: &Group) -> Read<Vec<String>> {
    if group.holds("exact", Form::Dataset)? { group.vector("exact") } else { Ok(Vec::new()) }
}

fn attributes(group: &Group) -> Read<Vec<Attribute>> {
    let names = group.vector::<String>("name")?;
    let values = group.matrix("values", names.len())?;
    Ok(std::iter::zip(names, values).map(|(name, values)| Attribute { name, values }).collect())
}

fn intensities(group: &Group) -> Read<Vec<TipIntensity>> {
    let crack = group.vector::<u32>("crack")?;
    let n = crack.len();
    let end = group.column::<String>("end", n)?;
    let (k1, k2) = (group.column::<f64>("k1", n)?, group.column::<f64>("k2", n)?);
    let ring = |&[r1, r2, k1, k2]: &[f64; 4]| Ring { r1, r2, k1, k2 };
    let rings: Vec<Ring> = group.rows("rings")?.iter().map(ring).collect();
    let parts = group.offsets("ring_offsets", n, rings.len())?;
    let (t_stress, j) = (known(group, "t_stress", n)?, known(group, "j", n)?);
    let error = known(group, "error", n)?;
    let intensity = |(k, part): (usize, std::ops::Range<usize>)| {
        let tip = TipId { crack: crack[k], end: group.word(ENDS, &end[k], "end")? };
        let (k1, k2, rings) = (k1[k], k2[k], rings[part].to_vec());
        Ok(TipIntensity { tip, k1, k2, t_stress: t_stress[k], j: j[k], error: error[k], rings })
    };
    parts.into_iter().enumerate().map(intensity).collect()
}

/// Values that are not there, or NaN, where they are not known.
fn known(group: &Group, name: &str, n: usize) -> Read<Vec<Option<f64>>> {
    if !group.holds(name, Form::Dataset)? {
        return Ok(vec![None; n]);
    }
    let values = group.column::<f64>(name, n)?;
    Ok(values.into_iter().map(|v| (!v.is_nan()).then_some(v)).collect())
}

fn history(group: &Group) -> Read<Vec<Record>> {
    let names = group.vector::<String>("name")?;
    let values = group.column::<f64>("value", names.len())?;
    let units = group.column::<String>("unit", names.len())?;
    let records = names.into_iter().zip(values).zip(units);
    Ok(records.map(|((name, value), unit)| Record { name, value, unit }).collect())
}

fn warnings(group: &Group) -> Read<Vec<Warning>> {
    let kinds = group.vector::<String>("kind")?;
    let n = kinds.len();
    let at = group.array::<f64>("at", &[Extent::Is(n as u64), Extent::Is(2)])?;
    let messages = group.column::<String>("message", n)?;
    let (values, limits) = (group.column::<f64>("value", n)?, group.column::<f64>("limit", n)?);
    let place = |k: usize| {
        let [x, y] = [at[2 * k], at[2 * k + 1]];
        (!x.is_nan() || !y.is_nan()).then_some(vec2(x, y))
    };
    let texts = kinds.into_iter().zip(messages).enumerate();
    let warning = |(k, (kind, message))| {
        let (value, limit) = (values[k], limits[k]);
        Warning { kind, at: place(k), value, limit, message }
    };
    Ok(texts.map(warning).collect())
}

fn reactions(group: &Group) -> Read<Vec<Reaction>> {
    let places = group.vector::<String>("on")?;
    let n = places.len();
    let (held, forces) = (group.matrix("held", n)?, group.matrix("force", n)?);
    let moments = group.column::<f64>("moment", n)?;
    let results = places.into_iter().zip(held).zip(forces.into_iter().zip(moments));
    let reaction = |((on, held), (force, moment)): ((String, Vec<f64>), (Vec<f64>, f64))| {
        let is_held = |&h: &f64| match h {
            0.0 => Ok(false),
            1.0 => Ok(true),
            _ => Err(group.error("held", format!("{h}: expected 0 or 1"))),
        };
        let held = held.iter().map(is_held).collect::<Read<_>>()?;
        Ok(Reaction { on, held, force, moment })
    };
    results.map(reaction).collect()
}

#[cfg(test)]
mod tests;
