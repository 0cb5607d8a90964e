//! Several quantities, or parts of a field, in one figure.

use std::borrow::Cow;

use ppum::dataset::Dataset;
use ppum::decompose::FieldPart;
use ppum::field::Field;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{
    FigureError, FigureStyle, Labels, PanelGrid, lacks_legend, panel_area, panels,
};
use ppum_render::png::TextChunk;
use ppum_render::range::ColorRange;

use super::body::BodyView;
use super::camera::{Camera, extent, whole};
use super::coloring::ColorMapping;
use super::compose::{RenderedImage, tell_legend};
use super::engine::Engine;
use super::error::ImageError;
use super::notice::Notice;
use super::quantity::DisplayError;
use super::subject::{ImageSubject, scene_bounds};
use super::values::PixelValues;
use crate::request::page_style::{DEFAULT_SIZE, PageStyle, SHAPE};
use crate::request::scene::{Subject, SubjectError};
use crate::request::{PanelsError, Request};

/// The name of the part that is the whole field.
pub const WHOLE: &str = "all";

/// A part in words: `smooth part`, `part of patch 7`, `whole field`.
#[must_use]
pub fn caption(part: &str) -> String {
    match part.trim() {
        WHOLE => "whole field".to_owned(),
        part => match part.parse() {
            Ok(FieldPart::Patch(patch)) => format!("part of patch {patch}"),
            _ => format!("{part} part"),
        },
    }
}

/// The dataset changed as a subject says, once for each of some parts in place of its own.
///
/// # Errors
/// Features that the dataset does not have.
pub fn datasets(
    dataset: &Dataset,
    subject: &Subject,
    parts: &[String],
) -> Result<Vec<Dataset>, SubjectError> {
    let changed = parts.iter().map(|part| {
        let part = (part.trim() != WHOLE).then(|| part.clone());
        Subject { part, ..subject.clone() }.applied(dataset).map(Cow::into_owned)
    });
    changed.collect()
}

impl Request {
    /// The subjects of the panels of some bodies: of all of them each quantity.
    ///
    /// # Errors
    /// A text that means nothing for a field.
    pub fn subjects<'a>(
        &self,
        bodies: &[(&'a Dataset, &'a Field<'a>)],
    ) -> Result<Vec<ImageSubject<'a>>, DisplayError> {
        let texts: Vec<Option<&str>> = match &self.panels.quantities[..] {
            [] => vec![self.scene.quantity.as_deref()],
            several => several.iter().map(|text| Some(text.as_str())).collect(),
        };
        let of = |text| {
            bodies.iter().map(move |&(dataset, field)| ImageSubject::new(dataset, field, text))
        };
        texts.into_iter().flat_map(of).collect()
    }
}

/// A figure of panels.
struct PanelFigure<'a> {
    /// All parts of a quantity, then those of the next one.
    subjects: &'a [ImageSubject<'a>],
    request: Request,
    /// The number of parts.
    parts: usize,
}

/// A figure of panels that was drawn.
pub struct PanelImages {
    /// The page.
    pub page: Canvas,
    /// The images, row by row.
    pub images: Vec<RenderedImage>,
    /// Their words: captions are titles.
    pub labels: Vec<Labels>,
    /// The names of the quantities, with commas between.
    pub names: String,
    /// True if all have one range.
    pub is_shared: bool,
}

/// Draws the panels of a request: all parts of a quantity, then those of the next one.
///
/// # Errors
/// Features that a field does not have; a layout of too few panels; a size without room; a watcher
/// that stops it.
pub fn draw(
    subjects: &[ImageSubject<'_>],
    request: &Request,
    engine: &Engine<'_>,
) -> Result<PanelImages, ImageError> {
    request.panels.check(&request.scene)?;
    let parts = request.panels.parts.len().max(1);
    PanelFigure { subjects, request: subjects[0].resolved(request)?, parts }.draw(engine)
}

impl PanelFigure<'_> {
    fn draw(&self, engine: &Engine<'_>) -> Result<PanelImages, ImageError> {
        let (subject, request) = (&self.subjects[0], &self.request);
        let labels = self.labels()?;
        let title = subject.title(request)?;
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let grid = self.grid(&title, &captions)?;
        let size = [grid.columns, grid.rows];
        let whole = whole(subject, &request.scene);
        let aspect = request.place.aspect(whole);
        let design = request.design(whole, PageStyle::page(aspect, size), size);
        let room = |design: &FigureStyle| panel_area(&title, &captions, grid, design);
        let design = request.look.fitted(design, aspect, size, room)?;
        let room = room(&design)?;
        let body = self.camera(&design, room)?.body(subject, &request.scene, engine)?;
        let images = self.images(&body, &design, engine)?;
        let all: Vec<_> = images.iter().zip(&labels).map(|(i, l)| i.panel(l.clone())).collect();
        let lacking = all.iter().filter(|panel| lacks_legend(panel, room, &design));
        lacking.for_each(|panel| tell_legend(&panel.legend, engine));
        let page = panels(&title, &all, grid, &design)?;
        if let Some(layout) = request.panels.layout.filter(|given| *given != size) {
            engine.tell(Notice::EmptyPanels(layout, self.subjects.len()));
        }
        let names = self.subjects.iter().step_by(self.parts);
        let names = names.map(|subject| subject.name.as_str()).collect::<Vec<_>>().join(", ");
        Ok(PanelImages { page, images, labels, names, is_shared: self.is_shared() })
    }

    fn camera(&self, design: &FigureStyle, room: [u32; 2]) -> Result<Camera, ImageError> {
        let (ImageSubject { dataset, field, .. }, request) = (&self.subjects[0], &self.request);
        let deformed = request.scene.deformed;
        let bounds = deformed.map(|_| scene_bounds(dataset, field, &request.scene)).transpose()?;
        let (region, extent) = (request.place.clone(), extent(request, Some(design), room));
        Ok(Camera::Region { region, extent, bounds })
    }

    fn is_shared(&self) -> bool {
        self.request.panels.shared_range
    }

    /// The images of all panels, of one range if that is asked for.
    fn images(
        &self,
        body: &BodyView<'_>,
        design: &FigureStyle,
        engine: &Engine<'_>,
    ) -> Result<Vec<RenderedImage>, ImageError> {
        let values = self.subjects.iter().map(|subject| {
            let values = subject.values(body, self.request.samples, engine)?;
            subject.tell_values(&values, engine);
            Ok(values)
        });
        let values = values.collect::<Result<Vec<_>, ImageError>>()?;
        let colorings = self.colorings(body, &values, engine)?;
        let all = self.subjects.iter().zip(values.iter().zip(&colorings));
        all.map(|(subject, colored)| {
            subject.compose(&self.request, body, colored, Some(design), engine)
        })
        .collect()
    }

    /// The arrangement: as given, but without rows and columns that no panel is in; else a row for
    /// each of several quantities of several parts, or that with the largest images.
    fn grid(&self, title: &str, captions: &[&str]) -> Result<PanelGrid, ImageError> {
        let (count, parts) = (captions.len(), self.parts);
        let sized = |size| PanelGrid { shared_bar: self.is_shared(), ..PanelGrid::new(size) };
        let of = |columns: usize| sized([columns as u32, count.div_ceil(columns) as u32]);
        if let Some(layout) = self.request.panels.layout {
            return match layout {
                [0, _] | [_, 0] => Err(PanelsError::Empty.into()),
                _ if count > sized(layout).cells() => {
                    Err(PanelsError::Few { layout, count }.into())
                }
                [columns, _] => Ok(of(count.min(columns as usize))),
            };
        }
        if parts > 1 && count > parts {
            return Ok(of(parts));
        }
        let whole = whole(&self.subjects[0], &self.request.scene);
        let aspect = self.request.place.aspect(whole);
        let width = |grid: PanelGrid| {
            let parts = [grid.columns, grid.rows];
            let mut design = self.request.design(whole, DEFAULT_SIZE, parts);
            if self.request.look.has_free_height() {
                design.size[1] = (f64::from(design.size[0]) / SHAPE) as u32;
            }
            let [width, height] = panel_area(title, captions, grid, &design)?.map(f64::from);
            Ok::<_, FigureError>(width.min(height * aspect.unwrap_or(SHAPE)))
        };
        let fitting = (1..=count).filter_map(|n| Some((width(of(n)).ok()?, of(n))));
        let best = fitting.reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.map_or_else(|| Ok(width(of(count)).map(|_| of(count))?), |(_, grid)| Ok(grid))
    }

    /// The words of the panels, `(a) σ_yy` above the first; where one bar is for all it names what
    /// they share.
    fn labels(&self) -> Result<Vec<Labels>, ImageError> {
        let (parts, all) = (self.parts, self.subjects);
        let is_one = all.len() == parts;
        let captions: Vec<_> = match &self.request.panels.parts[..] {
            [_] => Vec::new(),
            parts => parts.iter().map(|part| caption(part)).collect(),
        };
        let of = |(number, subject): (usize, &ImageSubject<'_>)| {
            let [name, _] = subject.shown.words(subject.field);
            let mut labels = subject.labels(&self.request)?;
            if self.is_shared() && !is_one && self.request.labels.bar.is_none() {
                labels.quantity.clear();
            }
            let caption = match captions.get(number % parts) {
                Some(part) if is_one => part.clone(),
                Some(part) => format!("{name}, {part}"),
                None => name,
            };
            labels.title = format!("({}) {caption}", letters(number));
            Ok(labels)
        };
        all.iter().enumerate().map(of).collect()
    }

    /// The ways to colours, of one range for all if that is asked for.
    fn colorings(
        &self,
        body: &BodyView<'_>,
        values: &[PixelValues],
        engine: &Engine<'_>,
    ) -> Result<Vec<ColorMapping>, ImageError> {
        let (colors, watcher) = (&self.request.scene.colors, engine.watcher);
        let all = self.subjects.iter().zip(values);
        if !self.is_shared() {
            return all.map(|(one, values)| one.coloring(body, colors, values, watcher)).collect();
        }
        let map = colors.map(self.subjects[0].shown.quantity())?;
        let style = colors.style_of(all.clone().map(|(one, v)| (&*one.shown, &v.values)), map);
        let spans = all.map(|(one, values)| one.span(body, values, &style, watcher));
        let spans = spans.collect::<Result<Vec<_>, _>>()?;
        let span = ColorRange::shared(&spans, style.colormap.diverging);
        let span = span.ok_or(PanelsError::Shared)?;
        Ok(vec![ColorMapping { style, span, ends: None }; values.len()])
    }
}

impl PanelImages {
    /// The texts of the file: what it shows, of which dataset, and what drew it. Ranges of panels
    /// that have their own stand on their bars.
    #[must_use]
    pub fn texts(&self, file: &str) -> Vec<TextChunk> {
        let mut texts = self.images[0].description(file, &self.names);
        let is_own = |key: &str| ["ppum:range", "ppum:range-basis", "ppum:extrema"].contains(&key);
        texts.retain(|(key, _)| self.is_shared || !is_own(key));
        texts
    }
}

/// The letters of a panel's caption by its number: `a`, `b`, …, `z`, `aa`, `ab`, …
#[must_use]
pub fn letters(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    match number / 26 {
        0 => last.to_string(),
        before => letters(before - 1) + &last.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_behind_z() {
        let found = [0, 25, 26, 51, 52, 701, 702].map(letters);
        assert_eq!(found, ["a", "z", "aa", "az", "ba", "zz", "aaa"]);
    }
}
