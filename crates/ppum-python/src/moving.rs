//! Moving pictures of the steps of a series.

use ppum::progress::Watcher;
use ppum_figure::figure::Design;
use ppum_render::animation::{AnimationError, apng, gif};
use ppum_render::view::View;
use ppum_scene::moving::{Moving, MovingError};
use ppum_scene::scene::{Scene, Subject};
use ppum_scene::shot::{ShotError, reshaped};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::Dataset;
use crate::errors::{RenderError, no_field, picture, subject};
use crate::field::{Field, written};
use crate::picture::{Look, Spot, view};
use crate::watch::long;

/// Most pixels of all pictures together: they are kept until the colours of a GIF are counted, in 1 GiB.
const MOST: u64 = 1 << 28;

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
    fn view(
        &self,
        moving: &Moving,
        dataset: &ppum::dataset::Dataset,
        scene: &Scene,
    ) -> PyResult<View> {
        let room = match self.design {
            Some(design) => moving.room(dataset, scene, design).map_err(unmoved)?,
            None => self.size,
        };
        let made = match self.spot {
            // as flat as can be: figures show more above and below, not beside
            Some(spot) if self.design.is_some() => {
                reshaped(&view(spot, [self.size[0].max(1), 1])?, room)
            }
            Some(spot) => return view(spot, room),
            None => View::hug(moving.bounds(dataset, scene).map_err(unmoved)?, room),
        };
        made.map_err(|error| picture(ShotError::View(error)))
    }
}

/// The bytes of a moving picture of some steps, `gif` or `apng`, each shown for some milliseconds. `this` is the field of one of them,
/// changed as the others are by `changes`; without a look the pictures are bare.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
pub(crate) fn animation<'py>(
    this: &Field,
    py: Python<'py>,
    dataset: &Dataset,
    changes: &str,
    scene: &str,
    steps: Vec<usize>,
    spot: Option<Spot>,
    size: [u32; 2],
    look: Option<&str>,
    milliseconds: u16,
    form: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let is_gif = match form {
        "gif" => true,
        "apng" => false,
        other => {
            let known = "moving pictures are gif or apng";
            return Err(PyValueError::new_err(format!("`{other}` is no form: {known}")));
        }
    };
    let dataset = &*dataset.0;
    let look = look.map(written::<Look>).transpose()?;
    let design = look.map(|look| look.design(dataset.domain.bounds)).transpose()?;
    let size = design.as_ref().map_or(size, |design| design.size);
    let pixels = u64::from(size[0]) * u64::from(size[1]) * steps.len() as u64;
    if pixels > MOST {
        return Err(RenderError::new_err(format!(
            "{} pictures of {}x{} pixels do not fit into memory; choose a smaller size or fewer steps",
            steps.len(),
            size[0],
            size[1]
        )));
    }
    let scene = Scene { subject: written::<Subject>(changes)?, ..this.scene(scene)? };
    let (moving, sight) = (Moving::Steps(steps), Sight { spot, size, design: design.as_ref() });
    let drawn = |watcher: &dyn Watcher| -> PyResult<Vec<u8>> {
        let scene = moving.settled(dataset, &scene).map_err(unmoved)?;
        let view = sight.view(&moving, dataset, &scene)?;
        let mut images = Vec::new();
        let take = &mut |image| images.push(image);
        moving.draw_in(dataset, &scene, &view, sight.design, watcher, take).map_err(unmoved)?;
        let bytes = match is_gif {
            true => gif(&images, milliseconds),
            false => apng(&images, milliseconds, &[("Title".into(), dataset.title.clone())]),
        };
        bytes.map_err(|error: AnimationError| RenderError::new_err(error.to_string()))
    };
    Ok(PyBytes::new(py, &long(py, None, progress.as_ref(), drawn)??))
}
