//! Isolines with their levels.

use ppum::text::trimmed;
use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::isoline::Isoline;
use ppum_render::view::View;

use super::line_scale;
use crate::canvas::Halo;
use crate::canvas::{Align, Item, Lettering, Path, Pen};

const LINE: Rgba = [18, 18, 22, 235];
const SEAM: Rgba = [255, 255, 255, 105];
const GROUND: Rgba = [255, 255, 255, 215];
const WIDTH: f64 = 1.2;
const TEXT: f64 = 11.5;
/// A line this many times as long as its label, and as that is high, has one.
const ROOM: [f64; 2] = [2.5, 6.0];

/// Isolines as dark lines with a light seam, of one width everywhere; with their levels where there is room, if that is wanted.
#[must_use]
pub fn isolines(view: &View, lines: &[Isoline], with_levels: bool) -> Vec<Item> {
    let scale = line_scale(view.pixels);
    let path = Path { pieces: lines.iter().map(|line| points(view, line)).collect() };
    let pen = Pen::new(LINE, WIDTH * scale).with_halo(SEAM, 0.7 * scale);
    let mut items = vec![Item::Line { path: path.clone(), pen }];
    if with_levels {
        let mut taken: Vec<(Vec2, f64)> = Vec::new();
        for (line, points) in lines.iter().zip(&path.pieces) {
            items.extend(label(view, line.level, points, &mut taken).map(Item::Text));
        }
    }
    items
}

/// The line in pixels, the first point again at the end of a closed one.
fn points(view: &View, line: &Isoline) -> Vec<Vec2> {
    line.polyline().into_iter().map(|offset| view.pixel_of_offset(offset)).collect()
}

/// The level along the straightest part of its line, away from other labels and from the picture's border; none
/// where there is no room. `taken` holds middles and half lengths of labels.
fn label(
    view: &View,
    level: f64,
    points: &[Vec2],
    taken: &mut Vec<(Vec2, f64)>,
) -> Option<Lettering> {
    let size = TEXT * line_scale(view.pixels);
    let line = Lettering::new(trimmed(level).replace('-', "−"), size, Vec2::ZERO, LINE);
    let half = 0.5 * line.width();
    let arcs = arc_lengths(points);
    let length = *arcs.last()?;
    if length < (ROOM[0] * 2.0 * half).max(ROOM[1] * size) {
        return None;
    }
    let at = |s: f64| point_at(points, &arcs, s);
    let margin = vec2(half + size, half + size);
    let most = vec2(f64::from(view.pixels[0]), f64::from(view.pixels[1])) - margin;
    let is_free = |p: Vec2| {
        let inside = p.x > margin.x && p.y > margin.y && p.x < most.x && p.y < most.y;
        inside && taken.iter().all(|(q, r)| (p - *q).length() > half + r + 2.0 * size)
    };
    const PLACES: u32 = 24;
    let places = (1..PLACES).map(|k| length * f64::from(k) / f64::from(PLACES));
    let bend = |s: f64| {
        let (a, b) = (at((s - half).max(0.0)), at((s + half).min(length)));
        ((a + b) * 0.5 - at(s)).length()
    };
    let best = places.filter(|&s| is_free(at(s))).min_by(|&a, &b| bend(a).total_cmp(&bend(b)))?;
    if bend(best) > 0.6 * size {
        return None;
    }
    let (middle, along) = (at(best), at((best + half).min(length)) - at((best - half).max(0.0)));
    // upright: read from left to right
    let along = if along.x < 0.0 { -along } else { along };
    let angle = (-along.y).atan2(along.x);
    taken.push((middle, half));
    let down = along.unit().left() * (0.36 * size);
    let halo = Some(Halo { color: GROUND, width: 0.25 * size });
    Some(Lettering { at: middle + down, angle, halo, align: Align::Middle, ..line })
}

/// Arc length at each point.
fn arc_lengths(points: &[Vec2]) -> Vec<f64> {
    let mut arcs = vec![0.0];
    for ends in points.windows(2) {
        arcs.push(arcs[arcs.len() - 1] + (ends[1] - ends[0]).length());
    }
    arcs
}

fn point_at(points: &[Vec2], arcs: &[f64], s: f64) -> Vec2 {
    let k = arcs.partition_point(|&arc| arc <= s).clamp(1, points.len().max(2) - 1);
    let (Some(&a), Some(&b)) = (points.get(k - 1), points.get(k)) else { return Vec2::ZERO };
    let part = (s - arcs[k - 1]) / (arcs[k] - arcs[k - 1]).max(f64::MIN_POSITIVE);
    a + (b - a) * part.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::window(-1.0, -1.0, 1.0, 1.0, [600, 600]).unwrap()
    }

    fn circle(radius: f64, level: f64) -> Isoline {
        let at = |k: u32| {
            let (sin, cos) = (f64::from(k) / 100.0 * std::f64::consts::TAU).sin_cos();
            vec2(cos, sin) * radius
        };
        Isoline { level, points: (0..100).map(at).collect(), closed: true }
    }

    #[test]
    fn closed_lines_are_closed_and_labels_lie_on_their_lines() {
        let lines = [circle(0.8, 2.5), circle(0.5, -1.0), circle(0.01, 7.0)];
        let items = isolines(&view(), &lines, true);
        let Item::Line { path, .. } = &items[0] else { panic!("lines first") };
        assert!(path.pieces.iter().all(|p| p.len() == 101 && p.first() == p.last()));
        let texts: Vec<&Lettering> = items
            .iter()
            .filter_map(|item| match item {
                Item::Text(text) => Some(text),
                _ => None,
            })
            .collect();
        assert_eq!(texts.iter().map(|t| t.text.as_str()).collect::<Vec<_>>(), ["2.5", "−1"]);
        for (text, radius) in texts.iter().zip([240.0, 150.0]) {
            let from_center = (text.at - vec2(300.0, 300.0)).length();
            assert!((from_center - radius).abs() < 8.0, "{from_center}");
            assert!(text.angle.abs() <= std::f64::consts::FRAC_PI_2 + 1e-9, "upright");
        }
        assert_eq!(isolines(&view(), &lines, false).len(), 1);
        assert_eq!(isolines(&view(), &[], true).len(), 1);
    }
}
