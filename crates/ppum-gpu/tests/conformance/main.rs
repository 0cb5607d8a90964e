//! All renderers draw the corpus of fields alike.
//!
//! Tests need a graphics device, a software one is enough. Where there is none they are
//! [`skipped`].

mod colors;
mod control;
mod corpus;
mod derivatives;
mod large;
mod lost;
mod parts;
mod passes;
mod replaced;
mod series;
mod texts;
mod watched;

use std::fmt::Display;

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::vec2;
use ppum_gpu::{AdapterChoice, GpuError, Method, Program, Renderer, Values};
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::view::View;
use ppum_testkit::fields::{Differences, Truth, Window};
use ppum_testkit::skipped::skipped;
use ppum_testkit::synthetic::Recipe;

/// Single precision: 2⁻²⁴ times what a few hundred operations lose, relative to the local scale.
const SINGLE: f64 = 2e-5;

/// Single pixels may be this much farther off where the method asks for it: the vectors of the CPU
/// expand polynomials of degree 8 along rows; splatting subtracts one constant for the
/// whole picture.
const OUTLIERS: f64 = 5.0;

/// Both ways to draw.
const METHODS: [Method; 2] = [Method::Gather, Method::Splat];

/// A renderer, if there is a device.
///
/// # Panics
/// If one is required and there is none, or if opening it fails.
fn renderer_or_skip() -> Option<Renderer> {
    match Renderer::open(AdapterChoice::Any) {
        Ok(renderer) => Some(renderer),
        Err(GpuError::NoAdapter { .. }) => {
            skipped("no graphics adapter");
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

/// The value of a result that must not be an error here.
fn good<T, E: Display>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|error| panic!("{error}"))
}

/// The values of a raster in double precision.
fn values<T: RasterValue>(raster: &Raster<T>) -> Vec<f64> {
    raster.values.iter().map(|&value| value.into()).collect()
}

/// Most of the domain of the recipes.
fn window() -> Window {
    let center = Recipe::default().domain.center();
    Window { center: center + vec2(0.0123, -0.0171), width: 1.2637, pixels: [71, 53] }
}

/// A program's values of a view.
fn draw(
    renderer: &mut Renderer,
    program: &mut Program<'_, Values>,
    window: &Window,
) -> Raster<f32> {
    good(good(renderer.draw(program, &view(window))).read())
}

/// The values of a quantity, uploaded and drawn.
fn render(renderer: &mut Renderer, field: &Field<'_>, text: &str, method: Method) -> Raster<f32> {
    good(renderer.render(field, &view(&window()), &quantity(text, field), method, unwatched()))
}

/// Checks a picture of [`window`] against the evaluation point by point.
fn check(what: &str, field: &Field<'_>, text: &str, method: Method, raster: &Raster<f32>) {
    let truth = Truth::new(field, window());
    let found = truth.expected(&quantity(text, field)).compare(values(raster).into_iter());
    println!("{what} by {method:?}: {:e}", found.worst);
    close(what, method, &found);
}

/// Checks that a picture is that of the field, in single precision.
fn close(what: &str, method: Method, found: &Differences) {
    let worst = if method == Method::Splat { OUTLIERS * SINGLE } else { SINGLE };
    let good = found.strange == 0 && found.most < SINGLE && found.worst < worst;
    assert!(good, "{what} by {method:?}: {found:?}");
}

/// The bits of a picture: NaN are equal.
fn bits(raster: &Raster<f32>) -> Vec<u32> {
    raster.values.iter().map(|value| value.to_bits()).collect()
}
