//! Value, gradient and Hessian of components against the scalar evaluation.

use ppum::field::Field;
use ppum::weight::WeightFunction;
use ppum_gpu::{Derivatives, Renderer};
use ppum_testkit::fields::Truth;
use ppum_testkit::synthetic::Recipe;

use crate::{METHODS, SINGLE, good, renderer_or_skip, values, view, window};

/// Second derivatives of U are divided by S after those of S are subtracted: where S is small
/// single pixels are off by this many times more.
const SECOND: f64 = 10.0;

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
        let mut program = good(renderer.compile(&scene, Derivatives(component), method));
        let found = good(good(renderer.draw(&mut program, &view(&window()))).read());
        for (k, (expected, found)) in expected.iter().zip(&found).enumerate() {
            let found = expected.compare(values(found).into_iter());
            let name = ["v", "x", "y", "xx", "xy", "yy"][k];
            println!("{method:?}, {name} of component {component}: {:e}", found.worst);
            let worst = if k < 3 { SINGLE } else { SECOND * SINGLE };
            let good = found.strange == 0 && found.most < SINGLE && found.worst < worst;
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
