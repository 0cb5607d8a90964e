//! Evaluation of a dataset for a page: values of rows, images, values at points.

mod describe;
pub mod paint;
mod probe;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum_render::range::ColorRange;
use ppum_render::scatter::{BAND, render_rows};
use ppum_scene::colors::ColorOptions;
use ppum_scene::mirror::Mirror;
use ppum_scene::probe::PointReader;
use ppum_scene::scene::SceneRequest;
use ppum_scene::shot::QuantityRequest;

use crate::error::PageError;
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
    asked: QuantityRequest,
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
    fn new(dataset: &'d Dataset, scene: &SceneRequest) -> Result<Self, PageError> {
        let step = scene.subject.step_of(dataset);
        let field = Field::new(dataset, step)?;
        let asked = QuantityRequest::new(scene, &field).map_err(PageError::shot)?;
        let mirror = scene.mirror.clone();
        Ok(Self { step, text: scene.quantity.clone(), mirror, field, asked, reader: None })
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
    pub fn rows(&mut self, rows: &ImageRows) -> Result<Vec<f64>, PageError> {
        let ImageRows { frame, rows: [first, end] } = rows;
        let view = frame.view.checked().map_err(PageError::shot)?;
        if !first.is_multiple_of(BAND) || first > end || *end > view.pixels[1] {
            return Err(PageError::Rows(*first, *end, view.pixels[1]));
        }
        let subject = prepared(&mut self.subject, self.dataset, &frame.scene)?;
        let PageSubject { field, asked, .. } = subject;
        let is_whole = frame.scene.deformed.is_some() || frame.scene.mirror.is_some();
        let quantity = asked.shown.quantity().filter(|_| !is_whole);
        let Some(quantity) = quantity else { return Ok(Vec::new()) };
        render_rows(field, &view, quantity, *first..*end, unwatched()).map_err(PageError::shot)
    }
}

/// The subject of a scene: the one that is known, or a new one in its place.
fn prepared<'s, 'd>(
    known: &'s mut Option<PageSubject<'d>>,
    dataset: &'d Dataset,
    scene: &SceneRequest,
) -> Result<&'s mut PageSubject<'d>, PageError> {
    let subject = match known.take().filter(|subject| subject.is_of(dataset, scene)) {
        Some(subject) => subject,
        None => PageSubject::new(dataset, scene)?,
    };
    Ok(known.insert(subject))
}
