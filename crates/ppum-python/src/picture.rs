//! Pictures: values at pixels, colours, figures, extreme values.

use numpy::{IntoPyArray as _, PyArray1, PyArray3, PyArrayMethods as _};
use ppum::crack::Side;
use ppum::progress::Watcher;
use ppum::vec2::{Rect, Vec2};
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, Design, Labels, Theme, bare};
use ppum_figure::form::PageFormat;
use ppum_figure::ticks;
use ppum_render::colormap::{Colormap, NAMES};
use ppum_render::extrema::{Extremum, On, extrema};
use ppum_render::png::encode_quickly;
use ppum_render::raster::{Raster, Sample};
use ppum_render::view::View;
use ppum_scene::deformed;
use ppum_scene::drawing::{Drawn, RasterValues, Shown};
use ppum_scene::engine::Engine;
use ppum_scene::notice::Notice;
use ppum_scene::request::Request;
use ppum_scene::scene::{Scene, shown};
use ppum_scene::shot::{FieldSource, Shot, ShotError, page, page_in, shot, view_in};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{RenderError, not_shown, picture, rendering};
use crate::field::{Field, written};
use crate::watch::{guard, long};

/// Centre and width of a view.
pub(crate) type Spot = ((f64, f64), f64);

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

/// Raises what `figure` and `rgba` would raise of a request before they draw.
#[pyfunction]
pub(crate) fn check_request(this: &Field, request: &str) -> PyResult<()> {
    let scene = this.request(request)?.scene;
    if let Some(name) = &scene.quantity {
        guard(|| this.shown(name).map(drop))?;
    }
    let map = scene.colors.map(None);
    map.map(drop).map_err(|error| RenderError::new_err(error.to_string()))
}

/// The look of a figure.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Look {
    /// Columns and rows; with `inches` they follow from the resolution.
    size: [u32; 2],
    inches: Option<[f64; 2]>,
    dpi: Option<f64>,
    font_size: Option<f64>,
    dark: bool,
    transparent: bool,
    /// `right`, `bottom`, `none`, or what fits the plate.
    bar: Option<String>,
}

/// Pixels per inch of figures for paper, as the program has it.
const PAPER_DPI: f64 = 300.0;

impl Look {
    pub(crate) fn design(&self, plate: Rect) -> PyResult<Design> {
        let mut design = match (self.inches, self.dpi) {
            (Some(inches), dpi) => Design::inches(inches, dpi.unwrap_or(PAPER_DPI)),
            (None, None) => Design::pixels(self.size),
            (None, Some(dpi)) => Design::pixels(self.size).at(dpi),
        };
        design.font_size = self.font_size.unwrap_or(design.font_size);
        design.theme = if self.dark { Theme::Dark } else { Theme::Light };
        design.transparent = self.transparent;
        let size = plate.size();
        design.bar = match self.bar.as_deref() {
            None => BarPlace::fitting(size.x / size.y),
            Some("right") => BarPlace::Right,
            Some("bottom") => BarPlace::Bottom,
            Some("none") => BarPlace::None,
            Some(other) => {
                let known = "there are right, bottom, none";
                return Err(PyValueError::new_err(format!("bar: `{other}` is no place; {known}")));
            }
        };
        Ok(design)
    }
}

pub(crate) fn view(((x, y), width): Spot, size: [u32; 2]) -> PyResult<View> {
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
            On::Face(_, Side::Above) => Some("above"),
            On::Face(_, Side::Below) => Some("below"),
            _ => None,
        };
        let on = found.on.name();
        Self { value: found.value, xy: (at.x, at.y), offset: (offset.x, offset.y), on, side }
    }
}

impl Field {
    pub(crate) fn shown(&self, name: &str) -> PyResult<Shown> {
        shown(&self.spelled(name), self.owned.field()).map_err(|error| not_shown(&error))
    }

    /// A request of Python's layer, its quantity spelled as the libraries do.
    pub(crate) fn request(&self, text: &str) -> PyResult<Request> {
        let mut request = written::<Request>(text)?;
        let scene = &mut request.scene;
        scene.quantity = scene.quantity.take().map(|name| self.spelled(&name));
        scene.subject = self.told.clone();
        Ok(request)
    }

    pub(crate) fn source(&self) -> FieldSource<'_> {
        FieldSource::of(self.owned.dataset(), self.owned.field())
    }

    fn raster<T: Sample>(
        &self,
        py: Python<'_>,
        what: &Shown,
        view: &View,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<RasterValues>
    where
        RasterValues: From<Raster<T>>,
    {
        let field = self.owned.field();
        match what {
            Shown::Cells(_, values) => {
                long(py, None, progress, |_| Drawn::of_cells(values, field, view).values)
            }
            Shown::Quantity(quantity) => {
                let drawn = |watcher: &dyn Watcher| T::render(field, view, quantity, watcher);
                Ok(long(py, None, progress, drawn)?.map_err(rendering)?.into())
            }
        }
    }

    /// The box that shows all of the plate, deformed or not.
    fn whole(&self, scene: &Scene) -> PyResult<Rect> {
        let field = self.owned.field();
        let Some(factor) = scene.deformed else { return Ok(field.domain.bounds) };
        let factor = factor.number(&[field]);
        let bounds = factor.and_then(|factor| deformed::bounds(field, factor, scene.outline));
        bounds.map_err(|error| picture(error.into()))
    }

    fn page(
        &self,
        request: &Request,
        spot: Option<View>,
        design: &Design,
        engine: &Engine<'_>,
    ) -> PyResult<(Canvas, Shot)> {
        let source = self.source();
        let made = match spot {
            Some(view) => page(source, request, &view, Some(design), engine),
            None => {
                let bad = |error| picture(ShotError::View(error));
                let whole = self.whole(&request.scene)?;
                let any = View::hug(whole, design.size).map_err(bad)?;
                let room = view_in(source, request, &any, design).map_err(picture)?.pixels;
                // as tight about the plate as the program's
                let view = View::hug(whole, room).map_err(bad)?;
                page_in(source, request, &view, Some(design), engine)
            }
        };
        made.map_err(picture)
    }
}

/// What is made of a request by its engine, and what is to be said of it, in words.
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
    this: &Field,
    py: Python<'py>,
    name: &str,
    spot: Spot,
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
    this: &Field,
    py: Python<'py>,
    request: &str,
    spot: Spot,
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

/// What a colour bar says.
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
    fn new(shot: &Shot, field: &Field) -> Self {
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

/// The picture of [`rgba`] as a PNG that is made quickly, with its colour bar.
#[pyfunction]
pub(crate) fn frame<'py>(
    this: &Field,
    py: Python<'py>,
    request: &str,
    spot: Spot,
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
    this: &Field,
    py: Python<'py>,
    request: &str,
    spot: Option<Spot>,
    look: &str,
    form: &str,
) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
    let (request, look) = (this.request(request)?, written::<Look>(look)?);
    let mut design = look.design(this.owned.field().domain.bounds)?;
    if request.blank {
        design.bar = BarPlace::None;
    }
    // as flat as can be: figures show more above and below, not beside
    let spot = spot.map(|spot| view(spot, [design.size[0].max(1), 1])).transpose()?;
    let form = self::form(form)?;
    let drawn = |engine: &Engine<'_>| {
        let made = this.page(&request, spot, &design, engine)?;
        Notice::of_glyphs(&made.0, form).into_iter().for_each(|notice| engine.tell(notice));
        Ok(made)
    };
    let ((page, shot), told) = long(py, None, None, |watcher| made(&request, watcher, drawn))??;
    let mut texts = shot.texts(&this.owned.dataset().title);
    texts.extend(shot.notes());
    let dpi = (look.inches.is_some() || look.dpi.is_some()).then_some(design.dpi);
    let bytes = long(py, None, None, |_| form.bytes(&page, dpi, &texts))?;
    Ok((PyBytes::new(py, &bytes?), told))
}

/// The smallest and the largest value in a view; none where there are no values.
#[pyfunction]
#[pyo3(name = "extrema")]
pub(crate) fn extrema_in(
    this: &Field,
    py: Python<'_>,
    name: &str,
    spot: Spot,
    size: [u32; 2],
) -> PyResult<Option<(ExtremumFacts, ExtremumFacts)>> {
    let (what, view) = (long(py, None, None, |_| this.shown(name))??, view(spot, size)?);
    let Shown::Quantity(quantity) = what else {
        return Err(RenderError::new_err(format!("`{name}` is a value of cells: look at them")));
    };
    let field = this.owned.field();
    let found = |watcher: &dyn Watcher| {
        let raster = f64::render(field, &view, &quantity, watcher)?;
        extrema(field, &view, &quantity, &raster, watcher)
    };
    let found = long(py, None, None, found)?.map_err(rendering)?;
    let facts = |of| ExtremumFacts::new(of, view.center);
    Ok(found.map(|found| (facts(found.min), facts(found.max))))
}
