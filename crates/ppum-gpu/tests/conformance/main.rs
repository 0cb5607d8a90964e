//! All renderers draw the corpus of fields alike.
//!
//! Tests need a graphics device, a software one is enough. Where there is none they say visibly that they are
//! skipped, or fail if `PPUM_REQUIRE_GPU` is set.

mod corpus;

use std::fmt::Display;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_gpu::{Choice, GpuError, Renderer};
use ppum_render::raster::{Raster, Sample};
use ppum_render::view::View;
use ppum_testkit::fields::Window;

/// A renderer, if there is a device.
///
/// # Panics
/// When one is required and there is none, or when opening it fails.
fn renderer_or_skip() -> Option<Renderer> {
    match Renderer::open(Choice::Any) {
        Ok(renderer) => Some(renderer),
        Err(error @ GpuError::NoAdapter { .. }) => {
            assert!(std::env::var_os("PPUM_REQUIRE_GPU").is_none(), "{error}");
            eprintln!("SKIPPED: no graphics adapter");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

fn view(window: &Window) -> View {
    View::new(window.center, window.width, window.pixels).expect("a view")
}

fn quantity(text: &str, field: &Field<'_>) -> Quantity {
    good(Quantity::parse(text, field))
}

/// What must not fail here.
fn good<T, E: Display>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|error| panic!("{error}"))
}

/// The values of a raster in double precision.
fn values<T: Sample>(raster: &Raster<T>) -> Vec<f64> {
    raster.values.iter().map(|&value| value.into()).collect()
}
