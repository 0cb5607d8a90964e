//! Animations of the steps of a series.

use ppum::progress::Watcher;
use ppum_scene::engine::Engine;
use ppum_scene::image_job::ImageSettings;
use ppum_scene::moving::{
    AnimationFormat, FrameSource, MovingError, SeriesAnimation, Work, with_subject,
};
use ppum_scene::request::Request;
use ppum_scene::scene::Subject;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::PyDataset;
use crate::errors::{RenderError, no_field, picture, subject};
use crate::field::{PyField, written};
use crate::picture::made;
use crate::watch::long;

/// Some steps of a dataset, of which one at a time is read.
struct SelectedSteps<'a> {
    dataset: &'a PyDataset,
    request: Request,
    steps: Vec<usize>,
}

/// The reason why there is no animation: a step that cannot be read, or drawn.
enum StepError {
    Read(PyErr),
    Drawn(MovingError),
}

impl<E: Into<MovingError>> From<E> for StepError {
    fn from(error: E) -> Self {
        Self::Drawn(error.into())
    }
}

impl From<StepError> for PyErr {
    fn from(error: StepError) -> Self {
        match error {
            StepError::Read(error) => error,
            StepError::Drawn(MovingError::Field(error)) => no_field(error),
            StepError::Drawn(MovingError::Subject(error)) => subject(&error),
            StepError::Drawn(MovingError::Shot(error)) => picture(*error),
            StepError::Drawn(error) => RenderError::new_err(error.to_string()),
        }
    }
}

impl FrameSource for SelectedSteps<'_> {
    type Error = StepError;

    fn count(&self) -> usize {
        self.steps.len()
    }

    fn with(&self, number: usize, work: &mut Work<'_, StepError>) -> Result<(), StepError> {
        let step = self.steps[number];
        let data = self.dataset.at(step).map_err(StepError::Read)?;
        with_subject(&data, &self.request.at_step(step), work)
    }
}

/// The bytes of an animation of some steps, `gif` or `apng`, each shown for some milliseconds.
/// `this` is the field of one of them, changed as the others are by `changes`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
pub(crate) fn animation<'py>(
    this: &PyField,
    py: Python<'py>,
    dataset: &PyDataset,
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
    let drawn = |engine: &Engine<'_>| -> Result<Vec<u8>, StepError> {
        let mut frames = SelectedSteps { dataset, request: request.clone(), steps };
        frames.request = frames.settled(&request)?;
        let ImageSettings { placing, design } = ImageSettings::new(&frames, &request)?;
        let film = SeriesAnimation::new(&frames, &placing, design.as_ref(), engine)?;
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
