//! Meshes.

use ppum::mesh::{Clip, Mesh, Shape};
use ppum::polynomial::PolynomialSpace;

use super::group::GroupReader;
use crate::content::ObjectKind;
use crate::names::{Codes, SHAPES, SIDES, SPACES};

/// The arrays with a row for each patch.
const COLUMNS: [&str; 6] = ["shape", "origin", "map_degree", "map_space", "map_offset", "element"];

/// The optional arrays of clips.
const CLIPS: [&str; 3] = ["clip_offsets", "clip_field", "clip_side"];

pub(super) fn mesh(group: &GroupReader) -> Mesh {
    let n = group.rows_of(&COLUMNS);
    let mut rows = group.matrix("map", 2).into_iter();
    let mut row = || rows.next().unwrap_or_default();
    let has_clips = CLIPS.iter().any(|name| group.holds(name, ObjectKind::Dataset));
    let clips = if has_clips { clips(group) } else { Vec::new() };
    Mesh {
        shape: codes(group, "shape", SHAPES, n, Shape::Triangle),
        origin: group.point_rows("origin", n),
        map_degree: group.column("map_degree", n),
        map_space: spaces(group, "map_space", n),
        map_offset: group.column("map_offset", n),
        map: [row(), row()],
        element: group.column("element", n),
        clip_offsets: if has_clips { group.column("clip_offsets", n + 1) } else { Vec::new() },
        clips,
    }
}

fn clips(group: &GroupReader) -> Vec<Clip> {
    let n = group.rows_of(&CLIPS[1..]);
    let fields = group.column::<u32>("clip_field", n);
    let sides = codes(group, "clip_side", SIDES, n, true);
    let all = fields.into_iter().zip(sides);
    all.map(|(field, is_above)| Clip { field, is_above }).collect()
}

/// The monomials of maps or of blocks.
pub(super) fn spaces(group: &GroupReader, name: &str, rows: usize) -> Vec<PolynomialSpace> {
    codes(group, name, SPACES, rows, PolynomialSpace::Total)
}

/// A column of codes.
fn codes<T: Copy>(
    group: &GroupReader,
    name: &str,
    codes: &Codes<T>,
    rows: usize,
    default: T,
) -> Vec<T> {
    let column = group.column::<u8>(name, rows);
    let known = |(k, code): (usize, u8)| match codes.get(usize::from(code)) {
        Some((value, _)) => *value,
        None => {
            let all = codes.iter().enumerate().map(|(k, (_, word))| format!("{k} ({word})"));
            let all = all.collect::<Vec<_>>().join(", ");
            group.error(name, format!("entry {k} is {code}, expected one of: {all}"));
            default
        }
    };
    column.into_iter().enumerate().map(known).collect()
}
