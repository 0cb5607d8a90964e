//! The figure of a comparison.

use ppum::field::Field;
use ppum_figure::canvas::{Canvas, Item};
use ppum_figure::figure::{Design, Labels, Panel, figure};
use ppum_figure::overlay;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Range;
use ppum_render::raster::Raster;
use ppum_render::resample::norms::difference;
use ppum_render::scale::Scale;
use ppum_render::view::View;

use super::measure::Measurements;

/// The look of the panels.
pub(super) struct Look<'a> {
    pub(super) field: &'a Field<'a>,
    pub(super) view: View,
    pub(super) style: Style,
    /// Those of the direct picture.
    pub(super) labels: Labels,
}

impl Look<'_> {
    /// All panels, and the picture of the direct one. Of one method they stand in a row: direct, resampled,
    /// difference; of several the differences stand below what they belong to.
    pub(super) fn sheet(
        self,
        found: &Measurements,
        size: [u32; 2],
    ) -> anyhow::Result<(Canvas, Picture)> {
        let direct = Picture::bare(&found.direct, &self.view, &self.style)?;
        let norm = &direct.normalization;
        let fixed = Style { range: Range::Fixed(norm.min(), norm.max()), ..self.style.clone() };
        let mut first = vec![self.panel(&found.direct, &self.style, "direct", size)?];
        let mut second = vec![Canvas::new([0, 0], [0; 4])];
        for one in &found.resampled {
            first.push(self.panel(&one.raster, &fixed, &one.name(), size)?);
            let apart = difference(&found.direct, &one.raster);
            let title = format!("{} − direct", one.name());
            second.push(self.panel(&apart, &signed()?, &title, size)?);
        }
        let rows = match found.resampled.len() {
            1 => vec![first.into_iter().chain(second.into_iter().skip(1)).collect()],
            _ => vec![first, second],
        };
        Ok((side_by_side(&rows, size), direct))
    }

    fn panel(
        &self,
        raster: &Raster,
        style: &Style,
        title: &str,
        size: [u32; 2],
    ) -> anyhow::Result<Canvas> {
        let picture = Picture::bare(raster, &self.view, style)?;
        let labels = Labels { title: title.to_owned(), ..self.labels.clone() };
        let cracks = &self.field.step.cracks;
        let rims = overlay::rims(&self.view, &self.field.domain.holes);
        let layers = [rims, overlay::cracks(&self.view, cracks)].concat();
        let panel = Panel { picture: &picture, layers, labels, cracks, shares_next: false };
        Ok(figure(panel, &Design::pixels(size))?)
    }
}

/// Colours of differences.
fn signed() -> anyhow::Result<Style> {
    Ok(Style { scale: Scale::Linear, ..Style::named("coolwarm")? })
}

/// Panels of one size in rows.
fn side_by_side(rows: &[Vec<Canvas>], size: [u32; 2]) -> Canvas {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0) as u32;
    let mut page = Canvas::new([columns * size[0], rows.len() as u32 * size[1]], [255; 4]);
    for (j, row) in (0..).zip(rows) {
        for (i, panel) in (0..).zip(row) {
            let (corner, canvas) = ([i * size[0], j * size[1]], panel.clone());
            page.items.push(Item::Inset { corner, canvas });
        }
    }
    page
}
