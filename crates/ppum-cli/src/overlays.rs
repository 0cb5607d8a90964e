//! Options of what is drawn over the colours of a picture.

use ppum_render::glyph::LEAST_SPACING;
use ppum_scene::overlays::{self, Levels, Overlay};

use crate::arguments::positive;

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
    /// Arrows of the displacement (of a potential its gradient), so many pixels of a bare picture
    /// apart [default: 36]
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

impl Overlays {
    /// What is drawn.
    pub(crate) fn chosen(&self) -> overlays::Overlays {
        overlays::Overlays {
            shown: self.overlay.clone(),
            isolines: self.isolines.clone(),
            level_labels: self.level_labels,
            arrows: self.arrows,
            crosses: self.crosses,
        }
    }
}
