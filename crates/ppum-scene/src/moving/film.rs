//! Frames in one range, and the files of animations.

use std::io::Write;

use ppum_figure::canvas::Canvas;
use ppum_figure::figure::FigureStyle;
use ppum_figure::form;
use ppum_render::animation::{AnimationError, Apng, ColorCounts, Gif};
use ppum_render::image::Image;
use ppum_render::picture::Style;
use ppum_render::png::TextChunk;
use ppum_render::view::View;

use super::{FrameSource, FrameView};
use crate::colors;
use crate::drawing::{PixelValues, classes, united};
use crate::engine::Engine;
use crate::notice::Notice;
use crate::request::Request;
use crate::shared::{ColorMapping, ValueStatistics};
use crate::shot::{ImageError, ImageInput, QuantityRequest, RenderedImage};

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
fn bytes(drawn: &PixelValues) -> usize {
    drawn.values.bytes() + drawn.opacity.as_ref().map_or(0, |(_, all)| all.len())
}

/// Frames once their values and their range are known.
pub struct SeriesAnimation<'a, F: FrameSource<Error: From<AnimationError>>> {
    frames: &'a F,
    place: &'a dyn FrameView<F::Error>,
    design: Option<&'a FigureStyle>,
    engine: &'a Engine<'a>,
    drawn: BoundedCache<PixelValues>,
    /// The one way to colours of all frames.
    pub coloring: ColorMapping,
    /// The view of each frame.
    pub views: Vec<View>,
    /// The name of what the first one shows, and what drew it.
    pub name: String,
    /// The device that drew the first one.
    pub by: String,
}

/// The results of the first pass.
#[derive(Default)]
struct RangePass {
    found: ValueStatistics,
    style: Option<Style>,
    classes: Vec<Option<Vec<f64>>>,
    views: Vec<View>,
    name: String,
    by: String,
    is_of_cells: bool,
    colors: colors::ColorOptions,
}

impl RangePass {
    /// The values of a frame, and what they say of the range.
    fn add(
        &mut self,
        input: &ImageInput<'_>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> Result<PixelValues, ImageError> {
        let drawn = input.values(request.samples, engine)?;
        if self.style.is_none() {
            let (quantity, colors) = (input.shown.quantity(), &request.scene.colors);
            self.style = Some(colors.style(quantity, colors.map(quantity)?));
            (self.name, self.by) = (input.name.to_owned(), drawn.by.clone());
            (self.is_of_cells, self.colors) = (quantity.is_none(), colors.clone());
        }
        if let Some(style) = &self.style {
            self.found.add(input.span(&drawn, style, engine.watcher)?, &drawn, style.scale);
        }
        self.classes.push(classes([(input.shown, &drawn.values)]));
        self.views.push(drawn.view);
        Ok(drawn)
    }

    /// One way to colours for all frames, their views, and of the first its name and what drew it.
    fn finished(self) -> (ColorMapping, Vec<View>, String, String) {
        let classes = self.classes.into_iter().collect::<Option<Vec<_>>>().and_then(united);
        let style = self.style.unwrap_or_default();
        let classed = self.colors.classed(style.clone(), classes);
        (self.found.coloring(classed, style), self.views, self.name, self.by)
    }
}

impl<'a, F: FrameSource<Error: From<AnimationError>>> SeriesAnimation<'a, F> {
    /// Looks at all frames.
    ///
    /// # Errors
    /// No frames; those of one image; a watcher that stops it.
    pub fn new(
        frames: &'a F,
        place: &'a dyn FrameView<F::Error>,
        design: Option<&'a FigureStyle>,
        engine: &'a Engine<'a>,
    ) -> Result<Self, F::Error> {
        let (mut first, mut drawn) = (RangePass::default(), BoundedCache::new(VALUES));
        frames.each(&mut |source, request| {
            let seen = place.seen(source, request, engine)?;
            let size = design.map_or(seen.view().pixels, |design| design.size);
            if u64::from(size[0]) * u64::from(size[1]) > MOST {
                return Err(ImageError::TooLarge(size).into());
            }
            let asked =
                QuantityRequest::new(&request.scene, source.field).map_err(ImageError::from)?;
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
    pub fn page(&self, number: usize) -> Result<(Canvas, RenderedImage), F::Error> {
        let mut made = None;
        self.frames.with(number, &mut |source, request| {
            let seen = self.place.seen(source, request, self.engine)?;
            let asked =
                QuantityRequest::new(&request.scene, source.field).map_err(ImageError::from)?;
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
        texts: &[TextChunk],
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
