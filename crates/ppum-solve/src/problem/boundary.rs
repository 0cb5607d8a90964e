//! Conditions on the border of the box.

use ppum::vec2::{Rect, Vec2, vec2};

use ppum::expression::Expression;

/// An edge of the box Ω.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// x = min.
    Left,
    /// x = max.
    Right,
    /// y = min.
    Bottom,
    /// y = max.
    Top,
}

impl Edge {
    /// All edges.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Bottom, Self::Top];

    /// Name in problem files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Bottom => "bottom",
            Self::Top => "top",
        }
    }

    /// The edge of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|edge| edge.name() == name)
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
        match self {
            Self::Left | Self::Right => [domain.min.y, domain.max.y],
            Self::Bottom | Self::Top => [domain.min.x, domain.max.x],
        }
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
        match self {
            Self::Left => p.x - domain.min.x,
            Self::Right => domain.max.x - p.x,
            Self::Bottom => p.y - domain.min.y,
            Self::Top => domain.max.y - p.y,
        }
    }
}

/// Conditions on a piece of an edge. Pieces may overlap where they speak of different components;
/// a component of which nothing is said anywhere is free of traction (of flux).
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryCondition {
    /// The edge.
    pub edge: Edge,
    /// Start of the piece in the edge's own coordinate, see [`Edge::range`].
    pub from: f64,
    /// End of the piece, larger than `from`.
    pub to: f64,
    /// One condition a component of the unknown field.
    pub components: Vec<Condition>,
}

/// The condition on one component of the unknown field.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Nothing is said of this component here.
    Free,
    /// The component itself: u_k = g.
    Dirichlet(Expression),
    /// The traction (σ n)_k, or for Poisson the flux κ ∂u/∂n into the plate; n points outwards.
    Neumann(Expression),
}

impl BoundaryCondition {
    /// Conditions on a whole edge.
    #[must_use]
    pub fn on_edge(edge: Edge, domain: &Rect, components: Vec<Condition>) -> Self {
        let [from, to] = edge.range(domain);
        Self { edge, from, to, components }
    }
}
