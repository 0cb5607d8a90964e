//! Images: values at pixels, colours, figures, extreme values.

use std::collections::BTreeMap;

use numpy::{IntoPyArray as _, PyArray1, PyArray3, PyArrayMethods as _};
use ppum::crack::Side;
use ppum::progress::Watcher;
use ppum::vec2::Vec2;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{Labels, bare};
use ppum_figure::form::PageFormat;
use ppum_figure::ticks;
use ppum_render::colormap::{Colormap, NAMES};
use ppum_render::extrema::{BodyRegion, Extremum, ExtremumSite, extrema};
use ppum_render::png::{TextChunk, encode_quickly};
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::view::View;
use ppum_scene::drawing::{DisplayedQuantity, PixelValues, RasterValues};
use ppum_scene::engine::Engine;
use ppum_scene::help::TEXTS;
use ppum_scene::image_job::ImageJob;
use ppum_scene::notice::Notice;
use ppum_scene::panels::{PanelImages, datasets, draw};
use ppum_scene::request::Request;
use ppum_scene::scene::{Subject, shown};
use ppum_scene::shot::{FieldSource, RenderedImage, shot};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{RenderError, no_field, not_shown, picture, rendering, subject};
use crate::field::{PyField, written};
use crate::watch::{guard, long};

/// Centre and width of a view.
pub(crate) type CenterAndWidth = ((f64, f64), f64);

/// Names of the built-in colour maps.
#[pyfunction]
pub(crate) fn colormaps() -> Vec<&'static str> {
    NAMES.to_vec()
}

/// Red, green and blue of each of the colours of a built-in map, the lowest first.
#[pyfunction]
pub(crate) fn colormap(name: &str) -> PyResult<Vec<(u8, u8, u8)>> {
    let map = Colormap::named(name).map_err(|error| RenderError::new_err(error.to_string()))?;
    Ok(map.palette(BAR).into_iter().map(|[r, g, b, _]| (r, g, b)).collect())
}

/// The effects of the options of images, by their names in the program.
#[pyfunction]
pub(crate) fn option_texts() -> BTreeMap<&'static str, &'static str> {
    TEXTS.iter().map(|(name, text)| (&**name, &**text)).collect()
}

/// A request that asks for nothing, with all that could be asked for.
#[pyfunction]
pub(crate) fn default_request() -> PyResult<String> {
    let request = serde_json::to_string(&Request::default());
    request.map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Raises what `figure` and `rgba` would raise of a request before they draw.
#[pyfunction]
pub(crate) fn check_request(this: &PyField, request: &str) -> PyResult<()> {
    let Request { scene, panels, .. } = this.request(request)?;
    for name in scene.quantity.iter().chain(&panels.quantities) {
        guard(|| this.shown(name).map(drop))?;
    }
    panels.check(&scene).map_err(|error| RenderError::new_err(error.to_string()))?;
    let map = scene.colors.map(None);
    map.map(drop).map_err(|error| RenderError::new_err(error.to_string()))
}

pub(crate) fn view(((x, y), width): CenterAndWidth, size: [u32; 2]) -> PyResult<View> {
    View::new(Vec2 { x, y }, width, size).map_err(|error| RenderError::new_err(error.to_string()))
}

/// One extreme value.
#[derive(IntoPyObject)]
pub(crate) struct ExtremumFacts {
    value: f64,
    xy: (f64, f64),
    offset: (f64, f64),
    on: &'static str,
    side: Option<&'static str>,
}

impl ExtremumFacts {
    fn new(found: Extremum, center: Vec2) -> Self {
        let (at, offset) = (center + found.offset, found.offset);
        let side = match found.on {
            ExtremumSite::Face(_, Side::Above) => Some("above"),
            ExtremumSite::Face(_, Side::Below) => Some("below"),
            _ => None,
        };
        let on = found.on.name();
        Self { value: found.value, xy: (at.x, at.y), offset: (offset.x, offset.y), on, side }
    }
}

impl PyField {
    pub(crate) fn shown(&self, name: &str) -> PyResult<DisplayedQuantity> {
        shown(&self.spelled(name), self.owned.field()).map_err(|error| not_shown(&error))
    }

    /// A request of Python's layer, its quantity spelled as the libraries do.
    pub(crate) fn request(&self, text: &str) -> PyResult<Request> {
        let mut request = written::<Request>(text)?;
        let Request { scene, panels, .. } = &mut request;
        let names = scene.quantity.iter_mut().chain(&mut panels.quantities);
        names.for_each(|name| *name = self.spelled(name));
        scene.subject = self.told.clone();
        Ok(request)
    }

    pub(crate) fn source(&self) -> FieldSource<'_> {
        FieldSource::of(self.owned.dataset(), self.owned.field())
    }

    fn raster<T: RasterValue>(
        &self,
        py: Python<'_>,
        what: &DisplayedQuantity,
        view: &View,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<RasterValues>
    where
        RasterValues: From<Raster<T>>,
    {
        let field = self.owned.field();
        match what {
            DisplayedQuantity::Cells(_, values) => {
                long(py, None, progress, |_| PixelValues::of_cells(values, field, view).values)
            }
            DisplayedQuantity::Quantity(quantity) => {
                let drawn = |watcher: &dyn Watcher| T::render(field, view, quantity, watcher);
                Ok(long(py, None, progress, drawn)?.map_err(rendering)?.into())
            }
        }
    }

    /// The page of a figure, and the texts of its file.
    fn page(&self, request: &Request, engine: &Engine<'_>) -> PyResult<(Canvas, Vec<TextChunk>)> {
        let title = &self.owned.dataset().title;
        if request.panels.are_given() {
            let drawn = self.panels(request, engine)?;
            let texts = [drawn.texts(title), drawn.shots[0].notes()].concat();
            return Ok((drawn.page, texts));
        }
        let still = ImageJob::new(self.source(), request.clone()).map_err(picture)?;
        let (page, shot) = still.page(engine).map_err(picture)?;
        Ok((page, [shot.texts(title), shot.notes()].concat()))
    }

    /// The panels of a request, of the field or of its parts.
    fn panels(&self, request: &Request, engine: &Engine<'_>) -> PyResult<PanelImages> {
        if request.panels.parts.is_empty() {
            return draw(&[self.source()], request, engine).map_err(picture);
        }
        let (dataset, step) = self.owned.place();
        let of = Subject { step: Some(step), ..Subject::default() };
        let datasets = datasets(dataset, &of, &request.panels.parts).map_err(|e| subject(&e))?;
        let fields = datasets.iter().map(|dataset| ppum::field::Field::new(dataset, step));
        let fields = fields.collect::<Result<Vec<_>, _>>().map_err(no_field)?;
        let sources = datasets.iter().zip(&fields).map(|(d, f)| FieldSource::of(d, f));
        draw(&sources.collect::<Vec<_>>(), request, engine).map_err(picture)
    }
}

/// Draws a request with its engine, and returns the notices in words.
pub(crate) fn made<T>(
    request: &Request,
    watcher: &dyn Watcher,
    make: impl FnOnce(&Engine<'_>) -> PyResult<T>,
) -> PyResult<(T, Vec<String>)> {
    let engine = Engine::new(request.backend, request.precision, None, watcher);
    let engine = engine.map_err(|error| picture(error.into()))?;
    let made = make(&engine)?;
    Ok((made, engine.into_notices().iter().map(Notice::to_string).collect()))
}

/// Values at the centres of pixels, rows from the top.
#[pyfunction]
pub(crate) fn render<'py>(
    this: &PyField,
    py: Python<'py>,
    name: &str,
    spot: CenterAndWidth,
    size: [u32; 2],
    single: bool,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (what, view) = (long(py, None, None, |_| this.shown(name))??, view(spot, size)?);
    let values = match single {
        true => this.raster::<f32>(py, &what, &view, progress.as_ref())?,
        false => this.raster::<f64>(py, &what, &view, progress.as_ref())?,
    };
    let shape = [size[1] as usize, size[0] as usize];
    Ok(match values {
        RasterValues::Double(raster) => raster.values.into_pyarray(py).reshape(shape)?.into_any(),
        RasterValues::Single(raster) => raster.values.into_pyarray(py).reshape(shape)?.into_any(),
    })
}

/// The colours of a request, with what lies over them: rows from the top; red, green, blue, alpha;
/// and what is to be said of them.
#[pyfunction]
pub(crate) fn rgba<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &str,
    spot: CenterAndWidth,
    size: [u32; 2],
) -> PyResult<(Bound<'py, PyArray3<u8>>, Vec<String>)> {
    let (request, view) = (this.request(request)?, view(spot, size)?);
    let drawn = |engine: &Engine<'_>| {
        let shot = shot(this.source(), &request, &view, None, engine).map_err(picture)?;
        let page = shot.page(Labels::default(), None, engine);
        Ok(page.map_err(|error| picture(error.into()))?.image())
    };
    let (image, told) = long(py, None, None, |watcher| made(&request, watcher, drawn))??;
    let shape = [size[1] as usize, size[0] as usize, 4];
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
        let (picture, field) = (&shot.picture, field.owned.field());
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
    request: &str,
    spot: CenterAndWidth,
    size: [u32; 2],
) -> PyResult<(Bound<'py, PyBytes>, BarFacts)> {
    let (request, view) = (this.request(request)?, view(spot, size)?);
    let drawn = |engine: &Engine<'_>| {
        let mut shot = shot(this.source(), &request, &view, None, engine).map_err(picture)?;
        let layers = std::mem::take(&mut shot.layers.items);
        let bytes = encode_quickly(&bare(&shot.picture, layers).image());
        let bytes = bytes.map_err(|error| RenderError::new_err(error.to_string()))?;
        Ok((bytes, BarFacts::new(&shot, this)))
    };
    let ((bytes, bar), _) = long(py, None, None, |watcher| made(&request, watcher, drawn))??;
    Ok((PyBytes::new(py, &bytes), bar))
}

/// The form of figures that a name's end says.
pub(crate) fn form(name: &str) -> PyResult<PageFormat> {
    match name {
        "png" => Ok(PageFormat::Png),
        "svg" => Ok(PageFormat::Svg),
        "pdf" => Ok(PageFormat::Pdf),
        other => {
            let known = "figures are png, svg or pdf";
            Err(PyValueError::new_err(format!("`{other}` is no form: {known}")))
        }
    }
}

/// The bytes of a figure's file, of the form that its name's end says: `png`, `svg` or `pdf`; and
/// what is to be said of it.
#[pyfunction]
pub(crate) fn figure<'py>(
    this: &PyField,
    py: Python<'py>,
    request: &str,
    form: &str,
) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
    let (request, form) = (this.request(request)?, self::form(form)?);
    let drawn = |engine: &Engine<'_>| {
        let made = this.page(&request, engine)?;
        Notice::of_glyphs(&made.0, form).into_iter().for_each(|notice| engine.tell(notice));
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
    spot: CenterAndWidth,
    size: [u32; 2],
) -> PyResult<Option<(ExtremumFacts, ExtremumFacts)>> {
    let (what, view) = (long(py, None, None, |_| this.shown(name))??, view(spot, size)?);
    let DisplayedQuantity::Quantity(quantity) = what else {
        return Err(RenderError::new_err(format!("`{name}` is a value of cells: look at them")));
    };
    let field = this.owned.field();
    let Some(region) = BodyRegion::seen(field, &view) else { return Ok(None) };
    let found = |watcher: &dyn Watcher| extrema(field, &region, &quantity, watcher);
    let found = long(py, None, None, found)?.map_err(rendering)?;
    let facts = |of| ExtremumFacts::new(of, region.anchor);
    Ok(found.map(|found| (facts(found.min), facts(found.max))))
}
