//! Graphics devices: which there are, an open one, and reading back from it.

pub(crate) mod adapter;
mod gpu;
pub(crate) mod read;

pub use gpu::Gpu;
