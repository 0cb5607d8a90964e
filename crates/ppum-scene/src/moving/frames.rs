//! Fields one after the other, and where they are seen.

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use ppum::vec2::Rect;
use ppum_figure::figure::{FigureStyle, plot_area};
use ppum_render::animation::AnimationError;
use ppum_render::deform::AutomaticFactor;
use ppum_render::view::View;

use crate::body::BodyView;
use crate::deformed::Magnification;
use crate::engine::Engine;
use crate::request::Request;
use crate::scene::SubjectError;
use crate::shot::{FieldSource, ImageError, title};

/// The motion in an animation.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionKind {
    /// The frames are these steps.
    Steps(Vec<usize>),
    /// The body deforms up to so many times its displacement and back, in so many frames.
    Factor(f64, usize),
}

/// The reason why there are no such images.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MovingError {
    /// A step that is not there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A part or a replacement.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// An image.
    #[error(transparent)]
    Shot(Box<ImageError>),
    /// The file.
    #[error(transparent)]
    Animation(#[from] AnimationError),
}

impl From<ImageError> for MovingError {
    fn from(error: ImageError) -> Self {
        Self::Shot(Box::new(error))
    }
}

/// Works on a frame: a field, and what is shown of it.
pub type Work<'a, E> = dyn FnMut(FieldSource<'_>, &Request) -> Result<(), E> + 'a;

/// The frames of an animation, or the one of a still image.
pub trait FrameSource {
    /// The reason why there is no such frame.
    type Error: From<ImageError>;

    /// The number of frames.
    fn count(&self) -> usize;

    /// Works on the frame of a number; fields may be read for it, and forgotten after it.
    ///
    /// # Errors
    /// A frame that there is not; those of the work.
    fn with(&self, number: usize, work: &mut Work<'_, Self::Error>) -> Result<(), Self::Error>;

    /// Works on all frames in their order.
    ///
    /// # Errors
    /// As [`Self::with`].
    fn each(&self, work: &mut Work<'_, Self::Error>) -> Result<(), Self::Error> {
        (0..self.count()).try_for_each(|number| self.with(number, work))
    }

    /// The factor of the deformed body as a number, the same for all frames that do not have
    /// theirs.
    ///
    /// # Errors
    /// Fields that are no displacements.
    fn factor(&self, factor: Magnification) -> Result<f64, Self::Error> {
        if let Magnification::Given(factor) = factor {
            return Ok(factor);
        }
        let mut found = AutomaticFactor::default();
        self.each(&mut |FieldSource { field, .. }, _| {
            Ok(found.add(field, &field.domain.bounds).map_err(ImageError::from)?)
        })?;
        Ok(found.factor())
    }

    /// The request of them, with the factor of the deformed body as a number and with the edges
    /// at which a body is mirrored.
    ///
    /// # Errors
    /// As [`Self::factor`] and [`FieldSource::lines`].
    fn settled(&self, request: &Request) -> Result<Request, Self::Error> {
        let mut request = request.clone();
        if request.scene.mirror.is_some() && self.count() > 0 {
            self.with(0, &mut |source, _| {
                request.scene = source.settled(request.scene.clone()).map_err(ImageError::from)?;
                Ok(())
            })?;
        }
        if let Some(factor) = request.scene.deformed {
            request.scene.deformed = Some(Magnification::Given(self.factor(factor)?));
        }
        Ok(request)
    }

    /// The box that shows the body in all frames.
    ///
    /// # Errors
    /// A field that is no displacement, or a factor that is too large.
    fn bounds(&self) -> Result<Option<Rect>, Self::Error> {
        let mut all: Option<Rect> = None;
        self.each(&mut |source, Request { scene, .. }| {
            let bounds = source.seen_bounds(scene)?;
            all = Some(all.map_or(bounds, |all| all.union(&bounds)));
            Ok(())
        })?;
        Ok(all)
    }

    /// Columns and rows that a design has room for under all titles; all of its size without one
    /// of figures.
    ///
    /// # Errors
    /// A design without room.
    fn room(&self, design: &FigureStyle) -> Result<[u32; 2], Self::Error> {
        let mut room = design.size;
        self.each(&mut |source, request| {
            let title = title(source, request).map_err(ImageError::from)?;
            let [columns, rows] = plot_area(&title, design).map_err(ImageError::from)?;
            room = [room[0].min(columns), room[1].min(rows)];
            Ok(())
        })?;
        Ok(room)
    }
}

/// Chooses the view of each frame.
pub trait FrameView<E> {
    /// Returns the visible part of a frame.
    ///
    /// # Errors
    /// A place that the frame does not have.
    fn seen<'f>(
        &self,
        source: FieldSource<'f>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'f>, E>;
}

impl<E: From<ImageError>> FrameView<E> for View {
    fn seen<'f>(
        &self,
        source: FieldSource<'f>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'f>, E> {
        Ok(source.seen(&request.scene, self, engine)?)
    }
}

/// Frames of a dataset that is in memory.
pub struct InMemory<'a> {
    /// The dataset.
    pub dataset: &'a Dataset,
    /// The request.
    pub request: Request,
    /// The motion in an animation.
    pub moving: &'a MotionKind,
}

impl<'a> InMemory<'a> {
    /// The frames, deformed by one factor if they are.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn new(
        dataset: &'a Dataset,
        request: &Request,
        moving: &'a MotionKind,
    ) -> Result<Self, MovingError> {
        let mut all = Self { dataset, request: request.clone(), moving };
        all.request = all.settled(request)?;
        Ok(all)
    }

    /// Returns the request of a frame.
    fn of(&self, number: usize) -> Request {
        let mut request = self.request.clone();
        match self.moving {
            MotionKind::Steps(steps) => request = request.at_step(steps[number]),
            MotionKind::Factor(largest, count) => {
                let part = number as f64 / *count as f64;
                let share = 0.5 - 0.5 * (std::f64::consts::TAU * part).cos();
                request.scene.deformed = Some(Magnification::Given(largest * share));
            }
        }
        request
    }
}

impl FrameSource for InMemory<'_> {
    type Error = MovingError;

    fn count(&self) -> usize {
        match self.moving {
            MotionKind::Steps(steps) => steps.len(),
            MotionKind::Factor(_, count) => *count,
        }
    }

    fn with(&self, number: usize, work: &mut Work<'_, MovingError>) -> Result<(), MovingError> {
        with_subject(self.dataset, &self.of(number), work)
    }
}

/// Works on what a request shows of a dataset.
///
/// # Errors
/// Features that the dataset does not have; the errors of the work.
pub fn with_subject<E: From<SubjectError> + From<FieldError>>(
    dataset: &Dataset,
    request: &Request,
    work: &mut Work<'_, E>,
) -> Result<(), E> {
    let subject = &request.scene.subject;
    let mut changed = None;
    let dataset = match subject.is_whole() {
        true => dataset,
        false => {
            let changed = changed.insert(dataset.clone());
            subject.apply(changed)?;
            changed
        }
    };
    let field = Field::new(dataset, subject.step_of(dataset))?;
    work(FieldSource::of(dataset, &field), request)
}
