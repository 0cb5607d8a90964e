//! Conditions on the boundary: edges of the box, rims of holes, faces of cracks.

use std::fmt;

use ppum::border::BorderLine;
use ppum::crack::Side;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::expression::Expression;
use ppum::vec2::{Rect, Vec2, vec2};

use super::{Keyword, word_table};

/// An edge of the box Ω.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DomainEdge {
    /// x = min.
    Left,
    /// x = max.
    Right,
    /// y = min.
    Bottom,
    /// y = max.
    Top,
}

impl DomainEdge {
    /// All edges.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Bottom, Self::Top];

    /// Name in problem files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.word()
    }

    /// The edge of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|edge| edge.name() == name)
    }

    /// The edge that a line of the boundary is.
    pub fn of_line(line: &BorderLine) -> Option<Self> {
        Self::ALL.into_iter().find(|edge| line.hole.is_none() && edge.normal() == line.outward())
    }

    /// Unit normal that points out of the box.
    #[must_use]
    pub fn normal(self) -> Vec2 {
        match self {
            Self::Left => vec2(-1.0, 0.0),
            Self::Right => vec2(1.0, 0.0),
            Self::Bottom => vec2(0.0, -1.0),
            Self::Top => vec2(0.0, 1.0),
        }
    }

    /// The range of the edge's own coordinate: y on the left and right, x at the bottom and top.
    #[must_use]
    pub fn range(self, domain: &Rect) -> [f64; 2] {
        [domain.min, domain.max].map(|p| self.coordinate(p))
    }

    /// The edge's own coordinate of a point.
    #[must_use]
    pub fn coordinate(self, p: Vec2) -> f64 {
        if self.normal().x == 0.0 { p.x } else { p.y }
    }

    /// The point of the edge with own coordinate `s`.
    #[must_use]
    pub fn point(self, domain: &Rect, s: f64) -> Vec2 {
        match self {
            Self::Left => vec2(domain.min.x, s),
            Self::Right => vec2(domain.max.x, s),
            Self::Bottom => vec2(s, domain.min.y),
            Self::Top => vec2(s, domain.max.y),
        }
    }

    /// Distance of `p` to the line of the edge, positive inside the box.
    #[must_use]
    pub fn depth(self, domain: &Rect, p: Vec2) -> f64 {
        self.normal().dot(self.point(domain, self.coordinate(p)) - p)
    }
}

word_table!(DomainEdge: Left "left", Right "right", Bottom "bottom", Top "top");

/// The word for the whole outline of the body.
pub(crate) const OUTLINE: &str = "outline";

/// A part of the boundary of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoundaryPart {
    /// A piece of an edge of the box; what lies in holes does not count.
    Edge {
        /// The edge.
        edge: DomainEdge,
        /// Start of the piece in the edge's own coordinate, see [`DomainEdge::range`].
        from: f64,
        /// End of the piece, larger than `from`.
        to: f64,
    },
    /// The rim of a hole, by its index; that of the hole around the outline is the outline.
    Hole(usize),
    /// Some sides of the rim of a hole.
    Sides(BoundaryRange),
    /// A piece of rims that has a name, by its index in [`Problem::pieces`].
    ///
    /// [`Problem::pieces`]: super::ProblemData::pieces
    Piece(usize),
    /// A face of a crack, or both.
    Crack {
        /// Index of the crack.
        crack: usize,
        /// The face of the material on this side; both if none is named.
        face: Option<Side>,
    },
}

impl BoundaryPart {
    /// A whole edge.
    #[must_use]
    pub fn edge(edge: DomainEdge, domain: &Rect) -> Self {
        let [from, to] = edge.range(domain);
        Self::Edge { edge, from, to }
    }

    /// The part that two that meet have in common; of pieces of rims one of them.
    pub(crate) fn common(self, other: Self) -> Self {
        match (self, other) {
            (Self::Edge { edge, from: a, to: b }, Self::Edge { from: c, to: d, .. }) => {
                Self::Edge { edge, from: a.max(c), to: b.min(d) }
            }
            (Self::Crack { crack, face }, Self::Crack { face: other, .. }) => {
                Self::Crack { crack, face: face.or(other) }
            }
            (Self::Hole(_), part) | (part, _) => part,
        }
    }
}

/// Sides of rims with a name, on which conditions may be given.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryPiece {
    /// The name; different ones are different.
    pub name: String,
    /// Where it is; no two runs have a side in common, except for parts of other pieces.
    pub runs: Vec<BoundaryRange>,
}

/// Successive sides of the polygon around a hole, as [`Hole::edges`] counts them.
///
/// [`Hole::edges`]: ppum::domain::Hole::edges
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryRange {
    /// Index of the hole.
    pub hole: usize,
    /// Number of the first side.
    pub from: usize,
    /// Number of the side after the last one.
    pub to: usize,
}

impl BoundaryRange {
    /// Its sides, of its hole.
    pub(crate) fn edges(self, hole: &Hole) -> impl Iterator<Item = Edge> + '_ {
        hole.edges().take(self.to).skip(self.from)
    }

    /// True if a side of a hole belongs to it.
    pub fn holds(self, hole: usize, side: usize) -> bool {
        self.hole == hole && (self.from..self.to).contains(&side)
    }
}

impl fmt::Display for BoundaryPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Edge { edge, from, to } => {
                write!(f, "the {} edge between {from} and {to}", edge.name())
            }
            Self::Hole(hole) => write!(f, "the rim of hole {hole}"),
            Self::Sides(BoundaryRange { hole, from, to }) => {
                write!(f, "the sides {from} to {} of hole {hole}", to - 1)
            }
            Self::Piece(piece) => write!(f, "piece {piece}"),
            Self::Crack { crack, face: None } => write!(f, "the faces of crack {crack}"),
            Self::Crack { crack, face: Some(side) } => {
                write!(f, "the face of crack {crack} {} it", side.word())
            }
        }
    }
}

/// Conditions on a part of the boundary. Parts may overlap where they speak of different
/// components; a component of which nothing is said anywhere is free of traction (of flux).
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryCondition {
    /// The place.
    pub on: BoundaryPart,
    /// One condition per component of the unknown field.
    pub components: Vec<Condition>,
    /// The unit vector along which the first component is; the second is along that to its left.
    /// It is that of x except for a symmetry to an oblique line.
    pub axis: Vec2,
    /// A pressure p: the traction −p n, n pointing out of the material. It says all components.
    pub pressure: Option<Expression>,
    /// A coefficient h > 0: values that are given are those of the surroundings, to which the field
    /// yields, κ ∂u/∂n = h (g − u), n pointing out of the material.
    pub exchange: Option<Expression>,
}

/// The condition on one component of the unknown field.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Nothing is said of this component here.
    Free,
    /// The component itself: u_k = g.
    Dirichlet(Expression),
    /// The traction (σ n)_k, or for Poisson the flux κ ∂u/∂n into the body; n points outwards.
    Neumann(Expression),
}

impl BoundaryCondition {
    /// Conditions on a part of the boundary, one per component.
    #[must_use]
    pub fn new(on: BoundaryPart, components: Vec<Condition>) -> Self {
        Self { on, components, axis: vec2(1.0, 0.0), pressure: None, exchange: None }
    }

    /// A pressure on a part of the boundary of an elastic body.
    #[must_use]
    pub fn pressure(on: BoundaryPart, pressure: Expression) -> Self {
        Self { pressure: Some(pressure), ..Self::new(on, vec![Condition::Free; 2]) }
    }

    /// Conditions on a whole edge.
    #[must_use]
    pub fn on_edge(edge: DomainEdge, domain: &Rect, components: Vec<Condition>) -> Self {
        Self::new(BoundaryPart::edge(edge, domain), components)
    }

    /// True if something is said of a component; along oblique axes it is of both.
    pub(crate) fn says(&self, component: usize) -> bool {
        let is_free = self.components[component] == Condition::Free;
        self.pressure.is_some() || !is_free || self.is_oblique()
    }

    fn is_oblique(&self) -> bool {
        self.axis.y != 0.0
    }

    /// The direction along which a value is given, if it is oblique.
    pub(crate) fn oblique_axis(&self) -> Option<Vec2> {
        held_directions(self.fixed(), self.axes()).next().filter(|_| self.is_oblique())
    }

    /// The directions of the components.
    pub fn axes(&self) -> [Vec2; 2] {
        [self.axis, self.axis.left()]
    }

    /// Returns for x and y whether a direction with a component along that axis is held.
    pub fn coordinates_of(&self, held: [bool; 2]) -> [bool; 2] {
        if self.is_oblique() { [held.contains(&true); 2] } else { held }
    }

    /// Returns for each component whether the field takes a given value exactly, which excludes an
    /// exchange.
    pub fn fixed(&self) -> [bool; 2] {
        self.held().map(|is_held| is_held && self.exchange.is_none())
    }

    /// Returns for each component whether its value is given.
    pub fn held(&self) -> [bool; 2] {
        let is_held = |c: &Condition| matches!(c, Condition::Dirichlet(_));
        let mut held = [false; 2];
        held.iter_mut().zip(&self.components).for_each(|(held, c)| *held = is_held(c));
        held
    }

    /// The formulas of what it gives.
    pub fn formulas(&self) -> impl Iterator<Item = &Expression> {
        let given = self.components.iter().filter_map(|component| match component {
            Condition::Neumann(given) | Condition::Dirichlet(given) => Some(given),
            Condition::Free => None,
        });
        given.chain(&self.pressure).chain(&self.exchange)
    }

    /// The coefficient h of the exchange at a point, zero if there is none.
    pub fn exchange_at(&self, x: Vec2) -> f64 {
        self.exchange.as_ref().map_or(0.0, |exchange| exchange.value(x))
    }

    /// The tractions (fluxes) at a point, zero where a value is given.
    pub fn loads(&self, x: Vec2, normal: Vec2) -> [f64; 2] {
        let (held, values) = (self.held(), self.values(x, normal));
        in_plane([0, 1].map(|k| if held[k] { 0.0 } else { values[k] }), self.axes())
    }

    /// The given values and tractions (fluxes), along the axes, at a point with the normal out of
    /// the material; zero where nothing is said.
    pub fn values(&self, x: Vec2, normal: Vec2) -> [f64; 2] {
        if let Some(pressure) = &self.pressure {
            return (-normal * pressure.value(x)).into();
        }
        let mut values = [0.0; 2];
        for (value, component) in values.iter_mut().zip(&self.components) {
            *value = match component {
                Condition::Free => 0.0,
                Condition::Dirichlet(g) | Condition::Neumann(g) => g.value(x),
            };
        }
        values
    }
}

/// The vector of components along axes.
pub fn in_plane([first, second]: [f64; 2], axes: [Vec2; 2]) -> [f64; 2] {
    (axes[0] * first + axes[1] * second).into()
}

/// The axes along which values are given.
pub fn held_directions(held: [bool; 2], axes: [Vec2; 2]) -> impl Iterator<Item = Vec2> + Clone {
    axes.into_iter().zip(held).filter(|(_, is_held)| *is_held).map(|(axis, _)| axis)
}
