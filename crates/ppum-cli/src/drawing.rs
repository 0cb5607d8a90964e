//! The subject of a picture, and its values once they are drawn; colours come afterwards.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::RangeError;
use ppum_render::raster::{Raster, Statistics};
use ppum_render::view::View;

/// The subject of a picture.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) field: &'a Field<'a>,
    pub(crate) view: &'a View,
    pub(crate) quantity: &'a Quantity,
}

/// Values at the centres of a view's pixels, and what drew them: `cpu f64`, `gpu f32, NAME`.
pub(crate) struct Drawn {
    pub(crate) view: View,
    pub(crate) values: Values,
    pub(crate) by: String,
    /// The pixels of the plate without a value, by their place row by row.
    pub(crate) without: Vec<u32>,
    /// The pixels where the deformed plate lies over itself.
    pub(crate) overlap: Vec<u32>,
}

/// Values in the precision that they were computed in.
pub(crate) enum Values {
    Double(Raster<f64>),
    Single(Raster<f32>),
}

impl From<Raster<f64>> for Values {
    fn from(raster: Raster<f64>) -> Self {
        Self::Double(raster)
    }
}

impl From<Raster<f32>> for Values {
    fn from(raster: Raster<f32>) -> Self {
        Self::Single(raster)
    }
}

impl Drawn {
    /// The values of an undeformed plate.
    pub(crate) fn new(values: impl Into<Values>, job: Job<'_>, by: &str) -> Self {
        let (values, domain) = (values.into(), job.field.domain);
        let without = match &values {
            Values::Double(raster) => raster.undefined(domain, job.view),
            Values::Single(raster) => raster.undefined(domain, job.view),
        };
        Self { view: *job.view, values, by: by.to_owned(), without, overlap: Vec::new() }
    }

    /// Gives the values colours.
    pub(crate) fn picture(&self, style: &Style) -> Result<Picture, RangeError> {
        let mut picture = match &self.values {
            Values::Double(raster) => Picture::bare(raster, &self.view, style),
            Values::Single(raster) => Picture::bare(raster, &self.view, style),
        }?;
        picture.hatch(&self.without);
        hatch(&mut picture.image, &self.overlap);
        Ok(picture)
    }

    /// The number of pixels of the plate without a value, and of all of them.
    pub(crate) fn undefined(&self) -> [usize; 2] {
        let Statistics { finite, infinite, .. } = match &self.values {
            Values::Double(raster) => raster.statistics(),
            Values::Single(raster) => raster.statistics(),
        };
        [self.without.len(), self.without.len() + finite + infinite]
    }
}

/// Dark lines across the pixels where the plate lies over itself.
fn hatch(image: &mut Image, overlap: &[u32]) {
    let columns = image.size[0];
    let pixels = image.rgba.as_chunks_mut().0;
    for &index in overlap {
        if (index % columns + index / columns).is_multiple_of(HATCH_STEP) {
            pixels[index as usize] = HATCH;
        }
    }
}

const HATCH: Rgba = [16, 16, 20, 255];
const HATCH_STEP: u32 = 5;
