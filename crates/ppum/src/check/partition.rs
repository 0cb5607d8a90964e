//! The patches of a partition.

use super::{
    Checked, check_all, check_each, check_extents, check_length, check_points, is_box, require,
};
use crate::cover::OVERLAP;
use crate::dataset::Partition;
use crate::vec2::Rect;

/// Part of a cell's size that its support reaches beyond it on each side, below which strips of overlap are
/// thinner than any cover's; a hair below the bound of covers, for rounding.
const LEAST_REACH: f64 = 0.005 - 1e-9;

/// Most patches: their borders are counted in 32 bits.
const MOST_PATCHES: usize = 1 << 30;

pub(super) fn check_partition(partition: &Partition) -> Checked {
    let n = partition.len();
    require(n > 0, "center", || "there is no patch".into())?;
    require(n <= MOST_PATCHES, "center", || format!("{n} patches are too many"))?;
    for (name, length) in [
        ("half", partition.half.len()),
        ("origin", partition.origin.len()),
        ("scale", partition.scale.len()),
        ("cell", partition.cell.len()),
        ("level", partition.level.len()),
        ("point", partition.point.len()),
    ] {
        check_length(name, length, n, "one per patch")?;
    }
    check_points("center", &partition.center)?;
    check_extents("half", &partition.half)?;
    check_points("origin", &partition.origin)?;
    check_extents("scale", &partition.scale)?;
    check_points("points", &partition.points)?;
    check_all("cell", &partition.cell, is_box, |c| {
        format!("({}, {}) to ({}, {}) is not a box", c.min.x, c.min.y, c.max.x, c.max.y)
    })?;
    let reach = |patch: usize| thin_strip(&partition.support(patch), &partition.cell[patch]);
    check_each(
        "half",
        n,
        |patch| reach(patch).is_none(),
        |patch| {
            format!(
                "makes the support reach {} times the cell's size beyond it: patches overlap in strips too thin \
             for their numbers, give them {} times the cell at least",
                reach(patch).unwrap_or_default(),
                OVERLAP.start()
            )
        },
    )?;
    let meets = |patch: usize| partition.support(patch).overlaps(&partition.cell[patch]);
    check_each("center", n, meets, |_| "puts the support beside its cell".into())?;
    let points = partition.points.len();
    check_all(
        "point",
        &partition.point,
        |p| p.is_none_or(|p| (p as usize) < points),
        |p| format!("index {}, but there are {points} points", p.unwrap_or_default()),
    )
}

/// Farthest a support reaches beyond its cell, in units of the cell's size, where that is a strip too thin.
/// Rounding is no strip.
fn thin_strip(support: &Rect, cell: &Rect) -> Option<f64> {
    let along = |inner: [f64; 2], outer: [f64; 2]| {
        let rounding = 4.0 * f64::EPSILON * outer[0].abs().max(outer[1].abs());
        let reaches = [inner[0] - outer[0], outer[1] - inner[1]].into_iter();
        let strips = reaches.filter(move |reach| *reach > rounding);
        strips.map(move |reach| reach / (inner[1] - inner[0])).find(|&part| part < LEAST_REACH)
    };
    along([cell.min.x, cell.max.x], [support.min.x, support.max.x])
        .or_else(|| along([cell.min.y, cell.max.y], [support.min.y, support.max.y]))
}
