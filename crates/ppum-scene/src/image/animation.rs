//! Images in motion: the steps of a series, or the deformed body with a factor that grows and
//! falls. All have one range.
//!
//! A [`SeriesAnimation`] looks at all frames first, then draws them one after the other: none but
//! one of their fields needs to be in memory.

use std::io::Write;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::FigureStyle;
use ppum_figure::form::PageFormat;
use ppum_render::animation::{AnimationError, Apng, ColorCounts, Gif};
use ppum_render::deform::AutomaticFactor;
use ppum_render::image::Image;
use ppum_render::picture::Style;
use ppum_render::png::TextChunk;
use ppum_render::view::View;

use super::body::BodyView;
use super::camera::{Camera, ImageSettings, LayoutInput};
use super::coloring::{ColorMapping, ValueStatistics};
use super::compose::RenderedImage;
use super::engine::Engine;
use super::error::{ImageError, ImageErrorKind};
use super::quantity::{classes, united};
use super::subject::ImageSubject;
use super::values::PixelValues;
use crate::request::Request;
use crate::request::colors::ColorOptions;
use crate::request::magnification::Magnification;

/// The file format of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// In 256 colours, for programs that know no other.
    Gif,
    /// Without loss.
    Apng,
}

/// Memory for the values of frames from the first pass, which finds the range, to the second
/// \[bytes\]: 160 images of 1024 × 768 pixels. Those of more are computed again.
const VALUES: usize = 1 << 30;
/// The limit for images, whose colours a GIF counts before it is begun.
const IMAGES: usize = 1 << 29;

/// Most pixels of a frame: a gigabyte.
const MOST: u64 = 1 << 28;

/// Works on a frame: what it shows, and its request.
pub type Work<'a, E> = dyn FnMut(&ImageSubject<'_>, &Request) -> Result<(), E> + 'a;

/// The frames of an animation.
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

    /// The request of them, with the factor of the deformed body as a number, the same for all
    /// frames that do not have theirs, and with the edges at which a body is mirrored.
    ///
    /// # Errors
    /// Fields that are no displacements; datasets that do not know their lines of symmetry.
    fn resolved(&self, request: &Request) -> Result<Request, Self::Error> {
        let mut request = request.clone();
        if (request.is_figure() || request.scene.mirror.is_some()) && self.count() > 0 {
            self.with(0, &mut |subject, _| {
                request.scene = request.scene_of(subject.dataset).map_err(ImageError::from)?;
                Ok(())
            })?;
        }
        if request.scene.deformed == Some(Magnification::Auto) {
            let mut found = AutomaticFactor::default();
            self.each(&mut |ImageSubject { field, .. }, _| {
                Ok(found.add(field, &field.domain.bounds).map_err(ImageError::from)?)
            })?;
            request.scene.deformed = Some(Magnification::Given(found.factor()));
        }
        Ok(request)
    }

    /// The input of the layout of their pages, figures or bare.
    ///
    /// # Errors
    /// As [`LayoutInput::add`].
    fn layout_input(&self, is_figure: bool) -> Result<LayoutInput, Self::Error> {
        let mut input = LayoutInput::default();
        for number in 0..self.count() {
            let mut is_deformed = false;
            self.with(number, &mut |subject, request| {
                is_deformed = request.scene.deformed.is_some();
                Ok(input.add(subject, request)?)
            })?;
            // the first frame tells all of bare ones that are undeformed: the others stay unread
            if !is_figure && !is_deformed {
                break;
            }
        }
        Ok(input)
    }

    /// The settings common to the frames of a request whose factor is a number.
    ///
    /// # Errors
    /// As [`LayoutInput::add`]; a size without room.
    fn settings(&self, request: &Request) -> Result<ImageSettings, Self::Error> {
        Ok(ImageSettings::new(request, &self.layout_input(request.figure)?)?)
    }
}

/// The motion in an animation.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionKind {
    /// The frames are these steps.
    Steps(Vec<usize>),
    /// The body deforms up to so many times its displacement and back, in so many frames.
    Factor(f64, usize),
}

/// Frames of a dataset that is in memory.
pub struct InMemory<'a> {
    dataset: &'a Dataset,
    request: Request,
    moving: &'a MotionKind,
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
    ) -> Result<Self, ImageError> {
        let all = Self { dataset, request: request.clone(), moving };
        Ok(Self { request: all.resolved(request)?, ..all })
    }

    /// Returns the request of a frame.
    fn of(&self, number: usize) -> Request {
        match self.moving {
            MotionKind::Steps(steps) => self.request.at_step(steps[number]),
            MotionKind::Factor(largest, count) => {
                let part = number as f64 / *count as f64;
                let share = 0.5 - 0.5 * (std::f64::consts::TAU * part).cos();
                let mut request = self.request.clone();
                request.scene.deformed = Some(Magnification::Given(largest * share));
                request
            }
        }
    }
}

impl FrameSource for InMemory<'_> {
    type Error = ImageError;

    fn count(&self) -> usize {
        match self.moving {
            MotionKind::Steps(steps) => steps.len(),
            MotionKind::Factor(_, count) => *count,
        }
    }

    fn with(&self, number: usize, work: &mut Work<'_, ImageError>) -> Result<(), ImageError> {
        with_subject(self.dataset, &self.of(number), work)
    }
}

/// Works on what a request shows of a dataset.
///
/// # Errors
/// Features that the dataset does not have; the errors of the work.
pub fn with_subject<E: From<ImageError>>(
    dataset: &Dataset,
    request: &Request,
    work: &mut Work<'_, E>,
) -> Result<(), E> {
    let scene = &request.scene;
    let dataset = scene.subject.applied(dataset).map_err(ImageError::from)?;
    let field = Field::new(&dataset, scene.subject.step_of(&dataset)).map_err(ImageError::from)?;
    let subject = ImageSubject::new(&dataset, &field, scene.quantity.as_deref());
    work(&subject.map_err(ImageError::from)?, request)
}

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
fn bytes(values: &PixelValues) -> usize {
    values.values.bytes() + values.opacity.as_ref().map_or(0, |(_, all)| all.len())
}

/// Frames once their values and their range are known.
pub struct SeriesAnimation<'a, F: FrameSource> {
    frames: &'a F,
    camera: &'a Camera,
    design: Option<&'a FigureStyle>,
    engine: &'a Engine<'a>,
    values: BoundedCache<PixelValues>,
    /// The one way to colours of all frames.
    pub coloring: ColorMapping,
    /// The view of each frame.
    pub views: Vec<View>,
    /// The name of what the first one shows, and what drew it.
    pub name: String,
    /// The device that drew the first one.
    pub by: String,
}

/// The data of the first frame, which all share.
struct FirstFrame {
    style: Style,
    colors: ColorOptions,
    name: String,
    by: String,
    is_of_cells: bool,
}

impl FirstFrame {
    fn new(
        subject: &ImageSubject<'_>,
        request: &Request,
        values: &PixelValues,
    ) -> Result<Self, ImageError> {
        let (quantity, colors) = (subject.shown.quantity(), request.scene.colors.clone());
        let style = colors.style(quantity, colors.map(quantity)?);
        let (name, by) = (subject.name.clone(), values.by.clone());
        Ok(Self { style, colors, name, by, is_of_cells: quantity.is_none() })
    }
}

impl<'a, F: FrameSource> SeriesAnimation<'a, F> {
    /// Looks at all frames.
    ///
    /// # Errors
    /// No frames; those of one image; a watcher that stops it.
    pub fn new(
        frames: &'a F,
        camera: &'a Camera,
        design: Option<&'a FigureStyle>,
        engine: &'a Engine<'a>,
    ) -> Result<Self, F::Error> {
        let (mut found, mut values) = (ValueStatistics::default(), BoundedCache::new(VALUES));
        let (mut first, mut all_classes, mut views) = (None, Vec::new(), Vec::new());
        frames.each(&mut |subject, request| {
            let body = camera.body(subject, &request.scene, engine)?;
            let size = design.map_or(body.view().pixels, |design| design.size);
            if u64::from(size[0]) * u64::from(size[1]) > MOST {
                return Err(ImageError::from(ImageErrorKind::TooLarge(size)).into());
            }
            let drawn = subject.values(&body, request.samples, engine)?;
            let FirstFrame { style, .. } = match &mut first {
                Some(first) => first,
                none => none.insert(FirstFrame::new(subject, request, &drawn)?),
            };
            let span = subject.span(&body, &drawn, style, engine.watcher);
            found.add(span.map_err(ImageError::from)?, &drawn, style.scale);
            all_classes.push(classes([(&*subject.shown, &drawn.values)]));
            views.push(drawn.view);
            let bytes = bytes(&drawn);
            values.push(drawn, bytes);
            Ok(())
        })?;
        let first = first.ok_or(AnimationError::Empty).map_err(ImageError::from)?;
        let FirstFrame { style, colors, name, by, is_of_cells } = first;
        engine.tell_undefined(&name, found.undefined, is_of_cells);
        let all_classes = all_classes.into_iter().collect::<Option<Vec<_>>>().and_then(united);
        let coloring = found.coloring(colors.classed(style.clone(), all_classes), style);
        Ok(Self { frames, camera, design, engine, values, coloring, views, name, by })
    }

    /// The page of a frame.
    ///
    /// # Errors
    /// As [`Self::new`]; a design without room.
    pub fn page(&self, number: usize) -> Result<(Canvas, RenderedImage), F::Error> {
        let (design, engine, mut made) = (self.design, self.engine, None);
        self.frames.with(number, &mut |subject, request| {
            let body = self.camera.body(subject, &request.scene, engine)?;
            let image = match &self.values.all[number] {
                Some(values) => self.image_of(subject, request, (&body, values)),
                None => {
                    let values = subject.values(&body, request.samples, engine)?;
                    self.image_of(subject, request, (&body, &values))
                }
            };
            made = Some(image?.page(subject, request, design, engine)?);
            Ok(())
        })?;
        Ok(made.ok_or(AnimationError::Empty).map_err(ImageError::from)?)
    }

    fn image_of(
        &self,
        subject: &ImageSubject<'_>,
        request: &Request,
        (body, values): (&BodyView<'_>, &PixelValues),
    ) -> Result<RenderedImage, ImageError> {
        subject.compose(request, body, (values, &self.coloring), self.design, self.engine)
    }

    fn image(&self, number: usize) -> Result<Image, F::Error> {
        Ok(self.page(number)?.0.image())
    }

    /// Writes an animation whose frames are shown for some milliseconds each, and returns its
    /// columns and rows. The texts of the file follow from the first frame; only an APNG can hold
    /// them.
    ///
    /// # Errors
    /// As [`Self::page`]; what the file does not hold, or cannot be written.
    pub fn write(
        &self,
        form: AnimationFormat,
        milliseconds: u16,
        texts: &dyn Fn(&RenderedImage) -> Vec<TextChunk>,
        out: &mut dyn Write,
    ) -> Result<[u32; 2], F::Error> {
        let (page, image) = self.page(0)?;
        self.engine.tell_glyphs(&page, PageFormat::Png);
        let first = page.image();
        let size = first.size;
        match form {
            AnimationFormat::Gif => self.gif(first, milliseconds, out)?,
            AnimationFormat::Apng => self.apng(&first, milliseconds, &texts(&image), out)?,
        }
        Ok(size)
    }

    fn apng(
        &self,
        first: &Image,
        milliseconds: u16,
        texts: &[TextChunk],
        out: &mut dyn Write,
    ) -> Result<(), F::Error> {
        let frames = self.frames.count();
        let count = u32::try_from(frames).unwrap_or(u32::MAX);
        let mut file =
            Apng::new(out, first.size, count, milliseconds, texts).map_err(ImageError::from)?;
        file.add(first).map_err(ImageError::from)?;
        for number in 1..frames {
            file.add(&self.image(number)?).map_err(ImageError::from)?;
        }
        Ok(file.finish().map_err(ImageError::from)?)
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
        let mut file = Gif::new(out, size, &colors, milliseconds).map_err(ImageError::from)?;
        for (number, image) in images.all.into_iter().enumerate() {
            file.add(&image.map_or_else(|| self.image(number), Ok)?).map_err(ImageError::from)?;
        }
        Ok(file.finish().map_err(ImageError::from)?)
    }
}
