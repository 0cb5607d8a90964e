//! Large data.

use ppum::field::Field;
use ppum_gpu::Method;
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
