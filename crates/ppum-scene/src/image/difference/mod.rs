//! The difference of two images of one view: both fields are evaluated at the centre of each
//! pixel, and one value is taken from the other.
//!
//! It is computed by the processor in double precision alone. Where two fields are nearly the same
//! their difference is what single precision has lost.

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum_render::RasterError;
use ppum_render::cells;
use ppum_render::extrema::Extrema;
use ppum_render::picture::Style;
use ppum_render::range::ColorRange;
use ppum_render::raster::Raster;
use ppum_render::resample::norms::{difference, norms};
use ppum_render::scale::Scale;
use ppum_render::scatter::render;
use ppum_render::view::View;

use crate::image::quantity::DisplayedQuantity;
use crate::image::values::{PROCESSOR, PixelValues, undefined, with_raster};
use crate::request::colors::{ColorOptions, MapError, map};

/// One of the two: a field and what is shown of it.
#[derive(Clone, Copy)]
pub struct DifferenceSide<'a> {
    /// The field.
    pub field: &'a Field<'a>,
    /// The displayed quantity.
    pub shown: &'a DisplayedQuantity,
}

/// Two sides, and what is said of them: `right` − `left`.
#[derive(Clone, Copy)]
pub struct FieldDifference<'a> {
    /// The minuend.
    pub right: DifferenceSide<'a>,
    /// The subtrahend.
    pub left: DifferenceSide<'a>,
}

/// The map of differences: blue, white, red.
pub const MAP: &str = "coolwarm";

impl DifferenceSide<'_> {
    fn raster(&self, view: &View, watcher: &dyn Watcher) -> Result<Raster, RasterError> {
        match self.shown {
            DisplayedQuantity::Quantity(quantity) => {
                render::<f64>(self.field, view, quantity, watcher)
            }
            DisplayedQuantity::Cells(_, values) => Ok(cells::raster(self.field, values, view)),
        }
    }

    fn words(&self) -> [String; 2] {
        self.shown.words(self.field)
    }
}

impl FieldDifference<'_> {
    /// The values at the pixels of a view.
    ///
    /// # Errors
    /// A quantity that a field does not have; a watcher that stops it.
    pub fn draw(&self, view: &View, watcher: &dyn Watcher) -> Result<PixelValues, RasterError> {
        let left = self.left.raster(view, watcher)?;
        let right = self.right.raster(view, watcher)?;
        let apart = difference(&left, &right);
        // a value is missing where both bodies are
        let here = undefined(&apart, self.left.field, view);
        let mut drawn = PixelValues::new(apart, self.right.field, view, PROCESSOR);
        drawn.without.retain(|pixel| here.binary_search(pixel).is_ok());
        drawn.norms = Some(norms(&left, &right));
        Ok(drawn)
    }

    /// The way in which its values become colours.
    ///
    /// # Errors
    /// An unknown map.
    pub fn style(&self, colors: &ColorOptions) -> Result<Style, MapError> {
        let map = map(colors.colormap.as_deref().unwrap_or(MAP))?;
        let quantity = self.right.shown.quantity().or(self.left.shown.quantity());
        Ok(colors.style(quantity, map))
    }

    /// The words for it and its unit, as figures have them; no unit if the sides have different
    /// ones.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        let ([own, unit], [other, its_unit]) = (self.right.words(), self.left.words());
        let unit = if unit == its_unit { unit } else { String::new() };
        [named(&own, &other), unit]
    }

    /// Returns warnings about a doubtful difference: bodies at different places, units that differ.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let ([_, unit], [_, its_unit]) = (self.right.words(), self.left.words());
        let [own, other] = [self.right, self.left].map(|side| side.field.domain.bounds);
        let name =
            |unit: &str| if unit.is_empty() { "no unit".to_owned() } else { unit.to_owned() };
        let mut all = Vec::new();
        if !own.overlaps(&other) {
            all.push("the plates have no point in common: there is no difference".to_owned());
        } else if own != other {
            all.push("the plates are not the same: the difference is drawn where both are".into());
        }
        if unit != its_unit {
            let (unit, its_unit) = (name(&unit), name(&its_unit));
            all.push(format!(
                "units differ, right {unit}, left {its_unit}: numbers are subtracted"
            ));
        }
        all
    }
}

/// The name of the difference of two quantities that are shown on the right and on the left.
#[must_use]
pub fn named(right: &str, left: &str) -> String {
    match right == left {
        true => format!("{right} (right − left)"),
        false => format!("{right} (right) − {left} (left)"),
    }
}

/// The range of differences, with their extrema at the pixels: robust against peaks. Zero is in the
/// middle of the colours of maps that have one, also where all differences have one sign.
#[must_use]
pub fn span(drawn: &PixelValues, style: &Style) -> ColorRange {
    let values = with_raster!(&drawn.values, raster => Extrema::of_pixels(raster, &drawn.view));
    let mut span = ColorRange { values, ..drawn.span(style, None) };
    if style.range.is_found() && style.colormap.diverging && style.scale != Scale::Log {
        let size = span.max.max(-span.min);
        (span.min, span.max) = (-size, size);
    }
    span
}

#[cfg(test)]
mod tests;
