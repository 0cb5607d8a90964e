//! From values to colours to an image, step by step.

use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_figure::figure::{BarPlace, FigureStyle};
use ppum_render::RasterError;
use ppum_render::image::Image;
use ppum_render::isoline::Isoline;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::ColorRange;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::samples::{Means, SampleImage, Samples};

use super::drawn::RenderedImage;
use super::error::ImageError;
use super::source::{FieldSource, QuantityRequest};
use crate::body::{BodyPart, BodyView};
use crate::colors::ColorOptions;
use crate::deformed;
use crate::drawing::{DisplayedQuantity, DrawingInput, PixelValues, RasterValues};
use crate::engine::{Engine, EngineError};
use crate::layers::{LayerInput, Layers, LayersError};
use crate::mirror::{Mirror, MirrorLines};
use crate::notice::Notice;
use crate::overlays::IsolineLevels;
use crate::range;
use crate::request::Request;
use crate::scene::SceneRequest;
use crate::shared::ColorMapping;
use crate::whole;

/// The input of an image: what is shown of a field, and where it is seen.
#[derive(Clone, Copy)]
pub struct ImageInput<'a> {
    /// The field, and what is subtracted.
    pub source: FieldSource<'a>,
    /// The displayed quantity.
    pub shown: &'a DisplayedQuantity,
    /// Its name in notices and in the file.
    pub name: &'a str,
    /// Where it is seen.
    pub seen: &'a BodyView<'a>,
}

impl<'a> FieldSource<'a> {
    /// Returns the input of an image of this source.
    #[must_use]
    pub fn input<'b>(self, asked: &'b QuantityRequest, seen: &'b BodyView<'b>) -> ImageInput<'b>
    where
        'a: 'b,
    {
        ImageInput { source: self, shown: &asked.shown, name: &asked.name, seen }
    }
}

impl<'a> ImageInput<'a> {
    /// The values, each the mean of so many samples.
    ///
    /// # Errors
    /// A quantity that the field does not have; what the engine or the samples do not fit; a
    /// watcher that stops it.
    pub fn values(&self, samples: Samples, engine: &Engine<'_>) -> Result<PixelValues, ImageError> {
        let draw = &mut |job: DrawingInput<'_>, samples| engine.draw(job, samples);
        self.values_by(samples, draw, engine.watcher)
    }

    /// The values, where `evaluate` computes those of the undeformed body in a view.
    ///
    /// # Errors
    /// As [`Self::values`].
    pub fn values_by(
        &self,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let Self { shown, seen, .. } = *self;
        let is_center = samples == Samples::CENTER;
        let minus = self.source.minus(shown);
        match (&minus, seen.factor(), shown.quantity()) {
            _ if is_center => {}
            (Some(_), ..) => return Err(ImageError::Samples("differences are")),
            (_, Some(_), _) => return Err(ImageError::Samples("the deformed plate is")),
            (.., None) => return Err(ImageError::Samples("values of cells are")),
            (.., Some(quantity)) if seen.lines != MirrorLines::default() => {
                return self.means_of_whole(quantity, samples, evaluate, watcher);
            }
            _ => {}
        }
        match minus {
            Some(minus) => Ok(minus.draw(seen.view(), watcher)?),
            None => self.parts(seen, samples, evaluate, watcher),
        }
    }

    /// The values of the body and its images.
    fn parts(
        &self,
        seen: &BodyView<'_>,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let (field, shown) = (self.source.field, self.shown);
        whole::draw(field, seen, shown, &mut |BodyPart { view, points, .. }, shown| {
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
        quantity: &Quantity,
        samples: Samples,
        evaluate: &mut Evaluate<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageError> {
        let (field, view) = (self.source.field, self.seen.view());
        let finer = view.finer(samples.side())?;
        let [columns, rows] = finer.pixels.map(u64::from);
        if columns * rows > MOST_SAMPLES {
            return Err(ImageError::MirroredSamples);
        }
        let finer = BodyView::new(field, finer, self.seen.lines);
        let drawn = self.parts(&finer, Samples::CENTER, evaluate, watcher)?;
        let job = DrawingInput { field, view, quantity };
        Ok(match &drawn.values {
            RasterValues::Double(raster) => averaged(job, samples, raster, &drawn),
            RasterValues::Single(raster) => averaged(job, samples, raster, &drawn),
        })
    }

    /// Tells of pixels without values, of so many, and of a quantity that is infinite everywhere.
    pub fn tell_values(&self, drawn: &PixelValues, engine: &Engine<'_>) {
        engine.tell_undefined(self.name, drawn.undefined(), self.shown.quantity().is_none());
        let statistics = drawn.values.statistics();
        if statistics.finite == 0 && statistics.infinite > 0 {
            engine.tell(Notice::Infinite(self.name.to_owned()));
        }
    }

    /// The colours of the image for it alone.
    ///
    /// # Errors
    /// A map that there is not; a watcher that stops the search for the range.
    pub fn coloring(
        &self,
        colors: &ColorOptions,
        drawn: &PixelValues,
        engine: &Engine<'_>,
    ) -> Result<ColorMapping, ImageError> {
        let style = self.source.style(self.shown, colors, drawn)?;
        let span = self.span(drawn, &style, engine.watcher)?;
        Ok(ColorMapping { style, span, ends: None })
    }

    /// The range of the colours.
    ///
    /// # Errors
    /// A watcher that stops the search.
    pub fn span(
        &self,
        drawn: &PixelValues,
        style: &Style,
        watcher: &dyn Watcher,
    ) -> Result<ColorRange, RasterError> {
        match self.quantity() {
            Some(quantity) => {
                range::value_span(self.source.field, self.seen, quantity, drawn, style, watcher)
            }
            None => Ok(self.source.pixel_span(drawn, style)),
        }
    }

    /// The image with colours for it alone.
    ///
    /// # Errors
    /// As the steps that it consists of.
    pub fn draw(
        &self,
        request: &Request,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<RenderedImage, ImageError> {
        let drawn = self.values(request.samples, engine)?;
        self.tell_values(&drawn, engine);
        let coloring = self.coloring(&request.scene.colors, &drawn, engine)?;
        self.shot(request, &drawn, &coloring, design, engine)
    }

    /// The image of the values in colours, with its overlays. With the `design` of a figure
    /// cracks are drawn whatever is asked for.
    ///
    /// # Errors
    /// A range that does not fit; overlays that there are not; a watcher that stops it.
    pub fn shot(
        &self,
        request: &Request,
        drawn: &PixelValues,
        coloring: &ColorMapping,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<RenderedImage, ImageError> {
        let mut picture = coloring.picture(drawn)?;
        let scene = &request.scene;
        let centers = match self.quantity() {
            // isolines are found between the centres of pixels
            Some(_) if drawn.opacity.is_some() && scene.overlays.isolines.is_some() => {
                Some(self.values(Samples::CENTER, engine)?)
            }
            _ => None,
        };
        let values = &centers.as_ref().unwrap_or(drawn).values;
        let has_bar = design.is_some_and(|design| design.bar != BarPlace::None);
        let ground = LayerInput { design, has_bar, ..self.ground(&picture, values) };
        let layers = self.layers(scene, ground, engine.watcher).map_err(Box::new)?;
        layers.notices.iter().for_each(|notice| engine.tell(notice.clone()));
        let step = request.scene.subject.step_of(self.source.dataset);
        let step = Some((step, self.source.field.step.load));
        if request.blank {
            blank(&mut picture.image);
        }
        Ok(RenderedImage {
            shown: self.shown.clone(),
            name: self.name.to_owned(),
            picture,
            layers,
            cracks: self.seen.cracks(self.source.field),
            by: drawn.by.clone(),
            overlaps: drawn.overlap.len(),
            factor: self.seen.factor(),
            mirrored: request.scene.mirror.as_ref().map(Mirror::to_string),
            dataset: (
                self.source.dataset.title.clone(),
                step.filter(|_| self.source.dataset.steps.len() > 1),
            ),
        })
    }

    /// The isolines of a quantity that an image of it in these colours has.
    ///
    /// # Errors
    /// As the steps that an image consists of; values of cells, which have none.
    pub fn isolines(
        &self,
        wanted: &IsolineLevels,
        colors: &ColorOptions,
        engine: &Engine<'_>,
    ) -> Result<Vec<Isoline>, ImageError> {
        let quantity = self.shown.quantity().ok_or(ImageError::NoIsolines)?;
        let drawn = self.values(Samples::CENTER, engine)?;
        let picture = self.coloring(colors, &drawn, engine)?.picture(&drawn)?;
        let ground = self.ground(&picture, &drawn.values);
        Ok(ground.isolines(self.seen, quantity, &ground.levels(wanted), engine.watcher)?)
    }

    /// The quantity of which extrema and isolines are found: they are those of one field.
    fn quantity(&self) -> Option<&'a Quantity> {
        self.shown.quantity().filter(|_| self.source.left.is_none())
    }

    /// The input of the layers of a bare image, without a bar beside it.
    #[must_use]
    pub fn ground<'b>(
        &'b self,
        picture: &'b ColoredRaster,
        values: &'b RasterValues,
    ) -> LayerInput<'b> {
        let FieldSource { dataset, field, .. } = self.source;
        let quantity = self.quantity();
        LayerInput { dataset, field, quantity, picture, values, design: None, has_bar: false }
    }

    /// Layers over the image.
    ///
    /// # Errors
    /// As [`Overlays::layers`](crate::overlays::Overlays::layers).
    pub fn layers(
        &self,
        scene: &SceneRequest,
        ground: LayerInput<'_>,
        watcher: &dyn Watcher,
    ) -> Result<Layers, LayersError> {
        scene.overlays.layers(ground, self.seen, scene.outline, watcher)
    }
}

/// Computes the means of so many samples a pixel of an undeformed body: an engine, a card that
/// stays open, or what knows the values.
pub type Evaluate<'e> =
    dyn FnMut(DrawingInput<'_>, Samples) -> Result<PixelValues, EngineError> + 'e;

/// Most samples of an image of the whole, all of which are held at once: 512 MiB.
const MOST_SAMPLES: u64 = 1 << 26;

/// The means over the pixels of an image of samples, whose values are given.
fn averaged<T: RasterValue>(
    job: DrawingInput<'_>,
    samples: Samples,
    raster: &Raster<T>,
    PixelValues { without, by, .. }: &PixelValues,
) -> PixelValues
where
    RasterValues: From<Raster<T>>,
{
    let image = SampleImage { raster, undefined: without };
    PixelValues::averaged(Means::of(job.view, job.quantity, samples, image), job, by)
}

/// Leaves out the colours: the body is white.
fn blank(image: &mut Image) {
    let seen = image.rgba.as_chunks_mut::<4>().0.iter_mut().filter(|pixel| pixel[3] > 0);
    seen.for_each(|pixel| pixel[..3].fill(255));
}
