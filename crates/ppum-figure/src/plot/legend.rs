//! The legend of a plot, where it covers the least of the curves.

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::image::Rgba;

use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::overlay::{LegendEntry, Symbol};
use crate::text::{self, CAP_HEIGHT};

// Lengths in pixels of a plot of 1024 × 768; others are scaled.
const TEXT: f64 = 13.0;
const ROW: f64 = 20.0;
const MARGIN: f64 = 9.0;
/// Length of a line's sample: dashes are told apart in it.
const SAMPLE: f64 = 34.0;
const SQUARE: f64 = 11.0;
/// Longest label, in parts of the page.
const LONGEST: f64 = 0.4;
/// Distance of the points of curves that are counted.
const STEP: f64 = 3.0;
const GROUND: Rgba = [255, 255, 255, 225];
const FRAME: Rgba = [120, 120, 126, 255];
const INK: Rgba = [38, 38, 42, 255];

/// A box with a line for each entry on a page of some size; nothing without entries.
pub(super) fn legend(
    pixels: [u32; 2],
    entries: &[LegendEntry],
    curves: &[Vec<Vec2>],
    scale: f64,
) -> Vec<CanvasItem> {
    if entries.is_empty() {
        return Vec::new();
    }
    let entries: Vec<LegendEntry> =
        entries.iter().map(|entry| short(entry, pixels[0], scale)).collect();
    let mark = if entries.iter().any(is_line) { SAMPLE } else { SQUARE };
    let widths = entries.iter().map(|entry| letter(entry, scale).width());
    let size = vec2(
        (3.0 * MARGIN + mark) * scale + widths.fold(0.0, f64::max),
        (2.0 * MARGIN + ROW * entries.len() as f64 - (ROW - TEXT)) * scale,
    );
    let corner = place(pixels, size, curves, scale);
    let mut outline = CanvasPath::default();
    outline.rect(corner, corner + size);
    let mut items = vec![
        CanvasItem::Fill { outline: outline.clone(), color: GROUND },
        CanvasItem::Line { path: outline, pen: StrokeStyle::new(FRAME, scale) },
    ];
    for (row, entry) in entries.iter().enumerate() {
        let down = (MARGIN + 0.5 * TEXT + ROW * row as f64) * scale;
        items.extend(line(entry, corner + vec2(MARGIN * scale, down), mark * scale, scale));
    }
    items
}

/// The entry with a label that leaves room for the plot: what tells quantities apart is often
/// their end.
fn short(entry: &LegendEntry, columns: u32, scale: f64) -> LegendEntry {
    let room = LONGEST * f64::from(columns);
    LegendEntry { label: text::squeezed(&entry.label, TEXT * scale, room), ..entry.clone() }
}

fn is_line(entry: &LegendEntry) -> bool {
    matches!(entry.symbol, Symbol::Line(_))
}

fn letter(entry: &LegendEntry, scale: f64) -> TextItem {
    TextItem::new(&entry.label, TEXT * scale, vec2(0.0, 0.0), INK)
}

/// The mark, `mark` long, and the label of an entry, from the middle of the mark's left end.
fn line(entry: &LegendEntry, start: Vec2, mark: f64, scale: f64) -> [CanvasItem; 2] {
    let (mut path, half) = (CanvasPath::default(), 0.5 * SQUARE * scale);
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
    let right = mark + MARGIN * scale;
    let at = start + vec2(right, 0.5 * CAP_HEIGHT * TEXT * scale);
    [symbol, CanvasItem::Text(TextItem { at, ..letter(entry, scale) })]
}

/// The upper left corner of a box of some size: in one of the page's corners or in the middle of a
/// side, where it covers the fewest points of the curves; of several the first.
fn place(pixels: [u32; 2], size: Vec2, curves: &[Vec<Vec2>], scale: f64) -> Vec2 {
    let near = vec2(MARGIN, MARGIN) * scale;
    let far = (vec2(f64::from(pixels[0]), f64::from(pixels[1])) - near - size).max(Vec2::ZERO);
    let near = near.min(far);
    let middle = (near + far) * 0.5;
    let (top, bottom) = ([far.x, near.x, middle.x], [far.x, near.x, middle.x]);
    let places = top.map(|x| vec2(x, near.y)).into_iter();
    let places = places.chain(bottom.map(|x| vec2(x, far.y)));
    let places = places.chain([far.x, near.x].map(|x| vec2(x, middle.y)));
    let covered = |corner: Vec2| {
        let boxed = Rect::new(corner, corner + size);
        curves
            .iter()
            .flat_map(|curve| dots(curve, STEP * scale))
            .filter(|p| boxed.contains(*p))
            .count()
    };
    let counted = places.map(|corner| (covered(corner), corner));
    counted.min_by_key(|(count, _)| *count).map_or(near, |(_, corner)| corner)
}

/// Points along a line, no farther than `step` from each other; of very long pieces fewer.
fn dots(curve: &[Vec2], step: f64) -> impl Iterator<Item = Vec2> + '_ {
    let between = move |pair: &[Vec2]| {
        let (a, b) = (pair[0], pair[1]);
        let count = ((b - a).length() / step).ceil().clamp(1.0, 2000.0) as u32;
        (1..=count).map(move |k| a + (b - a) * (f64::from(k) / f64::from(count)))
    };
    curve.first().copied().into_iter().chain(curve.windows(2).flat_map(between))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve through all corners but one leaves that to the legend; without curves it is the
    /// upper right one.
    #[test]
    fn the_free_corner_is_taken() {
        let pen = StrokeStyle::new(INK, 1.0);
        let entries =
            [LegendEntry::new(Symbol::Line(pen), "a"), LegendEntry::new(Symbol::Line(pen), "b")];
        let box_of = |curves: &[Vec<Vec2>]| match &legend([600, 400], &entries, curves, 1.0)[0] {
            CanvasItem::Fill { outline, .. } => outline.pieces[0].clone(),
            _ => Vec::new(),
        };
        let corners = [vec2(600.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 400.0), vec2(600.0, 400.0)];
        let nearest = |outline: &[Vec2]| {
            let far =
                |k: &usize| outline.iter().map(|p| (*p - corners[*k]).length()).fold(1e9, f64::min);
            (0..4).min_by(|a, b| far(a).total_cmp(&far(b)))
        };
        assert_eq!(nearest(&box_of(&[])), Some(0));
        for free in 0..4 {
            // from the corner before over the others, along the middle lines too
            let inward = |p: Vec2| p + (vec2(300.0, 200.0) - p) * 0.15;
            let mut curve: Vec<_> = (1..4).map(|n| inward(corners[(free + n) % 4])).collect();
            curve.splice(
                0..0,
                [vec2(300.0, 30.0), vec2(300.0, 370.0), vec2(30.0, 200.0), vec2(570.0, 200.0)],
            );
            assert_eq!(nearest(&box_of(&[curve])), Some(free), "{free}");
        }
    }

    /// Labels of any length leave room, and keep their ends.
    #[test]
    fn long_labels_are_shortened_in_their_middle() {
        let pen = StrokeStyle::new(INK, 2.0);
        let entry =
            |end: &str| LegendEntry::new(Symbol::Line(pen), format!("{}{end}", "x + ".repeat(200)));
        let items = legend([700, 450], &[entry("_above"), entry("_below")], &[], 1.0);
        let texts: Vec<&TextItem> = items
            .iter()
            .filter_map(|item| match item {
                CanvasItem::Text(text) => Some(text),
                _ => None,
            })
            .collect();
        assert!(texts.iter().all(|text| text.width() <= 0.41 * 700.0));
        assert!(texts[0].text.ends_with("_above") && texts[1].text.ends_with("_below"));
    }
}
