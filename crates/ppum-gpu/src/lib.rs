//! Draws fields exactly at every pixel on graphics cards.
#![allow(dead_code, reason = "the renderer that joins the parts is not there yet")]

mod adapter;
mod device;
mod error;
mod functions;
mod geometry;
mod groups;
mod quantity;
mod shader;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod texts_tests;
mod weight;

#[cfg(not(target_arch = "wasm32"))]
pub use adapter::adapters;
pub use adapter::{AdapterInfo, AdapterKind, Choice};
pub use device::Gpu;
pub use error::GpuError;
