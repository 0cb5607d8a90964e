//! Draws fields exactly at every pixel on graphics cards.
#![allow(dead_code, reason = "the renderer that joins the parts is not there yet")]

mod adapter;
mod areas;
mod bins;
mod bodies;
mod color;
mod device;
mod error;
mod functions;
mod geometry;
mod groups;
mod lattice;
mod layout;
mod program;
mod quads;
mod quantity;
mod read;
mod region;
mod renderer;
mod scene;
mod seen;
mod shader;
mod smooth;
#[doc(hidden)]
pub mod testing;
#[cfg(test)]
mod tests;
mod weight;

#[cfg(not(target_arch = "wasm32"))]
pub use adapter::adapters;
pub use adapter::{AdapterInfo, AdapterKind, Choice};
pub use color::Shading;
pub use device::Gpu;
pub use error::GpuError;
pub use program::{Method, Output, Program};
pub use renderer::{Drawn, RenderError, Renderer};
pub use scene::Scene;
