//! Layers over an image: items that the window draws, or their pixels where they are too many for
//! that.

use std::ops::Deref;
use std::sync::Arc;

use egui::{Color32, ColorImage};
use ppum_figure::canvas::{Canvas, CanvasItem};
use ppum_scene::layers::Layers;

/// Layers as they are shown.
#[derive(Debug, Default)]
pub struct OverlayShapes {
    layers: Layers,
    /// Pixels in place of the items, where they are too many to be drawn each time that the window
    /// is shown.
    pub pixels: Option<Arc<ColorImage>>,
}

/// Points of lines that the window draws by itself, in a few milliseconds.
const MOST: usize = 12_000;

impl OverlayShapes {
    /// Layers over an image of so many pixels.
    pub(super) fn new(mut layers: Layers, size: [u32; 2]) -> Self {
        if points(&layers.items) <= MOST {
            return Self { layers, pixels: None };
        }
        // a million items are not handed on: to forget them takes long
        let pixels = Arc::new(drawn(std::mem::take(&mut layers.items), size));
        Self { layers, pixels: Some(pixels) }
    }
}

impl Deref for OverlayShapes {
    type Target = Layers;

    fn deref(&self) -> &Layers {
        &self.layers
    }
}

fn points(items: &[CanvasItem]) -> usize {
    let of = |item: &CanvasItem| match item {
        CanvasItem::Line { path, .. } | CanvasItem::Fill { outline: path, .. } => {
            path.polylines(1.0).map(|line| line.len()).sum()
        }
        CanvasItem::Inset { canvas, .. } => points(&canvas.items),
        _ => 1,
    };
    items.iter().map(of).sum()
}

/// The items with nothing below them: on black they are what they add, and what they let through is
/// how much lighter they are on white.
fn drawn(items: Vec<CanvasItem>, size: [u32; 2]) -> ColorImage {
    let mut canvas = Canvas { size, paper: [0, 0, 0, 255], items };
    let black = canvas.image();
    canvas.paper = [255; 4];
    let white = canvas.image();
    let both = black.rgba.as_chunks::<4>().0.iter().zip(white.rgba.as_chunks::<4>().0);
    let pixels = both.map(|(&[r, g, b, _], white)| {
        let through = white[1].saturating_sub(g);
        Color32::from_rgba_premultiplied(r, g, b, 255 - through)
    });
    ColorImage::new(size.map(|n| n as usize), pixels.collect())
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;
    use ppum_figure::canvas::{CanvasPath, StrokeStyle};

    use super::*;

    /// Lines across a page, `count` of them, half let through.
    fn lines(count: usize) -> Layers {
        let piece = vec![vec2(0.0, 2.0), vec2(8.0, 2.0)];
        let (path, pen) =
            (CanvasPath::of_pieces(vec![piece; count]), StrokeStyle::new([200, 0, 0, 128], 2.0));
        Layers { items: vec![CanvasItem::Line { path, pen }], ..Layers::default() }
    }

    #[test]
    fn what_is_much_becomes_pixels_that_let_through() {
        assert!(OverlayShapes::new(lines(3), [8, 4]).pixels.is_none());
        let laid = OverlayShapes::new(lines(MOST), [8, 4]);
        let pixels = laid.pixels.expect("that is much").pixels.clone();
        let [r, g, _, a] = pixels[8 + 4].to_array();
        assert!(r.abs_diff(100) < 3 && g == 0 && a.abs_diff(128) < 3, "{:?}", pixels[8 + 4]);
        assert_eq!(pixels[3 * 8 + 4], Color32::TRANSPARENT);
    }
}
