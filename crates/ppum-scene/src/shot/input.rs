//! From values to colours to a picture, step by step.

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_figure::figure::{BarPlace, Design};
use ppum_render::RenderError;
use ppum_render::image::Image;
use ppum_render::isoline::Isoline;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::ValueSpan;
use ppum_render::raster::{Raster, Sample};
use ppum_render::samples::{Means, SampleImage, Samples};
use ppum_render::view::View;

use super::{Shot, ShotError};
use crate::colors::Colors;
use crate::drawing::{BodyView, DrawingInput, Drawn, RasterValues, Shown};
use crate::engine::Engine;
use crate::layers::{Ground, Layers};
use crate::minus::{self, Minus, Side};
use crate::mirror::{Mirror, MirrorLines};
use crate::notice::Notice;
use crate::overlays::Levels;
use crate::range;
use crate::request::Request;
use crate::scene::Scene;
use crate::shared::Coloring;
use crate::whole;

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
            (None, BodyView::Mirrored(view, lines), _) => {
                self.whole((view, lines), samples, engine)?
            }
            (None, BodyView::Moved(body), shown) => {
                centers("the deformed plate is")?;
                engine.check_deformed()?;
                whole::draw_moved::<ShotError>(body, (field, shown), engine.watcher)?
            }
        })
    }

    /// The values of the whole of a body that is mirrored.
    fn whole(
        &self,
        (view, lines): (&View, &MirrorLines),
        samples: Samples,
        engine: &Engine<'_>,
    ) -> Result<Drawn, ShotError> {
        let Self { field, shown, .. } = *self;
        let centers = |view: &View, samples: Samples| {
            whole::draw((field, shown), (view, lines), |view: &View, shown: &Shown| {
                let seen = &BodyView::Plate(*view);
                Input { shown, seen, ..*self }.values(samples, engine)
            })
        };
        let Some(quantity) = shown.quantity().filter(|_| samples != Samples::CENTER) else {
            return centers(view, samples);
        };
        let finer = view.finer(samples.side())?;
        let [columns, rows] = finer.pixels.map(u64::from);
        if columns * rows > MOST_SAMPLES {
            return Err(ShotError::MirroredSamples);
        }
        let drawn = centers(&finer, Samples::CENTER)?;
        let job = DrawingInput { field, view, quantity };
        Ok(match &drawn.values {
            RasterValues::Double(raster) => averaged(job, samples, raster, &drawn),
            RasterValues::Single(raster) => averaged(job, samples, raster, &drawn),
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
            mirrored: request.scene.mirror.as_ref().map(Mirror::to_string),
            dataset: (self.dataset.title.clone(), step.filter(|_| self.dataset.steps.len() > 1)),
        })
    }

    /// The isolines of a quantity that a picture of it in these colours has.
    ///
    /// # Errors
    /// As the steps that a picture consists of; values of cells, which have none.
    pub fn isolines(
        &self,
        wanted: &Levels,
        colors: &Colors,
        engine: &Engine<'_>,
    ) -> Result<Vec<Isoline>, ShotError> {
        let Self { dataset, field, .. } = *self;
        let quantity = self.shown.quantity().ok_or(ShotError::NoIsolines)?;
        let drawn = self.values(Samples::CENTER, engine)?;
        let picture = &self.coloring(colors, &drawn, engine)?.picture(&drawn)?;
        let ground = Ground {
            dataset,
            field,
            quantity: Some(quantity),
            picture,
            values: &drawn.values,
            design: None,
            has_bar: false,
        };
        let lines = self.seen.lines();
        Ok(ground.isolines(quantity, &ground.levels(wanted), lines, engine.watcher)?)
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
            Some(_) if drawn.opacity.is_some() && scene.overlays.isolines.is_some() => {
                Some(self.values(Samples::CENTER, engine)?)
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

/// Most samples of an image of the whole, all of which are held at once: 512 MiB.
const MOST_SAMPLES: u64 = 1 << 26;

/// The means over the pixels of an image of samples, whose values are given.
fn averaged<T: Sample>(
    job: DrawingInput<'_>,
    samples: Samples,
    raster: &Raster<T>,
    Drawn { without, by, .. }: &Drawn,
) -> Drawn
where
    RasterValues: From<Raster<T>>,
{
    let image = SampleImage { raster, undefined: without };
    Drawn::averaged(Means::of(job.view, job.quantity, samples, image), job, by)
}

/// Leaves out the colours: the plate is white.
fn blank(image: &mut Image) {
    let seen = image.rgba.as_chunks_mut::<4>().0.iter_mut().filter(|pixel| pixel[3] > 0);
    seen.for_each(|pixel| pixel[..3].fill(255));
}
