//! Values along a crack: both sides, jumps, opening.

use anyhow::{Context as _, ensure};
use ppum::crack::{Crack, SegmentId, Side};
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;

use super::places::{Place, evaluate};
use super::table::{Column, Table};
use crate::number::count as counted;

/// A row for each of `count` points at equal distances along the crack, its ends included.
pub(super) fn table(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    index: usize,
    count: usize,
) -> anyhow::Result<Table> {
    let cracks = &field.step.cracks;
    ensure!(!cracks.is_empty(), "--crack {index}: the dataset has no cracks");
    let number = counted(cracks.len(), "crack", "cracks");
    let crack = cracks
        .get(index)
        .with_context(|| format!("--crack {index}: the dataset has {number}, numbered from 0"))?;
    let stations = stations(crack, index as u32, count);
    let components = field.data.components.iter().zip(0..);
    let components = components.map(|(name, c)| (name.clone(), Quantity::Component(c)));
    let wanted: Vec<_> = quantities.iter().cloned().chain(components).collect();
    let sides = [Side::Above, Side::Below].map(|side| {
        let places: Vec<Place> = stations.iter().map(|s| s.place(side)).collect();
        evaluate(field, &wanted, &places)
    });
    let mut rows = Vec::new();
    let width = wanted.len();
    for (k, station) in stations.iter().enumerate() {
        let [above, below] = [0, 1].map(|side| &sides[side][k * width..(k + 1) * width]);
        rows.extend(station.row(above, below, quantities.len()));
    }
    Ok(Table::new(columns(field, quantities), rows))
}

fn columns(field: &Field<'_>, quantities: &[(String, Quantity)]) -> Vec<Column> {
    let unit = field.data.unit.as_str();
    let mut columns = ["s", "x", "y"].map(|name| Column::new(name, "")).to_vec();
    for (name, quantity) in quantities {
        let sided = |side: &str| Column::new(&format!("{name}_{side}"), quantity.unit(field));
        columns.extend(["above", "below"].map(sided));
    }
    let components = &field.data.components;
    columns.extend(components.iter().map(|name| Column::new(&format!("jump_{name}"), unit)));
    if components.len() == 2 {
        columns.extend(["opening", "sliding"].map(|name| Column::new(name, unit)));
    }
    columns
}

/// A point of a crack.
struct Station {
    /// Arc length from the crack's start.
    s: f64,
    /// The nearer end of its segment, and the way from there.
    anchor: Vec2,
    offset: Vec2,
    segment: SegmentId,
    /// Unit direction of the segment.
    tangent: Vec2,
}

fn stations(crack: &Crack, index: u32, count: usize) -> Vec<Station> {
    let mut starts = vec![0.0];
    for p in crack.points.windows(2) {
        starts.push(starts[starts.len() - 1] + (p[1] - p[0]).length());
    }
    let (last, total) = (crack.points.len() - 2, starts[starts.len() - 1]);
    let station = |k: usize| {
        let s = if k + 1 == count { total } else { total * (k as f64 / (count - 1) as f64) };
        let segment = starts.partition_point(|&start| start <= s).saturating_sub(1).min(last);
        let [a, b] = [crack.points[segment], crack.points[segment + 1]];
        let (tangent, inner) = ((b - a).unit(), s - starts[segment]);
        let beyond = starts[segment + 1] - s;
        let (anchor, way) = if inner <= beyond { (a, inner) } else { (b, -beyond) };
        let segment = SegmentId { crack: index, segment: segment as u32 };
        Station { s, anchor, offset: tangent * way, segment, tangent }
    };
    (0..count).map(station).collect()
}

impl Station {
    fn place(&self, side: Side) -> Place {
        let mark = if side == Side::Above { 1.0 } else { -1.0 };
        let (anchor, offset) = (self.anchor, self.offset);
        Place { point: anchor + offset, anchor, offset, on: Some(self.segment), side, mark }
    }

    /// Position, the quantities on both sides, the jumps of the components that follow them; normal to the
    /// crack and along it.
    fn row(&self, above: &[f64], below: &[f64], quantities: usize) -> Vec<f64> {
        let p = self.anchor + self.offset;
        let mut row = vec![self.s, p.x, p.y];
        row.extend(above.iter().zip(below).take(quantities).flat_map(|(a, b)| [a, b]));
        let jumps: Vec<f64> =
            above.iter().zip(below).skip(quantities).map(|(a, b)| a - b).collect();
        row.extend(&jumps);
        if let [x, y] = jumps[..] {
            let jump = Vec2::from([x, y]);
            row.extend([jump.dot(self.tangent.left()), jump.dot(self.tangent)]);
        }
        row
    }
}
