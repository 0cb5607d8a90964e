//! An image and what belongs to it, bare or in a figure.

use ppum::crack::Crack;
use ppum_render::picture::ColoredRaster;

use super::style::Labels;
use crate::canvas::{Canvas, CanvasItem};
use crate::overlay::LegendEntry;

/// The reason why there is no such figure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// No room for the images between the labels.
    #[error("a figure of {}x{} pixels leaves no room; give at least {}x{}, {}x{} inches, or smaller letters",
        size[0], size[1], least[0], least[1], inches(least[0], *dpi), inches(least[1], *dpi))]
    TooSmall {
        /// The size asked for.
        size: [u32; 2],
        /// A size that leaves room, no smaller on any side.
        least: [u32; 2],
        /// Pixels per inch.
        dpi: f64,
    },
    /// The image is larger than the room between the labels.
    #[error("a picture of {}x{} pixels does not fit a figure with room for {}x{}; \
        draw it with the size that plot_area gives", plot[0], plot[1], room[0], room[1])]
    TooLarge {
        /// The image's size.
        plot: [u32; 2],
        /// The room.
        room: [u32; 2],
    },
    /// A number of panels that the grid has no cells for, or none.
    #[error("{panels} panels do not fit a grid of {cells} cells")]
    Panels {
        /// Number of panels.
        panels: usize,
        /// Number of cells.
        cells: usize,
    },
    /// One bar for images with several ranges, scales or colour maps.
    #[error("one colour bar cannot explain pictures with different ranges or colours")]
    Ranges,
}

/// An image and what belongs to it.
#[derive(Clone, Debug)]
pub struct Panel<'a> {
    /// The image.
    pub picture: &'a ColoredRaster,
    /// The overlays; positions are pixels of the image.
    pub layers: Vec<CanvasItem>,
    /// The entries of a legend that has no room in the image; it stands beside the image or
    /// above it.
    pub legend: Vec<LegendEntry>,
    /// Its words.
    pub labels: Labels,
    /// The cracks from whose tips the axes count at deep zoom.
    pub cracks: &'a [Crack],
    /// The panel, by its place in the figure, whose bar explains this one too; none, or one without
    /// a bar of its own, if this one has its own.
    pub bar_of: Option<usize>,
}

/// An image with layers over it, and nothing around it.
#[must_use]
pub fn bare(picture: &ColoredRaster, layers: Vec<CanvasItem>) -> Canvas {
    let mut page = Canvas::new(picture.image.size, [0; 4]);
    page.items.push(CanvasItem::Picture { image: picture.image.clone(), corner: [0, 0] });
    page.items.extend(layers);
    page
}

/// A length in inches, with a digit behind the point and not below.
fn inches(pixels: u32, dpi: f64) -> f64 {
    (f64::from(pixels) / dpi * 10.0).ceil() / 10.0
}
