//! Cracks and holes that are given as curves: `arc`, `ellipse`, `spline`, `path`.

use ppum::text::trimmed;
use ppum::vec2::{Vec2, vec2};

use super::super::curve::{self, MOST, SmoothCurve, Spline, TooSharp};
use super::super::document::{Section, Value};
use super::all;

/// Keys of the curves that a crack or a piece of one may be.
const CURVES: [&str; 3] = ["arc", "ellipse", "spline"];

/// Keys that give the course of a crack.
const COURSES: [&str; 5] = ["points", "arc", "ellipse", "spline", "path"];

/// Least number of segments of a curve that is asked for.
const FEWEST: u32 = 4;

/// Gap between pieces of a path, in parts of their size, that is rounding of their ends.
const JOINT: f64 = 1e-6;

/// The course of a `[[crack]]`.
pub(super) fn course(section: Section<'_>) -> Option<Vec<Vec2>> {
    let section = section.only(&["points", "arc", "ellipse", "spline", "path", "segments"], &[]);
    let given: Vec<_> = COURSES.iter().filter(|key| section.mentions(key)).collect();
    if let [_, second, ..] = given[..] {
        return section.get(second)?.error("gives the crack once more; leave one out");
    }
    let segments = segments(&section)?;
    if let Some(path) = section.get("path") {
        return self::path(&path, segments);
    }
    if let Some((curve, value)) = CURVES.iter().find_map(|key| open(&section, key)) {
        return vertices(&curve?, segments, &value);
    }
    if let (Some(_), Some(value)) = (segments, section.get("segments")) {
        return value.error("is for curves; give more points");
    }
    let example = "points = [[-0.5, 0.0], [0.5, 0.0]]";
    super::points(&section.require("points", example)?)
}

/// The number of segments that is asked for; none if that is left to the program.
fn segments(section: &Section<'_>) -> Option<Option<usize>> {
    let Some(value) = section.get("segments") else { return Some(None) };
    let count = value.whole()?;
    if !(FEWEST..=MOST as u32).contains(&count) {
        return value.error(&format!("is {count}, but must be {FEWEST} to {MOST}"));
    }
    Some(Some(count as usize))
}

/// The corners of a closed curve, of a `[[hole]]`; none if it is given in another way.
pub(super) fn rim(section: &Section<'_>) -> Option<Option<Vec<Vec2>>> {
    let (key, value) =
        ["ellipse", "spline"].iter().find_map(|key| Some((key, section.get(key)?)))?;
    let read = || {
        let segments = segments(section)?;
        let curve = match *key {
            "ellipse" => ellipse(&value, false)?,
            _ => SmoothCurve::Spline(Spline::closed(&knots(&value, 3, true)?)),
        };
        points_or_mistake(curve.closed(segments), &value)
    };
    Some(read())
}

/// The curve of a key, if that is given, with its value.
fn open<'a>(section: &Section<'a>, key: &str) -> Option<(Option<SmoothCurve>, Value<'a>)> {
    let value = section.get(key)?;
    let curve = match key {
        "arc" => arc(&value),
        "ellipse" => ellipse(&value, true),
        _ => knots(&value, 3, false).map(|points| SmoothCurve::Spline(Spline::open(&points))),
    };
    Some((curve, value))
}

fn vertices(curve: &SmoothCurve, segments: Option<usize>, value: &Value<'_>) -> Option<Vec<Vec2>> {
    points_or_mistake(curve.divided(segments), value)
}

fn points_or_mistake(points: Result<Vec<Vec2>, TooSharp>, value: &Value<'_>) -> Option<Vec<Vec2>> {
    let report = |TooSharp { at }: TooSharp| {
        let message = format!(
            "turns too sharply around [{}, {}]: it would take more than {MOST} segments; make it rounder, or say how \
             many by `segments`",
            trimmed(at.x),
            trimmed(at.y)
        );
        value.error::<()>(&message);
    };
    points.map_err(report).ok()
}

/// Pieces one after the other, each from where the one before ends.
fn path(value: &Value<'_>, segments: Option<usize>) -> Option<Vec<Vec2>> {
    let pieces = value.list("a list of pieces such as { arc = { … } }")?;
    if pieces.is_empty() {
        return value.error("has no pieces; give one at least");
    }
    let all = all(pieces.iter().map(|value| piece(value, segments)))?;
    let mut points: Vec<Vec2> = Vec::new();
    for (piece, value) in all.iter().zip(&pieces) {
        let Some(end) = points.last().copied() else {
            points.clone_from(piece);
            continue;
        };
        let size = (piece[piece.len() - 1] - piece[0]).length() + (end - points[0]).length();
        if (piece[0] - end).length() > JOINT * size {
            let [p, q] = [end, piece[0]];
            return value.error(&format!(
                "has a gap: the piece begins at [{}, {}], but the one before ends at [{}, {}]; begin each piece where \
                 the one before ends",
                trimmed(q.x), trimmed(q.y), trimmed(p.x), trimmed(p.y)
            ));
        }
        points.extend(&piece[1..]);
    }
    Some(points)
}

fn piece(value: &Value<'_>, segments: Option<usize>) -> Option<Vec<Vec2>> {
    let section = value.table("a piece of `path`", "{ points = [[0, 0], [1, 0]] }")?;
    let keys = ["points", "arc", "ellipse", "spline"];
    let section = section.only(&keys, &[]);
    let given = keys.iter().filter(|key| section.mentions(key)).count();
    if given != 1 {
        return value.error(
            "has a piece without, or with more than, one of points, arc, ellipse, spline; give one",
        );
    }
    if let Some((curve, value)) = CURVES.iter().find_map(|key| open(&section, key)) {
        return vertices(&curve?, segments, &value);
    }
    let points = section.get("points")?;
    let found = super::points(&points)?;
    if found.len() < 2 {
        return points.error("has too few points; give two at least");
    }
    Some(found)
}

fn arc(value: &Value<'_>) -> Option<SmoothCurve> {
    let example = "{ center = [0, 0], radius = 1, from = 0, to = 90 }";
    let section = value.table("`arc`", example)?.only(&["center", "radius", "from", "to"], &[]);
    let center = section.require("center", "center = [0, 0]").and_then(|value| value.point());
    let radius = section.require("radius", "radius = 1").and_then(|value| positive(&value));
    let range = range(&section);
    let ([from, to], radius) = (range?, radius?);
    Some(SmoothCurve::arc(center?, radius, from, to))
}

/// A part of an ellipse, or all of it.
fn ellipse(value: &Value<'_>, is_part: bool) -> Option<SmoothCurve> {
    let (keys, example): (&[_], _) = match is_part {
        true => (
            &["center", "axes", "angle", "from", "to"],
            "{ center = [0, 0], axes = [2, 1], from = 0, to = 90 }",
        ),
        false => (&["center", "axes", "angle"], "{ center = [0, 0], axes = [2, 1] }"),
    };
    let section = value.table("`ellipse`", example)?.only(keys, &[]);
    let center = section.require("center", "center = [0, 0]").and_then(|value| value.point());
    let axes = section.require("axes", "axes = [2, 1]").and_then(|value| {
        let [a, b] = value.pair("the two half axes [a, b]")?;
        let (a, b) = (positive(&a), positive(&b));
        Some(vec2(a?, b?))
    });
    let angle = section.get("angle").map_or(Some(0.0), |value| value.constant());
    let range = if is_part { range(&section) } else { Some(curve::around(0.0)) };
    let (axes, angle, [from, to]) = (axes?, angle?.to_radians(), range?);
    Some(SmoothCurve::Ellipse { center: center?, axes, angle, from, to })
}

fn positive(value: &Value<'_>) -> Option<f64> {
    let number = value.constant()?;
    if number > 0.0 {
        return Some(number);
    }
    value.error(&format!("is {number}, but must be positive"))
}

/// `from` and `to`, in radians.
fn range(section: &Section<'_>) -> Option<[f64; 2]> {
    let from = section.require("from", "from = 0").and_then(|value| value.constant());
    let last = section.require("to", "to = 90");
    let to = last.as_ref().and_then(Value::constant);
    let (from, to, last) = (from?, to?, last?);
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
fn knots(value: &Value<'_>, least: usize, is_closed: bool) -> Option<Vec<Vec2>> {
    let points = super::points(value)?;
    if points.len() < least {
        return value.error(&format!("needs at least {least} points; add `[x, y]`"));
    }
    if points.len() > MOST {
        return value.error(&format!("has {} points, but at most {MOST} may be", points.len()));
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
