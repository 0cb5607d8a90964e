//! Geometries of Gmsh: points, curves and physical groups; statements between semicolons.
//!
//! Numbers may be formulas of variables. Loops, conditions, macros and operations on surfaces are
//! not read.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use ppum::expression::Expression;
use ppum::vec2::{Vec2, vec2};

use crate::bspline::BSpline;
use crate::curve::{EllipseArc, PlaneCurve};
use crate::error::ImportError;
use crate::sketch::{DrawnCurve, Sketch};
use crate::source::SourceLine;

/// Statements that make nothing of the boundary.
const SILENT: [&str; 14] = [
    "SetFactory",
    "Mesh",
    "Plane Surface",
    "Surface",
    "Curve Loop",
    "Line Loop",
    "Physical Surface",
    "Physical Point",
    "Transfinite",
    "Recombine",
    "Characteristic",
    "Field",
    "Geometry",
    "General",
];

/// Statements whose lines up to another one are not read.
const BLOCKS: [(&str, &str); 5] = [
    ("For", "EndFor"),
    ("If", "EndIf"),
    ("Macro", "Return"),
    ("Function", "Return"),
    ("DefineConstant", "]"),
];

/// Longest list with a range, `1:100`.
const LONGEST: usize = 100_000;

#[derive(Default)]
struct GeoFile {
    variables: BTreeMap<String, f64>,
    /// Variables whose values are not read, with their lines.
    unread: BTreeMap<String, SourceLine>,
    points: BTreeMap<i64, Vec2>,
    curves: BTreeMap<i64, (Vec<DrawnCurve>, SourceLine)>,
    names: BTreeMap<i64, String>,
    sketch: Sketch,
}

/// A statement `Kind(tag) = { list }` in parts.
struct Statement<'a> {
    kind: &'a str,
    tag: &'a str,
    value: &'a str,
    source: SourceLine,
}

pub(crate) fn read(text: &str) -> Result<Sketch, ImportError> {
    let text = without_comments(text);
    let mut geometry = GeoFile::default();
    let (mut rest, mut line) = (text.as_str(), 1);
    while !rest.trim().is_empty() {
        let blank = rest.len() - rest.trim_start().len();
        line += newlines(&rest[..blank]);
        rest = &rest[blank..];
        let source = SourceLine::new(line);
        let end = match block_end(rest, source)? {
            Some((kind, end)) => {
                geometry.sketch.leave(format!("{kind}, with all up to its end"), source);
                end
            }
            None => {
                let (length, end) = statement_end(rest).ok_or_else(|| {
                    source.error("the statement has no semicolon; the file may be cut off")
                })?;
                geometry.statement(&rest[..length], source)?;
                end
            }
        };
        line += newlines(&rest[..end]);
        rest = &rest[end..];
    }
    geometry.draw()?;
    Ok(geometry.sketch)
}

fn newlines(text: &str) -> usize {
    text.bytes().filter(|b| *b == b'\n').count()
}

/// The text without comments, lines kept.
fn without_comments(text: &str) -> String {
    let (mut found, mut rest) = (String::new(), text);
    while let Some(at) = rest.find('/') {
        let (before, comment) = rest.split_at(at);
        found += before;
        let length = match comment.as_bytes().get(1) {
            Some(b'/') => comment.find('\n').unwrap_or(comment.len()),
            Some(b'*') => comment[2..].find("*/").map_or(comment.len(), |end| end + 4),
            _ => {
                found.push('/');
                1
            }
        };
        found.extend(std::iter::repeat_n('\n', newlines(&comment[..length])));
        rest = &comment[length..];
    }
    found + rest
}

/// The lengths of a statement without and with what ends it: a semicolon, or the brace behind a
/// list of statements.
fn statement_end(rest: &str) -> Option<(usize, usize)> {
    let (mut depth, mut has_statements) = (0_usize, false);
    for (at, c) in rest.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ';' if depth == 0 => return Some((at, at + 1)),
            ';' => has_statements = true,
            _ => {}
        }
        if c == '}' && depth == 0 && has_statements {
            let semicolon = usize::from(rest[at + 1..].starts_with(';'));
            return Some((at + 1, at + 1 + semicolon));
        }
    }
    None
}

/// The kind of a block that begins here, and its length; blocks of the same kind lie in it.
fn block_end(rest: &str, source: SourceLine) -> Result<Option<(&'static str, usize)>, ImportError> {
    let word = rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
    let Some((kind, end)) = BLOCKS.iter().find(|(kind, _)| *kind == word) else { return Ok(None) };
    let (mut depth, mut at) = (0_usize, 0);
    for word in rest.split_inclusive(|c: char| !c.is_alphanumeric()) {
        let name = word.trim_end_matches(|c: char| !c.is_alphanumeric());
        at += word.len();
        depth += usize::from(name == *kind);
        let is_end = name == *end || (*end == "]" && word.ends_with(']'));
        depth = depth.saturating_sub(usize::from(is_end));
        if depth == 0 {
            let semicolon = usize::from(rest[at..].starts_with(';'));
            return Ok(Some((kind, at + semicolon)));
        }
    }
    Err(source.error(format!("{kind} has no {end}; the file may be cut off")))
}

impl GeoFile {
    fn statement(&mut self, text: &str, source: SourceLine) -> Result<(), ImportError> {
        let Some((left, value)) = text.split_once('=') else {
            let kind = text.split(['(', '{', '[']).next().unwrap_or_default().trim();
            if !kind.is_empty() && !text.contains("In Surface") {
                self.leave(kind, source);
            }
            return Ok(());
        };
        let (kind, tag) = match left.split_once('(') {
            Some((kind, tag)) => (kind.trim(), tag.trim().trim_end_matches(')')),
            None => (left.trim(), ""),
        };
        let statement = Statement { kind, tag, value: value.trim(), source };
        match kind {
            "Point" => self.point(&statement)?,
            "Physical Curve" | "Physical Line" => self.physical(&statement)?,
            "Line" | "Circle" | "Ellipse" | "Ellipsis" | "Spline" | "BSpline" | "Bezier" => {
                self.curve(&statement)?;
            }
            _ if tag.is_empty() && is_name(kind) && !statement.value.starts_with(['{', '"']) => {
                match self.number(statement.value, source) {
                    Ok(value) => drop(self.variables.insert(kind.to_owned(), value)),
                    Err(_) => {
                        let what = format!("{kind} = {}", start_of(statement.value));
                        self.sketch.leave(what, source);
                        self.unread.insert(kind.to_owned(), source);
                    }
                }
            }
            kind => self.leave(kind, source),
        }
        Ok(())
    }

    /// Leaves a statement that is not read, unless it makes nothing of the boundary.
    fn leave(&mut self, kind: &str, source: SourceLine) {
        if !SILENT.iter().any(|silent| kind.starts_with(silent)) {
            self.sketch.leave(start_of(kind), source);
        }
    }

    fn point(&mut self, statement: &Statement<'_>) -> Result<(), ImportError> {
        let (tag, at) = (self.tag(statement)?, self.list(statement)?);
        let [x, y, rest @ ..] = &at[..] else {
            return Err(statement.source.error("a Point has fewer than two coordinates; add them"));
        };
        if rest.first().is_some_and(|z| *z != 0.0) {
            self.sketch.leave("z of a Point; curves are taken in the x-y plane", statement.source);
        }
        self.points.insert(tag, vec2(*x, *y));
        Ok(())
    }

    fn tag(&self, statement: &Statement<'_>) -> Result<i64, ImportError> {
        Ok(self.number(statement.tag, statement.source)? as i64)
    }

    fn curve(&mut self, statement: &Statement<'_>) -> Result<(), ImportError> {
        let (tag, numbers) = (self.tag(statement)?, self.list(statement)?);
        let point = |tag: &f64| {
            let point = self.points.get(&(tag.abs() as i64)).copied();
            point.ok_or_else(|| {
                statement.source.error(format!("Point({tag}) is not defined; define it before"))
            })
        };
        // circles of the OpenCASCADE kernel: centre, radius, angles
        let is_centred = statement.kind == "Circle" && numbers.len() >= 4;
        let (made, count) = if is_centred {
            (centred(&numbers), 0)
        } else {
            let points: Vec<_> = numbers.iter().map(point).collect::<Result<_, _>>()?;
            (made(statement.kind, &points), points.len())
        };
        let kind = statement.kind;
        let message = || format!("{kind} has {count} points that make no such curve; repair it");
        let made = made.ok_or_else(|| statement.source.error(message()))?;
        self.curves.insert(tag, (made, statement.source));
        Ok(())
    }

    /// Names of curves: `Physical Curve("name", 7) = {1, 2}`.
    fn physical(&mut self, statement: &Statement<'_>) -> Result<(), ImportError> {
        let name = match statement.tag.split('"').nth(1) {
            Some(name) => name.to_owned(),
            None => format!("curve-{}", self.tag(statement)?),
        };
        for curve in self.list(statement)? {
            self.names.insert(curve.abs() as i64, name.clone());
        }
        Ok(())
    }

    /// The numbers of `{1, -2, 3:5, a + b}`.
    fn list(&self, statement: &Statement<'_>) -> Result<Vec<f64>, ImportError> {
        let inner = statement.value.trim_start_matches('{').trim_end_matches('}');
        let mut numbers = Vec::new();
        for item in items(inner) {
            let item = item.trim().trim_start_matches('{').trim_end_matches('}');
            let Some((from, to)) = item.split_once(':') else {
                numbers.push(self.number(item, statement.source)?);
                continue;
            };
            let [from, to] =
                [self.number(from, statement.source)?, self.number(to, statement.source)?];
            let count = (to - from).floor();
            if !(0.0..LONGEST as f64).contains(&count) {
                return Err(statement.source.error(format!(
                        "the list has {count} numbers from {from} to {to}, but at most {LONGEST} are read"
                    )));
            }
            numbers.extend((0..=count as usize).map(|k| from + k as f64));
        }
        Ok(numbers)
    }

    /// A number, or a formula of variables.
    fn number(&self, text: &str, source: SourceLine) -> Result<f64, ImportError> {
        let text = text.trim();
        let number = text.parse().ok().or_else(|| self.evaluated(text));
        number.filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            let name = words(text).into_iter().find_map(|word| self.unread.get_key_value(word));
            let message = match name {
                Some((name, defined)) => {
                    format!("the value of `{name}` in {defined} is not read; write a number there")
                }
                None => format!("`{}` is no number; write one", start_of(text)),
            };
            source.error(message)
        })
    }

    /// The values of names that Gmsh reserves for the next free number of a point or a curve.
    /// Surfaces are not read, so that their numbers are free.
    fn reserved(&self, name: &str) -> Option<f64> {
        let next = |last: Option<&i64>| last.map_or(1, |last| last + 1) as f64;
        let (point, curve) = (self.points.keys().next_back(), self.curves.keys().next_back());
        match name {
            "newp" => Some(next(point)),
            "newc" | "newl" | "newreg" => Some(next(curve)),
            "newll" | "newcl" | "news" | "newsl" | "newv" => Some(1.0),
            _ => None,
        }
    }

    /// The value of a formula, with the variables' values for their names; Gmsh's functions begin
    /// with a capital.
    fn evaluated(&self, text: &str) -> Option<f64> {
        let mut formula = String::new();
        for word in words(text) {
            match self.variables.get(word).copied().or_else(|| self.reserved(word)) {
                Some(value) => formula += &format!("({value:?})"),
                None if is_name(word) => formula += &word.to_lowercase(),
                None => formula += word,
            }
        }
        Expression::parse(&formula).ok()?.constant()
    }

    fn draw(&mut self) -> Result<(), ImportError> {
        for (tag, (curves, source)) in std::mem::take(&mut self.curves) {
            let name = self.names.get(&tag);
            for curve in curves {
                self.sketch.add(curve, name.cloned(), source)?;
            }
        }
        Ok(())
    }
}

fn is_name(word: &str) -> bool {
    let mut chars = word.chars();
    chars.next().is_some_and(|c| c.is_alphabetic() || c == '_')
        && chars.all(|c| c.is_alphanumeric() || c == '_')
}

fn start_of(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(40).collect()
}

/// The parts of a list between commas that stand in no parentheses.
fn items(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let is_between = |c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    };
    text.split(is_between).filter(|item| !item.trim().is_empty()).collect()
}

/// Names, numbers such as `1e-3`, and single other characters.
fn words(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let end = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        found.push(&rest[..end]);
        rest = &rest[end..];
    }
    found
}

/// A circle, or an arc of one, by centre, radius and angles.
fn centred(numbers: &[f64]) -> Option<Vec<DrawnCurve>> {
    let [x, y, _, radius, angles @ ..] = numbers else { return None };
    let range = [angles.first().copied().unwrap_or(0.0), angles.get(1).copied().unwrap_or(TAU)];
    let arc = EllipseArc::circle(vec2(*x, *y), *radius, range);
    (*radius > 0.0).then(|| vec![PlaneCurve::Arc(arc).into()])
}

/// The curves by points.
fn made(kind: &str, points: &[Vec2]) -> Option<Vec<DrawnCurve>> {
    let curve = match (kind, points) {
        ("Line", [_, _, ..]) | ("Spline" | "BSpline" | "Bezier", [_, _]) => {
            DrawnCurve::polyline(points.to_vec())
        }
        ("Circle", &[a, center, b]) => arc(a, center, a, b)?,
        ("Ellipse" | "Ellipsis", &[a, center, major, b]) => arc(a, center, major, b)?,
        ("Spline", [_, _, ..]) => return catmull_rom(points),
        ("BSpline", _) => BSpline::clamped(points.len().saturating_sub(1).min(3), points)?.into(),
        ("Bezier", _) => BSpline::bezier(points)?.into(),
        _ => return None,
    };
    Some(vec![curve])
}

/// The shorter arc between two points of an ellipse with a point on its first axis. In the axes'
/// frame x² / a² + y² / b² = 1 holds at both points, which gives a and b; a circle needs one.
fn arc(from: Vec2, center: Vec2, major: Vec2, to: Vec2) -> Option<DrawnCurve> {
    let axis = (major - center).unit();
    let own = [from, to].map(|p| vec2((p - center).dot(axis), axis.cross(p - center)));
    let [p, q] = own.map(|v| vec2(v.x * v.x, v.y * v.y));
    let determinant = p.x * q.y - q.x * p.y;
    let is_circle =
        major == from && (own[0].length() - own[1].length()).abs() < 1e-6 * own[0].length();
    let radii = if is_circle || determinant == 0.0 {
        [own[0].length(); 2]
    } else {
        [determinant / (q.y - p.y), determinant / (p.x - q.x)].map(f64::sqrt)
    };
    let angle = |v: Vec2| (v.y / radii[1]).atan2(v.x / radii[0]);
    let [start, end] = own.map(angle);
    let turn = (end - start).rem_euclid(TAU);
    let turn = if turn > 0.5 * TAU { turn - TAU } else { turn };
    let radii = [axis * radii[0], axis.left() * radii[1]];
    let arc = EllipseArc { center, radii, range: [start, start + turn] };
    let is_arc = turn.is_finite() && turn != 0.0 && radii.iter().all(|r| r.is_finite());
    is_arc.then(|| PlaneCurve::Arc(arc).into())
}

/// The Catmull–Rom spline of Gmsh, one Bézier curve between two points; the tangent at a point is
/// half the step from the one before it to the one after it. A closed one goes on behind its ends.
fn catmull_rom(points: &[Vec2]) -> Option<Vec<DrawnCurve>> {
    let ([first, second, ..], [.., before, last]) = (points, points) else { return None };
    let [start, end] = match first == last {
        true => [*before, *second],
        false => [*first * 2.0 - *second, *last * 2.0 - *before],
    };
    let all = [&[start], points, &[end]].concat();
    let slope = |from: Vec2, to: Vec2| (to - from) / 6.0;
    let controls = |p: &[Vec2]| [p[1], p[1] + slope(p[0], p[2]), p[2] - slope(p[1], p[3]), p[2]];
    all.windows(4).map(|p| BSpline::bezier(&controls(p)).map(DrawnCurve::from)).collect()
}
