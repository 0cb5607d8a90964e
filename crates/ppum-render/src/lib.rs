//! ppum-render
pub mod colormap;
pub mod image;
pub mod picture;
pub mod png;
pub mod range;
pub mod raster;
pub mod scale;
pub mod view;
