//! Animations of the steps of a series.

use ppum::progress::Watcher;
use ppum_scene::animation::{AnimationFormat, FrameSource, SeriesAnimation, Work, with_subject};
use ppum_scene::camera::ImageSettings;
use ppum_scene::engine::Engine;
use ppum_scene::error::ImageError;
use ppum_scene::request::Request;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::PyDataset;
use crate::errors::{picture, render_error};
use crate::field::PyField;
use crate::picture::made;
use crate::watch::long;

/// Some steps of a dataset, of which one at a time is read.
struct SelectedSteps<'a> {
    dataset: &'a PyDataset,
    request: Request,
    steps: Vec<usize>,
}

/// The reason why there is no animation: a step that cannot be read, or drawn.
struct StepError(PyErr);

impl From<ImageError> for StepError {
    fn from(error: ImageError) -> Self {
        Self(picture(error))
    }
}

impl FrameSource for SelectedSteps<'_> {
    type Error = StepError;

    fn count(&self) -> usize {
        self.steps.len()
    }

    fn with(&self, number: usize, work: &mut Work<'_, StepError>) -> Result<(), StepError> {
        let step = self.steps[number];
        let data = self.dataset.at(step).map_err(StepError)?;
        with_subject(&data, &self.request.at_step(step), work)
    }
}

/// The bytes of an animation of some steps, `gif` or `apng`, each shown for some milliseconds.
/// `this` is the field of one of them, changed as the others are.
#[pyfunction]
pub(crate) fn animation<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &Bound<'_, PyAny>,
    steps: Vec<usize>,
    milliseconds: u16,
    form: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
    let form = if form == "apng" { AnimationFormat::Apng } else { AnimationFormat::Gif };
    let mut request = this.request(request)?;
    request.panels.check_steps().map_err(render_error)?;
    request.scene.subject = this.changes.clone();
    let title = this.dataset().title.clone();
    let drawn = |engine: &Engine<'_>| -> Result<Vec<u8>, StepError> {
        let mut frames =
            SelectedSteps { dataset: this.series.get(), request: request.clone(), steps };
        frames.request = frames.resolved(&request)?;
        let ImageSettings { camera, design } = frames.settings(&request)?;
        let film = SeriesAnimation::new(&frames, &camera, design.as_ref(), engine)?;
        let title = |_: &_| vec![("Title".into(), title.clone())];
        let mut bytes = Vec::new();
        film.write(form, milliseconds, &title, &mut bytes)?;
        Ok(bytes)
    };
    let all = |watcher: &dyn Watcher| {
        made(&request, watcher, |engine| drawn(engine).map_err(|StepError(error)| error))
    };
    let (bytes, told) = long(py, None, progress.as_ref(), all)??;
    Ok((PyBytes::new(py, &bytes), told))
}
