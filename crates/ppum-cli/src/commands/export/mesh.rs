//! Meshes for programs that interpolate: `.vtu`, and `.vtkhdf` or `.pvd` for series.

use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{anyhow, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::text::short;
use ppum_scene::export::vtkhdf::{self, ExportedStep};
use ppum_scene::export::vtp::{self, PolylineData};
use ppum_scene::export::vtu::{self, FileNotes};
use ppum_scene::export::{
    Accuracy, ExportError, ExportMesh, HIGHEST_ORDER, MeasuredAccuracy, PointArray, RANDOM_POINTS,
    resolve, times,
};
use ppum_scene::list::parts;
use ppum_scene::overlays::IsolineLevels;
use sha2::{Digest as _, Sha256};

use crate::dataset::{field, quantity};
use crate::formula_text::FormulaText;
use crate::number::count;
use crate::output::{StandardStream, tell};
use crate::progress::ProgressLine;
use crate::subject::image_subject;
use crate::target::{self, FileFormat};
use ppum_scene::arguments::positive;

/// Most cells of a mesh that is swept around an axis: some 3 GB of memory.
const MOST_SWEPT: usize = 20_000_000;

/// The features that a mesh has to resolve.
#[derive(Debug, clap::Args)]
pub(crate) struct Options {
    /// Largest difference of a mesh from the field, as a fraction of the range of each quantity
    /// [default: 1e-3]
    #[arg(long, value_name = "T", value_parser = positive)]
    tolerance: Option<f64>,
    /// Radius about tips outside of which a mesh resolves quantities that are infinite there
    /// [default: 1/50 of the crack, of half of it if both ends are tips, or of the distance from
    /// other borders and cracks if that is less]
    #[arg(long, value_name = "R", value_parser = positive)]
    tip_radius: Option<f64>,
    /// Maximum number of triangles [default: 1000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    max_cells: Option<u32>,
    /// Degree of the polynomials between the points of a triangle, 1 to 4: higher ones take fewer
    /// triangles for fine tolerances [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=i64::from(HIGHEST_ORDER)))]
    order: Option<u8>,
    /// Average where stresses jump between patches or elements, so that a mesh is torn at cracks
    /// and interfaces only
    #[arg(long)]
    average: bool,
    /// Sweep the mesh of a body of revolution around its axis in so many segments, 3 or more: a
    /// body in space of wedges, vectors and tensors turned, y its axis
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(3..))]
    revolve: Option<u16>,
}

impl Options {
    /// Refuses options of meshes, where `what` is written.
    pub(super) fn check_none(&self, what: &str) -> anyhow::Result<()> {
        let given = [
            ("--tolerance", self.tolerance.is_some()),
            ("--tip-radius", self.tip_radius.is_some()),
            ("--max-cells", self.max_cells.is_some()),
            ("--order", self.order.is_some()),
            ("--average", self.average),
            ("--revolve", self.revolve.is_some()),
        ];
        match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => {
                Err(anyhow!("{option} is for meshes; {what} exact, end -o in .vtu for a mesh"))
            }
            None => Ok(()),
        }
    }

    fn accuracy(&self) -> Accuracy {
        let default = Accuracy::default();
        Accuracy {
            tolerance: self.tolerance.unwrap_or(default.tolerance),
            radius: self.tip_radius,
            cells: self.max_cells.map_or(default.cells, |cells| cells as usize),
            order: self.order.unwrap_or(default.order),
            average: self.average,
        }
    }
}

/// A dataset, and where its mesh goes.
pub(super) struct ExportJob<'a> {
    pub(super) dataset: &'a Dataset,
    /// SHA-256 of the dataset's file.
    pub(super) hash: &'a str,
    pub(super) output: &'a Path,
    /// Quantities with commas between.
    pub(super) quantities: Option<&'a str>,
    /// The levels of isolines among lines.
    pub(super) isolines: Option<&'a IsolineLevels>,
}

impl Options {
    /// Writes the mesh of a step, by default the last one; in the form of VTKHDF those of all.
    pub(super) fn write(
        &self,
        job: &ExportJob<'_>,
        step: Option<usize>,
        out: &mut StandardStream,
    ) -> anyhow::Result<()> {
        let count = job.dataset.steps.len();
        let format = FileFormat::of(job.output);
        if format == Some(FileFormat::VtkHdf) {
            ensure!(self.revolve.is_none(), "--revolve: end -o in .vtu, or in .pvd for a series");
            return self.write_vtkhdf(job, step.map_or(0..count, |step| step..step + 1), out);
        }
        let step = step.unwrap_or(count.saturating_sub(1));
        if format == Some(FileFormat::Vtp) {
            self.check_none("lines are")?;
            let is_idle = job.quantities.is_some() && job.isolines.is_none();
            ensure!(!is_idle, "--quantity: lines have one for --isolines alone; end -o in .vtu");
            return write_lines(job, step, out);
        }
        status(self.write_step(job, step, job.output, out)?)
    }

    /// Writes the meshes of some steps to one file.
    fn write_vtkhdf(
        &self,
        job: &ExportJob<'_>,
        steps: Range<usize>,
        out: &mut StandardStream,
    ) -> anyhow::Result<()> {
        let (mut meshes, mut bytes) = (Vec::new(), 0);
        for step in steps {
            let (mesh, about) = self.mesh(job, step)?;
            bytes += mesh.bytes();
            ensure!(bytes <= vtkhdf::MOST_BYTES, "{} meshes {TOO_LARGE}", meshes.len() + 1);
            meshes.push(ExportedStep { load: job.dataset.steps[step].load, mesh, about });
        }
        let file = vtkhdf::file(&meshes.iter().collect::<Vec<_>>())?;
        target::save(job.output, |out| out.write_all(&file))?;
        let (steps, size) = (count(meshes.len(), "step", "steps"), file.len() as f64 / 1e6);
        writeln!(out, "wrote {}: {steps}, {size:.1} MB", job.output.display())?;
        let mut is_kept = true;
        for step in &meshes {
            is_kept &= tell_mesh(&step.mesh, out)?;
        }
        status(is_kept)
    }

    /// Writes the meshes of all steps and their list; `inputs` are not replaced.
    pub(super) fn write_all(
        &self,
        job: &ExportJob<'_>,
        inputs: &[&Path],
        out: &mut StandardStream,
    ) -> anyhow::Result<()> {
        let files: Vec<_> = (0..job.dataset.steps.len()).map(|step| file_of(job, step)).collect();
        for file in &files {
            target::check(file, target::FileKind::Export, inputs.iter().copied())?;
        }
        let mut is_kept = true;
        for (step, file) in files.iter().enumerate() {
            is_kept &= self.write_step(job, step, file, out)?;
        }
        let name = |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into();
        let loads: Vec<_> = job.dataset.steps.iter().map(|step| step.load).collect();
        let listed: Vec<_> = times(&loads).into_iter().zip(files.iter().map(name)).collect();
        target::save(job.output, |out| vtu::write_collection(out, &listed))?;
        let steps = count(files.len(), "step", "steps");
        writeln!(out, "wrote {}: {steps}", job.output.display())?;
        status(is_kept)
    }

    /// Writes the mesh of a step; false if it does not keep the tolerance.
    fn write_step(
        &self,
        job: &ExportJob<'_>,
        step: usize,
        file: &Path,
        out: &mut StandardStream,
    ) -> anyhow::Result<bool> {
        if self.revolve.is_some() {
            ensure!(
                job.dataset.equation.is_axisymmetric(),
                "--revolve: the body is plane; one of revolution has `state = \"axisymmetric\"`"
            );
            let order = self.order.unwrap_or(1);
            ensure!(order == 1, "--revolve: swept cells are linear; leave --order out");
        }
        let (mesh, about) = self.mesh(job, step)?;
        let cells = usize::from(self.revolve.unwrap_or(0)) * mesh.triangles().len();
        ensure!(
            cells <= MOST_SWEPT,
            "--revolve: {} triangles in so many segments are {cells} cells, more than {MOST_SWEPT}; \
             take fewer segments, or a larger --tolerance",
            mesh.triangles().len()
        );
        target::save(file, |out| match self.revolve {
            Some(segments) => vtu::write_revolved(out, &mesh, segments.into(), &about),
            None => vtu::write(out, &mesh, &about),
        })?;
        let size = file.metadata().map_or(0, |found| found.len()) as f64 / 1e6;
        writeln!(out, "wrote {}: {size:.1} MB", file.display())?;
        tell_mesh(&mesh, out)
    }

    fn mesh(&self, job: &ExportJob<'_>, step: usize) -> anyhow::Result<(ExportMesh, FileNotes)> {
        let field = field(job.dataset, Some(step))?;
        let arrays = arrays(&field, job.quantities)?;
        let mesh =
            resolve(&field, &arrays, &self.accuracy(), &ProgressLine::new()).map_err(explained)?;
        Ok((mesh, FileNotes::of(job.dataset, &field, job.hash.to_owned())))
    }
}

/// Prints the size of a mesh, and how well it resolves the field. False, with a warning, if it does
/// not keep the tolerance.
fn tell_mesh(mesh: &ExportMesh, out: &mut StandardStream) -> anyhow::Result<bool> {
    writeln!(out, "  {} triangles, {} points", mesh.triangles().len(), mesh.points.len())?;
    for measured in &mesh.arrays {
        writeln!(out, "  {}", summary(mesh, measured))?;
    }
    let complaint = mesh.complaint();
    if let Some(text) = &complaint {
        let remedy = if mesh.is_complete { "" } else { "; raise --max-cells or --tolerance" };
        tell(&format!("warning: {text}{remedy}"));
    }
    Ok(complaint.is_none())
}

/// A file is written that does not keep its tolerance; a warning has told the differences.
#[derive(Debug)]
pub(crate) struct ToleranceMissed;

impl std::error::Error for ToleranceMissed {}

impl std::fmt::Display for ToleranceMissed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the tolerance is not kept")
    }
}

fn status(is_kept: bool) -> anyhow::Result<()> {
    if is_kept { Ok(()) } else { Err(ToleranceMissed.into()) }
}

/// Writes the cracks, the tips, the border and isolines of a step.
fn write_lines(job: &ExportJob<'_>, step: usize, out: &mut StandardStream) -> anyhow::Result<()> {
    let field = field(job.dataset, Some(step))?;
    let mut lines = PolylineData::of(job.dataset, &field);
    let mut about = FileNotes::of(job.dataset, &field, job.hash.to_owned());
    if let Some(levels) = job.isolines {
        let quantity = job.quantities.map(FormulaText::read).transpose()?;
        let subject = image_subject(job.dataset, &field, quantity.as_ref())?;
        lines.add_isolines(&subject, levels, &ProgressLine::new())?;
        about.texts.push(("quantities", subject.name.trim().to_owned()));
    }
    target::save(job.output, |out| vtp::write(out, &lines, &about))?;
    let counts =
        [count(lines.points.len(), "point", "points"), count(lines.lines.len(), "line", "lines")];
    Ok(writeln!(out, "wrote {}: {}", job.output.display(), counts.join(", "))?)
}

/// Why the meshes of a series are not written to one file.
const TOO_LARGE: &str = "take more memory than one file may; raise --tolerance, or end -o in .pvd \
                         for a file of each step";

/// `growth.pvd` has `growth-0000.vtu` and so on beside it.
fn file_of(job: &ExportJob<'_>, step: usize) -> PathBuf {
    let stem = job.output.file_stem().unwrap_or_default().to_string_lossy();
    job.output.with_file_name(format!("{stem}-{step:04}.vtu"))
}

fn arrays(field: &Field<'_>, quantities: Option<&str>) -> anyhow::Result<Vec<PointArray>> {
    let defaults = PointArray::defaults(field)?;
    let Some(list) = quantities else { return Ok(defaults) };
    let array = |text: &str| match defaults.iter().find(|array| array.name == text) {
        Some(known) => Ok(known.clone()),
        None => {
            let quantity = quantity(field, text)?;
            quantity.check(field)?;
            Ok(PointArray::scalar(text, quantity))
        }
    };
    parts(list).into_iter().map(array).collect()
}

/// The error with the option that mends it.
fn explained(error: ExportError) -> anyhow::Error {
    let option = match error {
        ExportError::Cells { .. } => Some("--max-cells"),
        ExportError::Radius { .. } => Some("--tip-radius"),
        _ => None,
    };
    let error = anyhow::Error::from(error);
    match option {
        Some(option) => error.context(option),
        None => error,
    }
}

/// SHA-256 in hexadecimal digits.
pub(super) fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        // writing to a String does not fail
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// How well an array is resolved.
fn summary(mesh: &ExportMesh, measured: &MeasuredAccuracy) -> String {
    let MeasuredAccuracy { array, allowed, largest, share, is_singular, .. } = measured;
    let mut text = format!(
        "{}: allowed {}, largest difference{} at {RANDOM_POINTS} random points {}",
        array.name,
        short(*allowed),
        if mesh.accuracy.average { " of averages" } else { "" },
        short(*largest)
    );
    if *share < 1.0 {
        text += &format!(", {} % within", short(100.0 * share));
    }
    if *is_singular {
        let points = count(mesh.singular.len(), "point", "points");
        let extreme = |of: fn(f64, f64) -> f64| mesh.radii.iter().copied().reduce(of);
        let [least, most] = [f64::min, f64::max].map(|of| short(extreme(of).unwrap_or_default()));
        let radii = if least == most { most } else { format!("{least} to {most}") };
        text += &format!(", outside of {radii} about {points} where it is infinite");
    }
    text
}
