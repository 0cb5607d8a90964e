//! Large data: many patches are drawn, and what does not fit is refused with the numbers.

use ppum::field::Field;
use ppum_gpu::{GpuError, Method};
use ppum_testkit::synthetic::Recipe;

use crate::{check, good, render, renderer_or_skip};

/// A cover of 16 · 4^level patches without a crack.
fn uniform(level: u8) -> Recipe {
    let recipe = Recipe { cells: [4, 4], level, tip_level: level, ..Recipe::default() };
    Recipe { cracks: Vec::new(), degrees: vec![1], components: 1, ..recipe }
}

#[test]
fn a_million_patches_are_drawn() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = uniform(8).dataset();
    let field = good(Field::new(&dataset, 0));
    assert_eq!(field.step.partition.len(), 1 << 20);
    let raster = render(&mut renderer, &field, "u", Method::Gather);
    check("a million patches", &field, "u", Method::Gather, &raster);
}

#[test]
fn what_does_not_fit_is_refused() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = uniform(4).dataset();
    let field = good(Field::new(&dataset, 0));
    // a row of a texture of data holds 128 KiB
    renderer.limit_rows(1);
    let error = renderer.upload(&field).map(|_| ()).expect_err("4096 patches in 128 KiB");
    let GpuError::TooLarge { needed, most, .. } = &error else { panic!("{error}") };
    assert!(*most == 1 << 17 && needed > most, "{needed} {most}");
    let message = error.to_string();
    assert!(message.contains(&needed.to_string()), "{message}");
    let small = uniform(1).dataset();
    let small = good(Field::new(&small, 0));
    let raster = render(&mut renderer, &small, "u", Method::Gather);
    check("a field that fits", &small, "u", Method::Gather, &raster);
}
