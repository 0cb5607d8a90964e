//! The field drawn directly and resampled, with what each takes.

use std::time::Instant;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::RenderError;
use ppum_render::raster::Raster;
use ppum_render::resample::need::{Convergence, Subject, converge};
use ppum_render::resample::norms::{Norms, norms};
use ppum_render::resample::{Grid, GridError, Interpolation, cells, representation_bytes};
use ppum_render::scatter::render;
use ppum_render::view::View;

use super::{Args, Over};
use crate::progress::Bar;

/// The subject of a comparison.
#[derive(Clone, Copy)]
pub(super) struct Job<'a> {
    pub(super) field: &'a Field<'a>,
    pub(super) view: View,
    pub(super) quantity: &'a Quantity,
    pub(super) args: &'a Args,
}

/// All that was found.
pub(super) struct Measurements {
    pub(super) direct: Raster,
    pub(super) direct_seconds: f64,
    pub(super) direct_bytes: u64,
    pub(super) resampled: Vec<Resampled>,
}

/// What one method gave.
pub(super) struct Resampled {
    /// Of the cells of the cover none.
    pub(super) interpolation: Option<Interpolation>,
    /// Points of the grid.
    pub(super) grid: Option<[u32; 2]>,
    pub(super) bytes: u64,
    /// Seconds for the samples, and for the picture made of them; those of cells are together.
    pub(super) seconds: [f64; 2],
    pub(super) raster: Raster,
    pub(super) norms: Norms,
    /// Errors of other grids, and the error that was asked for.
    pub(super) convergence: Option<(Convergence, f64)>,
}

impl Resampled {
    /// `bilinear, 64×64`.
    pub(super) fn name(&self) -> String {
        name(self.interpolation, self.grid.unwrap_or_default())
    }
}

/// The name of a method on a grid of so many points: `bilinear, 64×64`.
pub(super) fn name(interpolation: Option<Interpolation>, [nx, ny]: [u32; 2]) -> String {
    match interpolation {
        Some(interpolation) => format!("{interpolation}, {nx}×{ny}"),
        None => "one value a cell".into(),
    }
}

/// Draws and measures, in double precision.
pub(super) fn measure(
    job: Job<'_>,
    methods: &[Option<Interpolation>],
) -> anyhow::Result<Measurements> {
    let Job { field, view, quantity, .. } = job;
    let grid = job.grid()?;
    let (direct, direct_seconds) = timed(|| render::<f64>(field, &view, quantity, &Bar::new()))?;
    let resampled = methods.iter().map(|method| match method {
        Some(interpolation) => job.on_grid(&direct, grid, *interpolation),
        None => job.on_cells(&direct),
    });
    let resampled = resampled.collect::<anyhow::Result<_>>()?;
    Ok(Measurements {
        resampled,
        direct,
        direct_seconds,
        direct_bytes: representation_bytes(field),
    })
}

impl Job<'_> {
    fn grid(&self) -> Result<Grid, GridError> {
        match self.args.over {
            Over::Domain => Grid::over_domain(self.field, self.args.grid),
            Over::View => Grid::over_view(&self.view, self.args.grid),
        }
    }

    fn on_grid(
        &self,
        direct: &Raster,
        grid: Grid,
        interpolation: Interpolation,
    ) -> anyhow::Result<Resampled> {
        let Self { field, view, quantity, args } = *self;
        let (samples, sampling) = timed(|| grid.sample(field, quantity, &Bar::new()))?;
        let (raster, drawing) = timed(|| Ok(samples.raster(interpolation, &view)))?;
        let subject = Subject { field, view: &view, quantity, grid, interpolation };
        let found = |error| anyhow::Ok((converge(&subject, error, &Bar::new())?, error));
        Ok(Resampled {
            interpolation: Some(interpolation),
            grid: Some(grid.size),
            bytes: grid.bytes(),
            seconds: [sampling, drawing],
            norms: norms(direct, &raster),
            raster,
            convergence: args.error.map(found).transpose()?,
        })
    }

    fn on_cells(&self, direct: &Raster) -> anyhow::Result<Resampled> {
        let Self { field, view, quantity, .. } = *self;
        let (raster, seconds) = timed(|| cells(field, &view, quantity, &Bar::new()))?;
        Ok(Resampled {
            interpolation: None,
            grid: None,
            bytes: 8 * field.step.partition.len() as u64,
            seconds: [seconds, 0.0],
            norms: norms(direct, &raster),
            raster,
            convergence: None,
        })
    }
}

/// What was made, and the seconds that passed.
fn timed<T>(work: impl FnOnce() -> Result<T, RenderError>) -> Result<(T, f64), RenderError> {
    let start = Instant::now();
    let made = work()?;
    Ok((made, start.elapsed().as_secs_f64()))
}
