//! Options of what is drawn over the colours of a picture.

use anyhow::{bail, ensure};
use clap::ValueEnum;
use ppum_figure::overlay::Entry;
use ppum_render::glyph::LEAST_SPACING;
use ppum_scene::drawing::Seen;
use ppum_scene::layers::{Ground, Layers};
use ppum_scene::overlays::{self, Levels, Overlay};

use crate::arguments::positive;
use crate::output::tell;
use crate::progress::Bar;

/// Options of overlays.
#[derive(Debug, clap::Args)]
pub(crate) struct Overlays {
    /// What is drawn over the colours, in any number and order; a figure always shows the cracks
    #[arg(long, value_enum, value_delimiter = ',')]
    overlay: Vec<Word>,
    /// Isolines of the quantity: auto for round levels, N for about so many, or the levels
    #[arg(long, value_name = "auto|N|A,B,…", allow_hyphen_values = true)]
    isolines: Option<Levels>,
    /// Write their levels along the isolines
    #[arg(long, requires = "isolines")]
    level_labels: bool,
    /// Arrows of the displacement (of a potential its gradient), so many pixels of a bare picture apart [default: 36]
    #[arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true, default_missing_value = "36", value_parser = spacing)]
    arrows: Option<f64>,
    /// Crosses of the principal stresses, so many pixels of a bare picture apart [default: 36]
    #[arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true, default_missing_value = "36", value_parser = spacing)]
    crosses: Option<f64>,
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

/// The words of overlays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Word {
    /// Supports of the patches, which overlap
    Patches,
    /// Borders of the cover's cells
    Cells,
    /// Boxes of the cells, coloured by the kind of enrichment
    Boxes,
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

impl From<Word> for Overlay {
    fn from(word: Word) -> Self {
        match word {
            Word::Patches => Self::Patches,
            Word::Cells => Self::Cells,
            Word::Boxes => Self::Boxes,
            Word::Points => Self::Points,
            Word::Centers => Self::Centers,
            Word::Rings => Self::Rings,
            Word::Cracks => Self::Cracks,
            Word::Supports => Self::Supports,
            Word::Loads => Self::Loads,
        }
    }
}

impl Overlays {
    /// Draws them over a picture of what is seen, and tells what is not to be seen.
    pub(crate) fn layers(
        &self,
        ground: Ground<'_>,
        seen: &Seen<'_>,
        outline: bool,
    ) -> anyhow::Result<Layers> {
        ensure!(
            self.crosses.is_none() || ground.field.equation.elastic().is_some(),
            "--crosses: they show principal stresses, and a potential has none; --arrows shows its gradient"
        );
        let layers = self.chosen().layers(ground, seen, outline, &Bar::new())?;
        layers.notices.iter().for_each(|notice| tell(&format!("warning: {notice}")));
        Ok(layers)
    }

    fn chosen(&self) -> overlays::Overlays {
        overlays::Overlays {
            shown: self.overlay.iter().copied().map(Overlay::from).collect(),
            isolines: self.isolines.clone(),
            level_labels: self.level_labels,
            arrows: self.arrows,
            crosses: self.crosses,
        }
    }

    /// Refuses what the deformed plate does not have.
    pub(crate) fn check_deformed(&self) -> anyhow::Result<()> {
        if let Some(other) = self.chosen().undeformable() {
            bail!(
                "--overlay {}: of these overlays the deformed plate has cells and cracks alone",
                other.name()
            );
        }
        Ok(())
    }

    /// True if isolines are asked for.
    pub(crate) fn have_isolines(&self) -> bool {
        self.isolines.is_some()
    }

    /// Room around the plate for what stands outside of it, in parts of the plate's larger side.
    pub(crate) fn margin(&self, pixels: [u32; 2], scale: f64) -> f64 {
        self.chosen().margin(pixels, scale)
    }
}

/// Tells what a legend says that is nowhere drawn.
pub(crate) fn tell_legend(legend: &[Entry]) {
    if !legend.is_empty() {
        let words = legend.iter().map(|entry| entry.label.as_str()).collect::<Vec<_>>().join(", ");
        tell(&format!("warning: the picture is too small for its legend: {words}"));
    }
}
