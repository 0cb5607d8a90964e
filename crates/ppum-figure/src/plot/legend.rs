//! The legend of a plot, where it covers the least of the curves.

use ppum::vec2::{Rect, Vec2, vec2};

use crate::canvas::CanvasItem;
use crate::overlay::{LEGEND_MARGIN, LEGEND_TEXT, LegendBox, LegendEntry, Symbol};
use crate::text;

/// Length of a line's sample: dashes are told apart in it.
const SAMPLE: f64 = 34.0;
/// Longest label, in parts of the page.
const LONGEST: f64 = 0.4;
/// Distance of the points of curves that are counted.
const STEP: f64 = 3.0;

/// A box with a line for each entry on a page of some size; nothing without entries. Labels leave
/// room for the plot: what tells quantities apart is often their end.
pub(super) fn legend(
    pixels: [u32; 2],
    entries: &[LegendEntry],
    curves: &[Vec<Vec2>],
    scale: f64,
) -> Vec<CanvasItem> {
    let room = LONGEST * f64::from(pixels[0]);
    let short = |entry: &LegendEntry| LegendEntry {
        label: text::squeezed(&entry.label, LEGEND_TEXT * scale, room),
        ..entry.clone()
    };
    let entries: Vec<LegendEntry> = entries.iter().map(short).collect();
    let has_lines = entries.iter().any(|entry| matches!(entry.symbol, Symbol::Line(_)));
    let plain = LegendBox::new(&entries, scale);
    let legend = if has_lines { plain.marked(SAMPLE) } else { plain };
    legend.items(place(pixels, legend.size(), curves, scale))
}

/// The upper left corner of a box of some size: in one of the page's corners or in the middle of a
/// side, where it covers the fewest points of the curves; of several the first.
fn place(pixels: [u32; 2], size: Vec2, curves: &[Vec<Vec2>], scale: f64) -> Vec2 {
    let near = vec2(LEGEND_MARGIN, LEGEND_MARGIN) * scale;
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
    use crate::canvas::{StrokeStyle, TextItem};

    const INK: ppum_render::image::Rgba = [38, 38, 42, 255];

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
