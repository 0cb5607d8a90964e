//! Several quantities in one figure.

use anyhow::{Context as _, ensure};
use ppum::field::Field;
use ppum_figure::figure::{Grid, Labels, Panel, panel_area, panels};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Span;

use super::{Args, Plate, titled, told, warn};
use crate::deformed::words;
use crate::drawing::{Drawn, Seen};
use crate::output::Output;
use crate::page;
use crate::range::Telling;
use crate::subject::Asked;

impl Args {
    /// Draws the quantities, each in a panel.
    pub(super) fn panels(
        &self,
        plate: &Plate<'_>,
        [columns, rows]: [u32; 2],
        out: &mut Output,
    ) -> anyhow::Result<()> {
        let (field, title) = (plate.field, plate.shown.clone());
        let grid = Grid { columns, rows, shared_bar: self.shared_range };
        let subjects = self.asked(field, grid)?;
        let worded = |title| self.look.worded(Labels { title, ..Labels::default() }).title;
        let labels: Vec<Labels> =
            subjects.iter().zip(0..).map(|(s, k)| self.words(s, k, field)).collect();
        let design = self.look.design(self.window.aspect(field));
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let frame = self.frame(panel_area(&worded(title.clone()), &captions, grid, &design)?);
        let seen = self.deformed.seen(field, &self.window, frame, &self.engine)?;
        let drawn = subjects.iter().map(|subject| {
            let drawn = self.drawn(field, &seen, subject)?;
            warn(&subject.name, drawn.undefined());
            Ok(drawn)
        });
        let drawn = drawn.collect::<anyhow::Result<Vec<_>>>()?;
        let mut pictures = self.pictures(field, &seen, &subjects, &drawn)?;
        let layers = subjects.iter().zip(drawn.iter().zip(&pictures));
        let layers = layers
            .map(|(asked, (drawn, picture))| self.layers(plate, &seen, asked, drawn, picture));
        let layers = layers.collect::<anyhow::Result<Vec<_>>>()?;
        let cracks = seen.cracks(field);
        let factor = seen.moved().map(|points| words(points.view.factor()));
        pictures.iter_mut().for_each(|picture| self.blank(picture));
        let panel =
            |((picture, labels), layers)| Panel { picture, layers, labels, cracks: &cracks };
        let all: Vec<Panel<'_>> = pictures.iter().zip(labels).zip(layers).map(panel).collect();
        let page = panels(&worded(titled(title, factor.as_deref())), &all, grid, &design)?;
        let names: Vec<&str> = subjects.iter().map(|subject| subject.name.as_str()).collect();
        let (names, picture, by) = (names.join(", "), &pictures[0], &drawn[0].by);
        let mut texts =
            picture.description(&plate.dataset.title, &self.subject.file_name(), &names);
        if !self.shared_range {
            // each panel has its own, on its bar
            let is_own =
                |key: &str| ["ppum:range", "ppum:range-basis", "ppum:extrema"].contains(&key);
            texts.retain(|(key, _)| !is_own(key));
        }
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(self.notes(plate, &seen));
        let [columns, rows] = page.size;
        let told = told(&seen, drawn[0].overlap.len());
        let colors = self.colors(&Telling::new(plate.dataset, field), &subjects, &pictures);
        let told = format!("{names}{told}, {columns}x{rows} pixels, {by}{colors}");
        page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    fn asked(&self, field: &Field<'_>, grid: Grid) -> anyhow::Result<Vec<Asked>> {
        ensure!(grid.columns.min(grid.rows) > 0, "--layout: give at least 1x1 panels");
        let asked = self.subject.quantities(field)?;
        ensure!(
            asked.len() <= grid.cells(),
            "--layout {}x{} has fewer panels than there are quantities, {}",
            grid.columns,
            grid.rows,
            asked.len()
        );
        Ok(asked)
    }

    /// The words of a panel, `(a) σ_yy` above it; where one bar is for all it names nothing but the unit.
    fn words(&self, subject: &Asked, number: u8, field: &Field<'_>) -> Labels {
        let mut labels = subject.labels(String::new(), field);
        let name = labels.quantity.clone();
        if self.shared_range {
            labels.quantity.clear();
        }
        let mut labels = self.look.worded(labels);
        // after z comes {, but nobody has that many
        labels.title = format!("({}) {name}", char::from(b'a'.saturating_add(number)));
        labels
    }

    /// What the colours of each panel mean, in lines of their own; those of one range once.
    fn colors(&self, telling: &Telling<'_>, subjects: &[Asked], pictures: &[Picture]) -> String {
        let line = |(subject, picture): (&Asked, &Picture)| {
            format!("\n  {}: {}", subject.name, telling.colors(picture))
        };
        let all = subjects.iter().zip(pictures).map(line);
        match pictures.first() {
            Some(first) if self.shared_range => format!("\n  {}", telling.colors(first)),
            _ => all.collect(),
        }
    }

    /// The values in colours, of one range for all if that is asked for.
    fn pictures(
        &self,
        field: &Field<'_>,
        seen: &Seen<'_>,
        subjects: &[Asked],
        drawn: &[Drawn],
    ) -> anyhow::Result<Vec<Picture>> {
        let styles = subjects.iter().map(|subject| self.colours.style(&subject.quantity));
        let mut styles = styles.collect::<anyhow::Result<Vec<_>>>()?;
        let all = subjects.iter().zip(drawn).zip(&styles);
        let spans = all.map(|((asked, drawn), style)| self.span(field, seen, asked, drawn, style));
        let mut spans = spans.collect::<anyhow::Result<Vec<_>>>()?;
        if self.shared_range {
            let first = styles.first().context("there is a quantity")?.clone();
            let shared = Span::shared(&spans, first.colormap.diverging);
            spans.fill(shared.context("there is a range")?);
            styles.fill(first);
        }
        let picture = |(drawn, (style, span)): (&Drawn, (&Style, Span))| drawn.picture(style, span);
        Ok(drawn.iter().zip(styles.iter().zip(spans)).map(picture).collect::<Result<_, _>>()?)
    }
}
