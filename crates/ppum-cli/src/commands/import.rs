//! `ppum import`: the problem file of a drawing or a mesh.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum_import::{BodyDrawing, DrawingFormat, ImportOptions};

use crate::number::count;
use crate::output::{StandardStream, tell};
use crate::standard::is_standard;
use crate::target;

/// Write a problem file for a part that is drawn in DXF, SVG or Gmsh
///
/// The closed curve around all others is the outline, closed curves in it are holes, open curves
/// and those whose layer, group or label begins with `crack` are cracks. Layers, groups and labels
/// become names for loads. Material and loads are left as comments, to be filled in. Entities that
/// cannot be read are named with their line.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ImportArgs {
    /// Drawing: .dxf or .svg, a mesh .msh or a geometry .geo of Gmsh
    #[arg(value_name = "DRAWING")]
    file: PathBuf,
    /// Problem file to write, - for standard output [default: beside the drawing, with the
    /// extension .toml]
    #[arg(short, long, value_name = "FILE.toml")]
    output: Option<PathBuf>,
    /// Take only curves of this layer, group or label; several with commas between
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    layer: Vec<String>,
    /// Join ends, and replace curves, within this fraction of the drawing's longer side
    #[arg(long, value_name = "T", default_value = "1e-6")]
    tolerance: f64,
    /// Replace an existing problem file
    #[arg(long)]
    force: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum import bracket.dxf
  ppum import bracket.dxf --layer part,bolts -o bracket.toml
  ppum import tooth.svg --tolerance 1e-4
  ppum import plate.msh -o - | less";

/// Longest drawing, in bytes.
const LONGEST: u64 = 1 << 28;

impl ImportArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let beside = self.file.with_extension("toml");
        let output = self.output.as_deref().unwrap_or(&beside);
        let format = DrawingFormat::of_extension(&extension(&self.file));
        let format = format.with_context(|| self.file.display().to_string())?;
        ensure!(
            self.tolerance > 0.0 && self.tolerance <= 0.01,
            "--tolerance: give a part of the drawing, more than 0 and at most 0.01"
        );
        target::check(output, target::FileKind::Problem, [self.file.as_path()])?;
        if !self.force && !is_standard(output) {
            target::check_new(output)?;
        }
        let bytes = ppum_file::read(&self.file, LONGEST);
        let bytes = bytes.with_context(|| format!("cannot read {}", self.file.display()))?;
        let options = ImportOptions { tolerance: self.tolerance, layers: self.layer.clone() };
        let drawing = ppum_import::read(&bytes, format, &options);
        let drawing = drawing.with_context(|| self.file.display().to_string())?;
        for notice in &drawing.notices {
            tell(&format!("{}: {notice}", self.file.display()));
        }
        self.write(&drawing, output, out)
    }

    fn write(
        &self,
        drawing: &BodyDrawing,
        output: &Path,
        out: &mut StandardStream,
    ) -> anyhow::Result<()> {
        let name = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
        let text = drawing.problem_file(&name(self.file.file_stem()), &name(self.file.file_name()));
        ensure!(
            text.len() as u64 <= ppum_problem::MAX_LENGTH,
            "the problem file would have {} MiB, more than is read; draw fewer points, or give a larger --tolerance",
            text.len() >> 20
        );
        if is_standard(output) {
            return Ok(out.exact().write_all(text.as_bytes())?);
        }
        target::save(output, |out| out.write_all(text.as_bytes()))?;
        let holes = count(drawing.holes.len(), "hole", "holes");
        let counts = format!("{holes}, {}", count(drawing.cracks.len(), "crack", "cracks"));
        Ok(writeln!(
            out,
            "wrote {}: an outline, {counts}; fill in material and loads",
            output.display()
        )?)
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().into_owned()
}
