//! ppum-render
pub mod raster;
pub mod view;
