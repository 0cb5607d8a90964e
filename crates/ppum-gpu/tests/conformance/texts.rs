//! Every composed shader is valid, without a graphics device.

use std::collections::BTreeSet;

use ppum::field::Field;
use ppum_gpu::testing::texts;
use ppum_gpu::{Colors, Method, TransferFunction, Values};
use ppum_render::picture::Style;
use ppum_render::range::RangeChoice;
use ppum_render::raster::Raster;
use ppum_testkit::fields::{self, DrawingCase};
use ppum_testkit::wgsl::Module;

use crate::{METHODS, good, quantity};

/// Validates the texts of a case that were not validated before.
fn validate(case: &DrawingCase, known: &mut BTreeSet<String>) {
    let field = good(Field::new(&case.dataset, 0));
    for (k, text) in case.quantities.iter().enumerate() {
        let quantity = quantity(text, &field);
        for method in METHODS {
            let mut all = good(texts(&field, &Values(quantity.clone()), method));
            if method == Method::Splat {
                assert_eq!(all.len() > 1, has_field(text));
            }
            if k == 0 {
                let colors = Colors { quantity: quantity.clone(), shading: shading() };
                all.extend(good(texts(&field, &colors, method)));
            }
            for shader in all.into_iter().filter(|shader| known.insert(shader.clone())) {
                let what = format!("{}: {text}, {method:?}", case.name);
                Module::new(&shader).unwrap_or_else(|error| panic!("{what}: {error}"));
            }
        }
    }
}

/// Some colours.
fn shading() -> TransferFunction {
    let Style { colormap, scale, undefined, .. } = Style::default();
    let nothing = Raster::<f32>::new([0, 0], Vec::new());
    let normalization =
        good(RangeChoice::Fixed(0.0, 1.0).span(scale, false, &nothing, None).normalization(scale));
    TransferFunction { normalization, colormap, undefined }
}

/// False for quantities of the partition alone, which need no field to be splatted.
fn has_field(quantity: &str) -> bool {
    !["overlap", "weight-sum"].contains(&quantity) && !quantity.starts_with("phi:")
}

#[test]
fn all_shaders_are_valid() {
    let groups = [fields::coverings(), fields::functions(), fields::equations(), fields::wholes()];
    let mut known = BTreeSet::new();
    for case in groups.iter().flatten() {
        validate(case, &mut known);
    }
    println!("{} shaders are valid", known.len());
    assert!(known.len() > 100);
}
