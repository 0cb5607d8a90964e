//! `ppum export`: a page to explore a dataset in a browser, a mesh for other programs.

pub(crate) mod mesh;

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_page::{LARGEST, PageStart, PageView, SHAPE, StartError, html};
use ppum_scene::overlays::Overlays;
use ppum_scene::region::{ImageExtent, ViewRegion};
use ppum_scene::scene::{SceneRequest, Subject};

use crate::dataset::{field, named};
use crate::formula_text::{FormulaText, files};
use crate::output::{StandardStream, tell};
use crate::standard::{self, is_standard};
use crate::subject::image_subject;
use crate::target::{self, FileFormat};

/// Write a page to explore a dataset in a browser, or a mesh for ParaView and other programs
///
/// A page, .html, holds the dataset and what evaluates it. A browser opens it from disk, without a
/// server and without a network, and computes each pixel as exactly as `ppum render`. Zoom, colours
/// and overlays are chosen in the page; the options say what it shows first.
///
/// A mesh, .vtu, has triangles that resolve the quantities to a tolerance, and points with the
/// values of both sides on cracks. The file and the command tell the largest difference from the
/// field, measured at random points; if it is more than the tolerance allows, the exit status is 3.
/// For a series, .vtkhdf has all steps in one file, .pvd lists a .vtu file for each. A .vtp file
/// has cracks, tips with their K, the border, supports, loads and, with --isolines, those of a
/// quantity as lines and points.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ExportArgs {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// File to write: a page, .html; a mesh, .vtu or .vtkhdf (for a series .vtkhdf or .pvd); lines,
    /// .vtp; - for a page on standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Quantity or value of cells of `ppum info`, a formula of quantities, or @FILE with one
    /// [default: von-mises; for Poisson problems u]; for meshes several quantities, separated by
    /// commas [default: displacement, stress, von-mises; for Poisson problems u, gradient]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
    #[command(flatten)]
    place: ViewRegion,
    #[command(flatten)]
    scene: SceneRequest,
    #[command(flatten)]
    accuracy: mesh::Options,
}

const EXAMPLES: &str = "\
Examples:
  ppum export plate.h5 -o plate.html
  ppum export plate.h5 -o tip.html --tip 1 --zoom 1e6 --scale log
  ppum export plate.h5 -o uy.html -q uy --colormap coolwarm --isolines auto
  ppum export growth.h5 -o growth.html --step 0
  ppum export half.h5 -o whole.html --mirror --deformed auto
  ppum solve plate.toml -o - | ppum export - -o plate.html
  ppum export plate.h5 -o plate.vtu --tolerance 1e-4
  ppum export growth.h5 -o growth.vtkhdf
  ppum export plate.h5 -o plate.vtu --tolerance 1e-6 --order 3
  ppum export plate.h5 -o lines.vtp -q von-mises --isolines auto
  ppum export growth.h5 -o growth.pvd -q 'displacement,s1'";

impl ExportArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        use FileFormat::{Pvd, VtkHdf, Vtp, Vtu};

        if let Some(Vtu | VtkHdf | Pvd | Vtp) = FileFormat::of(&self.output) {
            return self.write_mesh(out);
        }
        self.accuracy.check_none("a page is")?;
        target::check(&self.output, target::FileKind::Export, self.inputs())?;
        let bytes = self.bytes(LARGEST)?;
        let dataset = named(&self.file, ppum_format::from_bytes(bytes.clone()))?;
        let start = self.start(&dataset)?;
        let page = html(&bytes, start.title(&dataset), &start)?;
        if is_standard(&self.output) {
            out.exact().write_all(page.as_bytes())?;
            tell(&format!("wrote standard output: {}", told(&page)));
            return Ok(());
        }
        target::save(&self.output, |out| out.write_all(page.as_bytes()))?;
        Ok(writeln!(out, "wrote {}: {}", self.output.display(), told(&page))?)
    }

    fn write_mesh(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        target::check(&self.output, target::FileKind::Export, self.inputs())?;
        self.check_no_look()?;
        let bytes = self.bytes(standard::DATASET)?;
        let hash = mesh::hash(&bytes);
        let dataset = named(&self.file, ppum_format::from_bytes(bytes))?;
        let job = mesh::ExportJob {
            dataset: &dataset,
            hash: &hash,
            output: &self.output,
            quantities: self.quantity.as_deref(),
            isolines: self.scene.overlays.isolines.as_ref(),
        };
        if FileFormat::of(&self.output) != Some(FileFormat::Pvd) {
            return self.accuracy.write(&job, self.step, out);
        }
        ensure!(self.step.is_none(), "--step: a .pvd file lists all steps; end -o in .vtu for one");
        self.accuracy.write_all(&job, &self.inputs().collect::<Vec<_>>(), out)
    }

    /// Refuses options that only pages have; lines may have isolines.
    fn check_no_look(&self) -> anyhow::Result<()> {
        let isolines = self.scene.overlays.isolines.clone();
        let isolines = isolines.filter(|_| FileFormat::of(&self.output) == Some(FileFormat::Vtp));
        let overlays = Overlays { isolines, ..Overlays::default() };
        ensure!(
            !self.place.is_given()
                && self.scene == SceneRequest { overlays, ..SceneRequest::default() },
            "a mesh has no view, colours, overlays, deformed or mirrored bodies: these options are \
             for pages, --isolines for lines too; end -o in .html or .vtp"
        );
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        [self.file.as_path()].into_iter().chain(files(&self.quantity))
    }

    fn bytes(&self, largest: u64) -> anyhow::Result<Vec<u8>> {
        if is_standard(&self.file) {
            return standard::bytes(standard::THE_DATASET, largest);
        }
        let read = ppum_file::read(&self.file, largest);
        read.with_context(|| format!("cannot read {}", self.file.display()))
    }

    /// Returns the initial view of the page, if the dataset has it.
    fn start(&self, dataset: &Dataset) -> anyhow::Result<PageStart> {
        let field = field(dataset, self.step)?;
        let file = match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => "dataset.h5".to_owned(),
        };
        let quantity = self.quantity.as_deref().map(FormulaText::read).transpose()?;
        image_subject(dataset, &field, quantity.as_ref())?;
        let quantity = quantity.map(|given| given.text.trim().to_owned());
        let subject = Subject { step: self.step, ..Subject::default() };
        let scene = SceneRequest { subject, quantity, ..self.scene.clone() };
        PageStart::new(scene, (dataset, &field), self.view(&field)?, file).map_err(explained)
    }

    /// The view, if one is asked for.
    fn view(&self, field: &Field<'_>) -> anyhow::Result<Option<PageView>> {
        if !self.place.is_given() {
            return Ok(None);
        }
        let frame = ImageExtent { pixels: SHAPE, may_shrink: false, margin: 0.0 };
        Ok(Some(self.place.seen(field.domain.bounds, field, frame)?.into()))
    }
}

/// The error with the option that mends it.
fn explained(error: StartError) -> anyhow::Error {
    let option = match error {
        StartError::Colormap(_) => "--colormap",
        StartError::Stations => "--overlay",
        StartError::Body(_) => "--deformed, --mirror",
        _ => "-o",
    };
    anyhow::Error::from(error).context(option)
}

/// The size of the page, and what it is for.
fn told(page: &str) -> String {
    format!("{:.1} MB; a browser opens it from disk", page.len() as f64 / 1e6)
}
