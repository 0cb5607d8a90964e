//! `ppum plot`: curves of exact values, of convergence and of the solver's work.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, ensure};
use ppum::dataset::Dataset;
use ppum_figure::plot::{LEAST, Plot, plot};
use ppum_scene::list::parts;
use ppum_scene::plots::{self, PlotError, Profiles};

use crate::dataset::{field, open, open_results, open_step, quantities};
use crate::formula_text::files;
use crate::output::{StandardStream, tell};
use crate::page;
use crate::profile::ProfileArgs;
use crate::standard::{self, is_standard};
use crate::target;
use ppum_scene::arguments::page as page_size;

/// Plot exact values along a line, a crack or a circle, around a tip, or how a solution came about
///
/// The curves of several datasets are drawn in one plot. Near a tip, --tip K --angle A has
/// logarithmic axes and says the exponents of the power laws; --convergence compares solutions of
/// one problem on finer and finer covers.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("where").required(true))]
pub(crate) struct PlotArgs {
    /// Datasets
    #[arg(value_name = "FILE.h5", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    profile: ProfileArgs,
    /// Errors against unknowns, one dataset each: with respect to the exact solution, or of energy
    /// and stress intensity factors with respect to the largest dataset
    #[arg(long, group = "where")]
    convergence: bool,
    /// The solver's work: seconds of its phases, or --history=residuals and others
    #[arg(long, group = "where", value_enum, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "seconds")]
    history: Option<plots::SolverWork>,
    /// Stress intensity factors of all tips in the steps of a series
    #[arg(long, group = "where", conflicts_with = "step")]
    series: bool,
    /// Horizontal axis of --series
    #[arg(long, value_enum, requires = "series", default_value = "step")]
    over: plots::SeriesAxis,
    /// Quantities: von-mises, s1, sxx, ux or others of `ppum info`, formulas of them, or @FILE
    /// [default: those that suit]; with --series of k1, k2, load, length and extension [default:
    /// k1,k2]
    #[arg(short, long, value_name = "Q,…", allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["convergence", "history"])]
    quantity: Vec<String>,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
    /// Logarithmic axes: x, y or x,y
    #[arg(long, value_name = "AXES", value_delimiter = ',')]
    log: Vec<LogAxisArg>,
    /// Size in pixels
    #[arg(long, value_name = "WxH", value_parser = page_size, default_value = "900x600")]
    size: [u32; 2],
    /// File to write: .svg, .pdf or .png
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  ppum plot plate.h5 --line -1,0.1,1,0.1 -q syy,sxx -o line.svg
  ppum plot plate.h5 --crack 0 -o opening.svg
  ppum plot plate.h5 --crack 0 -q normal-traction,shear-traction -o tractions.svg
  ppum plot plate.h5 --tip 1 --radius 1e-6 -q sxx,syy,sxy -o around.png
  ppum plot plate.h5 --tip 1 --angle 0 -q syy -o singularity.pdf
  ppum plot coarse.h5 plate.h5 --circle 0,0,0.7 -q von-mises -o circle.svg
  ppum plot level-3.h5 level-4.h5 level-5.h5 level-6.h5 --convergence -o convergence.svg
  ppum plot plate.h5 --history -o seconds.svg
  ppum plot plate.h5 --history=residuals -o residuals.svg
  ppum plot growth.h5 --series --over extension -o k.svg";

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum LogAxisArg {
    /// The horizontal axis
    X,
    /// The vertical axis
    Y,
}

/// A dataset with the name of its file.
struct NamedFile {
    name: String,
    dataset: Dataset,
}

impl NamedFile {
    fn all(datasets: &[Self]) -> Vec<plots::NamedDataset<'_>> {
        datasets
            .iter()
            .map(|named| plots::NamedDataset { name: &named.name, dataset: &named.dataset })
            .collect()
    }
}

impl PlotArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        target::check(&self.output, target::FileKind::Picture, self.inputs())?;
        let [[width, height], [least_width, least_height]] = [self.size, LEAST];
        ensure!(
            width >= least_width && height >= least_height,
            "a plot of {width}x{height} pixels leaves no room; give at least {least_width}x{least_height}"
        );
        let datasets = self.datasets()?;
        let mut drawn = self.plot(&datasets)?;
        for axis in &self.log {
            let axis = if *axis == LogAxisArg::X { &mut drawn.x } else { &mut drawn.y };
            *axis = std::mem::take(axis).logarithmic();
        }
        for warning in plots::check(&drawn)? {
            tell(&format!("warning: {warning}"));
        }
        let page = plot(&drawn, self.size);
        let names: Vec<&str> = datasets.iter().map(|named| named.name.as_str()).collect();
        let texts = plots::texts(&names, &drawn);
        page::save(&self.output, &page, None, &texts, &plots::curves(&drawn), out)
    }

    fn plot(&self, datasets: &[NamedFile]) -> anyhow::Result<Plot> {
        let named = NamedFile::all(datasets);
        let plot = match (self.convergence, self.history) {
            (true, _) => plots::convergence(&named, self.step),
            (_, Some(what)) => plots::history(&named, what, self.step),
            _ if self.series => plots::series(&named, &self.numbers()?, self.over),
            _ => return self.profiles(&named),
        };
        plot.map_err(plot_error)
    }

    /// The numbers of --series, by default K_I and K_II.
    fn numbers(&self) -> anyhow::Result<Vec<plots::SeriesNumber>> {
        let words: Vec<&str> = self.quantity.iter().flat_map(|list| parts(list)).collect();
        if words.is_empty() {
            return Ok(vec![plots::SeriesNumber::K1, plots::SeriesNumber::K2]);
        }
        words.iter().map(|word| word.parse().map_err(plot_error)).collect()
    }

    /// A curve for each quantity of each dataset.
    fn profiles(&self, datasets: &[plots::NamedDataset<'_>]) -> anyhow::Result<Plot> {
        let jumps = self.quantity.is_empty() && self.profile.is_crack();
        let mut all = Profiles::new(self.profile.variable(), jumps, datasets.len() > 1);
        for named in datasets {
            let field = field(named.dataset, self.step)?;
            let wanted = match self.quantity.is_empty() && !jumps {
                true => &[plots::usual(&field).to_owned()][..],
                false => &self.quantity,
            };
            let quantities = quantities(&field, wanted)?;
            all.add(*named, &field, &quantities, &self.profile.drawn(&field, &quantities)?);
        }
        Ok(all.plot())
    }

    /// Reads what is needed of a dataset: all of it, the results of all steps, or one step.
    fn open(&self, file: &Path) -> anyhow::Result<Dataset> {
        match () {
            () if self.convergence => open(file),
            () if self.history.is_some() || self.series => open_results(file),
            () => open_step(file, self.step),
        }
    }

    fn datasets(&self) -> anyhow::Result<Vec<NamedFile>> {
        let standard = self.files.iter().filter(|file| is_standard(file)).count();
        ensure!(standard < 2, "standard input can be read once");
        let named = |file: &PathBuf| {
            let name = match file.file_stem() {
                Some(name) if !is_standard(file) => name.to_string_lossy().into_owned(),
                _ => standard::name(file),
            };
            Ok(NamedFile { name, dataset: self.open(file)? })
        };
        self.files.iter().map(named).collect()
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(PathBuf::as_path).chain(files(&self.quantity))
    }
}

/// An error in terms of the program's options.
fn plot_error(error: PlotError) -> anyhow::Error {
    match error {
        PlotError::FewDatasets => anyhow!(
            "--convergence compares three datasets or more, or the steps of one that has three or more"
        ),
        PlotError::FewSizes(_) | PlotError::OtherProblem { .. } => {
            anyhow!("--convergence: {error}")
        }
        PlotError::Grown(name) => anyhow!(
            "--convergence compares solutions of one problem, but the cracks of {name} grow from step to step; \
             --series draws what becomes of them"
        ),
        PlotError::OneStep(name) => {
            anyhow!("{name}: --series draws over steps, but there is one alone")
        }
        PlotError::UnknownNumber { name, known } => {
            anyhow!("--series draws {known}, not `{name}`")
        }
        PlotError::NoGrowth(_) => anyhow!("{error} (--over length)"),
        error => error.into(),
    }
}
