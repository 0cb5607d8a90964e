//! Images: values in colours, with what lies over them, and their colour bar.

use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::text::trimmed;
use ppum_figure::figure::{axis_label, bare};
use ppum_figure::ticks;
use ppum_render::colormap::Colormap;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::Picture;
use ppum_render::range::ValueSpan;
use ppum_render::raster::Raster;
use ppum_scene::command;
use ppum_scene::drawing::{BodyView, Drawn, PROCESSOR, RasterValues, Shown};
use ppum_scene::engine::Engine;
use ppum_scene::layers::{Ground, Layers};
use ppum_scene::place::Place;
use ppum_scene::range::Telling;
use ppum_scene::request::Request;
use ppum_scene::shared::Coloring;
use ppum_scene::shot::Input;
use ppum_scene::spot::number;

use super::{Evaluator, KnownRange, Subject, prepared};
use crate::error::PageError;
use crate::messages::{Frame, Legend, Tick};

/// An image with its colour bar.
#[derive(Clone, Debug)]
pub struct Painted {
    /// The pixels.
    pub image: Image,
    /// The colour bar.
    pub legend: Legend,
    /// The values, which other colours may be given.
    pub values: Vec<f64>,
}

/// Most labels of a colour bar.
const LABELS: usize = 7;
/// Colours of a bar that is continuous.
const COLORS: usize = 64;
/// Digits of values beyond the ends of the bar.
const DIGITS: usize = 4;

impl Evaluator<'_> {
    /// The image of values: that of `ppum render`. Of a quantity there is one value for each pixel,
    /// row by row; values of cells are found here, whatever is given.
    ///
    /// # Errors
    /// What the dataset does not have; values that are not one for each pixel; a range that does
    /// not fit the scale.
    pub fn paint(&mut self, frame: &Frame, values: Vec<f64>) -> Result<Painted, PageError> {
        let seen = &BodyView::Plate(frame.view.checked().map_err(PageError::shot)?);
        let subject = &*prepared(&mut self.subject, self.dataset, &frame.scene)?;
        let engine = Engine::processor(unwatched());
        let painting = Painting { dataset: self.dataset, subject, frame, seen, engine: &engine };
        let drawn = painting.drawn(values)?;
        let known = self.last.take().filter(|found| found.is_kept(subject, frame));
        let coloring = painting.coloring(&drawn, known)?;
        let picture = coloring.picture(&drawn).map_err(PageError::shot)?;
        let layers = painting.layers(&picture, &drawn.values)?;
        let mut legend = painting.legend(&picture);
        legend.notices = engine.into_notices().iter().map(ToString::to_string).collect();
        self.last = Some(KnownRange::new(subject, frame, coloring.span));
        let image = bare(&picture, layers.items).image();
        let values = match drawn.values {
            RasterValues::Double(raster) => raster.values,
            RasterValues::Single(_) => Vec::new(),
        };
        Ok(Painted { image, legend, values })
    }
}

impl KnownRange {
    fn new(subject: &Subject<'_>, frame: &Frame, span: ValueSpan) -> Self {
        let (step, text) = (subject.step, subject.text.clone());
        Self { step, text, colors: frame.scene.colors.clone(), span }
    }

    /// True if an image keeps this range, which was found for the same quantity and colours.
    fn is_kept(&self, subject: &Subject<'_>, frame: &Frame) -> bool {
        frame.keeps_range
            && (self.step, &self.text) == (subject.step, &subject.text)
            && self.colors == frame.scene.colors
    }
}

/// An image while it is made.
struct Painting<'a> {
    dataset: &'a Dataset,
    subject: &'a Subject<'a>,
    frame: &'a Frame,
    seen: &'a BodyView<'a>,
    engine: &'a Engine<'a>,
}

impl Painting<'_> {
    fn input(&self) -> Input<'_> {
        let Self { dataset, subject: Subject { field, asked, .. }, seen, .. } = self;
        Input { dataset, field, shown: &asked.shown, name: &asked.name, seen, left: None }
    }

    fn drawn(&self, values: Vec<f64>) -> Result<Drawn, PageError> {
        let (view, Subject { field, asked, .. }) = (self.seen.view(), self.subject);
        let drawn = match &asked.shown {
            Shown::Cells(_, values) => Drawn::of_cells(values, field, view),
            Shown::Quantity(_) => {
                let pixels = view.pixels[0] as usize * view.pixels[1] as usize;
                if values.len() != pixels {
                    return Err(PageError::Values(values.len(), pixels));
                }
                Drawn::new(Raster::new(view.pixels, values), field, view, PROCESSOR)
            }
        };
        self.input().tell_values(&drawn, self.engine);
        Ok(drawn)
    }

    /// The colours, of the range that is known, or of one that is found.
    fn coloring(&self, drawn: &Drawn, known: Option<KnownRange>) -> Result<Coloring, PageError> {
        let (colors, shown) = (&self.frame.scene.colors, &self.subject.asked.shown);
        let Some(KnownRange { span, .. }) = known else {
            let found = self.input().coloring(colors, drawn, self.engine);
            return found.map_err(PageError::shot);
        };
        let map = colors.map(shown.quantity()).map_err(PageError::shot)?;
        let style = colors.style_of([(shown, &drawn.values)], map);
        Ok(Coloring { style, span, ends: None })
    }

    fn layers(&self, picture: &Picture, values: &RasterValues) -> Result<Layers, PageError> {
        let Subject { field, asked, .. } = self.subject;
        let ground = Ground {
            dataset: self.dataset,
            field,
            quantity: asked.shown.quantity(),
            picture,
            values,
            design: None,
            has_bar: true,
        };
        let overlays = &self.frame.scene.overlays;
        let layers = overlays.layers(ground, self.seen, false, unwatched());
        let layers = layers.map_err(|error| PageError::shot(Box::new(error)))?;
        layers.notices.iter().for_each(|notice| self.engine.tell(notice.clone()));
        Ok(layers)
    }

    fn command(&self) -> String {
        let (Frame { scene, file, .. }, view) = (self.frame, self.seen.view());
        let mut request = Request::from(scene.clone());
        (request.place, request.look.size) = (Place::of(view), Some(view.pixels));
        command::line(&command::render(&request, file, "image.png"))
    }

    /// The colour bar, without notices.
    fn legend(&self, picture: &Picture) -> Legend {
        let Subject { field, asked, .. } = self.subject;
        let (norm, map) = (&picture.normalization, &picture.colormap);
        let ticks = match picture.one_value {
            None => ticks::bar(norm, LABELS),
            Some(value) => ticks::of_one_value(norm, value),
        };
        let [name, unit] = asked.shown.words(field);
        let beyond = |has: bool, color: Rgba| has.then(|| hex(color));
        let extreme = |value: Option<f64>| value.map(|value| number(value, DIGITS));
        Legend {
            label: axis_label(&name, &ticks, &unit),
            range: [norm.min(), norm.max()],
            colors: colors(map),
            beyond: [beyond(picture.has_below, map.below), beyond(picture.has_above, map.above)],
            extremes: picture.span.beyond().map(extreme),
            sentence: Telling::new(self.dataset, field).colors(picture),
            command: self.command(),
            notices: Vec::new(),
            ticks: match map.classes() {
                [] => ticks.major.into_iter().map(|t| Tick { at: t.at, label: t.label }).collect(),
                classes => class_ticks(classes),
            },
        }
    }
}

/// A label in the middle of the colour of each class.
fn class_ticks(classes: &[f64]) -> Vec<Tick> {
    let at = |k: usize| (k as f64 + 0.5) / classes.len() as f64;
    classes.iter().enumerate().map(|(k, v)| Tick { at: at(k), label: trimmed(*v) }).collect()
}

/// The colours of the bar, of classes and bands one each.
fn colors(map: &Colormap) -> Vec<String> {
    let classes = map.classes().len();
    if classes > 0 {
        return (0..classes).map(|class| hex(map.class_color(class))).collect();
    }
    let count = map.bands().map_or(COLORS, usize::from);
    let middle = |k: usize| (k as f64 + 0.5) / count as f64;
    (0..count).map(|k| hex(map.color(middle(k)))).collect()
}

fn hex([red, green, blue, _]: Rgba) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
