//! Exports from the window: images, figures, animations, and the command that draws them.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ppum::progress::Watcher;
use ppum_figure::figure::{BarPlace, FigureStyle, hugging, plot_area};
use ppum_figure::form::PageFormat;
use ppum_render::view::{View, ViewError};
use ppum_scene::animation::{
    AnimationFormat as Animation, FrameSource, InMemory, MotionKind, SeriesAnimation, Work,
};
use ppum_scene::camera::Camera;
use ppum_scene::command;
use ppum_scene::compose::{page_of_view, reshaped, view_in};
use ppum_scene::engine::Engine;
use ppum_scene::magnification::Magnification;
use ppum_scene::mirror::Mirror;
use ppum_scene::notice::Notice;
use ppum_scene::overlays::Overlay;
use ppum_scene::page_style::PageStyle;
use ppum_scene::quantity::DisplayError;
use ppum_scene::region::ViewRegion;
use ppum_scene::request::{FigureTexts, Request};
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;

use crate::field::OwnedField;
use crate::frames::Subtrahend;

/// The kinds of files that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportChoice {
    /// The image alone.
    Image,
    /// With axes, colour bar and title.
    Figure,
    /// The steps of a series.
    Steps,
    /// The deformed body, its factor growing and falling.
    Deformation,
}

impl ExportChoice {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Image, Self::Figure, Self::Steps, Self::Deformation];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Image => "Image",
            Self::Figure => "Figure",
            Self::Steps => "Animation of the steps",
            Self::Deformation => "Animation of the deformation",
        }
    }

    /// True for animations.
    pub(crate) fn is_moving(self) -> bool {
        matches!(self, Self::Steps | Self::Deformation)
    }

    /// Returns the endings of its file names, the usual one first.
    #[must_use]
    pub fn ends(self) -> &'static [&'static str] {
        match self {
            Self::Image | Self::Figure => &["png", "svg", "pdf"],
            Self::Steps | Self::Deformation => &["gif", "apng", "png"],
        }
    }
}

/// How an animation moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Images a second.
    pub rate: f64,
    /// Images of the deformation's coming and going.
    pub count: usize,
    /// How many times its displacement the body is drawn with at most; automatic if it is not
    /// given.
    pub factor: Option<f64>,
}

impl Default for Motion {
    fn default() -> Self {
        Self { rate: 12.0, count: 36, factor: None }
    }
}

/// A unit of sizes of pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Centimetres on paper.
    Centimetre,
    /// Inches on paper.
    Inch,
    /// Pixels, with letters that grow with the page.
    Pixel,
}

impl LengthUnit {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Centimetre, Self::Inch, Self::Pixel];

    /// Its sign, and how many of it are an inch.
    #[must_use]
    pub fn words(self) -> (&'static str, f64) {
        match self {
            Self::Centimetre => ("cm", 2.54),
            Self::Inch => ("in", 1.0),
            Self::Pixel => ("pixels", SCREEN_DPI),
        }
    }
}

/// The size of a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageSize {
    /// The unit of its sides.
    pub unit: LengthUnit,
    /// Its width.
    pub width: f64,
    /// Its height; on paper without one that of what is shown.
    pub height: Option<f64>,
    /// Pixels per inch of paper.
    pub dpi: f64,
    /// Size of letters on paper \[points\].
    pub font_size: f64,
}

/// Pixels per inch of screens, as CSS has it.
const SCREEN_DPI: f64 = 96.0;

impl PageSize {
    /// A column of a journal, as high as what is shown.
    pub const COLUMN: Self =
        Self { unit: LengthUnit::Centimetre, width: 8.6, height: None, dpi: 300.0, font_size: 9.0 };

    /// So many columns and rows.
    #[must_use]
    pub fn pixels(size: [u32; 2]) -> Self {
        let [width, height] = size.map(f64::from);
        Self { unit: LengthUnit::Pixel, width, height: Some(height), ..Self::COLUMN }
    }

    /// Returns the page in another unit.
    pub(crate) fn in_unit(self, unit: LengthUnit) -> Self {
        let factor = unit.words().1 / self.unit.words().1;
        let round = |length: f64| match unit {
            LengthUnit::Pixel => length.round(),
            _ => (100.0 * length).round() / 100.0,
        };
        let height = self.height.map(|height| round(factor * height));
        Self { unit, width: round(factor * self.width), height, ..self }
    }

    /// The look of a figure; where no height is given with any.
    fn design(&self) -> FigureStyle {
        let sides = [self.width, self.height.unwrap_or(self.width)];
        if self.unit == LengthUnit::Pixel {
            return FigureStyle::pixels(sides.map(|side| side.round() as u32));
        }
        let inches = sides.map(|side| side / self.unit.words().1);
        FigureStyle { font_size: self.font_size, ..FigureStyle::inches(inches, self.dpi) }
    }
}

/// An image that is to be written.
#[derive(Clone, Debug)]
pub struct ImageExport {
    /// The field that is looked at, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// The file of its dataset.
    pub file: Option<PathBuf>,
    /// The subtrahend: a field, and what is shown of it.
    pub left: Option<Subtrahend>,
    /// The shown scene.
    pub scene: SceneRequest,
    /// Where.
    pub view: View,
    /// The page.
    pub page: PageSize,
    /// The kind of the file.
    pub choice: ExportChoice,
    /// The motion of an animation.
    pub motion: Motion,
    /// The texts of a figure that are not automatic.
    pub texts: FigureTexts,
}

type Failure = Box<dyn Error>;

/// Why there is no animation of a difference.
const NOT_MOVING: &str =
    "an animation is of one view; save images of the difference, or switch it off (Shift+V)";
/// Why there is no command of a difference.
pub const NO_COMMAND: &str = "no command draws the difference of two views; a session does: ppum view --session … --screenshot …";

impl ImageExport {
    /// The look of a figure, none of a bare image; in words why there is none.
    fn design(&self, request: &Request) -> Result<Option<FigureStyle>, Failure> {
        if self.choice == ExportChoice::Image {
            return Ok(None);
        }
        let design = self.page.design();
        if self.page.height.is_some() || self.page.unit == LengthUnit::Pixel {
            return Ok(Some(design));
        }
        let title = self.subject()?.title(request)?;
        let room = |design: &FigureStyle| Ok(plot_area(&title, design)?);
        let aspect = self.view.width / self.view.height();
        hugging(&design, aspect, [1, 1], &BarPlace::ANYWHERE, room).map(Some)
    }

    /// The file's bytes, in the form that its name ends in, and what is to be said of them. For an
    /// animation, `done` counts the images, those of the search for the range and those that are
    /// drawn.
    ///
    /// # Errors
    /// The reason, in words, why the image cannot be drawn or encoded.
    pub fn bytes(
        &self,
        path: &Path,
        watcher: &dyn Watcher,
        done: &AtomicUsize,
    ) -> Result<(Vec<u8>, Vec<Notice>), String> {
        let engine = Engine::processor(watcher);
        let bytes = match self.choice {
            ExportChoice::Image | ExportChoice::Figure => self.still(path, &engine),
            _ if self.left.is_some() => Err(NOT_MOVING.into()),
            ExportChoice::Steps | ExportChoice::Deformation => self.moving(path, &engine, done),
        };
        Ok((bytes.map_err(|error| error.to_string())?, engine.into_notices()))
    }

    /// The view on the pixels of the page; that of a figure gets the shape of its plot later.
    fn shaped(&self, design: Option<&FigureStyle>) -> Result<View, ViewError> {
        match design {
            Some(_) => Ok(self.view),
            None => reshaped(&self.view, self.page.design().size),
        }
    }

    fn subject(&self) -> Result<ImageSubject<'_>, DisplayError> {
        let (dataset, field) = (self.field.dataset(), self.field.field());
        let subject = ImageSubject::new(dataset, field, self.scene.quantity.as_deref())?;
        Ok(ImageSubject { left: self.left.as_ref().map(Subtrahend::side), ..subject })
    }

    /// Returns the request of the image; a page shows the cracks where the window does.
    fn request(&self) -> Request {
        let mut scene = self.scene.clone();
        let is_page = self.choice != ExportChoice::Image;
        scene.overlays.no_cracks = is_page && !scene.overlays.shown.contains(&Overlay::Cracks);
        let labels = if is_page { self.texts.clone() } else { FigureTexts::default() };
        Request { labels, ..Request::from(scene) }
    }

    fn still(&self, path: &Path, engine: &Engine<'_>) -> Result<Vec<u8>, Failure> {
        let (subject, request) = (self.subject()?, self.request());
        let design = self.design(&request)?;
        let view = self.shaped(design.as_ref())?;
        let (page, shot) = page_of_view(&subject, &request, &view, design.as_ref(), engine)?;
        // files that are passed on do not say in which folder they were made
        let names = [self.file.as_deref(), Some(path)].map(|path| path.and_then(Path::file_name));
        let [file, output] =
            names.map(|name| name.map_or(NAMELESS.into(), |n| n.to_string_lossy()));
        let command = match self.left {
            None => self.command_of(&file, &output)?,
            Some(_) => NO_COMMAND.into(),
        };
        let mut texts = shot.texts(&file);
        texts.push(("ppum:command".to_owned(), command));
        texts.extend(shot.notes());
        let form = PageFormat::of(path);
        engine.tell_glyphs(&page, form);
        let dpi = design.filter(|_| self.page.unit != LengthUnit::Pixel).map(|design| design.dpi);
        Ok(form.bytes(&page, dpi, &texts)?)
    }

    /// The number of images of an animation.
    pub(crate) fn count(&self) -> usize {
        match self.choice {
            ExportChoice::Steps => self.field.dataset().steps.len(),
            _ => self.motion.count,
        }
    }

    fn moving(
        &self,
        path: &Path,
        engine: &Engine<'_>,
        done: &AtomicUsize,
    ) -> Result<Vec<u8>, Failure> {
        let request = self.request();
        let automatic = || Magnification::Auto.number(&[self.field.field()]).unwrap_or(1.0);
        let moving = match self.choice {
            ExportChoice::Steps => MotionKind::Steps((0..self.count()).collect()),
            _ => MotionKind::Factor(self.motion.factor.unwrap_or_else(automatic), self.count()),
        };
        let frames = InMemory::new(self.field.dataset(), &request, &moving)?;
        let frames = CountedFrames { frames, done };
        let design = self.design(&request)?;
        let view = self.shaped(design.as_ref())?;
        let room = match &design {
            Some(design) => frames.layout_input(true)?.room(design)?,
            None => view.pixels,
        };
        let camera = Camera::View(reshaped(&view, room)?);
        done.store(0, Ordering::Relaxed);
        let animation = SeriesAnimation::new(&frames, &camera, design.as_ref(), engine)?;
        let milliseconds = (1000.0 / self.motion.rate).round().clamp(10.0, 60_000.0) as u16;
        let is_gif = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("gif"));
        let (form, mut bytes) = (if is_gif { Animation::Gif } else { Animation::Apng }, Vec::new());
        animation.write(form, milliseconds, &|_| Vec::new(), &mut bytes)?;
        Ok(bytes)
    }

    /// The command that draws the same.
    ///
    /// # Errors
    /// A size without room for a figure, a difference, which no command draws; in words.
    pub fn command(&self, output: &Path) -> Result<String, String> {
        let file = self.file.as_deref().map_or(NAMELESS.into(), Path::to_string_lossy);
        self.command_of(&file, &output.to_string_lossy()).map_err(|error| error.to_string())
    }

    fn command_of(&self, file: &str, output: &str) -> Result<String, Failure> {
        if self.left.is_some() {
            return Err(NO_COMMAND.into());
        }
        let mut request = self.request();
        let design = self.design(&request)?;
        let mut view = self.shaped(design.as_ref())?;
        request.look.size = Some(view.pixels);
        if let Some(design) = &design {
            view = view_in(&self.subject()?, &request, &view, design)?;
            (request.figure, request.look) = (true, PageStyle::of(design));
            // the command would show the whole of a body of revolution
            let mirror = &mut request.scene.mirror;
            *mirror =
                mirror.take().or(Mirror::of_figures(self.field.dataset()).and(Some(Mirror::NONE)));
        }
        request.place = ViewRegion::of(&view);
        let mut words = command::render(&request, file, output);
        if self.choice == ExportChoice::Steps {
            words.retain(|word| !word.starts_with("--step="));
            words.extend(["--steps=all".to_owned(), format!("--fps={:?}", self.motion.rate)]);
        }
        Ok(command::line(&words))
    }
}

/// A dataset without a file, as a command would name it.
const NAMELESS: &str = "FILE.h5";

/// Frames that are counted when they were worked on.
struct CountedFrames<'a, F> {
    frames: F,
    done: &'a AtomicUsize,
}

impl<F: FrameSource> FrameSource for CountedFrames<'_, F> {
    type Error = F::Error;

    fn count(&self) -> usize {
        self.frames.count()
    }

    fn with(&self, number: usize, work: &mut Work<'_, F::Error>) -> Result<(), F::Error> {
        self.frames.with(number, work)?;
        self.done.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }
}
