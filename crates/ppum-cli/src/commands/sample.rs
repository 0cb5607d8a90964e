//! `ppum sample`: exact values along lines, cracks and circles, at lists of points and on grids.

mod points;

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::bail;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::sample;
use ppum::vec2::Rect;
use ppum_scene::table::NumberTable;

use crate::dataset::quantities;
use crate::formula_text::files;
use crate::output::StandardStream;
use crate::profile::{ProfileArgs, check_grid, listed, save};
use crate::standard::is_standard;
use crate::subject::StepArgs;
use crate::target;
use ppum_scene::arguments::{corners, size};

/// Write exact values along a line, a crack or a circle, at points or on a grid
///
/// A table as CSV or NPY (numpy), by the extension of the output. A point on a crack gives two
/// rows, one for each side; a grid has the upper side alone.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("where").required(true))]
pub(crate) struct SampleArgs {
    #[command(flatten)]
    profile: ProfileArgs,
    /// At the points of a text file, - for standard input: a line with x and y for each
    #[arg(long, value_name = "P.csv", group = "where", conflicts_with = "count")]
    points: Option<PathBuf>,
    /// On a grid of columns and rows of points, borders included
    #[arg(long, value_name = "NXxNY", value_parser = size, group = "where")]
    #[arg(conflicts_with = "count")]
    grid: Option<[u32; 2]>,
    /// Box of the grid by two opposite corners [default: that of the domain]
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = corners)]
    #[arg(requires = "grid")]
    view: Option<Rect>,
    /// Quantities: von-mises, s1, sxx, ux or others of `ppum info`, formulas of them, or @FILE
    /// [default: the components; for elasticity also the stresses]
    #[arg(short, long, value_name = "Q,…", allow_hyphen_values = true)]
    quantity: Vec<String>,
    #[command(flatten)]
    step: StepArgs,
    /// File to write, .csv or .npy; - for CSV to standard output [default: -]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum sample plate.h5 --line -1,0.1,1,0.1 --count 500 -q uy,syy -o line.csv
  ppum sample plate.h5 --crack 0 -o crack.csv
  ppum sample plate.h5 --tip 1 --radius 1e-6 -q syy -o around.csv
  ppum sample plate.h5 --grid 400x300 -q von-mises -o field.npy
  ppum sample plate.h5 --points gauges.csv -q 'exx,eyy,2*exy'";

impl SampleArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        if let Some(output) = &self.output {
            target::check(output, target::FileKind::Table, self.inputs())?;
        }
        let dataset = self.step.open()?;
        let field = self.step.field(&dataset)?;
        let quantities = quantities(&field, &self.quantity)?;
        let table = self.table(&field, &quantities)?;
        table.check_names()?;
        match self.output.as_deref().filter(|path| !is_standard(path)) {
            Some(path) => {
                save(&table, path)?;
                writeln!(out, "wrote {}: {}", path.display(), table.summary())?;
            }
            None => table.write_csv(out.exact())?,
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let points = self.points.as_deref().into_iter();
        self.step.inputs().chain(points).chain(files(&self.quantity))
    }

    fn table(
        &self,
        field: &Field<'_>,
        quantities: &[(String, Quantity)],
    ) -> anyhow::Result<NumberTable> {
        if self.profile.is_given() {
            return self.profile.table(field, quantities);
        }
        let cracks = &field.step.cracks;
        if let Some(path) = &self.points {
            let mut places = sample::points(cracks, &points::read(path)?);
            sample::settle(field.domain, &mut places);
            return listed(field, quantities, places);
        }
        let Some([nx, ny]) = self.grid else {
            bail!("give --line, --crack, --circle, --tip, --points or --grid")
        };
        check_grid([nx, ny])?;
        let window = self.view.unwrap_or(field.domain.bounds);
        let mut places = sample::grid(cracks, window, [nx, ny]);
        sample::settle(field.domain, &mut places);
        Ok(listed(field, quantities, places)?.with_shape([ny as usize, nx as usize]))
    }
}
