//! Gather and splat against the scalar reference.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_gpu::{Choice, Method, Renderer};
use ppum_render::reference::reference;
use ppum_render::view::View;
use ppum_testkit::synthetic::Recipe;

#[test]
fn first() {
    let mut renderer = Renderer::open(Choice::Any).expect("x");
    let recipe = Recipe::default();
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(recipe.domain.center(), 1.2637, [131, 97]).expect("a view");
    for quantity in
        [Quantity::Overlap, Quantity::WeightSum, Quantity::Component(0), Quantity::VonMises]
    {
        let expected = reference(&field, &view, &quantity).expect("a quantity");
        for method in [Method::Gather, Method::Splat] {
            let found =
                renderer.render(&field, &view, &quantity, method).unwrap_or_else(|e| panic!("{e}"));
            let mut all: Vec<f64> = found
                .values
                .iter()
                .zip(&expected.values)
                .map(|(&a, &b)| {
                    if b.is_nan() && a.is_nan() {
                        0.0
                    } else {
                        (f64::from(a) - b).abs() / (1e-30 + b.abs())
                    }
                })
                .collect();
            all.sort_by(f64::total_cmp);
            let q = |s: f64| all[((all.len() - 1) as f64 * s) as usize];
            println!("{quantity:?} {method:?} {:e} {:e} {:e}", q(0.5), q(0.99), q(1.0));
        }
    }
}
