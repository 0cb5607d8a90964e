//! The subject of a picture, and the picture once it is drawn.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::picture::{Picture, Style};
use ppum_render::raster::{Raster, Sample};
use ppum_render::view::View;

/// The subject of a picture.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) field: &'a Field<'a>,
    pub(crate) view: &'a View,
    pub(crate) quantity: &'a Quantity,
    pub(crate) style: &'a Style,
}

/// A picture, and what drew it: `cpu f64`, `gpu f32, NAME`.
pub(crate) struct Drawn {
    pub(crate) picture: Picture,
    pub(crate) by: String,
    /// The number of pixels of the plate without a value, and of all of them.
    pub(crate) undefined: [usize; 2],
    /// True if some value is finite.
    pub(crate) is_finite: bool,
}

impl Drawn {
    pub(crate) fn new<T: Sample>(
        raster: &Raster<T>,
        job: Job<'_>,
        by: &str,
    ) -> anyhow::Result<Self> {
        let mut picture = Picture::bare(raster, job.view, job.style)?;
        let without = raster.undefined(job.field.domain, job.view);
        picture.hatch(&without);
        let with = raster.values.len() - raster.statistics().undefined;
        let undefined = [without.len(), without.len() + with];
        let is_finite = picture.has_values;
        Ok(Self { picture, by: by.to_owned(), undefined, is_finite })
    }
}
