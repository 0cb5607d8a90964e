//! Views and rasters, and the renderer against the point-by-point reference.

mod errors;
mod mesh;
mod raster;
mod scatter;
mod summation;
mod view;
