//! Moving pictures of the steps of a series.

use ppum::progress::Watcher;
use ppum_scene::engine::Engine;
use ppum_scene::moving::{AnimationFormat, Film, Frames, MovingError, Work, with_subject};
use ppum_scene::request::Request;
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

/// Some steps of a dataset, of which one at a time is read.
struct Reel<'a> {
    dataset: &'a Dataset,
    request: Request,
    steps: Vec<usize>,
}

/// The reason why there is no animation: a step that cannot be read, or drawn.
enum Unmoved {
    Read(PyErr),
    Drawn(MovingError),
}

impl<E: Into<MovingError>> From<E> for Unmoved {
    fn from(error: E) -> Self {
        Self::Drawn(error.into())
    }
}

impl From<Unmoved> for PyErr {
    fn from(error: Unmoved) -> Self {
        match error {
            Unmoved::Read(error) => error,
            Unmoved::Drawn(MovingError::Field(error)) => no_field(error),
            Unmoved::Drawn(MovingError::Subject(error)) => subject(&error),
            Unmoved::Drawn(MovingError::Shot(error)) => picture(*error),
            Unmoved::Drawn(error) => RenderError::new_err(error.to_string()),
        }
    }
}

impl Frames for Reel<'_> {
    type Error = Unmoved;

    fn count(&self) -> usize {
        self.steps.len()
    }

    fn with(&self, number: usize, work: &mut Work<'_, Unmoved>) -> Result<(), Unmoved> {
        let step = self.steps[number];
        let data = self.dataset.at(step).map_err(Unmoved::Read)?;
        with_subject(&data, &self.request.at_step(step), work)
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
    let mut request = this.request(request)?;
    request.panels.check_steps().map_err(|error| RenderError::new_err(error.to_string()))?;
    request.scene.subject = written::<Subject>(changes)?;
    let title = this.owned.dataset().title.clone();
    #[expect(clippy::result_large_err, reason = "one for a whole film")]
    let drawn = |engine: &Engine<'_>| -> Result<Vec<u8>, Unmoved> {
        let mut frames = Reel { dataset, request: request.clone(), steps };
        frames.request = frames.settled(&request)?;
        let Common { placing, design } = Common::new(&frames, &request)?;
        let film = Film::new(&frames, &placing, design.as_ref(), engine)?;
        let title = |_: &_| vec![("Title".into(), title.clone())];
        let mut bytes = Vec::new();
        film.write(form, milliseconds, &title, &mut bytes)?;
        Ok(bytes)
    };
    let all = |watcher: &dyn Watcher| {
        made(&request, watcher, |engine| drawn(engine).map_err(PyErr::from))
    };
    let (bytes, told) = long(py, None, progress.as_ref(), all)??;
    Ok((PyBytes::new(py, &bytes), told))
}
