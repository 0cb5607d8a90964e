//! What can go wrong on a graphics card. Nothing here panics: a program falls back to the CPU.

use ppum::formula::WgslError;

/// Why a graphics card could not do what it was asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is no adapter, or none of the wanted kind.
    #[error(
        "no graphics adapter{wanted}: install a Vulkan driver for the graphics card, or the software \
         one (on Debian `libvulkan1 mesa-vulkan-drivers`); `--backend cpu` needs none"
    )]
    NoAdapter {
        /// What was asked for beside an adapter, beginning with a space; empty if nothing.
        wanted: &'static str,
    },
    /// The driver refused to do something.
    #[error("{what}: the graphics driver says: {message}; `--backend cpu` does without it")]
    Device {
        /// What was tried.
        what: String,
        /// The driver's words.
        message: String,
    },
    /// The card's memory is full.
    #[error("{what}: out of graphics memory; draw fewer pixels or use `--backend cpu`")]
    Memory {
        /// What was tried.
        what: String,
    },
    /// A shader is not accepted.
    #[error("shader: {message}")]
    Shader {
        /// The compiler's words, with the place.
        message: String,
    },
    /// The device was lost: driver reset, card removed. What lived on it has to be made anew.
    #[error("the graphics device was lost; open it again")]
    Lost,
    /// Data that do not fit into what the device binds at once.
    #[error(
        "{what} need {needed} bytes, and the graphics device takes {most}; use `--backend cpu`"
    )]
    TooLarge {
        /// What is too large, in the plural.
        what: String,
        /// Bytes that are needed.
        needed: u64,
        /// Bytes that there can be.
        most: u64,
    },
    /// Something this device or this crate cannot do; the text says what and what to do instead.
    #[error("{0}")]
    Unsupported(String),
}

impl GpuError {
    /// That a formula is wrong.
    pub(crate) fn formula(what: &str, error: &dyn std::fmt::Display) -> Self {
        Self::Unsupported(format!("{what}: {error}"))
    }

    /// That formulas are right, but too large for a shader.
    pub(crate) fn limit(what: &str, error: &WgslError) -> Self {
        Self::Unsupported(format!("{what}: {error}; `--backend cpu` has no such limit"))
    }
}
