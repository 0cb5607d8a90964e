//! Several quantities, or parts of a field, in one figure.

use anyhow::{Context as _, ensure};
use ppum_figure::figure::{FigureError, Grid, Labels, Panel, lacks_legend, panel_area, panels};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Span;

use super::{Args, Plate, titled, told, warn, warn_of_infinite};
use crate::look::{DEFAULT_SIZE, Look, letters};
use crate::output::Output;
use crate::overlays::tell_legend;
use crate::page;
use crate::subject::Asked;
use ppum_scene::deformed::words;
use ppum_scene::drawing::{Drawn, Seen};
use ppum_scene::layers::Layers;
use ppum_scene::range::Telling;

/// What a panel shows, and of which plate; several parts of a field are several plates.
type Subject<'a> = (&'a Plate<'a>, Asked);

impl Args {
    /// Draws each quantity of each plate in a panel.
    pub(super) fn panels(&self, plates: &[Plate<'_>], out: &mut Output) -> anyhow::Result<()> {
        let plate = &plates[0];
        let Plate { dataset, field, shown: title, .. } = plate;
        let subjects = self.subjects(plates)?;
        let worded = |title| self.look.worded(Labels { title, ..Labels::default() }).title;
        let labels = self.labels(&subjects, plates.len());
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let untold = worded(title.clone());
        let grid = self.grid(&untold, &captions, plates)?;
        let size = [grid.columns, grid.rows];
        let design = self.design(field, Look::page(self.window.aspect(field), size), size);
        let frame = self.frame(panel_area(&untold, &captions, grid, &design)?, &design);
        let seen = self.deformed.seen(field, &self.window, frame, &self.engine)?;
        let drawn = subjects.iter().map(|(plate, asked)| {
            let drawn = self.drawn(plate.field, &seen, asked)?;
            warn(asked, drawn.undefined());
            warn_of_infinite(asked, &drawn);
            Ok(drawn)
        });
        let drawn = drawn.collect::<anyhow::Result<Vec<_>>>()?;
        let mut pictures = self.pictures(&seen, &subjects, &drawn)?;
        let layers = subjects.iter().zip(drawn.iter().zip(&pictures));
        let layers = layers.map(|((plate, asked), (drawn, picture))| {
            self.layers(plate, &seen, asked, drawn, picture, &design)
        });
        let layers = layers.collect::<anyhow::Result<Vec<_>>>()?;
        let cracks = seen.cracks(field);
        let factor = seen.moved().map(|points| words(points.view.factor()));
        pictures.iter_mut().for_each(|picture| self.blank(picture));
        let panel = |((picture, labels), Layers { items, legend, .. })| Panel {
            picture,
            layers: items,
            legend,
            labels,
            cracks: &cracks,
            bar_of: None,
        };
        let all: Vec<Panel<'_>> =
            pictures.iter().zip(labels.clone()).zip(layers).map(panel).collect();
        let room = panel_area(&untold, &captions, grid, &design)?;
        let lacking = all.iter().filter(|panel| lacks_legend(panel, room, &design));
        let mut lacking: Vec<_> = lacking.map(|panel| &panel.legend).collect();
        lacking.dedup();
        lacking.into_iter().for_each(|legend| tell_legend(legend));
        let page = panels(&worded(titled(title.clone(), factor.as_deref())), &all, grid, &design)?;
        let names = subjects.iter().step_by(plates.len()).map(|(_, asked)| asked.name.as_str());
        let names = names.collect::<Vec<_>>().join(", ");
        let mut texts = pictures[0].description(&dataset.title, &self.subject.file_name(), &names);
        if !self.shared_range {
            // each panel has its own, on its bar
            let is_own =
                |key: &str| ["ppum:range", "ppum:range-basis", "ppum:extrema"].contains(&key);
            texts.retain(|(key, _)| !is_own(key));
        }
        let by = &drawn[0].by;
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(self.notes(plate, &seen));
        let ([columns, rows], parts) = (page.size, self.subject.replacements.captions());
        let names = [names].into_iter().chain(parts).collect::<Vec<_>>().join(", ");
        let told = told(&seen, drawn[0].overlap.len());
        let colors = self.colors(&Telling::new(dataset, field), &subjects, &labels, &pictures);
        let told = format!("{names}{told}, {columns}x{rows} pixels, {by}{colors}");
        page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    /// What the panels show: all parts of a quantity, then those of the next one.
    fn subjects<'a>(&self, plates: &'a [Plate<'a>]) -> anyhow::Result<Vec<Subject<'a>>> {
        let of = plates.iter().map(|plate| Ok(self.asked(plate.field)?.into_iter()));
        let mut of = of.collect::<anyhow::Result<Vec<_>>>()?;
        let mut all = Vec::new();
        while of[0].len() > 0 {
            all.extend(plates.iter().zip(of.iter_mut().filter_map(Iterator::next)));
        }
        Ok(all)
    }

    /// The arrangement: as given; else a row for each of several quantities of several parts, or that with the largest
    /// pictures.
    fn grid(&self, title: &str, captions: &[&str], plates: &[Plate<'_>]) -> anyhow::Result<Grid> {
        let (count, parts, shared_bar) = (captions.len(), plates.len(), self.shared_range);
        let of = |columns: usize| {
            let size = [columns as u32, count.div_ceil(columns) as u32];
            Grid { shared_bar, ..Grid::new(size) }
        };
        if let Some([columns, rows]) = self.layout {
            ensure!(columns.min(rows) > 0, "--layout: give at least 1x1 panels");
            let grid = Grid { shared_bar, ..Grid::new([columns, rows]) };
            ensure!(
                count <= grid.cells(),
                "--layout {columns}x{rows} has fewer panels than there are pictures, {count}"
            );
            return Ok(grid);
        }
        if parts > 1 && count > parts {
            return Ok(of(parts));
        }
        let field = plates[0].field;
        let aspect = self.window.aspect(field);
        let width = |grid: Grid| {
            let design = self.design(field, DEFAULT_SIZE, [grid.columns, grid.rows]);
            let [width, height] = panel_area(title, captions, grid, &design)?.map(f64::from);
            Ok::<_, FigureError>(width.min(height * aspect.unwrap_or(SHAPE)))
        };
        let fitting = (1..=count).filter_map(|n| Some((width(of(n)).ok()?, of(n))));
        let best = fitting.reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.map_or_else(|| Ok(width(of(count)).map(|_| of(count))?), |(_, grid)| Ok(grid))
    }

    /// The words of the panels, `(a) σ_yy` above the first; where one bar is for all it names what they share.
    fn labels(&self, subjects: &[Subject<'_>], parts: usize) -> Vec<Labels> {
        let captions = self.subject.replacements.captions();
        let is_one = subjects.len() == parts;
        let of = |(number, (plate, asked)): (usize, &Subject<'_>)| {
            let mut labels = asked.labels(String::new(), plate.field);
            let name = labels.quantity.clone();
            if self.shared_range && !is_one {
                labels.quantity.clear();
            }
            let mut labels = self.look.worded(labels);
            let caption = match captions.get(number % parts) {
                Some(part) if is_one => part.clone(),
                Some(part) => format!("{name}, {part}"),
                None => name,
            };
            labels.title = format!("({}) {caption}", letters(number));
            labels
        };
        subjects.iter().enumerate().map(of).collect()
    }

    /// What the colours of each panel mean, in lines of their own; those of one range once.
    fn colors(
        &self,
        telling: &Telling<'_>,
        subjects: &[Subject<'_>],
        labels: &[Labels],
        pictures: &[Picture],
    ) -> String {
        let has_parts = self.subject.has_parts();
        let line = |((subject, labels), picture): ((&Subject<'_>, &Labels), &Picture)| {
            let letter = labels.title.split(' ').next().filter(|_| has_parts).unwrap_or_default();
            let name = format!("{letter} {}", subject.1.name);
            format!("\n  {}: {}", name.trim_start(), telling.colors(picture))
        };
        let all = subjects.iter().zip(labels).zip(pictures).map(line);
        match pictures.first() {
            Some(first) if self.shared_range => format!("\n  {}", telling.colors(first)),
            _ => all.collect(),
        }
    }

    /// The values in colours, of one range for all if that is asked for.
    fn pictures(
        &self,
        seen: &Seen<'_>,
        subjects: &[Subject<'_>],
        drawn: &[Drawn],
    ) -> anyhow::Result<Vec<Picture>> {
        let all: Vec<_> = subjects.iter().map(|(_, asked)| asked).zip(drawn).collect();
        let styles = match self.shared_range {
            true => vec![self.colours.style_of(&all)?; all.len()],
            false => {
                let style = |pair| self.colours.style_of(std::slice::from_ref(pair));
                all.iter().map(style).collect::<anyhow::Result<_>>()?
            }
        };
        let spans =
            subjects.iter().zip(drawn).zip(&styles).map(|(((plate, asked), drawn), style)| {
                self.span(plate.field, seen, asked, drawn, style)
            });
        let mut spans = spans.collect::<anyhow::Result<Vec<_>>>()?;
        if self.shared_range {
            let shared = Span::shared(&spans, styles[0].colormap.diverging);
            spans.fill(shared.context("there is a range")?);
        }
        let picture = |(drawn, (style, span)): (&Drawn, (&Style, Span))| drawn.picture(style, span);
        Ok(drawn.iter().zip(styles.iter().zip(spans)).map(picture).collect::<Result<_, _>>()?)
    }
}

/// Width over height of pictures that have any shape.
const SHAPE: f64 = 4.0 / 3.0;
