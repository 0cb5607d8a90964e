//! Half models: a crack on an edge, about which the whole body is mirrored.
//!
//! Of a symmetric field u, mirrored about the line y = 0, the upper half is all there is to know:
//!
//! ```text
//! symmetric       u_x(x, −y) = u_x(x, y)     u_y(x, −y) = −u_y(x, y)     on the line u_y = 0, t_x = 0
//! antisymmetric   u_x(x, −y) = −u_x(x, y)    u_y(x, −y) = u_y(x, y)      on the line u_x = 0, t_y = 0
//! ```
//!
//! On a crack that lies on the line neither holds: there the edge is a face of the crack. The end
//! of the crack between two corners of the box is a tip, the one at a corner a mouth.

use ppum::crack::TipId;
use ppum::vec2::{Rect, Vec2};

use super::boundary::{BorderPart, BoundaryCondition, Condition, Edge};
use super::cracks::{edge_along, touch};
use super::model::Problem;

/// Symmetry of a field to a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// A crack or wedge on the line opens; a potential is even.
    Symmetric,
    /// The sides of a crack or wedge on the line slide; a potential is odd.
    Antisymmetric,
}

impl BoundaryCondition {
    /// A symmetry, or an antisymmetry, to a straight part of the border with this normal.
    #[must_use]
    pub fn symmetry_on(on: BorderPart, normal: Vec2, symmetry: Symmetry) -> Self {
        let is_oblique = normal.x != 0.0 && normal.y != 0.0;
        let is_across = is_oblique || normal.x != 0.0;
        let condition = |across: bool| match across == (symmetry == Symmetry::Symmetric) {
            true => Condition::Dirichlet(0.0.into()),
            false => Condition::Free,
        };
        let new = Self::new(on, vec![condition(is_across), condition(!is_across)]);
        Self { axis: if is_oblique { normal } else { new.axis }, ..new }
    }

    /// The symmetry to its edge that it says; none of other conditions.
    pub(crate) fn symmetry(&self) -> Option<Symmetry> {
        match self.on {
            BorderPart::Edge { edge, .. } => self.symmetry_to(edge.normal()),
            _ => None,
        }
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
            () if is_zero(across) && is_free(along) => Some(Symmetry::Symmetric),
            () if is_free(across) && is_zero(along) => Some(Symmetry::Antisymmetric),
            () => None,
        }
    }
}

impl Problem {
    /// The edge that a crack lies on.
    pub(crate) fn edge_of(&self, crack: usize) -> Option<Edge> {
        edge_along(&self.cracks[crack].points, &self.domain.bounds, 0.0)
    }

    /// The parts of an edge, in its own coordinate, that are faces of cracks.
    pub(crate) fn faces_on(&self, edge: Edge) -> impl Iterator<Item = [f64; 2]> {
        let on_edge = (0..self.cracks.len()).filter(move |&k| self.edge_of(k) == Some(edge));
        on_edge.map(move |k| {
            let along = self.cracks[k].points.iter().map(|p| edge.coordinate(*p));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], s| [a.min(s), b.max(s)])
        })
    }

    /// The problem whose symmetries leave out the faces of cracks on edges, as they must before it
    /// is solved. Files are read so, and [`Problem::with_crack`] and [`Problem::with_boundary`] see
    /// to it; others who change cracks or conditions must.
    #[must_use]
    pub fn with_free_faces(mut self) -> Self {
        if (0..self.cracks.len()).any(|k| self.edge_of(k).is_some()) {
            let all = std::mem::take(&mut self.boundary);
            self.boundary =
                all.into_iter().flat_map(|condition| self.beside_faces(condition)).collect();
        }
        self
    }

    /// The parts of a symmetry beside the faces of cracks; other conditions as they are.
    fn beside_faces(&self, condition: BoundaryCondition) -> Vec<BoundaryCondition> {
        let BorderPart::Edge { edge, from, to } = condition.on else { return vec![condition] };
        if condition.symmetry().is_none() {
            return vec![condition];
        }
        let mut parts = vec![[from, to]];
        for [a, b] in self.faces_on(edge) {
            let beside = |[from, to]: [f64; 2]| [[from, to.min(a)], [from.max(b), to]];
            parts = parts.into_iter().flat_map(beside).filter(|[from, to]| from < to).collect();
        }
        let part = |[from, to]: [f64; 2]| BoundaryCondition {
            on: BorderPart::Edge { edge, from, to },
            ..condition.clone()
        };
        parts.into_iter().map(part).collect()
    }

    /// The symmetry of the field at a tip on an edge: that of the edge ahead of it.
    pub(crate) fn symmetry_at(&self, tip: TipId) -> Option<Symmetry> {
        let (crack, touch) = (tip.crack as usize, touch(&self.domain.bounds));
        let edge = self.edge_of(crack)?;
        let (at, axis) =
            (self.cracks[crack].end_point(tip.end), self.cracks[crack].growth_direction(tip.end));
        let ahead = [touch, 4.0 * touch].map(|step| edge.coordinate(at + axis * step));
        let holds = |condition: &&BoundaryCondition| match condition.on {
            BorderPart::Edge { edge: own, from, to } => {
                own == edge && ahead.iter().all(|s| from <= *s && *s <= to)
            }
            _ => false,
        };
        self.boundary.iter().find(holds).and_then(BoundaryCondition::symmetry)
    }

    /// The symmetry of the field at a crack on an edge.
    pub(crate) fn symmetry_of(&self, crack: usize) -> Option<Symmetry> {
        let ends = self.cracks[crack].tips();
        let mut tips = ends.map(|end| TipId { crack: crack as u32, end });
        tips.find_map(|tip| self.symmetry_at(tip))
    }

    /// True if the faces of cracks and symmetries of some kinds fill an edge.
    fn is_along(&self, edge: Edge, is_of_kind: impl Fn(Symmetry) -> bool) -> bool {
        let [from, to] = edge.range(&self.domain.bounds);
        let of_condition = |condition: &BoundaryCondition| match condition.on {
            BorderPart::Edge { edge: own, from, to } if own == edge => {
                condition.symmetry().filter(|kind| is_of_kind(*kind)).map(|_| to - from)
            }
            _ => None,
        };
        let held: f64 = self.boundary.iter().filter_map(of_condition).sum();
        let faces: f64 = self.faces_on(edge).map(|[from, to]| to - from).sum();
        held + faces >= (to - from) - touch(&self.domain.bounds)
    }

    /// The symmetry that all sides of the outline on a line along an edge have.
    fn symmetry_of_sides(&self, edge: Edge, line: f64) -> Option<Symmetry> {
        let (touch, normal) = (touch(&self.domain.bounds), edge.normal());
        let hole = self.domain.outline()?;
        let is_on = |p: &Vec2| (normal.dot(*p) - line).abs() <= touch;
        let sides = self.domain.holes[hole].sides().enumerate();
        let on_line = sides.filter(|(_, ends)| ends.iter().all(is_on)).map(|(side, _)| side);
        let symmetry = |side: usize| {
            let here = self.boundary.iter().filter(|one| self.is_on(one.on, hole, side));
            here.filter_map(|one| one.symmetry_to(normal)).next()
        };
        let mut all = on_line.map(symmetry);
        let first = all.next()??;
        all.all(|other| other == Some(first)).then_some(first)
    }

    /// The edges of the box around the body beyond which it may be mirrored: those that have one
    /// symmetry from corner to corner, but for the faces of cracks. Of two opposite edges the left
    /// or the lower one.
    #[must_use]
    pub fn mirrors(&self) -> Vec<(Edge, Symmetry)> {
        let body = self.domain.body_bounds();
        let of_box = |edge: Edge| {
            let kinds = [Symmetry::Symmetric, Symmetry::Antisymmetric].into_iter();
            let mut kinds = kinds.filter(|kind| self.is_along(edge, |own| own == *kind));
            let has_faces_alone = self.is_along(edge, |_| false);
            kinds.next().filter(|_| !has_faces_alone)
        };
        let symmetry = |edge: Edge| {
            let line = |around: &Rect| edge.normal().dot(edge.point(around, 0.0));
            let kind = match line(&body) == line(&self.domain.bounds) {
                true => of_box(edge),
                false => self.symmetry_of_sides(edge, line(&body)),
            };
            kind.map(|kind| (edge, kind))
        };
        let pairs = [[Edge::Left, Edge::Right], [Edge::Bottom, Edge::Top]];
        pairs.into_iter().filter_map(|pair| pair.into_iter().find_map(symmetry)).collect()
    }

    /// The number of images of a plate with a crack on an edge that make the whole: 2 of a half, 4
    /// of a quarter. None of other plates.
    pub(crate) fn images(&self) -> Option<f64> {
        (0..self.cracks.len()).find(|&k| self.edge_of(k).is_some())?;
        let pairs = [[Edge::Left, Edge::Right], [Edge::Bottom, Edge::Top]];
        let is_mirror = |edge: &Edge| self.is_along(*edge, |_| true);
        let mirrored = pairs.into_iter().filter(|pair| pair.iter().any(is_mirror)).count();
        Some([1.0, 2.0, 4.0][mirrored])
    }

    /// True of a symmetry that fields satisfy exactly: that of an edge with a crack.
    pub(crate) fn is_exact(&self, condition: &BoundaryCondition) -> bool {
        let BorderPart::Edge { edge, .. } = condition.on else { return false };
        condition.symmetry().is_some() && self.faces_on(edge).next().is_some()
    }
}
