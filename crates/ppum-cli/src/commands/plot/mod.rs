//! `ppum plot`: curves of exact values, of convergence and of the solver's work.

mod convergence;
mod history;
mod profiles;
mod seen;
mod series;

use std::path::{Path, PathBuf};

use anyhow::ensure;
use ppum::dataset::Dataset;
use ppum_figure::plot::{LEAST, Plot, plot};

use crate::arguments::page as page_size;
use crate::dataset::{open, open_results, open_step};
use crate::given::{self, parts};
use crate::output::Output;
use crate::page;
use crate::profile::Profile;
use crate::standard::{self, is_standard};
use crate::target;
use history::What;
use series::Over;

/// Plot exact values along a line, a crack or a circle, around a tip, or how a solution came about
///
/// Of several datasets the curves stand in one plot. Near a tip, --tip K --angle A has logarithmic axes and says the
/// exponents of the power laws; --convergence compares solutions of one problem on finer and finer covers.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("where").required(true))]
pub(crate) struct Args {
    /// Datasets
    #[arg(value_name = "FILE.h5", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    profile: Profile,
    /// Errors against unknowns, a dataset each: those of the exact solution, or the distance of energy and stress
    /// intensity factors from those of the largest dataset
    #[arg(long, group = "where")]
    convergence: bool,
    /// The solver's work: seconds of its phases, or --history=residuals and others
    #[arg(long, group = "where", value_enum, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "seconds")]
    history: Option<What>,
    /// Stress intensity factors of all tips in the steps of a series
    #[arg(long, group = "where", conflicts_with = "step")]
    series: bool,
    /// What --series is drawn over
    #[arg(long, value_enum, requires = "series", default_value = "step")]
    over: Over,
    /// Quantities, see `ppum info`, or formulas of them, or @FILE [default: those that suit]; with --series of k1, k2,
    /// load, length and extension [default: k1,k2]
    #[arg(short, long, value_name = "Q,…", allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["convergence", "history"])]
    quantity: Vec<String>,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
    /// Logarithmic axes: x, y or x,y
    #[arg(long, value_name = "AXES", value_delimiter = ',')]
    log: Vec<Axis>,
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
  ppum plot plate.h5 --tip 1 --radius 1e-6 -q sxx,syy,sxy -o around.png
  ppum plot plate.h5 --tip 1 --angle 0 -q syy -o singularity.pdf
  ppum plot coarse.h5 plate.h5 --circle 0,0,0.7 -q von-mises -o circle.svg
  ppum plot level-3.h5 level-4.h5 level-5.h5 level-6.h5 --convergence -o convergence.svg
  ppum plot plate.h5 --history -o seconds.svg
  ppum plot plate.h5 --history=residuals -o residuals.svg
  ppum plot growth.h5 --series --over extension -o k.svg";

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Axis {
    /// The horizontal axis
    X,
    /// The vertical axis
    Y,
}

/// A dataset with the name of its file.
struct Named {
    name: String,
    dataset: Dataset,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        let [[width, height], [least_width, least_height]] = [self.size, LEAST];
        ensure!(
            width >= least_width && height >= least_height,
            "a plot of {width}x{height} pixels leaves no room; give at least {least_width}x{least_height}"
        );
        let datasets = self.datasets()?;
        let mut drawn = self.plot(&datasets)?;
        for axis in &self.log {
            let axis = if *axis == Axis::X { &mut drawn.x } else { &mut drawn.y };
            *axis = std::mem::take(axis).logarithmic();
        }
        seen::check(&drawn)?;
        let page = plot(&drawn, self.size);
        page::save(&self.output, &page, None, &texts(&datasets, &drawn), &curves(&drawn), out)
    }

    fn plot(&self, datasets: &[Named]) -> anyhow::Result<Plot> {
        if self.convergence {
            return convergence::plot(datasets, self.step);
        }
        if let Some(what) = self.history {
            return history::plot(datasets, what, self.step);
        }
        if self.series {
            return series::plot(datasets, &self.quantity, self.over);
        }
        profiles::plot(datasets, &self.profile, &self.quantity, self.step)
    }

    /// What of a dataset is drawn: all of it, what its solver tells of all steps, or one step.
    fn open(&self, file: &Path) -> anyhow::Result<Dataset> {
        match () {
            () if self.convergence => open(file),
            () if self.history.is_some() || self.series => open_results(file),
            () => open_step(file, self.step),
        }
    }

    fn datasets(&self) -> anyhow::Result<Vec<Named>> {
        let standard = self.files.iter().filter(|file| is_standard(file)).count();
        ensure!(standard < 2, "standard input can be read once");
        let named = |file: &PathBuf| {
            let name = match file.file_stem() {
                Some(name) if !is_standard(file) => name.to_string_lossy().into_owned(),
                _ => standard::name(file),
            };
            Ok(Named { name, dataset: self.open(file)? })
        };
        self.files.iter().map(named).collect()
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let formulas = self.quantity.iter().flat_map(|list| parts(list)).filter_map(given::file);
        self.files.iter().map(PathBuf::as_path).chain(formulas)
    }
}

/// What a plot's file says of itself.
fn texts(datasets: &[Named], plot: &Plot) -> Vec<(String, String)> {
    let names: Vec<_> = datasets.iter().map(|named| named.name.as_str()).collect();
    let summary = format!("{} of {}, evaluated exactly", curves(plot), names.join(", "));
    [
        ("Title", plot.title.clone()),
        ("Software", concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Description", summary),
    ]
    .map(|(key, text)| (key.to_owned(), text))
    .into()
}

/// The names of the curves.
fn curves(plot: &Plot) -> String {
    plot.curves.iter().map(|curve| plain(&curve.label)).collect::<Vec<_>>().join(", ")
}

/// A label of a plot as it is told in messages: `K_I` for `K_{I}`.
fn plain(label: &str) -> String {
    let mut parts = label.split("_{");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (subscript, rest) = part.split_once('}').unwrap_or((part, ""));
        text.extend(["_", subscript, rest]);
    }
    text
}

/// A label of several curves: with the dataset's name where there are several datasets.
fn label(datasets: &[Named], dataset: &Named, name: &str) -> String {
    if datasets.len() > 1 { format!("{}: {name}", dataset.name) } else { name.to_owned() }
}
