//! The way values become colours, of one image or of several in one range.
//!
//! All images of a series are looked at first, which [`ValueStatistics`] keeps in mind; then each
//! has its colours by the [`ColorMapping`] of all.

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_render::RasterError;
use ppum_render::extrema::Extrema;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::{Basis, ColorRange, RangeChoice, RangeError};
use ppum_render::scale::Scale;

use super::body::BodyView;
use super::values::PixelValues;
use super::whole;

/// The way values become colours.
#[derive(Clone, Debug)]
pub struct ColorMapping {
    /// Map and scale.
    pub style: Style,
    /// The range.
    pub span: ColorRange,
    /// For a series, whether values of some step lie below the range, and above it, so that all
    /// bars are alike.
    pub ends: Option<[bool; 2]>,
}

impl ColorMapping {
    /// The values in colours.
    ///
    /// # Errors
    /// As [`PixelValues::picture`].
    pub fn picture(&self, drawn: &PixelValues) -> Result<ColoredRaster, RangeError> {
        let mut picture = drawn.picture(&self.style, self.span.clone())?;
        if let Some(ends) = self.ends {
            [picture.has_below, picture.has_above] = ends;
            picture.one_value = None;
        }
        Ok(picture)
    }
}

/// The range of what was drawn; one that has to be found with the extrema of what is seen of the
/// body. These are the same whether it is deformed or not, and their places are those of the
/// undeformed body.
///
/// # Errors
/// A quantity that the field does not have, a watcher that stops the search.
pub fn value_span(
    field: &Field<'_>,
    seen: &BodyView<'_>,
    quantity: &Quantity,
    drawn: &PixelValues,
    style: &Style,
    watcher: &dyn Watcher,
) -> Result<ColorRange, RasterError> {
    if !style.range.is_found() {
        return Ok(drawn.span(style, None));
    }
    // a deformed body that is drawn has displacements
    let regions = seen.regions(field).unwrap_or_default();
    let parts = (regions.as_slice(), &seen.lines);
    Ok(drawn.span(style, whole::extrema(field, parts, quantity, watcher)?))
}

/// Ranges of values and undefined pixels of images, before colours are chosen.
#[derive(Clone, Debug, Default)]
pub struct ValueStatistics {
    spans: Vec<ColorRange>,
    /// Those of steps that have one value everywhere.
    even: Vec<ColorRange>,
    /// Smallest and largest value.
    values: Option<[f64; 2]>,
    /// Number of pixels of the body without a value, and of all of them.
    pub undefined: [usize; 2],
}

impl ValueStatistics {
    /// Adds a step. One without values says nothing of the range; one that has one value
    /// everywhere, as before any load, no more than this value.
    pub fn add(&mut self, mut span: ColorRange, drawn: &PixelValues, scale: Scale) {
        let [without, all] = drawn.undefined();
        self.undefined = [self.undefined[0] + without, self.undefined[1] + all];
        let found = drawn.values.statistics();
        if found.finite + found.infinite == 0 {
            return;
        }
        let constant = span.values.as_ref().and_then(Extrema::constant);
        let ends = constant.map_or_else(|| drawn.values.ends(), |value| [value; 2]);
        let known = self.values.unwrap_or(ends);
        self.values = Some([known[0].min(ends[0]), known[1].max(ends[1])]);
        match constant.or_else(|| drawn.values.one_value()) {
            Some(value) if span.basis != Basis::Given && (scale != Scale::Log || value > 0.0) => {
                self.even.push(span.clone());
                [span.min, span.max] = [value; 2];
            }
            _ => {}
        }
        self.spans.push(span);
    }

    /// The way the values of all steps become colours: classes have theirs, which `classed` says;
    /// else it follows from the range.
    #[must_use]
    pub fn coloring(self, classed: Style, style: Style) -> ColorMapping {
        match classed.range {
            RangeChoice::Fixed(min, max) if !classed.colormap.classes().is_empty() => {
                let span = ColorRange { min, max, basis: Basis::Given, values: None };
                ColorMapping { style: classed, span, ends: Some([false; 2]) }
            }
            _ => self.ranged(style),
        }
    }

    fn ranged(self, style: Style) -> ColorMapping {
        let symmetric = style.colormap.diverging;
        let shared = ColorRange::shared(&self.spans, symmetric);
        let is_range = |span: &ColorRange| span.normalization(style.scale).is_ok();
        let span = shared.filter(is_range).or_else(|| ColorRange::shared(&self.even, symmetric));
        let nothing = ColorRange { min: 0.1, max: 1.0, basis: Basis::All, values: None };
        let span = span.or_else(|| self.spans.into_iter().next()).unwrap_or(nothing);
        let varies = self.values.filter(|[min, max]| min < max);
        let ends = varies.map(|[min, max]| [min < span.min, max > span.max]);
        ColorMapping { style, span, ends }
    }
}
