//! Fields: components, blocks and their coefficients.

use super::{Checked, check_all, check_length, check_names, check_numbers, fail, require};
use crate::dataset::{Equation, FieldData, MAX_DEGREE, Step, monomials};

/// Most components of a field: each pixel of a picture holds all of them with their derivatives.
const MAX_COMPONENTS: usize = 64;

pub(super) fn check_field(field: &FieldData, step: &Step, equation: &Equation) -> Checked {
    let components = field.components.len();
    require(components > 0, "components", || "a field needs at least one".into())?;
    require(components <= MAX_COMPONENTS, "components", || {
        format!("there are {components} components, but at most {MAX_COMPONENTS} may be")
    })?;
    check_names("components", field.components.iter())?;
    if field.name == "displacement" || field.name == "potential" {
        check_length("components", components, equation.components(), "those of the equation")?;
    }
    if !field.exact.is_empty() {
        check_length("exact", field.exact.len(), components, "one per component, or none")?;
    }
    check_rows(field, step.partition.len())?;
    check_coefficients(field)?;
    check_blocks(field, step.functions.len())
}

/// Compressed rows: start at zero, never fall, end at the number of blocks.
fn check_rows(field: &FieldData, patches: usize) -> Checked {
    let rows = &field.patch_blocks;
    check_length("patch_blocks", rows.len(), patches + 1, "one more than patches")?;
    require(rows[0] == 0, "patch_blocks[0]", || format!("is {}, expected 0", rows[0]))?;
    if let Some(k) = rows.windows(2).position(|w| w[0] > w[1]) {
        return fail(
            &format!("patch_blocks[{}]", k + 1),
            format!("{} falls below {}; offsets must not fall", rows[k + 1], rows[k]),
        );
    }
    let blocks = field.block_function.len();
    require(rows[patches] as usize == blocks, &format!("patch_blocks[{patches}]"), || {
        format!("is {}, but there are {blocks} blocks", rows[patches])
    })?;
    check_length("block_degree", field.block_degree.len(), blocks, "one per block")?;
    check_length("block_offset", field.block_offset.len(), blocks, "one per block")
}

fn check_coefficients(field: &FieldData) -> Checked {
    check_length("coefficients", field.coefficients.len(), field.components.len(), "components")?;
    let count = field.coefficients[0].len();
    for (k, values) in field.coefficients.iter().enumerate() {
        let place = format!("coefficients[{k}]");
        check_length(&place, values.len(), count, "as in component 0")?;
        check_numbers(&place, values)?;
    }
    Ok(())
}

fn check_blocks(field: &FieldData, functions: usize) -> Checked {
    let count = field.coefficients[0].len() as u64;
    check_all(
        "block_function",
        &field.block_function,
        |&f| (f as usize) < functions,
        |f| format!("index {f}, but there are {functions} functions"),
    )?;
    check_all(
        "block_degree",
        &field.block_degree,
        |&d| d as usize <= MAX_DEGREE,
        |d| format!("degree {d} is above {MAX_DEGREE}"),
    )?;
    for (b, (&offset, &degree)) in field.block_offset.iter().zip(&field.block_degree).enumerate() {
        let needed = monomials(degree as usize) as u64;
        let fits = offset.checked_add(needed).is_some_and(|end| end <= count);
        require(fits, &format!("block_offset[{b}]"), || {
            format!("coefficients {offset} + {needed} reach beyond the {count} stored")
        })?;
    }
    // blocks that shared theirs could ask for far more than a file holds
    let sizes = field.block_degree.iter().map(|&degree| monomials(degree.into()) as u64);
    let all: u64 = sizes.sum();
    require(all <= count, "block_offset", || {
        format!(
            "the blocks take {all} coefficients, but {count} are stored; give each block its own"
        )
    })
}
