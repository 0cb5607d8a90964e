//! From a raster of values to colours.

use ppum::vec2::Vec2;
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::view::View;
use rayon::prelude::*;

use crate::colormap::{Colormap, ColormapError, HALF, Rgb};
use crate::extrema::Extrema;
use crate::image::{Image, Rgba};
use crate::png::TextChunk;
use crate::range::{ColorRange, RangeChoice, RangeError};
use crate::samples::Samples;
use crate::scale::{Normalization, Scale};
use crate::shades::Shades;

/// The way values become colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// The colours, those for values below and above the range included.
    pub colormap: Colormap,
    /// The way values spread over the colours.
    pub scale: Scale,
    /// The range of values that the colours span.
    pub range: RangeChoice,
    /// The colour of pixels without a value; transparent unless set.
    pub undefined: Rgba,
    /// The colour of those that lie on the body; crosshatched if there is none.
    pub nan_color: Option<Rgb>,
}

impl Style {
    /// A named colour map on a linear scale with an automatic range.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(colormap: &str) -> Result<Self, ColormapError> {
        let colormap = Colormap::named(colormap)?;
        Ok(Self {
            colormap,
            scale: Scale::Linear,
            range: RangeChoice::Auto,
            undefined: [0; 4],
            nan_color: None,
        })
    }

    /// The style with one colour for each of some rising whole numbers ([`Raster::whole_numbers`]),
    /// on a linear scale.
    #[must_use]
    pub fn classed(self, values: &[f64]) -> Self {
        let (Some(first), Some(last)) = (values.first(), values.last()) else { return self };
        let range = RangeChoice::Fixed(first - HALF, last + HALF);
        Self { colormap: self.colormap.classed(values), scale: Scale::Linear, range, ..self }
    }
}

impl Default for Style {
    /// Viridis, linear, automatic range, transparent where nothing is defined.
    fn default() -> Self {
        Self::named("viridis").expect("viridis is built in")
    }
}

/// A coloured raster, pixel for pixel, with what is needed to read it.
#[derive(Clone, Debug, PartialEq)]
pub struct ColoredRaster {
    /// The colours.
    pub image: Image,
    /// The view.
    pub view: View,
    /// Position of a value among the colours, the range found.
    pub normalization: Normalization,
    /// The range, how it came about, and what is known of the values.
    pub span: ColorRange,
    /// The colours.
    pub colormap: Colormap,
    /// The one value that is seen, if there is no other except for rounding.
    pub one_value: Option<f64>,
    /// True if some value is finite.
    pub has_values: bool,
    /// True if some value lies below the range, at a pixel or not.
    pub has_below: bool,
    /// True if some value lies above the range, at a pixel or not; an infinite one always does.
    pub has_above: bool,
    /// The meaning of a pixel's value: the value at its centre, or a mean.
    pub samples: Samples,
}

/// Lines of the hatching, what lies between them, and their distance in units of their width.
const HATCH: Rgba = [96, 96, 102, 255];
const HATCHED: Rgba = [196, 196, 200, 255];
const HATCH_STEP: u32 = 6;

impl ColoredRaster {
    /// The bare image of a raster: one pixel a value, nothing else. A range that is found is
    /// found from the pixels alone; [`spanning`](Self::spanning) takes one that knows the extrema
    /// between them.
    ///
    /// # Errors
    /// A fixed range that does not fit the scale.
    ///
    /// # Panics
    /// If the raster does not have the view's size.
    pub fn bare<T: RasterValue>(
        raster: &Raster<T>,
        view: &View,
        style: &Style,
    ) -> Result<Self, RangeError> {
        let values = style.range.is_found().then(|| Extrema::of_pixels(raster, view)).flatten();
        let Style { colormap, scale, range, .. } = style;
        let span = range.span(*scale, colormap.diverging, raster, values);
        Self::spanning(raster, view, style, span)
    }

    /// The bare image of a raster with a range that was found for it, or for others too.
    ///
    /// # Errors
    /// A range that does not fit the scale.
    ///
    /// # Panics
    /// If the raster does not have the view's size.
    pub fn spanning<T: RasterValue>(
        raster: &Raster<T>,
        view: &View,
        style: &Style,
        span: ColorRange,
    ) -> Result<Self, RangeError> {
        assert_eq!(raster.size, view.pixels, "a raster belongs to a view of its size");
        let Style { colormap, scale, undefined, .. } = style;
        let norm = span.normalization(*scale)?;
        let shades = Shades::new(colormap, norm, *undefined);
        let constant = span.values.as_ref().and_then(Extrema::constant);
        let (rgba, seen) = match constant {
            None => painted(&shades, &raster.values),
            // what differs from it is rounding
            Some(one) => painted(&shades, &evened(raster, one)),
        };
        let between = span.beyond().map(|value| value.is_some());
        let (has_below, has_above) = (seen[0] | between[0], seen[1] | between[1]);
        Ok(Self {
            image: Image { size: raster.size, rgba },
            view: *view,
            normalization: norm,
            span,
            colormap: colormap.clone(),
            one_value: constant.or_else(|| raster.one_value()),
            has_values: raster.values.iter().any(|&v| v.into().is_finite()),
            has_below,
            has_above,
            samples: Samples::CENTER,
        })
    }

    /// Says that values are means, and gives each pixel the opacity that it has by its share of the
    /// body ([`Means`](crate::samples::Means)).
    ///
    /// # Panics
    /// If there is not one opacity for each pixel.
    pub fn fade(&mut self, samples: Samples, opacity: &[u8]) {
        let pixels = self.image.rgba.as_chunks_mut::<4>().0;
        assert_eq!(pixels.len(), opacity.len(), "one opacity for each pixel");
        for (pixel, &share) in pixels.iter_mut().zip(opacity) {
            pixel[3] = ((u16::from(pixel[3]) * u16::from(share) + 127) / 255) as u8;
        }
        self.samples = samples;
    }

    /// Gives pixels of the body that have no value ([`Raster::undefined`]) a colour, or
    /// crosshatches them, to tell them from those outside.
    pub fn mark_undefined(&mut self, pixels: &[u32], color: Option<Rgb>) {
        let columns = self.image.size[0];
        let rgba = self.image.rgba.as_chunks_mut::<4>().0;
        for &pixel in pixels {
            let (column, row) = (pixel % columns, pixel / columns);
            let is_line =
                (column + row) % HATCH_STEP == 0 || column % HATCH_STEP == row % HATCH_STEP;
            let hatched = if is_line { HATCH } else { HATCHED };
            rgba[pixel as usize] = color.map_or(hatched, |Rgb([r, g, b])| [r, g, b, 255]);
        }
    }

    /// A description of the image, for the texts of its file: `Title`, `Software` and
    /// `Description`, then under `ppum:` the dataset, quantity, view (centre, width, pixels: enough
    /// to draw it again to the last bit), meaning of a pixel, range, scale and colour map; how the
    /// range came about, and the extrema if they were looked for.
    #[must_use]
    pub fn description(&self, title: &str, dataset: &str, quantity: &str) -> Vec<TextChunk> {
        let View { center: Vec2 { x, y }, width, pixels: [columns, rows] } = self.view;
        let norm = &self.normalization;
        let software = concat!("ppum ", env!("CARGO_PKG_VERSION"));
        let summary = match self.samples {
            Samples::CENTER => {
                format!("{quantity} of {dataset}, evaluated at every pixel's centre")
            }
            samples => format!("{quantity} of {dataset}, {}", samples.meaning()),
        };
        let entries = [
            ("Title", title.to_owned()),
            ("Software", software.to_owned()),
            ("Description", summary),
            ("ppum:dataset", dataset.to_owned()),
            ("ppum:quantity", quantity.to_owned()),
            ("ppum:view", format!("center {x:?},{y:?} width {width:?} pixels {columns}x{rows}")),
            ("ppum:pixel", self.samples.meaning()),
            ("ppum:range", format!("{:?},{:?}", norm.min(), norm.max())),
            ("ppum:scale", norm.scale().to_string()),
            ("ppum:colormap", self.colormap.name.clone()),
        ];
        let seen = |values: Extrema| values.seen_from(self.view.center).to_string();
        let known = self.span.values.clone().map(|values| ("ppum:extrema", seen(values)));
        let basis = ("ppum:range-basis", self.span.basis.to_string());
        let entries = entries.into_iter().chain([basis]).chain(known);
        entries.map(|(key, text)| (key.to_owned(), text)).collect()
    }
}

/// One value in place of all finite ones.
fn evened<T: RasterValue>(raster: &Raster<T>, one: f64) -> Vec<f64> {
    let of = |value: f64| if value.is_finite() { one } else { value };
    raster.values.par_iter().map(|&value| of(value.into())).collect()
}

/// Pixels that are coloured at a time.
const BLOCK: usize = 1024;

/// The colours of values, and whether one of them lay below, and above, the range.
fn painted<T: RasterValue>(shades: &Shades, values: &[T]) -> (Vec<u8>, [bool; 2]) {
    let mut rgba = vec![0; 4 * values.len()];
    let pixels = rgba.as_chunks_mut::<4>().0.par_chunks_mut(BLOCK);
    let blocks = pixels.zip(values.par_chunks(BLOCK)).with_min_len(16);
    let seen = blocks.map(|(pixels, values)| shades.paint(T::sample_slice(values), pixels));
    let seen = seen.reduce(|| [false; 2], |a, b| [a[0] | b[0], a[1] | b[1]]);
    (rgba, seen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    fn view(columns: u32, rows: u32) -> View {
        View::new(vec2(0.1, -0.2), 3e-7, [columns, rows]).unwrap()
    }

    #[test]
    fn every_kind_of_value_has_its_colour() {
        let inf = f64::INFINITY;
        let values = vec![0.0, 2.0, 10.0, -0.1, 10.1, inf, -inf, f64::NAN];
        let mut style = Style::named("magma").unwrap();
        style.range = RangeChoice::Fixed(0.0, 10.0);
        style.colormap = style.colormap.contrasting();
        let map = &style.colormap;
        let picture =
            ColoredRaster::bare(&Raster::new([4, 2], values), &view(4, 2), &style).unwrap();
        let colors: Vec<Rgba> = (0..8).map(|k| picture.image.pixel(k % 4, k / 4)).collect();
        let ends = [map.color(0.0), map.color(0.2), map.color(1.0)];
        assert_eq!(colors[..3], ends);
        assert_eq!(colors[3..], [map.below, map.above, map.above, map.below, [0; 4]]);
        assert!(picture.has_below && picture.has_above);
    }

    /// Borders of bands are where the scale has them, to the last bit.
    #[test]
    fn bands_end_at_their_values() {
        let map = Colormap::named("viridis").unwrap().banded(3);
        let style = Style {
            colormap: map.clone(),
            range: RangeChoice::Fixed(0.0, 3.0),
            ..Style::default()
        };
        let values = vec![1.0 - 1e-12, 1.0, 2.0 - 1e-12, 2.0, 3.0, 0.0];
        let picture =
            ColoredRaster::bare(&Raster::new([3, 2], values), &view(3, 2), &style).unwrap();
        let colors: Vec<Rgba> = (0..6).map(|k| picture.image.pixel(k % 3, k / 3)).collect();
        let bands = [0.1, 0.5, 0.9].map(|t| map.color(t));
        assert_eq!(colors, [0, 1, 1, 2, 2, 0].map(|k: usize| bands[k]));
    }

    #[test]
    fn whole_numbers_have_a_colour_each() {
        let values = vec![6.0, 30.0, 12.0, 6.0, f64::NAN, 12.0];
        let raster = Raster::new([3, 2], values);
        let classes = raster.whole_numbers(3).expect("three");
        assert_eq!(classes, [6.0, 12.0, 30.0]);
        let style = Style { scale: Scale::Log, ..Style::default() }.classed(&classes);
        let picture = ColoredRaster::bare(&raster, &view(3, 2), &style).unwrap();
        let colors: Vec<Rgba> = (0..6).map(|k| picture.image.pixel(k % 3, k / 3)).collect();
        let map = Colormap::named("viridis").unwrap();
        let [a, b, c] = [0.0, 0.5, 1.0].map(|t| map.color(t));
        assert_eq!(colors, [a, c, b, a, [0; 4], b]);
        assert!(!picture.has_below && !picture.has_above);
    }

    #[test]
    fn what_has_no_value_is_hatched_or_has_a_colour() {
        let values: Vec<f64> = (0..240).map(|k| if k % 3 == 0 { f64::NAN } else { 1.0 }).collect();
        let raster = Raster::new([20, 12], values);
        let mut picture = ColoredRaster::bare(&raster, &view(20, 12), &Style::default()).unwrap();
        let plain = picture.clone();
        let undefined: Vec<u32> = (0..120).filter(|k| k % 3 == 0).collect();
        let mut colored = picture.clone();
        colored.mark_undefined(&undefined, Some(Rgb([1, 2, 3])));
        let is_colored = |k: u32| colored.image.pixel(k % 20, k / 20) == [1, 2, 3, 255];
        assert!((0..240).all(|k| is_colored(k) == undefined.contains(&k)));
        picture.mark_undefined(&undefined, None);
        let found = [HATCH, HATCHED].map(|color| {
            undefined.iter().filter(|&&k| picture.image.pixel(k % 20, k / 20) == color).count()
        });
        assert!(found[0] > 5 && found[1] > 5 && found[0] + found[1] == undefined.len());
        let is_same =
            |k: u32| picture.image.pixel(k % 20, k / 20) == plain.image.pixel(k % 20, k / 20);
        assert!((0..240).all(|k| is_same(k) != undefined.contains(&k)));
    }

    #[test]
    fn colours_are_those_of_the_map_within_one_step() {
        for (name, scale) in
            [("turbo", Scale::Linear), ("viridis_r", Scale::Log), ("coolwarm", Scale::SymLog)]
        {
            let raster = Raster::from_fn([500, 4], |i, j| f64::from(40 + 4 * i + j).powi(2));
            let style = Style { scale, ..Style::named(name).unwrap() };
            let picture = ColoredRaster::bare(&raster, &view(500, 4), &style).unwrap();
            for (i, j) in [(0, 0), (3, 1), (77, 2), (250, 0), (499, 3)] {
                let t = picture.normalization.position(raster.value(i, j));
                let (found, exact) = (picture.image.pixel(i, j), picture.colormap.color(t));
                let same = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
                assert!(same, "{name} at {i}, {j}: {found:?} for {exact:?}");
            }
            assert!(!picture.has_below && !picture.has_above);
        }
    }

    #[test]
    fn single_precision_gives_the_same_picture() {
        let wide = Raster::from_fn([64, 48], |i, j| f64::from(i * j) * 0.25);
        let narrow = Raster::from_fn([64, 48], |i, j| (i * j) as f32 * 0.25);
        let draw = |picture: Result<ColoredRaster, _>| picture.unwrap().image;
        let style = Style::default();
        assert_eq!(
            draw(ColoredRaster::bare(&wide, &view(64, 48), &style)),
            draw(ColoredRaster::bare(&narrow, &view(64, 48), &style))
        );
    }

    #[test]
    fn the_description_restores_the_view() {
        let raster = Raster::from_fn([4, 2], |i, _| f64::from(i));
        let picture = ColoredRaster::bare(&raster, &view(4, 2), &Style::default()).unwrap();
        let texts = picture.description("Plate", "plate.h5", "von Mises");
        let text = |key: &str| &texts.iter().find(|t| t.0 == key).unwrap().1;
        assert_eq!(text("ppum:view"), "center 0.1,-0.2 width 3e-7 pixels 4x2");
        // what FORMAT.md makes of it
        let numbers = text("ppum:view").split([' ', ',', 'x']).filter_map(|part| part.parse().ok());
        let [x, y, width, columns, rows]: [f64; 5] =
            numbers.collect::<Vec<_>>().try_into().unwrap();
        assert_eq!((vec2(x, y), width), (picture.view.center, picture.view.width));
        for (i, j) in [(0, 0), (3, 0), (1, 1)] {
            let h = width / columns;
            let across = (f64::from(i) - (columns - 1.0) / 2.0) * h;
            let up = ((rows - 1.0) / 2.0 - f64::from(j)) * h;
            assert!((picture.view.offset(i, j) - vec2(across, up)).length() < 1e-15 * width);
        }
        assert_eq!(text("ppum:pixel"), "value at pixel centre");
        assert_eq!(text("ppum:range"), "0.0,3.0");
        assert_eq!(text("Title"), "Plate");
    }
}
