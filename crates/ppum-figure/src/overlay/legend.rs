//! Legends: what marks and colours mean.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::view::View;

use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::text::{self, CAP_HEIGHT};

/// A line of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
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
    Line(StrokeStyle),
}

impl LegendEntry {
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

/// Largest parts of an image's width and height that a legend in it takes.
const PART: [f64; 2] = [0.75, 0.4];

/// The corners, upper left and lower right, of a box with a line for each entry in the upper right
/// corner of a view; none without entries, and none where it would hide most of the view or not fit
/// into it.
#[must_use]
pub fn legend_box(view: &View, scale: f64, entries: &[LegendEntry]) -> Option<[Vec2; 2]> {
    let pixels = view.pixels.map(f64::from);
    let size = legend_size(entries, scale);
    let fits = size.x <= PART[0] * pixels[0] && size.y <= PART[1] * pixels[1];
    let corner = corner(view.pixels, size, scale);
    (fits && !entries.is_empty()).then_some([corner, corner + size])
}

/// That box; nothing where there is none.
#[must_use]
pub fn legend(view: &View, scale: f64, entries: &[LegendEntry]) -> Vec<CanvasItem> {
    let place = legend_box(view, scale, entries);
    place.map_or_else(Vec::new, |[min, _]| legend_at(min, entries, scale))
}

/// The upper left corner of a box in the upper right one of a page.
fn corner(pixels: [u32; 2], size: Vec2, scale: f64) -> Vec2 {
    let right = f64::from(pixels[0]) - MARGIN * scale;
    vec2((right - size.x).max(0.0), MARGIN * scale)
}

/// Width and height of a legend's box.
pub(crate) fn legend_size(entries: &[LegendEntry], scale: f64) -> Vec2 {
    let widest = entries.iter().map(|entry| text::width(&entry.label, TEXT * scale));
    vec2(
        (3.0 * MARGIN + MARK) * scale + widest.fold(0.0, f64::max),
        (2.0 * MARGIN + ROW * entries.len() as f64 - (ROW - TEXT)) * scale,
    )
}

/// A legend's box with its upper left corner at a place; nothing without entries.
pub(crate) fn legend_at(corner: Vec2, entries: &[LegendEntry], scale: f64) -> Vec<CanvasItem> {
    if entries.is_empty() {
        return Vec::new();
    }
    let letter =
        |entry: &LegendEntry| TextItem::new(&entry.label, TEXT * scale, vec2(0.0, 0.0), INK);
    let size = legend_size(entries, scale);
    let mut outline = CanvasPath::default();
    outline.rect(corner, corner + size);
    let mut items = vec![
        CanvasItem::Fill { outline: outline.clone(), color: GROUND },
        CanvasItem::Line { path: outline, pen: StrokeStyle::new(FRAME, scale) },
    ];
    for (row, entry) in entries.iter().enumerate() {
        let middle = corner.y + (MARGIN + 0.5 * TEXT + ROW * row as f64) * scale;
        let left = corner.x + MARGIN * scale;
        let mut path = CanvasPath::default();
        let half = 0.5 * MARK * scale;
        items.push(match entry.symbol {
            Symbol::Square(color) => {
                path.rect(vec2(left, middle - half), vec2(left + 2.0 * half, middle + half));
                CanvasItem::Fill { outline: path, color }
            }
            Symbol::Line(pen) => {
                path.line(vec2(left, middle), vec2(left + 2.0 * half, middle));
                CanvasItem::Line { path, pen }
            }
        });
        let base = vec2(left + (MARK + MARGIN) * scale, middle + 0.5 * CAP_HEIGHT * TEXT * scale);
        items.push(CanvasItem::Text(TextItem { at: base, ..letter(entry) }));
    }
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Whatever the image's shape, the box is whole and leaves most of the image, or is not there.
    #[test]
    fn legends_are_whole_or_not_there() {
        let mut random = Random(15);
        let mut found = [0, 0];
        for _ in 0..500 {
            let mut side = || {
                let most = random.pick(&[40, 1500]);
                1 + random.below(most) as u32
            };
            let view = View::new(Vec2::ZERO, 1.0, [side(), side()]).unwrap();
            let label = "longest arrow 0.1".repeat(1 + random.below(2));
            let entries: Vec<LegendEntry> = (0..=random.below(5))
                .map(|_| LegendEntry::new(Symbol::Square(INK), label.clone()))
                .collect();
            let items = legend(&view, 1.0, &entries);
            found[usize::from(items.is_empty())] += 1;
            let size = Vec2::from(view.pixels.map(f64::from));
            for item in &items {
                let [lo, hi] = item.bounds();
                let inside = lo.x >= 0.0 && lo.y >= 0.0 && hi.x <= size.x && hi.y <= size.y;
                assert!(inside, "{view:?} {item:?}");
            }
            if let Some([min, max]) = legend_box(&view, 1.0, &entries) {
                let part = (max - min).x * (max - min).y / (size.x * size.y);
                assert!(part < 0.31 && !items.is_empty(), "{view:?}");
            }
        }
        assert!(found.iter().all(|count| *count > 50), "{found:?}");
        assert!(legend(&View::new(Vec2::ZERO, 1.0, [900; 2]).unwrap(), 1.0, &[]).is_empty());
    }
}
