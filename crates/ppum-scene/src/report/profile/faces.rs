//! Values along a crack: both sides, jumps, opening.

use ppum::crack::Side;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::sample::{SamplePoint, SamplePoints};
use ppum::vec2::Vec2;

use super::{Profile, ProfileError, evaluate};
use crate::report::table::{Column, NumberTable};

/// One row for each of the points at parts of the crack's length.
pub(super) fn table(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    index: usize,
    parts: &[f64],
    watcher: &dyn Watcher,
) -> Result<Profile, ProfileError> {
    let cracks = &field.step.cracks;
    let stations = u32::try_from(index).ok().and_then(|k| SamplePoints::along(cracks, k, parts));
    let stations = stations.ok_or(ProfileError::Crack { index, count: cracks.len() })?;
    // opening and sliding have columns of their own
    let is_asked =
        |quantity: &Quantity| !matches!(quantity, Quantity::Face(face) if face.is_jump());
    let quantities: Vec<_> = quantities.iter().filter(|(_, q)| is_asked(q)).cloned().collect();
    let components = (0..).map(Quantity::Component).take(field.data.components.len());
    let asked = quantities.iter().map(|(_, quantity)| quantity.clone());
    let wanted: Vec<_> = asked.chain(components).collect();
    let values = evaluate(field, &wanted, &stations.places(), watcher)?;
    let (above, below) = values.split_at(values.len() / 2);
    // the body is on the left of a crack on an edge
    let nothing = vec![f64::NAN; below.len()];
    let below = if is_on_edge(field, index) { &nothing } else { below };
    let sides = above.chunks(wanted.len()).zip(below.chunks(wanted.len()));
    let rows = stations
        .all()
        .iter()
        .zip(sides)
        .flat_map(|(station, sides)| row((field, station), sides, &quantities))
        .collect();
    let places = stations.all().iter().map(|station| station.place(Side::Above)).collect();
    let table = NumberTable::new(columns(field, &quantities), rows);
    Ok(Profile { table, places, undefined: Vec::new() })
}

/// True of a crack on an edge of the box, of which one face is in the body.
fn is_on_edge(field: &Field<'_>, crack: usize) -> bool {
    let (bounds, crack) = (&field.domain.bounds, &field.step.cracks[crack]);
    let is_along = |line: &dyn Fn(&Vec2) -> bool| crack.points.iter().all(line);
    !crack.is_curved()
        && (is_along(&|p| p.x == bounds.min.x)
            || is_along(&|p| p.x == bounds.max.x)
            || is_along(&|p| p.y == bounds.min.y)
            || is_along(&|p| p.y == bounds.max.y))
}

fn columns(field: &Field<'_>, quantities: &[(String, Quantity)]) -> Vec<Column> {
    let unit = field.data.unit.as_str();
    let mut columns = ["s", "x", "y"].map(|name| Column::new(name, "")).to_vec();
    for (name, quantity) in quantities {
        let sided =
            |side: Side| Column::new(&format!("{name}_{}", side.name()), quantity.unit(field));
        match is_sided(quantity) {
            true => columns.extend([Side::Above, Side::Below].map(sided)),
            false => columns.push(Column::new(name, quantity.unit(field))),
        }
    }
    let components = &field.data.components;
    columns.extend(components.iter().map(|name| Column::new(&format!("jump_{name}"), unit)));
    if components.len() == 2 || field.is_displacement() {
        columns.extend(["opening", "sliding"].map(|name| Column::new(name, unit)));
    }
    columns
}

/// True if each face has a value of its own.
fn is_sided(quantity: &Quantity) -> bool {
    !matches!(quantity, Quantity::Face(face) if !face.is_sided())
}

/// Position, the quantities on both sides, the jumps of the components that follow them; normal to
/// the crack and along it.
fn row(
    (field, station): (&Field<'_>, &SamplePoint),
    (above, below): (&[f64], &[f64]),
    quantities: &[(String, Quantity)],
) -> Vec<f64> {
    let p = station.point();
    let pairs = || above.iter().zip(below);
    let jumps: Vec<f64> = pairs().skip(quantities.len()).map(|(a, b)| a - b).collect();
    let mut row = vec![station.s, p.x, p.y];
    for ((_, quantity), (a, b)) in quantities.iter().zip(pairs()) {
        row.extend([a, b].into_iter().take(if is_sided(quantity) { 2 } else { 1 }));
    }
    row.extend(&jumps);
    if let ([x, y], _) | ([x, y, _], true) = (&jumps[..], field.is_displacement()) {
        let (x, y) = (*x, *y);
        row.extend(station.opening(Vec2::from([x, y])));
    }
    row
}
