//! `ppum compare`: a direct image beside what resampling gives.

mod args;
mod arrangement;
mod measure;
mod report;

use std::io::Write as _;
use std::path::Path;

use anyhow::ensure;
use ppum_figure::figure::Labels;
use ppum_render::picture::ColoredRaster;
use ppum_render::png::TextChunk;
use ppum_render::resample::Interpolation;

use crate::number::json;
use crate::output::{StandardStream, tell};
use crate::standard::is_standard;
use crate::{page, target, threads};
pub(crate) use args::CompareArgs;
use args::ComparisonRegion;
use arrangement::PanelArrangement;
use measure::{Measurements, measure};
use ppum_scene::arguments::MOST_OF_PAGE;
use ppum_scene::range::RangeLocations;
use ppum_scene::region::ImageExtent;
use report::{ComparisonReport, table};

/// Refuses pages that are too large: everything else on them is drawn as large as they are.
fn check_page([columns, rows]: [u32; 2]) -> anyhow::Result<()> {
    ensure!(
        u64::from(columns) * u64::from(rows) <= MOST_OF_PAGE,
        "a page of {columns}x{rows} pixels; at most {MOST_OF_PAGE}, such as 8192x8192"
    );
    Ok(())
}

impl CompareArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        if let Some(path) = &self.output {
            target::check(path, target::FileKind::Picture, self.inputs())?;
        }
        ensure!(
            !self.json || !self.output.as_deref().is_some_and(is_standard),
            "the picture and JSON cannot both go to standard output; give a file with -o"
        );
        let dataset = self.subject.step.open()?;
        let field = self.subject.step.field(&dataset)?;
        let (quantity, name) = self.subject.quantity(&field)?;
        let methods = self.methods();
        let title = self.subject.step.replacements.title(&dataset.title);
        let symbol = quantity.symbol(&field.data.components);
        let unit = quantity.unit(&field).to_owned();
        let labels = Labels { title, quantity: symbol, unit, ..Labels::default() };
        let labels = self.labels.texts().applied(labels);
        let layout = PanelArrangement::new(self, &field, &labels, &methods);
        check_page(layout.size())?;
        let frame = ImageExtent { pixels: layout.room()?, may_shrink: true, margin: 0.0 };
        let view = self.place.seen(field.domain.bounds, &field, frame)?;
        let job = measure::ComparisonInput { field: &field, view, quantity: &quantity, args: self };
        let found = threads::with(self.threads, || measure(job, &methods))??;
        let report = ComparisonReport::new(&self.subject.file_name(), &name, &view, &found);
        let mut told = String::new();
        if let Some(path) = &self.output {
            let colors = &self.colors;
            let style = colors.style(Some(&quantity), colors.map(Some(&quantity))?);
            let (page, direct) = layout.draw(&found, job, &style)?;
            let texts = self.texts(&direct, &dataset.title, &name, &found);
            page::put(path, &page, self.look.given_dpi(), &texts, out)?;
            let ([columns, rows], telling) = (page.size, RangeLocations::new(&dataset, &field));
            told = format!("{columns}x{rows} pixels, direct: {}", telling.colors(&direct));
        }
        self.tell(&report, &told, out)
    }

    /// The interpolations, each once; none for the cells of the cover.
    fn methods(&self) -> Vec<Option<Interpolation>> {
        let mut methods = Vec::new();
        for method in self.method.iter().flat_map(|method| method.meant()) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }

    /// The texts of the figure's file.
    fn texts(
        &self,
        direct: &ColoredRaster,
        title: &str,
        name: &str,
        found: &Measurements,
    ) -> Vec<TextChunk> {
        let file = self.subject.file_name();
        let mut texts = direct.description(title, &file, name);
        for (key, text) in &mut texts {
            if key == "Description" {
                *text = format!("{name} of {file}, direct and resampled");
            }
        }
        let methods = found.methods.iter().map(|one| ("ppum:resampled".to_owned(), one.name()));
        texts.extend(methods.chain(self.subject.step.replacements.notes()));
        texts
    }

    /// Numbers on standard output, unless the image goes there; of that what its colours mean.
    fn tell(
        &self,
        report: &ComparisonReport,
        told: &str,
        out: &mut StandardStream,
    ) -> anyhow::Result<()> {
        if self.json {
            return Ok(json(out, report)?);
        }
        let table = table(report);
        match &self.output {
            Some(path) if is_standard(path) => {
                [told].into_iter().chain(table.lines()).for_each(tell)
            }
            Some(path) => writeln!(out, "wrote {}: {told}\n{}", path.display(), table.trim_end())?,
            None => write!(out, "{table}")?,
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let map = self.colors.colormap.as_deref().map(Path::new);
        self.subject.inputs().chain(map)
    }
}
