//! Meshes: the arrays of their elements, their maps, and the level fields that cut them.

use super::errors::{
    CheckResult, Errors, check_all, check_each, check_index, check_length, check_numbers,
    check_points, check_rising, fail, require,
};
use crate::dataset::{FieldData, MAX_DEGREE, Partition, Step};
use crate::domain::Domain;
use crate::function::{Frame, FunctionKind};
use crate::mesh::Mesh;
use crate::vec2::Vec2;

/// Intervals of the lattice on which the determinants of maps are checked.
const SAMPLES: u8 = 4;

/// Corners may lie outside the domain's box by this part of its size, because they are rounded.
const OUTSIDE: f64 = 1e-9;

pub(super) fn check_mesh(mesh: &Mesh, errors: &mut Errors) {
    let n = mesh.len();
    let mut has_maps = true;
    for (name, length) in [
        ("origin", mesh.origin.len()),
        ("map_degree", mesh.map_degree.len()),
        ("map_space", mesh.map_space.len()),
        ("map_offset", mesh.map_offset.len()),
        ("element", mesh.element.len()),
    ] {
        has_maps &= errors.add(check_length(name, length, n, "one per patch, as `shape`"));
    }
    has_maps &= errors.add(check_points("origin", &mesh.origin));
    has_maps &= errors.add(check_all(
        "map_degree",
        &mesh.map_degree,
        |&d| (1..=MAX_DEGREE).contains(&usize::from(d)),
        |d| format!("degree {d} is not between 1 and {MAX_DEGREE}"),
    ));
    let columns = mesh.map[0].len();
    has_maps &= errors.add(check_length("map[1]", mesh.map[1].len(), columns, "as in row 0"));
    for (k, row) in mesh.map.iter().enumerate() {
        has_maps &= errors.add(check_numbers(&format!("map[{k}]"), row));
    }
    errors.add(check_clips(mesh));
    if has_maps && errors.add(check_offsets(mesh, columns)) {
        errors.add(check_maps(mesh));
    }
}

fn check_offsets(mesh: &Mesh, columns: usize) -> CheckResult {
    let size = |k: usize| mesh.map_space[k].size(mesh.map_degree[k].into()) as u64 - 1;
    let fits =
        |k: usize| mesh.map_offset[k].checked_add(size(k)).is_some_and(|end| end <= columns as u64);
    check_each("map_offset", mesh.len(), fits, |k| {
        let (start, size) = (mesh.map_offset[k], size(k));
        format!("columns {start} + {size} reach beyond the {columns} of `map`")
    })
}

/// Elements have a finite box, and maps that do not fold.
fn check_maps(mesh: &Mesh) -> CheckResult {
    let is_finite = |k: usize| {
        let bounds = mesh.bounds(k);
        bounds.min.is_finite() && bounds.max.is_finite() && bounds.size().is_finite()
    };
    check_each("map_offset", mesh.len(), is_finite, |_| "the element is not finite".into())?;
    for k in 0..mesh.len() {
        // the parts of a cut element are consecutive patches
        let is_known = k > 0
            && mesh.shape[k] == mesh.shape[k - 1]
            && mesh.map_range(k) == mesh.map_range(k - 1)
            && mesh.map_space[k] == mesh.map_space[k - 1];
        let folded = |&xi: &[f64; 2]| {
            let det = mesh.image(k, xi).1;
            det <= 0.0 || det.is_nan()
        };
        let found = if is_known { None } else { mesh.shape[k].samples(SAMPLES).find(folded) };
        if let Some([x, y]) = found {
            let det = mesh.image(k, [x, y]).1;
            let message = format!(
                "the map of patch {k} (element {}) has the determinant {det} at ({x}, {y}) of its shape, which must be \
                 positive: put the element's nodes in counter-clockwise order, or repair the element",
                mesh.element[k]
            );
            return fail(&format!("map_offset[{k}]"), message);
        }
    }
    Ok(())
}

fn check_clips(mesh: &Mesh) -> CheckResult {
    let (offsets, clips) = (&mesh.clip_offsets, mesh.clips.len());
    if offsets.is_empty() && clips == 0 {
        return Ok(());
    }
    check_rising("clip_offsets", offsets, (mesh.len(), "patches"), (clips, "clips"))
}

/// Checks that the corners of the elements lie in the domain's box, which has no holes.
pub(super) fn check_domain(mesh: &Mesh, domain: &Domain) -> CheckResult {
    require(domain.holes.is_empty(), "", || {
        "a mesh is its own domain, without holes: leave the holes out".into()
    })?;
    let size = domain.bounds.size();
    let margin = Vec2 { x: size.x * OUTSIDE, y: size.y * OUTSIDE };
    let (min, max) = (domain.bounds.min - margin, domain.bounds.max + margin);
    for k in 0..mesh.len() {
        for &corner in mesh.shape[k].corners() {
            let (p, _) = mesh.image(k, corner);
            if p.min(min) != min || p.max(max) != max {
                let message = format!(
                    "the element has a corner at ({}, {}), outside the box of the domain: enlarge the domain",
                    p.x, p.y
                );
                return fail(&format!("origin[{k}]"), message);
            }
        }
    }
    Ok(())
}

/// Checks the level fields that a step's functions and clips refer to, and that only meshes have
/// them.
pub(super) fn check_levels(step: &Step, errors: &mut Errors) {
    if let Partition::Mesh(mesh) = &step.partition {
        let wrong = (0..mesh.clips.len()).find_map(|k| {
            check_level(&format!("partition.clip_field[{k}]"), mesh.clips[k].field, step).err()
        });
        errors.add(wrong.map_or(Ok(()), Err));
    }
    errors.each("functions", &step.functions, |_, function| match &function.kind {
        FunctionKind::Level { field } => check_use("levels", *field, step),
        FunctionKind::Formula { frame: Frame::Levels(fields), .. } => {
            fields.iter().try_for_each(|&field| check_use("frame.levels", field, step))
        }
        _ => Ok(()),
    });
}

fn check_use(place: &str, field: u32, step: &Step) -> CheckResult {
    require(step.partition.mesh().is_some(), place, || {
        "level fields belong to meshes; the patches of this step are boxes".into()
    })?;
    check_level(place, field, step)
}

/// A level field is a polynomial of one component on each patch.
fn check_level(place: &str, index: u32, step: &Step) -> CheckResult {
    check_index(place, index as usize, step.fields.len(), "fields")?;
    let field: &FieldData = &step.fields[index as usize];
    let count = field.components.len();
    require(count == 1, place, || {
        format!("names the field `{}` of {count} components; a level field has one", field.name)
    })?;
    let is_one = |f: &u32| {
        let function = step.functions.get(*f as usize);
        function.is_none_or(|function| function.kind == FunctionKind::One)
    };
    let other = field.block_function.iter().position(|f| !is_one(f));
    require(other.is_none(), place, || {
        let block = other.unwrap_or_default();
        format!(
            "names the field `{}`, whose block {block} has a function; level fields are polynomials alone",
            field.name
        )
    })
}
