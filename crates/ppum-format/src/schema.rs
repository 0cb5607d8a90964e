//! The arrays of the file's groups, each named once. Attributes, and what is in a group only
//! sometimes, are in `encode` and `decode`.

mod functions;

use ppum::crack::Crack;
use ppum::dataset::{
    Attribute, BoxPartition, FieldData, NamedQuantity, Reaction, Record, TipIncrement,
    TipIntensity, TipStatus, Warning,
};
use ppum::domain::Hole;
use ppum::mesh::{Clip, Mesh};
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::Vec2;

use crate::column::{ArrayColumn, TableColumns, any_vector, table, vector};
use crate::reader::GroupReader;
use crate::stored::{self, StoredWord as _};
#[cfg(test)]
pub(crate) use functions::role_by_name;
pub(crate) use functions::{FUNCTIONS, StoredFunction};

pub(crate) const QUANTITIES: &TableColumns<NamedQuantity> =
    table!(NamedQuantity: cell("name", name), cell("formula", text), cell("unit", unit));

pub(crate) const BOXES: &[ArrayColumn<BoxPartition>] = &[
    vector!(BoxPartition, center),
    vector!(BoxPartition, half),
    vector!(BoxPartition, origin),
    vector!(BoxPartition, scale),
    vector!(BoxPartition, cell).optional(),
    vector!(BoxPartition, level).optional(),
    vector!(BoxPartition, point),
    any_vector!(BoxPartition, points),
];

pub(crate) const MESH: &[ArrayColumn<Mesh>] = &[
    vector!(Mesh, shape),
    vector!(Mesh, origin),
    vector!(Mesh, map_degree),
    vector!(Mesh, map_space),
    vector!(Mesh, map_offset),
    vector!(Mesh, element),
    ArrayColumn::new(
        "map",
        |mesh, group, name| group.put_matrix(name, mesh.map.iter()),
        |mesh, group, name, _| mesh.map = group.matrix(name, 2).try_into().unwrap_or_default(),
    ),
];

/// The offsets of clips, there if there is any array of [`CLIPS`].
pub(crate) const CLIP_OFFSETS: &[ArrayColumn<Mesh>] = &[ArrayColumn::new(
    "clip_offsets",
    |mesh, group, name| group.put(name, &mesh.clip_offsets),
    |mesh, group, name, n| mesh.clip_offsets = group.rows(name, n + 1),
)];

pub(crate) const CLIPS: &TableColumns<Clip> =
    table!(Clip: cell("clip_field", field), cell("clip_side", is_above));

pub(crate) const CRACKS: &TableColumns<Crack> =
    table!(Crack: cell("ends", ends), list("points", "offsets", points));

/// Components, coefficients, and what has an entry for each block.
pub(crate) const FIELD: &[ArrayColumn<FieldData>] = &[
    any_vector!(FieldData, components),
    any_vector!(FieldData, exact).optional(),
    any_vector!(FieldData, patch_blocks),
    vector!(FieldData, block_function),
    vector!(FieldData, block_degree),
    ArrayColumn {
        is_used: |data| data.block_space.contains(&PolynomialSpace::Tensor),
        ..vector!(FieldData, block_space).optional()
    },
    vector!(FieldData, block_offset),
    ArrayColumn::new(
        "coefficients",
        |data, group, name| group.put_matrix(name, data.coefficients.iter()),
        |data, group, name, _| {
            data.coefficients = group.matrix(name, group.rows_of(["components", name]));
        },
    ),
];

pub(crate) const ATTRIBUTES: &TableColumns<Attribute> =
    table!(Attribute: cell("name", name), matrix("values", values));

pub(crate) const INTENSITIES: &TableColumns<TipIntensity> = table!(TipIntensity:
    cell("crack", tip.crack), cell("end", tip.end), cell("k1", k1), cell("k2", k2),
    list("rings", "ring_offsets", rings), cell("t_stress", t_stress).optional(),
    cell("j", j).optional(), cell("error", error).optional(),
);

pub(crate) const HISTORY: &TableColumns<Record> =
    table!(Record: cell("name", name), cell("value", value), cell("unit", unit));

pub(crate) const WARNINGS: &TableColumns<Warning> = table!(Warning:
    cell("kind", kind), cell("message", message), cell("at", at), cell("value", value),
    cell("limit", limit),
);

pub(crate) const REACTIONS: &TableColumns<Reaction> = table!(Reaction:
    cell("on", on), custom(HELD), matrix("force", force), cell("moment", moment));

/// Numbers that are 1 where the support holds a component.
const HELD: ArrayColumn<[Reaction]> = ArrayColumn {
    counts: true,
    ..ArrayColumn::new(
        "held",
        |rows, group, name| {
            let flag = |held: &bool| f64::from(u8::from(*held));
            let flags = rows.iter().map(|row| row.held.iter().map(flag).collect::<Vec<_>>());
            group.put_matrix(name, flags)
        },
        |rows, group, name, n| {
            let is_held = |h: f64| {
                if h != 0.0 && h != 1.0 {
                    group.error(name, format!("{h}: expected 0 or 1"));
                }
                h == 1.0
            };
            for (row, held) in rows.iter_mut().zip(group.matrix(name, n)) {
                row.held = held.into_iter().map(is_held).collect();
            }
        },
    )
};

pub(crate) const GROWTH: &TableColumns<TipIncrement> = table!(TipIncrement:
    cell("crack", tip.crack), cell("end", tip.end), cell("fate", fate), custom(OTHER),
    list("path", "path_offsets", path), cell("strength", k_eq), cell("direction", direction),
    cell("curvature", curvature), cell("length", length), cell("due", due),
    cell("extension", extension),
);

const OTHER: ArrayColumn<[TipIncrement]> = ArrayColumn {
    counts: true,
    ..ArrayColumn::new(
        "other",
        |tips, group, name| group.put(name, &tips.iter().map(other).collect::<Vec<_>>()),
        |tips, group, name, n| {
            let others = tips.iter_mut().zip(group.rows(name, n));
            others.for_each(|(tip, other)| set_other(group, tip, other));
        },
    )
};

/// The index of what a tip meets, −1 for none.
fn other(tip: &TipIncrement) -> i64 {
    match tip.fate {
        TipStatus::MeetsHole(k) | TipStatus::MeetsCrack(k) => k.into(),
        _ => -1,
    }
}

fn set_other(group: &GroupReader, tip: &mut TipIncrement, other: i64) {
    let word = tip.fate.word().unwrap_or_default();
    match &mut tip.fate {
        TipStatus::MeetsHole(k) | TipStatus::MeetsCrack(k) => match u32::try_from(other) {
            Ok(index) => *k = index,
            Err(_) => group.error("other", format!("{other} is no index of what `{word}`")),
        },
        _ if other != -1 && !group.is_wrong("fate") => {
            group.error("other", format!("is {other} of `{word}`, must be -1"));
        }
        _ => {}
    }
}

/// A hole as a row of its group.
#[derive(Clone, Default)]
pub(crate) struct StoredHole {
    pub(crate) kind: String,
    pub(crate) points: Vec<Vec2>,
    pub(crate) radius: f64,
}

pub(crate) const HOLES: &TableColumns<StoredHole> = table!(StoredHole:
    cell("kind", kind), list("points", "offsets", points), cell("radius", radius));

impl StoredHole {
    pub(crate) fn of(hole: &Hole) -> Self {
        let (side, points, radius) = match hole {
            Hole::Circle { center, radius } => (None, vec![*center], *radius),
            Hole::Polygon { points, side } => (Some(*side), points.clone(), 0.0),
        };
        let kind = stored::HOLES.iter().find(|(kind, _)| *kind == side);
        Self { kind: kind.map_or_else(String::new, |(_, word)| (*word).to_owned()), points, radius }
    }

    pub(crate) fn hole(self, group: &GroupReader) -> Option<Hole> {
        let Self { kind, points, radius } = self;
        match (group.word(stored::HOLES, &kind, "kind")?, &*points) {
            (None, &[center]) => return Some(Hole::Circle { center, radius }),
            (None, _) if group.is_wrong("points") => {}
            (None, other) => {
                group.error("offsets", format!("a circle has 1 point, not {}", other.len()));
            }
            (Some(side), _) if radius == 0.0 => return Some(Hole::Polygon { points, side }),
            (Some(_), _) => group.error("radius", format!("is {radius} of a polygon, must be 0")),
        }
        None
    }
}
