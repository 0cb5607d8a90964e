//! The rules, and files that break them.

use super::edit::{edit, put, remove, rename, set, text, texts};
use super::{FULL, PLAIN};
use crate::content::{Array, ArrayValues, ElementType, ObjectTree};

/// A rule in words, the file that is damaged, the damage, and parts of what the reader says.
pub(super) type BrokenRule = (&'static str, u64, fn(&mut ObjectTree), &'static [&'static str]);

pub(super) const RULES: &[BrokenRule] = &[
    // conventions
    (
        "texts of the root are scalars",
        FULL,
        |c| put(c, "@title", texts(&["a", "b"])),
        &["@title", "expected []"],
    ),
    (
        "the format's name is a scalar too",
        FULL,
        |c| put(c, "@format", texts(&["pp", "um"])),
        &["`format` is not \"ppum\""],
    ),
    (
        "types are those of the page",
        FULL,
        |c| put(c, "steps/0000/partition/level", Array::vector([0u32; 3])),
        &["partition/level", "type u32", "expected u8"],
    ),
    (
        "the version has two numbers",
        FULL,
        |c| put(c, "@format_version", Array::vector([1u32])),
        &["@format_version"],
    ),
    (
        "numbered groups begin with 0000",
        PLAIN,
        |c| rename(c, "steps/0000", "steps/0007"),
        &["steps/0000", "without gaps"],
    ),
    (
        "numbered groups have no gaps",
        FULL,
        |c| rename(c, "steps/0000/fields/0001", "steps/0000/fields/0002"),
        &["steps/0000/fields/0001", "without gaps"],
    ),
    (
        "numbers of groups have four digits",
        FULL,
        |c| rename(c, "tables/0002", "tables/2"),
        &["tables/0002", "four digits"],
    ),
    (
        "numbers of groups have no more digits than they need",
        FULL,
        |c| rename(c, "tables/0001", "tables/00001"),
        &["tables/0001", "four digits"],
    ),
    (
        "what is numbered is a group",
        FULL,
        |c| put(c, "steps/0000/fields/0002", Array::vector([1.0])),
        &["steps/0000/fields/0002", "is a dataset, but must be a group"],
    ),
    // domain
    (
        "holes are of another kind of domain",
        FULL,
        |c| put(c, "domain@kind", text("box")),
        &["domain/holes", "does not belong to `box`"],
    ),
    (
        "a domain with holes has them",
        FULL,
        |c| remove(c, "domain/holes"),
        &["domain/holes", "is missing"],
    ),
    (
        "polygons have no radius",
        FULL,
        |c| set(c, "domain/holes/radius", 1, f64::NAN),
        &["domain/holes/radius", "must be 0"],
    ),
    (
        "circles have one",
        FULL,
        |c| set(c, "domain/holes/radius", 0, -0.1),
        &["domain/holes/radius[0]", "not positive"],
    ),
    (
        "corners that follow each other differ",
        FULL,
        |c| edit(c, "domain/holes/points", |v: &mut Vec<f64>| v.copy_within(2..4, 4)),
        &["domain/holes/points[1]", "equal"],
    ),
    (
        "the box has a size",
        FULL,
        |c| edit(c, "domain@min", |v: &mut Vec<f64>| v[1] = 50.0),
        &["domain: ", "is not a box"],
    ),
    // equation
    (
        "constants belong to their equation",
        FULL,
        |c| put(c, "equation@conductivity", Array::scalar(1.0)),
        &["equation@conductivity", "does not belong to `eigenstrain`"],
    ),
    (
        "and so does the state",
        PLAIN,
        |c| put(c, "equation@state", text("plane-stress")),
        &["equation@state", "does not belong to `poisson`"],
    ),
    // quantities
    (
        "names of quantities are letters, digits, _ and -",
        FULL,
        |c| set(c, "quantities/name", 0, "a b".to_owned()),
        &["quantities `a b`", "names are letters"],
    ),
    // partition
    (
        "breakpoints of a formula increase",
        FULL,
        |c| put(c, "steps/0000/partition/weight_breakpoints", Array::vector([0.5, 0.25])),
        &["partition/weight_breakpoints", "must increase"],
    ),
    (
        "breakpoints of a formula differ",
        FULL,
        |c| put(c, "steps/0000/partition/weight_breakpoints", Array::vector([0.5, 0.5])),
        &["partition/weight_breakpoints", "must increase"],
    ),
    (
        "splines have their own breakpoints",
        PLAIN,
        |c| put(c, "steps/0000/partition/weight_breakpoints", Array::vector([0.1])),
        &["partition/weight_breakpoints", "but those of `"],
    ),
    (
        "splines have no formula",
        PLAIN,
        |c| put(c, "steps/0000/partition@weight_formula", text("1 - t")),
        &["partition@weight_formula", "does not belong to `"],
    ),
    (
        "a point is an index or -1",
        FULL,
        |c| set(c, "steps/0000/partition/point", 0, -2_i64),
        &["partition/point", "neither an index nor -1"],
    ),
    (
        "cells leave no gaps",
        PLAIN,
        |c| edit(c, "steps/0000/partition/cell", |v: &mut Vec<f64>| v[2] = 0.5 * (v[0] + v[2])),
        &["steps/0000/partition/cell", "none covers"],
    ),
    (
        "cells do not overlap",
        PLAIN,
        |c| edit(c, "steps/0000/partition/cell", |v: &mut Vec<f64>| v.copy_within(4..8, 0)),
        &["steps/0000/partition/cell[", "overlaps another cell"],
    ),
    (
        "cells lie in the box",
        PLAIN,
        |c| edit(c, "steps/0000/partition/cell", |v: &mut Vec<f64>| v[0] -= 1.0),
        &["steps/0000/partition/cell[0]", "out of the domain's box"],
    ),
    (
        "cells are wider than rounding",
        PLAIN,
        |c| edit(c, "steps/0000/partition/cell", |v: &mut Vec<f64>| v[2] = v[0] + 1e-14),
        &["steps/0000/partition/cell[0]", "thinner than the rounding"],
    ),
    (
        "a support holds some of its cell",
        PLAIN,
        |c| edit(c, "steps/0000/partition/center", |v: &mut Vec<f64>| v[0] += 9.0),
        &["steps/0000/partition/center[0]", "beside its cell"],
    ),
    (
        "supports cover the cells",
        PLAIN,
        |c| {
            edit(c, "steps/0000/partition/half", |v: &mut Vec<f64>| {
                v.iter_mut().for_each(|h| *h *= 0.5)
            })
        },
        &["steps/0000/partition/half", "no support holds ("],
    ),
    (
        "supports do not just cover the cells",
        PLAIN,
        |c| {
            let cell = c["steps/0000/partition/cell"].values.clone();
            let Some(cell) = f64::of(&cell) else { panic!("numbers") };
            for (name, sign) in [("center", 1.0), ("half", -1.0)] {
                edit(c, &format!("steps/0000/partition/{name}"), |v: &mut Vec<f64>| {
                    for (v, cell) in
                        v.as_chunks_mut::<2>().0.iter_mut().zip(cell.as_chunks::<4>().0)
                    {
                        for k in 0..2 {
                            v[k] = 0.5
                                * (cell[k + 2] + sign * cell[k])
                                * if sign < 0.0 { 1.005 } else { 1.0 };
                        }
                    }
                });
            }
        },
        &["steps/0000/partition/half", "thin strip"],
    ),
    (
        "blocks do not share coefficients",
        PLAIN,
        |c| set(c, "steps/0000/fields/0000/block_offset", 1, 0_u64),
        &["steps/0000/fields/0000/block_offset[1]", "shares coefficients with block 0"],
    ),
    // cracks
    (
        "a crack has two points or more",
        PLAIN,
        |c| edit(c, "steps/0000/cracks/offsets", |v: &mut Vec<u64>| v[1] = 1),
        &["steps/0000/cracks[0]", "two or more"],
    ),
    (
        "points of a crack that follow each other differ",
        PLAIN,
        |c| edit(c, "steps/0000/cracks/points", |v: &mut Vec<f64>| v.copy_within(0..2, 2)),
        &["steps/0000/cracks/points[0]", "equal"],
    ),
    // functions: what a kind does not use
    (
        "only sides and tip frames have a crack",
        FULL,
        |c| set_function(c, "formula", "world", "crack", 0_i64),
        &["functions/crack", "does not use it: expected -1"],
    ),
    (
        "only formulas have a text",
        FULL,
        |c| set_function(c, "side", "", "formula", "x".to_owned()),
        &["functions/formula", "of the kind `side` does not use it"],
    ),
    (
        "only formulas have a role",
        FULL,
        |c| set_function(c, "side", "", "role", "user".to_owned()),
        &["functions/role", "does not use it: expected an empty text"],
    ),
    (
        "only formulas have a frame",
        FULL,
        |c| set_function(c, "one", "", "frame", "world".to_owned()),
        &["functions/frame:", "of the kind `one` does not use it"],
    ),
    (
        "only tip frames have an end",
        FULL,
        |c| set_function(c, "formula", "world", "frame_end", "last".to_owned()),
        &["functions/frame_end", "does not use it"],
    ),
    (
        "only fixed frames have an angle",
        FULL,
        |c| set_function(c, "formula", "tip", "frame_angle", f64::NAN),
        &["functions/frame_angle", "does not use it: expected 0"],
    ),
    (
        "only fixed frames have an origin",
        FULL,
        |c| {
            let k = function(c, "formula", "world");
            set(c, "steps/0000/functions/frame_origin", 2 * k + 1, f64::NAN);
        },
        &["functions/frame_origin", "does not use it: expected 0, 0"],
    ),
    (
        "only formulas have parameters",
        FULL,
        |c| give_to_the_first(c, "steps/0000/functions/parameter_offsets"),
        &["functions/parameter_offsets", "expected no parameters"],
    ),
    (
        "only formulas have kinks",
        FULL,
        |c| give_to_the_first(c, "steps/0000/functions/kink_offsets"),
        &["functions/kink_offsets", "expected no kinks"],
    ),
    (
        "only formulas have singular points",
        FULL,
        |c| give_to_the_first(c, "steps/0000/functions/singular_offsets"),
        &["functions/singular_offsets", "expected no singular points"],
    ),
    (
        "only components have cuts",
        FULL,
        |c| give_to_the_first(c, "steps/0000/functions/cut_offsets"),
        &["functions/cut_offsets", "of the kind `one` does not use it: expected no cuts"],
    ),
    (
        "components have cuts",
        FULL,
        |c| {
            let k = function(c, "component", "");
            edit(c, "steps/0000/functions/cut_offsets", |v: &mut Vec<u64>| v[k + 1] = v[k]);
        },
        &["functions/cuts[", "a component needs at least one"],
    ),
    (
        "cuts come with their offsets",
        FULL,
        |c| remove(c, "steps/0000/functions/cut_offsets"),
        &["functions/cut_offsets", "is missing"],
    ),
    (
        "offsets of cuts come with cuts",
        FULL,
        |c| remove(c, "steps/0000/functions/cuts"),
        &["functions/cuts", "is missing"],
    ),
    (
        "a component has cuts at all",
        FULL,
        |c| {
            remove(c, "steps/0000/functions/cuts");
            remove(c, "steps/0000/functions/cut_offsets");
        },
        &["functions/cuts[", "a component needs at least one"],
    ),
    (
        "cuts are of segments that there are",
        FULL,
        |c| set(c, "steps/0000/functions/cuts", 1, 9_i64),
        &["functions/cuts[0][1]", "segments"],
    ),
    (
        "and of cracks that there are",
        FULL,
        |c| set(c, "steps/0000/functions/cuts", 0, 99_i64),
        &["functions/cuts[0][0]", "cracks"],
    ),
    (
        "what follows stands behind",
        FULL,
        |c| set(c, "steps/0000/functions/cuts", 2, 0_i64),
        &["functions/cuts[0][2]", "must stand behind it"],
    ),
    (
        "what follows is there",
        FULL,
        |c| set(c, "steps/0000/functions/cuts", 3, 1_000_i64),
        &["functions/cuts[0][3]", "cuts"],
    ),
    (
        "a cut has four numbers",
        FULL,
        |c| put(c, "steps/0000/functions/cuts", Array::vector([0_i64; 4])),
        &["functions/cuts", "expected"],
    ),
    (
        "parameters have different names",
        FULL,
        |c| {
            edit(c, "steps/0000/functions/parameter_name", |v: &mut Vec<String>| v.fill("a".into()))
        },
        &["functions/parameter_name[", "already has a meaning"],
    ),
    // fields
    (
        "fields have different names",
        FULL,
        |c| put(c, "steps/0000/fields/0001@name", text("displacement")),
        &["steps/0000/fields", "occurs twice"],
    ),
    (
        "components have different names",
        FULL,
        |c| put(c, "steps/0000/fields/0001/components", texts(&["a", "a"])),
        &["steps/0000/fields/0001/components", "occurs twice"],
    ),
    (
        "degrees are at most 8",
        FULL,
        |c| set(c, "steps/0000/fields/0000/block_degree", 0, 9_u8),
        &["block_degree[0]", "above 8"],
    ),
    (
        "blocks are of functions of the table",
        FULL,
        |c| set(c, "steps/0000/fields/0000/block_function", 0, 4000_u32),
        &["block_function[0]", "functions"],
    ),
    (
        "coefficients of a block are there",
        FULL,
        |c| set(c, "steps/0000/fields/0000/block_offset", 0, u64::MAX),
        &["block_offset[0]", "reach beyond"],
    ),
    (
        "offsets of blocks do not fall",
        FULL,
        |c| set(c, "steps/0000/fields/0000/patch_blocks", 1, 90_000_u32),
        &["patch_blocks[2]", "must not fall"],
    ),
    (
        "exact solutions have all components or none",
        FULL,
        |c| put(c, "steps/0000/fields/0000/exact", texts(&["x"])),
        &["fields/0000/exact", "one per component, or none"],
    ),
    // results
    (
        "attributes have different names",
        FULL,
        |c| put(c, "steps/0000/attributes/name", texts(&["a", "a"])),
        &["steps/0000/attributes", "occurs twice"],
    ),
    (
        "a tip has one entry of intensities",
        FULL,
        |c| {
            edit(c, "steps/0000/intensities/crack", |v: &mut Vec<u32>| v[1] = v[0]);
            edit(c, "steps/0000/intensities/end", |v: &mut Vec<String>| v[1] = v[0].clone());
        },
        &["steps/0000/intensities[1]", "same tip as intensities[0]"],
    ),
    (
        "intensities are of tips",
        FULL,
        |c| {
            set(c, "steps/0000/intensities/crack", 0, 1_u32);
            set(c, "steps/0000/intensities/end", 0, "last".to_owned());
        },
        &["steps/0000/intensities/end[0]", "no tip"],
    ),
    (
        "rings have an inner radius below the outer one",
        FULL,
        |c| {
            let n = c["steps/0000/intensities/crack"].shape[0] as usize;
            put(
                c,
                "steps/0000/intensities/rings",
                Array { shape: vec![1, 4], values: ArrayValues::F64(vec![0.2, 0.1, 0.0, 0.0]) },
            );
            let offsets = std::iter::once(0).chain(std::iter::repeat_n(1, n));
            put(
                c,
                "steps/0000/intensities/ring_offsets",
                Array::vector(offsets.collect::<Vec<u64>>()),
            );
        },
        &["steps/0000/intensities/rings[0]", "r1 < r2"],
    ),
    (
        "what is known of a tip is finite",
        FULL,
        |c| set(c, "steps/0000/intensities/t_stress", 0, f64::INFINITY),
        &["steps/0000/intensities/t_stress[0]"],
    ),
    (
        "an error is not negative",
        FULL,
        |c| set(c, "steps/0000/intensities/error", 0, -1.0),
        &["steps/0000/intensities/error[0]"],
    ),
    (
        "a place has two coordinates or none",
        FULL,
        |c| set(c, "steps/0000/warnings/at", 0, 0.5),
        &["steps/0000/warnings/at[0]"],
    ),
    (
        "warnings are of a kind",
        FULL,
        |c| set(c, "steps/0000/warnings/kind", 0, " ".to_owned()),
        &["steps/0000/warnings/kind[0]", "empty"],
    ),
    (
        "a component is held or not",
        FULL,
        |c| set(c, "steps/0000/reactions/held", 0, 0.5),
        &["reactions/held", "expected 0 or 1"],
    ),
    (
        "where nothing is held is no force",
        FULL,
        |c| set(c, "steps/0000/reactions/force", 1, 1.0),
        &["steps/0000/reactions/force[0]", "not held"],
    ),
    (
        "a potential has no moments",
        5,
        |c| set(c, "steps/0000/reactions/moment", 0, 1.0),
        &["steps/0000/reactions/moment[0]", "expected 0"],
    ),
    // versions
    (
        "major versions begin with 1",
        FULL,
        |c| put(c, "@format_version", Array::vector([0u32, 9])),
        &["@format_version", "at least 1"],
    ),
    (
        "higher major versions are refused",
        FULL,
        |c| put(c, "@format_version", Array::vector([2u32, 0])),
        &["use a newer ppum"],
    ),
];

/// The number of the first function of a kind, in a frame if it is a formula.
fn function(content: &ObjectTree, kind: &str, frame: &str) -> usize {
    let column = |name: &str| match &content[&format!("steps/0000/functions/{name}")].values {
        ArrayValues::Text(texts) => texts.clone(),
        other => panic!("{other:?}"),
    };
    let (kinds, frames) = (column("kind"), column("frame"));
    (0..kinds.len()).find(|&k| kinds[k] == kind && frames[k] == frame).expect("there is one")
}

fn set_function<T: ElementType>(
    c: &mut ObjectTree,
    kind: &str,
    frame: &str,
    column: &str,
    value: T,
) {
    let k = function(c, kind, frame);
    set(c, &format!("steps/0000/functions/{column}"), k, value);
}

/// Makes the first entry of a list that offsets divide one of the first function, which is `one`.
fn give_to_the_first(content: &mut ObjectTree, offsets: &str) {
    edit(content, offsets, |v: &mut Vec<u64>| v[1..].iter_mut().for_each(|o| *o = (*o).max(1)));
}
