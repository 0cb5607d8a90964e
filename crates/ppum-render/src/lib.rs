//! Draws fields exactly at every pixel.
//!
//! A [`View`](view::View) says which part of the plane is shown on how many pixels,
//! [`render`](scatter::render) evaluates a quantity at the centre of each pixel into a
//! [`Raster`](raster::Raster), and [`Picture`](picture::Picture) gives its values colours. [`png`]
//! encodes the result together with what it shows, [`animation`] several of them; [`samples`] takes means over pixels; `ppum-figure` draws on it and around it. Nothing is resampled, interpolated or triangulated on the way.
//! [`deform`] shows the plate as its displacements move it; [`resample`] does what other programs do, to compare.
//!
//! What is drawn on pictures comes from the exact field too: [`isolines`](isoline::isolines), arrows and crosses ([`glyph`]), and the
//! true [`extrema`](extrema::extrema) of a view. [`pieces`] cuts squares where fields jump.
//!
//! ```
//! use ppum::prelude::*;
//! use ppum::progress::unwatched;
//! use ppum_render::picture::{Picture, Style};
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
//! let picture = Picture::bare(&raster, &view, &Style::named("viridis")?)?;
//! let file = png::encode(&picture.image, &picture.description("A slope", "by hand", "u"))?;
//! assert_eq!(&file[1..4], b"PNG");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Values
//!
//! [`reference`](mod@reference) evaluates a picture point by point; the renderer is held to it. Its values are
//! those of the points, whatever is drawn around them. Those of the renderer are summed tile by tile, in an
//! order and about a displacement that depend on where in its picture a point lies: alone, in a row or amid
//! other pixels it agrees to 10⁻¹⁵ of the largest value in f64 and 6·10⁻⁷ in f32, as measured with stresses. No value depends on the number of threads. Work runs on the
//! pool of `rayon` that calls (`ThreadPool::install`), and no other is needed.
//!
//! Rendering takes a [`Watcher`](ppum::progress::Watcher), which follows it and can stop it.

pub mod animation;
pub mod cells;
pub mod colormap;
pub mod deform;
mod error;
pub mod extrema;
pub mod glyph;
pub mod image;
pub mod isoline;
mod parts;
pub mod picture;
pub mod pieces;
pub mod pixels;
pub mod png;
pub mod range;
pub mod raster;
pub mod reference;
pub mod resample;
pub mod samples;
pub mod scale;
pub mod scatter;
pub mod shades;
pub mod view;

pub use error::RenderError;

#[cfg(test)]
mod tests {
    use std::path::Path;

    use ppum_testkit::rooms::{Floors, check, check_page};

    const FLOORS: Floors<'_> = &[
        &[("image", &[]), ("parts", &[]), ("pieces", &[]), ("scale", &[]), ("view", &[])],
        &[
            ("colormap", &["image"]),
            ("error", &["view"]),
            ("pixels", &["view"]),
            ("png", &["image"]),
        ],
        &[("shades", &["colormap", "image", "scale"])],
        &[("raster", &["error", "image", "shades", "view"])],
        &[
            ("animation", &["image", "png"]),
            ("cells", &["raster", "view"]),
            ("deform", &["parts", "pieces", "raster", "view"]),
            ("isoline", &["error", "parts", "pieces", "raster", "view"]),
            ("reference", &["error", "parts", "raster", "view"]),
            ("resample", &["error", "parts", "raster", "view"]),
            ("extrema", &["error", "parts", "raster", "view"]),
            ("scatter", &["error", "image", "parts", "pixels", "raster", "shades", "view"]),
        ],
        &[
            ("glyph", &["deform", "error", "parts", "view"]),
            ("range", &["extrema", "raster", "scale"]),
            ("samples", &["error", "raster", "scatter", "view"]),
        ],
        &[(
            "picture",
            &[
                "colormap", "extrema", "image", "png", "range", "raster", "samples", "scale",
                "shades", "view",
            ],
        )],
    ];

    #[test]
    fn arrows_lead_down() {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        check(&sources, FLOORS);
        check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
    }

    #[test]
    fn errors_cross_threads() {
        fn check<E: std::error::Error + Send + Sync + 'static>() {}
        check::<super::RenderError>();
        check::<super::animation::AnimationError>();
        check::<super::colormap::ColormapError>();
        check::<super::range::RangeError>();
        check::<super::view::ViewError>();
    }
}
