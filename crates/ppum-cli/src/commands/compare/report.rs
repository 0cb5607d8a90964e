//! The numbers of a comparison.

use std::fmt::Write as _;

use ppum::text::trimmed_to;
use ppum_render::resample::need::{GridConvergence, GridNeed};
use ppum_render::resample::norms::{DifferenceNorms, NAMES};
use ppum_render::view::View;
use serde::Serialize;

use super::measure::{Measurements, MethodResult};
use crate::number::JsonNumber;

/// All numbers, as JSON shows them.
#[derive(Serialize)]
pub(super) struct ComparisonReport {
    file: String,
    quantity: String,
    center: [f64; 2],
    width: f64,
    pixels: [u32; 2],
    direct: Cost,
    resampled: Vec<MethodRow>,
}

#[derive(Serialize)]
struct Cost {
    bytes: u64,
    seconds: f64,
}

/// One method.
#[derive(Serialize)]
struct MethodRow {
    method: &'static str,
    grid: Option<[u32; 2]>,
    bytes: u64,
    seconds: f64,
    sampling_seconds: f64,
    #[serde(flatten)]
    errors: PixelErrors,
    needed: Option<NeededRow>,
}

/// Errors over the pixels of a view.
#[derive(Serialize)]
struct PixelErrors {
    absolute: [JsonNumber; 3],
    relative: [JsonNumber; 3],
    compared: usize,
    infinite: usize,
    lost: usize,
    invented: usize,
}

impl PixelErrors {
    fn new(norms: &DifferenceNorms) -> Self {
        let DifferenceNorms { compared, infinite, lost, invented, .. } = *norms;
        let [absolute, relative] =
            [norms.absolute, norms.relative()].map(|all| all.map(JsonNumber));
        Self { absolute, relative, compared, infinite, lost, invented }
    }
}

/// The grids for an error, in the three norms.
#[derive(Serialize)]
struct NeededRow {
    error: f64,
    grids: Vec<NeededGridRow>,
    measured: Vec<ComparisonNumbers>,
}

/// See [`ppum_scene::compare::NeededGrid`].
#[derive(Serialize)]
struct NeededGridRow {
    kind: &'static str,
    grid: Option<[JsonNumber; 2]>,
    reason: Option<&'static str>,
}

#[derive(Serialize)]
struct ComparisonNumbers {
    grid: [u32; 2],
    relative: [JsonNumber; 3],
}

impl ComparisonReport {
    pub(super) fn new(file: &str, quantity: &str, view: &View, found: &Measurements) -> Self {
        Self {
            file: file.to_owned(),
            quantity: quantity.to_owned(),
            center: view.center.into(),
            width: view.width,
            pixels: view.pixels,
            direct: Cost { bytes: found.direct_bytes, seconds: found.direct_seconds },
            resampled: found.methods.iter().map(MethodRow::new).collect(),
        }
    }
}

impl MethodRow {
    fn new(one: &MethodResult) -> Self {
        let [sampling, drawing] = one.seconds;
        Self {
            method: one
                .resampled
                .interpolation
                .map_or("cells", |interpolation| interpolation.name()),
            grid: one.resampled.grid,
            bytes: one.resampled.bytes,
            seconds: sampling + drawing,
            sampling_seconds: sampling,
            errors: PixelErrors::new(&one.resampled.norms),
            needed: one.convergence.as_ref().map(|(found, error)| NeededRow::new(found, *error)),
        }
    }
}

impl NeededRow {
    fn new(found: &GridConvergence, error: f64) -> Self {
        let measured = found.steps.iter().map(|(grid, norms)| ComparisonNumbers {
            grid: *grid,
            relative: norms.relative().map(JsonNumber),
        });
        let grids = (0..3).map(|norm| NeededGridRow::new(found.needed(norm, error)));
        Self { error, grids: grids.collect(), measured: measured.collect() }
    }
}

impl NeededGridRow {
    fn new(needed: GridNeed) -> Self {
        let words = ppum_scene::compare::NeededGrid::new(needed);
        Self { kind: words.kind, grid: words.size.map(|n| n.map(JsonNumber)), reason: words.reason }
    }

    fn text(&self) -> String {
        let size = |[nx, ny]: [JsonNumber; 2]| format!("{}×{}", short(nx.0), short(ny.0));
        match (self.kind, self.grid, self.reason) {
            ("extrapolated", Some(grid), _) => format!("{} (extrapolated)", size(grid)),
            (_, Some(grid), _) => size(grid),
            (_, None, Some("singular")) => {
                "no grid: the quantity is infinite at a point of the view".into()
            }
            (_, None, Some("jump")) => {
                "no grid: the quantity jumps across a crack in the view".into()
            }
            _ => "no grid: the error no longer fell".into(),
        }
    }
}

fn short(value: f64) -> String {
    trimmed_to(value, 3)
}

/// Bytes as people read them.
fn bytes(count: u64) -> String {
    let powers = [(1u64 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB")];
    match powers.into_iter().find(|(power, _)| count >= *power) {
        Some((power, unit)) => format!("{:.1} {unit}", count as f64 / power as f64),
        None => format!("{count} B"),
    }
}

/// The numbers as a table.
pub(super) fn table(report: &ComparisonReport) -> String {
    let [columns, rows] = report.pixels;
    let mut text = format!("{} of {}, {columns}x{rows} pixels\n\n", report.quantity, report.file);
    let mut line = |cells: [&str; 6]| {
        let [name, memory, time, l1, l2, max] = cells;
        let line = format!("{name:<24} {memory:>10} {time:>9}   {l1:>9} {l2:>9} {max:>9}");
        text += line.trim_end();
        text += "\n";
    };
    line(["", "memory", "seconds", NAMES[0], NAMES[1], NAMES[2]]);
    let Cost { bytes: memory, seconds } = report.direct;
    line(["direct", &bytes(memory), &format!("{seconds:.3}"), "", "", ""]);
    for row in &report.resampled {
        let [l1, l2, max] = row.errors.absolute.map(|v| short(v.0));
        let name =
            row.grid.map_or("one value a cell".into(), |[x, y]| format!("{}, {x}×{y}", row.method));
        line([&name, &bytes(row.bytes), &format!("{:.3}", row.seconds), &l1, &l2, &max]);
        let [l1, l2, max] = row.errors.relative.map(|v| short(v.0));
        line(["  relative", "", "", &l1, &l2, &max]);
    }
    for row in &report.resampled {
        text += &remarks(row);
    }
    text
}

/// Writes remarks that do not fit into a row of the table.
fn remarks(row: &MethodRow) -> String {
    let (errors, mut text, method) = (&row.errors, String::new(), row.method);
    let counts = [
        (errors.lost, "pixels of the plate have no value, next to holes or the border"),
        (errors.invented, "pixels outside the plate have a value"),
        (errors.infinite, "pixels are infinite in one of the pictures: L∞ is"),
    ];
    for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
        let _ = writeln!(text, "{method}: {count} {what}");
    }
    if let Some(needed) = &row.needed {
        let _ =
            writeln!(text, "\n{method}: the grid for a relative error of {}", short(needed.error));
        for (name, grid) in NAMES.iter().zip(&needed.grids) {
            let _ = writeln!(text, "  {name:<3} {}", grid.text());
        }
    }
    text
}
