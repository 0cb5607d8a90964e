//! Images: values at pixels, colours, figures, extreme values.

use std::collections::BTreeMap;
use std::path::Path;

use numpy::{PyArray1, PyArray3, PyArrayMethods as _};
use ppum::progress::Watcher;
use ppum::vec2::{Rect, Vec2};
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::bare;
use ppum_figure::form::PageFormat;
use ppum_figure::ticks;
use ppum_render::colormap::{Colormap, NAMES};
use ppum_render::extrema::{BodyRegion, Extremum, ExtremumSite, extrema};
use ppum_render::png::{TextChunk, encode_quickly};
use ppum_render::scatter;
use ppum_render::view::View;
use ppum_scene::compose::{self, RenderedImage};
use ppum_scene::engine::Engine;
use ppum_scene::help::{FOREIGN, TEXTS};
use ppum_scene::notice::Notice;
use ppum_scene::panels::{PanelImages, datasets, draw};
use ppum_scene::quantity::DisplayedQuantity;
use ppum_scene::request::Request;
use ppum_scene::scene::Subject;
use ppum_scene::subject::ImageSubject;
use ppum_scene::values::{PixelValues, RasterValues};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{RenderError, no_field, picture, quantity, render_error, rendering};
use crate::facts::to_python;
use crate::field::{PyField, read_data};
use crate::values::rows;
use crate::watch::{guard, long};

/// Names of the built-in colour maps.
#[pyfunction]
pub(crate) fn colormaps() -> Vec<&'static str> {
    NAMES.to_vec()
}

/// Red, green and blue of each of the colours of a built-in map, the lowest first.
#[pyfunction]
pub(crate) fn colormap(name: &str) -> PyResult<Vec<(u8, u8, u8)>> {
    let map = Colormap::named(name).map_err(render_error)?;
    Ok(map.palette(BAR).into_iter().map(|[r, g, b, _]| (r, g, b)).collect())
}

/// The effects of the options of images, by their names in the program.
#[pyfunction]
pub(crate) fn option_texts() -> BTreeMap<&'static str, &'static str> {
    TEXTS.iter().map(|(name, text)| (&**name, &**text)).collect()
}

/// Names of options in other programs, and those of the program.
#[pyfunction]
pub(crate) fn foreign_options() -> Vec<(&'static str, &'static str)> {
    FOREIGN.to_vec()
}

/// A request that asks for nothing, with all that could be asked for.
#[pyfunction]
pub(crate) fn default_request(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    to_python(py, &Request::default())
}

/// Raises what `figure` and `rgba` would raise of a request before they draw.
#[pyfunction]
pub(crate) fn check_request(this: &PyField, request: &Bound<'_, PyAny>) -> PyResult<()> {
    let Request { scene, panels, .. } = this.request(request)?;
    for name in scene.quantity.iter().chain(&panels.quantities) {
        guard(|| this.shown(name).map(drop))?;
    }
    panels.check(&scene).map_err(render_error)?;
    scene.colors.map(None).map(drop).map_err(render_error)
}

/// The lower left and upper right corner of what a request shows, of a mirrored body the whole.
#[pyfunction]
pub(crate) fn whole(
    this: &PyField,
    request: &Bound<'_, PyAny>,
) -> PyResult<((f64, f64), (f64, f64))> {
    let request = this.request(request)?;
    let lines = this.subject(&request)?.lines(&request.scene);
    let lines = lines.map_err(|error| picture(error.into()))?;
    let Rect { min, max } = lines.whole(this.field().domain.bounds);
    Ok(((min.x, min.y), (max.x, max.y)))
}

/// A `ppum.View`.
#[derive(FromPyObject)]
pub(crate) struct PyView {
    pub(crate) center: (f64, f64),
    pub(crate) width: f64,
    pub(crate) size: [u32; 2],
}

impl PyView {
    /// The view that can be drawn.
    ///
    /// # Errors
    /// A view without pixels, or one that is too small.
    pub(crate) fn checked(&self) -> PyResult<View> {
        let (x, y) = self.center;
        View::new(Vec2 { x, y }, self.width, self.size).map_err(render_error)
    }
}

/// An extreme value, its place, that as an offset from the middle of the view, what it lies on, and
/// the side of a face.
type ExtremumFacts = (f64, (f64, f64), (f64, f64), &'static str, Option<&'static str>);

fn extremum(found: &Extremum, center: Vec2) -> ExtremumFacts {
    let side = match found.on {
        ExtremumSite::Face(_, side) => Some(side.name()),
        _ => None,
    };
    let [at, offset] = [center + found.offset, found.offset].map(|p| (p.x, p.y));
    (found.value, at, offset, found.on.name(), side)
}

impl PyField {
    pub(crate) fn shown(&self, name: &str) -> PyResult<DisplayedQuantity> {
        DisplayedQuantity::parse(&self.spelled(name), self.field()).map_err(quantity)
    }

    /// Returns the displayed quantity of a name, found without Python's lock.
    pub(crate) fn displayed(&self, py: Python<'_>, name: &str) -> PyResult<DisplayedQuantity> {
        long(py, None, None, |_| self.shown(name))?
    }

    /// A request of Python's layer, its quantity spelled as the libraries do.
    pub(crate) fn request(&self, data: &Bound<'_, PyAny>) -> PyResult<Request> {
        let mut request = read_data::<Request>(data)?;
        let Request { scene, panels, .. } = &mut request;
        let names = scene.quantity.iter_mut().chain(&mut panels.quantities);
        names.for_each(|name| *name = self.spelled(name));
        scene.subject = self.titled.clone();
        Ok(request)
    }

    fn subject(&self, request: &Request) -> PyResult<ImageSubject<'_>> {
        let text = request.scene.quantity.as_deref();
        ImageSubject::new(self.dataset(), self.field(), text).map_err(quantity)
    }

    /// The page of a figure, and the texts of its file.
    fn page(&self, request: &Request, engine: &Engine<'_>) -> PyResult<(Canvas, Vec<TextChunk>)> {
        let title = &self.dataset().title;
        if request.panels.are_given() {
            let drawn = self.panels(request, engine)?;
            let texts = [drawn.texts(title), drawn.images[0].notes()].concat();
            return Ok((drawn.page, texts));
        }
        let (page, image) =
            compose::page(&self.subject(request)?, request, engine).map_err(picture)?;
        Ok((page, [image.texts(title), image.notes()].concat()))
    }

    /// The panels of a request, of the field or of its parts.
    fn panels(&self, request: &Request, engine: &Engine<'_>) -> PyResult<PanelImages> {
        let (dataset, step) = self.place();
        let of = Subject { step: Some(step), ..Subject::default() };
        let datasets = datasets(dataset, &of, &request.panels.parts).map_err(quantity)?;
        let fields = datasets.iter().map(|dataset| ppum::field::Field::new(dataset, step));
        let fields = fields.collect::<Result<Vec<_>, _>>().map_err(no_field)?;
        let mut bodies: Vec<_> = datasets.iter().zip(&fields).collect();
        if bodies.is_empty() {
            bodies.push((dataset, self.field()));
        }
        let subjects = request.subjects(&bodies).map_err(quantity)?;
        draw(&subjects, request, engine).map_err(picture)
    }
}

/// Draws a request with its engine, and returns the notices in words.
pub(crate) fn made<T>(
    request: &Request,
    watcher: &dyn Watcher,
    make: impl FnOnce(&Engine<'_>) -> PyResult<T>,
) -> PyResult<(T, Vec<String>)> {
    let engine = Engine::new(request.backend, request.precision, None, watcher);
    let engine = engine.map_err(picture)?;
    let made = make(&engine)?;
    Ok((made, engine.into_notices().iter().map(Notice::to_string).collect()))
}

/// Values at the centres of pixels, rows from the top.
#[pyfunction]
pub(crate) fn render<'py>(
    this: &PyField,
    py: Python<'py>,
    name: &str,
    view: PyView,
    single: bool,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (what, view) = (this.displayed(py, name)?, view.checked()?);
    let field = this.field();
    let drawn = |watcher: &dyn Watcher| {
        Ok(match (&what, single) {
            (DisplayedQuantity::Cells(_, values), _) => {
                PixelValues::of_cells(values, field, &view).values
            }
            (DisplayedQuantity::Quantity(quantity), true) => {
                scatter::render::<f32>(field, &view, quantity, watcher)?.into()
            }
            (DisplayedQuantity::Quantity(quantity), false) => {
                scatter::render::<f64>(field, &view, quantity, watcher)?.into()
            }
        })
    };
    Ok(match long(py, None, progress.as_ref(), drawn)?.map_err(rendering)? {
        RasterValues::Double(raster) => rows(py, raster.values, view.pixels[0])?.into_any(),
        RasterValues::Single(raster) => rows(py, raster.values, view.pixels[0])?.into_any(),
    })
}

/// The colours of a request, with what lies over them: rows from the top; red, green, blue, alpha;
/// and what is to be said of them.
#[pyfunction]
pub(crate) fn rgba<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &Bound<'_, PyAny>,
    view: PyView,
) -> PyResult<(Bound<'py, PyArray3<u8>>, Vec<String>)> {
    let (request, view) = (this.request(request)?, view.checked()?);
    let drawn = |engine: &Engine<'_>| {
        let image = this.subject(&request)?.image_in(&request, &view, None, engine);
        Ok(image.map_err(picture)?.bare(engine).image())
    };
    let (image, told) = long(py, None, None, |watcher| made(&request, watcher, drawn))??;
    let [columns, rows] = view.pixels.map(|n| n as usize);
    let shape = [rows, columns, 4];
    Ok((PyArray1::from_vec(py, image.rgba).reshape(shape)?, told))
}

/// The texts of a colour bar.
#[derive(IntoPyObject)]
pub(crate) struct BarFacts {
    /// The range of the colours.
    range: (f64, f64),
    /// Red, green and blue of each of its colours, the lowest first; bytes.
    colors: Vec<u8>,
    /// Positions from 0 to 1, and labels: (value − reference) / 10^exponent.
    ticks: Vec<(f64, String)>,
    reference: f64,
    exponent: i32,
    symbol: String,
    unit: String,
    /// Whether some value lies below the range, and above it.
    beyond: (bool, bool),
}

/// Colours that a bar is made of.
const BAR: usize = 256;

/// Labels of a bar, about.
const LABELS: usize = 7;

impl BarFacts {
    fn new(shot: &RenderedImage, field: &PyField) -> Self {
        let (picture, field) = (&shot.picture, field.field());
        let norm = &picture.normalization;
        let place = |k: usize| (k as f64 + 0.5) / BAR as f64;
        let colors = (0..BAR).flat_map(|k| {
            let [r, g, b, _] = picture.colormap.color(place(k));
            [r, g, b]
        });
        let ticks = ticks::bar(norm, LABELS);
        let [symbol, unit] = shot.shown.words(field);
        Self {
            range: (norm.min(), norm.max()),
            colors: colors.collect(),
            ticks: ticks.major.into_iter().map(|tick| (tick.at, tick.label)).collect(),
            reference: ticks.reference,
            exponent: ticks.exponent,
            symbol,
            unit,
            beyond: (picture.has_below, picture.has_above),
        }
    }
}

/// The image of [`rgba`] as a PNG that is made quickly, with its colour bar.
#[pyfunction]
pub(crate) fn frame<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &Bound<'_, PyAny>,
    view: PyView,
) -> PyResult<(Bound<'py, PyBytes>, BarFacts)> {
    let (request, view) = (this.request(request)?, view.checked()?);
    let drawn = |engine: &Engine<'_>| {
        let image = this.subject(&request)?.image_in(&request, &view, None, engine);
        let mut shot = image.map_err(picture)?;
        let layers = std::mem::take(&mut shot.layers.items);
        let bytes = encode_quickly(&bare(&shot.picture, layers).image());
        let bytes = bytes.map_err(render_error)?;
        Ok((bytes, BarFacts::new(&shot, this)))
    };
    let ((bytes, bar), _) = long(py, None, None, |watcher| made(&request, watcher, drawn))??;
    Ok((PyBytes::new(py, &bytes), bar))
}

/// The format of pages that a name's end says.
pub(crate) fn page_format(end: &str) -> PageFormat {
    PageFormat::of(&Path::new("page").with_extension(end))
}

/// The bytes of a figure's file, `png`, `svg` or `pdf`, and its notices.
#[pyfunction]
pub(crate) fn figure<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &Bound<'_, PyAny>,
    form: &str,
) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
    let (request, form) = (this.request(request)?, page_format(form));
    let drawn = |engine: &Engine<'_>| {
        let made = this.page(&request, engine)?;
        engine.tell_glyphs(&made.0, form);
        Ok(made)
    };
    let all = |watcher: &dyn Watcher| made(&request, watcher, drawn);
    let ((page, texts), told) = long(py, None, None, all)??;
    let bytes = long(py, None, None, |_| form.bytes(&page, request.look.given_dpi(), &texts))?;
    Ok((PyBytes::new(py, &bytes?), told))
}

/// The smallest and the largest value in a view; none where there are no values.
#[pyfunction]
#[pyo3(name = "extrema")]
pub(crate) fn extrema_in(
    this: &PyField,
    py: Python<'_>,
    name: &str,
    view: PyView,
) -> PyResult<Option<(ExtremumFacts, ExtremumFacts)>> {
    let (what, view) = (this.displayed(py, name)?, view.checked()?);
    let DisplayedQuantity::Quantity(quantity) = what else {
        return Err(RenderError::new_err(format!("`{name}` is a value of cells: look at them")));
    };
    let field = this.field();
    let Some(region) = BodyRegion::seen(field, &view) else { return Ok(None) };
    let found = |watcher: &dyn Watcher| extrema(field, &region, &quantity, watcher);
    let found = long(py, None, None, found)?.map_err(rendering)?;
    let facts = |found: &Extremum| extremum(found, region.anchor);
    Ok(found.map(|found| (facts(&found.min), facts(&found.max))))
}
