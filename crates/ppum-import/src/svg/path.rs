//! Paths of SVG: M L H V C S Q T A Z, absolute and relative.

use std::f64::consts::TAU;

use ppum::vec2::{Vec2, vec2};

use super::number::take;
use crate::affine::PlaneMap;
use crate::bspline::BSpline;
use crate::curve::{EllipseArc, PlaneCurve};
use crate::sketch::DrawnCurve;

/// The pen of a path.
#[derive(Default)]
struct PathCursor {
    at: Vec2,
    /// Where the current part of the path began.
    start: Vec2,
    /// The last control point of the curve before, and the degree of that curve.
    control: Option<(Vec2, usize)>,
    run: Vec<Vec2>,
    curves: Vec<DrawnCurve>,
}

/// The curves of the attribute `d`; segments that follow each other are one polyline.
pub(super) fn curves(d: &str) -> Result<Vec<DrawnCurve>, String> {
    let (mut rest, mut pen, mut command) = (d, PathCursor::default(), ' ');
    loop {
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
        let Some(first) = rest.chars().next() else { break };
        if first.is_ascii_alphabetic() {
            command = first;
            rest = &rest[1..];
        } else if command.eq_ignore_ascii_case(&'z') || command == ' ' {
            return Err(format!("the path has `{first}` where a command belongs; repair it"));
        }
        let before = rest.len();
        let is_drawn = pen.draw(command, &mut rest);
        is_drawn.ok_or_else(|| {
            format!(
                "the path is wrong after `{command}`, {before} characters before its end; repair it"
            )
        })?;
        // more points of a move are lines
        command = match command {
            'm' => 'l',
            'M' => 'L',
            other => other,
        };
    }
    pen.lift();
    Ok(pen.curves)
}

impl PathCursor {
    /// Draws one segment; nothing if the text has no numbers for it.
    fn draw(&mut self, command: char, rest: &mut &str) -> Option<()> {
        let origin = if command.is_ascii_lowercase() { self.at } else { Vec2::ZERO };
        let mut number = || take(rest);
        let mut point = || Some(origin + vec2(number()?, number()?));
        let control = self.control.take();
        let reflected = |degree: usize| match control {
            Some((control, of)) if of == degree => self.at * 2.0 - control,
            _ => self.at,
        };
        match command.to_ascii_uppercase() {
            'M' => self.move_to(point()?),
            'L' => self.line_to(point()?),
            'H' => self.line_to(vec2(origin.x + take(rest)?, self.at.y)),
            'V' => self.line_to(vec2(self.at.x, origin.y + take(rest)?)),
            'C' => self.curve_to(&[point()?, point()?, point()?])?,
            'S' => self.curve_to(&[reflected(3), point()?, point()?])?,
            'Q' => self.curve_to(&[point()?, point()?])?,
            'T' => self.curve_to(&[reflected(2), point()?])?,
            'A' => self.arc(origin, rest)?,
            'Z' => self.close(),
            _ => return None,
        }
        Some(())
    }

    /// Ends a polyline.
    fn lift(&mut self) {
        let run = std::mem::take(&mut self.run);
        if run.len() > 1 {
            self.curves.push(DrawnCurve::polyline(run));
        }
    }

    fn move_to(&mut self, to: Vec2) {
        self.lift();
        (self.at, self.start) = (to, to);
    }

    fn line_to(&mut self, to: Vec2) {
        if self.run.is_empty() {
            self.run.push(self.at);
        }
        if to != self.at {
            self.run.push(to);
        }
        self.at = to;
    }

    fn close(&mut self) {
        if self.at != self.start {
            self.line_to(self.start);
        }
        self.lift();
    }

    /// A Bézier curve from the pen on.
    fn curve_to(&mut self, points: &[Vec2]) -> Option<()> {
        self.lift();
        let all = [&[self.at], points].concat();
        let [.., control, to] = all[..] else { return None };
        self.control = Some((control, points.len()));
        if all.iter().any(|p| *p != self.at) {
            self.curves.push(BSpline::bezier(&all)?.into());
        }
        self.at = to;
        Some(())
    }

    fn arc(&mut self, origin: Vec2, rest: &mut &str) -> Option<()> {
        let radii = [take(rest)?.abs(), take(rest)?.abs()];
        let angle = take(rest)?;
        let [is_large, is_positive] = [flag(rest)?, flag(rest)?];
        let to = origin + vec2(take(rest)?, take(rest)?);
        if radii.contains(&0.0) || to == self.at {
            self.line_to(to);
            return Some(());
        }
        self.lift();
        let arc = arc_between([self.at, to], radii, angle, [is_large, is_positive]);
        self.curves.push(PlaneCurve::Arc(arc).into());
        self.at = to;
        Some(())
    }
}

/// A flag, which is one digit and may stand before a number without a blank.
fn flag(rest: &mut &str) -> Option<bool> {
    let text = rest.trim_start();
    let text = text.strip_prefix(',').unwrap_or(text).trim_start();
    let digit = text.chars().next().filter(|c| ['0', '1'].contains(c))?;
    *rest = &text[1..];
    Some(digit == '1')
}

/// The arc of an ellipse between two points, by the map that makes the ellipse a unit circle; too
/// small an ellipse is enlarged (SVG 2, appendix B.2.4 and B.2.5).
fn arc_between(
    ends: [Vec2; 2],
    [rx, ry]: [f64; 2],
    angle: f64,
    [is_large, is_positive]: [bool; 2],
) -> EllipseArc {
    let turn = PlaneMap::turning(angle);
    let back = PlaneMap::scaling(rx.recip(), ry.recip()).after(&PlaneMap::turning(-angle));
    let [a, b] = ends.map(|end| back.vector(end));
    let half = (b - a) * 0.5;
    let scale = half.length().max(1.0);
    let height = (scale * scale - half.dot(half)).max(0.0).sqrt() / half.length();
    let way = if is_large == is_positive { -1.0 } else { 1.0 };
    let center = (a + b) * 0.5 + half.left() * (way * height);
    let [from, to] = [a, b].map(|p| (p - center).y.atan2((p - center).x));
    let sweep = (to - from).rem_euclid(TAU);
    let range = [from, if is_positive { from + sweep } else { from + sweep - TAU }];
    let radii = [turn.vector(vec2(rx * scale, 0.0)), turn.vector(vec2(0.0, ry * scale))];
    let forward = turn.after(&PlaneMap::scaling(rx, ry));
    EllipseArc { center: forward.point(center), radii, range }
}
