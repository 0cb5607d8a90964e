//! The table `[[crack]]`, which may be a curve: `arc`, `ellipse`, `spline`, `path`; and what closed
//! curves have in common with it.

use std::f64::consts::TAU;

use ppum::spline::Spline;
use ppum::vec2::{Vec2, vec2};

use crate::file::{DocumentValue, FromValue as _, Section, all};
use crate::geometry::{MOST_SEGMENTS, SmoothCurve, TooSharp, shown};

/// Gap between pieces of a path, in parts of their size, that is rounding of their ends.
pub(super) const JOINT: f64 = 1e-6;

/// The course of a `[[crack]]`.
pub(super) fn course(section: &Section<'_>) -> Option<Vec<Vec2>> {
    let given = section.given(&["points", "arc", "ellipse", "spline", "path"]);
    if let [_, (_, second), ..] = &given[..] {
        return second.error("gives the crack once more; leave one out");
    }
    let segments = segments(section)?;
    match given.first() {
        Some(("path", value)) => path(value, segments),
        Some((key, value)) if *key != "points" => open(key, value, segments),
        _ if segments.is_some() => {
            section.value("segments")?.error("is for curves; give more points")
        }
        _ => section.require("points"),
    }
}

/// The number of segments that is asked for; none if that is left to the program.
pub(super) fn segments(section: &Section<'_>) -> Option<Option<usize>> {
    if section.value("segments").is_none() {
        return Some(None);
    }
    section.get::<usize>("segments")?;
    Some(Some(section.within("segments")? as usize))
}

/// The vertices of an open curve.
fn open(key: &str, value: &DocumentValue<'_>, segments: Option<usize>) -> Option<Vec<Vec2>> {
    let curve = match key {
        "arc" => arc(value)?,
        "ellipse" => ellipse(value, true)?,
        _ => SmoothCurve::Spline(Spline::open(&knots(value, false)?)),
    };
    points_or_error(curve.divided(segments), value)
}

pub(super) fn points_or_error(
    points: Result<Vec<Vec2>, TooSharp>,
    value: &DocumentValue<'_>,
) -> Option<Vec<Vec2>> {
    points.or_else(|TooSharp { at }| {
        let message = format!(
            "turns too sharply around {}: it would take more than {MOST_SEGMENTS} segments; make it rounder, or say how \
             many by `segments`",
            shown(at)
        );
        value.error(&message).ok_or(())
    }).ok()
}

/// Pieces one after the other, each from where the one before ends.
fn path(value: &DocumentValue<'_>, segments: Option<usize>) -> Option<Vec<Vec2>> {
    Some(joined(value, segments)?.0)
}

/// Pieces one after the other, each from where the one before ends, and the number of the point at
/// which each begins.
pub(super) fn joined(
    value: &DocumentValue<'_>,
    segments: Option<usize>,
) -> Option<(Vec<Vec2>, Vec<usize>)> {
    let pieces = value.list()?;
    if pieces.is_empty() {
        return value.error("has no pieces; give one at least");
    }
    let all = all(pieces.iter().map(|value| piece(value, segments)))?;
    let (mut points, mut starts): (Vec<Vec2>, _) = (Vec::new(), vec![0]);
    for (piece, value) in all.iter().zip(&pieces) {
        let Some(end) = points.last().copied() else {
            points.clone_from(piece);
            continue;
        };
        let size = (piece[piece.len() - 1] - piece[0]).length() + (end - points[0]).length();
        if (piece[0] - end).length() > JOINT * size {
            return value.error(&format!(
                "has a gap: the piece begins at {}, but the one before ends at {}; begin each piece where the one \
                 before ends",
                shown(piece[0]), shown(end)
            ));
        }
        starts.push(points.len() - 1);
        points.extend(&piece[1..]);
    }
    Some((points, starts))
}

fn piece(value: &DocumentValue<'_>, segments: Option<usize>) -> Option<Vec<Vec2>> {
    let (section, keys) = (value.table()?, ["points", "arc", "ellipse", "spline"]);
    let given = section.given(&keys);
    let [(key, curve)] = &given[..] else {
        if given.is_empty() && section.mentions_any(&keys) {
            return None;
        }
        return value.error(
            "has a piece without, or with more than, one of points, arc, ellipse, spline; give one",
        );
    };
    if *key != "points" {
        return open(key, curve, segments);
    }
    let points = Vec::read(curve)?;
    if points.len() < 2 {
        curve.error("has too few points; give two at least")
    } else {
        Some(points)
    }
}

fn arc(value: &DocumentValue<'_>) -> Option<SmoothCurve> {
    let section = value.table()?;
    let (center, radius) = (section.require("center"), section.within("radius"));
    let [from, to] = range(&section)?;
    Some(SmoothCurve::arc(center?, radius?, from, to))
}

/// A part of an ellipse, or all of it.
pub(super) fn ellipse(value: &DocumentValue<'_>, is_part: bool) -> Option<SmoothCurve> {
    let section = value.table()?;
    let center = section.require("center");
    let axes = section.required("axes").and_then(|value| {
        let [a, b] = value.array()?.map(|axis| axis.within("axes", &section));
        Some(vec2(a?, b?))
    });
    let angle = section.or("angle", 0.0);
    let range = if is_part { range(&section) } else { Some([0.0, TAU]) };
    let (axes, angle, [from, to]) = (axes?, angle?.to_radians(), range?);
    Some(SmoothCurve::Ellipse { center: center?, axes, angle, from, to })
}

/// `from` and `to`, in radians.
fn range(section: &Section<'_>) -> Option<[f64; 2]> {
    let (from, to) = (section.require::<f64>("from"), section.require::<f64>("to"));
    let (from, to, last) = (from?, to?, section.value("to")?);
    if from == to {
        return last.error(
            "equals `from`, so that the curve has no length; give another angle, in degrees",
        );
    }
    if (to - from).abs() >= 360.0 {
        return last.error("is a whole turn or more from `from`, and the crack would meet itself; give less than 360 degrees");
    }
    Some([from.to_radians(), to.to_radians()])
}

/// The points of a spline.
pub(super) fn knots(value: &DocumentValue<'_>, is_closed: bool) -> Option<Vec<Vec2>> {
    let points: Vec<Vec2> = Vec::read(value)?;
    if points.len() < 3 {
        return value.error("needs at least 3 points; add `[x, y]`");
    }
    if points.len() > MOST_SEGMENTS {
        return value
            .error(&format!("has {} points, but at most {MOST_SEGMENTS} may be", points.len()));
    }
    let next = |k: usize| points[(k + 1) % points.len()];
    let last = if is_closed { points.len() } else { points.len() - 1 };
    match (0..last).find(|k| points[*k] == next(*k)) {
        Some(k) if is_closed && k + 1 == points.len() => value
            .error("ends with its first point, to which it returns by itself; remove the last one"),
        Some(k) => {
            value.error(&format!("has equal points, {k} and the next one; remove one of them"))
        }
        None => Some(points),
    }
}
