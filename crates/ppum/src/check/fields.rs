//! Fields: components, blocks and their coefficients.

use super::errors::{
    CheckResult, Errors, check_all, check_each, check_length, check_names, check_numbers,
    check_rising, fail, require,
};
use crate::dataset::{Equation, FieldData, MAX_DEGREE, Step};
use crate::polynomial::PolynomialSpace;

/// Most components of a field: each pixel of an image holds all of them with their derivatives.
pub(super) const MAX_COMPONENTS: usize = 64;

pub(super) fn check_field(
    field: &FieldData,
    step: &Step,
    equation: &Equation,
    errors: &mut Errors,
) {
    errors.add(check_components(field, equation));
    if !field.exact.is_empty() {
        let (length, components) = (field.exact.len(), field.components.len());
        errors.add(check_length("exact", length, components, "one per component, or none"));
    }
    let has_rows = errors.add(check_rows(field, step.partition.len()));
    let has_coefficients = errors.add(check_coefficients(field));
    let functions = step.functions.len();
    errors.add(check_all(
        "block_function",
        &field.block_function,
        |&f| (f as usize) < functions,
        |f| format!("index {f}, but there are {functions} functions"),
    ));
    let has_spaces = errors.add(check_spaces(field, step));
    let has_degrees = errors.add(check_all(
        "block_degree",
        &field.block_degree,
        |&d| d as usize <= MAX_DEGREE,
        |d| format!("degree {d} is above {MAX_DEGREE}"),
    ));
    if has_rows && has_coefficients && has_spaces && has_degrees {
        errors.add(check_offsets(field));
    }
}

fn check_components(field: &FieldData, equation: &Equation) -> CheckResult {
    let components = field.components.len();
    require(components > 0, "components", || "a field needs at least one".into())?;
    require(components <= MAX_COMPONENTS, "components", || {
        format!("there are {components} components, but at most {MAX_COMPONENTS} may be")
    })?;
    check_names("components", field.components.iter())?;
    let is_unknown = field.name == "displacement" || field.name == "potential";
    if is_unknown && *equation != Equation::None {
        check_length("components", components, equation.components(), "those of the equation")?;
        let names = equation.component_names();
        require(equation.expansion().is_none() || field.components == names, "components", || {
            format!("of a body with `expansion` they are {}", names.join(", "))
        })?;
    }
    Ok(())
}

fn check_rows(field: &FieldData, patches: usize) -> CheckResult {
    let blocks = field.block_function.len();
    check_rising("patch_blocks", &field.patch_blocks, (patches, "patches"), (blocks, "blocks"))?;
    check_length("block_degree", field.block_degree.len(), blocks, "one per block")?;
    check_length("block_offset", field.block_offset.len(), blocks, "one per block")
}

fn check_coefficients(field: &FieldData) -> CheckResult {
    check_length("coefficients", field.coefficients.len(), field.components.len(), "components")?;
    let Some(count) = field.coefficients.first().map(Vec::len) else { return Ok(()) };
    for (k, values) in field.coefficients.iter().enumerate() {
        let place = format!("coefficients[{k}]");
        check_length(&place, values.len(), count, "as in component 0")?;
        check_numbers(&place, values)?;
    }
    Ok(())
}

/// Tensor products belong to meshes: covers of boxes and what draws them know total degrees alone.
fn check_spaces(field: &FieldData, step: &Step) -> CheckResult {
    let (spaces, blocks) = (&field.block_space, field.block_function.len());
    if spaces.is_empty() {
        return Ok(());
    }
    check_length("block_space", spaces.len(), blocks, "one per block, or none")?;
    let is_mesh = step.partition.mesh().is_some();
    let fits = |space: &PolynomialSpace| is_mesh || *space == PolynomialSpace::Total;
    check_all("block_space", spaces, fits, |_| {
        "a tensor product on a box: write it as a block of twice the degree, with zeros".into()
    })
}

/// Each block has coefficients of its own: blocks that shared them could ask for far more than a
/// file holds.
fn check_offsets(field: &FieldData) -> CheckResult {
    let count = field.coefficients.first().map_or(0, Vec::len) as u64;
    let offsets = &field.block_offset;
    let size = |block: usize| field.block_size(block) as u64;
    let fits = |b: usize| offsets[b].checked_add(size(b)).is_some_and(|end| end <= count);
    check_each("block_offset", offsets.len(), fits, |b| {
        format!("coefficients {} + {} reach beyond the {count} stored", offsets[b], size(b))
    })?;
    let follows = |one: usize, next: usize| offsets[one] + size(one) <= offsets[next];
    if (1..offsets.len()).all(|b| follows(b - 1, b)) {
        return Ok(());
    }
    let mut order: Vec<usize> = (0..offsets.len()).collect();
    order.sort_by_key(|&b| offsets[b]);
    match order.array_windows().find(|&&[one, next]| !follows(one, next)) {
        None => Ok(()),
        Some([one, next]) => fail(
            &format!("block_offset[{next}]"),
            format!("shares coefficients with block {one}; give each block its own"),
        ),
    }
}
