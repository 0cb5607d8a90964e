//! Images: values in colours, with what lies over them, and their colour bar.

use ppum::progress::unwatched;
use ppum::text::trimmed;
use ppum_figure::figure::{axis_label, bare};
use ppum_figure::ticks;
use ppum_render::colormap::Colormap;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::ColoredRaster;
use ppum_render::range::ColorRange;
use ppum_render::raster::Raster;
use ppum_render::samples::Samples;
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::coloring::ColorMapping;
use ppum_scene::command;
use ppum_scene::engine::Engine;
use ppum_scene::error::{ImageError, ImageErrorKind};
use ppum_scene::layers::LayerInput;
use ppum_scene::location::number;
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::range::RangeLocations;
use ppum_scene::region::ViewRegion;
use ppum_scene::request::Request;
use ppum_scene::subject::ImageSubject;
use ppum_scene::values::{DrawingInput, PROCESSOR, PixelValues, RasterValues};

use super::{Evaluator, KnownRange, PageSubject, prepared};
use crate::messages::{PageFrame, PageLegend, PageTick};

/// An image with its colour bar.
#[derive(Clone, Debug)]
pub struct PageImage {
    /// The pixels.
    pub image: Image,
    /// The colour bar.
    pub legend: PageLegend,
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
    /// The image of values: that of `ppum render`. A quantity has one value for each pixel, row by
    /// row; values of cells are found here, whatever is given.
    ///
    /// # Errors
    /// A quantity that the dataset does not have; values that are not one for each pixel; a range
    /// that does not fit the scale.
    pub fn paint(&mut self, frame: &PageFrame, values: Vec<f64>) -> Result<PageImage, ImageError> {
        let view = frame.view.checked()?;
        let subject = &*prepared(&mut self.subject, self.dataset, &frame.scene)?;
        let engine = Engine::processor(unwatched());
        // of a deformed body the overlays that it has
        let scene = &frame.scene.drawn();
        let shown = &subject.image_subject(self.dataset);
        let body = &shown.body(scene, &view, &engine)?;
        let drawn = drawn(shown, body, values, &engine)?;
        let known = self.last.take().filter(|found| found.is_kept(subject, frame));
        let coloring = match known {
            None => shown.coloring(body, &scene.colors, &drawn, engine.watcher)?,
            Some(KnownRange { span, .. }) => {
                let style = shown.style(&scene.colors, &drawn)?;
                ColorMapping { style, span, ends: None }
            }
        };
        let picture = &coloring.picture(&drawn)?;
        let values = &drawn.values;
        let input =
            LayerInput { subject: shown, body, picture, values, design: None, has_bar: true };
        let layers = input.layers(scene, engine.watcher)?;
        layers.notices.into_iter().for_each(|notice| engine.tell(notice));
        let image = bare(picture, layers.items).image();
        let notices = engine.into_notices().iter().map(ToString::to_string).collect();
        let legend =
            PageLegend { notices, command: command(frame, &view), ..legend(shown, picture) };
        self.last = Some(KnownRange::new(subject, frame, coloring.span));
        let values = match drawn.values {
            RasterValues::Double(raster) => raster.values,
            RasterValues::Single(_) => Vec::new(),
        };
        Ok(PageImage { image, legend, values })
    }
}

impl KnownRange {
    fn new(subject: &PageSubject<'_>, frame: &PageFrame, span: ColorRange) -> Self {
        let (step, text) = (subject.step, subject.text.clone());
        Self { step, text, colors: frame.scene.colors.clone(), span }
    }

    /// True if an image keeps this range, which was found for the same quantity and colours.
    fn is_kept(&self, subject: &PageSubject<'_>, frame: &PageFrame) -> bool {
        frame.keeps_range
            && (self.step, &self.text) == (subject.step, &subject.text)
            && self.colors == frame.scene.colors
    }
}

/// The values of an image: those that are given where they are known by rows.
fn drawn(
    subject: &ImageSubject<'_>,
    body: &BodyView<'_>,
    values: Vec<f64>,
    engine: &Engine<'_>,
) -> Result<PixelValues, ImageError> {
    let (view, field) = (*body.view(), subject.field);
    let is_by_rows = body.factor().is_none() && body.lines == MirrorLines::default();
    let drawn = match subject.shown.quantity().filter(|_| is_by_rows) {
        None => subject.values(body, Samples::CENTER, engine),
        Some(_) => {
            let pixels = view.pixels[0] as usize * view.pixels[1] as usize;
            if values.len() != pixels {
                return Err(ImageErrorKind::Values(values.len(), pixels).into());
            }
            let mut values = Some(values);
            let given = &mut |_: DrawingInput<'_>, _| {
                let raster = Raster::new(view.pixels, values.take().unwrap_or_default());
                Ok(PixelValues::new(raster, field, &view, PROCESSOR))
            };
            subject.values_by(body, Samples::CENTER, given, unwatched())
        }
    };
    let drawn = drawn?;
    subject.tell_values(&drawn, engine);
    Ok(drawn)
}

/// The command that draws an image.
fn command(PageFrame { scene, file, .. }: &PageFrame, view: &View) -> String {
    let mut request = Request::from(scene.drawn());
    (request.place, request.look.size) = (ViewRegion::of(view), Some(view.pixels));
    command::line(&command::render(&request, file, "image.png"))
}

/// The colour bar, without notices and command.
fn legend(subject: &ImageSubject<'_>, picture: &ColoredRaster) -> PageLegend {
    let ImageSubject { dataset, field, .. } = *subject;
    let (norm, map) = (&picture.normalization, &picture.colormap);
    let ticks = match picture.one_value {
        None => ticks::bar(norm, LABELS),
        Some(value) => ticks::of_one_value(norm, value),
    };
    let [name, unit] = subject.words();
    let beyond = |has: bool, color: Rgba| has.then(|| hex(color));
    let extreme = |value: Option<f64>| value.map(|value| number(value, DIGITS));
    PageLegend {
        label: axis_label(&name, &ticks, &unit),
        range: [norm.min(), norm.max()],
        colors: colors(map),
        beyond: [beyond(picture.has_below, map.below), beyond(picture.has_above, map.above)],
        extremes: picture.span.beyond().map(extreme),
        sentence: RangeLocations::new(dataset, field).colors(picture),
        command: String::new(),
        notices: Vec::new(),
        ticks: match map.classes() {
            [] => ticks.major.into_iter().map(|t| PageTick { at: t.at, label: t.label }).collect(),
            classes => class_ticks(classes),
        },
    }
}

/// A label in the middle of the colour of each class.
fn class_ticks(classes: &[f64]) -> Vec<PageTick> {
    let at = |k: usize| (k as f64 + 0.5) / classes.len() as f64;
    classes.iter().enumerate().map(|(k, v)| PageTick { at: at(k), label: trimmed(*v) }).collect()
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
