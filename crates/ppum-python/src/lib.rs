//! The compiled part of the Python package `ppum`: datasets, fields, problems and images as
//! Python's objects.
//!
//! People import `ppum`, whose Python is beside this crate in `python/ppum`: names, defaults,
//! shapes and documentation are there. Here is what has to be fast or is written already: every
//! call reads numbers and texts, works without Python's lock, and gives back arrays, dictionaries
//! or an exception. Nothing is computed here that the libraries do not compute. Without the feature
//! `python` the crate is empty.
#![cfg(feature = "python")]

mod building;
mod command;
mod compare;
mod dataset;
mod errors;
mod exporting;
mod facts;
mod field;
mod intensities;
mod moving;
mod owned;
mod picture;
mod plot;
mod pool;
mod probe;
mod problem;
mod values;
mod watch;
mod weights;

/// The compiled part of ppum; import `ppum` instead.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use crate::{
        building::{build, scattered},
        command::command,
        compare::{compare, resample},
        dataset::{PyDataset, from_bytes, read},
        exporting::{Triangles, check_target, page, replace, triangles, vtkhdf},
        field::PyField,
        intensities::intensities,
        moving::animation,
        picture::{
            check_request, colormap, colormaps, default_request, extrema_in, figure,
            foreign_options, frame, option_texts, render, rgba, whole,
        },
        plot::{Curves, profiles, reports},
        probe::probe,
        problem::{check, solve},
        watch::panic_for_tests,
        weights::{derivative, factor, influence, polynomials, rate, weight_functions},
    };

    /// The version of the package, that of all crates.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
