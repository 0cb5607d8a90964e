//! Moving pictures of the steps of a series.

use ppum::progress::Watcher;
use ppum_scene::engine::Engine;
use ppum_scene::moving::{AnimationFormat, Film, InMemory, Moving, MovingError};
use ppum_scene::scene::Subject;
use ppum_scene::still::Common;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::Dataset;
use crate::errors::{RenderError, no_field, picture, subject};
use crate::field::{Field, written};
use crate::picture::made;
use crate::watch::long;

fn unmoved(error: MovingError) -> PyErr {
    match error {
        MovingError::Field(error) => no_field(error),
        MovingError::Subject(error) => subject(&error),
        MovingError::Shot(error) => picture(*error),
        error => RenderError::new_err(error.to_string()),
    }
}

/// The bytes of a moving picture of some steps, `gif` or `apng`, each shown for some milliseconds.
/// `this` is the field of one of them, changed as the others are by `changes`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
pub(crate) fn animation<'py>(
    this: &Field,
    py: Python<'py>,
    dataset: &Dataset,
    changes: &str,
    request: &str,
    steps: Vec<usize>,
    milliseconds: u16,
    form: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
    let form = match form {
        "gif" => AnimationFormat::Gif,
        "apng" => AnimationFormat::Apng,
        other => {
            let known = "moving pictures are gif or apng";
            return Err(PyValueError::new_err(format!("`{other}` is no form: {known}")));
        }
    };
    let dataset = &*dataset.0;
    let mut request = this.request(request)?;
    request.panels.check_steps().map_err(|error| RenderError::new_err(error.to_string()))?;
    request.scene.subject = written::<Subject>(changes)?;
    let moving = Moving::Steps(steps);
    let drawn = |engine: &Engine<'_>| {
        let frames = InMemory::new(dataset, &request, &moving).map_err(unmoved)?;
        let Common { placing, design } = Common::new(&frames, &request).map_err(unmoved)?;
        let film = Film::new(&frames, &placing, design.as_ref(), engine).map_err(unmoved)?;
        let title = |_: &_| vec![("Title".into(), dataset.title.clone())];
        let mut bytes = Vec::new();
        film.write(form, milliseconds, &title, &mut bytes).map_err(unmoved)?;
        Ok(bytes)
    };
    let all = |watcher: &dyn Watcher| made(&request, watcher, drawn);
    let (bytes, told) = long(py, None, progress.as_ref(), all)??;
    Ok((PyBytes::new(py, &bytes), told))
}
