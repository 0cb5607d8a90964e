//! `ppum compare`: a direct picture beside what resampling gives.

mod measure;
mod report;
mod sheet;

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::ensure;
use clap::ValueEnum;
use ppum_figure::figure::Labels;
use ppum_render::picture::Picture;
use ppum_render::png::Text;
use ppum_render::resample::Interpolation;

use crate::arguments::{MOST_OF_PAGE, positive, size};
use crate::look::LookArgs;
use crate::number::json;
use crate::output::{Output, tell};
use crate::standard::is_standard;
use crate::subject::{ColorArgs, QuantityArgs};
use crate::window::{ImageExtent, WindowArgs};
use crate::{page, target, threads};
use measure::{Measurements, measure};
use ppum_scene::range::Telling;
use report::{Report, table};
use sheet::Layout;

/// Compare direct drawing with resampling: pictures, errors, memory, time
///
/// Resampling takes exact values at the points of a grid, as other programs do, and interpolates
/// them at the pixels. The picture shows the field, what each method makes of it, and
/// the differences.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: QuantityArgs,
    /// Picture to write, - for standard output; without it numbers only
    #[arg(short, long, value_name = "OUT.png|svg|pdf")]
    output: Option<PathBuf>,
    /// Points of the grid, borders included
    #[arg(long, value_name = "N|NXxNY", value_parser = grid, default_value = "64")]
    grid: [u32; 2],
    /// The rectangle of the grid
    #[arg(long, value_enum, default_value = "domain")]
    over: ComparisonRegion,
    /// How values between the points are found
    #[arg(long, value_enum, value_delimiter = ',', default_value = "bilinear")]
    method: Vec<MethodArg>,
    /// Find the grids that have no larger relative error
    #[arg(long, value_name = "E", value_parser = positive)]
    error: Option<f64>,
    #[command(flatten)]
    look: LookArgs,
    #[command(flatten)]
    window: WindowArgs,
    #[command(flatten)]
    colours: ColorArgs,
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
  ppum compare plate.h5 -o paper.pdf --inches 7x2.4 --font-size 6
  ppum compare plate.h5 -o cells.png --method cells --over view --view 0,-0.2,0.4,0.2";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ComparisonRegion {
    /// The box of the domain
    Domain,
    /// What the picture shows
    View,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodArg {
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

impl MethodArg {
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

/// Refuses pages that are too large: everything else on them is drawn as large as they are.
fn check_page([columns, rows]: [u32; 2]) -> anyhow::Result<()> {
    ensure!(
        u64::from(columns) * u64::from(rows) <= MOST_OF_PAGE,
        "a page of {columns}x{rows} pixels; at most {MOST_OF_PAGE}, such as 8192x8192"
    );
    Ok(())
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        if let Some(path) = &self.output {
            target::check(path, target::FileKind::Picture, self.inputs())?;
        }
        ensure!(
            !self.json || !self.output.as_deref().is_some_and(is_standard),
            "the picture and JSON cannot both go to standard output; give a file with -o"
        );
        let dataset = self.subject.open()?;
        let field = self.subject.field(&dataset)?;
        let (quantity, asked) = self.subject.quantity(&field)?;
        let methods = self.methods();
        let title = self.subject.replacements.title(&dataset.title);
        let [symbol, unit] = asked.shown.words(&field);
        let labels = Labels { title, quantity: symbol, unit, ..Labels::default() };
        let labels = self.look.texts().applied(labels);
        let layout = Layout::new(self, &field, &labels, &methods);
        check_page(layout.size())?;
        let frame = ImageExtent { pixels: layout.room()?, may_shrink: true, margin: 0.0 };
        let view = self.window.seen(&field, frame)?;
        let job = measure::ComparisonInput { field: &field, view, quantity: &quantity, args: self };
        let found = threads::with(self.threads, || measure(job, &methods))??;
        let report = Report::new(&self.subject.file_name(), &asked.name, &view, &found);
        let mut told = String::new();
        if let Some(path) = &self.output {
            let colors = self.colours.chosen();
            let style = colors.style(Some(&quantity), colors.map(Some(&quantity))?);
            let (page, direct) = layout.draw(&found, job, &style)?;
            let texts = self.texts(&direct, &dataset.title, &asked.name, &found);
            page::put(path, &page, self.look.given_dpi(), &texts, out)?;
            let ([columns, rows], telling) = (page.size, Telling::new(&dataset, &field));
            told = format!("{columns}x{rows} pixels, direct: {}", telling.colors(&direct));
        }
        self.tell(&report, &told, out)
    }

    /// The interpolations, each once; none for the cells of the cover.
    fn methods(&self) -> Vec<Option<Interpolation>> {
        let mut methods = Vec::new();
        for method in self.method.iter().flat_map(|method| method.meant()) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }

    /// The texts of the figure's file.
    fn texts(&self, direct: &Picture, title: &str, name: &str, found: &Measurements) -> Vec<Text> {
        let file = self.subject.file_name();
        let mut texts = direct.description(title, &file, name);
        for (key, text) in &mut texts {
            if key == "Description" {
                *text = format!("{name} of {file}, direct and resampled");
            }
        }
        let methods = found.methods.iter().map(|one| ("ppum:resampled".to_owned(), one.name()));
        texts.extend(methods.chain(self.subject.replacements.notes()));
        texts
    }

    /// Numbers on standard output, unless the picture goes there; of that what its colours mean.
    fn tell(&self, report: &Report, told: &str, out: &mut Output) -> anyhow::Result<()> {
        if self.json {
            return Ok(json(out, report)?);
        }
        let table = table(report);
        match &self.output {
            Some(path) if is_standard(path) => {
                [told].into_iter().chain(table.lines()).for_each(tell)
            }
            Some(path) => writeln!(out, "wrote {}: {told}\n{}", path.display(), table.trim_end())?,
            None => write!(out, "{table}")?,
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain(self.colours.input())
    }
}
