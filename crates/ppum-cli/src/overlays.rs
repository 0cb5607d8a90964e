//! What is drawn over the colours of a picture.

use anyhow::bail;
use clap::ValueEnum;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_figure::canvas::Item;
use ppum_figure::overlay::{self, Load, Support};
use ppum_render::deform::DeformedView;
use ppum_render::view::View;
use ppum_solve::problem::{Problem, Station};

use crate::output::tell;

/// Options of overlays.
#[derive(Debug, clap::Args)]
pub(crate) struct Overlays {
    /// What is drawn over the colours, in any number and order; a figure always shows the cracks
    #[arg(long, value_enum, value_delimiter = ',')]
    overlay: Vec<Overlay>,
}

/// In the order in which they are drawn, the lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
enum Overlay {
    /// Supports of the patches, which overlap
    Patches,
    /// Borders of the cover's cells
    Cells,
    /// Points the cover was made from
    Points,
    /// Centres of the cells, coloured by the kind of enrichment
    Centers,
    /// Rings that the stress intensity factors are integrated over
    Rings,
    /// Cracks with their tips, and rims of holes
    Cracks,
    /// Supports of the plate, as its problem file has them
    Supports,
    /// Loads on the plate, as its problem file has them
    Loads,
}

/// Distance of supports and loads, in pixels of a picture 768 pixels high.
const SPACING: f64 = 30.0;
/// Room for them around the plate.
const MARGIN: f64 = 0.09;

impl Overlays {
    /// Draws them over a view of a step of the dataset; a figure has its cracks whatever is asked for.
    pub(crate) fn items(
        &self,
        view: &View,
        dataset: &Dataset,
        field: &Field<'_>,
        is_figure: bool,
    ) -> Vec<Item> {
        let mut wanted = self.overlay.clone();
        if is_figure {
            wanted.push(Overlay::Cracks);
        }
        wanted.sort_unstable();
        wanted.dedup();
        let stations = self.stations(view, dataset);
        let (mut items, mut legend) = (Vec::new(), Vec::new());
        for overlay in wanted {
            items.extend(match overlay {
                Overlay::Patches => overlay::patches(view, &field.step.partition),
                Overlay::Cells => overlay::cells(view, &field.step.partition),
                Overlay::Points => overlay::points(view, &field.step.partition),
                Overlay::Centers => {
                    let (centers, entries) = overlay::centers(view, field);
                    legend.extend(entries);
                    centers
                }
                Overlay::Rings => overlay::rings(view, &field.step.cracks, &field.step.intensities),
                Overlay::Cracks => {
                    let rims = overlay::rims(view, &field.domain.holes);
                    [rims, overlay::cracks(view, &field.step.cracks)].concat()
                }
                Overlay::Supports => overlay::supports(view, &supports(&stations)),
                Overlay::Loads => overlay::loads(view, &loads(&stations)),
            });
        }
        items.extend(overlay::legend(view, &legend));
        items
    }

    /// Draws them over the deformed plate, which has its border and the faces of its cracks whatever is asked for in a figure; with
    /// the border of the undeformed plate if that is wanted.
    pub(crate) fn deformed_items(
        &self,
        view: &DeformedView<'_>,
        is_figure: bool,
        with_outline: bool,
    ) -> anyhow::Result<Vec<Item>> {
        let has = |wanted: Overlay| self.overlay.contains(&wanted);
        let other = self.overlay.iter().find(|o| !matches!(o, Overlay::Cells | Overlay::Cracks));
        if let Some(other) = other.and_then(ValueEnum::to_possible_value) {
            bail!(
                "--overlay {}: the deformed plate is drawn with cells and cracks alone",
                other.get_name()
            );
        }
        let mut items = Vec::new();
        if with_outline {
            items.extend(overlay::undeformed_outline(view)?);
        }
        if has(Overlay::Cells) {
            items.extend(overlay::deformed_cells(view));
        }
        if is_figure || has(Overlay::Cracks) {
            items.extend(overlay::deformed_outline(view));
            items.extend(overlay::faces(view));
        }
        Ok(items)
    }

    /// Room around the plate for what stands outside of it, in parts of the plate's larger side.
    pub(crate) fn margin(&self) -> f64 {
        if self.have_stations() { MARGIN } else { 0.0 }
    }

    fn have_stations(&self) -> bool {
        self.overlay.iter().any(|o| matches!(o, Overlay::Supports | Overlay::Loads))
    }

    /// Points along the border with supports and loads; none if nobody asks for them.
    fn stations(&self, view: &View, dataset: &Dataset) -> Vec<Station> {
        if !self.have_stations() {
            return Vec::new();
        }
        match Problem::of_dataset(dataset) {
            Ok(Some(problem)) => {
                let side = f64::from(view.pixels[0].min(view.pixels[1]));
                return problem.stations(SPACING * (side / 768.0).max(1.0) * view.pixel_size());
            }
            Ok(None) => tell(
                "warning: the dataset holds no problem file, so its supports and loads are not known",
            ),
            Err(_) => tell(
                "warning: the dataset's problem file cannot be read, so its supports and loads are not known",
            ),
        }
        Vec::new()
    }
}

fn supports(stations: &[Station]) -> Vec<Support> {
    let held = stations.iter().filter(|station| station.held != [false; 2]);
    held.map(|&Station { at, outward, held, .. }| Support { at, outward, held }).collect()
}

fn loads(stations: &[Station]) -> Vec<Load> {
    let loaded = stations.iter().filter(|station| station.traction != Vec2::ZERO);
    loaded.map(|&Station { at, outward, traction, .. }| Load { at, outward, traction }).collect()
}
