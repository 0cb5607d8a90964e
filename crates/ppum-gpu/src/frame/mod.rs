//! What a view changes: numbers formed in double precision, once a frame.

pub(crate) mod areas;
pub(crate) mod geometry;
pub(crate) mod quads;
pub(crate) mod shading;
pub(crate) mod view_data;
