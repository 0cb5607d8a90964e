//! `ppum compare`: a direct picture beside what resampling gives.

mod measure;
mod report;
mod sheet;

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use clap::ValueEnum;
use ppum_figure::figure::{Design, plot_area};
use ppum_render::picture::Picture;
use ppum_render::png;
use ppum_render::resample::Interpolation;

use crate::arguments::{page, positive, size};
use crate::number::json;
use crate::output::{Output, tell};
use crate::range::Telling;
use crate::standard::is_standard;
use crate::subject::{Colors, Subject};
use crate::window::{Frame, Window};
use crate::{target, threads};
use measure::{Measurements, measure};
use report::{Report, table};

/// Compare direct drawing with resampling: pictures, errors, memory, time
///
/// Resampling takes exact values at the points of a grid, as other programs do, and interpolates them at
/// the pixels. The picture shows the field, what each method makes of it, and the differences.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: Subject,
    /// Picture to write, - for standard output; without it numbers only
    #[arg(short, long, value_name = "OUT.png")]
    output: Option<PathBuf>,
    /// Points of the grid, borders included
    #[arg(long, value_name = "N|NXxNY", value_parser = grid, default_value = "64")]
    grid: [u32; 2],
    /// The rectangle of the grid
    #[arg(long, value_enum, default_value = "domain")]
    over: Over,
    /// How values between the points are found
    #[arg(long, value_enum, value_delimiter = ',', default_value = "bilinear")]
    method: Vec<Method>,
    /// Find the grids that have no larger relative error
    #[arg(long, value_name = "E", value_parser = positive)]
    error: Option<f64>,
    /// Size of each panel in pixels
    #[arg(long, value_name = "WxH", value_parser = page, default_value = "720x600")]
    size: [u32; 2],
    #[command(flatten)]
    window: Window,
    #[command(flatten)]
    colours: Colors,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Number of threads [default: all cores]; errors do not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
}

const EXAMPLES: &str = "\
Examples:
  ppum compare plate.h5 -o compare.png --grid 64
  ppum compare plate.h5 -o all.png --grid 256 --method all -q uy --tip 1
  ppum compare plate.h5 --grid 2048x1024 --error 1e-2 --json
  ppum compare plate.h5 -o cells.png --method cells --over view --view 0,-0.2,0.4,0.2";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Over {
    /// The box of the domain
    Domain,
    /// What the picture shows
    View,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Method {
    /// The value of the nearest point
    Nearest,
    /// Linear in each direction, of four points
    Bilinear,
    /// Catmull–Rom's spline in each direction, of sixteen points
    Bicubic,
    /// One value for each cell of the cover, that at its centre; no grid
    Cells,
    /// All of them
    All,
}

impl Method {
    /// The interpolations that are meant; none for the cells of the cover.
    fn meant(self) -> Vec<Option<Interpolation>> {
        use Interpolation::{Bicubic, Bilinear, Nearest};
        match self {
            Self::Nearest => vec![Some(Nearest)],
            Self::Bilinear => vec![Some(Bilinear)],
            Self::Bicubic => vec![Some(Bicubic)],
            Self::Cells => vec![None],
            Self::All => vec![Some(Nearest), Some(Bilinear), Some(Bicubic), None],
        }
    }
}

/// `N` or `NXxNY`.
fn grid(text: &str) -> Result<[u32; 2], String> {
    let square = text.parse().map(|n| [n, n]);
    square.or_else(|_| size(text)).map_err(|_| "write a whole number N, or two, NXxNY".into())
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        if let Some(path) = &self.output {
            target::check(path, target::Kind::Picture, self.inputs())?;
        }
        ensure!(
            !self.json || !self.output.as_deref().is_some_and(is_standard),
            "the picture and JSON cannot both go to standard output; give a file with -o"
        );
        let dataset = self.subject.open()?;
        let field = self.subject.field(&dataset)?;
        let asked = self.subject.quantity(&field)?;
        let (quantity, name) = (&asked.quantity, &asked.name);
        let pixels = plot_area("Title", &Design::pixels(self.size))?;
        let frame = Frame { pixels, may_shrink: true, margin: 0.0 };
        let view = self.window.seen(&field, frame)?;
        let style = self.colours.style(quantity)?;
        let job = measure::Job { field: &field, view, quantity, args: self };
        let found = threads::with(self.threads, || measure(job))??;
        let report = Report::new(&self.subject.file_name(), name, &view, &found);
        let mut colors = String::new();
        if let Some(path) = &self.output {
            let title = self.subject.replacements.title(&dataset.title);
            let labels = asked.labels(title, &field);
            let look = sheet::Look { field: &field, view, style, quantity, labels };
            let (bytes, direct) = self.picture(&found, look, name)?;
            if is_standard(path) {
                out.exact().write_all(&bytes)?;
            } else {
                target::save(path, |out| out.write_all(&bytes))?;
            }
            colors = format!("direct: {}\n", Telling::new(&dataset, &field).colors(&direct));
        }
        self.tell(&report, &colors, out)
    }

    /// The figure as a file, and the direct picture in it.
    fn picture(
        &self,
        found: &Measurements,
        look: sheet::Look<'_>,
        name: &str,
    ) -> anyhow::Result<(Vec<u8>, Picture)> {
        let (dataset, title) = (self.subject.file_name(), look.labels.title.clone());
        let (page, direct) = look.sheet(found, self.size)?;
        let mut texts = direct.description(&title, &dataset, name);
        for (key, text) in &mut texts {
            if key == "Description" {
                *text = format!("{name} of {dataset}, direct and resampled");
            }
        }
        let methods = found.resampled.iter().map(|one| ("ppum:resampled".to_owned(), one.name()));
        texts.extend(methods.chain(self.subject.replacements.notes()));
        Ok((png::encode(&page.image(), &texts).context("cannot encode the picture")?, direct))
    }

    /// Numbers on standard output, unless the picture goes there, and what the colours of the direct picture mean.
    fn tell(&self, report: &Report, colors: &str, out: &mut Output) -> anyhow::Result<()> {
        if self.json {
            return Ok(json(out, report)?);
        }
        match &self.output {
            Some(path) if is_standard(path) => {
                colors.lines().chain(table(report).lines()).for_each(tell);
            }
            Some(path) => {
                let table = table(report);
                writeln!(out, "wrote {}\n{colors}{}", path.display(), table.trim_end())?;
            }
            None => write!(out, "{}", table(report))?,
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain(self.colours.input())
    }
}
