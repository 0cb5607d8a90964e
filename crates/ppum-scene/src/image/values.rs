//! Values at the pixels of an image, before they become colours.

use ppum::dataset::Step;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::text::trimmed_to;
use ppum_render::cells;
use ppum_render::extrema::Extrema;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::{ColorRange, RangeError};
use ppum_render::raster::{Raster, RasterValue, Statistics};
use ppum_render::resample::norms::DifferenceNorms;
use ppum_render::samples::{Means, Samples};
use ppum_render::view::View;
use rayon::prelude::*;

/// The field, view and quantity of an image.
#[derive(Clone, Copy, Debug)]
pub struct DrawingInput<'a> {
    /// The field.
    pub field: &'a Field<'a>,
    /// The view.
    pub view: &'a View,
    /// The quantity.
    pub quantity: &'a Quantity,
}

/// Relative error of stresses above which fewer than three digits remain, which images show.
const FEW_DIGITS: f64 = 1e-3;

/// The relative error of stresses in single precision, of a step that keeps fewer than three digits
/// in it. The solver's record `rounding` tells that of double precision; a step without one counts
/// as good.
#[must_use]
pub fn single_precision_error(step: &Step) -> Option<f64> {
    let rounding = step.record("rounding")?;
    let error = rounding * f64::from(f32::EPSILON) / f64::EPSILON;
    (error > FEW_DIGITS).then_some(error)
}

/// The warning about images of a step in single precision, if its coefficients do not bear it.
#[must_use]
pub fn single_precision_warning(step: &Step) -> Option<String> {
    let error = single_precision_error(step)?;
    Some(format!(
        "coefficients cancel: in single precision stresses are wrong by up to {} of their size in places; double \
         precision shows them",
        trimmed_to(error, 1)
    ))
}

/// Values at the centres of a view's pixels, and what drew them: `cpu f64`, `gpu f32, NAME`.
#[derive(Clone, Debug)]
pub struct PixelValues {
    /// The view.
    pub view: View,
    /// The values.
    pub values: RasterValues,
    /// The device that drew them.
    pub by: String,
    /// The pixels of the body without a value, by their place row by row.
    pub without: Vec<u32>,
    /// The pixels where the deformed body lies over itself.
    pub overlap: Vec<u32>,
    /// The number of samples a pixel that the values are means of, and how much of each pixel the
    /// body covers.
    pub opacity: Option<(Samples, Vec<u8>)>,
    /// The size of a difference, also in parts of the side that was taken away.
    pub norms: Option<DifferenceNorms>,
}

/// Values in the precision that they were computed in.
#[derive(Clone, Debug)]
pub enum RasterValues {
    /// In double precision.
    Double(Raster<f64>),
    /// In single precision.
    Single(Raster<f32>),
}

impl From<Raster<f64>> for RasterValues {
    fn from(raster: Raster<f64>) -> Self {
        Self::Double(raster)
    }
}

impl From<Raster<f32>> for RasterValues {
    fn from(raster: Raster<f32>) -> Self {
        Self::Single(raster)
    }
}

/// Does the same with values of either precision.
macro_rules! with_raster {
    ($values:expr, $raster:ident => $result:expr) => {
        match $values {
            $crate::image::values::RasterValues::Double($raster) => $result,
            $crate::image::values::RasterValues::Single($raster) => $result,
        }
    };
}

pub(crate) use with_raster;

impl RasterValues {
    /// The different values, rising, if they are at most `most` whole numbers.
    pub(super) fn whole_numbers(&self, most: usize) -> Option<Vec<f64>> {
        with_raster!(self, raster => raster.whole_numbers(most))
    }

    /// Counts and ends of the finite values.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        with_raster!(self, raster => raster.statistics())
    }

    /// The value that all pixels have, if there is no other.
    pub fn one_value(&self) -> Option<f64> {
        with_raster!(self, raster => raster.one_value())
    }

    /// The smallest and the largest value, which may be infinite.
    pub fn ends(&self) -> [f64; 2] {
        fn of<T: RasterValue>(raster: &Raster<T>) -> [f64; 2] {
            let start = [f64::INFINITY, f64::NEG_INFINITY];
            let values = raster.values.iter().map(|&value| value.into());
            values.fold(start, |[min, max], value: f64| [min.min(value), max.max(value)])
        }
        with_raster!(self, raster => of(raster))
    }

    /// Memory that they take \[bytes\].
    pub fn bytes(&self) -> usize {
        with_raster!(self, raster => size_of_val(raster.values.as_slice()))
    }
}

impl PixelValues {
    /// The values of an undeformed body.
    pub fn new(values: impl Into<RasterValues>, field: &Field<'_>, view: &View, by: &str) -> Self {
        let values = values.into();
        let without = with_raster!(&values, raster => undefined(raster, field, view));
        let (by, overlap) = (by.to_owned(), Vec::new());
        Self { view: *view, values, by, without, overlap, opacity: None, norms: None }
    }

    /// One value per patch.
    pub fn of_cells(values: &[f64], field: &Field<'_>, view: &View) -> Self {
        Self::new(cells::raster(field, values, view), field, view, PROCESSOR)
    }

    /// The means of samples of an undeformed body.
    pub fn averaged<T: RasterValue>(means: Means<T>, job: DrawingInput<'_>, by: &str) -> Self
    where
        RasterValues: From<Raster<T>>,
    {
        let (without, opacity) = (means.undefined(), Some((means.samples, means.opacity())));
        let (values, by) = (means.raster.into(), by.to_owned());
        Self { view: *job.view, values, by, without, overlap: Vec::new(), opacity, norms: None }
    }

    /// The range of the values, with the extrema of the view if these are known.
    pub fn span(&self, style: &Style, values: Option<Extrema>) -> ColorRange {
        let Style { range, scale, colormap, .. } = style;
        with_raster!(&self.values, raster => range.span(*scale, colormap.diverging, raster, values))
    }

    /// Gives the values colours of a range.
    pub fn picture(&self, style: &Style, span: ColorRange) -> Result<ColoredRaster, RangeError> {
        let mut picture = with_raster!(&self.values, raster => {
            ColoredRaster::spanning(raster, &self.view, style, span)
        })?;
        picture.mark_undefined(&self.without, style.nan_color);
        hatch(&mut picture.image, &self.overlap);
        if let Some((samples, opacity)) = &self.opacity {
            picture.fade(*samples, opacity);
        }
        Ok(picture)
    }

    /// The number of pixels of the body without a value, and of all of them.
    pub fn undefined(&self) -> [usize; 2] {
        let Statistics { finite, infinite, .. } = self.values.statistics();
        [self.without.len(), self.without.len() + finite + infinite]
    }
}

/// The pixels of the body without a value: on a mesh those of its elements.
pub(crate) fn undefined<T: RasterValue>(
    raster: &Raster<T>,
    field: &Field<'_>,
    view: &View,
) -> Vec<u32> {
    let without = raster.undefined(field.domain, view);
    if field.step.partition.mesh().is_none() {
        return without;
    }
    let (local, columns) = (field.at(view.center), view.pixels[0]);
    let is_inside = |pixel: &u32| local.contains(view.offset(pixel % columns, pixel / columns));
    without.into_par_iter().filter(is_inside).collect()
}

/// The name of the device of values that no backend computes.
pub const PROCESSOR: &str = "cpu f64";

/// Dark lines across the pixels where the body lies over itself.
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
