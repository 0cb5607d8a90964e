//! Draws fields exactly at every pixel on graphics devices.
//!
//! The contract is that of `ppum-render`: a [`View`](ppum_render::view::View) of a
//! [`Field`](ppum::field::Field) and a [`Quantity`](ppum::quantity::Quantity) make a raster. A
//! [`Renderer`] puts a field on the card ([`Scene`]), compiles an output of it ([`Program`]), and draws
//! that, by either [`Method`]:
//!
//! - *gather*: each pixel finds the patches that cover it, sums and divides once;
//! - *splat*: the three passes of Üffinger et al. 2011, patches drawn as quads and blended.
//!
//! A program knows its scene, and its type says what it yields: [`Values`], [`Colors`] or
//! [`Derivatives`].
//!
//! ```no_run
//! use ppum::prelude::*;
//! use ppum_gpu::{Choice, Colors, Method, Renderer, Shading, Values};
//! use ppum_render::picture::Style;
//! use ppum_render::range::Range;
//! use ppum_render::view::View;
//!
//! fn frames(dataset: &Dataset, views: &[View]) -> Result<(), Box<dyn std::error::Error>> {
//!     let field = Field::new(dataset, 0)?;
//!     let mut renderer = Renderer::open(Choice::Any)?;
//!     let scene = renderer.upload(&field)?;
//!     let mut stress = renderer.compile(&scene, Values(Quantity::VonMises), Method::Gather)?;
//!     let raster = renderer.draw(&mut stress, &views[0])?.read()?;
//!     let Style { colormap, scale, undefined, .. } = Style::default();
//!     let normalization = Range::Auto.normalization(scale, colormap.diverging, &raster)?;
//!     let shading = Shading { normalization, colormap, undefined };
//!     let colors = Colors { quantity: Quantity::VonMises, shading };
//!     let mut movie = renderer.compile(&scene, colors, Method::Gather)?;
//!     for view in views {
//!         let image = renderer.draw(&mut movie, view)?.read()?;
//!         assert_eq!(image.size, view.pixels);
//!     }
//!     Ok(())
//! }
//! ```
//!
//! Shaders compute in single precision. Everything that would cancel there is formed in double
//! precision on the processor: positions of tips, cracks and rims relative to the view, positions of
//! patches relative to a region around it, in two halves. So views may be 10⁻¹² of the domain wide.
//! Values agree with the CPU renderer to 2·10⁻⁵ of the field's local scale and mostly to 10⁻⁶.
//!
//! Nothing panics on what a driver does: errors are results, so that who draws can fall back to the CPU.

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
