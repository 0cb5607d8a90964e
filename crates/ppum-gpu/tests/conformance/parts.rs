//! Parts of a field are fields: drawn alone they are what the CPU draws, and together they are
//! the whole.

use ppum::decompose::{FieldPart, KINDS};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum_gpu::Method;
use ppum_testkit::synthetic::Recipe;

use crate::{METHODS, bits, check, good, render, renderer_or_skip};

#[test]
fn parts_are_drawn_alone() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let extra = vec![FunctionKind::formula("x*y^2", Frame::World)];
    let whole = Recipe { extra, level: 1, ..Recipe::default() }.dataset();
    let step = &whole.steps[0];
    let mut sum =
        vec![0.0; bits(&render(&mut renderer, &field(&whole), "uy", Method::Gather)).len()];
    for part in KINDS.into_iter().chain([FieldPart::Patch(17)]) {
        let mut dataset = whole.clone();
        dataset.steps[0].fields = vec![good(step.fields[0].part(part, &step.functions))];
        let field = field(&dataset);
        for method in METHODS {
            let raster = render(&mut renderer, &field, "uy", method);
            check(&part.to_string(), &field, "uy", method, &raster);
            if method == Method::Gather && !matches!(part, FieldPart::Patch(_)) {
                sum.iter_mut()
                    .zip(&raster.values)
                    .for_each(|(sum, &value)| *sum += f64::from(value));
            }
        }
        let raster = render(&mut renderer, &field, "von-mises", Method::Gather);
        check(&format!("stress of {part}"), &field, "von-mises", Method::Gather, &raster);
    }
    let together = render(&mut renderer, &field(&whole), "uy", Method::Gather);
    let apart = sum.iter().zip(&together.values).map(|(a, &b)| (a - f64::from(b)).abs());
    let worst = apart.filter(|d| !d.is_nan()).fold(0.0, f64::max);
    assert!(worst < 1e-5, "{worst}");
}

/// Functions of components are jumps.
#[test]
fn jumps_of_cracks_that_meet_are_drawn_alone() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let mut dataset = Recipe::meeting().dataset();
    let step = &mut dataset.steps[0];
    step.fields = vec![good(step.fields[0].part(FieldPart::Jump, &step.functions))];
    let field = field(&dataset);
    for method in METHODS {
        let raster = render(&mut renderer, &field, "uy", method);
        check("jumps", &field, "uy", method, &raster);
    }
}

fn field(dataset: &ppum::dataset::Dataset) -> Field<'_> {
    good(Field::new(dataset, 0))
}
