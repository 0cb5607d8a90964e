//! Pictures in motion: the steps of a series, or the deformed plate with a factor that grows and
//! falls. All have one range.
//!
//! A [`Film`] looks at all frames first, then draws them one after the other: none but one of their
//! fields needs to be in memory.

use std::io::Write;

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use ppum::vec2::Rect;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{Design, plot_area};
use ppum_figure::form;
use ppum_render::animation::{AnimationError, Apng, ColorCounts, Gif};
use ppum_render::deform::AutomaticFactor;
use ppum_render::image::Image;
use ppum_render::picture::Style;
use ppum_render::png::Text;
use ppum_render::view::View;

use crate::colors;
use crate::deformed::{self, Factor};
use crate::drawing::{BodyView, Drawn, classes, united};
use crate::engine::Engine;
use crate::notice::Notice;
use crate::request::Request;
use crate::scene::SubjectError;
use crate::shared::{Coloring, ValueStatistics};
use crate::shot::{Asked, FieldSource, Input, Shot, ShotError, title};

/// What moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Moving {
    /// The frames are these steps.
    Steps(Vec<usize>),
    /// The plate deforms up to so many times its displacement and back, in so many frames.
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
    /// The file.
    #[error(transparent)]
    Animation(#[from] AnimationError),
}

impl From<ShotError> for MovingError {
    fn from(error: ShotError) -> Self {
        Self::Shot(Box::new(error))
    }
}

/// Works on a frame: a field, and what is shown of it.
pub type Work<'a, E> = dyn FnMut(FieldSource<'_>, &Request) -> Result<(), E> + 'a;

/// The frames of an animation, or the one of a still picture.
pub trait Frames {
    /// The reason why there is no such frame.
    type Error: From<ShotError> + From<AnimationError>;

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

    /// The factor of the deformed plate as a number, the same for all frames that do not
    /// have theirs.
    ///
    /// # Errors
    /// Fields that are no displacements.
    fn factor(&self, factor: Factor) -> Result<f64, Self::Error> {
        if let Factor::Given(factor) = factor {
            return Ok(factor);
        }
        let mut found = AutomaticFactor::default();
        self.each(&mut |FieldSource { field, .. }, _| {
            Ok(found.add(field, &field.domain.bounds).map_err(ShotError::from)?)
        })?;
        Ok(found.factor())
    }

    /// The box that shows the plate in all frames.
    ///
    /// # Errors
    /// As [`deformed::bounds`].
    fn bounds(&self) -> Result<Option<Rect>, Self::Error> {
        let mut all: Option<Rect> = None;
        self.each(&mut |FieldSource { field, .. }, Request { scene, .. }| {
            let bounds = match scene.deformed {
                None => field.domain.bounds,
                Some(factor) => {
                    let factor = factor.number(&[field]);
                    factor
                        .and_then(|factor| deformed::bounds(field, factor, scene.outline))
                        .map_err(ShotError::from)?
                }
            };
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
    fn room(&self, design: &Design) -> Result<[u32; 2], Self::Error> {
        let mut room = design.size;
        self.each(&mut |source, request| {
            let title = title(source, request).map_err(ShotError::from)?;
            let [columns, rows] = plot_area(&title, design).map_err(ShotError::from)?;
            room = [room[0].min(columns), room[1].min(rows)];
            Ok(())
        })?;
        Ok(room)
    }
}

/// Chooses the view of each frame.
pub trait FrameView<E> {
    /// What is seen of a frame.
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

impl<E: From<ShotError>> FrameView<E> for View {
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
    /// What is shown.
    pub request: Request,
    /// What moves.
    pub moving: &'a Moving,
}

impl<'a> InMemory<'a> {
    /// The frames, deformed by one factor if they are.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn new(
        dataset: &'a Dataset,
        request: &Request,
        moving: &'a Moving,
    ) -> Result<Self, MovingError> {
        let mut all = Self { dataset, request: request.clone(), moving };
        if let Some(factor) = request.scene.deformed {
            all.request.scene.deformed = Some(Factor::Given(all.factor(factor)?));
        }
        Ok(all)
    }

    /// What a frame shows.
    fn of(&self, number: usize) -> Request {
        let mut request = self.request.clone();
        match self.moving {
            Moving::Steps(steps) => request.scene.subject.step = Some(steps[number]),
            Moving::Factor(largest, count) => {
                let part = number as f64 / *count as f64;
                let share = 0.5 - 0.5 * (std::f64::consts::TAU * part).cos();
                request.scene.deformed = Some(Factor::Given(largest * share));
            }
        }
        request
    }
}

impl Frames for InMemory<'_> {
    type Error = MovingError;

    fn count(&self) -> usize {
        match self.moving {
            Moving::Steps(steps) => steps.len(),
            Moving::Factor(_, count) => *count,
        }
    }

    fn with(&self, number: usize, work: &mut Work<'_, MovingError>) -> Result<(), MovingError> {
        let request = self.of(number);
        let subject = &request.scene.subject;
        let mut changed = None;
        let dataset = match subject.is_whole() {
            true => self.dataset,
            false => {
                let changed = changed.insert(self.dataset.clone());
                subject.apply(changed)?;
                changed
            }
        };
        let field = Field::new(dataset, subject.step_of(dataset))?;
        work(FieldSource::of(dataset, &field), &request)
    }
}

/// The file format of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// In 256 colours, for programs that know no other.
    Gif,
    /// Without loss.
    Apng,
}

/// Memory for the values of frames from the first pass, which finds the range, to the second
/// \[bytes\]: 160 pictures of 1024 × 768 pixels. Those of more are computed again.
const VALUES: usize = 1 << 30;
/// The same for pictures, whose colours a GIF counts before it is begun.
const IMAGES: usize = 1 << 29;

/// Most pixels of a frame: a gigabyte.
const MOST: u64 = 1 << 28;

/// Values by number, of which those are kept that fit the memory.
struct BoundedCache<T> {
    room: usize,
    all: Vec<Option<T>>,
}

impl<T> BoundedCache<T> {
    fn new(room: usize) -> Self {
        Self { room, all: Vec::new() }
    }

    fn push(&mut self, thing: T, bytes: usize) {
        let fits = bytes <= self.room;
        self.room -= if fits { bytes } else { 0 };
        self.all.push(fits.then_some(thing));
    }
}

/// Memory of what is kept of a frame.
fn bytes(drawn: &Drawn) -> usize {
    drawn.values.bytes() + drawn.opacity.as_ref().map_or(0, |(_, all)| all.len())
}

/// Frames once their values and their range are known.
pub struct Film<'a, F: Frames> {
    frames: &'a F,
    place: &'a dyn FrameView<F::Error>,
    design: Option<&'a Design>,
    engine: &'a Engine<'a>,
    drawn: BoundedCache<Drawn>,
    /// The one way to colours of all frames.
    pub coloring: Coloring,
    /// The view of each frame.
    pub views: Vec<View>,
    /// The name of what the first one shows, and what drew it.
    pub name: String,
    /// What drew the first one.
    pub by: String,
}

/// What the first pass finds.
#[derive(Default)]
struct First {
    found: ValueStatistics,
    style: Option<Style>,
    classes: Vec<Option<Vec<f64>>>,
    views: Vec<View>,
    name: String,
    by: String,
    is_of_cells: bool,
    colors: colors::Colors,
}

impl First {
    /// The values of a frame, and what they say of the range.
    fn add(
        &mut self,
        input: &Input<'_>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> Result<Drawn, ShotError> {
        let drawn = input.values(request.samples, engine)?;
        if self.style.is_none() {
            let (quantity, colors) = (input.shown.quantity(), &request.scene.colors);
            self.style = Some(colors.style(quantity, colors.map(quantity)?));
            (self.name, self.by) = (input.name.to_owned(), drawn.by.clone());
            (self.is_of_cells, self.colors) = (quantity.is_none(), colors.clone());
        }
        if let Some(style) = &self.style {
            self.found.add(input.span(&drawn, style, engine)?, &drawn, style.scale);
        }
        self.classes.push(classes([(input.shown, &drawn.values)]));
        self.views.push(drawn.view);
        Ok(drawn)
    }

    /// One way to colours for all frames, their views, and of the first its name and what drew it.
    fn finished(self) -> (Coloring, Vec<View>, String, String) {
        let classes = self.classes.into_iter().collect::<Option<Vec<_>>>().and_then(united);
        let style = self.style.unwrap_or_default();
        let classed = self.colors.classed(style.clone(), classes);
        (self.found.coloring(classed, style), self.views, self.name, self.by)
    }
}

impl<'a, F: Frames> Film<'a, F> {
    /// Looks at all frames.
    ///
    /// # Errors
    /// No frames; those of one picture; a watcher that stops it.
    pub fn new(
        frames: &'a F,
        place: &'a dyn FrameView<F::Error>,
        design: Option<&'a Design>,
        engine: &'a Engine<'a>,
    ) -> Result<Self, F::Error> {
        let (mut first, mut drawn) = (First::default(), BoundedCache::new(VALUES));
        frames.each(&mut |source, request| {
            let seen = place.seen(source, request, engine)?;
            let size = design.map_or(seen.view().pixels, |design| design.size);
            if u64::from(size[0]) * u64::from(size[1]) > MOST {
                return Err(ShotError::TooLarge(size).into());
            }
            let asked = Asked::new(&request.scene, source.field).map_err(ShotError::from)?;
            let found = first.add(&source.input(&asked, &seen), request, engine)?;
            let bytes = bytes(&found);
            drawn.push(found, bytes);
            Ok(())
        })?;
        if first.views.is_empty() {
            return Err(AnimationError::Empty.into());
        }
        engine.tell_undefined(&first.name, first.found.undefined, first.is_of_cells);
        let (coloring, views, name, by) = first.finished();
        Ok(Self { frames, place, design, engine, drawn, coloring, views, name, by })
    }

    /// The page of a frame.
    ///
    /// # Errors
    /// As [`Self::new`]; a design without room.
    pub fn page(&self, number: usize) -> Result<(Canvas, Shot), F::Error> {
        let mut made = None;
        self.frames.with(number, &mut |source, request| {
            let seen = self.place.seen(source, request, self.engine)?;
            let asked = Asked::new(&request.scene, source.field).map_err(ShotError::from)?;
            let input = source.input(&asked, &seen);
            let again = match &self.drawn.all[number] {
                Some(_) => None,
                None => Some(input.values(request.samples, self.engine)?),
            };
            if let Some(drawn) = self.drawn.all[number].as_ref().or(again.as_ref()) {
                let shot = input.shot(request, drawn, &self.coloring, self.design, self.engine)?;
                made = Some(source.page(shot, request, self.design, self.engine)?);
            }
            Ok(())
        })?;
        Ok(made.ok_or(AnimationError::Empty)?)
    }

    fn image(&self, number: usize) -> Result<Image, F::Error> {
        Ok(self.page(number)?.0.image())
    }

    /// Writes an animation whose frames are shown for some milliseconds each, and returns its
    /// columns and rows. What its file says follows from the first frame; it has a place in an
    /// APNG alone.
    ///
    /// # Errors
    /// As [`Self::page`]; what the file does not hold, or cannot be written.
    pub fn write(
        &self,
        form: AnimationFormat,
        milliseconds: u16,
        texts: &dyn Fn(&Shot) -> Vec<Text>,
        out: &mut dyn Write,
    ) -> Result<[u32; 2], F::Error> {
        let (page, shot) = self.page(0)?;
        Notice::of_glyphs(&page, form::PageFormat::Png)
            .into_iter()
            .for_each(|n| self.engine.tell(n));
        let first = page.image();
        let size = first.size;
        match form {
            AnimationFormat::Gif => self.gif(first, milliseconds, out)?,
            AnimationFormat::Apng => self.apng(&first, milliseconds, &texts(&shot), out)?,
        }
        Ok(size)
    }

    fn apng(
        &self,
        first: &Image,
        milliseconds: u16,
        texts: &[Text],
        out: &mut dyn Write,
    ) -> Result<(), F::Error> {
        let frames = self.frames.count();
        let count = u32::try_from(frames).unwrap_or(u32::MAX);
        let mut file = Apng::new(out, first.size, count, milliseconds, texts)?;
        file.add(first)?;
        for number in 1..frames {
            file.add(&self.image(number)?)?;
        }
        Ok(file.finish()?)
    }

    /// Counts the colours of all frames, then writes them.
    fn gif(&self, first: Image, milliseconds: u16, out: &mut dyn Write) -> Result<(), F::Error> {
        let (size, mut first) = (first.size, Some(first));
        let (mut colors, mut images) = (ColorCounts::new(), BoundedCache::new(IMAGES));
        for number in 0..self.frames.count() {
            let image = first.take().map_or_else(|| self.image(number), Ok)?;
            colors.add(&image);
            let bytes = image.rgba.len();
            images.push(image, bytes);
        }
        let mut file = Gif::new(out, size, &colors, milliseconds)?;
        for (number, image) in images.all.into_iter().enumerate() {
            file.add(&image.map_or_else(|| self.image(number), Ok)?)?;
        }
        Ok(file.finish()?)
    }
}
