//! The objects of the file, each named once: how it is written, how it is read, and its name in the
//! data model.

mod domain;
mod edges;
mod equation;
mod functions;
mod growth;
mod partition;
mod tables;

use ppum::dataset::{
    Attribute, Dataset, FieldData, NamedQuantity, Reaction, Record, Step, TipIntensity, Warning,
};
use ppum::polynomial::PolynomialSpace;

use crate::content::Array;
use crate::member::{GroupShape, Member, TableMembers, members, names_of, vector};
use crate::reader::numbered;
#[cfg(test)]
pub(crate) use functions::role_by_name;

/// All of a dataset but its steps; the tables, which formulas of the others may read, come first.
pub(crate) const HEAD: &[Member<Dataset>] = members!(Dataset:
    custom(tables::TABLES), attribute("title", title), attribute("program", program),
    custom(PROBLEM), custom(domain::DOMAIN), custom(equation::EQUATION),
    rows("quantities", quantities, QUANTITIES).optional(),
);

const PROBLEM: Member<Dataset> = Member::<Dataset>::array(
    "problem",
    |dataset, group, name| {
        let texts = dataset.problem.iter().cloned();
        texts.for_each(|text| group.array(name, Array::scalar(text)));
        Ok(())
    },
    |dataset, group, name, _| dataset.problem = Some(group.scalar(name)),
)
.optional();

const QUANTITIES: &TableMembers<NamedQuantity> =
    members!(NamedQuantity: cell("name", name), cell("formula", text), cell("unit", unit));

/// The steps of a dataset; they are written and read one by one.
pub(crate) const STEPS: Member<Dataset> = Member::<Dataset>::group(
    "steps",
    (GroupShape::Numbered, || names_of(STEP)),
    |_, _, _| Ok(()),
    |_, _, _, _| (),
);

pub(crate) const STEP: &[Member<Step>] = members!(Step:
    attribute("load", load), custom(partition::PARTITION), custom(edges::CRACKS),
    rows("intensities", intensities, INTENSITIES).optional_to_read(),
    rows("history", history, HISTORY).optional_to_read(),
    rows("warnings", warnings, WARNINGS).optional(), custom(growth::GROWTH),
    custom(functions::FUNCTIONS), custom(FIELDS), custom(ATTRIBUTES),
    rows("reactions", reactions, REACTIONS).optional(),
);

/// The members of a step that are read without its patches.
pub(crate) const RESULTS: &[&str] = &["cracks", "intensities", "history", "warnings", "growth"];

const FIELDS: Member<Step> = Member::<Step>::group(
    "fields",
    (GroupShape::Numbered, || names_of(FIELD)),
    |step, group, name| {
        let mut fields = step.fields.iter().enumerate();
        fields.try_for_each(|(k, f)| group.group(&format!("{name}/{k:04}")).put(FIELD, f))
    },
    |step, group, name, _| {
        let none = || FieldData::new("", &[]);
        step.fields = numbered(group, name, |group| group.taken(FIELD, none()));
    },
);

/// Components, coefficients, and what has an entry for each block.
const FIELD: &[Member<FieldData>] = members!(FieldData:
    attribute("name", name), attribute("unit", unit), any_vector(components),
    any_vector(exact).optional_to_read(), any_vector(patch_blocks), vector(block_function),
    vector(block_degree), custom(BLOCK_SPACE), vector(block_offset), custom(COEFFICIENTS),
);

/// Written where a block has a tensor product, and read as if it were missing where none has.
const BLOCK_SPACE: Member<FieldData> = Member {
    is_used: |data| data.block_space.contains(&PolynomialSpace::Tensor),
    take: |data, group, name, n| {
        let spaces: Vec<_> = group.rows(name, n);
        let is_used = spaces.contains(&PolynomialSpace::Tensor);
        data.block_space = if is_used { spaces } else { Vec::new() };
    },
    ..vector!(FieldData, block_space).optional()
};

const COEFFICIENTS: Member<FieldData> = Member::<FieldData>::array(
    "coefficients",
    |data, group, name| group.put_matrix(name, data.coefficients.iter()),
    |data, group, name, _| {
        data.coefficients = group.matrix(name, group.rows_of(["components", name]));
    },
);

const ATTRIBUTES: Member<Step> = Member::<Step>::group(
    "attributes",
    (GroupShape::Table, || names_of(ATTRIBUTE)),
    |step, group, name| {
        let mut group = group.group(name);
        group.put(ATTRIBUTE, &step.attributes)?;
        if step.attributes.is_empty() {
            group.array("values", Array::matrix(&[[]; 0], step.partition.len()));
        }
        Ok(())
    },
    |step, group, name, _| step.attributes = group.group(name).table(ATTRIBUTE),
)
.optional_to_read();

const ATTRIBUTE: &TableMembers<Attribute> =
    members!(Attribute: cell("name", name), matrix("values", values));

const INTENSITIES: &TableMembers<TipIntensity> = members!(TipIntensity:
    cell("crack", tip.crack), cell("end", tip.end), cell("k1", k1), cell("k2", k2),
    list("rings", "ring_offsets", rings), cell("t_stress", t_stress).optional(),
    cell("j", j).optional(), cell("error", error).optional(),
);

const HISTORY: &TableMembers<Record> =
    members!(Record: cell("name", name), cell("value", value), cell("unit", unit));

const WARNINGS: &TableMembers<Warning> = members!(Warning:
    cell("kind", kind), cell("message", message), cell("at", at), cell("value", value),
    cell("limit", limit),
);

const REACTIONS: &TableMembers<Reaction> = members!(Reaction:
    cell("on", on), custom(HELD), matrix("force", force), cell("moment", moment));

/// Numbers that are 1 where the support holds a component.
const HELD: Member<[Reaction]> = Member {
    counts: true,
    ..Member::<[Reaction]>::array(
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
