//! Colours on the card against those of the CPU.

use ppum::field::Field;
use ppum_gpu::{Colors, Method, TransferFunction, Values};
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::RangeChoice;
use ppum_render::raster::Raster;
use ppum_render::scale::Scale;
use ppum_testkit::fields::Window;
use ppum_testkit::synthetic::Recipe;

use crate::{draw, good, quantity, renderer_or_skip, view};

/// Relative distance from an end of the range within which single precision may decide otherwise.
const ROUNDING: f64 = 1e-6;

/// Steps of a byte that a channel may be off: the palettes are equal, and neighbours in them differ
/// by at most one half of a step, rounded.
const STEP: u8 = 1;

/// The range leaves values below and above it, and the window reaches beyond the domain.
#[test]
fn colours_are_those_of_the_cpu() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let recipe = Recipe { level: 1, ..Recipe::default() };
    let dataset = recipe.dataset();
    let field = good(Field::new(&dataset, 0));
    let window = Window { center: recipe.domain.center(), width: 1.5123, pixels: [83, 61] };
    let scene = good(renderer.upload(&field));
    for (text, method, scale, map) in [
        ("von-mises", Method::Gather, Scale::Linear, "viridis"),
        ("von-mises", Method::Splat, Scale::Log, "magma_r"),
        ("duy_dx", Method::Gather, Scale::SymLog, "coolwarm"),
    ] {
        let quantity = quantity(text, &field);
        let mut values = good(renderer.compile(&scene, Values(quantity.clone()), method));
        let raster = draw(&mut renderer, &mut values, &window);
        let range = middle(&raster);
        let mut style = good(Style::named(map));
        (style.scale, style.range, style.undefined) =
            (scale, RangeChoice::Fixed(range.0, range.1), [9, 8, 7, 6]);
        let expected = good(ColoredRaster::bare(&raster, &view(&window), &style));
        assert!(
            expected.has_below && expected.has_above,
            "{text}: the range should leave values out"
        );
        assert!(raster.values.iter().any(|v| v.is_nan()), "{text}: the domain should end");
        let shading = TransferFunction {
            normalization: expected.normalization,
            colormap: style.colormap.clone(),
            undefined: style.undefined,
        };
        let mut colors = good(renderer.compile(&scene, Colors { quantity, shading }, method));
        let found = good(good(renderer.draw(&mut colors, &view(&window))).read());
        assert_eq!(found.size, expected.image.size);
        compare(&format!("{text}, {scale}"), &found.rgba, &expected.image.rgba, &raster, range);
    }
}

/// A range that leaves out a tenth of the values on each side.
fn middle(raster: &Raster<f32>) -> (f64, f64) {
    let mut values: Vec<f32> = raster.values.iter().copied().filter(|v| v.is_finite()).collect();
    values.sort_by(f32::total_cmp);
    let at = |tenth: usize| f64::from(values[values.len() * tenth / 10]);
    (at(1), at(9))
}

fn compare(what: &str, found: &[u8], expected: &[u8], raster: &Raster<f32>, range: (f64, f64)) {
    let (mut left_out, mut worst) = (0, 0);
    for ((found, expected), &value) in found.chunks(4).zip(expected.chunks(4)).zip(&raster.values) {
        let near = |end: f64| (f64::from(value) - end).abs() < ROUNDING * end.abs();
        if near(range.0) || near(range.1) {
            left_out += 1;
            continue;
        }
        let off = found.iter().zip(expected).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        assert!(off <= STEP, "{what}: {found:?} for {expected:?}, value {value}");
        worst = worst.max(off);
    }
    println!("{what}: {worst} steps at most, {left_out} pixels left out");
    assert!(left_out < raster.values.len() / 100, "{what}: {left_out} pixels left out");
}
