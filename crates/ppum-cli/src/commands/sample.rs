//! `ppum sample`: exact values along lines and cracks, at lists of points and on grids, for plots.

mod along;
mod points;
mod table;

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{bail, ensure};
use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher};
use ppum::quantity::Quantity;
use ppum::sample::{self, Place};
use ppum::vec2::Rect;
use rayon::prelude::*;

use crate::arguments::{corners, ends, size};
use crate::dataset::{field, open, quantities};
use crate::given::{self, parts};
use crate::output::{Output, tell};
use crate::progress::Bar;
use crate::replacements::Replacements;
use crate::standard::is_standard;
use crate::target;
use crate::undefined;
use table::{Column, Table};

/// Write exact values along a line or a crack, at points or on a grid
///
/// A table as CSV or NPY (numpy), by the extension of the output. Of a point on a crack there are two
/// rows, one for each side; a grid has the upper side alone.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("where").required(true))]
pub(crate) struct Args {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Along the line between two points
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = ends)]
    #[arg(group = "where")]
    line: Option<[ppum::vec2::Vec2; 2]>,
    /// At the points of a text file, - for standard input: a line with x and y for each
    #[arg(long, value_name = "P.csv", group = "where")]
    points: Option<PathBuf>,
    /// On a grid of columns and rows of points, borders included
    #[arg(long, value_name = "NXxNY", value_parser = size, group = "where")]
    grid: Option<[u32; 2]>,
    /// Along a crack, numbered from 0: both sides, jumps and opening
    #[arg(long, value_name = "K", group = "where")]
    crack: Option<usize>,
    /// Number of points along a line or crack [default: 201]
    #[arg(long, value_name = "N", conflicts_with_all = ["points", "grid"])]
    count: Option<usize>,
    /// Box of the grid by two opposite corners [default: that of the domain]
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = corners)]
    #[arg(requires = "grid")]
    view: Option<Rect>,
    /// Quantities, see `ppum info`, or formulas of them, or @FILE [default: the components; for
    /// elasticity also the stresses]
    #[arg(short, long, value_name = "Q,…", allow_hyphen_values = true)]
    quantity: Vec<String>,
    #[command(flatten)]
    replacements: Replacements,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
    /// File to write, .csv or .npy; - for CSV to standard output [default: -]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum sample plate.h5 --line -1,0.1,1,0.1 --count 500 -q uy,syy -o line.csv
  ppum sample plate.h5 --crack 0 -o crack.csv
  ppum sample plate.h5 --grid 400x300 -q von-mises -o field.npy
  ppum sample plate.h5 --points gauges.csv -q 'exx,eyy,2*exy'";

/// Points along a line or crack if nothing is said.
const COUNT: usize = 201;

/// Most points at a time: their table takes some gigabytes.
const MOST: usize = 20_000_000;

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        if let Some(output) = &self.output {
            target::check(output, target::Kind::Table, self.inputs())?;
        }
        let mut dataset = open(&self.file)?;
        self.replacements.apply(&mut dataset, self.step)?;
        let field = field(&dataset, self.step)?;
        let quantities = quantities(&field, &self.quantity)?;
        let table = self.table(&field, &quantities)?;
        table.check_names()?;
        match self.output.as_deref().filter(|path| !is_standard(path)) {
            Some(path) => {
                table.save(path)?;
                writeln!(out, "wrote {}: {}", path.display(), table.summary())?;
            }
            None => table.write_csv(out.exact())?,
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let files = [&self.file].into_iter().chain(&self.points).map(PathBuf::as_path);
        let formulas = self.quantity.iter().flat_map(|list| parts(list)).filter_map(given::file);
        files.chain(formulas).chain(self.replacements.files())
    }

    fn table(&self, field: &Field<'_>, quantities: &[(String, Quantity)]) -> anyhow::Result<Table> {
        let count = self.count.unwrap_or(COUNT);
        ensure!(count >= 2, "--count {count}: a line has two points or more");
        ensure!(count <= MOST, "--count {count}: at most {MOST} points at a time");
        let cracks = &field.step.cracks;
        if let Some(crack) = self.crack {
            return along::table(field, quantities, crack, count);
        }
        if let Some([a, b]) = self.line {
            ensure!(a != b, "--line: its two points are equal");
            let places = sample::line(cracks, a, b, count);
            let lengths = places.iter().map(|place| (place.point - a).length()).collect();
            let table = listed(field, quantities, &places)?;
            return Ok(table.with_first(Column::new("s", ""), lengths));
        }
        if let Some(path) = &self.points {
            return listed(field, quantities, &sample::points(cracks, &points::read(path)?));
        }
        let Some([nx, ny]) = self.grid else { bail!("give --line, --points, --grid or --crack") };
        let points = nx as usize * ny as usize;
        ensure!(nx > 0 && ny > 0, "--grid {nx}x{ny}: has no points");
        ensure!(points <= MOST, "--grid {nx}x{ny}: at most {MOST} points at a time");
        let window = self.view.unwrap_or(field.domain.bounds);
        let places = sample::grid(cracks, window, [nx, ny]);
        Ok(listed(field, quantities, &places)?.with_shape([ny as usize, nx as usize]))
    }
}

/// The quantities at all places, one row for each, on all cores.
fn evaluate(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[Place],
) -> anyhow::Result<Vec<f64>> {
    let (bar, done, total) = (Bar::new(), AtomicUsize::new(0), places.len());
    let watcher: &dyn Watcher = &bar;
    let values = |batch: &&[Place]| {
        let done = done.fetch_add(batch.len(), Ordering::Relaxed);
        watcher.report(Progress::new(Phase::Evaluation, done, total))?;
        Ok(sample::evaluate_batch(field, quantities, batch))
    };
    let batches: Vec<_> = sample::batches(places).collect();
    let rows = batches.par_iter().map(values).collect::<anyhow::Result<Vec<_>>>()?;
    Ok(rows.concat())
}

/// One row for each place: position, side, quantities.
fn listed(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: &[Place],
) -> anyhow::Result<Table> {
    let wanted: Vec<_> = quantities.iter().map(|(_, quantity)| quantity.clone()).collect();
    let values = evaluate(field, &wanted, places)?;
    tell_undefined(field, quantities, places, &values);
    let of = |(name, quantity): &(String, Quantity)| Column::new(name, quantity.unit(field));
    let head = ["x", "y", "side"].map(|name| Column::new(name, ""));
    let columns = head.into_iter().chain(quantities.iter().map(of)).collect();
    let mut rows = Vec::with_capacity(places.len() * (3 + quantities.len()));
    for (place, values) in places.iter().zip(values.chunks(quantities.len())) {
        rows.extend([place.point.x, place.point.y, place.mark()]);
        rows.extend(values);
    }
    Ok(Table::new(columns, rows))
}

/// Tells which quantities have no value at places of the plate.
fn tell_undefined(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: &[Place],
    values: &[f64],
) {
    let width = quantities.len();
    let is_inside = |k: usize| field.domain.at(places[k].anchor).contains(places[k].offset);
    for (column, (name, _)) in quantities.iter().enumerate() {
        let is_undefined = |k: &usize| values[k * width + column].is_nan() && is_inside(*k);
        let count = (0..places.len()).filter(is_undefined).count();
        if count > 0 {
            let inside = (0..places.len()).filter(|&k| is_inside(k)).count();
            tell(&format!("warning: {}", undefined::message(name, [count, inside], "points")));
        }
    }
}
