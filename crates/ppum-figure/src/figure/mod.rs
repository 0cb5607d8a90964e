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
mod color_bar;
mod color_key;
mod end_labels;
pub(crate) mod ink;
mod layout;
mod legend;
mod metrics;
mod panel;
mod panel_layout;
mod style;

use crate::canvas::Canvas;

pub use axis::axis_label;
pub use color_bar::StandaloneColorBar;
pub use layout::{PanelGrid, hugging, panel_area, panels, plot_area};
pub use panel::{FigureError, Panel, bare};
pub use panel_layout::lacks_legend;
pub use style::{BarPlace, FigureStyle, Labels, Theme, TickChoice};

/// A figure around an image of at most [`plot_area`], in the middle, its title above it.
///
/// # Errors
/// A size without room for the image.
pub fn figure(mut panel: Panel<'_>, style: &FigureStyle) -> Result<Canvas, FigureError> {
    let title = std::mem::take(&mut panel.labels.title);
    panels(&title, &[panel], PanelGrid::ONE, style)
}

#[cfg(test)]
mod tests;
