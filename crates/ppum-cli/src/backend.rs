//! Options that choose between the processor and a graphics device.

use std::num::NonZeroUsize;

use ppum_scene::engine::{Backend, Engine, EngineError, Precision};

use crate::progress::Bar;
use crate::{graphics, threads};

/// The options that choose who draws.
#[derive(Debug, clap::Args)]
pub(crate) struct Computing {
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

impl Computing {
    /// What computes the values as it is asked for.
    pub(crate) fn engine<'a>(&self, bar: &'a Bar) -> Result<Engine<'a>, EngineError> {
        Engine::new(self.backend, self.precision, Some(graphics::draw), bar)
    }

    /// Works on as many threads as are asked for, whatever draws.
    pub(crate) fn with_threads<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> anyhow::Result<T> {
        threads::with(self.threads, work)
    }
}
