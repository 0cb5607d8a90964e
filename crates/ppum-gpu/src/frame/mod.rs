//! Data of one frame: numbers that change with the view, formed in double precision.

pub(crate) mod areas;
pub(crate) mod geometry;
pub(crate) mod quads;
pub(crate) mod shading;
pub(crate) mod view_data;
