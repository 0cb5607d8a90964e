//! Draws fields exactly at every pixel.
//!
//! [`ppum_raster`], whose modules are re-exported here, evaluates a quantity at the centre of each
//! pixel of a [`View`](view::View) into a [`Raster`](raster::Raster), and
//! [`ColoredRaster`](picture::ColoredRaster) maps its values to colours. [`png`] encodes an image
//! with its metadata, [`animation`] encodes several images; [`samples`] takes means over pixels;
//! `ppum-figure` draws over images and around them. Nothing is resampled, interpolated or
//! triangulated. [`deform`] draws the deformed body; [`resample`] resamples on a grid as other
//! programs do, for comparison.
//!
//! Overlays use the exact field too: [`isolines`](isoline::isolines), arrows and crosses
//! ([`glyph`]), and the true [`extrema`](extrema::extrema) of a view. [`pieces`] splits squares
//! along the lines where fields jump.
//!
//! ```
//! use ppum::prelude::*;
//! use ppum::progress::unwatched;
//! use ppum_render::picture::{ColoredRaster, Style};
//! use ppum_render::{png, scatter::render, view::View};
//!
//! // one patch, u = 1 + 2ξ with ξ = x / 1.25
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 0)?.partition(1.25, WeightFunction::Linear)?;
//! let mut potential = FieldData::new("potential", &["u"]);
//! potential.push_patch(&[(0, 1)]);
//! potential.coefficients_mut(0).for_each(|c| c.copy_from_slice(&[1.0, 2.0, 0.0]));
//! let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
//! let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
//! let field = Field::new(&dataset, 0)?;
//!
//! let view = View::window(-1.0, -1.0, 1.0, 1.0, [4, 4])?;
//! let raster = render::<f64>(&field, &view, &Quantity::parse("u", &field)?, unwatched())?;
//! assert!((raster.value(3, 0) - 2.2).abs() < 1e-15); // x = 0.75
//! let picture = ColoredRaster::bare(&raster, &view, &Style::named("viridis")?)?;
//! let file = png::encode(&picture.image, &picture.description("A slope", "by hand", "u"))?;
//! assert_eq!(&file[1..4], b"PNG");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod anchored_edge;
pub mod animation;
pub mod cells;
pub mod colormap;
pub mod deform;
pub mod extrema;
pub mod glyph;
pub mod image;
pub mod isoline;
pub mod picture;
pub mod pieces;
pub mod png;
pub mod range;
pub mod resample;
pub mod samples;
pub mod scale;
pub mod shades;

pub use ppum_raster::{RasterError, pixels, raster, reference, scatter, view};

#[cfg(test)]
ppum_testkit::errors_cross_threads!(
    animation::AnimationError,
    colormap::ColormapError,
    range::RangeError
);
