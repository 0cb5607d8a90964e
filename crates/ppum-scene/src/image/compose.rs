//! Composition: values in colours, the layers over them, and the page that holds both.

use std::sync::Arc;

use ppum::crack::Crack;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, FigureError, FigureStyle, Labels, Panel};
use ppum_figure::figure::{bare, figure, lacks_legend, plot_area};
use ppum_figure::overlay::LegendEntry;
use ppum_render::image::Image;
use ppum_render::isoline::Isoline;
use ppum_render::picture::ColoredRaster;
use ppum_render::png::TextChunk;
use ppum_render::samples::Samples;
use ppum_render::view::{View, ViewError};

use super::body::BodyView;
use super::camera::{ImageSettings, LayoutInput};
use super::coloring::ColorMapping;
use super::engine::Engine;
use super::error::{ImageError, ImageErrorKind};
use super::layers::{LayerInput, Layers};
use super::notice::Notice;
use super::quantity::DisplayedQuantity;
use super::subject::ImageSubject;
use super::values::PixelValues;
use crate::request::Request;
use crate::request::colors::ColorOptions;
use crate::request::mirror::Mirror;
use crate::request::overlays::IsolineLevels;

/// An image with what lies over it.
#[derive(Debug)]
pub struct RenderedImage {
    /// The displayed quantity.
    pub shown: Arc<DisplayedQuantity>,
    /// Its name.
    pub name: String,
    /// The colours.
    pub picture: ColoredRaster,
    /// The layers over them.
    pub layers: Layers,
    /// The cracks where they are seen.
    pub cracks: Vec<Crack>,
    /// The device that computed the values.
    pub by: String,
    /// The number of pixels where the deformed body lies over itself.
    pub overlaps: usize,
    /// The edges at which the body is mirrored, if it is.
    pub mirrored: Option<String>,
    /// How many times its displacement the body is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The title of the dataset, and of a series the number of the step and its load.
    dataset: (String, Option<(usize, f64)>),
}

/// The page of an image as a request asks for it.
///
/// # Errors
/// A place that there is not; features that the field does not have; a range that does not fit; a
/// size without room; a watcher that stops it.
pub fn page(
    subject: &ImageSubject<'_>,
    request: &Request,
    engine: &Engine<'_>,
) -> Result<(Canvas, RenderedImage), ImageError> {
    let request = &subject.resolved(request)?;
    let ImageSettings { camera, design } =
        ImageSettings::new(request, &LayoutInput::of(subject, request)?)?;
    let body = camera.body(subject, &request.scene, engine)?;
    subject.image(request, &body, design.as_ref(), engine)?.page(
        subject,
        request,
        design.as_ref(),
        engine,
    )
}

/// The page of an image as a figure of a design, or bare without one, of the part of the plane
/// that a view shows.
///
/// # Errors
/// As [`page`].
pub fn page_of_view(
    subject: &ImageSubject<'_>,
    request: &Request,
    view: &View,
    design: Option<&FigureStyle>,
    engine: &Engine<'_>,
) -> Result<(Canvas, RenderedImage), ImageError> {
    let of_design = |design| view_in(subject, request, view, design);
    let view = design.map_or(Ok(*view), of_design)?;
    let image = subject.image_in(request, &view, design, engine)?;
    image.page(subject, request, design, engine)
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
/// A design without room.
pub fn view_in(
    subject: &ImageSubject<'_>,
    request: &Request,
    view: &View,
    design: &FigureStyle,
) -> Result<View, ImageError> {
    Ok(reshaped(view, plot_area(&subject.title(request)?, design)?)?)
}

impl ImageSubject<'_> {
    /// The image of it in a view.
    ///
    /// # Errors
    /// Features that the field does not have; a range that does not fit; a watcher that stops it.
    pub fn image_in(
        &self,
        request: &Request,
        view: &View,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<RenderedImage, ImageError> {
        let body = self.body(&request.scene, view, engine)?;
        self.image(request, &body, design, engine)
    }

    /// The image of a body, with colours for it alone.
    ///
    /// # Errors
    /// As [`Self::image_in`].
    pub fn image(
        &self,
        request: &Request,
        body: &BodyView<'_>,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<RenderedImage, ImageError> {
        let values = self.values(body, request.samples, engine)?;
        self.tell_values(&values, engine);
        let coloring = self.coloring(body, &request.scene.colors, &values, engine.watcher)?;
        self.compose(request, body, (&values, &coloring), design, engine)
    }

    /// The isolines of its quantity that an image of it in these colours has.
    ///
    /// # Errors
    /// As the steps that an image consists of; values of cells, which have none.
    pub fn isolines(
        &self,
        body: &BodyView<'_>,
        levels: &IsolineLevels,
        engine: &Engine<'_>,
    ) -> Result<Vec<Isoline>, ImageError> {
        let quantity = self.shown.quantity().ok_or(ImageErrorKind::NoIsolines)?;
        let values = self.values(body, Samples::CENTER, engine)?;
        let coloring = self.coloring(body, &ColorOptions::default(), &values, engine.watcher)?;
        let (picture, values) = (&coloring.picture(&values)?, &values.values);
        let input =
            LayerInput { subject: self, body, picture, values, design: None, has_bar: false };
        Ok(input.isolines(quantity, &input.levels(levels), engine.watcher)?)
    }

    /// The image of the values in colours, with its overlays. With the `design` of a figure
    /// cracks are drawn whatever is asked for.
    ///
    /// # Errors
    /// A range that does not fit; overlays that there are not; a watcher that stops it.
    pub fn compose(
        &self,
        request: &Request,
        body: &BodyView<'_>,
        (values, coloring): (&PixelValues, &ColorMapping),
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<RenderedImage, ImageError> {
        let (mut picture, scene) = (coloring.picture(values)?, &request.scene);
        let has_isolines = self.quantity().is_some() && scene.overlays.isolines.is_some();
        // isolines are found between the centres of pixels
        let centers = match has_isolines && values.opacity.is_some() {
            true => Some(self.values(body, Samples::CENTER, engine)?),
            false => None,
        };
        let (drawn, values) = (values, &centers.as_ref().unwrap_or(values).values);
        let has_bar = design.is_some_and(|design| design.bar != BarPlace::None);
        let input = LayerInput { subject: self, body, picture: &picture, values, design, has_bar };
        let layers = input.layers(scene, engine.watcher)?;
        layers.notices.iter().for_each(|notice| engine.tell(notice.clone()));
        if request.blank {
            blank(&mut picture.image);
        }
        let step = (scene.subject.step_of(self.dataset), self.field.step.load);
        let is_series = self.dataset.steps.len() > 1;
        Ok(RenderedImage {
            shown: Arc::clone(&self.shown),
            name: self.name.clone(),
            picture,
            layers,
            cracks: body.cracks(self.field),
            by: drawn.by.clone(),
            overlaps: drawn.overlap.len(),
            factor: body.factor(),
            mirrored: scene.mirror.as_ref().map(Mirror::to_string),
            dataset: (self.dataset.title.clone(), is_series.then_some(step)),
        })
    }
}

/// Leaves out the colours: the body is white.
fn blank(image: &mut Image) {
    let seen = image.rgba.as_chunks_mut::<4>().0.iter_mut().filter(|pixel| pixel[3] > 0);
    seen.for_each(|pixel| pixel[..3].fill(255));
}

impl RenderedImage {
    /// The panel of a figure with it.
    #[must_use]
    pub fn panel(&self, labels: Labels) -> Panel<'_> {
        let (layers, legend) = (self.layers.items.clone(), self.layers.legend.clone());
        let (picture, cracks) = (&self.picture, &self.cracks);
        Panel { picture, layers, legend, labels, cracks, bar_of: None }
    }

    /// Its page, and itself: a figure of a design, or bare without one.
    pub(super) fn page(
        self,
        subject: &ImageSubject<'_>,
        request: &Request,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<(Canvas, Self), ImageError> {
        let page = match design {
            None => self.bare(engine),
            Some(design) => self.figure(subject.labels(request)?, design, engine)?,
        };
        Ok((page, self))
    }

    /// The image without a figure around it.
    pub fn bare(&self, engine: &Engine<'_>) -> Canvas {
        tell_legend(&self.layers.legend, engine);
        bare(&self.picture, self.layers.items.clone())
    }

    fn figure(
        &self,
        labels: Labels,
        design: &FigureStyle,
        engine: &Engine<'_>,
    ) -> Result<Canvas, FigureError> {
        let panel = self.panel(labels);
        if lacks_legend(&panel, plot_area(&panel.labels.title, design)?, design) {
            tell_legend(&panel.legend, engine);
        }
        figure(panel, design)
    }

    /// The texts of a file with it, which shows something of some name.
    pub(super) fn description(&self, file: &str, name: &str) -> Vec<TextChunk> {
        let mut texts = self.picture.description(&self.dataset.0, file, name);
        texts.push(("ppum:backend".to_owned(), self.by.clone()));
        texts
    }

    /// The texts of its file: what it shows, of which dataset, and what drew it.
    #[must_use]
    pub fn texts(&self, file: &str) -> Vec<TextChunk> {
        let mut texts = self.description(file, &self.name);
        if let DisplayedQuantity::Quantity(Quantity::Formula(formula)) = &*self.shown {
            texts.push(("ppum:formula".to_owned(), one_line(formula.formula().text())));
        }
        texts
    }

    /// Returns the factor of deformation and the step of a series as further texts of the file.
    #[must_use]
    pub fn notes(&self) -> Vec<TextChunk> {
        let factor = self.factor.map(|factor| ("ppum:deformed", format!("{factor:?}")));
        let mirrored = self.mirrored.clone().map(|edges| ("ppum:mirror", edges));
        let step = self.dataset.1.map(|(step, load)| {
            [("ppum:step", step.to_string()), ("ppum:load", format!("{load:?}"))]
        });
        let all = factor.into_iter().chain(mirrored).chain(step.into_iter().flatten());
        all.map(|(key, text)| (key.to_owned(), text)).collect()
    }
}

/// Tells what a legend says that is nowhere drawn.
pub(super) fn tell_legend(legend: &[LegendEntry], engine: &Engine<'_>) {
    if !legend.is_empty() {
        engine.tell(Notice::NoLegend(legend.iter().map(|entry| entry.label.clone()).collect()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::overlays::{IsolineLevels, Overlay, Overlays, SPACING};
    use crate::request::scene::SceneRequest;
    use ppum::field::Field;
    use ppum_figure::canvas::CanvasItem;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    use crate::request::magnification::Magnification;

    /// Widths of all lines of a page, and sizes of its letters.
    fn widths(page: &Canvas) -> Vec<f64> {
        let of = |item: &CanvasItem| match item {
            CanvasItem::Line { pen, .. } => {
                vec![pen.width, pen.halo.map_or(0.0, |h| h.width), pen.dashes.map_or(0.0, |d| d[0])]
            }
            CanvasItem::Text(line) => vec![line.size],
            CanvasItem::Inset { canvas, .. } => widths(canvas),
            _ => Vec::new(),
        };
        page.items.iter().flat_map(of).collect()
    }

    /// Strokes and letters, those over the image too, are lengths on paper: the same at any
    /// number of pixels per inch.
    #[test]
    fn strokes_are_lengths_on_paper() {
        for seed in 0..4 {
            let recipe = Recipe { components: 2, ..Recipe::random(seed) };
            let dataset = Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let overlays = Overlays {
                shown: vec![Overlay::Patches, Overlay::Points, Overlay::Centers, Overlay::Rings],
                no_cracks: false,
                isolines: Some(IsolineLevels::Count(4)),
                level_labels: true,
                arrows: Some(SPACING),
                crosses: Some(SPACING),
            };
            let deformed = (seed % 2 == 1).then_some(Magnification::Given(0.02));
            let scene = SceneRequest {
                overlays,
                deformed,
                quantity: Some("ux".into()),
                ..SceneRequest::default()
            };
            let on_paper = |dpi: f64| {
                let design = FigureStyle::inches([3.4, 2.6], dpi);
                let view = View::fit(dataset.domain.bounds, [340, 260]).unwrap();
                let subject = ImageSubject::new(&dataset, &field, Some("ux")).unwrap();
                let (request, engine) = (scene.drawn().into(), Engine::default());
                let made = page_of_view(&subject, &request, &view, Some(&design), &engine);
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
