//! What is drawn on pictures is the same whatever drew them: isolines and extrema are found on the
//! exact field, and a raster says only where to look.

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum_render::extrema::{Extrema, extrema};
use ppum_render::isoline::{Isoline, isolines};
use ppum_render::raster::{Raster, Sample};
use ppum_render::scatter;
use ppum_testkit::synthetic::{Coefficients, Recipe};

use crate::{METHODS, good, quantity, render, renderer_or_skip, view, window};

/// Lines and extrema of a quantity by a raster of it.
fn passes<T: Sample>(
    field: &Field<'_>,
    text: &str,
    levels: &[f64],
    raster: &Raster<T>,
) -> (Vec<Isoline>, Option<Extrema>) {
    let (view, quantity) = (view(&window()), quantity(text, field));
    let lines = good(isolines(field, &view, &quantity, levels, raster, unwatched()));
    (lines, good(extrema(field, &view, &quantity, raster, unwatched())))
}

#[test]
fn lines_and_extrema_are_those_of_the_processor() {
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
            let expected = passes(&field, text, &levels, &raster);
            assert!(!expected.0.is_empty() && expected.1.is_some(), "{seed} {text}");
            for method in METHODS {
                let drawn = render(&mut renderer, &field, text, method);
                let found = passes(&field, text, &levels, &drawn);
                assert_eq!(found.0, expected.0, "lines of {text} by {method:?}, {seed}");
                let [found, expected] = [&found.1, &expected.1].map(|e| {
                    let e = e.as_ref().expect("values");
                    [e.min, e.max]
                });
                for (found, expected) in found.iter().zip(expected) {
                    let size = found.value.abs().max(1e-3);
                    let is_same = (found.value - expected.value).abs() <= 1e-6 * size
                        || found.value == expected.value;
                    assert!(is_same, "{text} by {method:?}, {seed}: {found:?} {expected:?}");
                }
            }
        }
    }
}
