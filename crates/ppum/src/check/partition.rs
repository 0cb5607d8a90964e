//! The patches of a partition.

use super::errors::{
    CheckResult, Errors, check_all, check_each, check_extents, check_length, check_points, is_box,
    no_box, require,
};
use super::mesh::check_mesh;
use crate::dataset::{BoxPartition, Partition};

/// Most patches: their boundaries are counted in 32 bits.
const MOST_PATCHES: usize = 1 << 30;

pub(super) fn check_partition(partition: &Partition, errors: &mut Errors) {
    match partition {
        Partition::Boxes(boxes) => check_boxes(boxes, errors),
        Partition::Mesh(mesh) => {
            errors.add(check_count("shape", mesh.len()));
            check_mesh(mesh, errors);
        }
    }
}

fn check_boxes(partition: &BoxPartition, errors: &mut Errors) {
    let n = partition.len();
    errors.add(check_count("center", n));
    let mut is_fine = true;
    let cells = [("cell", partition.cell.len()), ("level", partition.level.len())];
    let cells = cells.into_iter().filter(|_| partition.has_cells() || !partition.level.is_empty());
    for (name, length) in cells.chain([
        ("half", partition.half.len()),
        ("origin", partition.origin.len()),
        ("scale", partition.scale.len()),
        ("point", partition.point.len()),
    ]) {
        is_fine &= errors.add(check_length(name, length, n, "one per patch"));
    }
    is_fine &= errors.add(check_points("center", &partition.center));
    is_fine &= errors.add(check_extents("half", &partition.half));
    errors.add(check_points("origin", &partition.origin));
    errors.add(check_extents("scale", &partition.scale));
    errors.add(check_points("points", &partition.points));
    is_fine &= errors.add(check_all("cell", &partition.cell, is_box, no_box));
    if is_fine && partition.has_cells() {
        let meets = |patch: usize| partition.support(patch).overlaps(&partition.cell[patch]);
        errors.add(check_each("center", n, meets, |_| "puts the support beside its cell".into()));
    }
    let points = partition.points.len();
    errors.add(check_all(
        "point",
        &partition.point,
        |p| p.is_none_or(|p| (p as usize) < points),
        |p| format!("index {}, but there are {points} points", p.unwrap_or_default()),
    ));
}

fn check_count(place: &str, patches: usize) -> CheckResult {
    require(patches > 0, place, || "there is no patch".into())?;
    require(patches <= MOST_PATCHES, place, || format!("{patches} patches are too many"))
}
