//! Isolines on pictures are the same whatever drew them: they are found on the exact field, and a
//! raster says only where to look.

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum_render::isoline::{Isoline, isolines};
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::scatter;
use ppum_testkit::synthetic::{Coefficients, Recipe};

use crate::{METHODS, good, quantity, render, renderer_or_skip, view, window};

/// Lines of a quantity by a raster of it.
fn lines<T: RasterValue>(
    field: &Field<'_>,
    text: &str,
    levels: &[f64],
    raster: &Raster<T>,
) -> Vec<Isoline> {
    let (view, quantity) = (view(&window()), quantity(text, field));
    good(isolines(field, &view, &quantity, levels, raster, unwatched()))
}

#[test]
fn lines_are_those_of_the_processor() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    for seed in 0..4 {
        let coefficients = Coefficients::Taylor;
        let dataset = Recipe { coefficients, ..Recipe::random(seed) }.dataset();
        let field = good(Field::new(&dataset, 0));
        // each of them on two fields
        let texts = [["ux", "magnitude"], ["uy - 0.3*x", "von-mises"]];
        for text in texts[seed as usize % 2] {
            let shown = view(&window());
            let raster: Raster<f64> =
                good(scatter::render(&field, &shown, &quantity(text, &field), unwatched()));
            let found = raster.statistics();
            let levels = [0.2, 0.4, 0.6].map(|t| found.min + t * (found.mean - found.min) * 1.8);
            let expected = lines(&field, text, &levels, &raster);
            assert!(!expected.is_empty(), "{seed} {text}");
            for method in METHODS {
                let drawn = render(&mut renderer, &field, text, method);
                let found = lines(&field, text, &levels, &drawn);
                assert_eq!(found, expected, "lines of {text} by {method:?}, {seed}");
            }
        }
    }
}
