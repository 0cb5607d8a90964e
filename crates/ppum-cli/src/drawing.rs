//! The subject of a picture, and its values once they are drawn; colours come afterwards.

use ppum::crack::Crack;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::cells;
use ppum_render::deform::DeformedPoints;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::RangeError;
use ppum_render::raster::{Raster, Statistics};
use ppum_render::view::View;

/// What a picture shows.
#[derive(Clone, Debug)]
pub(crate) enum Shown {
    /// A quantity, at every point.
    Quantity(Quantity),
    /// One value per patch, on its cell, with its name.
    Cells(String, Vec<f64>),
}

impl Shown {
    /// The quantity, if it is one.
    pub(crate) fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Quantity(quantity) => Some(quantity),
            Self::Cells(..) => None,
        }
    }

    /// True if its values are whole numbers by their nature.
    fn is_whole(&self) -> bool {
        match self {
            Self::Quantity(quantity) => *quantity == Quantity::Overlap,
            Self::Cells(_, values) => values.iter().all(|v| v.is_nan() || v.fract() == 0.0),
        }
    }
}

/// Most values that have a colour each: no more can be told apart.
const MOST_CLASSES: usize = 20;

/// The values that have a colour each in pictures of one range, rising: none unless they are few whole numbers in all of them.
pub(crate) fn classes<'a>(
    pictures: impl IntoIterator<Item = (&'a Shown, &'a Drawn)>,
) -> Option<Vec<f64>> {
    let values = |(shown, drawn): (&Shown, &Drawn)| {
        shown.is_whole().then(|| drawn.values.whole_numbers(MOST_CLASSES))?
    };
    let found: Option<Vec<Vec<f64>>> = pictures.into_iter().map(values).collect();
    let mut all = found?.concat();
    all.sort_by(f64::total_cmp);
    all.dedup();
    (all.len() <= MOST_CLASSES).then_some(all)
}

/// What is seen of a plate: as it was, or deformed.
pub(crate) enum Seen<'f> {
    Plate(View),
    Moved(DeformedPoints<'f>),
}

impl<'f> Seen<'f> {
    /// The deformed plate, if it is that.
    pub(crate) fn moved(&self) -> Option<&DeformedPoints<'f>> {
        match self {
            Self::Plate(_) => None,
            Self::Moved(points) => Some(points),
        }
    }

    /// The cracks where they are seen.
    pub(crate) fn cracks(&self, field: &Field<'_>) -> Vec<Crack> {
        self.moved().map_or_else(|| field.step.cracks.clone(), |points| points.view.moved_cracks())
    }
}

/// The subject of a picture of a quantity.
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

impl Values {
    /// The different values, rising, if they are at most `most` whole numbers.
    fn whole_numbers(&self, most: usize) -> Option<Vec<f64>> {
        match self {
            Self::Double(raster) => raster.whole_numbers(most),
            Self::Single(raster) => raster.whole_numbers(most),
        }
    }
}

impl Drawn {
    /// The values of an undeformed plate.
    pub(crate) fn new(values: impl Into<Values>, field: &Field<'_>, view: &View, by: &str) -> Self {
        let values = values.into();
        let without = match &values {
            Values::Double(raster) => raster.undefined(field.domain, view),
            Values::Single(raster) => raster.undefined(field.domain, view),
        };
        Self { view: *view, values, by: by.to_owned(), without, overlap: Vec::new() }
    }

    /// One value per patch.
    pub(crate) fn of_cells(values: &[f64], field: &Field<'_>, view: &View) -> Self {
        Self::new(cells::raster(field, values, view), field, view, PROCESSOR)
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

/// What draws all that is not drawn by a backend.
pub(crate) const PROCESSOR: &str = "cpu f64";

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
