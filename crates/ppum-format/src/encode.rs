//! Dataset → content: the layout of FORMAT.md, group by group.

mod mesh;

use std::sync::Arc;

use ppum::crack::{Crack, SegmentId, TipId};
use ppum::dataset::{
    BoxPartition, Dataset, Equation, Fate, FieldData, Growth, NamedQuantity, Partition, Reaction,
    Record, Step, TipIntensity, Warning,
};
use ppum::domain::{Domain, Hole};
use ppum::formula::Table;
use ppum::function::{Cut, Declared, Frame, Function, FunctionKind, Role};
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::{Rect, Vec2};
use ppum::weight::WeightFunction;

use crate::content::{Array, ArrayValues, Content, Element, join, step_path};
use crate::error::WriteError;
use crate::limits::{FORMAT_VERSION, MAX_TABLE_VALUES};
use crate::names::{
    BOX_WITH_HOLES, BOXES, CRACK_ENDS, EIGENSTRAIN, ELASTICITY, ENDS, FATES, GROWTH_NUMBERS, HOLES,
    MEETS_CRACK, MEETS_HOLE, MESH, NO_EQUATION, NO_LEVELS, PLAIN_BOX, POISSON, STOPS,
    STRESS_STATES, Words, word,
};

type Written = Result<(), WriteError>;

/// Everything of a dataset under its names in the file, without checksums.
pub(crate) fn content(dataset: &Dataset) -> Result<Content, WriteError> {
    beginning(dataset, dataset.steps.len())
}

/// The same of the first steps alone.
pub(crate) fn beginning(dataset: &Dataset, steps: usize) -> Result<Content, WriteError> {
    let mut content = Content::new();
    let mut root = GroupWriter { path: String::new(), content: &mut content };
    let (major, minor) = FORMAT_VERSION;
    root.attribute("format", Array::scalar("ppum".to_owned()));
    root.attribute("format_version", Array::vector([major, minor]));
    root.attribute("program", Array::scalar(dataset.program.clone()));
    root.attribute("title", Array::scalar(dataset.title.clone()));
    if let Some(problem) = &dataset.problem {
        root.array("problem", Array::scalar(problem.clone()));
    }
    let is_mesh = dataset.steps.iter().any(|step| step.partition.mesh().is_some());
    domain(&mut root.group("domain"), &dataset.domain, is_mesh);
    equation(&mut root.group("equation"), &dataset.equation)?;
    tables(&mut root, &dataset.tables)?;
    quantities(&mut root.group("quantities"), &dataset.quantities);
    for (k, s) in dataset.steps.iter().take(steps).enumerate() {
        step(&mut root.group(&step_path(k)), s)?;
    }
    Ok(content)
}

/// A step under its names in the file.
pub(crate) fn one_step(number: usize, one: &Step) -> Result<Content, WriteError> {
    let mut content = Content::new();
    step(&mut GroupWriter { path: step_path(number), content: &mut content }, one)?;
    Ok(content)
}

fn domain(group: &mut GroupWriter, domain: &Domain, is_mesh: bool) {
    let kind = match (is_mesh, domain.holes.is_empty()) {
        (true, _) => MESH,
        (false, true) => PLAIN_BOX,
        (false, false) => BOX_WITH_HOLES,
    };
    group.attribute("kind", Array::scalar(kind.to_owned()));
    group.attribute("min", Array::vector(<[f64; 2]>::from(domain.bounds.min)));
    group.attribute("max", Array::vector(<[f64; 2]>::from(domain.bounds.max)));
    if !domain.holes.is_empty() {
        holes(&mut group.group("holes"), &domain.holes);
    }
}

fn holes(group: &mut GroupWriter, holes: &[Hole]) {
    let rows = holes.iter().map(|hole| match hole {
        Hole::Circle { center, radius } => (None, *radius, std::slice::from_ref(center)),
        Hole::Polygon { points, side } => (Some(*side), 0.0, points.as_slice()),
    });
    let points = rows.clone().flat_map(|(_, _, points)| points);
    let kinds = rows.clone().filter_map(|(kind, ..)| word(HOLES, kind));
    group.vector("kind", kinds.map(str::to_owned));
    group.array("points", Array::rows(points.map(|&p| <[f64; 2]>::from(p))));
    group.array("offsets", offsets(rows.clone().map(|(_, _, points)| points.len())));
    group.vector("radius", rows.map(|(_, radius, _)| radius));
}

/// Puts arrays into a group of the file.
struct GroupWriter<'a> {
    path: String,
    content: &'a mut Content,
}

impl GroupWriter<'_> {
    fn group(&mut self, name: &str) -> GroupWriter<'_> {
        GroupWriter { path: self.path_of(name), content: self.content }
    }

    fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    fn array(&mut self, name: &str, array: Array) {
        self.content.insert(self.path_of(name), array);
    }

    fn attribute(&mut self, name: &str, array: Array) {
        self.content.insert(self.path_of(&format!("@{name}")), array);
    }

    fn vector<T: Element>(&mut self, name: &str, values: impl IntoIterator<Item = T>) {
        self.array(name, Array::vector(values));
    }

    /// The word of an enumeration's value, or the error that the format has none.
    fn word<T: PartialEq>(
        &self,
        words: &Words<T>,
        value: T,
        name: &str,
    ) -> Result<String, WriteError> {
        word(words, value).map(str::to_owned).ok_or_else(|| self.unknown(name))
    }

    fn unknown(&self, name: &str) -> WriteError {
        WriteError::object(&self.path_of(name), "this kind has no word in the file format")
    }
}

fn equation(group: &mut GroupWriter, equation: &Equation) -> Written {
    for (name, expression) in equation.constants() {
        match expression.constant() {
            Some(value) => group.attribute(name, Array::scalar(value)),
            None => group.attribute(name, Array::scalar(expression.text().to_owned())),
        }
    }
    let kind = match equation {
        Equation::Elasticity(elasticity) => {
            let state = group.word(STRESS_STATES, elasticity.state, "state")?;
            group.attribute("state", Array::scalar(state));
            if elasticity.eigenstrain.is_some() { EIGENSTRAIN } else { ELASTICITY }
        }
        Equation::Poisson { .. } => POISSON,
        Equation::None => NO_EQUATION,
    };
    group.attribute("kind", Array::scalar(kind.to_owned()));
    Ok(())
}

fn tables(root: &mut GroupWriter, tables: &[Arc<Table>]) -> Written {
    for (k, table) in tables.iter().enumerate() {
        let mut group = root.group(&format!("tables/{k:04}"));
        let (x, y, values) = (table.x(), table.y(), table.values());
        group.attribute("name", Array::scalar(table.name().to_owned()));
        group.vector("x", x.iter().copied());
        if y.is_empty() {
            group.vector("values", values.iter().copied());
        } else {
            group.vector("y", y.iter().copied());
            let shape = vec![y.len() as u64, x.len() as u64];
            group.array("values", Array { shape, values: ArrayValues::F64(values.to_vec()) });
        }
    }
    let total: usize = tables.iter().map(|table| table.values().len()).sum();
    if total > MAX_TABLE_VALUES {
        let mistake = format!("have {total} values together; at most {MAX_TABLE_VALUES} may be");
        return Err(WriteError::object("tables", mistake));
    }
    Ok(())
}

/// Nothing where there are none, like everything that came with version 1.1.
fn quantities(group: &mut GroupWriter, quantities: &[NamedQuantity]) {
    if !quantities.is_empty() {
        group.vector("name", quantities.iter().map(|q| q.name.clone()));
        group.vector("formula", quantities.iter().map(|q| q.text.clone()));
        group.vector("unit", quantities.iter().map(|q| q.unit.clone()));
    }
}

fn step(group: &mut GroupWriter, step: &Step) -> Written {
    group.attribute("load", Array::scalar(step.load));
    match &step.partition {
        Partition::Boxes(boxes) => partition(&mut group.group("partition"), boxes),
        Partition::Mesh(mesh) => mesh::mesh(&mut group.group("partition"), mesh)?,
        _ => return Err(group.unknown("partition")),
    }
    cracks(&mut group.group("cracks"), &step.cracks)?;
    functions(&mut group.group("functions"), &step.functions)?;
    for (k, f) in step.fields.iter().enumerate() {
        field(&mut group.group(&format!("fields/{k:04}")), f)?;
    }
    let patches = step.partition.len();
    let mut attributes = group.group("attributes");
    attributes.vector("name", step.attributes.iter().map(|a| a.name.clone()));
    let values: Vec<_> = step.attributes.iter().map(|a| a.values.clone()).collect();
    attributes.array("values", Array::matrix(&values, patches));
    intensities(&mut group.group("intensities"), &step.intensities)?;
    history(&mut group.group("history"), &step.history);
    warnings(&mut group.group("warnings"), &step.warnings);
    reactions(&mut group.group("reactions"), &step.reactions);
    step.growth.iter().try_for_each(|g| growth(&mut group.group("growth"), g))
}

fn partition(group: &mut GroupWriter, partition: &BoxPartition) {
    let weight = &partition.weight;
    group.attribute("kind", Array::scalar(BOXES.to_owned()));
    group.attribute("weight", Array::scalar(weight.name().to_owned()));
    if let WeightFunction::Formula(formula) = weight {
        group.attribute("weight_formula", Array::scalar(formula.text().to_owned()));
    }
    group.vector("weight_breakpoints", weight.breakpoints().iter().copied());
    for (name, points) in [
        ("center", &partition.center),
        ("half", &partition.half),
        ("origin", &partition.origin),
        ("scale", &partition.scale),
        ("points", &partition.points),
    ] {
        group.array(name, Array::rows(points.iter().map(|&p| <[f64; 2]>::from(p))));
    }
    let corners = |c: &Rect| [c.min.x, c.min.y, c.max.x, c.max.y];
    if partition.has_cells() {
        group.array("cell", Array::rows(partition.cell.iter().map(corners)));
        group.vector("level", partition.level.iter().copied());
    }
    group.vector("point", partition.point.iter().map(|p| p.map_or(-1, i64::from)));
}

/// Compressed rows: where each part starts, and where the last one ends.
fn offsets(lengths: impl Iterator<Item = usize>) -> Array {
    let mut end = 0;
    let ends = lengths.map(|n| {
        end += n as u64;
        end
    });
    Array::vector(std::iter::once(0).chain(ends).collect::<Vec<u64>>())
}

fn cracks(group: &mut GroupWriter, cracks: &[Crack]) -> Written {
    let points = cracks.iter().flat_map(|c| &c.points);
    let mut ends = Vec::with_capacity(cracks.len());
    for crack in cracks {
        let [start, last] = crack.ends;
        ends.push([group.word(CRACK_ENDS, start, "ends")?, group.word(CRACK_ENDS, last, "ends")?]);
    }
    group.array("points", Array::rows(points.map(|&p| <[f64; 2]>::from(p))));
    group.array("offsets", offsets(cracks.iter().map(|c| c.points.len())));
    group.array("ends", Array::rows(ends));
    Ok(())
}

/// One row of the function table; what a kind does not use keeps its default.
struct Row<'a> {
    kind: &'static str,
    crack: i64,
    formula: &'a str,
    frame: &'static str,
    end: String,
    origin: [f64; 2],
    angle: f64,
    parameters: &'a [(String, f64)],
    cuts: &'a [Cut],
    kinks: &'a [[Vec2; 2]],
    singular: &'a [Vec2],
    levels: [i64; 2],
    role: String,
}

impl<'a> Row<'a> {
    fn new(kind: &'static str) -> Self {
        Self {
            kind,
            crack: -1,
            formula: "",
            frame: "",
            end: String::new(),
            origin: [0.0; 2],
            angle: 0.0,
            parameters: &[],
            cuts: &[],
            kinks: &[],
            singular: &[],
            levels: NO_LEVELS,
            role: String::new(),
        }
    }

    fn of(kind: &'a FunctionKind, group: &GroupWriter) -> Result<Self, WriteError> {
        match kind {
            FunctionKind::One => Ok(Self::new("one")),
            FunctionKind::Side { crack } => {
                Ok(Self { crack: i64::from(*crack), ..Self::new("side") })
            }
            FunctionKind::Level { field } => {
                Ok(Self { levels: [-1, i64::from(*field)], ..Self::new("level") })
            }
            FunctionKind::Component { cuts } => Ok(Self { cuts, ..Self::new("component") }),
            FunctionKind::Formula { text, frame, parameters, declared, role } => {
                let Declared { kinks, singular } = declared;
                let role = group.word(&Role::NAMES, *role, "role")?;
                let row = Self { formula: text, parameters, role, ..Self::new("formula") };
                Self { kinks, singular, ..row }.in_frame(frame, group)
            }
            _ => Err(group.unknown("kind")),
        }
    }

    fn in_frame(self, frame: &Frame, group: &GroupWriter) -> Result<Self, WriteError> {
        Ok(match *frame {
            Frame::World => Self { frame: "world", ..self },
            Frame::Fixed { origin, angle } => {
                Self { frame: "fixed", origin: origin.into(), angle, ..self }
            }
            Frame::Levels(fields) => {
                Self { frame: "levels", levels: fields.map(i64::from), ..self }
            }
            Frame::Tip(TipId { crack, end }) => {
                let end = group.word(ENDS, end, "end")?;
                Self { frame: "tip", crack: i64::from(crack), end, ..self }
            }
            _ => return Err(group.unknown("frame")),
        })
    }
}

fn functions(group: &mut GroupWriter, functions: &[Function]) -> Written {
    let rows: Vec<Row> =
        functions.iter().map(|f| Row::of(&f.kind, group)).collect::<Result<_, _>>()?;
    group.vector("name", functions.iter().map(|f| f.name.clone()));
    group.vector("kind", rows.iter().map(|r| r.kind.to_owned()));
    group.vector("crack", rows.iter().map(|r| r.crack));
    group.vector("formula", rows.iter().map(|r| r.formula.to_owned()));
    group.vector("frame", rows.iter().map(|r| r.frame.to_owned()));
    group.vector("frame_end", rows.iter().map(|r| r.end.clone()));
    group.array("frame_origin", Array::rows(rows.iter().map(|r| r.origin)));
    group.vector("frame_angle", rows.iter().map(|r| r.angle));
    group.array("parameter_offsets", offsets(rows.iter().map(|r| r.parameters.len())));
    let parameters = || rows.iter().flat_map(|r| r.parameters);
    group.vector("parameter_name", parameters().map(|(name, _)| name.clone()));
    group.vector("parameter_value", parameters().map(|(_, value)| *value));
    if rows.iter().any(|r| r.levels != NO_LEVELS) {
        group.array("levels", Array::rows(rows.iter().map(|r| r.levels)));
    }
    if rows.iter().any(|r| !r.role.is_empty()) {
        group.vector("role", rows.iter().map(|r| r.role.clone()));
    }
    cuts(group, &rows);
    declared(group, &rows);
    Ok(())
}

fn cuts(group: &mut GroupWriter, rows: &[Row]) {
    let all: Vec<_> = rows.iter().flat_map(|r| r.cuts).collect();
    if !all.is_empty() {
        group.array("cut_offsets", offsets(rows.iter().map(|r| r.cuts.len())));
        group.array("cuts", Array::rows(all.into_iter().map(cut)));
    }
}

fn cut(&Cut { segment: SegmentId { crack, segment }, left, right }: &Cut) -> [i64; 4] {
    [crack.into(), segment.into(), left.number(), right.number()]
}

fn declared(group: &mut GroupWriter, rows: &[Row]) {
    let kinks: Vec<_> = rows.iter().flat_map(|r| r.kinks).collect();
    if !kinks.is_empty() {
        group.array("kink_offsets", offsets(rows.iter().map(|r| r.kinks.len())));
        group.array("kinks", Array::rows(kinks.iter().map(|[a, b]| [a.x, a.y, b.x, b.y])));
    }
    let singular: Vec<_> = rows.iter().flat_map(|r| r.singular).collect();
    if !singular.is_empty() {
        group.array("singular_offsets", offsets(rows.iter().map(|r| r.singular.len())));
        group.array("singular", Array::rows(singular.iter().map(|&&p| <[f64; 2]>::from(p))));
    }
}

fn field(group: &mut GroupWriter, field: &FieldData) -> Written {
    let coefficients = field.coefficients.first().map_or(0, Vec::len);
    group.attribute("name", Array::scalar(field.name.clone()));
    group.attribute("unit", Array::scalar(field.unit.clone()));
    group.vector("components", field.components.iter().cloned());
    group.vector("exact", field.exact.iter().cloned());
    group.vector("patch_blocks", field.patch_blocks.iter().copied());
    group.vector("block_function", field.block_function.iter().copied());
    group.vector("block_degree", field.block_degree.iter().copied());
    group.vector("block_offset", field.block_offset.iter().copied());
    if field.block_space.iter().any(|space| *space != PolynomialSpace::Total) {
        mesh::spaces(group, "block_space", &field.block_space)?;
    }
    group.array("coefficients", Array::matrix(&field.coefficients, coefficients));
    Ok(())
}

fn intensities(group: &mut GroupWriter, intensities: &[TipIntensity]) -> Written {
    let mut ends = Vec::with_capacity(intensities.len());
    for intensity in intensities {
        ends.push(group.word(ENDS, intensity.tip.end, "end")?);
    }
    let rings = intensities.iter().flat_map(|i| &i.rings);
    group.vector("crack", intensities.iter().map(|i| i.tip.crack));
    group.vector("end", ends);
    group.vector("k1", intensities.iter().map(|i| i.k1));
    group.vector("k2", intensities.iter().map(|i| i.k2));
    group.array("ring_offsets", offsets(intensities.iter().map(|i| i.rings.len())));
    group.array("rings", Array::rows(rings.map(|r| [r.r1, r.r2, r.k1, r.k2])));
    known(group, "t_stress", intensities.iter().map(|i| i.t_stress));
    known(group, "j", intensities.iter().map(|i| i.j));
    known(group, "error", intensities.iter().map(|i| i.error));
    Ok(())
}

/// Nothing where no value is known; NaN stands for those that are not.
fn known(group: &mut GroupWriter, name: &str, values: impl Iterator<Item = Option<f64>> + Clone) {
    if values.clone().any(|value| value.is_some()) {
        group.vector(name, values.map(|value| value.unwrap_or(f64::NAN)));
    }
}

fn history(group: &mut GroupWriter, history: &[Record]) {
    group.vector("name", history.iter().map(|r| r.name.clone()));
    group.vector("value", history.iter().map(|r| r.value));
    group.vector("unit", history.iter().map(|r| r.unit.clone()));
}

/// Nothing where there are none; the place of a warning without one is NaN.
fn warnings(group: &mut GroupWriter, warnings: &[Warning]) {
    if warnings.is_empty() {
        return;
    }
    let at = |w: &Warning| w.at.map_or([f64::NAN; 2], <[f64; 2]>::from);
    group.vector("kind", warnings.iter().map(|w| w.kind.clone()));
    group.array("at", Array::rows(warnings.iter().map(at)));
    group.vector("value", warnings.iter().map(|w| w.value));
    group.vector("limit", warnings.iter().map(|w| w.limit));
    group.vector("message", warnings.iter().map(|w| w.message.clone()));
}

/// Nothing where there are none.
fn reactions(group: &mut GroupWriter, reactions: &[Reaction]) {
    let Some(first) = reactions.first() else { return };
    let components = first.force.len();
    let flags = |r: &Reaction| r.held.iter().map(|&h| f64::from(u8::from(h))).collect();
    let held: Vec<_> = reactions.iter().map(flags).collect();
    let force: Vec<_> = reactions.iter().map(|r| r.force.clone()).collect();
    group.vector("on", reactions.iter().map(|r| r.on.clone()));
    group.array("held", Array::matrix(&held, components));
    group.array("force", Array::matrix(&force, components));
    group.vector("moment", reactions.iter().map(|r| r.moment));
}

fn growth(group: &mut GroupWriter, growth: &Growth) -> Written {
    if let Some(cycles) = growth.cycles {
        group.attribute("cycles", Array::scalar(cycles));
    }
    if let Some(stop) = growth.stop {
        let stop = group.word(STOPS, stop, "@stop")?;
        group.attribute("stop", Array::scalar(stop));
    }
    let tips = || growth.tips.iter();
    let ends: Result<Vec<_>, _> = tips().map(|t| group.word(ENDS, t.tip.end, "end")).collect();
    let fates: Result<Vec<_>, _> = tips().map(|t| fate(group, t.fate)).collect();
    let (words, others): (Vec<_>, Vec<_>) = fates?.into_iter().unzip();
    group.vector("crack", tips().map(|t| t.tip.crack));
    group.vector("end", ends?);
    group.vector("fate", words);
    group.vector("other", others);
    group.array("path_offsets", offsets(tips().map(|t| t.path.len())));
    group.array("path", Array::rows(tips().flat_map(|t| &t.path).map(|&p| <[f64; 2]>::from(p))));
    for (name, value) in GROWTH_NUMBERS {
        group.vector(name, tips().map(|t| *value(&mut t.clone())));
    }
    Ok(())
}

/// The word of a fate, and the index of what is met.
fn fate(group: &GroupWriter, fate: Fate) -> Result<(String, i64), WriteError> {
    match fate {
        Fate::MeetsHole(k) => Ok((MEETS_HOLE.to_owned(), k.into())),
        Fate::MeetsCrack(k) => Ok((MEETS_CRACK.to_owned(), k.into())),
        other => Ok((group.word(FATES, other, "fate")?, -1)),
    }
}
