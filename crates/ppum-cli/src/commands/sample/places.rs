//! Where values are wanted, and the values there.

use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use ppum::crack::{Crack, SegmentId, Side};
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;

use super::MOST;
use crate::sides::{Segments, seen};
use crate::standard::{self, is_standard};

/// A point on a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// The point as it was meant: `anchor + offset` may round to its neighbour.
    pub(super) point: Vec2,
    pub(super) anchor: Vec2,
    pub(super) offset: Vec2,
    /// The segment that it lies on, if it lies on a crack.
    pub(super) on: Option<SegmentId>,
    pub(super) side: Side,
    /// 1 above a crack, −1 below, 0 if the point is on none.
    pub(super) mark: f64,
}

/// Points that share an anchor: near each other, and few enough to be work for one thread.
const BLOCK: usize = 256;

/// The quantities at all places, a row for each, on all cores. Each block is seen from an anchor near it.
pub(super) fn evaluate(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: &[Place],
) -> Vec<f64> {
    let quantities: Vec<Quantity> =
        quantities.iter().map(|(_, quantity)| quantity.clone()).collect();
    let seat = |place: &Place| (place.anchor, place.on, place.side);
    let alike = |a: &Place, b: &Place| seat(a) == seat(b);
    let runs: Vec<&[Place]> =
        places.chunk_by(alike).flat_map(|run| run.chunks(4 * BLOCK)).collect();
    let values = |run: &&[Place]| {
        let offsets: Vec<Vec2> = run.iter().map(|place| place.offset).collect();
        let mut local = seen(field, run[0].on, run[0].anchor);
        Quantity::at_many(&quantities, &mut local, &offsets, run[0].side)
    };
    runs.par_iter().map(values).collect::<Vec<_>>().concat()
}

/// Points with an anchor for each block, a point on a crack on both of its sides.
pub(super) fn both_sides(cracks: &[Crack], points: &[Vec2]) -> Vec<Place> {
    sided(&Segments::new(cracks), points).into_iter().flatten().collect()
}

/// One place a point, on a crack two.
fn sided(segments: &Segments<'_>, points: &[Vec2]) -> Vec<Vec<Place>> {
    let block = |points: &[Vec2]| -> Vec<Vec<Place>> {
        points.iter().map(|&point| places(segments, points[0], point)).collect()
    };
    points.chunks(BLOCK).flat_map(block).collect()
}

fn places(segments: &Segments<'_>, anchor: Vec2, point: Vec2) -> Vec<Place> {
    let on = segments.at(point, Vec2::ZERO);
    if on.is_none() {
        let offset = point - anchor;
        return vec![Place { point, anchor, offset, on, side: Side::Above, mark: 0.0 }];
    }
    let on_side = |side, mark| Place { point, anchor: point, offset: Vec2::ZERO, on, side, mark };
    vec![on_side(Side::Above, 1.0), on_side(Side::Below, -1.0)]
}

/// Points from a to b, and how far they are from a.
pub(super) fn line(cracks: &[Crack], a: Vec2, b: Vec2, count: usize) -> (Vec<f64>, Vec<Place>) {
    let points: Vec<Vec2> = (0..count).map(|k| between(a, b, k, count)).collect();
    let (mut lengths, mut all) = (Vec::new(), Vec::new());
    for (point, places) in points.iter().zip(sided(&Segments::new(cracks), &points)) {
        lengths.extend(places.iter().map(|_| (*point - a).length()));
        all.extend(places);
    }
    (lengths, all)
}

/// Point k of `count` from a to b, both included exactly; the middle if there is one alone.
fn between(a: Vec2, b: Vec2, k: usize, count: usize) -> Vec2 {
    match (k, count) {
        (_, 1) => (a + b) * 0.5,
        (0, _) => a,
        (k, n) if k + 1 == n => b,
        (k, n) => a + (b - a) * (k as f64 / (n - 1) as f64),
    }
}

/// The points of a grid in rows of constant y, the lowest first; of points on cracks the upper side.
pub(super) fn grid(cracks: &[Crack], window: Rect, [nx, ny]: [u32; 2]) -> Vec<Place> {
    let (Rect { min, max }, segments) = (window, Segments::new(cracks));
    let row = |j: u32| {
        let y = between(min, max, j as usize, ny as usize).y;
        let x = |i: u32| between(min, max, i as usize, nx as usize).x;
        let points: Vec<Vec2> = (0..nx).map(|i| vec2(x(i), y)).collect();
        let sided = sided(&segments, &points).into_iter();
        sided.map(|places| places[0]).collect::<Vec<_>>()
    };
    (0..ny).flat_map(row).collect()
}

/// Longest file of points, in bytes: those of [`super::MOST`] points in all digits.
const LONGEST: u64 = 1 << 30;

/// The points of a text file: lines with x and y apart by commas, semicolons or blanks; more columns are
/// ignored, and so are a first line of names, empty lines and what follows `#`.
pub(super) fn read(path: &Path) -> anyhow::Result<Vec<Vec2>> {
    let context = || format!("cannot read {}", path.display());
    let text = match is_standard(path) {
        true => standard::text("the list of points")?,
        false => ppum_file::text(path, LONGEST).with_context(context)?,
    };
    let name = standard::name(path);
    let mut points = Vec::new();
    let mut is_head = true;
    for (k, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        match point(line) {
            Some(point) => points.push(point),
            None if is_head
                && !line.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {}
            None => bail!("{name}:{k}: expected two finite numbers: x,y"),
        }
        is_head = false;
        ensure!(points.len() <= MOST, "{name}:{k}: more than {MOST} points");
    }
    ensure!(!points.is_empty(), "{name}: has no points");
    Ok(points)
}

fn point(line: &str) -> Option<Vec2> {
    let parts = line.split([',', ';', ' ', '\t']).filter(|part| !part.is_empty());
    let numbers: Vec<f64> = parts.take(2).map_while(|part| part.parse().ok()).collect();
    match numbers[..] {
        [x, y] if x.is_finite() && y.is_finite() => Some(vec2(x, y)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_file() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let with = |text: &str| {
            std::fs::write(file.path(), text).expect("written");
            read(file.path()).map_err(|e| e.to_string())
        };
        let two = Ok(vec![vec2(1.0, -2.5), vec2(0.0, 1e-3)]);
        assert_eq!(with("x,y\n1,-2.5\n\n0,1e-3 # tip\n"), two);
        assert_eq!(with("1; -2.5; 7\n  0\t1e-3"), two);
        for (text, hint) in [
            ("", "no points"),
            ("x,y\n", "no points"),
            ("1,2\nx,y", ":2: "),
            ("1,inf", ":1: "),
            ("1", ":1: "),
        ] {
            let error = with(text).expect_err(text);
            assert!(error.contains(hint), "{text}: {error}");
        }
    }

    #[test]
    fn ends_are_exact() {
        let (a, b) = (vec2(0.1, 0.2), vec2(0.7, -0.3));
        for n in [2, 3, 7, 1000] {
            assert_eq!((between(a, b, 0, n), between(a, b, n - 1, n)), (a, b));
        }
        assert_eq!(between(a, b, 0, 1), (a + b) * 0.5);
        let (_, places) = line(&[], a, b, 7);
        assert_eq!((places[0].point, places[6].point), (a, b));
        let bounds = Rect::new(vec2(-1.1, 0.1), vec2(0.7, 1.3));
        let corners = grid(&[], bounds, [7, 9]);
        assert_eq!((corners[0].point, corners[62].point), (bounds.min, bounds.max));
    }
}
