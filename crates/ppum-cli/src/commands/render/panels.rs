//! Several quantities, or parts of a field, in one figure.

use anyhow::ensure;
use ppum_figure::figure::{Design, FigureError, Grid, Labels, Panel, panel_area, panels};
use ppum_render::picture::Picture;
use ppum_render::range::Range;

use super::{Args, Plate, titled, told};
use crate::drawing::Drawn;
use crate::look::letters;
use crate::output::Output;
use crate::page;
use crate::subject::Asked;

/// What a panel shows, and of which plate; several parts of a field are several plates.
type Subject<'a> = (&'a Plate<'a>, Asked);

impl Args {
    /// Draws each quantity of each plate in a panel.
    pub(super) fn panels(&self, plates: &[Plate<'_>], out: &mut Output) -> anyhow::Result<()> {
        let Plate { dataset, field, shown: title } = &plates[0];
        let subjects = self.subjects(plates)?;
        let worded = |title| self.look.worded(Labels { title, ..Labels::default() }).title;
        let labels = self.labels(&subjects, plates.len());
        let design = self.design(field);
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let untold = worded(title.clone());
        let grid = self.grid(&untold, &captions, plates, &design)?;
        let frame = self.frame(panel_area(&untold, &captions, grid, &design)?);
        let seen = self.deformed.seen(field, &self.window, frame, &self.engine)?;
        let drawn = subjects.iter().map(|(plate, asked)| self.drawn(plate.field, &seen, asked));
        let drawn = drawn.collect::<anyhow::Result<Vec<_>>>()?;
        let mut pictures = self.pictures(&subjects, &drawn)?;
        let layers = subjects.iter().zip(drawn.iter().zip(&pictures));
        let layers = layers.map(|((plate, asked), (drawn, picture))| {
            self.layers(plate, &seen, asked, &drawn.values, picture)
        });
        let layers = layers.collect::<anyhow::Result<Vec<_>>>()?;
        let cracks = seen.cracks(field);
        pictures.iter_mut().for_each(|picture| self.blank(picture));
        let panel = |((picture, labels), layers)| Panel {
            picture,
            layers,
            labels,
            cracks: &cracks,
            bar_of: None,
        };
        let all: Vec<Panel<'_>> = pictures.iter().zip(labels).zip(layers).map(panel).collect();
        let page = panels(&worded(titled(title.clone(), &seen)), &all, grid, &design)?;
        let names = subjects.iter().step_by(plates.len()).map(|(_, asked)| asked.name.as_str());
        let names = names.collect::<Vec<_>>().join(", ");
        let mut texts = pictures[0].description(&dataset.title, &self.subject.file_name(), &names);
        if !self.shared_range {
            // each panel has its own, on its bar
            texts.retain(|(key, _)| key != "ppum:range");
        }
        let by = &drawn[0].by;
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(self.notes(&seen));
        let ([columns, rows], parts) = (page.size, self.subject.replacements.captions());
        let names = [names].into_iter().chain(parts).collect::<Vec<_>>().join(", ");
        let told = told(&seen, drawn[0].overlap.len());
        let told = format!("{names}{told}, {columns}x{rows} pixels, {by}");
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
    fn grid(
        &self,
        title: &str,
        captions: &[&str],
        plates: &[Plate<'_>],
        design: &Design,
    ) -> anyhow::Result<Grid> {
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
        let aspect = self.window.aspect(plates[0].field);
        let width = |grid: Grid| {
            let [width, height] = panel_area(title, captions, grid, design)?.map(f64::from);
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

    /// The values in colours, of one range for all if that is asked for.
    fn pictures(&self, subjects: &[Subject<'_>], drawn: &[Drawn]) -> anyhow::Result<Vec<Picture>> {
        let all: Vec<_> = subjects.iter().map(|(_, asked)| asked).zip(drawn).collect();
        let own = |pair: &(&Asked, &Drawn)| {
            Ok(pair.1.picture(&self.colours.style_of(std::slice::from_ref(pair))?)?)
        };
        let own = all.iter().map(own).collect::<anyhow::Result<Vec<_>>>()?;
        if !self.shared_range {
            return Ok(own);
        }
        let mut style = self.colours.style_of(&all)?;
        if self.colours.is_automatic() && style.colormap.classes().is_empty() {
            let norms = || own.iter().map(|picture| &picture.normalization);
            let min = norms().map(|norm| norm.min()).fold(f64::INFINITY, f64::min);
            let max = norms().map(|norm| norm.max()).fold(f64::NEG_INFINITY, f64::max);
            style.range = Range::Fixed(min, max);
        }
        Ok(drawn.iter().map(|drawn| drawn.picture(&style)).collect::<Result<_, _>>()?)
    }
}

/// Width over height of pictures that have any shape.
const SHAPE: f64 = 4.0 / 3.0;
