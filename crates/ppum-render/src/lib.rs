//! Draws fields exactly at every pixel.
//!
//! A [`View`](view::View) says which part of the plane is shown on how many pixels,
//! [`render`](scatter::render) evaluates a quantity at the centre of each pixel into a
//! [`Raster`](raster::Raster), [`Picture`](picture::Picture) gives its values colours, and
//! [`figure()`](figure::figure) adds axes, a colour bar and the cracks. [`png`] encodes the result
//! together with what it shows. Nothing is resampled, interpolated or triangulated on the way.
//!
//! [`reference`](mod@reference) evaluates a picture point by point; the renderer is held to it.
//! Pictures do not depend on the number of threads.

pub mod colormap;
mod error;
pub mod figure;
pub mod image;
pub mod overlay;
mod parts;
pub mod picture;
pub mod pixels;
pub mod png;
pub mod range;
pub mod raster;
pub mod reference;
pub mod scale;
pub mod scatter;
mod text;
pub mod ticks;
pub mod view;

pub use error::RenderError;
