//! What is drawn over the colours of a picture.

use std::str::FromStr;

use anyhow::{bail, ensure};
use clap::ValueEnum;
use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::{Axis, Quantity};
use ppum::vec2::Vec2;
use ppum_figure::canvas::Item;
use ppum_figure::levels;
use ppum_figure::overlay::{self, Entry, Load, Room, Support};
use ppum_figure::ticks::Notation;
use ppum_render::deform::DeformedPoints;
use ppum_render::glyph::{LEAST_SPACING, Lattice};
use ppum_render::isoline::{Isoline, isolines};
use ppum_render::picture::Picture;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_solve::problem::{Problem, Station};

use crate::arguments::positive;
use crate::drawing::Values;
use crate::output::tell;
use crate::progress::Bar;

/// Options of overlays.
#[derive(Debug, clap::Args)]
pub(crate) struct Overlays {
    /// What is drawn over the colours, in any number and order; a figure always shows the cracks
    #[arg(long, value_enum, value_delimiter = ',')]
    overlay: Vec<Overlay>,
    /// Isolines of the quantity: auto for round levels, N for about so many, or the levels
    #[arg(long, value_name = "auto|N|A,B,…", allow_hyphen_values = true)]
    isolines: Option<Levels>,
    /// Write their levels along the isolines
    #[arg(long, requires = "isolines")]
    level_labels: bool,
    /// Arrows of the displacement (of a potential its gradient), so many pixels apart [default: 36]
    #[arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true, default_missing_value = "36", value_parser = spacing)]
    arrows: Option<f64>,
    /// Crosses of the principal stresses, so many pixels apart [default: 36]
    #[arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true, default_missing_value = "36", value_parser = spacing)]
    crosses: Option<f64>,
}

/// The levels of isolines.
#[derive(Clone, Debug, PartialEq)]
enum Levels {
    Auto,
    Count(usize),
    At(Vec<f64>),
}

impl FromStr for Levels {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        if text == "auto" {
            return Ok(Self::Auto);
        }
        if !text.contains(',') {
            let count = text.parse().ok().filter(|count| (1..=1000).contains(count));
            return count.map(Self::Count).ok_or(
                "write auto, a number of levels from 1 to 1000, or their values with commas, `0.5,` for one",
            );
        }
        let number = |part: &str| part.trim().parse().ok().filter(|v: &f64| v.is_finite());
        let values: Option<Vec<f64>> =
            text.split(',').filter(|part| !part.trim().is_empty()).map(number).collect();
        let values = values.filter(|values| !values.is_empty());
        Ok(Self::At(values.ok_or("write finite values with commas between")?))
    }
}

/// Distance of arrows and crosses.
fn spacing(text: &str) -> Result<f64, String> {
    let value = positive(text)?;
    if value >= LEAST_SPACING {
        Ok(value)
    } else {
        Err(format!("write at least {LEAST_SPACING} pixels"))
    }
}

/// What overlays are drawn on.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    pub(crate) dataset: &'a Dataset,
    pub(crate) field: &'a Field<'a>,
    /// The quantity that is shown; none of values of cells, which have no isolines.
    pub(crate) quantity: Option<&'a Quantity>,
    pub(crate) picture: &'a Picture,
    pub(crate) values: &'a Values,
    /// A figure has its cracks whatever is asked for.
    pub(crate) is_figure: bool,
    /// True if a colour bar tells how numbers are written.
    pub(crate) has_bar: bool,
}

/// What is drawn over a picture, and the entries of a legend that has no room in it.
pub(crate) struct Layers {
    pub(crate) items: Vec<Item>,
    pub(crate) legend: Vec<Entry>,
}

impl Layers {
    /// Items with their legend over them if it has room.
    fn new(mut items: Vec<Item>, view: &View, legend: Vec<Entry>) -> Self {
        let inside = overlay::legend(view, &legend);
        let legend = if inside.is_empty() { legend } else { Vec::new() };
        items.extend(inside);
        Self { items, legend }
    }
}

/// Tells what a legend says that is nowhere drawn.
pub(crate) fn tell_legend(legend: &[Entry]) {
    if !legend.is_empty() {
        let words = legend.iter().map(|entry| entry.label.as_str()).collect::<Vec<_>>().join(", ");
        tell(&format!("warning: the picture is too small for its legend: {words}"));
    }
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

/// Most levels that are chosen by the program.
const AUTOMATIC: usize = 14;
/// Distance of supports and loads, in pixels of a picture 768 pixels high.
const SPACING: f64 = 30.0;
/// Room for them around the plate.
const MARGIN: f64 = 0.09;

impl Overlays {
    /// Draws them over a picture of the plate as it was before it was loaded.
    pub(crate) fn items(&self, ground: Ground<'_>) -> anyhow::Result<Layers> {
        let Ground { dataset, field, picture, is_figure, .. } = ground;
        let view = &picture.view;
        let mut wanted = self.overlay.clone();
        if is_figure {
            wanted.push(Overlay::Cracks);
        }
        wanted.sort_unstable();
        wanted.dedup();
        let stations = self.stations(view, dataset);
        let (glyphs, mut legend) =
            self.glyphs(ground, |spacing| Lattice::new(field, view, spacing))?;
        let mut centers = Vec::new();
        if wanted.contains(&Overlay::Centers) {
            let (items, entries) = overlay::centers(view, field);
            centers = items;
            legend.extend(entries);
        }
        let mut items = self.isolines(ground, overlay::legend_box(view, &legend))?;
        items.extend(glyphs);
        for overlay in wanted {
            items.extend(match overlay {
                Overlay::Patches => overlay::patches(view, &field.step.partition),
                Overlay::Cells => overlay::cells(view, &field.step.partition),
                Overlay::Points => overlay::points(view, &field.step.partition),
                Overlay::Centers => std::mem::take(&mut centers),
                Overlay::Rings => overlay::rings(view, &field.step.cracks, &field.step.intensities),
                Overlay::Cracks => {
                    let rims = overlay::rims(view, &field.domain.holes);
                    [rims, overlay::cracks(view, &field.step.cracks)].concat()
                }
                Overlay::Supports => overlay::supports(view, &supports(&stations)),
                Overlay::Loads => overlay::loads(view, &loads(&stations)),
            });
        }
        Ok(Layers::new(items, view, legend))
    }

    /// Refuses what the deformed plate does not have.
    pub(crate) fn check_deformed(&self) -> anyhow::Result<()> {
        let other = self.overlay.iter().find(|o| !matches!(o, Overlay::Cells | Overlay::Cracks));
        if let Some(other) = other.and_then(ValueEnum::to_possible_value) {
            bail!(
                "--overlay {}: of these overlays the deformed plate has cells and cracks alone",
                other.get_name()
            );
        }
        Ok(())
    }

    /// Isolines, found on the exact field; the picture's values say where to look for them.
    fn isolines(&self, ground: Ground<'_>, legend: Option<[Vec2; 2]>) -> anyhow::Result<Vec<Item>> {
        let Some(levels) = self.levels(ground.picture) else { return Ok(Vec::new()) };
        let Ground { field, picture, values, .. } = ground;
        let Some(quantity) = ground.quantity else { return Ok(Vec::new()) };
        let view = &picture.view;
        let (levels, bar) = (levels.as_slice(), Bar::new());
        let lines = match values {
            Values::Double(raster) => isolines(field, view, quantity, levels, raster, &bar),
            Values::Single(raster) => isolines(field, view, quantity, levels, raster, &bar),
        }?;
        let room = self.room(ground, &field.step.cracks, legend);
        Ok(self.shown(view, &lines, room))
    }

    /// Isolines of the plate as it was, where they have moved to.
    fn deformed_isolines(
        &self,
        ground: Ground<'_>,
        points: &DeformedPoints<'_>,
        legend: Option<[Vec2; 2]>,
    ) -> anyhow::Result<Vec<Item>> {
        let Some(levels) = self.levels(ground.picture) else { return Ok(Vec::new()) };
        let Some(view) = points.material_view() else { return Ok(Vec::new()) };
        let field = ground.field;
        let Some(quantity) = ground.quantity else { return Ok(Vec::new()) };
        let raster = render::<f64>(field, &view, quantity, &Bar::new())?;
        let lines = isolines(field, &view, quantity, &levels, &raster, &Bar::new())?;
        let lines = overlay::carried(&points.view, &lines);
        // cracks have opened, or closed: nothing can be said of their lines
        Ok(self.shown(&points.view.view, &lines, self.room(ground, &[], legend)))
    }

    /// Isolines, or a word that there are none of the levels that were listed; others lie in the range, if there is one.
    fn shown(&self, view: &View, lines: &[Isoline], room: Option<Room>) -> Vec<Item> {
        if let Some(Levels::At(_)) = self.isolines {
            warn_of_none(
                lines.len(),
                "isoline lies in the picture: its values pass none of the levels",
            );
        }
        overlay::isolines(view, lines, room)
    }

    /// Where labels of levels may stand, if they are asked for: not below a legend.
    fn room(
        &self,
        Ground { picture, has_bar, .. }: Ground<'_>,
        cracks: &[Crack],
        legend: Option<[Vec2; 2]>,
    ) -> Option<Room> {
        let notation = || match has_bar {
            true => Notation::of(&picture.normalization),
            false => Notation::PLAIN,
        };
        let all = self.level_labels.then(|| Room::new(picture, cracks, notation()));
        all.map(|room| legend.into_iter().fold(room, Room::without))
    }

    /// The levels of isolines, if they are asked for.
    fn levels(&self, picture: &Picture) -> Option<Vec<f64>> {
        let norm = &picture.normalization;
        self.isolines.as_ref().map(|levels| match levels {
            // nothing but rounding tells values apart
            _ if picture.one_value.is_some() => Vec::new(),
            Levels::Auto => levels::automatic(norm, AUTOMATIC),
            Levels::Count(count) => levels::about(norm, *count),
            Levels::At(values) => values.clone(),
        })
    }

    /// Arrows and crosses with what their lengths mean. `lattice` makes points with a spacing.
    fn glyphs<'f>(
        &self,
        Ground { field, picture: Picture { view, .. }, .. }: Ground<'_>,
        lattice: impl Fn(f64) -> Lattice<'f>,
    ) -> anyhow::Result<(Vec<Item>, Vec<Entry>)> {
        let (mut items, mut entries) = (Vec::new(), Vec::new());
        let mut add = |(more, meaning): (Vec<Item>, Vec<Entry>)| {
            items.extend(more);
            entries.extend(meaning);
        };
        if let Some(spacing) = self.crosses {
            ensure!(
                field.equation.elastic().is_some(),
                "--crosses: they show principal stresses, and a potential has none; --arrows shows its gradient"
            );
            let found = lattice(spacing).principal(&Bar::new())?;
            warn_of_none(found.len(), "cross stands in the picture; choose a smaller distance");
            add(overlay::crosses(view, &found, spacing));
        }
        if let Some(spacing) = self.arrows {
            let shown = match field.components() {
                2 => [Quantity::Component(0), Quantity::Component(1)],
                _ => [Quantity::Derivative(0, Axis::X), Quantity::Derivative(0, Axis::Y)],
            };
            let found = lattice(spacing).vectors(&shown, &Bar::new())?;
            warn_of_none(found.len(), "arrow stands in the picture; choose a smaller distance");
            add(overlay::arrows(view, &found, spacing));
        }
        Ok((items, entries))
    }

    /// Draws them over the deformed plate, which has its border and the faces of its cracks whatever is asked for in a figure; with
    /// the border of the undeformed plate if that is wanted.
    pub(crate) fn deformed_items(
        &self,
        ground: Ground<'_>,
        points: &DeformedPoints<'_>,
        with_outline: bool,
    ) -> anyhow::Result<Layers> {
        let has = |wanted: Overlay| self.overlay.contains(&wanted);
        let view = &points.view;
        let mut items = Vec::new();
        if with_outline {
            items.extend(overlay::undeformed_outline(view)?);
        }
        let (glyphs, legend) = self.glyphs(ground, |spacing| Lattice::deformed(points, spacing))?;
        let legend_box = overlay::legend_box(&view.view, &legend);
        items.extend(self.deformed_isolines(ground, points, legend_box)?);
        items.extend(glyphs);
        if has(Overlay::Cells) {
            items.extend(overlay::deformed_cells(view));
        }
        if ground.is_figure || has(Overlay::Cracks) {
            items.extend(overlay::deformed_outline(view));
            items.extend(overlay::faces(view));
        }
        Ok(Layers::new(items, &view.view, legend))
    }

    /// True if isolines are asked for.
    pub(crate) fn have_isolines(&self) -> bool {
        self.isolines.is_some()
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

/// Tells that nothing is drawn where something was asked for.
fn warn_of_none(count: usize, what: &str) {
    if count == 0 {
        tell(&format!("warning: no {what}"));
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
