//! Isolines with their levels.

use ppum::crack::Crack;
use ppum::edge::Edge;
use ppum::line::Line;
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::isoline::Isoline;
use ppum_render::picture::ColoredRaster;
use ppum_render::view::View;

use super::strokes::visible_edges;
use crate::canvas::Halo;
use crate::canvas::{Align, CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::ticks::Notation;

const LINE: Rgba = [18, 18, 22, 235];
const SEAM: Rgba = [255, 255, 255, 105];
const GROUND: Rgba = [255, 255, 255, 215];
const WIDTH: f64 = 1.2;
const TEXT: f64 = 11.5;
/// A line this many times as long as its label, and as that is high, has one.
const ROOM: [f64; 2] = [2.5, 6.0];

/// Distance from an arc at which pixels count as those along it \[pixels\].
const NEAR: f64 = 0.1;

/// The pixels that labels may cover: those of the body, away from cracks.
#[derive(Clone, Debug)]
pub struct Room {
    columns: usize,
    is_free: Vec<bool>,
    /// The way levels are written.
    notation: Notation,
    /// Middles and half lengths of the labels.
    labels: Vec<(Vec2, f64)>,
}

impl Room {
    /// The room of an image: where it is not transparent. Levels are written in some notation:
    /// that of the bar beside the image, or a plain one where there is none.
    #[must_use]
    pub fn new(picture: &ColoredRaster, cracks: &[Crack], notation: Notation) -> Self {
        let image = &picture.image;
        let is_free = image.rgba.chunks_exact(4).map(|pixel| pixel[3] > 0).collect();
        let mut room =
            Self { columns: image.size[0] as usize, is_free, notation, labels: Vec::new() };
        for edge in cracks.iter().flat_map(Crack::edges) {
            room.close_edge(&picture.view, edge);
        }
        room
    }

    /// Takes away the pixels along an edge.
    fn close_edge(&mut self, view: &View, edge: Edge) {
        if !edge.is_arc() {
            self.close([edge.from, edge.to].map(|p| view.pixel(p)));
        }
        for arc in visible_edges(view, edge).into_iter().filter(Edge::is_arc) {
            arc.flattened(NEAR).windows(2).for_each(|ends| self.close([ends[0], ends[1]]));
        }
    }

    /// Takes away the pixels along a line.
    fn close(&mut self, line: [Vec2; 2]) {
        let size = vec2(self.columns as f64, (self.is_free.len() / self.columns.max(1)) as f64);
        let all = Rect::new(Vec2::ZERO, size);
        let Some([a, b]) = Line::through(line).clipped(&all, [0.0, 1.0]) else { return };
        let steps = (b - a).length().ceil().max(1.0);
        for k in 0..=steps as usize {
            let p = a + (b - a) * (k as f64 / steps);
            if let Some(pixel) = self.pixel(p) {
                self.is_free[pixel] = false;
            }
        }
    }

    /// The room without a box.
    #[must_use]
    pub fn without(mut self, [min, max]: [Vec2; 2]) -> Self {
        for (row, pixels) in (0u32..).zip(self.is_free.chunks_mut(self.columns.max(1))) {
            let is_in =
                |at: u32, min: f64, max: f64| f64::from(at) + 1.0 > min && f64::from(at) < max;
            for (column, is_free) in (0u32..).zip(pixels).filter(|_| is_in(row, min.y, max.y)) {
                *is_free &= !is_in(column, min.x, max.x);
            }
        }
        self
    }

    fn pixel(&self, p: Vec2) -> Option<usize> {
        let is_inside = p.x >= 0.0 && p.y >= 0.0 && p.x < self.columns as f64;
        let pixel = p.y.max(0.0) as usize * self.columns + p.x.max(0.0) as usize;
        Some(pixel).filter(|&pixel| is_inside && pixel < self.is_free.len())
    }

    /// True if a rectangle about a point covers nothing else, `half` its sides' halves along a
    /// direction and across.
    fn holds(&self, middle: Vec2, along: Vec2, half: Vec2) -> bool {
        let [columns, rows] = [half.x, half.y].map(|half| half.ceil().max(1.0) as i32);
        let part = |k: i32, n: i32| f64::from(k) / f64::from(n);
        (-columns..=columns).all(|i| {
            (-rows..=rows).all(|j| {
                let across = along.left() * (half.y * part(j, rows));
                let pixel = self.pixel(middle + along * (half.x * part(i, columns)) + across);
                pixel.is_some_and(|pixel| self.is_free[pixel])
            })
        })
    }
}

/// Isolines as dark lines with a light seam, of one width everywhere; with their levels, if that is
/// wanted, where there is room.
#[must_use]
pub fn isolines(view: &View, scale: f64, lines: &[Isoline], room: Option<Room>) -> Vec<CanvasItem> {
    let path = CanvasPath::of_pieces(lines.iter().map(|line| points(view, line)).collect());
    let pen = StrokeStyle::new(LINE, WIDTH * scale).with_halo(SEAM, 0.7 * scale);
    let mut items = vec![CanvasItem::Line { path: path.clone(), pen }];
    if let Some(mut room) = room {
        for (line, points) in lines.iter().zip(&path.pieces) {
            items.extend(label(view, scale, line.level, points, &mut room).map(CanvasItem::Text));
        }
    }
    items
}

/// The line in pixels, the first point again at the end of a closed one.
fn points(view: &View, line: &Isoline) -> Vec<Vec2> {
    thinned(line.polyline().into_iter().map(|offset| view.pixel_of_offset(offset)).collect())
}

/// The points of a line without those that lie within [`UNSEEN`] of the chord of others; its ends
/// stay.
fn thinned(points: Vec<Vec2>) -> Vec<Vec2> {
    let Some(last) = points.len().checked_sub(1) else { return points };
    let (mut kept, mut from) = (vec![points[0]], 0);
    while from < last {
        let lies_near = |&to: &usize| {
            let chord = [points[from], points[to]];
            points[from + 1..to].iter().all(|&p| segment::distance(chord, p) <= UNSEEN)
        };
        let farthest = (from + 2..=last.min(from + RUN)).take_while(lies_near).last();
        from = farthest.unwrap_or(from + 1);
        kept.push(points[from]);
    }
    kept
}

/// Distance that nobody sees, pixels.
const UNSEEN: f64 = 0.02;
/// Most points that one chord stands for.
const RUN: usize = 48;

/// The level along the straightest part of its line, away from other labels, cracks and the body's
/// border; none where there is no room.
fn label(
    view: &View,
    scale: f64,
    level: f64,
    points: &[Vec2],
    room: &mut Room,
) -> Option<TextItem> {
    let size = TEXT * scale;
    let line = TextItem::new(room.notation.label(level), size, Vec2::ZERO, LINE);
    let half = 0.5 * line.width();
    let arcs = arc_lengths(points);
    let length = *arcs.last()?;
    if length < (ROOM[0] * 2.0 * half).max(ROOM[1] * size) {
        return None;
    }
    let at = |s: f64| point_at(points, &arcs, s);
    let margin = vec2(half + size, half + size);
    let most = vec2(f64::from(view.pixels[0]), f64::from(view.pixels[1])) - margin;
    // upright: read from left to right
    let along = |s: f64| {
        let way = at((s + half).min(length)) - at((s - half).max(0.0));
        if way.x < 0.0 { -way.unit() } else { way.unit() }
    };
    let is_free = |s: f64| {
        let p = at(s);
        let inside = p.x > margin.x && p.y > margin.y && p.x < most.x && p.y < most.y;
        let is_apart = |(q, r): &(Vec2, f64)| (p - *q).length() > half + r + 2.0 * size;
        inside
            && room.labels.iter().all(is_apart)
            && room.holds(p, along(s), vec2(half + 0.3 * size, 0.7 * size))
    };
    const PLACES: u32 = 24;
    let places = (1..PLACES).map(|k| length * f64::from(k) / f64::from(PLACES));
    let bend = |s: f64| {
        let (a, b) = (at((s - half).max(0.0)), at((s + half).min(length)));
        ((a + b) * 0.5 - at(s)).length()
    };
    let best = places.filter(|&s| is_free(s)).min_by(|&a, &b| bend(a).total_cmp(&bend(b)))?;
    if bend(best) > 0.6 * size {
        return None;
    }
    let (middle, along) = (at(best), along(best));
    let angle = (-along.y).atan2(along.x);
    room.labels.push((middle, half));
    let down = along.left() * (0.36 * size);
    let halo = Some(Halo { color: GROUND, width: 0.25 * size });
    Some(TextItem { at: middle + down, angle, halo, align: Align::Middle, ..line })
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
    use ppum::crack::CrackEnd;
    use ppum_render::picture::Style;
    use ppum_render::raster::Raster;
    use ppum_testkit::random::Random;

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
        let items = isolines(&view(), 1.0, &lines, Some(room(&[])));
        let CanvasItem::Line { path, .. } = &items[0] else { panic!("lines first") };
        assert!(path.pieces.iter().all(|p| p.len() > 2 && p.first() == p.last()));
        let texts: Vec<&TextItem> = items
            .iter()
            .filter_map(|item| match item {
                CanvasItem::Text(text) => Some(text),
                _ => None,
            })
            .collect();
        assert_eq!(texts.iter().map(|t| t.text.as_str()).collect::<Vec<_>>(), ["2.5", "−1"]);
        for (text, radius) in texts.iter().zip([240.0, 150.0]) {
            let from_center = (text.at - vec2(300.0, 300.0)).length();
            assert!((from_center - radius).abs() < 8.0, "{from_center}");
            assert!(text.angle.abs() <= std::f64::consts::FRAC_PI_2 + 1e-9, "upright");
        }
        assert_eq!(isolines(&view(), 1.0, &lines, None).len(), 1);
        assert_eq!(isolines(&view(), 1.0, &[], Some(room(&[]))).len(), 1);
    }

    /// Circles keep a point where the chord's sagitta, s²/8r, comes near what is unseen; straight
    /// lines their ends.
    #[test]
    fn lines_have_as_few_points_as_they_need() {
        for radius in [3.0, 50.0, 1000.0] {
            let turn = |k: u32| 0.5 * f64::from(k) / radius;
            let count = (std::f64::consts::TAU * radius * 2.0) as u32;
            let circle: Vec<Vec2> =
                (0..count).map(|k| vec2(turn(k).cos(), turn(k).sin()) * radius).collect();
            let kept = thinned(circle.clone());
            let off = |p: &Vec2| {
                kept.windows(2).map(|c| segment::distance([c[0], c[1]], *p)).fold(9.0, f64::min)
            };
            assert!(circle.iter().all(|p| off(p) <= UNSEEN), "{radius}");
            let chord = (8.0 * radius * UNSEEN).sqrt().min(0.5 * RUN as f64);
            let fewest = std::f64::consts::TAU * radius / chord;
            assert!((kept.len() as f64) < 1.7 * fewest + 2.0, "{radius}: {} {fewest}", kept.len());
            assert_eq!((kept[0], kept.last()), (circle[0], circle.last()));
        }
        let straight = (0..40).map(|k| vec2(f64::from(k), 2.0 * f64::from(k))).collect();
        assert_eq!(thinned(straight).len(), 2);
        assert!(thinned(Vec::new()).is_empty());
    }

    const NOTATION: Notation = Notation::PLAIN;

    /// A white image except for a hole at its right.
    fn room(cracks: &[Crack]) -> Room {
        let is_hole = |i: u32, j: u32| (f64::from(i) - 560.0).hypot(f64::from(j) - 300.0) < 100.0;
        let value = |i, j| if is_hole(i, j) { f64::NAN } else { 1.0 };
        let raster = Raster::from_fn([600, 600], value);
        Room::new(
            &ColoredRaster::bare(&raster, &view(), &Style::default()).unwrap(),
            cracks,
            NOTATION,
        )
    }

    /// Labels keep away from a box, wherever it is, with all of their letters.
    #[test]
    fn labels_keep_clear_of_boxes() {
        let mut random = Random(18);
        let lines = [circle(0.8, 1.0), circle(0.6, 2.0), circle(0.4, 3.0)];
        let mut found = 0;
        for _ in 0..40 {
            let mut place = || vec2(random.between(-50.0, 600.0), random.between(-50.0, 600.0));
            let (a, b) = (place(), place());
            let [min, max] = [a.min(b), a.max(b)];
            for item in isolines(&view(), 1.0, &lines, Some(room(&[]).without([min, max]))) {
                let (true, [lo, hi]) = (matches!(item, CanvasItem::Text(_)), item.bounds()) else {
                    continue;
                };
                found += 1;
                assert!(lo.x > max.x || hi.x < min.x || lo.y > max.y || hi.y < min.y, "{item:?}");
            }
        }
        assert!(found > 40, "{found}");
    }

    /// Labels stand neither on holes nor on cracks, with all of their letters.
    #[test]
    fn labels_keep_clear_of_holes_and_cracks() {
        let vertical = |x: f64| Isoline {
            level: -0.004,
            points: (0..=200).map(|k| vec2(x, f64::from(k) / 100.0 - 1.0)).collect(),
            closed: false,
        };
        let places = |cracks: &[Crack], x: f64| -> Vec<Vec2> {
            let items = isolines(&view(), 1.0, &[vertical(x)], Some(room(cracks)));
            let texts = items.iter().filter_map(|item| match item {
                CanvasItem::Text(text) => Some(text.at),
                _ => None,
            });
            texts.collect()
        };
        // through the hole's middle, and along its rim
        for x in [0.86, 0.55] {
            let at = places(&[], x)[0];
            assert!((at - vec2(560.0, 300.0)).length() > 108.0, "{at:?}");
        }
        let crack = |ends: [Vec2; 2]| Crack::polyline(ends.to_vec(), [CrackEnd::Tip; 2]);
        // a crack along the line, far beyond the image, leaves no room
        assert!(places(&[crack([vec2(-0.2, -1e9), vec2(-0.2, 1e9)])], -0.2).is_empty());
        assert_eq!(places(&[crack([vec2(0.2, -1.0), vec2(0.2, 1.0)])], -0.2).len(), 1);
        let half = places(&[crack([vec2(-0.2, 0.1), vec2(-0.2, 5.0)])], -0.2);
        assert!(half.len() == 1 && half[0].y > 280.0, "{half:?}");
    }
}
