//! Replaced functions and weights: what is drawn is the replaced field.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::decompose::FieldPart;
use ppum::field::Field;
use ppum::formula::Table;
use ppum::function::{Frame, FunctionKind};
use ppum::progress::unwatched;
use ppum_gpu::{Method, Renderer, Values};
use ppum_testkit::synthetic::Recipe;

use crate::{METHODS, bits, check, draw, good, quantity, renderer_or_skip, view, window};

fn dataset() -> Dataset {
    let extra = vec![FunctionKind::formula("x*y^2", Frame::World)];
    Recipe { extra, level: 1, ..Recipe::default() }.dataset()
}

/// Some replacements: functions of each kind, and the weight.
fn replacements() -> Vec<(&'static str, Dataset)> {
    let all = [
        ("sqrt(r)*cos(theta/2)", "r*cos(theta) + x^2"),
        ("side 0", "tanh(8*(y - 0.2))"),
        ("one", "1 + x*y/4"),
        ("extra", "side(0)*exp(-x)"),
    ];
    let mut out: Vec<_> = all
        .map(|(which, text)| {
            let mut new = dataset();
            good(new.steps[0].replace_function(which, text, &[]));
            (which, new)
        })
        .into();
    for weight in ["cosine", "(1 - t)^3*(1 + 3*t)"] {
        let mut new = dataset();
        good(new.steps[0].replace_weight(weight, &[]));
        out.push((weight, new));
    }
    out
}

/// Functions of components, and formulas in the place of some.
#[test]
fn replaced_functions_of_components() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let mut new = Recipe::meeting().dataset();
    good(new.steps[0].replace_function("component 1", "x*y^2", &[]));
    good(new.steps[0].replace_function("component 2", "side(0)", &[]));
    let truth = good(Field::new(&new, 0));
    let scene = good(renderer.upload(&truth));
    let stress = Values(quantity("von-mises", &truth));
    for method in METHODS {
        let mut program = good(renderer.compile(&scene, stress.clone(), method));
        let raster = draw(&mut renderer, &mut program, &window());
        check("components", &truth, "von-mises", method, &raster);
    }
}

#[test]
fn replaced_functions_are_drawn() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    for (k, (what, new)) in replacements().iter().enumerate() {
        let method = METHODS[k % 2];
        let truth = good(Field::new(new, 0));
        let scene = good(renderer.upload(&truth));
        let stress = Values(quantity("von-mises", &truth));
        let mut program = good(renderer.compile(&scene, stress, method));
        let raster = draw(&mut renderer, &mut program, &window());
        check(what, &truth, "von-mises", method, &raster);
    }
}

/// The device is lost after functions were replaced: the scene comes back with the groups the
/// program knows.
#[test]
fn replaced_functions_survive_a_loss() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    for (what, new) in &replacements()[1..3] {
        let truth = good(Field::new(new, 0));
        let scene = good(renderer.upload(&truth));
        let stress = Values(quantity("von-mises", &truth));
        let mut program = good(renderer.compile(&scene, stress, Method::Gather));
        renderer.gpu().lose();
        let raster = draw(&mut renderer, &mut program, &window());
        check(what, &truth, "von-mises", Method::Gather, &raster);
    }
}

/// Patches without a smooth part do not mind that the function in place of 1 has no value.
#[test]
fn a_function_is_not_asked_where_it_is_not_used() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let mut dataset = dataset();
    let step = &mut dataset.steps[0];
    let jumps = good(step.fields[0].part(FieldPart::Jump, &step.functions));
    step.fields[0] = jumps;
    // negative everywhere: no logarithm
    good(step.replace_function("one", "log(-1 - x^2)", &[]));
    let truth = good(Field::new(&dataset, 0));
    let stress = quantity("von-mises", &truth);
    for method in METHODS {
        let raster = good(renderer.render(&truth, &view(&window()), &stress, method, unwatched()));
        check("jumps alone", &truth, "von-mises", method, &raster);
    }
}

/// Texts that no shader can hold, and texts that are no formulas, say what is wrong; what was
/// compiled before is drawn as before.
#[test]
fn a_broken_formula_leaves_the_old_picture() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = dataset();
    let field = good(Field::new(&dataset, 0));
    let stress = Values(quantity("von-mises", &field));
    let scene = good(renderer.upload(&field));
    let mut program = good(renderer.compile(&scene, stress, Method::Gather));
    let before = bits(&draw(&mut renderer, &mut program, &window()));
    let message = too_large(&mut renderer, &dataset);
    assert!(message.contains("2047"), "{message}");
    let after = bits(&draw(&mut renderer, &mut program, &window()));
    assert!(before == after);
    let mut wrong = dataset.clone();
    let error = wrong.steps[0].replace_function("extra", "x*(y", &[]).expect_err("no formula");
    assert!(error.to_string().contains("x*(y"), "{error}");
    assert_eq!(wrong, dataset);
}

/// The message about a table of 3000 knots.
fn too_large(renderer: &mut Renderer, dataset: &Dataset) -> String {
    let x: Vec<f64> = (0..3000).map(f64::from).collect();
    let values = x.iter().map(|x| x.sin()).collect();
    let mut broken = dataset.clone();
    broken.tables = vec![Arc::new(good(Table::curve("big", x, values)))];
    let tables = broken.tables.clone();
    good(broken.steps[0].replace_function("extra", "table(big, x)", &tables));
    let field = good(Field::new(&broken, 0));
    let stress = Values(quantity("von-mises", &field));
    let scene = good(renderer.upload(&field));
    let compiled = renderer.compile(&scene, stress, Method::Gather);
    compiled.expect_err("no shader holds so large a table").to_string()
}
