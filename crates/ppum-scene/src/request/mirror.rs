//! The whole of a body of which a dataset holds one half or a quarter.
//!
//! The body is mirrored at edges of the box around it, and its field repeated beyond them,
//! symmetric or antisymmetric ([`Reflection`](ppum::quantity::Reflection)). An image of the whole
//! has the pixels of the body itself, and where the body is not those of the reflected view: there
//! the field is evaluated at the reflected centre of each pixel, so that nothing is interpolated.

use std::fmt;
use std::str::FromStr;

use ppum::dataset::Dataset;
use ppum::domain::Domain;
use ppum::vec2::{Rect, Vec2, vec2};

/// The edges at which the body is mirrored: written `auto`, `none`, or as a list with commas
/// between.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mirror {
    /// Beyond the edges whose symmetry the dataset knows.
    Auto,
    /// Beyond these, at most one of left and right and one of bottom and top; `none` without any.
    Edges(Vec<MirrorEdge>),
}

/// An edge beyond which a body is mirrored: written `bottom`, or `bottom:antisymmetric`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MirrorEdge {
    /// The edge.
    pub edge: BoxEdge,
    /// True for an antisymmetric field.
    pub is_odd: bool,
}

/// An edge of the box around the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoxEdge {
    /// x = min.
    Left,
    /// x = max.
    Right,
    /// y = min.
    Bottom,
    /// y = max.
    Top,
}

/// The reason why the whole cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MirrorError {
    /// No symmetry that the dataset knows.
    #[error(
        "mirror: the dataset does not say which edge of the box around the body is a line of \
         symmetry, and at oblique lines nothing is mirrored; name an edge, as `bottom`, \
         `bottom,left` or `bottom:antisymmetric`"
    )]
    Unknown,
    /// An edge of the box that the body does not reach.
    #[error(
        "mirror: the body does not reach the {0} edge of its box; lines of symmetry are edges of the box around the body"
    )]
    Away(&'static str),
    /// A difference.
    #[error("mirror: differences are not mirrored; leave mirror out")]
    Difference,
}

impl BoxEdge {
    /// All of them with their names.
    const NAMES: [(&str, Self); 4] = [
        ("left", Self::Left),
        ("right", Self::Right),
        ("bottom", Self::Bottom),
        ("top", Self::Top),
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, edge)| *edge == self).map_or("", |(name, _)| name)
    }

    /// 0 for lines x = a, 1 for y = b.
    pub(crate) fn axis(self) -> usize {
        usize::from(matches!(self, Self::Bottom | Self::Top))
    }

    /// True if some point just inside the edge is in the body.
    fn is_reached_by(self, domain: &Domain) -> bool {
        let Rect { min, max } = domain.body_bounds();
        let inside = Rect::new(min + (max - min) * INSIDE, max - (max - min) * INSIDE);
        let part = |k: u32| (f64::from(k) + 0.5) / f64::from(LOOKS);
        let along = |k: u32| min + vec2((max.x - min.x) * part(k), (max.y - min.y) * part(k));
        let point = |p: Vec2| match self {
            Self::Left => vec2(inside.min.x, p.y),
            Self::Right => vec2(inside.max.x, p.y),
            Self::Bottom => vec2(p.x, inside.min.y),
            Self::Top => vec2(p.x, inside.max.y),
        };
        (0..LOOKS).any(|k| domain.contains(point(along(k))))
    }

    pub(crate) fn line(self, bounds: &Rect) -> f64 {
        match self {
            Self::Left => bounds.min.x,
            Self::Right => bounds.max.x,
            Self::Bottom => bounds.min.y,
            Self::Top => bounds.max.y,
        }
    }
}

/// Points along an edge at which the body is looked for, and their way into the box in parts of it.
const LOOKS: u32 = 1024;
const INSIDE: f64 = 1e-9;

/// The kinds of symmetry as they are written.
const KINDS: [(&str, bool); 2] = [("symmetric", false), ("antisymmetric", true)];

impl FromStr for Mirror {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "auto" => return Ok(Self::Auto),
            "none" => return Ok(Self::NONE),
            _ => {}
        }
        let edges: Vec<MirrorEdge> = text.split(',').map(str::parse).collect::<Result<_, _>>()?;
        for (k, one) in edges.iter().enumerate() {
            if let Some(other) = edges[..k].iter().find(|o| o.edge.axis() == one.edge.axis()) {
                let names = [other, one].map(|edge| edge.edge.name());
                return Err(format!("name one of `{}` and `{}`, not both", names[0], names[1]));
            }
        }
        Ok(Self::Edges(edges))
    }
}

impl FromStr for MirrorEdge {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        let (name, kind) = text.split_once(':').unwrap_or((text, KINDS[0].0));
        let edge = BoxEdge::NAMES.iter().find(|(known, _)| *known == name.trim());
        let kind = KINDS.iter().find(|(known, _)| *known == kind.trim());
        match (edge, kind) {
            (Some(&(_, edge)), Some(&(_, is_odd))) => Ok(Self { edge, is_odd }),
            _ => Err(format!(
                "`{text}` is no line of symmetry; write left, right, bottom or top, with \
                 `:antisymmetric` behind it if the field is"
            )),
        }
    }
}

impl fmt::Display for Mirror {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Edges(edges) if edges.is_empty() => f.write_str("none"),
            Self::Edges(edges) => {
                let all: Vec<_> = edges.iter().map(MirrorEdge::to_string).collect();
                f.write_str(&all.join(","))
            }
        }
    }
}

impl fmt::Display for MirrorEdge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.is_odd { ":antisymmetric" } else { "" };
        write!(f, "{}{kind}", self.edge.name())
    }
}

crate::request::written::as_text!(Mirror);

impl Mirror {
    /// The part that was solved alone.
    pub const NONE: Self = Self::Edges(Vec::new());

    /// The axis of a body of revolution that begins there: figures show the whole of it.
    #[must_use]
    pub fn of_figures(dataset: &Dataset) -> Option<Self> {
        let mut edges = with_axis(Vec::new(), dataset);
        edges.retain(|line| line.edge.is_reached_by(&dataset.domain));
        (!edges.is_empty()).then_some(Self::Edges(edges))
    }

    /// The edges: as they are named, else those that the problem of the dataset knows.
    ///
    /// # Errors
    /// None is named, and the dataset knows none.
    pub fn edges(&self, dataset: &Dataset) -> Result<Vec<MirrorEdge>, MirrorError> {
        let edges = match self {
            Self::Auto => with_axis(known(dataset), dataset),
            Self::Edges(edges) => edges.clone(),
        };
        let away = edges.iter().find(|line| !line.edge.is_reached_by(&dataset.domain));
        match away {
            Some(line) => Err(MirrorError::Away(line.edge.name())),
            None if edges.is_empty() && *self == Self::Auto => Err(MirrorError::Unknown),
            None => Ok(edges),
        }
    }
}

/// The edges with the axis of a body of revolution that begins there, which needs no problem to be
/// known.
fn with_axis(mut edges: Vec<MirrorEdge>, dataset: &Dataset) -> Vec<MirrorEdge> {
    let is_across = |line: &MirrorEdge| line.edge.axis() == BoxEdge::Left.axis();
    let begins_there = dataset.domain.bounds.min.x == 0.0;
    if dataset.equation.is_axisymmetric() && begins_there && !edges.iter().any(is_across) {
        edges.push(MirrorEdge { edge: BoxEdge::Left, is_odd: false });
    }
    edges
}

/// The edges of a dataset's problem that have a symmetry.
#[cfg(feature = "problem")]
fn known(dataset: &Dataset) -> Vec<MirrorEdge> {
    use ppum_problem::{DomainEdge, Problem, Symmetry};

    let problem = Problem::of_dataset(dataset).ok().flatten();
    let edges = problem.map(|problem| problem.mirrors()).unwrap_or_default();
    let edge = |(edge, symmetry)| MirrorEdge {
        edge: match edge {
            DomainEdge::Left => BoxEdge::Left,
            DomainEdge::Right => BoxEdge::Right,
            DomainEdge::Bottom => BoxEdge::Bottom,
            DomainEdge::Top => BoxEdge::Top,
        },
        is_odd: symmetry == Symmetry::Antisymmetric,
    };
    edges.into_iter().map(edge).collect()
}

/// Without the solver nobody reads problem files.
#[cfg(not(feature = "problem"))]
fn known(_: &Dataset) -> Vec<MirrorEdge> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrors_are_written_as_they_are_read() {
        for text in [
            "auto",
            "none",
            "bottom",
            "left:antisymmetric",
            "top,right",
            "left,bottom:antisymmetric",
        ] {
            assert_eq!(text.parse::<Mirror>().expect("a mirror").to_string(), text);
        }
        assert_eq!(" left : symmetric ".parse::<Mirror>().expect("a mirror").to_string(), "left");
        for wrong in ["", "middle", "left,right", "bottom,bottom", "left:odd", "left,"] {
            assert!(wrong.parse::<Mirror>().is_err(), "{wrong}");
        }
    }
}
