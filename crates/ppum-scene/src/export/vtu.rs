//! The files of VTK: an unstructured grid as XML (`.vtu`), and a collection of them (`.pvd`).
//!
//! Numbers are f64 in base 64, in blocks of zlib streams. Texts are arrays of bytes in UTF-8: VTK
//! has an array of strings, which other readers refuse.

use std::io::{self, Write};

use ppum::crack::TipId;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_figure::canvas::base64::base64;
use ppum_figure::canvas::xml::escaped;
use ppum_figure::canvas::zlib::zlib;
use rayon::prelude::*;

use super::grid::Grid;
use super::{ExportMesh, MeasuredAccuracy, RANDOM_POINTS};

/// Bytes that are compressed at a time.
const BLOCK: usize = 1 << 18;

/// The number of a mesh's triangles among the kinds of cells of VTK: linear or Lagrange's.
pub(super) fn cell_type(mesh: &ExportMesh) -> u8 {
    if mesh.accuracy.order == 1 { 5 } else { 69 }
}

/// The notes of a file beside the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileNotes {
    /// Names with texts: the title, the program, the hash of the dataset.
    pub texts: Vec<(&'static str, String)>,
    /// Names with rows of numbers: the time, stress intensity factors.
    pub numbers: Vec<NumberRows>,
}

/// Rows of numbers with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberRows {
    /// The name.
    pub name: String,
    /// Numbers in a row.
    pub width: usize,
    /// The rows, one after the other.
    pub values: Vec<f64>,
}

impl FileNotes {
    /// Collects the notes of a dataset whose file has this SHA-256, and of a field of it.
    #[must_use]
    pub fn of(dataset: &Dataset, field: &Field<'_>, hash: String) -> Self {
        let program = concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned();
        let texts =
            vec![("title", dataset.title.clone()), ("program", program), ("dataset_sha256", hash)];
        let mut numbers = vec![NumberRows::new("TimeValue", 1, vec![field.step.load])];
        let tips = &field.step.intensities;
        if !tips.is_empty() {
            let position = |tip: TipId| {
                let p = field.step.cracks[tip.crack as usize].end_point(tip.end);
                [p.x, p.y, 0.0]
            };
            let places = tips.iter().flat_map(|t| position(t.tip)).collect();
            let factors = tips.iter().flat_map(|tip| [tip.k1, tip.k2]).collect();
            numbers.push(NumberRows::new("tips", 3, places));
            numbers.push(NumberRows::new("stress_intensity_factors", 2, factors));
        }
        Self { texts, numbers }
    }
}

impl NumberRows {
    /// Rows of numbers.
    #[must_use]
    pub fn new(name: &str, width: usize, values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), width, values }
    }
}

impl Grid {
    /// The triangles of the plane.
    fn flat(mesh: &ExportMesh) -> Self {
        let points = mesh.points.iter().copied().flat_map(flat).collect();
        let arrays = (0..mesh.arrays.len()).map(|number| mesh.values_of(number)).collect();
        let mut grid = Self::without_cells(points, arrays);
        mesh.triangles().for_each(|triangle| grid.add(cell_type(mesh), triangle));
        grid
    }
}

/// Writes a mesh.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut dyn Write, mesh: &ExportMesh, about: &FileNotes) -> io::Result<()> {
    write_grid(out, &Grid::flat(mesh), mesh, about)
}

/// Writes the mesh of a body of revolution in space, swept around the axis in so many segments; its
/// triangles have the order 1.
///
/// # Errors
/// Those of the writer.
pub fn write_revolved(
    out: &mut dyn Write,
    mesh: &ExportMesh,
    segments: usize,
    about: &FileNotes,
) -> io::Result<()> {
    write_grid(out, &Grid::revolved(mesh, segments), mesh, about)
}

fn write_grid(
    out: &mut dyn Write,
    grid: &Grid,
    mesh: &ExportMesh,
    about: &FileNotes,
) -> io::Result<()> {
    let (points, cells) = (grid.points.len() / 3, grid.types.len());
    write_head(out, "UnstructuredGrid")?;
    write_about(out, mesh, about)?;
    writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")?;
    writeln!(out, "<Points>")?;
    numbers(out, "Points", "NumberOfComponents=\"3\"", &grid.points)?;
    writeln!(out, "</Points>\n<Cells>")?;
    let bytes = |all: &[u32]| all.iter().flat_map(|k| k.to_le_bytes()).collect::<Vec<u8>>();
    array(out, "Int32", "connectivity", "", &bytes(&grid.nodes))?;
    array(out, "Int32", "offsets", "", &bytes(&grid.ends))?;
    array(out, "UInt8", "types", "", &grid.types)?;
    writeln!(out, "</Cells>\n<PointData>")?;
    for (measured, values) in mesh.arrays.iter().zip(&grid.arrays) {
        let size = attributes(&measured.array.components);
        numbers(out, &measured.array.name, &size, values)?;
    }
    writeln!(out, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// Writes the start of a file of some kind, up to the field data.
pub(super) fn write_head(out: &mut dyn Write, kind: &str) -> io::Result<()> {
    writeln!(
        out,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\">\n<{kind}>"
    )
}

/// A point in space.
pub(super) fn flat(p: Vec2) -> [f64; 3] {
    [p.x, p.y, 0.0]
}

/// Writes the list of the files of a series, with their times.
///
/// # Errors
/// Those of the writer.
pub fn write_collection(out: &mut dyn Write, files: &[(f64, String)]) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
    writeln!(out, "<Collection>")?;
    for (time, file) in files {
        writeln!(out, "<DataSet timestep=\"{time}\" file=\"{}\"/>", escaped(file))?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}

/// The number of components, and their names.
fn attributes<Q>(components: &[(&str, Option<Q>)]) -> String {
    let mut text = format!("NumberOfComponents=\"{}\"", components.len());
    for (k, (name, _)) in components.iter().enumerate().filter(|(_, (name, _))| !name.is_empty()) {
        text += &format!(" ComponentName{k}=\"{name}\"");
    }
    text
}

/// Returns the accuracy of a mesh.
pub(super) fn accuracy(mesh: &ExportMesh) -> [NumberRows; 9] {
    let of = |value: fn(&MeasuredAccuracy) -> f64| mesh.arrays.iter().map(value).collect();
    let singular = mesh.singular.iter().flat_map(|p| [p.x, p.y, 0.0]).collect();
    [
        NumberRows::new("tolerance", 1, vec![mesh.accuracy.tolerance]),
        NumberRows::new("range", 1, of(|a| a.range)),
        NumberRows::new("allowed_difference", 1, of(|a| a.allowed)),
        NumberRows::new("largest_difference", 1, of(|a| a.largest)),
        NumberRows::new("share_within", 1, of(|a| a.share)),
        NumberRows::new("random_points", 1, vec![RANDOM_POINTS as f64]),
        NumberRows::new("averaged", 1, vec![f64::from(u8::from(mesh.accuracy.average))]),
        NumberRows::new("singular_radius", 1, mesh.radii.clone()),
        NumberRows::new("singular_points", 3, singular),
    ]
}

/// The texts of the field data, with the names of arrays and their units, one a line.
pub(super) fn texts(mesh: &ExportMesh, about: &FileNotes) -> Vec<(&'static str, String)> {
    let lines = |of: fn(&MeasuredAccuracy) -> &str| {
        mesh.arrays.iter().map(of).collect::<Vec<_>>().join("\n")
    };
    let named = [("quantities", lines(|a| &a.array.name)), ("units", lines(|a| &a.unit))];
    about.texts.iter().cloned().chain(named).collect()
}

/// The field data: what the mesh is accurate to, and what else is told.
fn write_about(out: &mut dyn Write, mesh: &ExportMesh, about: &FileNotes) -> io::Result<()> {
    writeln!(out, "<FieldData>")?;
    write_texts(out, &texts(mesh, about))?;
    for NumberRows { name, width, values } in accuracy(mesh).iter().chain(&about.numbers) {
        let rows = values.len() / width;
        let size = format!("NumberOfComponents=\"{width}\" NumberOfTuples=\"{rows}\"");
        numbers(out, name, &size, values)?;
    }
    writeln!(out, "</FieldData>")
}

/// Writes texts as arrays of bytes.
pub(super) fn write_texts(out: &mut dyn Write, texts: &[(&str, String)]) -> io::Result<()> {
    texts.iter().try_for_each(|(name, text)| {
        let size = format!("NumberOfTuples=\"{}\"", text.len());
        array(out, "UInt8", name, &size, text.as_bytes())
    })
}

pub(super) fn numbers(
    out: &mut dyn Write,
    name: &str,
    size: &str,
    values: &[f64],
) -> io::Result<()> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array(out, "Float64", name, size, &bytes)
}

/// An array: number of blocks, their size, that of the last one if it is smaller, their sizes once
/// compressed; then the blocks.
pub(super) fn array(
    out: &mut dyn Write,
    kind: &str,
    name: &str,
    size: &str,
    bytes: &[u8],
) -> io::Result<()> {
    let blocks: Vec<Vec<u8>> = bytes.par_chunks(BLOCK).map(zlib).collect();
    let head = [blocks.len(), BLOCK, bytes.len() % BLOCK];
    let head = head.into_iter().chain(blocks.iter().map(Vec::len));
    let head: Vec<u8> = head.flat_map(|number| (number as u64).to_le_bytes()).collect();
    writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{}\" {size} format=\"binary\">",
        escaped(name)
    )?;
    writeln!(out, "{}{}\n</DataArray>", base64(&head), base64(&blocks.concat()))
}
