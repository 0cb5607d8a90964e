//! ppum-render
pub mod colormap;
pub mod image;
pub mod raster;
pub mod view;
