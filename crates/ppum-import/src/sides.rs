//! Curves of a chain made few and named: straight runs and arcs joined, sides told apart.

use ppum::segment;
use ppum::vec2::{Vec2, vec2};

use crate::chain::CurveChain;
use crate::curve::{EllipseArc, PlaneCurve};
use crate::sketch::NamedCurve;

/// Distance from a straight line, in parts of the size, at which a vertex is none.
const STRAIGHT: f64 = 1e-10;

/// Cosine of the turn at which a side ends: 20°.
const CORNER: f64 = 0.94;

/// Most sides that get names.
const MOST_SIDES: usize = 64;

impl CurveChain {
    /// Returns the sides with as few curves as names and kinds allow.
    pub(crate) fn tidied(mut self, size: f64) -> Self {
        if self.is_closed {
            self.begin_at_a_change();
        }
        let mut curves: Vec<NamedCurve> = Vec::new();
        for named in self.curves {
            if !curves.last_mut().is_some_and(|before| absorbs(before, &named, size)) {
                curves.push(named);
            }
        }
        for named in &mut curves {
            if let PlaneCurve::Polyline(points) = &mut named.curve {
                straighten(points, STRAIGHT * size);
            }
        }
        Self { curves, ..self }
    }

    /// Turns a closed chain so that it begins where name or kind change, or at a corner.
    fn begin_at_a_change(&mut self) {
        if let [NamedCurve { curve: PlaneCurve::Polyline(points), .. }] = &mut self.curves[..] {
            points.pop();
            let n = points.len();
            let cosine = |k: usize| cosine(points[(k + n - 1) % n], points[k], points[(k + 1) % n]);
            // the first one, if it is one of several
            let first = (0..n).find(|k| cosine(*k) < CORNER).unwrap_or(0);
            points.rotate_left(first);
            points.push(points[0]);
            return;
        }
        let kind = |named: &NamedCurve| (named.name.clone(), std::mem::discriminant(&named.curve));
        let n = self.curves.len();
        let changes = |k: &usize| kind(&self.curves[(k + n - 1) % n]) != kind(&self.curves[*k]);
        let first = (0..n).find(changes).or_else(|| {
            (0..n).find(|k| is_corner(&self.curves[(k + n - 1) % n], &self.curves[*k]))
        });
        self.curves.rotate_left(first.unwrap_or(0));
    }

    /// True if names tell its curves apart, or are the user's own.
    fn has_names(&self, is_layered: bool) -> bool {
        let first = &self.curves[0].name;
        let differ = self.curves.iter().any(|named| named.name != *first);
        differ || (first.is_some() && !is_layered)
    }

    /// Returns the sides without names, if these are one layer.
    pub(crate) fn without_layer(mut self, is_layered: bool) -> Self {
        if !self.has_names(is_layered) {
            self.curves.iter_mut().for_each(|named| named.name = None);
        }
        self
    }

    /// Returns the sides with a name for each run between corners, if it has no names of its own.
    pub(crate) fn with_sides(mut self, is_layered: bool) -> Self {
        if self.has_names(is_layered) {
            return self;
        }
        let curves: Vec<_> = self.curves.iter().flat_map(split_at_corners).collect();
        let n = curves.len();
        let begins = |k: usize| k == 0 || is_corner(&curves[k - 1], &curves[k]);
        let count = (0..n).filter(|k| begins(*k)).count();
        if count > MOST_SIDES {
            return self;
        }
        let mut number = 0;
        let name = |(k, named): (usize, &NamedCurve)| {
            number += usize::from(begins(k));
            let base = named.name.as_deref().unwrap_or("side");
            NamedCurve { name: Some(format!("{base}-{number}")), ..named.clone() }
        };
        self.curves = curves.iter().enumerate().map(name).collect();
        self
    }
}

/// Cosine of the turn at b.
fn cosine(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    (b - a).unit().dot((c - b).unit())
}

fn is_corner(before: &NamedCurve, after: &NamedCurve) -> bool {
    let (before, after) = (before.curve.edges(), after.curve.edges());
    let [_, end] = before[before.len() - 1].end_tangents();
    end.dot(after[0].end_tangents()[0]) < CORNER
}

fn split_at_corners(named: &NamedCurve) -> Vec<NamedCurve> {
    let PlaneCurve::Polyline(points) = &named.curve else { return vec![named.clone()] };
    let mut runs = vec![vec![points[0]]];
    for (k, point) in points.iter().enumerate().skip(1) {
        runs.last_mut().into_iter().for_each(|run| run.push(*point));
        if k + 1 < points.len() && cosine(points[k - 1], *point, points[k + 1]) < CORNER {
            runs.push(vec![*point]);
        }
    }
    let part = |run| NamedCurve { curve: PlaneCurve::Polyline(run), ..named.clone() };
    runs.into_iter().map(part).collect()
}

/// Lengthens a curve by the next one, if both have one name and are one curve.
fn absorbs(before: &mut NamedCurve, after: &NamedCurve, size: f64) -> bool {
    if before.name != after.name {
        return false;
    }
    match (&mut before.curve, &after.curve) {
        (PlaneCurve::Polyline(a), PlaneCurve::Polyline(b)) => a.extend(&b[1..]),
        (PlaneCurve::Arc(a), PlaneCurve::Arc(b)) => match merged_arcs(a, b, size) {
            Some(arc) => *a = arc,
            None => return false,
        },
        _ => return false,
    }
    true
}

/// The arc that two of one ellipse make: the radii of the second one are those of a unit circle in
/// the radii of the first one. A whole turn is one exactly.
fn merged_arcs(a: &EllipseArc, b: &EllipseArc, size: f64) -> Option<EllipseArc> {
    use std::f64::consts::TAU;
    let [p, q] = a.radii;
    let own = |v: Vec2| vec2(v.cross(q), p.cross(v)) / p.cross(q);
    let [u, v] = b.radii.map(own);
    let misfits =
        [u.length() - 1.0, v.length() - 1.0, u.dot(v), (a.center - b.center).length() / size];
    let turn = a.range[1] - a.range[0] + u.cross(v).signum() * (b.range[1] - b.range[0]);
    let is_whole = (turn.abs() - TAU).abs() < 1e-9;
    let turn = if is_whole { turn.signum() * TAU } else { turn };
    let is_one =
        misfits.iter().all(|misfit| misfit.abs() < 1e-9) && turn != 0.0 && turn.abs() <= TAU;
    is_one.then_some(EllipseArc { range: [a.range[0], a.range[0] + turn], ..*a })
}

/// Takes out the inner vertices that lie on the line of the ones beside them.
fn straighten(points: &mut Vec<Vec2>, distance: f64) {
    let all = std::mem::take(points);
    for (k, point) in all.iter().enumerate() {
        let is_on_line = points.last().zip(all.get(k + 1)).is_some_and(|(before, after)| {
            segment::distance([*before, *after], *point) <= distance
        });
        if !is_on_line {
            points.push(*point);
        }
    }
}
