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
