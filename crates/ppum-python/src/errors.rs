//! The exceptions, which are classes of `ppum` so that they can be pickled, and what becomes them.

use std::convert::Infallible;
use std::fmt::Display;
use std::io;
use std::path::Path;

use ppum::field::FieldError;
use ppum::progress::Cancelled;
use ppum_format::{ReadError, WriteError};
use ppum_fracture::growth::GrowthError;
use ppum_fracture::solve::SolveError as Unsolved;
use ppum_problem::{Diagnostic, ProblemError as Mistakes, ProblemLocation};
use ppum_scene::error::{ImageError, ImageErrorKind};
use ppum_scene::profile::ProfileError;
use ppum_scene::region::PlaceError;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt, PyOSError};
use pyo3::import_exception;
use pyo3::prelude::*;

import_exception!(ppum, BuildError);
import_exception!(ppum, FormatError);
import_exception!(ppum, InternalError);
import_exception!(ppum, ProblemError);
import_exception!(ppum, QuantityError);
import_exception!(ppum, RenderError);
import_exception!(ppum, SolveError);

/// The number of the system's error for a file that is not there, the same on all systems.
const NO_ENTRY: i32 = 2;

/// `FileNotFoundError` and its like, with the file's name.
fn file(path: &Path, error: &io::Error, message: String) -> PyErr {
    let missing = (error.kind() == io::ErrorKind::NotFound).then_some(NO_ENTRY);
    let Some(number) = error.raw_os_error().or(missing) else {
        return io::Error::new(error.kind(), message).into();
    };
    // the words of the system, without the number that Rust adds and Python adds again
    let words = error.to_string();
    let words = words.split(" (os error").next().unwrap_or(&words).to_owned();
    PyOSError::new_err((number, words, path.display().to_string()))
}

/// A dataset that cannot be read; `of` is where it comes from.
pub(crate) fn unreadable(of: &str, error: ReadError) -> PyErr {
    match error {
        ReadError::Io { ref path, ref source } => file(path, source, error.to_string()),
        error => FormatError::new_err(format!("{of}: {error}")),
    }
}

/// Arrays that make no dataset: one line for each error.
pub(crate) fn unbuilt(errors: &[ReadError]) -> PyErr {
    let line = |error: &ReadError| match error {
        ReadError::Invalid(error) => error.to_string(),
        error => error.to_string(),
    };
    BuildError::new_err(errors.iter().map(line).collect::<Vec<_>>().join("\n"))
}

/// A dataset that cannot be written.
pub(crate) fn unwritable(error: WriteError) -> PyErr {
    match error {
        WriteError::Io { ref path, ref source } => file(path, source, error.to_string()),
        error => FormatError::new_err(error.to_string()),
    }
}

/// One error of a problem: file or key, line and column where they are known, what is wrong.
pub(crate) type ProblemFinding = (String, Option<usize>, Option<usize>, String);

fn finding(mistake: &Diagnostic) -> ProblemFinding {
    let (place, line, column) = match &mistake.location {
        ProblemLocation::File(place) | ProblemLocation::Key(place) => (place, None, None),
        ProblemLocation::Text { file, line, column } => (file, Some(*line), Some(*column)),
    };
    (place.clone(), line, column, mistake.message.clone())
}

pub(crate) fn findings(mistakes: &Mistakes) -> Vec<ProblemFinding> {
    mistakes.mistakes().iter().map(finding).collect()
}

/// A problem that cannot be read, with its findings.
pub(crate) fn problem(mistakes: &Mistakes) -> PyErr {
    ProblemError::new_err((mistakes.to_string(), findings(mistakes)))
}

/// Work that was stopped: by nobody but Python, which raises its own exception then.
pub(crate) fn cancelled(error: Cancelled) -> PyErr {
    PyKeyboardInterrupt::new_err(error.to_string())
}

/// A problem that cannot be solved.
pub(crate) fn unsolved(error: Unsolved) -> PyErr {
    match error {
        Unsolved::Cancelled(error) => cancelled(error),
        Unsolved::Problem(mistakes) => problem(&mistakes),
        error => SolveError::new_err(error.to_string()),
    }
}

/// A series that ends before its end.
pub(crate) fn ungrown(error: GrowthError<Infallible>) -> PyErr {
    match error {
        GrowthError::Solve(error) => unsolved(error),
        error => SolveError::new_err(error.to_string()),
    }
}

/// A field that is not there, or that cannot be compiled.
pub(crate) fn no_field(error: FieldError) -> PyErr {
    match error {
        FieldError::Step { .. } => PyIndexError::new_err(error.to_string()),
        error => FormatError::new_err(error.to_string()),
    }
}

/// Converts the error of a text that is no quantity of a field, or no change that can be made in
/// it.
pub(crate) fn quantity(error: impl Display) -> PyErr {
    QuantityError::new_err(error.to_string())
}

/// Converts an error of an image that needs no other class.
pub(crate) fn render_error(error: impl Display) -> PyErr {
    RenderError::new_err(error.to_string())
}

/// An image that cannot be drawn.
pub(crate) fn picture(error: ImageError) -> PyErr {
    match *error.0 {
        ImageErrorKind::Render(error) => rendering(error),
        ImageErrorKind::Field(error) => no_field(error),
        ImageErrorKind::Subject(error) => quantity(error),
        ImageErrorKind::Shown(error) => quantity(error),
        ImageErrorKind::Place(error @ PlaceError::Tip { .. }) => {
            PyIndexError::new_err(error.to_string())
        }
        error => render_error(error),
    }
}

pub(crate) fn rendering(error: ppum_render::RasterError) -> PyErr {
    match error {
        ppum_render::RasterError::Cancelled(error) => cancelled(error),
        ppum_render::RasterError::Quantity(error) => quantity(error),
        error => render_error(error),
    }
}

/// A curve that there are no values along.
pub(crate) fn no_profile(error: ProfileError) -> PyErr {
    match error {
        ProfileError::Cancelled(error) => cancelled(error),
        ProfileError::Crack { .. } | ProfileError::Tip { .. } => {
            PyIndexError::new_err(error.to_string())
        }
        error => quantity(error),
    }
}
