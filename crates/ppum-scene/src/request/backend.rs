//! Backends, which compute the values of an image.

use serde::{Deserialize, Serialize};

/// The backend that computes the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// A graphics card if there is one and it can, else the CPU
    #[default]
    Auto,
    /// This machine's processor
    Cpu,
    /// Any graphics device, a software one too: one pass that gathers
    Gpu,
    /// Splatting in the three passes of Üffinger et al. 2011, to compare
    Splat,
}

impl Backend {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Cpu, Self::Gpu, Self::Splat];
}

/// The precision of the computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the names say all, and clap would show more")]
pub enum Precision {
    F64,
    F32,
}
