//! Figures: an image with axes, a colour bar, a title and the cracks.
//!
//! The image's pixels are shown as they are, one to one; frame and ticks lie outside them. Pixels
//! without a value are hatched where the image is transparent. At deep zoom axes count from the
//! tip nearest to the view's centre ("x − 0.5 \[×10⁻¹²\]"), without one from a rounded centre.
//!
//! ```text
//!      title
//!      ┌──────────────┐  ▲  above the range
//!    y ┤              │  █─
//!      ┤   picture    │  █─  quantity [unit]
//!      └──┬────┬────┬─┘  ▼  below the range
//!              x
//! ```

mod axis;
mod beyond;
mod color_bar;
mod color_key;
mod design;
mod ink;
mod layout;
mod legend;
mod metrics;
mod panel;
mod sheet;

use crate::canvas::Canvas;

pub use axis::axis_label;
pub use color_bar::StandaloneColorBar;
pub use design::{BarPlace, FigureStyle, Labels, Theme, TickChoice};
pub use layout::{PanelGrid, hugging, panel_area, panels, plot_area};
pub use panel::{FigureError, Panel, bare};
pub use sheet::lacks_legend;

/// A figure around an image of at most [`plot_area`], in the middle, its title above it.
///
/// # Errors
/// A size without room for the image.
pub fn figure(mut panel: Panel<'_>, design: &FigureStyle) -> Result<Canvas, FigureError> {
    let title = std::mem::take(&mut panel.labels.title);
    panels(&title, &[panel], PanelGrid::ONE, design)
}

#[cfg(test)]
mod tests;
