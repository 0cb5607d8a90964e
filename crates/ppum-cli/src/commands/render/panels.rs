//! Several quantities in one figure.

use anyhow::{Context as _, ensure};
use ppum::field::Field;
use ppum_figure::figure::{Grid, Labels, Panel, panel_area, panels};
use ppum_render::picture::Picture;
use ppum_render::range::Range;
use ppum_render::view::View;

use super::{Args, Plate};
use crate::drawing::{Drawn, Job};
use crate::output::Output;
use crate::page;
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
        let title = self.look.worded(Labels { title, ..Labels::default() }).title;
        let labels: Vec<Labels> =
            subjects.iter().zip(0..).map(|(s, k)| self.words(s, k, field)).collect();
        let design = self.look.design(self.window.aspect(field));
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let frame = self.frame(panel_area(&title, &captions, grid, &design)?);
        let view = self.window.seen(field, frame)?;
        let drawn = self.drawn(field, &view, &subjects)?;
        let mut pictures = self.pictures(&subjects, &drawn)?;
        let layers = subjects.iter().zip(drawn.iter().zip(&pictures));
        let layers = layers
            .map(|(asked, (drawn, picture))| self.layers(plate, asked, &drawn.values, picture));
        let layers = layers.collect::<anyhow::Result<Vec<_>>>()?;
        pictures.iter_mut().for_each(|picture| self.blank(picture));
        let panel = |((picture, labels), layers)| Panel {
            picture,
            layers,
            labels,
            cracks: &field.step.cracks,
            shares_next: false,
        };
        let all: Vec<Panel<'_>> = pictures.iter().zip(labels).zip(layers).map(panel).collect();
        let page = panels(&title, &all, grid, &design)?;
        let names: Vec<&str> = subjects.iter().map(|subject| subject.name.as_str()).collect();
        let (names, picture, by) = (names.join(", "), &pictures[0], &drawn[0].by);
        let mut texts =
            picture.description(&plate.dataset.title, &self.subject.file_name(), &names);
        if !self.shared_range {
            // each panel has its own, on its bar
            texts.retain(|(key, _)| key != "ppum:range");
        }
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(self.subject.replacements.notes());
        let [columns, rows] = page.size;
        let told = format!("{names}, {columns}x{rows} pixels, {by}");
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

    /// The values of each panel.
    fn drawn(
        &self,
        field: &Field<'_>,
        view: &View,
        subjects: &[Asked],
    ) -> anyhow::Result<Vec<Drawn>> {
        let draw = |subject: &Asked| {
            let drawn = self.engine.draw(Job { field, view, quantity: &subject.quantity })?;
            drawn.warn(&subject.name);
            Ok(drawn)
        };
        subjects.iter().map(draw).collect()
    }

    /// The values in colours, of one range for all if that is asked for.
    fn pictures(&self, subjects: &[Asked], drawn: &[Drawn]) -> anyhow::Result<Vec<Picture>> {
        let own = |(subject, drawn): (&Asked, &Drawn)| {
            Ok(drawn.picture(&self.colours.style(&subject.quantity)?)?)
        };
        let own = subjects.iter().zip(drawn).map(own).collect::<anyhow::Result<Vec<_>>>()?;
        if !self.shared_range {
            return Ok(own);
        }
        let subject = subjects.first().context("there is a quantity")?;
        let mut style = self.colours.style(&subject.quantity)?;
        if self.colours.is_automatic() {
            let norms = || own.iter().map(|picture| &picture.normalization);
            let min = norms().map(|norm| norm.min()).fold(f64::INFINITY, f64::min);
            let max = norms().map(|norm| norm.max()).fold(f64::NEG_INFINITY, f64::max);
            style.range = Range::Fixed(min, max);
        }
        Ok(drawn.iter().map(|drawn| drawn.picture(&style)).collect::<Result<_, _>>()?)
    }
}
