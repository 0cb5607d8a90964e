//! The figure of a comparison.
//!
//! For one method, its panels (resampled, direct, difference) form a row, or a column for long
//! plates. For several methods, the differences form a second row or column. The field and its
//! resampled images share one colour bar.

use ppum::field::Field;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{FigureError, FigureStyle, Labels, Panel, PanelGrid, panel_area, panels};
use ppum_figure::overlay;
use ppum_render::extrema::{BodyRegion, extrema};
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::RangeChoice;
use ppum_render::raster::Raster;
use ppum_render::resample::Interpolation;
use ppum_render::resample::norms::difference;
use ppum_scene::compare::signed;
use ppum_scene::page_style::{LONG, PageStyle};
use ppum_scene::panels::letters;

use super::CompareArgs;
use super::measure::{ComparisonInput, Measurements, name};
use crate::progress::ProgressLine;

/// The panels of the page and their arrangement.
pub(super) struct PanelArrangement {
    title: String,
    panels: Vec<Shows>,
    /// Labels of the panels; their titles are the captions.
    labels: Vec<Labels>,
    grid: PanelGrid,
    design: FigureStyle,
}

/// The content of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shows {
    Direct,
    /// By the number of the method.
    Resampled(usize),
    Difference(usize),
}

impl PanelArrangement {
    /// The page for some methods; `labels` are the labels of the field.
    pub(super) fn new(
        args: &CompareArgs,
        field: &Field<'_>,
        labels: &Labels,
        methods: &[Option<Interpolation>],
    ) -> Self {
        let aspect = args.place.aspect(field.domain.bounds);
        let is_long = aspect.is_some_and(|aspect| aspect > LONG);
        let panels = Shows::all(methods.len(), is_long);
        let [across, down] = match (methods.len(), is_long) {
            (1, false) => [3, 1],
            (1, true) => [1, 3],
            (count, false) => [count as u32 + 1, 2],
            (count, true) => [2, count as u32 + 1],
        };
        let design =
            args.look.design(aspect, PageStyle::page(aspect, [across, down]), [across, down]);
        let names: Vec<String> = methods.iter().map(|method| name(*method, args.grid)).collect();
        let words = |(number, shows): (usize, &Shows)| {
            let (caption, quantity) = match *shows {
                Shows::Direct => ("direct".to_owned(), labels.quantity.clone()),
                Shows::Resampled(k) => (names[k].clone(), labels.quantity.clone()),
                Shows::Difference(k) => {
                    (format!("{} − direct", names[k]), format!("difference of {}", labels.quantity))
                }
            };
            let title = format!("({}) {caption}", letters(number));
            Labels { title, quantity, ..labels.clone() }
        };
        let words = panels.iter().enumerate().map(words).collect();
        // a column of images has its colour bar below the last one
        let barred = match (methods.len(), is_long) {
            (1, false) => [2, 1],
            (1, true) => [1, 2],
            _ => [across, down],
        };
        let grid = PanelGrid { barred: Some(barred), ..PanelGrid::new([across, down]) };
        Self { title: labels.title.clone(), panels, labels: words, grid, design }
    }

    /// Columns and rows of the page.
    pub(super) fn size(&self) -> [u32; 2] {
        self.design.size
    }

    /// The columns and rows of pixels that each image has room for.
    pub(super) fn room(&self) -> Result<[u32; 2], FigureError> {
        let captions: Vec<&str> = self.labels.iter().map(|labels| labels.title.as_str()).collect();
        panel_area(&self.title, &captions, self.grid, &self.design)
    }

    /// Draws the page; also returns the direct image of the field.
    pub(super) fn draw(
        &self,
        found: &Measurements,
        job: ComparisonInput<'_>,
        style: &Style,
    ) -> anyhow::Result<(Canvas, ColoredRaster)> {
        let ComparisonInput { field, view, .. } = job;
        let view = &view;
        let direct = direct(&found.direct, job, style)?;
        let norm = &direct.normalization;
        let fixed = Style { range: RangeChoice::Fixed(norm.min(), norm.max()), ..style.clone() };
        let picture = |shows: &Shows| match *shows {
            Shows::Direct => Ok(direct.clone()),
            Shows::Resampled(k) => {
                Ok(ColoredRaster::bare(&found.methods[k].resampled.raster, view, &fixed)?)
            }
            Shows::Difference(k) => {
                let apart = difference(&found.direct, &found.methods[k].resampled.raster);
                Ok(signed(&apart, view)?)
            }
        };
        let pictures = self.panels.iter().map(picture).collect::<anyhow::Result<Vec<_>>>()?;
        let (cracks, scale) = (&field.step.cracks, self.design.scale());
        let rims = overlay::rims(view, scale, &field.domain.holes, [None; 2]);
        let layers = [rims, overlay::cracks(view, scale, cracks)].concat();
        let bar = self.panels.iter().position(|shows| *shows == Shows::Direct);
        let panel = |((shows, labels), picture): ((&Shows, &Labels), _)| Panel {
            picture,
            layers: layers.clone(),
            legend: Vec::new(),
            labels: labels.clone(),
            cracks,
            bar_of: bar.filter(|_| matches!(shows, Shows::Resampled(_))),
        };
        let all = self.panels.iter().zip(&self.labels).zip(&pictures).map(panel);
        let all: Vec<Panel<'_>> = all.collect();
        Ok((panels(&self.title, &all, self.grid, &self.design)?, direct))
    }
}

impl Shows {
    /// All panels, ordered by rows or by columns of the page.
    fn all(methods: usize, in_columns: bool) -> Vec<Self> {
        let resampled = (0..methods).map(Self::Resampled);
        let differences = (0..methods).map(Self::Difference);
        if in_columns && methods > 1 {
            let pairs = resampled.zip(differences).flat_map(|(one, other)| [one, other]);
            return pairs.chain([Self::Direct]).collect();
        }
        resampled.chain([Self::Direct]).chain(differences).collect()
    }
}

/// The direct image; its automatic range is found from the true extrema.
fn direct(
    raster: &Raster,
    job: ComparisonInput<'_>,
    style: &Style,
) -> anyhow::Result<ColoredRaster> {
    let ComparisonInput { field, view, quantity, .. } = job;
    let values = match BodyRegion::seen(field, &view).filter(|_| style.range.is_found()) {
        Some(region) => extrema(field, &region, quantity, &ProgressLine::new())?,
        None => None,
    };
    let span = style.range.span(style.scale, style.colormap.diverging, raster, values);
    Ok(ColoredRaster::spanning(raster, &view, style, span)?)
}
