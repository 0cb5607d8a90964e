//! Why a file is no drawing of one body.

use ppum::vec2::Vec2;

use crate::source::SourceLine;

/// A file that cannot be read, or whose curves are no outline with holes and cracks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The name of the file ends in none of the known extensions.
    #[error("drawings are DXF, SVG, MSH or GEO files; end the name in .dxf, .svg, .msh or .geo")]
    UnknownFormat,
    /// A line that does not obey the format.
    #[error("{source_line}: {message}")]
    Syntax {
        /// Where.
        source_line: SourceLine,
        /// The error, and its remedy.
        message: String,
    },
    /// More than is read.
    #[error("the file has more than {most} {what}; leave out what is no border of the body")]
    TooMany {
        /// The things that are too many.
        what: &'static str,
        /// The largest number.
        most: usize,
    },
    /// A mesh of lines alone, which are no boundary.
    #[error(
        "the mesh has no triangles or quadrilaterals, and its lines are no border: {0}; save it with its \
         surfaces: a Physical Surface, or Mesh.SaveAll = 1"
    )]
    Faceless(Box<ImportError>),
    /// No curve at all.
    #[error("the file has no curves that can be read{}{}", on_layers(.layers), left(.notices))]
    Empty {
        /// The names of those that were left out.
        layers: Vec<String>,
        /// Notices about things that were left out.
        notices: Vec<String>,
    },
    /// Curves, but none that closes.
    #[error(
        "no curve closes: the outline is open from {} ({from_source}) to {} ({to_source}), a gap of {gap}; close it",
        shown(*.from), shown(*.to)
    )]
    Open {
        /// One end.
        from: Vec2,
        /// The line of the curve that ends there.
        from_source: SourceLine,
        /// The other end.
        to: Vec2,
        /// The line of the curve that ends there.
        to_source: SourceLine,
        /// Their distance.
        gap: f64,
    },
    /// More than two curves of closed ones meet.
    #[error(
        "{count} curves meet at {}, among them {}; the border of a body does not branch: give cracks the \
         layer, group or label `crack`",
        shown(*.at), lines_of(.sources)
    )]
    Branch {
        /// Where.
        at: Vec2,
        /// How many.
        count: usize,
        /// Their lines.
        sources: Vec<SourceLine>,
    },
    /// A closed curve beside the outline.
    #[error(
        "the closed curves at {} ({first}) and at {} ({second}) lie beside each other: there is more than \
         one body; keep one of them",
        shown(at[0]), shown(at[1])
    )]
    Bodies {
        /// A point of each.
        at: [Vec2; 2],
        /// The line of the larger one.
        first: SourceLine,
        /// The line of the other one.
        second: SourceLine,
    },
    /// A closed curve within a hole.
    #[error("the closed curve at {} ({inner}) lies in the hole of {hole}: it would be another body; remove it", shown(*.at))]
    Nested {
        /// A point of the inner curve.
        at: Vec2,
        /// The line of the inner curve.
        inner: SourceLine,
        /// The line of the curve around it.
        hole: SourceLine,
    },
    /// Closed curves that are not apart.
    #[error("curves cross or touch at {} ({first} and {second}); move them apart, or join them to one", shown(*.at))]
    Crossing {
        /// Where.
        at: Vec2,
        /// The line of one.
        first: SourceLine,
        /// The line of the other.
        second: SourceLine,
    },
    /// A crack that leaves the body.
    #[error("the open curve of {curve}, a crack, leaves the body at {}; shorten it, or leave it out", shown(*.at))]
    Outside {
        /// Where it lies outside.
        at: Vec2,
        /// Its line.
        curve: SourceLine,
    },
    /// A crack that closes.
    #[error("the crack at {} ({curve}) closes, and would cut the body; open it, or give it another name", shown(*.at))]
    ClosedCrack {
        /// A point of it.
        at: Vec2,
        /// Its line.
        curve: SourceLine,
    },
}

impl ImportError {
    pub(crate) fn syntax(source_line: SourceLine, message: impl Into<String>) -> Self {
        Self::Syntax { source_line, message: message.into() }
    }
}

/// A point in messages.
pub(crate) fn shown(at: Vec2) -> String {
    format!("[{:.6}, {:.6}]", at.x, at.y)
}

fn lines_of(all: &[SourceLine]) -> String {
    all.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and ")
}

fn on_layers(names: &[String]) -> String {
    if names.is_empty() {
        String::new()
    } else {
        format!(" of these names; it has {}", names.join(", "))
    }
}

fn left(notices: &[String]) -> String {
    notices.iter().map(|notice| format!("; {notice}")).collect()
}
