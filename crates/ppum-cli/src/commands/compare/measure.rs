//! The field drawn directly and resampled, with what each takes.

use std::time::Instant;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::RasterError;
use ppum_render::raster::Raster;
use ppum_render::resample::need::{GridConvergence, ResamplingSetup, converge};
use ppum_render::resample::{GridError, Interpolation, SampleGrid, representation_bytes};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::compare::ResampledImage;

use super::{CompareArgs, ComparisonRegion};
use crate::progress::ProgressLine;

/// The field, view and quantity that are compared.
#[derive(Clone, Copy)]
pub(super) struct ComparisonInput<'a> {
    pub(super) field: &'a Field<'a>,
    pub(super) view: View,
    pub(super) quantity: &'a Quantity,
    pub(super) args: &'a CompareArgs,
}

/// All that was found.
pub(super) struct Measurements {
    pub(super) direct: Raster,
    pub(super) direct_seconds: f64,
    pub(super) direct_bytes: u64,
    pub(super) methods: Vec<MethodResult>,
}

/// The image, times and errors of one method.
pub(super) struct MethodResult {
    pub(super) resampled: ResampledImage,
    /// Seconds for the samples, and for the image made of them; those of cells are together.
    pub(super) seconds: [f64; 2],
    /// Errors of other grids, and the error that was asked for.
    pub(super) convergence: Option<(GridConvergence, f64)>,
}

impl MethodResult {
    /// `bilinear, 64×64`.
    pub(super) fn name(&self) -> String {
        name(self.resampled.interpolation, self.resampled.grid.unwrap_or_default())
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
    job: ComparisonInput<'_>,
    methods: &[Option<Interpolation>],
) -> anyhow::Result<Measurements> {
    let ComparisonInput { field, view, quantity, .. } = job;
    let grid = job.grid()?;
    let (direct, direct_seconds) =
        timed(|| render::<f64>(field, &view, quantity, &ProgressLine::new()))?;
    let measured = methods.iter().map(|method| match method {
        Some(interpolation) => job.on_grid(&direct, grid, *interpolation),
        None => job.on_cells(&direct),
    });
    let (methods, direct_bytes) =
        (measured.collect::<anyhow::Result<_>>()?, representation_bytes(field));
    Ok(Measurements { methods, direct, direct_seconds, direct_bytes })
}

impl ComparisonInput<'_> {
    fn grid(&self) -> Result<SampleGrid, GridError> {
        match self.args.over {
            ComparisonRegion::Domain => SampleGrid::over_domain(self.field, self.args.grid),
            ComparisonRegion::View => SampleGrid::over_view(&self.view, self.args.grid),
        }
    }

    fn on_grid(
        &self,
        direct: &Raster,
        grid: SampleGrid,
        interpolation: Interpolation,
    ) -> anyhow::Result<MethodResult> {
        let Self { field, view, quantity, args } = *self;
        let (samples, sampling) = timed(|| grid.sample(field, quantity, &ProgressLine::new()))?;
        let draw = || Ok(ResampledImage::on_grid(&samples, interpolation, &view, direct));
        let (resampled, drawing) = timed(draw)?;
        let subject = ResamplingSetup { field, view: &view, quantity, grid, interpolation };
        let found = |error| anyhow::Ok((converge(&subject, error, &ProgressLine::new())?, error));
        let convergence = args.error.map(found).transpose()?;
        Ok(MethodResult { resampled, seconds: [sampling, drawing], convergence })
    }

    fn on_cells(&self, direct: &Raster) -> anyhow::Result<MethodResult> {
        let Self { field, view, quantity, .. } = *self;
        let draw =
            || ResampledImage::on_cells(field, quantity, &view, direct, &ProgressLine::new());
        let (resampled, seconds) = timed(draw)?;
        Ok(MethodResult { resampled, seconds: [seconds, 0.0], convergence: None })
    }
}

/// Returns the result of the work, and the seconds that passed.
fn timed<T>(work: impl FnOnce() -> Result<T, RasterError>) -> Result<(T, f64), RasterError> {
    let start = Instant::now();
    let made = work()?;
    Ok((made, start.elapsed().as_secs_f64()))
}
