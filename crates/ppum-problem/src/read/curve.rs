//! The table `[[crack]]`, which may be a curve: `arc`, `ellipse`, `spline`, `path`; and what closed
//! curves have in common with it.

use std::f64::consts::TAU;

use ppum::crack::Crack;
use ppum::edge::Edge;
use ppum::smooth_curve::{MOST_ARCS, SmoothCurve};
use ppum::spline::Spline;
use ppum::vec2::{Vec2, vec2};

use crate::file::{DocumentValue, FromValue as _, Section, all};
use crate::geometry::shown;

/// Gap between pieces of a path, in parts of their size, that is rounding of their ends.
pub(super) const JOINT: f64 = 1e-6;

/// The course of a `[[crack]]`.
pub(super) fn course(section: &Section<'_>) -> Option<Crack> {
    let given = section.given(&["points", "arc", "ellipse", "spline", "path"]);
    if let [_, (_, second), ..] = &given[..] {
        return second.error("gives the crack once more; leave one out");
    }
    note_segments(section)?;
    match given.first() {
        Some((key, value)) => open(section, key, value),
        None => section.require::<Vec<Vec2>>("points").and(None),
    }
}

/// Remarks a number of segments, which curves have none of.
pub(super) fn note_segments(section: &Section<'_>) -> Option<()> {
    section.optional::<usize>("segments")?;
    let note = "has no effect, since curves consist of arcs; remove it";
    section.value("segments").iter().for_each(|value| value.note(note));
    Some(())
}

/// The `bulges` of so many edges; none of a polyline.
pub(super) fn bulges(section: &Section<'_>, edges: usize) -> Option<Vec<f64>> {
    let Some(value) = section.value("bulges") else { return Some(Vec::new()) };
    let bulges = all(value.list()?.iter().map(f64::read))?;
    if bulges.len() == edges {
        return Some(bulges);
    }
    value.error(&format!(
        "has {} of the {edges} numbers that `points` need: give one for each edge, 0 where it is straight",
        bulges.len()
    ))
}

/// Reports `bulges` beside a curve.
pub(super) fn no_bulges(section: &Section<'_>) -> Option<()> {
    match section.value("bulges") {
        Some(value) => value.error("is for `points`; remove it"),
        None => Some(()),
    }
}

/// An open curve, which a key of a table gives.
fn open(section: &Section<'_>, key: &str, value: &DocumentValue<'_>) -> Option<Crack> {
    if key == "points" {
        let points: Vec<Vec2> = Vec::read(value)?;
        let bulges = bulges(section, points.len().saturating_sub(1))?;
        return Some(Crack { points, bulges, ..Crack::default() });
    }
    no_bulges(section)?;
    let curve = match key {
        "path" => return Some(Crack::along(&joined(value)?.0)),
        "arc" => arc(value)?,
        "ellipse" => ellipse(value, true)?,
        _ => SmoothCurve::Spline(Spline::open(&knots(value, false)?)),
    };
    Some(Crack::along(&edges(&curve, value)?))
}

/// The edges of a curve.
pub(super) fn edges(curve: &SmoothCurve, value: &DocumentValue<'_>) -> Option<Vec<Edge>> {
    let sharp = |at| {
        let message = format!(
            "turns too sharply around {}: it has a cusp, or would take more than {MOST_ARCS} arcs; make it rounder, \
             or divide it there by a `path`",
            shown(at)
        );
        value.error::<()>(&message);
    };
    curve.edges().map_err(sharp).ok()
}

/// The edges of pieces one after the other, each from where the one before ends, and the number of
/// the edge at which each begins.
pub(super) fn joined(value: &DocumentValue<'_>) -> Option<(Vec<Edge>, Vec<usize>)> {
    let pieces = value.list()?;
    if pieces.is_empty() {
        return value.error("has no pieces; give one at least");
    }
    let all = all(pieces.iter().map(piece))?;
    let (mut edges, mut starts): (Vec<Edge>, _) = (Vec::new(), Vec::new());
    for (piece, value) in all.iter().zip(&pieces) {
        starts.push(edges.len());
        edges.extend(piece.edges());
        let own = starts[starts.len() - 1];
        let Some(before) = own.checked_sub(1) else { continue };
        let (end, start) = (edges[before].to, edges[own].from);
        let last = piece.points[piece.points.len() - 1];
        let size = (last - start).length() + (end - edges[0].from).length();
        if (start - end).length() > JOINT * size {
            return value.error(&format!(
                "has a gap: the piece begins at {}, but the one before ends at {}; begin each piece where the one \
                 before ends",
                shown(start),
                shown(end)
            ));
        }
        edges[own].from = end;
    }
    Some((edges, starts))
}

fn piece(value: &DocumentValue<'_>) -> Option<Crack> {
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
    let course = open(&section, key, curve)?;
    if course.points.len() < 2 {
        return curve.error("has too few points; give two at least");
    }
    Some(course)
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
    if points.len() > MOST_ARCS {
        return value
            .error(&format!("has {} points, but at most {MOST_ARCS} may be", points.len()));
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
