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

mod choice;
mod device;
mod error;
mod frame;
mod layout;
mod program;
mod renderer;
mod scene;
mod shader;
#[doc(hidden)]
pub mod testing;
#[cfg(test)]
mod tests;

pub use choice::{AdapterKind, Choice};
pub use device::Gpu;
pub use device::adapter::AdapterInfo;
#[cfg(not(target_arch = "wasm32"))]
pub use device::adapter::adapters;
pub use error::{GpuError, RenderError};
pub use frame::shading::Shading;
pub use program::Program;
pub use program::output::{Colors, Derivatives, Output, Values};
pub use renderer::Renderer;
pub use renderer::drawn::Drawn;
pub use scene::Scene;
pub use shader::passes::Method;
