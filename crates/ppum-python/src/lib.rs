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
mod compare;
mod dataset;
mod errors;
mod exporting;
mod facts;
mod field;
mod intensities;
mod material;
mod moving;
mod owned;
mod picture;
mod plot;
mod pool;
mod problem;
mod values;
mod watch;

/// The compiled part of ppum; import `ppum` instead.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use crate::building::{build, scattered};
    #[pymodule_export]
    use crate::compare::{compare, resample};
    #[pymodule_export]
    use crate::dataset::{PyDataset, from_bytes, read};
    #[pymodule_export]
    use crate::exporting::{Triangles, page, triangles, vtkhdf};
    #[pymodule_export]
    use crate::field::PyField;
    #[pymodule_export]
    use crate::intensities::intensities;
    #[pymodule_export]
    use crate::material::material;
    #[pymodule_export]
    use crate::moving::animation;
    #[pymodule_export]
    use crate::picture::{
        check_request, colormap, colormaps, default_request, extrema_in, figure, frame,
        option_texts, render, rgba,
    };
    #[pymodule_export]
    use crate::plot::{Curves, profiles, told};
    #[pymodule_export]
    use crate::problem::{check, solve};
    #[pymodule_export]
    use crate::watch::panic_for_tests;

    /// The version of the package, that of all crates.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
