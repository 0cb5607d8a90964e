//! Values and slopes of components against the scalar evaluation.

use ppum::field::Field;
use ppum::quantity::{Axis, Quantity};
use ppum::weight::WeightFunction;
use ppum_gpu::{Renderer, Values};
use ppum_testkit::fields::Truth;
use ppum_testkit::synthetic::Recipe;

use crate::{METHODS, SINGLE, good, renderer_or_skip, values, view, window};

fn recipes() -> Vec<(u8, Recipe)> {
    let cubic = Recipe { weight: WeightFunction::Cubic, level: 1, ..Recipe::default() };
    let four = Recipe { components: 4, tip_level: 2, degrees: vec![3], ..cubic.clone() };
    let texts = cubic.tip_functions.clone().map(|text| format!("({text})"));
    let formulas = Recipe { tip_functions: texts, tip_degree: 1, ..cubic.clone() };
    let own = Recipe { weight: WeightFunction::Quadratic, own_frames: true, ..cubic.clone() };
    vec![(1, cubic), (3, four), (0, formulas), (1, own)]
}

fn check(renderer: &mut Renderer, component: u8, recipe: &Recipe) {
    let dataset = recipe.dataset();
    let field = good(Field::new(&dataset, 0));
    let truth = Truth::new(&field, window());
    let expected = truth.component(component.into());
    let scene = good(renderer.upload(&field));
    for method in METHODS {
        for (k, expected) in expected.iter().enumerate().take(3) {
            let quantity = match k {
                0 => Quantity::Component(component),
                1 => Quantity::Derivative(component, Axis::X),
                _ => Quantity::Derivative(component, Axis::Y),
            };
            let name = ["v", "x", "y"][k];
            let mut program = good(renderer.compile(&scene, Values(quantity), method));
            let found = good(good(renderer.draw(&mut program, &view(&window()))).read());
            let found = expected.compare(values(&found).into_iter());
            println!("{method:?}, {name} of component {component}: {:e}", found.worst);
            let good = found.strange == 0 && found.most < SINGLE && found.worst < SINGLE;
            assert!(good, "{method:?}, {name}: {found:?}");
        }
    }
}

#[test]
fn components_have_their_derivatives() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    for (component, recipe) in recipes() {
        check(&mut renderer, component, &recipe);
    }
}
