//! The choice between the processor and a graphics device.
//!
//! The choice is made here and nowhere else. Whatever draws gives a raster of values; ranges, colours, overlays
//! and figures are made of it by the same code.

use std::num::NonZeroUsize;
use std::sync::Once;

use clap::ValueEnum;
use ppum::quantity::Source;
use ppum_render::raster::{Raster, Sample};
use ppum_render::samples::{Samples, means};
use ppum_render::scatter::render;

use crate::graphics::{Device, Method};
use crate::output::tell;
use crate::progress::Bar;
use crate::{graphics, threads};
use ppum_scene::drawing::{Drawn, Job, Values, single_precision_warning};

/// The warning about single precision is given once, not for each picture of a series.
static TOLD: Once = Once::new();

/// The options that choose who draws.
#[derive(Debug, clap::Args)]
pub(crate) struct Engine {
    /// What computes the values
    #[arg(long, value_enum, default_value = "auto")]
    backend: Backend,
    /// Precision of the computation [default: that of the backend, f64 on the CPU, f32 on the GPU]
    #[arg(long, value_enum)]
    precision: Option<Precision>,
    /// Number of threads of the CPU [default: all cores]; the picture does not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
}

/// What computes the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Backend {
    /// A graphics card if there is one and it can, else the CPU
    Auto,
    /// This machine's processor
    Cpu,
    /// Any graphics device, a software one too: one pass that gathers
    Gpu,
    /// The same by the three passes of Üffinger et al. 2011, to compare
    Splat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Precision {
    F64,
    F32,
}

impl Engine {
    /// Refuses combinations that clap cannot see.
    pub(crate) fn check(&self) -> anyhow::Result<()> {
        let on_gpu = matches!(self.backend, Backend::Gpu | Backend::Splat);
        anyhow::ensure!(
            !on_gpu || self.precision != Some(Precision::F64),
            "graphics devices compute in single precision; use --backend cpu, or leave --precision out"
        );
        Ok(())
    }

    /// Draws the values at the pixels' centres; falls back to the CPU where that is allowed.
    pub(crate) fn draw(&self, job: Job<'_>) -> anyhow::Result<Drawn> {
        self.average(job, Samples::CENTER)
    }

    /// Draws the means of so many samples a pixel, and warns where these are wrong.
    pub(crate) fn average(&self, job: Job<'_>, samples: Samples) -> anyhow::Result<Drawn> {
        let drawn = self.drawn(job, samples)?;
        if let (Values::Single(_), Some(text)) =
            (&drawn.values, single_precision_warning(job.field.step))
        {
            TOLD.call_once(|| tell(&format!("warning: {text}")));
        }
        Ok(drawn)
    }

    fn drawn(&self, job: Job<'_>, samples: Samples) -> anyhow::Result<Drawn> {
        let on = |device, method| graphics::draw(job, samples, device, method);
        match self.backend {
            Backend::Cpu => self.on_cpu(job, samples),
            Backend::Gpu => Ok(on(Device::Any, Method::Gather)?),
            Backend::Splat => Ok(on(Device::Any, Method::Splat)?),
            Backend::Auto if self.needs_cpu(job) => self.on_cpu(job, samples),
            Backend::Auto => match on(Device::Hardware, Method::Gather) {
                Ok(drawn) => Ok(drawn),
                Err(error) => {
                    error.note().iter().for_each(|note| tell(note));
                    self.on_cpu(job, samples)
                }
            },
        }
    }

    /// True for what no graphics device can do, or not well.
    fn needs_cpu(&self, job: Job<'_>) -> bool {
        self.precision == Some(Precision::F64)
            || job.quantity.source() == Source::Exact
            || self.precision.is_none() && single_precision_warning(job.field.step).is_some()
    }

    /// Does what only the processor can, in double precision.
    pub(crate) fn on_processor<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> anyhow::Result<T> {
        let is_cpu = matches!(self.backend, Backend::Auto | Backend::Cpu);
        anyhow::ensure!(
            is_cpu && self.precision != Some(Precision::F32),
            "the deformed plate is drawn by the processor, in double precision; leave --backend and --precision out"
        );
        self.with_threads(work)
    }

    /// Works on as many threads as are asked for, whatever draws.
    pub(crate) fn with_threads<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> anyhow::Result<T> {
        threads::with(self.threads, work)
    }

    fn on_cpu(&self, job: Job<'_>, samples: Samples) -> anyhow::Result<Drawn> {
        let draw = || match self.precision {
            Some(Precision::F32) => on_cpu::<f32>(job, samples, "cpu f32"),
            _ => on_cpu::<f64>(job, samples, "cpu f64"),
        };
        threads::with(self.threads, draw)?
    }
}

fn on_cpu<T: Sample>(job: Job<'_>, samples: Samples, by: &str) -> anyhow::Result<Drawn>
where
    Values: From<Raster<T>>,
{
    if samples != Samples::CENTER {
        let means = means::<T>(job.field, job.view, job.quantity, samples, &Bar::new())?;
        return Ok(Drawn::averaged(means, job, by));
    }
    let raster = render::<T>(job.field, job.view, job.quantity, &Bar::new())?;
    Ok(Drawn::new(raster, job.field, job.view, by))
}
