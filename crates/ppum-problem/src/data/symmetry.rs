//! Half models: a crack on a straight line of the boundary, about which the whole body is mirrored.
//!
//! A symmetric field u, mirrored about the line y = 0, is determined by its upper half:
//!
//! ```text
//! symmetric       u_x(x, −y) = u_x(x, y)     u_y(x, −y) = −u_y(x, y)     on the line u_y = 0, t_x = 0
//! antisymmetric   u_x(x, −y) = −u_x(x, y)    u_y(x, −y) = u_y(x, y)      on the line u_x = 0, t_y = 0
//! ```
//!
//! On a crack that lies on the line neither holds: there the boundary is a face of the crack. The
//! end of the crack between two corners of the body is a tip, the one at a corner a mouth.

use std::f64::consts::{PI, TAU};

use ppum::border::BorderLine;
use ppum::border::touch;
use ppum::crack::TipId;
use ppum::edge::Edge;
use ppum::segment::Segment;
use ppum::vec2::Vec2;

use super::{BoundaryCondition, BoundaryPart, Condition, DomainEdge, ProblemData};
use crate::geometry::without;

/// Sine of angles that are rounding.
const ROUNDING: f64 = 1e-6;

/// Symmetry of a field to a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// A crack or wedge on the line opens; a potential is even.
    Symmetric,
    /// The sides of a crack or wedge on the line slide; a potential is odd.
    Antisymmetric,
}

impl BoundaryCondition {
    /// A symmetry, or an antisymmetry, to a straight part of the boundary with this normal.
    #[must_use]
    pub fn symmetry_on(on: BoundaryPart, normal: Vec2, symmetry: Symmetry) -> Self {
        let is_oblique = normal.x != 0.0 && normal.y != 0.0;
        let is_across = is_oblique || normal.x != 0.0;
        let condition = |across: bool| match across == (symmetry == Symmetry::Symmetric) {
            true => Condition::Dirichlet(0.0.into()),
            false => Condition::Free,
        };
        let new = Self::new(on, vec![condition(is_across), condition(!is_across)]);
        Self { axis: if is_oblique { normal } else { new.axis }, ..new }
    }

    /// The symmetry to a line with this normal that it says, where it holds.
    fn symmetry_to(&self, normal: Vec2) -> Option<Symmetry> {
        let [x, y] = self.components.as_slice() else { return None };
        let is_zero = |condition: &Condition| match condition {
            Condition::Dirichlet(g) => g.constant() == Some(0.0),
            _ => false,
        };
        let is_free = |condition: &Condition| match condition {
            Condition::Neumann(t) => t.constant() == Some(0.0),
            condition => *condition == Condition::Free,
        };
        let [first, second] = self.axes().map(|axis| axis.dot(normal).abs());
        let [across, along] = if second > first { [y, x] } else { [x, y] };
        match () {
            () if first.min(second) > ROUNDING => None,
            () if is_zero(across) && is_free(along) => Some(Symmetry::Symmetric),
            () if is_free(across) && is_zero(along) => Some(Symmetry::Antisymmetric),
            () => None,
        }
    }
}

impl ProblemData {
    /// The cracks that lie on straight lines of the boundary.
    pub(crate) fn border_cracks(&self) -> impl Iterator<Item = (usize, BorderLine)> {
        (0..self.cracks().len()).filter_map(|crack| Some((crack, self.body.line_of(crack)?)))
    }

    /// The edges, segments and arcs, of the boundary that a part of it consists of; none of circles
    /// and cracks.
    pub fn edges_of(&self, part: BoundaryPart) -> impl Iterator<Item = Edge> {
        self.sides_of(part).into_iter().map(|(edge, _)| edge)
    }

    /// These edges, with the holes of their rims.
    pub(crate) fn sides_of(&self, part: BoundaryPart) -> Vec<(Edge, Option<usize>)> {
        if let BoundaryPart::Edge { edge, from, to } = part {
            let ends = [from, to].map(|s| edge.point(&self.domain().bounds, s));
            return vec![(Edge::segment(ends), None)];
        }
        let holes = self.domain().holes.iter().enumerate();
        let own = holes.flat_map(|(k, hole)| {
            let sides = hole.edges().enumerate();
            sides.filter(move |(side, _)| self.is_on(part, k, *side)).map(move |s| (s.1, Some(k)))
        });
        own.collect()
    }

    /// True if some of a part of the boundary lies on a line of it.
    pub(crate) fn meets_line(&self, part: BoundaryPart, line: &BorderLine) -> bool {
        let touch = touch(&self.domain().bounds);
        self.edges_of(part).any(|edge| lies_on(edge, line, touch))
    }

    /// The symmetry to a line of the boundary that a condition on it says.
    pub(crate) fn symmetry_on(
        &self,
        condition: &BoundaryCondition,
        line: &BorderLine,
    ) -> Option<Symmetry> {
        let touch = touch(&self.domain().bounds);
        let mut edges = self.edges_of(condition.on).peekable();
        edges.peek()?;
        let is_on = edges.all(|edge| lies_on(edge, line, touch));
        condition.symmetry_to(line.outward()).filter(|_| is_on)
    }

    /// The symmetry of the field at a tip on the boundary: that of the line ahead of it.
    pub fn symmetry_at(&self, tip: TipId) -> Option<Symmetry> {
        let (crack, touch) = (tip.crack as usize, touch(&self.domain().bounds));
        let line = self.body.line_of(crack)?;
        let (at, axis) = (
            self.cracks()[crack].end_point(tip.end),
            self.cracks()[crack].growth_direction(tip.end),
        );
        let ahead = [2.0 * touch, 4.0 * touch].map(|step| at + axis * step);
        let holds = |edge: Edge| ahead.iter().all(|p| edge.distance(*p) < touch);
        let is_ahead = |condition: &&BoundaryCondition| self.edges_of(condition.on).any(holds);
        self.symmetry_on(self.boundary.iter().find(is_ahead)?, &line)
    }

    /// The symmetry of the field at a crack on an edge.
    pub(crate) fn symmetry_of(&self, crack: usize) -> Option<Symmetry> {
        let ends = self.cracks()[crack].tips();
        let mut tips = ends.map(|end| TipId { crack: crack as u32, end });
        tips.find_map(|tip| self.symmetry_at(tip))
    }

    /// True if the faces of cracks and symmetries of some kinds fill a line of the boundary.
    fn is_along(&self, line: &BorderLine, is_of_kind: impl Fn(Symmetry) -> bool) -> bool {
        let is_held =
            |one: &&BoundaryCondition| self.symmetry_on(one, line).is_some_and(&is_of_kind);
        let held = self.boundary.iter().filter(is_held);
        let held = held.flat_map(|condition| self.edges_of(condition.on));
        let mut parts: Vec<[f64; 2]> = held
            .chain(self.faces_along(line))
            .map(|edge| [edge.from, edge.to].map(|p| line.coordinate(p)))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let touch = touch(&self.domain().bounds);
        let filled = |reach: f64, [a, b]: [f64; 2]| {
            if a <= reach + touch { reach.max(b) } else { reach }
        };
        parts.into_iter().fold(0.0, filled) >= line.length() - touch
    }

    /// The faces of cracks on a line of the boundary.
    pub(crate) fn faces_along(&self, line: &BorderLine) -> impl Iterator<Item = Edge> {
        let own = self.border_cracks().filter(move |(_, own)| own == line);
        own.flat_map(|(crack, _)| self.cracks()[crack].edges())
    }

    /// The parts of a part of the boundary on a line that are no faces of cracks.
    pub fn parts_beside_faces(&self, part: BoundaryPart, line: &BorderLine) -> Vec<Segment> {
        let ranges = |edge: Edge| [edge.from, edge.to].map(|p| line.coordinate(p));
        let faces: Vec<[f64; 2]> = self.faces_along(line).map(ranges).collect();
        let [direction, start] = [line.direction(), line.ends[0]];
        let beside = |edge: Edge| {
            let [a, b] = ranges(edge);
            let all = without([a.min(b), a.max(b)], &faces).into_iter();
            all.map(move |range| range.map(|s| start + direction * s))
        };
        self.edges_of(part).filter(|edge| !edge.is_arc()).flat_map(beside).collect()
    }

    /// The lines of the body's boundary on an edge of the box around it.
    pub(crate) fn lines_on(&self, edge: DomainEdge) -> Vec<BorderLine> {
        let (touch, normal) = (touch(&self.domain().bounds), edge.normal());
        let at = edge.point(&self.domain().body_bounds(), 0.0);
        let is_on = |line: &BorderLine| {
            let [a, b] = line.ends.map(|p| normal.dot(p - at).abs());
            let is_outer = line.hole.is_none() || line.hole == self.domain().outline();
            a.max(b) <= touch && line.outward().dot(normal) > 0.0 && is_outer
        };
        self.domain().border_lines().filter(is_on).collect()
    }

    /// The edges of the box around the body beyond which it may be mirrored: those that have one
    /// symmetry from corner to corner, except for the faces of cracks. Two opposite edges count as
    /// one, the left or the lower.
    #[must_use]
    pub fn mirrors(&self) -> Vec<(DomainEdge, Symmetry)> {
        let symmetry = |edge: DomainEdge| {
            let lines = self.lines_on(edge);
            let is_of = |kind: &Symmetry| {
                let is_along = |line| self.is_along(line, |own| own == *kind);
                lines.iter().all(is_along)
                    && !lines.iter().all(|line| self.is_along(line, |_| false))
            };
            let kind = [Symmetry::Symmetric, Symmetry::Antisymmetric].into_iter().find(is_of)?;
            Some((edge, kind))
        };
        let pairs = [[DomainEdge::Left, DomainEdge::Right], [DomainEdge::Bottom, DomainEdge::Top]];
        pairs.into_iter().filter_map(|pair| pair.into_iter().find_map(symmetry)).collect()
    }

    /// The number of images of a body with a crack on a line of symmetry that make the whole: 2 of
    /// a half, 4 of a quarter, 2π/ω of a wedge between two lines at an angle ω. None of other
    /// bodies, and where images do not make a whole.
    pub fn images(&self) -> Option<f64> {
        let (_, first) = self.border_cracks().next()?;
        let axis = self.axis_lines();
        let is_mirror = |line: &BorderLine| !axis.contains(line) && self.is_along(line, |_| true);
        let normal = first.outward();
        let angle = |line: BorderLine| {
            let other = line.outward();
            PI - normal.cross(other).atan2(normal.dot(other)).abs()
        };
        is_mirror(&first).then_some(())?;
        let all = self.domain().border_lines().filter(is_mirror).map(angle);
        let least =
            all.filter(|angle| *angle > ROUNDING && *angle < PI - ROUNDING).fold(PI, f64::min);
        let count = TAU / least;
        ((count - count.round()).abs() < ROUNDING).then_some(count.round())
    }

    /// The line with a crack, or on the axis of a body of revolution, to which a condition says a
    /// symmetry: fields satisfy it exactly.
    pub fn exact_line(&self, condition: &BoundaryCondition) -> Option<BorderLine> {
        let mut lines = self.border_cracks().map(|(_, line)| line).chain(self.axis_lines());
        lines.find(|line| self.symmetry_on(condition, line).is_some())
    }
}

/// True if an edge lies on a line of the boundary.
fn lies_on(edge: Edge, line: &BorderLine, touch: f64) -> bool {
    !edge.is_arc() && [edge.from, edge.to].iter().all(|p| line.holds(*p, touch))
}
