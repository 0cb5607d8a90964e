//! The command `ppum`, which comes with the package.

use std::ffi::OsString;

use ppum_cli::graphics::Graphics;
use pyo3::prelude::*;

/// Runs the program without graphics cards and window; its exit status.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| ppum_cli::run(arguments, Graphics::default()))
}
