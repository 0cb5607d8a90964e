//! Legends: what marks and colours mean.

use ppum::vec2::vec2;
use ppum_render::image::Rgba;
use ppum_render::view::View;

use super::line_scale;
use crate::canvas::{Item, Lettering, Path, Pen};
use crate::text::CAP_HEIGHT;

/// A line of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The mark.
    pub symbol: Symbol,
    /// Its meaning.
    pub label: String,
}

/// A mark in a legend.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Symbol {
    /// A square of a colour.
    Square(Rgba),
    /// A piece of a line.
    Line(Pen),
}

impl Entry {
    /// A line of a legend.
    #[must_use]
    pub fn new(symbol: Symbol, label: impl Into<String>) -> Self {
        Self { symbol, label: label.into() }
    }
}

const TEXT: f64 = 13.0;
const ROW: f64 = 20.0;
const MARGIN: f64 = 9.0;
const MARK: f64 = 11.0;
const GROUND: Rgba = [255, 255, 255, 225];
const FRAME: Rgba = [120, 120, 126, 255];
const INK: Rgba = [38, 38, 42, 255];

/// A box in the upper right corner of a view with a line for each entry; nothing without entries.
#[must_use]
pub fn legend(view: &View, entries: &[Entry]) -> Vec<Item> {
    legend_in(view.pixels, entries, line_scale(view.pixels))
}

/// A box in the upper right corner of a page of some size.
fn legend_in(pixels: [u32; 2], entries: &[Entry], scale: f64) -> Vec<Item> {
    if entries.is_empty() {
        return Vec::new();
    }
    let letter = |entry: &Entry| Lettering::new(&entry.label, TEXT * scale, vec2(0.0, 0.0), INK);
    let widest = entries.iter().map(|entry| letter(entry).width()).fold(0.0, f64::max);
    let size = vec2(
        (3.0 * MARGIN + MARK) * scale + widest,
        (2.0 * MARGIN + ROW * entries.len() as f64 - (ROW - TEXT)) * scale,
    );
    let right = f64::from(pixels[0]) - MARGIN * scale;
    let corner = vec2((right - size.x).max(0.0), MARGIN * scale);
    let mut outline = Path::default();
    outline.rect(corner, corner + size);
    let mut items = vec![
        Item::Fill { outline: outline.clone(), color: GROUND },
        Item::Line { path: outline, pen: Pen::new(FRAME, scale) },
    ];
    for (row, entry) in entries.iter().enumerate() {
        let middle = corner.y + (MARGIN + 0.5 * TEXT + ROW * row as f64) * scale;
        let left = corner.x + MARGIN * scale;
        let mut path = Path::default();
        let half = 0.5 * MARK * scale;
        items.push(match entry.symbol {
            Symbol::Square(color) => {
                path.rect(vec2(left, middle - half), vec2(left + 2.0 * half, middle + half));
                Item::Fill { outline: path, color }
            }
            Symbol::Line(pen) => {
                path.line(vec2(left, middle), vec2(left + 2.0 * half, middle));
                Item::Line { path, pen }
            }
        });
        let base = vec2(left + (MARK + MARGIN) * scale, middle + 0.5 * CAP_HEIGHT * TEXT * scale);
        items.push(Item::Text(Lettering { at: base, ..letter(entry) }));
    }
    items
}
