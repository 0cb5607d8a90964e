//! ppum-render
pub mod colormap;
pub mod figure;
pub mod image;
pub mod overlay;
pub mod picture;
pub mod png;
pub mod range;
pub mod raster;
pub mod reference;
pub mod scale;
pub mod scatter;
mod text;
pub mod ticks;
pub mod view;
