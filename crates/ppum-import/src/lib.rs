//! Parts from drawings and meshes: DXF, SVG, Gmsh's .msh and .geo become problem files.
//!
//! ```text
//! text ─▶ dxf, svg, msh, geo ─▶ Sketch: curves, names, notices ─▶ chains ─▶ BodyDrawing ─▶ problem file
//! ```
//!
//! [`read()`] joins the curves of a file at their ends. The closed curve around all others is the
//! outline, closed curves in it are holes, open curves and those whose name begins with `crack`
//! are cracks. [`BodyDrawing::problem_file`] writes them in the words of docs/problem-file.md.
//!
//! ```
//! use ppum_import::{DrawingFormat, ImportOptions, read};
//!
//! let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20">
//!     <rect width="40" height="20"/> <circle cx="30" cy="10" r="4"/> <path d="M 0 10 H 12"/>
//! </svg>"#;
//! let drawing = read(svg.as_bytes(), DrawingFormat::Svg, &ImportOptions::default())?;
//! assert_eq!((drawing.holes.len(), drawing.cracks.len()), (1, 1));
//! let text = drawing.problem_file("bracket", "bracket.svg");
//! assert!(text.contains("center = [30, 10]\nradius = 4\n"));
//! # Ok::<(), ppum_import::ImportError>(())
//! ```
//!
//! Files are texts here; whoever calls reads and writes them.

mod affine;
mod assemble;
mod bspline;
mod chain;
mod crossing;
mod curve;
mod dxf;
mod error;
mod geo;
mod msh;
mod sides;
mod sketch;
mod source;
mod svg;
mod write;

use std::collections::BTreeSet;

pub use assemble::BodyDrawing;
pub use chain::CurveChain;
pub use curve::{EllipseArc, PlaneCurve};
pub use error::ImportError;
pub use sketch::NamedCurve;
pub use source::SourceLine;

use sketch::Sketch;

/// A format of drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawingFormat {
    /// AutoCAD's drawing interchange format, as text.
    Dxf,
    /// Scalable vector graphics.
    Svg,
    /// A mesh of Gmsh, format 2.2 or 4.1, as text.
    Msh,
    /// A geometry of Gmsh.
    Geo,
}

impl DrawingFormat {
    /// The format of files with this extension, in letters of any case.
    ///
    /// # Errors
    /// There is none.
    pub fn of_extension(extension: &str) -> Result<Self, ImportError> {
        let known =
            [("dxf", Self::Dxf), ("svg", Self::Svg), ("msh", Self::Msh), ("geo", Self::Geo)];
        let found = known.into_iter().find(|(name, _)| extension.eq_ignore_ascii_case(name));
        found.map(|(_, format)| format).ok_or_else(|| {
            ImportError(
                "drawings are DXF, SVG, MSH or GEO files; end the name in .dxf, .svg, .msh or .geo"
                    .into(),
            )
        })
    }
}

/// Options of reading a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportOptions {
    /// Ends at most this far apart are joined, and curves that the problem file does not know are
    /// met within this distance; in parts of the longer side of the drawing's box, 0 to 0.01.
    pub tolerance: f64,
    /// The names of the curves that are taken; if there are none, all curves.
    pub layers: Vec<String>,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self { tolerance: 1e-6, layers: Vec::new() }
    }
}

/// The body that a file draws.
///
/// # Errors
/// The text does not obey the format, or its curves are no outline with holes and cracks in it.
pub fn read(
    bytes: &[u8],
    format: DrawingFormat,
    options: &ImportOptions,
) -> Result<BodyDrawing, ImportError> {
    let mut sketch = sketch(bytes, format)?;
    sketch.keep(&options.layers)?;
    let is_faceless = sketch.is_mesh_without_faces;
    let assembled = assemble::assemble(sketch, options.tolerance.clamp(1e-12, 1e-2));
    assembled.map_err(|error| match is_faceless {
        true => ImportError(format!(
            "the mesh has no triangles or quadrilaterals, and its lines are no border: {error}; save it with its \
             surfaces: a Physical Surface, or Mesh.SaveAll = 1"
        )),
        false => error,
    })
}

/// The names of the layers, groups or labels of a file's curves, sorted.
///
/// # Errors
/// The text does not obey the format, or has no curves.
///
/// ```
/// use ppum_import::{DrawingFormat, layers};
///
/// let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20">
///     <g id="part"><rect width="40" height="20"/></g> <g id="frame"><path d="M 0 0 H 40"/></g>
/// </svg>"#;
/// assert_eq!(layers(svg.as_bytes(), DrawingFormat::Svg)?, ["frame", "part"]);
/// # Ok::<(), ppum_import::ImportError>(())
/// ```
pub fn layers(bytes: &[u8], format: DrawingFormat) -> Result<Vec<String>, ImportError> {
    let mut sketch = sketch(bytes, format)?;
    let names: BTreeSet<_> = sketch.curves.iter().filter_map(|curve| curve.name.clone()).collect();
    sketch.keep(&[])?;
    Ok(names.into_iter().collect())
}

fn sketch(bytes: &[u8], format: DrawingFormat) -> Result<Sketch, ImportError> {
    let text = String::from_utf8_lossy(bytes);
    match format {
        DrawingFormat::Dxf => dxf::read(&text),
        DrawingFormat::Svg => svg::read(&text),
        DrawingFormat::Msh => msh::read(&text),
        DrawingFormat::Geo => geo::read(&text),
    }
}
