//! VTKHDF: the meshes of all steps in one HDF5 file.
//!
//! An unstructured grid of version 2.2. The arrays of the steps stand one behind the other, and the
//! group `Steps` tells where each begins. Arrays and field data are those of [`vtu`](super::vtu).

use std::collections::{BTreeMap, BTreeSet};

use ppum_format::{ArrayValues, Arrays, WriteError};

use super::lagrange::node_count;
use super::vtu::{FileNotes, NumberRows, accuracy, cell_type, texts};
use super::{ExportMesh, times};

/// The mesh of a step, and what is told of it.
#[derive(Clone, Debug)]
pub struct ExportedStep {
    /// The load of the step.
    pub load: f64,
    /// The mesh.
    pub mesh: ExportMesh,
    /// The notes of the file.
    pub about: FileNotes,
}

/// Most bytes of meshes ([`ExportMesh::bytes`]) that should go to one file; to make it takes some
/// three times as much memory.
pub const MOST_BYTES: usize = 1 << 30;

/// The version of the form: the first with field data in steps.
const VERSION: [i64; 2] = [2, 2];

/// The file of the meshes of some steps, all with the same arrays; one step at least.
///
/// # Errors
/// [`WriteError`]: a text that cannot be stored.
pub fn file(steps: &[&ExportedStep]) -> Result<Vec<u8>, WriteError> {
    let mut grid = VtkGrid { file: Arrays::default(), steps };
    grid.attribute("VTKHDF@Version", &[2], ArrayValues::I64(VERSION.to_vec()));
    grid.attribute("VTKHDF@Type", &[], ArrayValues::Text(vec!["UnstructuredGrid".to_owned()]));
    grid.attribute("VTKHDF/Steps@NSteps", &[], ArrayValues::I64(vec![steps.len() as i64]));
    grid.add_cells();
    grid.add_arrays();
    grid.add_field_data();
    grid.file.to_bytes()
}

/// Places of the groups of data and of where each step's begins.
const POINT_DATA: [&str; 2] = ["VTKHDF/PointData", "VTKHDF/Steps/PointDataOffsets"];
const FIELD_DATA: [&str; 2] = ["VTKHDF/FieldData", "VTKHDF/Steps/FieldDataOffsets"];

struct VtkGrid<'s> {
    file: Arrays,
    steps: &'s [&'s ExportedStep],
}

impl VtkGrid<'_> {
    fn attribute(&mut self, name: &str, shape: &[u64], values: ArrayValues) {
        self.file.insert(name, shape, values);
    }

    fn numbers(&mut self, name: &str, values: Vec<i64>, shape: &[u64]) {
        self.file.insert(name, shape, ArrayValues::I64(values));
    }

    /// A number of each step.
    fn of_steps(&self, number: impl Fn(&ExportMesh) -> usize) -> Vec<i64> {
        self.steps.iter().map(|step| number(&step.mesh) as i64).collect()
    }

    fn add_cells(&mut self) {
        let steps = self.steps;
        let n = steps.len() as u64;
        let points = self.of_steps(|mesh| mesh.points.len());
        let cells = self.of_steps(|mesh| mesh.triangles().len());
        let corners = self.of_steps(|mesh| mesh.cells.len());
        for (part, counts) in [("Point", &points), ("Cell", &cells), ("ConnectivityId", &corners)] {
            self.numbers(&format!("VTKHDF/NumberOf{part}s"), counts.clone(), &[n]);
            // of cells for each kind of topology, of which there is one
            let shape: &[u64] = if part == "Point" { &[n] } else { &[n, 1] };
            self.numbers(&format!("VTKHDF/Steps/{part}Offsets"), begins(counts), shape);
        }
        self.numbers("VTKHDF/Steps/NumberOfParts", vec![1; steps.len()], &[n]);
        self.numbers("VTKHDF/Steps/PartOffsets", (0..n as i64).collect(), &[n]);
        let loads: Vec<_> = steps.iter().map(|step| step.load).collect();
        self.file.insert("VTKHDF/Steps/Values", [n], ArrayValues::F64(times(&loads)));

        let meshes = || steps.iter().map(|step| &step.mesh);
        let places = meshes().flat_map(|mesh| &mesh.points).flat_map(|p| [p.x, p.y, 0.0]);
        self.rows("VTKHDF/Points", 3, places.collect());
        let corners: Vec<i64> = meshes().flat_map(|mesh| &mesh.cells).map(|&k| k.into()).collect();
        self.file.insert("VTKHDF/Connectivity", [corners.len() as u64], ArrayValues::I64(corners));
        let ends = |mesh: &'_ ExportMesh| {
            let size = node_count(mesh.accuracy.order);
            (0..=mesh.triangles().len()).map(move |k| (size * k) as i64)
        };
        let ends: Vec<i64> = meshes().flat_map(ends).collect();
        self.file.insert("VTKHDF/Offsets", [ends.len() as u64], ArrayValues::I64(ends));
        let types = meshes().flat_map(|mesh| mesh.triangles().map(|_| cell_type(mesh)));
        let types: Vec<u8> = types.collect();
        self.file.insert("VTKHDF/Types", [types.len() as u64], ArrayValues::U8(types));
    }

    /// Rows of numbers; a vector of one for each row.
    fn rows(&mut self, name: &str, width: usize, values: Vec<f64>) {
        let rows = (values.len() / width) as u64;
        let shape = [rows, width as u64];
        let shape = if width == 1 { &shape[..1] } else { &shape };
        self.file.insert(name, shape, ArrayValues::F64(values));
    }

    fn add_arrays(&mut self) {
        let Some(first) = self.steps.first() else { return };
        let begin = begins(&self.of_steps(|mesh| mesh.points.len()));
        for (number, measured) in first.mesh.arrays.iter().enumerate() {
            let [data, offsets] = POINT_DATA.map(|group| member(group, &measured.array.name));
            let values = self.steps.iter().flat_map(|step| step.mesh.values_of(number));
            self.rows(&data, measured.array.components.len(), values.collect());
            self.numbers(&offsets, begin.clone(), &[begin.len() as u64]);
        }
    }

    /// Texts are arrays of bytes, as in `.vtu` files. A step that lacks numbers has no rows.
    fn add_field_data(&mut self) {
        let steps = self.steps;
        let mut names = BTreeSet::new();
        for ExportedStep { mesh, about, .. } in steps {
            names.extend(texts(mesh, about).into_iter().map(|(name, _)| name));
        }
        for name in names {
            let text = |ExportedStep { mesh, about, .. }: &ExportedStep| {
                let all = texts(mesh, about).into_iter();
                all.filter(|(own, _)| *own == name)
                    .flat_map(|(_, text)| text.into_bytes())
                    .collect()
            };
            let parts: Vec<Vec<u8>> = steps.iter().copied().map(text).collect();
            let bytes = parts.concat();
            let place = member(FIELD_DATA[0], name);
            self.file.insert(&place, [bytes.len() as u64], ArrayValues::U8(bytes));
            self.add_sizes(name, 1, parts.iter().map(Vec::len));
        }
        let mut widths = BTreeMap::new();
        for ExportedStep { mesh, about, .. } in steps {
            widths.extend(numbers_of(mesh, about).into_iter().map(|n| (n.name, n.width)));
        }
        for (name, width) in widths {
            let of_step = |ExportedStep { mesh, about, .. }: &ExportedStep| {
                let all = numbers_of(mesh, about).into_iter();
                all.filter(|numbers| numbers.name == name).flat_map(|n| n.values).collect()
            };
            let parts: Vec<Vec<f64>> = steps.iter().copied().map(of_step).collect();
            self.rows(&member(FIELD_DATA[0], &name), width, parts.concat());
            self.add_sizes(&name, width, parts.iter().map(|part| part.len() / width));
        }
    }

    /// Where the field data of each step begins, and its components and rows.
    fn add_sizes(&mut self, name: &str, width: usize, rows: impl Iterator<Item = usize>) {
        let rows: Vec<i64> = rows.map(|rows| rows as i64).collect();
        let n = rows.len() as u64;
        self.numbers(&member(FIELD_DATA[1], name), begins(&rows), &[n]);
        let sizes = rows.iter().flat_map(|&rows| [width as i64, rows]).collect();
        self.numbers(&member("VTKHDF/Steps/FieldDataSizes", name), sizes, &[n, 2]);
    }
}

fn numbers_of(mesh: &ExportMesh, about: &FileNotes) -> Vec<NumberRows> {
    accuracy(mesh).into_iter().chain(about.numbers.iter().cloned()).collect()
}

/// The name of an array in a group: a slash in it would be a group of its own.
fn member(group: &str, name: &str) -> String {
    format!("{group}/{}", name.replace('/', "\u{2215}").replace('@', "at "))
}

/// Where each of some parts begins.
fn begins(lengths: &[i64]) -> Vec<i64> {
    let next = |begin: &mut i64, length: &i64| {
        let own = *begin;
        *begin += length;
        Some(own)
    };
    lengths.iter().scan(0, next).collect()
}
