//! The subject of an image, and the first two stages on the way to its pixels: values and colours.

use std::fmt::Write as _;
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::text::trimmed;
use ppum::vec2::Rect;
use ppum_figure::figure::Labels;
use ppum_render::RasterError;
use ppum_render::deform::{DeformError, Deformation, DeformedView};
use ppum_render::picture::Style;
use ppum_render::range::ColorRange;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::samples::{Means, SampleImage, Samples};
use ppum_render::view::View;

use super::body::{BodyPart, BodyView};
use super::coloring::{ColorMapping, value_span};
use super::deformed;
use super::difference::{self, DifferenceSide, FieldDifference};
use super::engine::Engine;
use super::error::{ImageError, ImageErrorKind};
use super::mirror_lines::MirrorLines;
use super::notice::Notice;
use super::quantity::{DisplayError, DisplayedQuantity, default_quantity};
use super::values::{DrawingInput, PixelValues, RasterValues, with_raster};
use super::whole;
use crate::request::Request;
use crate::request::colors::{ColorOptions, MapError};
use crate::request::magnification::{Magnification, words};
use crate::request::mirror::MirrorError;
use crate::request::scene::SceneRequest;

/// The subject of an image: a field of a dataset, a quantity of it, and what is subtracted.
#[derive(Clone)]
pub struct ImageSubject<'a> {
    /// The dataset.
    pub dataset: &'a Dataset,
    /// Its field, which is that of the request's subject,
    /// see [`Subject::apply`](crate::request::scene::Subject::apply).
    pub field: &'a Field<'a>,
    /// The displayed quantity.
    pub shown: Arc<DisplayedQuantity>,
    /// Its name in notices and files.
    pub name: String,
    /// The subtrahend; with one the body is drawn undeformed.
    pub left: Option<DifferenceSide<'a>>,
}

/// Computes the means of so many samples a pixel of an undeformed body: an engine, a card that
/// stays open, or what knows the values.
pub type Evaluate<'e> =
    dyn FnMut(DrawingInput<'_>, Samples) -> Result<PixelValues, ImageError> + 'e;

/// Most samples of an image of the whole, all of which are held at once: 512 MiB.
const MOST_SAMPLES: u64 = 1 << 26;

impl<'a> ImageSubject<'a> {
    /// The quantity that a text names, by default that which suits the field.
    ///
    /// # Errors
    /// A text that means nothing for the field.
    pub fn new(
        dataset: &'a Dataset,
        field: &'a Field<'a>,
        text: Option<&str>,
    ) -> Result<Self, DisplayError> {
        let text = text.unwrap_or(default_quantity(field));
        let shown = DisplayedQuantity::parse(text, field)?;
        Ok(Self { dataset, field, name: shown.name(text), shown: Arc::new(shown), left: None })
    }

    /// The quantity of which extrema and isolines are found: they are those of one field.
    pub(super) fn quantity(&self) -> Option<&Quantity> {
        self.shown.quantity().filter(|_| self.left.is_none())
    }

    /// The difference, if something is subtracted.
    #[must_use]
    pub fn minus(&self) -> Option<FieldDifference<'_>> {
        let right = DifferenceSide { field: self.field, shown: &self.shown };
        self.left.map(|left| FieldDifference { right, left })
    }

    /// The words for what is shown, or for the difference, and the unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        self.minus().map_or_else(|| self.shown.words(self.field), |minus| minus.words())
    }

    /// The lines at which it is mirrored; none if nobody asks for the whole.
    ///
    /// # Errors
    /// A dataset that does not know its lines; differences, which are not mirrored.
    pub fn lines(&self, scene: &SceneRequest) -> Result<MirrorLines, MirrorError> {
        match &scene.mirror {
            Some(_) if self.left.is_some() => Err(MirrorError::Difference),
            mirror => MirrorLines::of(mirror.as_ref(), self.dataset),
        }
    }

    /// Returns the request of an image of it with the factor of the deformed body as a number, and
    /// with the edges at which a body is mirrored.
    ///
    /// # Errors
    /// Fields that are no displacements, a dataset that does not know its lines.
    pub fn resolved(&self, request: &Request) -> Result<Request, ImageError> {
        let mut scene = match self.left {
            Some(_) => request.scene.clone().with_edges(self.dataset)?,
            None => request.scene_of(self.dataset)?,
        };
        if let Some(factor) = scene.deformed {
            scene.deformed = Some(Magnification::Given(factor.number(&[self.field])?));
        }
        Ok(Request { scene, ..request.clone() })
    }

    /// Returns the parts of the body that are visible in a view.
    ///
    /// # Errors
    /// Fields that are no displacements, a dataset that does not know its lines, an engine that
    /// does not draw deformed bodies.
    pub fn body(
        &self,
        scene: &SceneRequest,
        view: &View,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'a>, ImageError> {
        let deformed = scene.deformed.filter(|_| self.left.is_none());
        let factor = deformed.map(|factor| factor.number(&[self.field])).transpose()?;
        let Some(factor) = factor else {
            return Ok(BodyView::new(self.field, *view, self.lines(scene)?));
        };
        self.deformed_body(scene, &Deformation::new(self.field, factor)?.seen(view), engine)
    }

    /// Returns the parts of the body that are visible in a view of the deformed plane.
    pub(super) fn deformed_body(
        &self,
        scene: &SceneRequest,
        view: &DeformedView<'a>,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'a>, ImageError> {
        let lines = self.lines(scene)?;
        engine.check_deformed()?;
        Ok(BodyView::deformed(view, lines, engine.watcher)?)
    }

    /// The values, each the mean of so many samples.
    ///
    /// # Errors
    /// A quantity that the field does not have; what the engine or the samples do not fit; a
    /// watcher that stops it.
    pub fn values(
        &self,
        body: &BodyView<'_>,
        samples: Samples,
        engine: &Engine<'_>,
    ) -> Result<PixelValues, ImageError> {
        let draw = &mut |input: DrawingInput<'_>, samples| engine.draw(input, samples);
        self.values_by(body, samples, draw, engine.watcher)
    }

    /// The values, where `evaluate` computes those of the undeformed body in a view.
    ///
    /// # Errors
    /// As [`Self::values`].
    pub fn values_by(
        &self,
        body: &BodyView<'_>,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let minus = self.minus();
        let refused = match (&minus, body.factor(), self.shown.quantity()) {
            _ if samples == Samples::CENTER => None,
            (Some(_), ..) => Some("differences are"),
            (_, Some(_), _) => Some("the deformed plate is"),
            (.., None) => Some("values of cells are"),
            (.., Some(quantity)) if body.lines != MirrorLines::default() => {
                return self.means_of_whole(body, quantity, samples, evaluate, watcher);
            }
            _ => None,
        };
        if let Some(what) = refused {
            return Err(ImageErrorKind::Samples(what).into());
        }
        match minus {
            Some(minus) => Ok(minus.draw(body.view(), watcher)?),
            None => self.parts(body, samples, evaluate, watcher),
        }
    }

    /// The values of the body and its images.
    fn parts(
        &self,
        body: &BodyView<'_>,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let field = self.field;
        whole::draw(field, body, &self.shown, &mut |BodyPart { view, points, .. }, shown| {
            Ok(match (points, shown) {
                (Some(points), shown) => deformed::draw(points, shown, watcher)?,
                (None, DisplayedQuantity::Cells(_, values)) => {
                    PixelValues::of_cells(values, field, view)
                }
                (None, DisplayedQuantity::Quantity(quantity)) => {
                    evaluate(DrawingInput { field, view, quantity }, samples)?
                }
            })
        })
    }

    /// The means of samples of the whole of a body that is mirrored.
    fn means_of_whole(
        &self,
        body: &BodyView<'_>,
        quantity: &Quantity,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let (field, view) = (self.field, body.view());
        let finer = view.finer(samples.side())?;
        let [columns, rows] = finer.pixels.map(u64::from);
        if columns * rows > MOST_SAMPLES {
            return Err(ImageErrorKind::MirroredSamples.into());
        }
        let finer = BodyView::new(field, finer, body.lines);
        let drawn = self.parts(&finer, Samples::CENTER, evaluate, watcher)?;
        let input = DrawingInput { field, view, quantity };
        Ok(with_raster!(&drawn.values, raster => averaged(input, samples, raster, &drawn)))
    }

    /// Tells of pixels without values, of so many, and of a quantity that is infinite everywhere.
    pub fn tell_values(&self, values: &PixelValues, engine: &Engine<'_>) {
        engine.tell_undefined(&self.name, values.undefined(), self.shown.quantity().is_none());
        let statistics = values.values.statistics();
        if statistics.finite == 0 && statistics.infinite > 0 {
            engine.tell(Notice::Infinite(self.name.clone()));
        }
    }

    /// The colours of the image for it alone.
    ///
    /// # Errors
    /// A map that there is not; a watcher that stops the search for the range.
    pub fn coloring(
        &self,
        body: &BodyView<'_>,
        colors: &ColorOptions,
        values: &PixelValues,
        watcher: &dyn Watcher,
    ) -> Result<ColorMapping, ImageError> {
        let style = self.style(colors, values)?;
        let span = self.span(body, values, &style, watcher)?;
        Ok(ColorMapping { style, span, ends: None })
    }

    /// The way values become colours, except for the range.
    ///
    /// # Errors
    /// A map that there is not.
    pub fn style(&self, colors: &ColorOptions, values: &PixelValues) -> Result<Style, MapError> {
        let Some(minus) = self.minus() else {
            let map = colors.map(self.shown.quantity())?;
            return Ok(colors.style_of([(&*self.shown, &values.values)], map));
        };
        minus.style(colors)
    }

    /// The range of the colours.
    ///
    /// # Errors
    /// A watcher that stops the search.
    pub fn span(
        &self,
        body: &BodyView<'_>,
        values: &PixelValues,
        style: &Style,
        watcher: &dyn Watcher,
    ) -> Result<ColorRange, RasterError> {
        match self.quantity() {
            Some(quantity) => value_span(self.field, body, quantity, values, style, watcher),
            None => Ok(self.pixel_span(values, style)),
        }
    }

    /// The range of the colours as far as the pixels tell.
    #[must_use]
    pub fn pixel_span(&self, values: &PixelValues, style: &Style) -> ColorRange {
        match self.left {
            Some(_) => difference::span(values, style),
            None => values.span(style, None),
        }
    }

    /// The labels of a figure: those that are asked for, else the words for what is shown; with the
    /// step and its load in the place of `{step}` and `{load}`.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn labels(&self, request: &Request) -> Result<Labels, DeformError> {
        let title = self.title(request)?;
        let [quantity, unit] = self.words();
        let labels = Labels { title, quantity, unit, ..Labels::default() };
        let labels = request.labels.applied(labels);
        let filled = |text: &str| self.filled(text, &request.scene);
        let (title, quantity) = (filled(&labels.title), filled(&labels.quantity));
        Ok(Labels { title, quantity, ..labels })
    }

    /// The title of a figure: as it is asked for, else that of the dataset, with the step of a
    /// series, the part, and the factor of the deformed body.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn title(&self, request: &Request) -> Result<String, DeformError> {
        let scene = &request.scene;
        if let Some(title) = &request.labels.title {
            return Ok(self.filled(title, scene));
        }
        let mut title = of_step(self.dataset, scene.subject.step_of(self.dataset));
        let mut add = |text: String| title = format!("{title} ({text})").trim_start().to_owned();
        if let Some(part) = &scene.subject.part {
            add(format!("{part} only"));
        }
        if let Some(factor) = scene.deformed {
            add(words(factor.number(&[self.field])?));
        }
        Ok(self.filled(&title, scene))
    }

    /// A text with the step of a series and its load in the place of `{step}` and `{load}`.
    fn filled(&self, text: &str, scene: &SceneRequest) -> String {
        if self.dataset.steps.len() < 2 {
            return text.to_owned();
        }
        let step = scene.subject.step_of(self.dataset).to_string();
        text.replace("{step}", &step).replace("{load}", &trimmed(self.field.step.load))
    }
}

/// A dataset's title with the step, if there are several, and its load, if loads differ.
#[must_use]
pub fn of_step(dataset: &Dataset, step: usize) -> String {
    let mut title = dataset.title.clone();
    let Some(shown) = dataset.steps.get(step).filter(|_| dataset.steps.len() > 1) else {
        return title;
    };
    let gap = if title.is_empty() { "" } else { ", " };
    let _ = write!(title, "{gap}step {step}");
    if dataset.steps.iter().any(|other| other.load != shown.load) {
        let _ = write!(title, ", load {}", trimmed(shown.load));
    }
    title
}

/// The means over the pixels of an image of samples, whose values are given.
fn averaged<T: RasterValue>(
    input: DrawingInput<'_>,
    samples: Samples,
    raster: &Raster<T>,
    PixelValues { without, by, .. }: &PixelValues,
) -> PixelValues
where
    RasterValues: From<Raster<T>>,
{
    let image = SampleImage { raster, undefined: without };
    PixelValues::averaged(Means::of(input.view, input.quantity, samples, image), input, by)
}

/// A box around all that a scene shows of a field, deformed or not.
///
/// # Errors
/// A field that is no displacement, a factor that is too large, lines that nobody knows.
pub fn scene_bounds(
    dataset: &Dataset,
    field: &Field<'_>,
    scene: &SceneRequest,
) -> Result<Rect, ImageError> {
    let lines = MirrorLines::of(scene.mirror.as_ref(), dataset)?;
    let Some(factor) = scene.deformed else { return Ok(lines.whole(field.domain.bounds)) };
    let factor = factor.number(&[field])?;
    let bounds = |sign: f64| deformed::bounds(field, sign * factor, scene.outline);
    Ok(lines.whole_of(bounds)?)
}
