//! An adapter as the program shows it.

use serde::Serialize;

/// A graphics adapter, in the shape of the JSON of `ppum info --gpu`.
#[derive(Debug, Serialize)]
pub struct Adapter {
    /// Its name.
    pub name: String,
    /// Hardware or software, in words.
    pub kind: &'static str,
    /// The interface that it is reached by, such as Vulkan.
    pub interface: String,
    /// Its driver.
    pub driver: String,
    /// Largest buffer that a shader sees \[MiB\].
    pub largest_binding_mib: u64,
    /// Largest buffer \[MiB\].
    pub largest_buffer_mib: u64,
    /// Largest width and height of a texture.
    pub largest_texture: u32,
    /// True if it can splat.
    pub splat: bool,
    /// The values of `--backend` that take it.
    pub taken_by: Vec<&'static str>,
}
