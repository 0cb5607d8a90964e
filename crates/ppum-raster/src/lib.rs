//! Evaluates fields exactly at every pixel of a view.
//!
//! A [`View`](view::View) says which part of the plane is shown on how many pixels.
//! [`render`](scatter::render) evaluates a quantity at the centre of each pixel into a
//! [`Raster`](raster::Raster), on vectors and on all threads; [`reference`](mod@reference) does so
//! point by point. Nothing is resampled, interpolated or triangulated on the way. `ppum-render`
//! gives the values colours.
//!
//! ```
//! use ppum::prelude::*;
//! use ppum::progress::unwatched;
//! use ppum_raster::{scatter::render, view::View};
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
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Values
//!
//! The renderer is held to [`reference`](mod@reference), whose values are those of the points,
//! whatever is drawn around them. Values of the renderer are summed tile by tile, in an order and
//! about a displacement that depend on where in its raster a point lies: alone, in a row or amid
//! other pixels it agrees to 10⁻¹⁵ of the largest value in f64 and 6·10⁻⁷ in f32, as measured with
//! stresses. No value depends on the number of threads. Work runs on the pool of `rayon` that calls
//! (`ThreadPool::install`), and no other is needed.
//!
//! Rendering takes a [`Watcher`](ppum::progress::Watcher), which follows it and can stop it.
//!
//! # Time to build
//!
//! The kernels of the renderer are generic code, compiled here for each instruction set, number
//! type and order of derivatives. [`RasterValue`](raster::RasterValue) is implemented for f64 and
//! f32 by functions that are not generic, so no other crate compiles kernels. This library has no
//! unit tests, which would compile them again; its tests are in `tests/raster`.

mod error;
pub mod parts;
pub mod pixels;
pub mod raster;
pub mod reference;
pub mod rows;
pub mod scatter;
pub mod summation;
pub mod view;

pub use error::RasterError;
