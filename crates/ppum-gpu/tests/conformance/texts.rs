//! Every composed shader is valid, without a graphics device.

use std::collections::BTreeSet;

use ppum::field::Field;
use ppum_gpu::testing::texts;
use ppum_gpu::{Method, Output};
use ppum_testkit::fields::{self, Case};
use ppum_testkit::wgsl::Module;

use crate::{METHODS, good, quantity};

/// Validates the texts of a case that were not validated before.
fn validate(case: &Case, known: &mut BTreeSet<String>) {
    let field = good(Field::new(&case.dataset, 0));
    for (k, text) in case.quantities.iter().enumerate() {
        let quantity = quantity(text, &field);
        let last = field.components() as u8 - 1;
        let outputs = [Output::Values, Output::Colors, Output::Component(last)];
        let outputs = if k == 0 { &outputs[..] } else { &outputs[..1] };
        for method in METHODS {
            for &output in outputs {
                let all = good(texts(&field, &quantity, method, output));
                if method == Method::Splat {
                    assert_eq!(all.len() > 1, has_field(text));
                }
                for shader in all.into_iter().filter(|shader| known.insert(shader.clone())) {
                    let what = format!("{}: {text}, {method:?}, {output:?}", case.name);
                    Module::new(&shader).unwrap_or_else(|error| panic!("{what}: {error}"));
                }
            }
        }
    }
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
