//! An adapter as the program shows it.

use serde::Serialize;

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
