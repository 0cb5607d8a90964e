//! What draws: the processor, or a graphics device.
//!
//! The choice is made here and nowhere else. Whatever draws gives a raster of values; ranges, colours, overlays
//! and figures are made of it by the same code.

use std::num::NonZeroUsize;

use clap::ValueEnum;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::{Quantity, Source};
use ppum_gpu::{Choice, GpuError, Method, RenderError, Renderer};
use ppum_render::picture::{Picture, Style};
use ppum_render::raster::{Raster, Sample};
use ppum_render::scatter::render;
use ppum_render::view::View;

use crate::output::tell;
use crate::{drivers, threads, undefined};

/// What draws, as it was asked for.
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

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Backend {
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

/// What is drawn.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) field: &'a Field<'a>,
    pub(crate) view: &'a View,
    pub(crate) quantity: &'a Quantity,
    pub(crate) style: &'a Style,
}

/// A picture, and what drew it: `cpu f64`, `gpu f32, NAME`.
pub(crate) struct Drawn {
    pub(crate) picture: Picture,
    pub(crate) by: String,
    /// How many pixels of the plate have no value, and how many there are.
    pub(crate) undefined: [usize; 2],
    /// True if some value is finite.
    pub(crate) is_finite: bool,
}

impl Drawn {
    fn new<T: Sample>(raster: &Raster<T>, job: Job<'_>, by: &str) -> anyhow::Result<Self> {
        let picture = Picture::bare(raster, job.view, job.style)?;
        let undefined = undefined::pixels(raster, job.field, job.view);
        let is_finite = raster.statistics().finite > 0;
        Ok(Self { picture, by: by.to_owned(), undefined, is_finite })
    }
}

impl Engine {
    /// What clap cannot see.
    pub(crate) fn check(&self) -> anyhow::Result<()> {
        let on_gpu = matches!(self.backend, Backend::Gpu | Backend::Splat);
        anyhow::ensure!(
            !on_gpu || self.precision != Some(Precision::F64),
            "graphics devices compute in single precision; use --backend cpu, or leave --precision out"
        );
        Ok(())
    }

    /// Draws; falls back to the CPU where that is allowed.
    pub(crate) fn draw(&self, job: Job<'_>) -> anyhow::Result<Drawn> {
        match self.backend {
            Backend::Cpu => self.on_cpu(job),
            Backend::Gpu => told(on_gpu(job, Choice::Any, Method::Gather))?,
            Backend::Splat => told(on_gpu(job, Choice::Any, Method::Splat))?,
            Backend::Auto if self.needs_cpu(job) => self.on_cpu(job),
            Backend::Auto => match on_gpu(job, Choice::Real, Method::Gather) {
                Ok(drawn) => drawn,
                Err(error) => {
                    note(&error).iter().for_each(|note| tell(note));
                    self.on_cpu(job)
                }
            },
        }
    }

    /// True for what no graphics device can do.
    fn needs_cpu(&self, job: Job<'_>) -> bool {
        self.precision == Some(Precision::F64) || job.quantity.source() == Source::Exact
    }

    fn on_cpu(&self, job: Job<'_>) -> anyhow::Result<Drawn> {
        let narrow = self.precision == Some(Precision::F32);
        let draw =
            || if narrow { on_cpu::<f32>(job, "cpu f32") } else { on_cpu::<f64>(job, "cpu f64") };
        threads::with(self.threads, draw)?
    }
}

fn on_cpu<T: Sample>(job: Job<'_>, by: &str) -> anyhow::Result<Drawn> {
    Drawn::new(&render::<T>(job.field, job.view, job.quantity, unwatched())?, job, by)
}

/// The outer error is the device's, after which the CPU may try; the inner one is anything else.
fn on_gpu(
    job: Job<'_>,
    choice: Choice,
    method: Method,
) -> Result<anyhow::Result<Drawn>, RenderError> {
    let mut renderer = drivers::opening(|| Renderer::open(choice))?;
    let raster = renderer.render(job.field, job.view, job.quantity, method, unwatched())?;
    let name = &renderer.gpu().info().name;
    let by = match method {
        Method::Gather => format!("gpu f32, {name}"),
        Method::Splat => format!("gpu splat f32, {name}"),
    };
    Ok(Drawn::new(&raster, job, &by))
}

/// The result with the device's error in words.
fn told<T>(result: Result<T, RenderError>) -> anyhow::Result<T> {
    result.map_err(|error| anyhow::anyhow!(message(&error)))
}

/// An error with the remedy that the options of this program offer.
pub(crate) fn message(error: &RenderError) -> String {
    let RenderError::Gpu(error) = error else { return error.to_string() };
    let remedy = match error {
        GpuError::NoAdapter { .. } => "; `--backend cpu` needs none",
        GpuError::Device { .. } => "; `--backend cpu` does without it",
        GpuError::Memory { .. } => "; draw fewer pixels or use `--backend cpu`",
        GpuError::FormulaTooLarge { .. } => "; `--backend cpu` has no such limit",
        GpuError::TooLarge { .. }
        | GpuError::PictureTooLarge { .. }
        | GpuError::TooMany { .. }
        | GpuError::NeedsDouble { .. } => "; use `--backend cpu`",
        _ => "",
    };
    format!("{error}{remedy}")
}

/// What is told when the CPU draws in place of a graphics card: nothing if there is none, as is normal,
/// or if the CPU will say the same.
fn note(error: &RenderError) -> Option<String> {
    match error {
        RenderError::Gpu(GpuError::NoAdapter { .. }) | RenderError::Quantity(_) => None,
        error => {
            let text = message(error);
            let lines: Vec<_> = text.lines().map(str::trim).collect();
            Some(format!(
                "note: drawn on the CPU, since the graphics card fails: {}",
                lines.join(" ")
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_are_told_in_one_line() {
        let error = GpuError::Shader { message: "expected `;`\n  at 3:4\n".to_owned() };
        let note = note(&error.into()).expect("a failure");
        assert!(note.starts_with("note: ") && note.ends_with("expected `;` at 3:4"), "{note}");
        assert_eq!(note.lines().count(), 1);
        assert!(super::note(&GpuError::Lost.into()).is_some());
    }

    #[test]
    fn errors_of_devices_name_the_option_that_helps() {
        let missing = message(&GpuError::NoAdapter { choice: Choice::Any }.into());
        assert!(
            missing.ends_with("mesa-vulkan-drivers`); `--backend cpu` needs none"),
            "{missing}"
        );
        let large = GpuError::PictureTooLarge { pixels: [20_000, 10], most: 16_384 };
        let large = message(&large.into());
        assert!(large.ends_with("at most 16384x16384; use `--backend cpu`"), "{large}");
        assert_eq!(message(&GpuError::Lost.into()), GpuError::Lost.to_string());
    }

    #[test]
    fn a_machine_without_a_graphics_card_is_no_failure() {
        let missing = GpuError::NoAdapter { choice: Choice::Real };
        assert_eq!(note(&missing.into()), None);
    }
}
