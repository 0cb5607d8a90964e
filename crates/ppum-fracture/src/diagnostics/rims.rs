//! The warning about cells that are too large for the stress at the rim of a hole.

use super::{percent, short, smaller_cells};
use ppum::dataset::{Warning, WarningKind};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::text::LocationText;
use ppum::vec2::Rect;
use ppum_problem::Problem;
use ppum_problem::geometry::{BoxList, wider};
use ppum_solve::refine::{coarsest, rim_error};

/// Estimated error of the stress at a rim, relative to the largest one, from which on it is told:
/// cells that are chosen by the program aim at less than half of it.
const LARGE: f64 = 0.02;

/// A hole and the cell that is the worst of those on its rim.
struct CoarseRim {
    hole: usize,
    cell: u32,
    /// Size of the cell in radii of curvature.
    part: f64,
    error: f64,
}

/// The warning about the worst hole, and how many are nearly as bad.
pub(super) fn of_rims(
    field: &Field<'_>,
    problem: Option<&Problem>,
    places: &LocationText,
) -> Option<Warning> {
    let holes = &field.domain.holes;
    if holes.is_empty() {
        return None;
    }
    let (partition, data) = (field.step.partition.boxes(), &field.step.fields[0]);
    let cells =
        BoxList::new((0..).zip(&partition.cell).map(|(number, cell)| (*cell, (number, *cell))));
    let order = |cell: u32| {
        let degrees = data.blocks(cell as usize).map(|block| data.block_degree[block]);
        degrees.max().map_or(0, usize::from)
    };
    let of_hole = |(hole, shape): (usize, &Hole)| {
        let near: Vec<(u32, Rect)> =
            cells.near(&wider(&shape.rim_bounds(), 0.0)).copied().collect();
        let (part, cell) = coarsest(shape, &near)?;
        Some(CoarseRim { hole, cell, part, error: rim_error(part, order(cell)) })
    };
    let all: Vec<_> = holes.iter().enumerate().filter_map(of_hole).collect();
    let count = all.iter().filter(|coarse| coarse.error > LARGE).count();
    let by_error =
        |a: &CoarseRim, b: &CoarseRim| a.error.total_cmp(&b.error).then(a.part.total_cmp(&b.part));
    let worst = all.into_iter().filter(|coarse| coarse.error > LARGE).max_by(by_error)?;
    let at = partition.cell[worst.cell as usize].center();
    let place = places.show(at);
    let message = message(&worst, &holes[worst.hole], problem, (count, &place));
    Some(Warning::new(WarningKind::CoarseHole, Some(at), [worst.error, LARGE], message))
}

fn message(
    worst: &CoarseRim,
    shape: &Hole,
    problem: Option<&Problem>,
    (count, at): (usize, &str),
) -> String {
    let CoarseRim { hole, part, error, .. } = worst;
    let (place, keys) = match shape.is_outside() {
        true => ("the outline".to_owned(), "`center` and `radius`".to_owned()),
        false => (format!("the rim of hole {hole}, counted from 0"), format!("`hole = {hole}`")),
    };
    let others = match count {
        1 => String::new(),
        2 => ", and of one other hole".into(),
        n => format!(", and of {} other holes", n - 1),
    };
    format!(
        "the cells at {place}{others}, are too large for the stress there: the worst, \
         around {at}, is {} of the radius of curvature long, and stresses are off by up to about {} % of the \
         largest; {}, or a higher `order`",
        short((1e3 * part).round() / 1e3),
        percent(*error),
        smaller_cells(problem, &keys)
    )
}
