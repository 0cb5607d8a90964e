//! Arguments of `ppum compare`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::ValueEnum;
use ppum_render::resample::Interpolation;
use ppum_scene::arguments::{positive, size};
use ppum_scene::colors::ColorOptions;
use ppum_scene::page_style::PageStyle;
use ppum_scene::region::ViewRegion;

use crate::labels::LabelArgs;
use crate::subject::QuantityArgs;
use crate::threads;

/// Compare direct drawing with resampling: images, errors, memory, time
///
/// Resampling takes exact values at the points of a grid, as other programs do, and interpolates
/// them at the pixels. The image shows the field, what each method makes of it, and
/// the differences.
#[derive(Debug, clap::Args)]
#[command(
    after_help = EXAMPLES,
    mut_arg("quantity", |argument| argument.help(QUANTITY)),
    mut_arg("part", |argument| argument.help(PART)),
)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(super) subject: QuantityArgs,
    /// Image to write, - for standard output; without it numbers only
    #[arg(short, long, value_name = "OUT.png|svg|pdf")]
    pub(super) output: Option<PathBuf>,
    /// Points of the grid, including those on its edges
    #[arg(long, value_name = "N|NXxNY", value_parser = grid, default_value = "64")]
    pub(super) grid: [u32; 2],
    /// The rectangle of the grid
    #[arg(long, value_enum, default_value = "domain")]
    pub(super) over: ComparisonRegion,
    /// Interpolation between the points
    #[arg(long, value_enum, value_delimiter = ',', default_value = "bilinear")]
    pub(super) method: Vec<MethodArg>,
    /// Find the smallest grids with at most this relative error
    #[arg(long, value_name = "E", value_parser = positive)]
    pub(super) error: Option<f64>,
    #[command(flatten)]
    pub(super) look: PageStyle,
    #[command(flatten)]
    pub(super) labels: LabelArgs,
    #[command(flatten)]
    pub(super) place: ViewRegion,
    #[command(flatten)]
    pub(super) colors: ColorOptions,
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
    /// Number of threads [default: all cores]; errors do not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    pub(super) threads: Option<NonZeroUsize>,
}

const QUANTITY: &str = "Quantity: von-mises, s1, sxx, ux or another of `ppum info`, a formula of quantities, or \
     @FILE with one [default: von-mises; for Poisson problems u]";

const PART: &str = "Evaluate only one contribution to the field: smooth, jump, tip, other (corner and \
     user-defined functions), or patch:N";

const EXAMPLES: &str = "\
Examples:
  ppum compare plate.h5 -o compare.png --grid 64
  ppum compare plate.h5 -o all.png --grid 256 --method all -q uy --tip 1
  ppum compare plate.h5 --grid 2048x1024 --error 1e-2 --json
  ppum compare plate.h5 -o paper.pdf --inches 7x2.4 --font-size 6
  ppum compare plate.h5 -o cells.png --method cells --over view --view 0,-0.2,0.4,0.2";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ComparisonRegion {
    /// The box of the domain
    Domain,
    /// The rectangle of the view
    View,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MethodArg {
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
    pub(super) fn meant(self) -> Vec<Option<Interpolation>> {
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
