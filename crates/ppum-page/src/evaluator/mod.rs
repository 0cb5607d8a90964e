//! Evaluation of a dataset for a page: values of rows, images, values at points.

mod describe;
pub mod paint;
mod probe;

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum_render::range::ColorRange;
use ppum_render::scatter::{BAND, render_rows};
use ppum_scene::colors::ColorOptions;
use ppum_scene::error::{ImageError, ImageErrorKind};
use ppum_scene::mirror::Mirror;
use ppum_scene::probe::PointReader;
use ppum_scene::quantity::DisplayedQuantity;
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;

use crate::messages::ImageRows;

/// Evaluates a dataset. The last request is kept ready: the field of the step, the quantity with
/// its gradient, the range of the colours.
pub struct Evaluator<'d> {
    dataset: &'d Dataset,
    subject: Option<PageSubject<'d>>,
    last: Option<KnownRange>,
}

/// A quantity of a step, ready to be evaluated.
struct PageSubject<'d> {
    step: usize,
    text: Option<String>,
    mirror: Option<Mirror>,
    field: Field<'d>,
    shown: Arc<DisplayedQuantity>,
    name: String,
    /// Made at the first question for values at a point.
    reader: Option<PointReader>,
}

/// The range of an image, and what it was found for.
struct KnownRange {
    step: usize,
    text: Option<String>,
    colors: ColorOptions,
    span: ColorRange,
}

impl<'d> PageSubject<'d> {
    fn new(dataset: &'d Dataset, scene: &SceneRequest) -> Result<Self, ImageError> {
        let step = scene.subject.step_of(dataset);
        let field = Field::new(dataset, step)?;
        let (text, mirror) = (scene.quantity.clone(), scene.mirror.clone());
        let subject = ImageSubject::new(dataset, &field, text.as_deref());
        let ImageSubject { shown, name, .. } = subject?;
        Ok(Self { step, text, mirror, field, shown, name, reader: None })
    }

    fn image_subject<'s>(&'s self, dataset: &'s Dataset) -> ImageSubject<'s> {
        let (shown, name) = (Arc::clone(&self.shown), self.name.clone());
        ImageSubject { dataset, field: &self.field, shown, name, left: None }
    }

    fn is_of(&self, dataset: &Dataset, scene: &SceneRequest) -> bool {
        self.step == scene.subject.step_of(dataset)
            && (&self.text, &self.mirror) == (&scene.quantity, &scene.mirror)
    }
}

impl<'d> Evaluator<'d> {
    /// An evaluator of a dataset, which was checked when it was read.
    #[must_use]
    pub fn new(dataset: &'d Dataset) -> Self {
        Self { dataset, subject: None, last: None }
    }

    /// Values of some rows, from the top, with the bits that they have in the whole image; none of
    /// values of cells and of a deformed or mirrored body, which [`paint`](Self::paint) finds.
    ///
    /// # Errors
    /// A quantity that the dataset does not have; rows that are not in the image.
    pub fn rows(&mut self, rows: &ImageRows) -> Result<Vec<f64>, ImageError> {
        let ImageRows { frame, rows: [first, end] } = rows;
        let view = frame.view.checked()?;
        if !first.is_multiple_of(BAND) || first > end || *end > view.pixels[1] {
            return Err(ImageErrorKind::Rows(*first, *end, view.pixels[1]).into());
        }
        let subject = prepared(&mut self.subject, self.dataset, &frame.scene)?;
        let PageSubject { field, shown, .. } = subject;
        let is_whole = frame.scene.deformed.is_some() || frame.scene.mirror.is_some();
        let quantity = shown.quantity().filter(|_| !is_whole);
        let Some(quantity) = quantity else { return Ok(Vec::new()) };
        Ok(render_rows(field, &view, quantity, *first..*end, unwatched())?)
    }
}

/// The subject of a scene: the one that is known, or a new one in its place.
fn prepared<'s, 'd>(
    known: &'s mut Option<PageSubject<'d>>,
    dataset: &'d Dataset,
    scene: &SceneRequest,
) -> Result<&'s mut PageSubject<'d>, ImageError> {
    let subject = match known.take().filter(|subject| subject.is_of(dataset, scene)) {
        Some(subject) => subject,
        None => PageSubject::new(dataset, scene)?,
    };
    Ok(known.insert(subject))
}
