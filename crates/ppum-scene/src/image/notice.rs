//! Notices about an image: requested items that are not visible, and values that may mislead.

use ppum::printable::printable;
use ppum_figure::canvas::Canvas;
use ppum_figure::form::PageFormat;

use crate::request::overlays::Overlay;

/// Something that whoever looks at an image should know.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Notice {
    /// The processor draws in place of a graphics card, for this reason.
    #[error("drawn on the CPU, since the graphics card fails: {}", joined(.0))]
    NoCard(String),
    /// The processor draws the elements of a mesh in place of a graphics card.
    #[error("drawn on the CPU, since graphics cards do not draw meshes")]
    Mesh,
    /// Single precision shows fewer than three digits, see
    /// [`single_precision_warning`](super::values::single_precision_warning).
    #[error("{0}")]
    SinglePrecision(String),
    /// No pixel has its centre on the body.
    #[error("no pixel has its centre on the plate")]
    OffPlate,
    /// Something has no value at some pixels of the body, of so many.
    #[error("{}", if *.is_of_cells { undefined_cells(.name, *.counts) } else {
        undefined(.name, *.counts, "pixels")
    })]
    Undefined {
        /// Its name.
        name: String,
        /// Pixels without a value, and all of the body.
        counts: [usize; 2],
        /// True for values of cells.
        is_of_cells: bool,
    },
    /// A quantity of this name is infinite wherever it has a value.
    #[error("`{0}` has no finite value in the picture")]
    Infinite(String),
    /// None of the levels that were listed occurs.
    #[error("no isoline lies in the picture: its values pass none of the levels")]
    NoIsoline,
    /// Cells, of a cover that has none.
    #[error(
        "the cover has no cells, so `{}` draws nothing; `patches` draws the supports", .0.name()
    )]
    NoCells(Overlay),
    /// Isolines of values of cells, or of a difference.
    #[error(
        "values that are constant in each cell, and differences, have no isolines; the overlay `cells` draws \
         the borders of the cells"
    )]
    NoIsolines,
    /// No cross has room.
    #[error("no cross stands in the picture; choose a smaller distance")]
    NoCross,
    /// No arrow has room.
    #[error("no arrow stands in the picture; choose a smaller distance")]
    NoArrow,
    /// Supports and loads without a problem file.
    #[error("the dataset holds no problem file, so its supports and loads are not known")]
    NoProblem,
    /// Supports and loads of a problem file that cannot be read.
    #[error("the dataset's problem file cannot be read, so its supports and loads are not known")]
    UnreadableProblem,
    /// A layout of columns and rows, some of which have none of so many images.
    #[error("the layout {} not fill; they are left out", unfilled(*.0, *.1))]
    EmptyPanels([u32; 2], usize),
    /// A legend of these entries has no room.
    #[error("the picture is too small for its legend: {}", .0.join(", "))]
    NoLegend(Vec<String>),
    /// Characters that the font of figures lacks, in a file of some form.
    #[error("the font of figures lacks {}; {}", listed(.0), shown_as(*.1))]
    NoGlyph(Vec<char>, PageFormat),
}

impl Notice {
    /// The characters of a page that the font of figures lacks, if there are some.
    #[must_use]
    pub fn of_glyphs(page: &Canvas, form: PageFormat) -> Option<Self> {
        let missing = page.missing();
        (!missing.is_empty()).then_some(Self::NoGlyph(missing, form))
    }

    /// The notice as a line on a terminal: `warning: …`, or `note: …` of what is no fault of the
    /// image.
    #[must_use]
    pub fn line(&self) -> String {
        let kind = if matches!(self, Self::NoCard(_) | Self::Mesh) { "note" } else { "warning" };
        format!("{kind}: {self}")
    }
}

/// The lines of a text in one.
fn joined(text: &str) -> String {
    text.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

fn listed(missing: &[char]) -> String {
    let list = missing.iter().map(|c| format!("`{c}`")).collect::<Vec<_>>().join(", ");
    printable(&list).into_owned()
}

fn unfilled([columns, rows]: [u32; 2], count: usize) -> String {
    let images = if count == 1 { "image does" } else { "images do" };
    format!("{columns}x{rows} has rows or columns that {count} {images}")
}

/// How a file shows characters that the font lacks.
fn shown_as(form: PageFormat) -> &'static str {
    match form {
        PageFormat::Svg => "programs with other fonts show them",
        PageFormat::Png | PageFormat::Pdf => "boxes stand for them",
    }
}

/// That a quantity has no value at some of the `things` of the body.
#[must_use]
pub fn undefined(name: &str, counts: [usize; 2], things: &str) -> String {
    format!(
        "`{name}` has no value at {} {things} of the plate: it is not defined there, as 0/0 and roots and \
         logarithms of negative numbers are not",
        some(counts)
    )
}

/// That the dataset has no value for some cells, which show at some pixels.
fn undefined_cells(name: &str, counts: [usize; 2]) -> String {
    format!(
        "`{name}` has no value at {} pixels of the plate: the dataset has none for their cells",
        some(counts)
    )
}

/// So many of all.
fn some([some, all]: [usize; 2]) -> String {
    if some == all { format!("all {all}") } else { format!("{some} of {all}") }
}
