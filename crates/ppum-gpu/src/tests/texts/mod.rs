//! Generated texts: valid beside what they stand with, and equal to their twins in Rust.

mod functions;
mod quantity;
mod weight;

use ppum::formula::wgsl_prelude;
use ppum_testkit::wgsl::Module;

/// A valid module of texts.
#[track_caller]
fn module(texts: &[&str]) -> Module {
    let source = wgsl_prelude().to_owned() + &texts.concat();
    Module::new(&source).unwrap_or_else(|error| panic!("{error}\n{}", texts.concat()))
}

/// The results of a function of a module, in double precision.
#[track_caller]
fn call(module: &Module, function: &str, arguments: &[f32]) -> Vec<f64> {
    let found = module.call(function, arguments).unwrap_or_else(|error| panic!("{error}"));
    found.into_iter().map(f64::from).collect()
}
