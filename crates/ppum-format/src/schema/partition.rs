//! The patches of a step: boxes with weights, or a mesh.

use ppum::dataset::{BoxPartition, Partition, Step};
use ppum::mesh::{Clip, Mesh};
use ppum::weight::{WeightError, WeightFunction};

use crate::content::ObjectKind;
use crate::member::{GroupShape, Member, TableMembers, members, names_of};
use crate::reader::GroupReader;
use crate::stored::{PartitionKind, WEIGHTS};

pub(super) const PARTITION: Member<Step> = Member::<Step>::group(
    "partition",
    (GroupShape::Single, || [names_of(BOXES), names_of(MESH)].concat()),
    |step, group, name| {
        let mut group = group.group(name);
        match &step.partition {
            Partition::Boxes(boxes) => {
                group.attribute("kind", &PartitionKind::Boxes)?;
                group.put(BOXES, boxes)
            }
            Partition::Mesh(mesh) => {
                group.attribute("kind", &PartitionKind::Mesh)?;
                group.put(MESH, mesh)
            }
            _ => Err(group.unknown("@kind")),
        }
    },
    |step, group, name, _| {
        let group = group.group(name);
        // of an unknown kind the arrays are read as what they look like: one error, not one for
        // each that is missing
        let is_mesh = match group.known_attribute::<PartitionKind>("kind") {
            Some(kind) => kind == PartitionKind::Mesh,
            None => group.row_count("shape").is_some(),
        };
        step.partition = if is_mesh {
            group.taken(MESH, Mesh::default()).into()
        } else {
            let boxes = group.taken(BOXES, BoxPartition::EMPTY);
            check_cells(&group);
            boxes.into()
        };
    },
);

const BOXES: &[Member<BoxPartition>] = members!(BoxPartition:
    vector(center), vector(half), vector(origin), vector(scale), vector(cell).optional(),
    vector(level).optional(), vector(point), any_vector(points), custom(WEIGHT),
);

/// The weight function: a word, the formula if it is one, and the breakpoints.
const WEIGHT: Member<BoxPartition> = Member::<BoxPartition>::attribute(
    "weight_formula",
    |boxes, group, name| {
        let weight = &boxes.weight;
        group.attribute("weight", &weight.name().to_owned())?;
        if let WeightFunction::Formula(formula) = weight {
            group.attribute(name, &formula.text().to_owned())?;
        }
        group.values("weight_breakpoints", weight.breakpoints())
    },
    |boxes, group, _, _| boxes.weight = weight(group).unwrap_or(WeightFunction::Linear),
)
.of_field("weight");

fn weight(group: &GroupReader) -> Option<WeightFunction> {
    let word: Option<String> = group.known_attribute("weight");
    let breakpoints: Vec<f64> = group.list("weight_breakpoints");
    match group.word(WEIGHTS, &word?, "@weight")? {
        None => {
            if !breakpoints.is_sorted_by(|a, b| a < b) {
                group.error("weight_breakpoints", "must increase from each to the next");
                return None;
            }
            let text: String = group.attribute("weight_formula");
            let scope = &group.scopes?.weight;
            let weight = WeightFunction::formula_with_breakpoints(&text, scope, &breakpoints);
            let place = |error: &WeightError| match error {
                WeightError::Breakpoint(_) => "weight_breakpoints",
                _ => "@weight_formula",
            };
            weight.map_err(|error| group.error(place(&error), error.to_string())).ok()
        }
        Some(weight) => {
            let name = weight.name();
            group.refuse("weight_formula", ObjectKind::Attribute, name);
            let right = weight.breakpoints();
            if breakpoints != right {
                let message = format!("are {breakpoints:?}, but those of `{name}` are {right:?}");
                group.error("weight_breakpoints", message);
            }
            Some(weight)
        }
    }
}

/// Cells and their levels are there together, or not at all.
fn check_cells(group: &GroupReader) {
    let cells = ["cell", "level"];
    let [cell, level] = cells.map(|name| group.holds(name, ObjectKind::Dataset));
    if cell != level {
        let [missing, other] = if level { cells } else { [cells[1], cells[0]] };
        group.error(
            missing,
            format!("is missing; a cover without cells has no `{other}` either, leave it out too"),
        );
    }
}

const MESH: &[Member<Mesh>] = members!(Mesh:
    vector(shape), vector(origin), vector(map_degree), vector(map_space), vector(map_offset),
    vector(element), custom(MAP), custom(CLIPS),
);

const MAP: Member<Mesh> = Member::<Mesh>::array(
    "map",
    |mesh, group, name| group.put_matrix(name, mesh.map.iter()),
    |mesh, group, name, _| mesh.map = group.matrix(name, 2).try_into().unwrap_or_default(),
);

/// The clips and their offsets, where there are any.
const CLIPS: Member<Mesh> = Member::<Mesh>::array(
    "clip_offsets",
    |mesh, group, name| {
        if mesh.clips.is_empty() {
            return Ok(());
        }
        group.values(name, &mesh.clip_offsets)?;
        group.put(CLIP, &mesh.clips)
    },
    |mesh, group, name, n| {
        let names = CLIP.iter().map(|member| member.names.stored).chain([name]);
        if { names }.any(|name| group.holds(name, ObjectKind::Dataset)) {
            mesh.clip_offsets = group.rows(name, n + 1);
            mesh.clips = group.table(CLIP);
        }
    },
);

const CLIP: &TableMembers<Clip> =
    members!(Clip: cell("clip_field", field), cell("clip_side", is_above));
