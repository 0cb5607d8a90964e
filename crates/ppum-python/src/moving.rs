//! Moving pictures of the steps of a series.

use ppum::progress::Watcher;
use ppum_figure::figure::Design;
use ppum_render::view::View;
use ppum_scene::engine::Engine;
use ppum_scene::moving::{AnimationFormat, Film, Frames as _, InMemory, Moving, MovingError};
use ppum_scene::scene::Subject;
use ppum_scene::shot::{ShotError, reshaped};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::Dataset;
use crate::errors::{RenderError, no_field, picture, subject};
use crate::field::{Field, written};
use crate::picture::{Look, Spot, made, view};
use crate::watch::long;

fn unmoved(error: MovingError) -> PyErr {
    match error {
        MovingError::Field(error) => no_field(error),
        MovingError::Subject(error) => subject(&error),
        MovingError::Shot(error) => picture(*error),
        error => RenderError::new_err(error.to_string()),
    }
}

/// What is seen: a place or all of the plate, as a bare picture of a size or a figure of a design.
struct Sight<'a> {
    spot: Option<Spot>,
    size: [u32; 2],
    design: Option<&'a Design>,
}

impl Sight<'_> {
    /// The view of all pictures, pixel for pixel.
    fn view(&self, frames: &InMemory<'_>) -> PyResult<View> {
        let room = match self.design {
            Some(design) => frames.room(design).map_err(unmoved)?,
            None => self.size,
        };
        let made = match self.spot {
            // as flat as can be: figures show more above and below, not beside
            Some(spot) if self.design.is_some() => {
                reshaped(&view(spot, [self.size[0].max(1), 1])?, room)
            }
            Some(spot) => return view(spot, room),
            None => {
                let whole = frames.bounds().map_err(unmoved)?;
                View::hug(whole.unwrap_or(frames.dataset.domain.bounds), room)
            }
        };
        made.map_err(|error| picture(ShotError::View(error)))
    }
}

/// The bytes of a moving picture of some steps, `gif` or `apng`, each shown for some milliseconds.
/// `this` is the field of one of them, changed as the others are by `changes`; without a look the
/// pictures are bare.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
pub(crate) fn animation<'py>(
    this: &Field,
    py: Python<'py>,
    dataset: &Dataset,
    changes: &str,
    request: &str,
    steps: Vec<usize>,
    spot: Option<Spot>,
    size: [u32; 2],
    look: Option<&str>,
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
    let look = look.map(written::<Look>).transpose()?;
    let design = look.map(|look| look.design(dataset.domain.bounds)).transpose()?;
    let size = design.as_ref().map_or(size, |design| design.size);
    let mut request = this.request(request)?;
    request.scene.subject = written::<Subject>(changes)?;
    let (moving, sight) = (Moving::Steps(steps), Sight { spot, size, design: design.as_ref() });
    let drawn = |engine: &Engine<'_>| {
        let frames = InMemory::new(dataset, &request, &moving).map_err(unmoved)?;
        let view = sight.view(&frames)?;
        let film = Film::new(&frames, &view, sight.design, engine).map_err(unmoved)?;
        let title = |_: &_| vec![("Title".into(), dataset.title.clone())];
        let mut bytes = Vec::new();
        film.write(form, milliseconds, &title, &mut bytes).map_err(unmoved)?;
        Ok(bytes)
    };
    let all = |watcher: &dyn Watcher| made(&request, watcher, drawn);
    let (bytes, told) = long(py, None, progress.as_ref(), all)??;
    Ok((PyBytes::new(py, &bytes), told))
}
