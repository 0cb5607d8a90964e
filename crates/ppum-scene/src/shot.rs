//! A picture of a request from a view: its values, their colours, what lies over them, its page.

use std::fmt::Write as _;

use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum::text::trimmed;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, Design, FigureError, Labels, Panel};
use ppum_figure::figure::{bare, figure, lacks_legend, plot_area};
use ppum_figure::overlay::LegendEntry;
use ppum_render::RenderError;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::image::Image;
use ppum_render::picture::{Picture, Style};
use ppum_render::png::Text;
use ppum_render::range::{RangeError, ValueSpan};
use ppum_render::samples::Samples;
use ppum_render::view::{View, ViewError};

use crate::colors::{Colors, MapError};
use crate::deformed::{self, words};
use crate::drawing::{BodyView, DrawingInput, Drawn, Shown};
use crate::engine::{Engine, EngineError};
use crate::layers::{Ground, Layers, LayersError};
use crate::minus::{self, Minus, Side};
use crate::notice::Notice;
use crate::range;
use crate::request::Request;
use crate::scene::{Scene, ShownError, default_quantity, shown};
use crate::shared::Coloring;

/// A picture with what lies over it.
#[derive(Debug)]
pub struct Shot {
    /// What is shown.
    pub shown: Shown,
    /// Its name.
    pub name: String,
    /// The colours.
    pub picture: Picture,
    /// What lies over them.
    pub layers: Layers,
    /// The cracks where they are seen.
    pub cracks: Vec<Crack>,
    /// What computed the values.
    pub by: String,
    /// The number of pixels where the deformed plate lies over itself.
    pub overlaps: usize,
    /// How many times its displacement the plate is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The title of the dataset, and of a series the number of the step and its load.
    dataset: (String, Option<(usize, f64)>),
}

/// The reason why there is no such picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShotError {
    /// Nothing that could be shown.
    #[error(transparent)]
    Shown(#[from] ShownError),
    /// The quantity, isolines, or a watcher that stopped it.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The backend.
    #[error(transparent)]
    Engine(EngineError),
    /// Means of samples where there are none.
    #[error("samples: {0} drawn at the centres of pixels; leave samples out")]
    Samples(&'static str),
    /// A frame of an animation with more pixels than memory is meant for.
    #[error("frames of {}x{} pixels do not fit into memory; choose a smaller size", .0[0], .0[1])]
    TooLarge([u32; 2]),
    /// The deformed plate.
    #[error(transparent)]
    Deform(#[from] DeformError),
    /// The colour map.
    #[error(transparent)]
    Colormap(#[from] MapError),
    /// The range of the colours.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The overlays.
    #[error(transparent)]
    Layers(#[from] Box<LayersError>),
    /// The page.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The view.
    #[error(transparent)]
    View(#[from] ViewError),
}

impl From<EngineError> for ShotError {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Render(error) => Self::Render(error),
            other => Self::Engine(other),
        }
    }
}

/// What a picture is made of: what is shown of a field, and where it is seen.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    /// The dataset.
    pub dataset: &'a Dataset,
    /// Its field.
    pub field: &'a Field<'a>,
    /// What is shown.
    pub shown: &'a Shown,
    /// Its name in notices and in the file.
    pub name: &'a str,
    /// Where it is seen.
    pub seen: &'a BodyView<'a>,
    /// What is subtracted, in the plate as it was.
    pub left: Option<Side<'a>>,
}

impl<'a> Input<'a> {
    fn minus(&self) -> Option<Minus<'a>> {
        let right = Side { field: self.field, shown: self.shown };
        self.left.map(|left| Minus { right, left })
    }

    /// The values, each the mean of so many samples.
    ///
    /// # Errors
    /// A quantity that the field does not have; what the engine or the samples do not fit; a
    /// watcher that stops it.
    pub fn values(&self, samples: Samples, engine: &Engine<'_>) -> Result<Drawn, ShotError> {
        let Self { field, shown, seen, .. } = *self;
        let centers = |what| match samples {
            Samples::CENTER => Ok(()),
            _ => Err(ShotError::Samples(what)),
        };
        Ok(match (self.minus(), seen, shown) {
            (Some(minus), seen, _) => {
                centers("differences are")?;
                minus.draw(seen.view(), engine.watcher)?.drawn
            }
            (None, BodyView::Plate(view), Shown::Quantity(quantity)) => {
                engine.draw(DrawingInput { field, view, quantity }, samples)?
            }
            (None, BodyView::Plate(view), Shown::Cells(_, values)) => {
                centers("values of cells are")?;
                Drawn::of_cells(values, field, view)
            }
            (None, BodyView::Moved(points), shown) => {
                centers("the deformed plate is")?;
                engine.check_deformed()?;
                deformed::draw(points, shown, engine.watcher)?
            }
        })
    }

    /// Tells of pixels without values, of so many, and of a quantity that is infinite everywhere.
    pub fn tell_values(&self, drawn: &Drawn, engine: &Engine<'_>) {
        engine.tell_undefined(self.name, drawn.undefined(), self.shown.quantity().is_none());
        let statistics = drawn.values.statistics();
        if statistics.finite == 0 && statistics.infinite > 0 {
            engine.tell(Notice::Infinite(self.name.to_owned()));
        }
    }

    /// The colours of the picture for it alone.
    ///
    /// # Errors
    /// A map that there is not; a watcher that stops the search for the range.
    pub fn coloring(
        &self,
        colors: &Colors,
        drawn: &Drawn,
        engine: &Engine<'_>,
    ) -> Result<Coloring, ShotError> {
        let quantity = self.shown.quantity();
        let style = match self.minus() {
            Some(minus) => minus.style(colors)?,
            None => colors.style_of([(self.shown, &drawn.values)], colors.map(quantity)?),
        };
        let span = self.span(drawn, &style, engine)?;
        Ok(Coloring { style, span, ends: None })
    }

    /// The range of the colours.
    ///
    /// # Errors
    /// A watcher that stops the search.
    pub fn span(
        &self,
        drawn: &Drawn,
        style: &Style,
        engine: &Engine<'_>,
    ) -> Result<ValueSpan, RenderError> {
        Ok(match (self.left, self.shown.quantity()) {
            (Some(_), _) => minus::span(drawn, style),
            (None, None) => drawn.span(style, None),
            (None, Some(quantity)) => {
                range::value_span(self.field, self.seen, quantity, drawn, style, engine.watcher)?
            }
        })
    }

    /// The picture with colours for it alone.
    ///
    /// # Errors
    /// As the steps that it consists of.
    pub fn draw(
        &self,
        request: &Request,
        design: Option<&Design>,
        engine: &Engine<'_>,
    ) -> Result<Shot, ShotError> {
        let drawn = self.values(request.samples, engine)?;
        self.tell_values(&drawn, engine);
        let coloring = self.coloring(&request.scene.colors, &drawn, engine)?;
        self.shot(request, &drawn, &coloring, design, engine)
    }

    /// The picture of the values in colours, with its overlays. With the `design` of a figure
    /// cracks are drawn whatever is asked for.
    ///
    /// # Errors
    /// A range that does not fit; overlays that there are not; a watcher that stops it.
    pub fn shot(
        &self,
        request: &Request,
        drawn: &Drawn,
        coloring: &Coloring,
        design: Option<&Design>,
        engine: &Engine<'_>,
    ) -> Result<Shot, ShotError> {
        let mut picture = coloring.picture(drawn)?;
        let layers = self.layers(&request.scene, drawn, &picture, design, engine)?;
        layers.notices.iter().for_each(|notice| engine.tell(notice.clone()));
        let step = request.scene.subject.step_of(self.dataset);
        let step = Some((step, self.field.step.load));
        if request.blank {
            blank(&mut picture.image);
        }
        Ok(Shot {
            shown: self.shown.clone(),
            name: self.name.to_owned(),
            picture,
            layers,
            cracks: self.seen.cracks(self.field),
            by: drawn.by.clone(),
            overlaps: drawn.overlap.len(),
            factor: self.seen.moved().map(|points| points.view.factor()),
            dataset: (self.dataset.title.clone(), step.filter(|_| self.dataset.steps.len() > 1)),
        })
    }

    fn layers(
        &self,
        scene: &Scene,
        drawn: &Drawn,
        picture: &Picture,
        design: Option<&Design>,
        engine: &Engine<'_>,
    ) -> Result<Layers, ShotError> {
        let Self { dataset, field, .. } = *self;
        // isolines are found of one field, and between the centres of pixels
        let quantity = self.shown.quantity().filter(|_| self.left.is_none());
        let centers = match quantity {
            Some(quantity) if drawn.opacity.is_some() && scene.overlays.isolines.is_some() => {
                let job = DrawingInput { field, view: &drawn.view, quantity };
                Some(engine.draw(job, Samples::CENTER)?)
            }
            _ => None,
        };
        let values = &centers.as_ref().unwrap_or(drawn).values;
        let has_bar = design.is_some_and(|design| design.bar != BarPlace::None);
        let ground = Ground { dataset, field, quantity, picture, values, design, has_bar };
        let layers = scene.overlays.layers(ground, self.seen, scene.outline, engine.watcher);
        Ok(layers.map_err(Box::new)?)
    }
}

/// Leaves out the colours: the plate is white.
fn blank(image: &mut Image) {
    let seen = image.rgba.as_chunks_mut::<4>().0.iter_mut().filter(|pixel| pixel[3] > 0);
    seen.for_each(|pixel| pixel[..3].fill(255));
}

/// A field of a dataset, and what is subtracted from what is shown of it.
#[derive(Clone, Copy)]
pub struct FieldSource<'a> {
    /// The dataset.
    pub dataset: &'a Dataset,
    /// Its field, which is that of the request's subject,
    /// see [`Subject::apply`](crate::scene::Subject::apply).
    pub field: &'a Field<'a>,
    /// What is subtracted; the plate is as it was then.
    pub left: Option<Side<'a>>,
}

/// What is shown, by the text that asked for it.
#[derive(Clone, Debug)]
pub struct Asked {
    /// What is shown.
    pub shown: Shown,
    /// Its name in messages and files.
    pub name: String,
}

impl Asked {
    /// What a scene shows of a field.
    ///
    /// # Errors
    /// A text that means nothing for the field.
    pub fn new(scene: &Scene, field: &Field<'_>) -> Result<Self, ShownError> {
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

    /// What a picture of it is made of.
    #[must_use]
    pub fn input<'b>(self, asked: &'b Asked, seen: &'b BodyView<'b>) -> Input<'b>
    where
        'a: 'b,
    {
        let Self { dataset, field, left } = self;
        Input { dataset, field, shown: &asked.shown, name: &asked.name, seen, left }
    }

    /// What is seen of it in a view.
    pub(crate) fn seen(
        self,
        scene: &Scene,
        view: &View,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'a>, ShotError> {
        let deformed = scene.deformed.filter(|_| self.left.is_none());
        let factor = deformed.map(|factor| factor.number(&[self.field])).transpose()?;
        let Some(factor) = factor else { return Ok(BodyView::Plate(*view)) };
        engine.check_deformed()?;
        Ok(BodyView::Moved(
            Deformation::new(self.field, factor)?.seen(view).points(engine.watcher)?,
        ))
    }

    /// The labels of a figure: those that are asked for, else the words for what is shown; with the
    /// step and its load in the place of `{step}` and `{load}`.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn labels(self, shown: &Shown, request: &Request) -> Result<Labels, DeformError> {
        let title = title(self, request)?;
        let [quantity, unit] = match self.left {
            None => shown.words(self.field),
            Some(left) => Minus { right: Side { field: self.field, shown }, left }.words(),
        };
        let labels = Labels { title, quantity, unit, ..Labels::default() };
        let labels = request.labels.applied(labels);
        let filled = |text: &str| self.filled(text, &request.scene);
        let (title, quantity) = (filled(&labels.title), filled(&labels.quantity));
        Ok(Labels { title, quantity, ..labels })
    }

    /// A text with the step of a series and its load in the place of `{step}` and `{load}`.
    fn filled(self, text: &str, scene: &Scene) -> String {
        if self.dataset.steps.len() < 2 {
            return text.to_owned();
        }
        let step = scene.subject.step_of(self.dataset).to_string();
        text.replace("{step}", &step).replace("{load}", &trimmed(self.field.step.load))
    }

    /// The page of a shot.
    pub(crate) fn page(
        self,
        shot: Shot,
        request: &Request,
        design: Option<&Design>,
        engine: &Engine<'_>,
    ) -> Result<(Canvas, Shot), ShotError> {
        let labels = design.map(|_| self.labels(&shot.shown, request)).transpose()?;
        Ok((shot.page(labels.unwrap_or_default(), design, engine)?, shot))
    }
}

/// Draws a picture from a view.
///
/// # Errors
/// What the field does not have; a range that does not fit; a watcher that stops it.
pub fn shot(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: Option<&Design>,
    engine: &Engine<'_>,
) -> Result<Shot, ShotError> {
    let asked = Asked::new(&request.scene, source.field)?;
    let seen = source.seen(&request.scene, view, engine)?;
    source.input(&asked, &seen).draw(request, design, engine)
}

/// The view of the same part of the plane, or more where the shapes differ, on other pixels.
///
/// # Errors
/// As [`View::new`].
pub fn reshaped(view: &View, pixels: [u32; 2]) -> Result<View, ViewError> {
    let aspect = f64::from(pixels[0]) / f64::from(pixels[1].max(1));
    View::new(view.center, view.width.max(view.height() * aspect), pixels)
}

/// The view of a figure of a design that shows the part of the plane that a view shows, or more.
///
/// # Errors
/// As [`page`].
pub fn view_in(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: &Design,
) -> Result<View, ShotError> {
    Ok(reshaped(view, plot_area(&title(source, request)?, design)?)?)
}

/// The page of a picture as a figure of a design, or bare without one, of the part of the plane
/// that a view shows.
///
/// # Errors
/// As [`shot`]; a design without room.
pub fn page(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: Option<&Design>,
    engine: &Engine<'_>,
) -> Result<(Canvas, Shot), ShotError> {
    let of_design = |design| view_in(source, request, view, design);
    let view = design.map_or(Ok(*view), of_design)?;
    page_in(source, request, &view, design, engine)
}

/// The page of a picture, which is that of the view, pixel for pixel: it need not fill the
/// design's room.
///
/// # Errors
/// As [`page`]; a picture that is larger than its room.
pub fn page_in(
    source: FieldSource<'_>,
    request: &Request,
    view: &View,
    design: Option<&Design>,
    engine: &Engine<'_>,
) -> Result<(Canvas, Shot), ShotError> {
    let seen = source.seen(&request.scene, view, engine)?;
    page_seen(source, request, &seen, design, engine)
}

/// The page of a picture of what is seen.
///
/// # Errors
/// As [`page_in`].
pub fn page_seen(
    source: FieldSource<'_>,
    request: &Request,
    seen: &BodyView<'_>,
    design: Option<&Design>,
    engine: &Engine<'_>,
) -> Result<(Canvas, Shot), ShotError> {
    let asked = Asked::new(&request.scene, source.field)?;
    let shot = source.input(&asked, seen).draw(request, design, engine)?;
    source.page(shot, request, design, engine)
}

/// The title of a figure: as it is asked for, else that of the dataset, with the step of a series,
/// the part, and the factor of the deformed plate.
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

impl Shot {
    /// The panel of a figure with it.
    #[must_use]
    pub fn panel(&self, labels: Labels) -> Panel<'_> {
        let (layers, legend) = (self.layers.items.clone(), self.layers.legend.clone());
        let (picture, cracks) = (&self.picture, &self.cracks);
        Panel { picture, layers, legend, labels, cracks, bar_of: None }
    }

    /// Its page: a figure of a design, or bare without one.
    ///
    /// # Errors
    /// A design without room.
    pub fn page(
        &self,
        labels: Labels,
        design: Option<&Design>,
        engine: &Engine<'_>,
    ) -> Result<Canvas, FigureError> {
        let panel = self.panel(labels);
        let Some(design) = design else {
            tell_legend(&panel.legend, engine);
            return Ok(bare(panel.picture, panel.layers));
        };
        if lacks_legend(&panel, plot_area(&panel.labels.title, design)?, design) {
            tell_legend(&panel.legend, engine);
        }
        figure(panel, design)
    }

    /// The texts of its file: what it shows, of which dataset, and what drew it.
    #[must_use]
    pub fn texts(&self, file: &str) -> Vec<Text> {
        let mut texts = self.picture.description(&self.dataset.0, file, &self.name);
        texts.push(("ppum:backend".to_owned(), self.by.clone()));
        if let Shown::Quantity(Quantity::Formula(formula)) = &self.shown {
            texts.push(("ppum:formula".to_owned(), one_line(formula.formula().text())));
        }
        texts
    }

    /// What was done to the plate, and the step of a series, as more texts of its file.
    #[must_use]
    pub fn notes(&self) -> Vec<Text> {
        let factor = self.factor.map(|factor| ("ppum:deformed".to_owned(), format!("{factor:?}")));
        let step = self.dataset.1.map(|(step, load)| {
            [
                ("ppum:step".to_owned(), step.to_string()),
                ("ppum:load".to_owned(), format!("{load:?}")),
            ]
        });
        factor.into_iter().chain(step.into_iter().flatten()).collect()
    }
}

/// Tells what a legend says that is nowhere drawn.
pub fn tell_legend(legend: &[LegendEntry], engine: &Engine<'_>) {
    if !legend.is_empty() {
        let entries = legend.iter().map(|entry| entry.label.clone()).collect();
        engine.tell(Notice::NoLegend(entries));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::overlays::{Levels, Overlay, Overlays, SPACING};
    use ppum_figure::canvas::Item;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    use crate::deformed::Factor;

    /// Widths of all lines of a page, and sizes of its letters.
    fn widths(page: &Canvas) -> Vec<f64> {
        let of = |item: &Item| match item {
            Item::Line { pen, .. } => {
                vec![pen.width, pen.halo.map_or(0.0, |h| h.width), pen.dashes.map_or(0.0, |d| d[0])]
            }
            Item::Text(line) => vec![line.size],
            Item::Inset { canvas, .. } => widths(canvas),
            _ => Vec::new(),
        };
        page.items.iter().flat_map(of).collect()
    }

    /// Strokes and letters, those over the picture too, are lengths on paper: the same at any
    /// number of pixels per inch.
    #[test]
    fn strokes_are_lengths_on_paper() {
        for seed in 0..4 {
            let recipe = Recipe { components: 2, ..Recipe::random(seed) };
            let dataset = Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let overlays = Overlays {
                shown: vec![Overlay::Patches, Overlay::Points, Overlay::Centers, Overlay::Rings],
                isolines: Some(Levels::Count(4)),
                level_labels: true,
                arrows: Some(SPACING),
                crosses: Some(SPACING),
            };
            let deformed = (seed % 2 == 1).then_some(Factor::Given(0.02));
            let scene =
                Scene { overlays, deformed, quantity: Some("ux".into()), ..Scene::default() };
            let on_paper = |dpi: f64| {
                let design = Design::inches([3.4, 2.6], dpi);
                let view = View::fit(dataset.domain.bounds, [340, 260]).unwrap();
                let (source, request) = (FieldSource::of(&dataset, &field), scene.drawn().into());
                let made = page(source, &request, &view, Some(&design), &Engine::default());
                let mut all = widths(&made.unwrap().0);
                all.iter_mut().for_each(|width| *width *= 72.0 / dpi);
                all.sort_by(f64::total_cmp);
                all.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
                all
            };
            let [screen, print] = [96.0, 300.0].map(on_paper);
            assert!(screen.len() > 3, "{screen:?}");
            let is_in = |width: &f64| print.iter().any(|other| (other - width).abs() < 1e-9);
            assert!(screen.iter().all(is_in), "seed {seed}: {screen:?} {print:?}");
        }
    }
}
