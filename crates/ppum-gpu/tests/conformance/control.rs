//! The comparison catches what is slightly wrong: a negative control.

use ppum::field::Field;
use ppum_gpu::Method;
use ppum_testkit::fields::{Differences, Truth};
use ppum_testkit::synthetic::Recipe;

use crate::{SINGLE, good, quantity, render, renderer_or_skip, values, window};

/// Errors of some 10⁻³ on one side only: a weight whose value is nearly right but not its slope,
/// tip functions with a wrong half angle, another sign, or a wrong exponent, a side that
/// is smeared.
const WRONG: [(Option<&str>, &str); 5] = [
    (None, "(1 - t)*(1 + 0.002*t)"),
    (Some("sqrt(r)*cos(theta/2)"), "sqrt(r)*cos(theta/1.998)"),
    (Some("sqrt(r)*sin(theta/2)"), "-sqrt(r)*sin(theta/2)"),
    (Some("sqrt(r)*sin(theta)*cos(theta/2)"), "r^0.501*sin(theta)*cos(theta/2)"),
    (Some("side 0"), "1.0005*side(0)"),
];

#[test]
fn slightly_wrong_functions_are_caught() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = Recipe { level: 1, ..Recipe::default() }.dataset();
    let field = good(Field::new(&dataset, 0));
    let truth = Truth::new(&field, window());
    let expected = truth.expected(&quantity("von-mises", &field));
    let mut difference = |field: &Field<'_>| -> Differences {
        let raster = render(&mut renderer, field, "von-mises", Method::Gather);
        expected.compare(values(&raster).into_iter())
    };
    assert!(difference(&field).worst < SINGLE);
    for (which, text) in WRONG {
        let mut wrong = dataset.clone();
        match which {
            Some(which) => drop(good(wrong.steps[0].replace_function(which, text, &[]))),
            None => good(wrong.steps[0].replace_weight(text, &[])),
        }
        let found = difference(&good(Field::new(&wrong, 0)));
        println!("{text}: {:e}", found.worst);
        assert!(found.worst > 2.0 * SINGLE, "{text} is not caught: {found:?}");
    }
}
