//! Several quantities, or parts of a field, in one figure.

use ppum::dataset::Dataset;
use ppum::decompose::FieldPart;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{
    FigureError, FigureStyle, Labels, PanelGrid, lacks_legend, panel_area, panels,
};
use ppum_render::png::TextChunk;
use ppum_render::range::ColorRange;

use crate::body::BodyView;
use crate::camera::{CameraChoice, extent};
use crate::drawing::PixelValues;
use crate::engine::Engine;
use crate::image_job::ImageJob;
use crate::notice::Notice;
use crate::page_style::{DEFAULT_SIZE, PageStyle, SHAPE};
use crate::request::{PanelsError, Request};
use crate::scene::{Subject, SubjectError};
use crate::shared::ColorMapping;
use crate::shot::{
    FieldSource, ImageError, ImageInput, QuantityRequest, RenderedImage, tell_legend, title,
};

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
/// A file that cannot be read; features that the dataset does not have.
pub fn datasets(
    dataset: &Dataset,
    subject: &Subject,
    parts: &[String],
) -> Result<Vec<Dataset>, SubjectError> {
    let changed = parts.iter().map(|part| {
        let part = (part.trim() != WHOLE).then(|| part.clone());
        let (subject, mut changed) = (Subject { part, ..subject.clone() }, dataset.clone());
        subject.apply(&mut changed).map(|()| changed)
    });
    changed.collect()
}

/// The content of a panel, and its body; several parts of a field are several bodies.
struct PanelContent<'a> {
    still: ImageJob<'a>,
    asked: QuantityRequest,
}

/// A figure of panels: each quantity of a request of each of some bodies.
struct PanelFigure<'a> {
    request: &'a Request,
    sources: &'a [FieldSource<'a>],
    /// All parts of a quantity, then those of the next one.
    contents: Vec<PanelContent<'a>>,
}

/// A figure of panels that was drawn.
pub struct PanelImages {
    /// The page.
    pub page: Canvas,
    /// The images, row by row.
    pub shots: Vec<RenderedImage>,
    /// Their words: captions are titles.
    pub labels: Vec<Labels>,
    /// The names of the quantities, with commas between.
    pub names: String,
    /// True if all have one range.
    pub is_shared: bool,
}

/// Draws the panels of a request; `sources` are the fields of its parts, as [`datasets`] has them.
///
/// # Errors
/// Features that a field does not have; a layout of too few panels; a size without room; a watcher
/// that stops it.
pub fn draw(
    sources: &[FieldSource<'_>],
    request: &Request,
    engine: &Engine<'_>,
) -> Result<PanelImages, ImageError> {
    PanelFigure::new(sources, request)?.draw(engine)
}

impl<'a> PanelFigure<'a> {
    fn new(sources: &'a [FieldSource<'a>], request: &'a Request) -> Result<Self, ImageError> {
        request.panels.check(&request.scene)?;
        let quantities = match &request.panels.quantities[..] {
            [] => vec![request.scene.quantity.clone()],
            several => several.iter().cloned().map(Some).collect(),
        };
        let content = |quantity: &Option<String>, source: FieldSource<'a>| {
            let mut request = request.clone();
            request.scene.quantity.clone_from(quantity);
            let still = ImageJob::new(source, request)?;
            let asked = QuantityRequest::new(&still.request.scene, source.field)?;
            Ok(PanelContent { still, asked })
        };
        let of = |quantity| sources.iter().map(move |&source| content(quantity, source));
        let contents = quantities.iter().flat_map(of).collect::<Result<Vec<_>, ImageError>>()?;
        Ok(Self { request, sources, contents })
    }

    fn draw(&self, engine: &Engine<'_>) -> Result<PanelImages, ImageError> {
        let PanelContent { still, .. } = &self.contents[0];
        let (source, request) = (still.source, &still.request);
        let labels = self.labels()?;
        let titled = title(source, request)?;
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let grid = self.grid(&titled, &captions)?;
        let size = [grid.columns, grid.rows];
        let whole = source.bounds(&request.scene);
        let aspect = request.place.aspect(whole);
        let design = request.design(whole, PageStyle::page(aspect, size), size);
        let room = |design: &FigureStyle| panel_area(&titled, &captions, grid, design);
        let design = request.look.fitted(design, aspect, size, room)?;
        let room = room(&design)?;
        let placing =
            CameraChoice::new(&request.place, extent(request, Some(&design), room), still)?;
        let seen = placing.body(source, &request.scene, engine)?;
        let shots = self.shots(&seen, &design, engine)?;
        let all: Vec<_> = shots.iter().zip(&labels).map(|(s, l)| s.panel(l.clone())).collect();
        let lacking = all.iter().filter(|panel| lacks_legend(panel, room, &design));
        lacking.for_each(|panel| tell_legend(&panel.legend, engine));
        let page = panels(&titled, &all, grid, &design)?;
        if let Some(layout) = request.panels.layout.filter(|given| *given != size) {
            engine.tell(Notice::EmptyPanels(layout, self.contents.len()));
        }
        let names = self.contents.iter().step_by(self.sources.len());
        let names = names.map(|content| content.asked.name.as_str()).collect::<Vec<_>>().join(", ");
        Ok(PanelImages { page, shots, labels, names, is_shared: self.is_shared() })
    }

    fn is_shared(&self) -> bool {
        self.request.panels.shared_range
    }

    /// The images of all panels, of one range if that is asked for.
    fn shots(
        &self,
        seen: &BodyView<'_>,
        design: &FigureStyle,
        engine: &Engine<'_>,
    ) -> Result<Vec<RenderedImage>, ImageError> {
        let inputs = self.contents.iter();
        let inputs: Vec<ImageInput<'_>> =
            inputs.map(|content| content.still.source.input(&content.asked, seen)).collect();
        let drawn = inputs.iter().map(|input| {
            let drawn = input.values(self.request.samples, engine)?;
            input.tell_values(&drawn, engine);
            Ok(drawn)
        });
        let drawn = drawn.collect::<Result<Vec<_>, ImageError>>()?;
        let colorings = self.colorings(&inputs, &drawn, engine)?;
        let shots = self.contents.iter().zip(&inputs).zip(drawn.iter().zip(&colorings));
        let shot =
            |((content, input), (drawn, coloring)): ((&PanelContent<'_>, &ImageInput<'_>), _)| {
                input.shot(&content.still.request, drawn, coloring, Some(design), engine)
            };
        shots.map(shot).collect()
    }

    /// The arrangement: as given, but without rows and columns that no panel is in; else a row for
    /// each of several quantities of several parts, or that with the largest images.
    fn grid(&self, title: &str, captions: &[&str]) -> Result<PanelGrid, ImageError> {
        let (count, parts) = (captions.len(), self.sources.len());
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
        let whole = self.sources[0].bounds(&self.request.scene);
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
        let (parts, all) = (self.sources.len(), &self.contents);
        let is_one = all.len() == parts;
        let captions: Vec<_> = match &self.request.panels.parts[..] {
            [_] => Vec::new(),
            parts => parts.iter().map(|part| caption(part)).collect(),
        };
        let of = |(number, content): (usize, &PanelContent<'_>)| {
            let PanelContent { still: ImageJob { source, request }, asked } = content;
            let [name, _] = asked.shown.words(source.field);
            let mut labels = source.labels(&asked.shown, request)?;
            if self.is_shared() && !is_one && request.labels.bar.is_none() {
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
        inputs: &[ImageInput<'_>],
        drawn: &[PixelValues],
        engine: &Engine<'_>,
    ) -> Result<Vec<ColorMapping>, ImageError> {
        let colors = &self.request.scene.colors;
        let all = inputs.iter().zip(drawn);
        if !self.is_shared() {
            return all.map(|(input, drawn)| input.coloring(colors, drawn, engine)).collect();
        }
        let map = colors.map(inputs[0].shown.quantity())?;
        let style = colors.style_of(all.clone().map(|(i, drawn)| (i.shown, &drawn.values)), map);
        let spans = all.map(|(input, drawn)| input.span(drawn, &style, engine.watcher));
        let spans = spans.collect::<Result<Vec<_>, _>>()?;
        let span = ColorRange::shared(&spans, style.colormap.diverging);
        let span = span.ok_or(PanelsError::Shared)?;
        Ok(vec![ColorMapping { style, span, ends: None }; inputs.len()])
    }
}

impl PanelImages {
    /// The texts of the file: what it shows, of which dataset, and what drew it. Ranges of panels
    /// that have their own stand on their bars.
    #[must_use]
    pub fn texts(&self, file: &str) -> Vec<TextChunk> {
        let mut texts = self.shots[0].description(file, &self.names);
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
