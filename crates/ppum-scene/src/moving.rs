//! Pictures in motion: the steps of a series, or the deformed plate with a factor that grows and falls. All have one range.

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use ppum::progress::Watcher;
use ppum_figure::figure::Design;
use ppum_render::image::Image;
use ppum_render::range::{Range, Span};
use ppum_render::view::View;

use crate::deformed::Factor;
use crate::scene::{Scene, SubjectError};
use crate::shot::{ShotError, page, reshaped, shot};

/// What moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Moving {
    /// The pictures are these steps.
    Steps(Vec<usize>),
    /// The plate deforms up to so many times its displacement and back, in so many pictures.
    Factor(f64, usize),
}

/// The reason why there are no such pictures.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MovingError {
    /// A step that is not there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A part or a replacement.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// A picture.
    #[error(transparent)]
    Shot(Box<ShotError>),
}

impl From<ShotError> for MovingError {
    fn from(error: ShotError) -> Self {
        Self::Shot(Box::new(error))
    }
}

/// Columns of the pictures that the range is found from; extrema between pixels are found besides.
const COLUMNS: u32 = 320;

impl Moving {
    /// The number of pictures.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Steps(steps) => steps.len(),
            Self::Factor(_, count) => *count,
        }
    }

    /// The scene of a picture.
    fn scene(&self, scene: &Scene, number: usize) -> Scene {
        let mut scene = scene.clone();
        match self {
            Self::Steps(steps) => scene.subject.step = Some(steps[number]),
            Self::Factor(largest, count) => {
                let part = number as f64 / *count as f64;
                let share = 0.5 - 0.5 * (std::f64::consts::TAU * part).cos();
                scene.deformed = Some(Factor::Given(largest * share));
            }
        }
        scene
    }

    /// Draws the pictures, one after the other, and gives each to `take`.
    ///
    /// # Errors
    /// As those of one picture; a watcher that stops it.
    pub fn draw(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        view: &View,
        design: Option<&Design>,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Image),
    ) -> Result<(), MovingError> {
        let mut scene = scene.clone();
        if scene.colors.range.is_found() {
            scene.colors.range = self.range(dataset, &scene, view, watcher)?;
        }
        self.each(dataset, &scene, |dataset, field, scene| {
            let (page, _) = page(dataset, (field, None), scene, view, design, watcher)?;
            take(page.image());
            Ok(())
        })
    }

    /// One range for all pictures; that of the scene where nothing has a value.
    fn range(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        view: &View,
        watcher: &dyn Watcher,
    ) -> Result<Range, MovingError> {
        let [columns, rows] = view.pixels.map(f64::from);
        let down = ((rows / columns * f64::from(COLUMNS)).round() as u32).clamp(1, 4 * COLUMNS);
        let small = reshaped(view, [COLUMNS, down]).map_err(ShotError::from)?;
        let mut spans = Vec::new();
        let mut is_symmetric = false;
        self.each(dataset, scene, |dataset, field, scene| {
            let shot = shot(dataset, (field, None), scene, &small, false, watcher)?;
            is_symmetric |= shot.picture.colormap.diverging;
            // a step that has one value everywhere, as before any load, says nothing of the range
            let has_range = shot.picture.has_values && shot.picture.one_value.is_none();
            spans.extend(has_range.then_some(shot.picture.span));
            Ok(())
        })?;
        let shared = Span::shared(&spans, is_symmetric);
        Ok(shared.map_or(scene.colors.range, |span| Range::Fixed(span.min, span.max)))
    }

    /// Does something for each picture, with its field.
    fn each(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        mut work: impl FnMut(&Dataset, &Field<'_>, &Scene) -> Result<(), ShotError>,
    ) -> Result<(), MovingError> {
        for number in 0..self.count() {
            let scene = self.scene(scene, number);
            let mut changed = None;
            let dataset = match scene.subject.is_whole() {
                true => dataset,
                false => {
                    let changed = changed.insert(dataset.clone());
                    scene.subject.apply(changed)?;
                    changed
                }
            };
            let field = Field::new(dataset, scene.subject.step_of(dataset))?;
            work(dataset, &field, &scene)?;
        }
        Ok(())
    }
}
