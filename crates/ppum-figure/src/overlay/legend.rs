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

pub(crate) const TEXT: f64 = 13.0;
const ROW: f64 = 20.0;
pub(crate) const MARGIN: f64 = 9.0;
/// Side of a square, and length of a line beside plots.
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
    let size = LegendBox::new(entries, scale).size();
    let fits = size.x <= PART[0] * pixels[0] && size.y <= PART[1] * pixels[1];
    let left = pixels[0] - MARGIN * scale - size.x;
    let corner = vec2(left.max(0.0), MARGIN * scale);
    (fits && !entries.is_empty()).then_some([corner, corner + size])
}

/// That box; nothing where there is none.
#[must_use]
pub fn legend(view: &View, scale: f64, entries: &[LegendEntry]) -> Vec<CanvasItem> {
    let place = legend_box(view, scale, entries);
    place.map_or_else(Vec::new, |[min, _]| LegendBox::new(entries, scale).items(min))
}

/// A box with a line for each entry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegendBox<'a> {
    entries: &'a [LegendEntry],
    /// Length of marks in units of the scale.
    mark: f64,
    scale: f64,
}

impl<'a> LegendBox<'a> {
    pub(crate) fn new(entries: &'a [LegendEntry], scale: f64) -> Self {
        Self { entries, mark: MARK, scale }
    }

    /// The box with marks of another length.
    pub(crate) fn marked(self, mark: f64) -> Self {
        Self { mark, ..self }
    }

    /// Width and height.
    pub(crate) fn size(&self) -> Vec2 {
        let Self { entries, mark, scale } = *self;
        let widest = entries.iter().map(|entry| text::width(&entry.label, TEXT * scale));
        vec2(
            (3.0 * MARGIN + mark) * scale + widest.fold(0.0, f64::max),
            (2.0 * MARGIN + ROW * entries.len() as f64 - (ROW - TEXT)) * scale,
        )
    }

    /// The box with its upper left corner at a place; nothing without entries.
    pub(crate) fn items(&self, corner: Vec2) -> Vec<CanvasItem> {
        if self.entries.is_empty() {
            return Vec::new();
        }
        let mut outline = CanvasPath::default();
        outline.rect(corner, corner + self.size());
        let pen = StrokeStyle::new(FRAME, self.scale);
        let mut items = vec![
            CanvasItem::Fill { outline: outline.clone(), color: GROUND },
            CanvasItem::Line { path: outline, pen },
        ];
        for (row, entry) in self.entries.iter().enumerate() {
            let down = MARGIN + 0.5 * TEXT + ROW * row as f64;
            items.extend(self.line(entry, corner + vec2(MARGIN, down) * self.scale));
        }
        items
    }

    /// An entry whose mark starts at a point.
    fn line(&self, entry: &LegendEntry, start: Vec2) -> [CanvasItem; 2] {
        let (mark, half) = (self.mark * self.scale, 0.5 * MARK * self.scale);
        let mut path = CanvasPath::default();
        let symbol = match entry.symbol {
            Symbol::Square(color) => {
                let middle = start + vec2(0.5 * mark, 0.0);
                path.rect(middle - vec2(half, half), middle + vec2(half, half));
                CanvasItem::Fill { outline: path, color }
            }
            Symbol::Line(pen) => {
                path.line(start, start + vec2(mark, 0.0));
                CanvasItem::Line { path, pen }
            }
        };
        let right = (self.mark + MARGIN) * self.scale;
        let at = start + vec2(right, 0.5 * CAP_HEIGHT * TEXT * self.scale);
        [symbol, CanvasItem::Text(TextItem::new(&entry.label, TEXT * self.scale, at, INK))]
    }
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
