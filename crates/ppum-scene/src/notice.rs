//! Notices about an image: requested items that are not visible, and values that may mislead.

use std::fmt;

use ppum::printable::printable;
use ppum_figure::canvas::Canvas;
use ppum_figure::form::PageFormat;

use crate::overlays::Overlay;

/// Something that whoever looks at an image should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// The processor draws in place of a graphics card, for this reason.
    NoCard(String),
    /// The processor draws the elements of a mesh in place of a graphics card.
    Mesh,
    /// Single precision shows fewer than three digits, see
    /// [`single_precision_warning`](crate::drawing::single_precision_warning).
    SinglePrecision(String),
    /// No pixel has its centre on the body.
    OffPlate,
    /// Something has no value at some pixels of the body, of so many.
    Undefined {
        /// Its name.
        name: String,
        /// Pixels without a value, and all of the body.
        counts: [usize; 2],
        /// True for values of cells.
        is_of_cells: bool,
    },
    /// A quantity of this name is infinite wherever it has a value.
    Infinite(String),
    /// None of the levels that were listed occurs.
    NoIsoline,
    /// Cells, of a cover that has none.
    NoCells(Overlay),
    /// Isolines of values of cells, or of a difference.
    NoIsolines,
    /// No cross has room.
    NoCross,
    /// No arrow has room.
    NoArrow,
    /// Supports and loads without a problem file.
    NoProblem,
    /// Supports and loads of a problem file that cannot be read.
    UnreadableProblem,
    /// A layout of columns and rows, some of which have none of so many images.
    EmptyPanels([u32; 2], usize),
    /// A legend of these entries has no room.
    NoLegend(Vec<String>),
    /// Characters that the font of figures lacks, in a file of some form.
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

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoCard(reason) => {
                let lines: Vec<_> = reason.lines().map(str::trim).collect();
                let reason = lines.join(" ");
                return write!(f, "drawn on the CPU, since the graphics card fails: {reason}");
            }
            Self::SinglePrecision(text) => text,
            Self::Undefined { name, counts, is_of_cells } => {
                let message = if *is_of_cells { undefined_cells } else { undefined_pixels };
                return f.write_str(&message(name, *counts));
            }
            Self::Infinite(name) => {
                return write!(f, "`{name}` has no finite value in the picture");
            }
            Self::EmptyPanels([columns, rows], count) => {
                let images = if *count == 1 { "image does" } else { "images do" };
                return write!(
                    f,
                    "the layout {columns}x{rows} has rows or columns that {count} {images} not fill; they are left out"
                );
            }
            Self::NoLegend(entries) => {
                let list = entries.join(", ");
                return write!(f, "the picture is too small for its legend: {list}");
            }
            Self::NoCells(overlay) => {
                let name = overlay.name();
                return write!(
                    f,
                    "the cover has no cells, so `{name}` draws nothing; `patches` draws the supports"
                );
            }
            Self::NoGlyph(missing, form) => return no_glyph(f, missing, *form),
            Self::Mesh => "drawn on the CPU, since graphics cards do not draw meshes",
            Self::OffPlate => "no pixel has its centre on the plate",
            Self::NoIsoline => "no isoline lies in the picture: its values pass none of the levels",
            Self::NoIsolines => {
                "values that are constant in each cell, and differences, have no isolines; the overlay `cells` draws \
                 the borders of the cells"
            }
            Self::NoCross => "no cross stands in the picture; choose a smaller distance",
            Self::NoArrow => "no arrow stands in the picture; choose a smaller distance",
            Self::NoProblem => {
                "the dataset holds no problem file, so its supports and loads are not known"
            }
            Self::UnreadableProblem => {
                "the dataset's problem file cannot be read, so its supports and loads are not known"
            }
        })
    }
}

fn no_glyph(f: &mut fmt::Formatter<'_>, missing: &[char], form: PageFormat) -> fmt::Result {
    let shown = match form {
        PageFormat::Svg => "programs with other fonts show them",
        PageFormat::Png | PageFormat::Pdf => "boxes stand for them",
    };
    let list = missing.iter().map(|c| format!("`{c}`")).collect::<Vec<_>>().join(", ");
    write!(f, "the font of figures lacks {}; {shown}", printable(&list))
}

fn undefined_pixels(name: &str, counts: [usize; 2]) -> String {
    undefined(name, counts, "pixels")
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
