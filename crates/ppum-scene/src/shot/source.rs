//! Fields that images are made of, and what is said of them.

use std::fmt::Write as _;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::text::trimmed;
use ppum::vec2::Rect;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{FigureStyle, Labels};
use ppum_render::deform::{DeformError, Deformation, DeformedView};
use ppum_render::picture::Style;
use ppum_render::range::ColorRange;
use ppum_render::view::View;

use super::drawn::RenderedImage;
use super::error::ImageError;
use crate::body::{BodyView, whole_box};
use crate::colors::{ColorOptions, MapError};
use crate::deformed::{self, words};
use crate::difference::{self, DifferenceSide, FieldDifference};
use crate::drawing::{DisplayedQuantity, PixelValues};
use crate::engine::Engine;
use crate::mirror::{MirrorError, MirrorLines};
use crate::request::Request;
use crate::scene::{DisplayError, SceneRequest, default_quantity, shown};

/// A field of a dataset, and what is subtracted from what is shown of it.
#[derive(Clone, Copy)]
pub struct FieldSource<'a> {
    /// The dataset.
    pub dataset: &'a Dataset,
    /// Its field, which is that of the request's subject,
    /// see [`Subject::apply`](crate::scene::Subject::apply).
    pub field: &'a Field<'a>,
    /// The subtrahend; with one the body is drawn undeformed.
    pub left: Option<DifferenceSide<'a>>,
}

/// The displayed quantity, with the text that requested it.
#[derive(Clone, Debug)]
pub struct QuantityRequest {
    /// The displayed quantity.
    pub shown: DisplayedQuantity,
    /// Its name in messages and files.
    pub name: String,
}

impl QuantityRequest {
    /// Parses the quantity of a scene for a field.
    ///
    /// # Errors
    /// A text that means nothing for the field.
    pub fn new(scene: &SceneRequest, field: &Field<'_>) -> Result<Self, DisplayError> {
        let text = scene.quantity.as_deref().unwrap_or(default_quantity(field));
        let shown = shown(text, field)?;
        Ok(Self { name: shown.name(text), shown })
    }
}

impl<'a> FieldSource<'a> {
    /// A field without anything on the left.
    #[must_use]
    pub fn of(dataset: &'a Dataset, field: &'a Field<'a>) -> Self {
        Self { dataset, field, left: None }
    }

    /// The difference, if something is subtracted from what is shown.
    #[must_use]
    pub fn minus(self, shown: &'a DisplayedQuantity) -> Option<FieldDifference<'a>> {
        let right = DifferenceSide { field: self.field, shown };
        self.left.map(|left| FieldDifference { right, left })
    }

    /// The words for what is shown, or for the difference, and the unit.
    #[must_use]
    pub fn words(self, shown: &'a DisplayedQuantity) -> [String; 2] {
        let minus = self.minus(shown);
        minus.map_or_else(|| shown.words(self.field), |minus| minus.words())
    }

    /// The way values become colours, except for the range.
    ///
    /// # Errors
    /// A map that there is not.
    pub fn style(
        self,
        shown: &'a DisplayedQuantity,
        colors: &ColorOptions,
        drawn: &PixelValues,
    ) -> Result<Style, MapError> {
        match self.minus(shown) {
            Some(minus) => minus.style(colors),
            None => Ok(colors.style_of([(shown, &drawn.values)], colors.map(shown.quantity())?)),
        }
    }

    /// The range of the colours as far as the pixels tell.
    #[must_use]
    pub fn pixel_span(self, drawn: &PixelValues, style: &Style) -> ColorRange {
        match self.left {
            Some(_) => difference::span(drawn, style),
            None => drawn.span(style, None),
        }
    }

    /// The lines at which it is mirrored; none if nobody asks for the whole.
    ///
    /// # Errors
    /// A dataset that does not know its lines; differences, which are not mirrored.
    pub fn lines(self, scene: &SceneRequest) -> Result<MirrorLines, MirrorError> {
        let Some(mirror) = &scene.mirror else { return Ok(MirrorLines::default()) };
        match () {
            () if self.left.is_some() => Err(MirrorError::Difference),
            () => {
                let edges = mirror.edges(self.dataset)?;
                Ok(MirrorLines::new(&edges, &self.dataset.domain.body_bounds()))
            }
        }
    }

    /// The scene with the edges named at which it is mirrored.
    ///
    /// # Errors
    /// As [`Self::lines`].
    pub fn settled(self, scene: SceneRequest) -> Result<SceneRequest, MirrorError> {
        self.lines(&scene)?;
        let mirror = scene.mirror.as_ref().map(|mirror| mirror.settled(self.dataset));
        Ok(SceneRequest { mirror: mirror.transpose()?, ..scene })
    }

    /// The box of what a scene shows of it, the whole of a body that is mirrored.
    #[must_use]
    pub fn bounds(self, scene: &SceneRequest) -> Rect {
        self.lines(scene).unwrap_or_default().whole(self.field.domain.bounds)
    }

    /// Returns the part of the field that is visible in a view.
    ///
    /// # Errors
    /// Fields that are no displacements, a dataset that does not know its lines, an engine that
    /// does not draw deformed bodies.
    pub fn seen(
        self,
        scene: &SceneRequest,
        view: &View,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'a>, ImageError> {
        let deformed = scene.deformed.filter(|_| self.left.is_none());
        let factor = deformed.map(|factor| factor.number(&[self.field])).transpose()?;
        let Some(factor) = factor else {
            return Ok(BodyView::new(self.field, *view, self.lines(scene)?));
        };
        self.moved(scene, &Deformation::new(self.field, factor)?.seen(view), engine)
    }

    /// Returns the part of the field that is visible in a view of the deformed plane.
    pub(crate) fn moved(
        self,
        scene: &SceneRequest,
        view: &DeformedView<'a>,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'a>, ImageError> {
        let lines = self.lines(scene)?;
        engine.check_deformed()?;
        Ok(BodyView::deformed(view, lines, engine.watcher)?)
    }

    /// A box around all that a scene shows of it, deformed or not.
    ///
    /// # Errors
    /// A field that is no displacement, a factor that is too large, lines that nobody knows.
    pub fn seen_bounds(self, scene: &SceneRequest) -> Result<Rect, ImageError> {
        let (lines, field) = (self.lines(scene)?, self.field);
        let Some(factor) = scene.deformed else { return Ok(lines.whole(field.domain.bounds)) };
        let factor = factor.number(&[field])?;
        let bounds = |sign: f64| deformed::bounds(field, sign * factor, scene.outline);
        Ok(whole_box(&lines, bounds)?)
    }

    /// The labels of a figure: those that are asked for, else the words for what is shown; with the
    /// step and its load in the place of `{step}` and `{load}`.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn labels(
        self,
        shown: &DisplayedQuantity,
        request: &Request,
    ) -> Result<Labels, DeformError> {
        let title = title(self, request)?;
        let [quantity, unit] = FieldSource::words(self, shown);
        let labels = Labels { title, quantity, unit, ..Labels::default() };
        let labels = request.labels.applied(labels);
        let filled = |text: &str| self.filled(text, &request.scene);
        let (title, quantity) = (filled(&labels.title), filled(&labels.quantity));
        Ok(Labels { title, quantity, ..labels })
    }

    /// A text with the step of a series and its load in the place of `{step}` and `{load}`.
    fn filled(self, text: &str, scene: &SceneRequest) -> String {
        if self.dataset.steps.len() < 2 {
            return text.to_owned();
        }
        let step = scene.subject.step_of(self.dataset).to_string();
        text.replace("{step}", &step).replace("{load}", &trimmed(self.field.step.load))
    }

    /// The page of a shot.
    pub(crate) fn page(
        self,
        shot: RenderedImage,
        request: &Request,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<(Canvas, RenderedImage), ImageError> {
        let labels = design.map(|_| self.labels(&shot.shown, request)).transpose()?;
        Ok((shot.page(labels.unwrap_or_default(), design, engine)?, shot))
    }
}

/// The title of a figure: as it is asked for, else that of the dataset, with the step of a series,
/// the part, and the factor of the deformed body.
///
/// # Errors
/// Fields that are no displacements.
pub fn title(source: FieldSource<'_>, request: &Request) -> Result<String, DeformError> {
    if let Some(title) = &request.labels.title {
        return Ok(source.filled(title, &request.scene));
    }
    let (FieldSource { dataset, field, .. }, scene) = (source, &request.scene);
    let mut title = of_step(dataset, scene.subject.step_of(dataset));
    let mut add = |text: String| title = format!("{title} ({text})").trim_start().to_owned();
    if let Some(part) = &scene.subject.part {
        add(format!("{part} only"));
    }
    if let Some(factor) = scene.deformed {
        add(words(factor.number(&[field])?));
    }
    Ok(source.filled(&title, scene))
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
