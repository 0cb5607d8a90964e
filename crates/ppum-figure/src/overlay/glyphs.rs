//! Arrows of vectors and crosses of principal stresses.

use ppum::vec2::{Vec2, vec2};
use ppum_render::glyph::{Glyph, Principal};
use ppum_render::image::Rgba;
use ppum_render::view::View;

use super::legend::{LegendEntry, Symbol};
use super::supports::arrow;
use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};
use crate::ticks::Notation;

const ARROW: Rgba = [18, 18, 22, 255];
/// Tension and compression.
const TENSION: Rgba = [190, 24, 40, 255];
const COMPRESSION: Rgba = [24, 62, 180, 255];
const SEAM: Rgba = [255, 255, 255, 150];
const WIDTH: f64 = 1.4;
const HEAD: f64 = 6.5;
/// Length of the longest arrow and of the longest arm of a cross with its opposite, in parts of
/// the spacing.
const LONGEST: f64 = 0.9;
/// Among so many values, one may be longer than the longest glyph; it is drawn as long as that.
const PEAKS: usize = 50;

/// Arrows centred on their points, their lengths as the vectors', and what their length means.
/// `spacing` is that of the points, in units of the scale as all lengths.
#[must_use]
pub fn arrows(
    view: &View,
    scale: f64,
    glyphs: &[Glyph<Vec2>],
    spacing: f64,
) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
    let longest = typical(glyphs.iter().map(|glyph| glyph.value.length()));
    let (mut shafts, mut heads) = (CanvasPath::default(), CanvasPath::default());
    for glyph in glyphs {
        let way = vec2(glyph.value.x, -glyph.value.y) / longest;
        let length = way.length();
        if !(length > 0.02 && length.is_finite()) {
            continue;
        }
        let half = way * (0.5 * LONGEST * spacing * scale * length.min(1.0) / length);
        let at = view.pixel_of_offset(glyph.offset);
        arrow(&mut shafts, &mut heads, [at - half, at + half], HEAD * scale);
    }
    let pen = StrokeStyle::new(ARROW, WIDTH * scale).with_halo(SEAM, 0.7 * scale);
    let entry = LegendEntry::new(Symbol::Line(pen), format!("longest arrow {}", number(longest)));
    let items = vec![
        CanvasItem::Line { path: shafts, pen },
        CanvasItem::Fill { outline: heads, color: ARROW },
    ];
    (items, if longest > 0.0 { vec![entry] } else { Vec::new() })
}

/// Crosses along the principal directions, their arms as long as the stresses; tension and
/// compression told apart by colours, and what their length means.
#[must_use]
pub fn crosses(
    view: &View,
    scale: f64,
    glyphs: &[Glyph<Principal>],
    spacing: f64,
) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
    let longest = typical(glyphs.iter().map(|g| g.value.s1.abs().max(g.value.s2.abs())));
    let (mut tension, mut compression) = (CanvasPath::default(), CanvasPath::default());
    for Glyph { offset, value: Principal { s1, s2, angle }, .. } in glyphs {
        let at = view.pixel_of_offset(*offset);
        let (sin, cos) = angle.sin_cos();
        for (stress, axis) in [(*s1, vec2(cos, -sin)), (*s2, vec2(sin, cos))] {
            let part = (stress / longest).abs().min(1.0);
            if part > 0.02 {
                let half = axis * (0.5 * LONGEST * spacing * scale * part);
                let path = if stress > 0.0 { &mut tension } else { &mut compression };
                path.line(at - half, at + half);
            }
        }
    }
    let pen = |color: Rgba| StrokeStyle::new(color, WIDTH * scale).with_halo(SEAM, 0.7 * scale);
    let mut entries = Vec::new();
    for (path, color, name) in
        [(&tension, TENSION, "tension"), (&compression, COMPRESSION, "compression")]
    {
        if !path.is_empty() {
            entries.push(LegendEntry::new(Symbol::Line(pen(color)), name));
        }
    }
    if let Some(last) = entries.last_mut() {
        last.label = format!("{}, longest {}", last.label, number(longest));
    }
    let lines = [(tension, TENSION), (compression, COMPRESSION)];
    (lines.map(|(path, color)| CanvasItem::Line { path, pen: pen(color) }).into(), entries)
}

/// A number as bars write it, with its power of ten, in few digits.
fn number(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse().unwrap_or(value);
    Notation::PLAIN.label(rounded)
}

/// The largest of the lengths except for a few peaks, as there are at tips; 0 if there is none.
fn typical(lengths: impl Iterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = lengths.filter(|length| length.is_finite()).collect();
    all.sort_by(f64::total_cmp);
    let most = all.last().copied().unwrap_or(0.0);
    let usual = all.len().checked_sub(1 + all.len() / PEAKS).map_or(0.0, |k| all[k]);
    // smooth fields are shown in full
    if most <= 1.5 * usual { most } else { usual }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::window(-1.0, -1.0, 1.0, 1.0, [200, 200]).unwrap()
    }

    fn lines(item: &CanvasItem) -> Vec<Vec<Vec2>> {
        let CanvasItem::Line { path, .. } = item else { panic!("lines") };
        path.pieces.clone()
    }

    /// Arrows are centred, point along their vectors (y up), and are as long as these
    /// in proportion.
    #[test]
    fn arrows_show_their_vectors() {
        let glyph = |x: f64, value| Glyph { offset: vec2(x, 0.0), value, face: None };
        let glyphs =
            [glyph(0.5, vec2(0.0, 2.0)), glyph(-0.5, vec2(1.0, 0.0)), glyph(0.0, Vec2::ZERO)];
        let (items, entries) = arrows(&view(), 1.0, &glyphs, 40.0);
        let CanvasItem::Fill { outline, .. } = &items[1] else { panic!("heads") };
        assert_eq!(outline.pieces.len(), 2, "none of a vector without length");
        let tip = |k: usize| outline.pieces[k][0];
        let shafts = lines(&items[0]);
        let (up, right) = (tip(0) - shafts[0][0], tip(1) - shafts[1][0]);
        assert!(
            (up - vec2(0.0, -36.0)).length() < 1e-9 && (right - vec2(18.0, 0.0)).length() < 1e-9
        );
        assert!(((tip(0) + shafts[0][0]) * 0.5 - vec2(150.0, 100.0)).length() < 1e-9);
        assert_eq!(entries[0].label, "longest arrow 2");
        assert!(arrows(&view(), 1.0, &[], 40.0).1.is_empty());
        let long = [glyph(0.0, vec2(1.909_13e6, 0.0))];
        assert_eq!(arrows(&view(), 1.0, &long, 40.0).1[0].label, "longest arrow 1.909×10⁶");
    }

    /// A peak does not make all others dots.
    #[test]
    fn peaks_are_cut_off() {
        let value = |k: u32| if k == 7 { 1e6 } else { 1.0 + f64::from(k % 3) };
        assert_eq!(typical((0..100).map(value)), 3.0);
        assert_eq!(typical((0..100).map(f64::from)), 99.0);
        assert_eq!(typical([f64::INFINITY, 2.0, f64::NAN].into_iter()), 2.0);
    }

    #[test]
    fn crosses_tell_tension_from_compression() {
        let value = Principal { s1: 3.0, s2: -1.5, angle: std::f64::consts::FRAC_PI_2 };
        let glyph = Glyph { offset: Vec2::ZERO, value, face: None };
        let (items, entries) = crosses(&view(), 1.0, &[glyph], 40.0);
        let [tension, compression] = [0, 1].map(|k| lines(&items[k])[0].clone());
        let way = |line: &[Vec2]| line[1] - line[0];
        assert!((way(&tension).y.abs() - 36.0).abs() < 1e-9 && way(&tension).x.abs() < 1e-9);
        assert!((way(&compression).x.abs() - 18.0).abs() < 1e-9);
        assert_eq!(
            entries.iter().map(|e| e.label.as_str()).collect::<Vec<_>>(),
            ["tension", "compression, longest 3"]
        );
    }
}
