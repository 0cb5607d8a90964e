//! Draws fields exactly at every pixel on graphics devices.
//!
//! The contract is that of `ppum-render`: a [`View`](ppum_render::view::View) of a
//! [`Field`](ppum::field::Field) and a [`Quantity`](ppum::quantity::Quantity) make a raster. A
//! [`Renderer`] puts a field on the card ([`Scene`]), compiles an output of it ([`Program`]), and
//! draws that, by either [`Method`]:
//!
//! - *gather*: each pixel finds the patches that cover it, sums and divides once;
//! - *splat*: the three passes of Üffinger et al. 2011, patches drawn as quads and blended.
//!
//! A program knows its scene, and its type says what it yields: [`Values`] or [`Colors`].
//!
//! ```
//! use ppum::prelude::*;
//! use ppum_gpu::{AdapterChoice, Colors, GpuError, Method, Renderer, TransferFunction, Values};
//! use ppum_render::picture::Style;
//! use ppum_render::range::RangeChoice;
//! use ppum_render::view::View;
//!
//! // one patch, u = 1 + 2ξ with ξ = x / 1.25
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 0)?.partition(1.25, WeightFunction::Linear)?;
//! let mut potential = FieldData::new("potential", &["u"]);
//! potential.push_patch(&[(0, 1)]);
//! potential.coefficients_mut(0).for_each(|c| c.copy_from_slice(&[1.0, 2.0, 0.0]));
//! let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
//! let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
//! let field = Field::new(&dataset, 0)?;
//!
//! let mut renderer = match Renderer::open(AdapterChoice::Any) {
//!     Err(GpuError::NoAdapter { .. }) => return Ok(()),
//!     opened => opened?,
//! };
//! let scene = renderer.upload(&field)?;
//! let u = Quantity::parse("u", &field)?;
//! let mut values = renderer.compile(&scene, Values(u.clone()), Method::Gather)?;
//! let view = View::window(-1.0, -1.0, 1.0, 1.0, [4, 4])?;
//! let raster = renderer.draw(&mut values, &view)?.read()?;
//! assert!((raster.value(3, 0) - 2.2).abs() < 1e-5); // x = 0.75
//!
//! // a program draws any view, here with colours of one range
//! let Style { colormap, scale, undefined, .. } = Style::default();
//! let span = RangeChoice::Auto.span(scale, colormap.diverging, &raster, None);
//! let normalization = span.normalization(scale)?;
//! let shading = TransferFunction { normalization, colormap, undefined };
//! let colors = Colors { quantity: u, shading: shading.clone() };
//! let mut movie = renderer.compile(&scene, colors, Method::Gather)?;
//! for half in [1.0, 0.1, 0.01] {
//!     let view = View::window(-half, -half, half, half, [4, 4])?;
//!     assert_eq!(renderer.draw(&mut movie, &view)?.read()?.size, view.pixels);
//! }
//!
//! // and with other colours, without being compiled again
//! let before = renderer.draw(&mut movie, &view)?.read()?;
//! let colormap = Style::named("magma")?.colormap;
//! movie.shade(TransferFunction { colormap, ..shading });
//! assert_ne!(renderer.draw(&mut movie, &view)?.read()?, before);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Shaders compute in single precision. Everything that would cancel there is formed in double
//! precision on the processor: positions of tips, cracks and rims relative to the view, positions
//! of patches relative to a region around it, in two halves. So views may be 10⁻¹² of the domain
//! wide. Values agree with the CPU renderer to 2·10⁻⁵ of the field's local scale and mostly
//! to 10⁻⁶.
//!
//! Nothing panics on what a driver does: errors are results, so that who draws can fall back to
//! the CPU.

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

pub use choice::{AdapterChoice, AdapterKind};
pub use device::Gpu;
pub use device::adapter::AdapterInfo;
pub use device::adapter::adapters;
pub use error::{GpuError, RenderError};
pub use frame::shading::TransferFunction;
pub use program::Program;
pub use program::output::{Colors, Output, Values};
pub use renderer::Renderer;
pub use renderer::pending::QueuedOutput;
pub use scene::Scene;
pub use shader::passes::Method;
