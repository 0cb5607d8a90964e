//! Graphics devices, all that the program knows of them; without the feature `gpu` there are none.

#[cfg(feature = "gpu")]
mod devices;
#[cfg(not(feature = "gpu"))]
mod none;

use serde::Serialize;

#[cfg(feature = "gpu")]
pub(crate) use devices::{MISSING, adapters, draw};
#[cfg(not(feature = "gpu"))]
pub(crate) use none::{MISSING, adapters, draw};

/// The devices that may draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Device {
    /// Graphics cards alone.
    Hardware,
    /// Those that compute in software too.
    Any,
}

/// The way a device draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    /// One pass that gathers.
    Gather,
    /// Three passes that splat.
    Splat,
}

/// A graphics adapter, in the shape of the JSON of `ppum info --gpu`.
#[derive(Debug, Serialize)]
pub(crate) struct Adapter {
    pub(crate) name: String,
    pub(crate) kind: &'static str,
    pub(crate) interface: String,
    pub(crate) driver: String,
    pub(crate) largest_binding_mib: u64,
    pub(crate) largest_buffer_mib: u64,
    pub(crate) largest_texture: u32,
    /// True if it can splat.
    pub(crate) splat: bool,
    /// The values of `--backend` that take it.
    pub(crate) taken_by: Vec<&'static str>,
}

/// A device that fails.
#[derive(Debug)]
pub(crate) struct Failure {
    message: String,
    /// True if there is no device, as is normal, or if the CPU will say the same.
    is_normal: bool,
}

impl Failure {
    /// The words when the CPU draws in place of the device; nothing if that is normal.
    pub(crate) fn note(&self) -> Option<String> {
        let lines: Vec<_> = self.message.lines().map(str::trim).collect();
        (!self.is_normal).then(|| {
            format!("note: drawn on the CPU, since the graphics card fails: {}", lines.join(" "))
        })
    }
}

impl From<Failure> for anyhow::Error {
    fn from(failure: Failure) -> Self {
        Self::msg(failure.message)
    }
}
