//! Draws fields exactly at every pixel on graphics cards.
//!
//! The contract is that of `ppum-render`: a [`View`](ppum_render::view::View) of a
//! [`Field`](ppum::field::Field) and a [`Quantity`](ppum::quantity::Quantity) make a raster. A
//! [`Renderer`] puts a field on the card ([`Scene`]), compiles a quantity with all functions of the
//! dataset ([`Program`]), and draws one with the other, by either [`Method`]:
//!
//! - *gather*: each pixel finds the patches that cover it, sums and divides once;
//! - *splat*: the three passes of Üffinger et al. 2011, patches drawn as quads and blended.
//!
//! Shaders compute in single precision. Everything that would cancel there is formed in double
//! precision on the processor: positions of tips, cracks and rims relative to the view, positions of
//! patches relative to a region around it, in two halves. So views may be 10⁻¹² of the domain wide.
//! Values agree with the CPU renderer to 2·10⁻⁵ of the field's local scale and mostly to 10⁻⁶.

mod adapter;
mod areas;
mod bins;
mod bodies;
mod color;
mod compose;
mod device;
mod error;
mod functions;
mod geometry;
mod groups;
mod lattice;
mod layout;
mod pipeline;
mod program;
mod quads;
mod quantity;
#[cfg(not(target_arch = "wasm32"))]
mod read;
mod region;
mod renderer;
mod scene;
mod seen;
mod shader;
mod smooth;
mod targets;
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
