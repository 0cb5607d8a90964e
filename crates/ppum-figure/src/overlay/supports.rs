//! Supports and loads as engineers draw them.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::view::View;

use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};

/// A point of the border with components that are held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportMark {
    /// The point.
    pub at: Vec2,
    /// Unit normal out of the body.
    pub outward: Vec2,
    /// The components that are held, x and y.
    pub held: [bool; 2],
    /// The direction that alone is held, where it is neither that of x nor of y.
    pub axis: Option<Vec2>,
    /// True where the field yields to a value of the surroundings, as heat of a cooled surface.
    pub yields: bool,
}

/// A point of the border with a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadMark {
    /// The point.
    pub at: Vec2,
    /// Unit normal out of the body.
    pub outward: Vec2,
    /// Force per area of the border.
    pub traction: Vec2,
}

impl LoadMark {
    /// The length of the longest arrow in a view of some pixels.
    #[must_use]
    pub fn longest(pixels: [u32; 2], scale: f64) -> f64 {
        (ARROW * scale).min(ARROW_PART * f64::from(pixels[0].min(pixels[1])))
    }
}

const SUPPORT: Rgba = [28, 84, 60, 255];
const LOAD: Rgba = [176, 32, 96, 255];
const SEAM: Rgba = [255, 255, 255, 170];
const WIDTH: f64 = 1.4;
/// Side of a support's triangle, and its ground's distance where it may roll.
const TRIANGLE: f64 = 11.0;
const ROLL: f64 = 3.5;
/// Length of the longest arrow, at most a part of the view's shorter side, and of an arrow's head.
const ARROW: f64 = 38.0;
const ARROW_PART: f64 = 0.12;
const HEAD: f64 = 8.0;
/// Arrows shorter than this are left out.
const SHORTEST: f64 = 2.0;

/// Supports as triangles whose tips touch the border. One on a hatched line holds both components;
/// one that stands on rollers holds the component along its own axis alone, and lies across the
/// border where that is its tangent. Springs from the border to a hatched line yield.
#[must_use]
pub fn supports(view: &View, scale: f64, supports: &[SupportMark]) -> Vec<CanvasItem> {
    let (mut bodies, mut lines) = (CanvasPath::default(), CanvasPath::default());
    for support in supports {
        let at = view.pixel(support.at);
        let rolling = match support.held {
            [true, false] => Some(vec2(1.0, 0.0)),
            [false, true] => Some(vec2(0.0, 1.0)),
            _ => support.axis,
        };
        match rolling {
            _ if support.yields => {
                let axis = on_page(support.outward);
                let end = spring(&mut lines, at, axis, scale);
                hatched(&mut lines, end, axis, scale);
            }
            None if support.held == [true; 2] => {
                let axis = on_page(nearest_axis(support.outward));
                let end = triangle(&mut bodies, at, axis, scale);
                hatched(&mut lines, end, axis, scale);
            }
            None => {}
            Some(axis) => {
                let sign = if axis.dot(support.outward) < 0.0 { -1.0 } else { 1.0 };
                let axis = on_page(axis * sign);
                let end = triangle(&mut bodies, at, axis, scale);
                ground(&mut lines, end + axis * (ROLL * scale), axis, scale);
            }
        }
    }
    let pen = StrokeStyle::new(SUPPORT, WIDTH * scale).with_halo(SEAM, scale);
    vec![
        CanvasItem::Fill { outline: bodies, color: SUPPORT },
        CanvasItem::Line { path: lines, pen },
    ]
}

/// Loads as arrows, the longest of one length whatever its traction: those that pull begin at the
/// border, those that press end there.
#[must_use]
pub fn loads(view: &View, scale: f64, loads: &[LoadMark]) -> Vec<CanvasItem> {
    let longest = LoadMark::longest(view.pixels, scale);
    let largest = loads.iter().map(|load| load.traction.length()).fold(0.0, f64::max);
    let (mut shafts, mut heads) = (CanvasPath::default(), CanvasPath::default());
    for load in loads {
        let way = on_page(load.traction / largest) * longest;
        if !way.is_finite() || way.length() < SHORTEST * scale {
            continue;
        }
        let at = view.pixel(load.at);
        let pulls = load.traction.dot(load.outward) >= -1e-9 * load.traction.length();
        let [from, to] = if pulls { [at, at + way] } else { [at - way, at] };
        arrow(&mut shafts, &mut heads, [from, to], HEAD * scale);
    }
    let pen = StrokeStyle::new(LOAD, WIDTH * scale).with_halo(SEAM, scale);
    vec![CanvasItem::Line { path: shafts, pen }, CanvasItem::Fill { outline: heads, color: LOAD }]
}

/// An arrow: a shaft, and a head that is no longer than the arrow.
pub(crate) fn arrow(
    shafts: &mut CanvasPath,
    heads: &mut CanvasPath,
    [from, to]: [Vec2; 2],
    head: f64,
) {
    let (along, length) = ((to - from).unit(), (to - from).length());
    let (head, across) = (head.min(length), along.left());
    let base = to - along * head;
    shafts.line(from, base);
    heads.pieces.push(vec![to, base + across * (0.36 * head), base - across * (0.36 * head), to]);
}

/// A direction of the world as one of the page, whose y runs down.
fn on_page(direction: Vec2) -> Vec2 {
    vec2(direction.x, -direction.y)
}

/// The coordinate direction nearest to a normal.
fn nearest_axis(normal: Vec2) -> Vec2 {
    if normal.x.abs() > normal.y.abs() {
        vec2(normal.x.signum(), 0.0)
    } else {
        vec2(0.0, normal.y.signum())
    }
}

/// A triangle with its tip at a point and its base away from it; the middle of the base.
fn triangle(bodies: &mut CanvasPath, at: Vec2, axis: Vec2, scale: f64) -> Vec2 {
    let (height, half) = (TRIANGLE * scale, 0.5 * TRIANGLE * scale);
    let (base, across) = (at + axis * height, axis.left());
    bodies.pieces.push(vec![at, base + across * half, base - across * half, at]);
    base
}

/// A spring from a point along an axis, to its far end.
fn spring(lines: &mut CanvasPath, at: Vec2, axis: Vec2, scale: f64) -> Vec2 {
    let (length, across) = (1.5 * TRIANGLE * scale, axis.left() * (0.3 * TRIANGLE * scale));
    let sides = [0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 0.0, 0.0];
    let last = (sides.len() - 1) as f64;
    let point = |(k, side): (usize, f64)| at + axis * (length * k as f64 / last) + across * side;
    lines.pieces.push(sides.into_iter().enumerate().map(point).collect());
    at + axis * length
}

/// A straight line under a support.
fn ground(lines: &mut CanvasPath, middle: Vec2, axis: Vec2, scale: f64) {
    let across = axis.left() * (0.75 * TRIANGLE * scale);
    lines.line(middle - across, middle + across);
}

/// A line with hatching on its far side.
fn hatched(lines: &mut CanvasPath, middle: Vec2, axis: Vec2, scale: f64) {
    ground(lines, middle, axis, scale);
    let (across, stroke) = (axis.left() * (TRIANGLE * scale), 0.3 * TRIANGLE * scale);
    for k in -1..=1 {
        let from = middle + across * (0.45 * f64::from(k) + 0.15);
        lines.line(from, from + axis * stroke - axis.left() * stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::window(-1.0, -1.0, 1.0, 1.0, [400, 400]).unwrap()
    }

    /// All points of the items' paths.
    fn path_points(items: &[CanvasItem]) -> Vec<Vec2> {
        let path = |item: &CanvasItem| match item {
            CanvasItem::Fill { outline, .. } => outline.clone(),
            CanvasItem::Line { path, .. } => path.clone(),
            _ => CanvasPath::default(),
        };
        items.iter().flat_map(|item| path(item).pieces.into_iter().flatten()).collect()
    }

    #[test]
    fn supports_stand_outside_of_the_plate() {
        for (at, outward) in [
            (vec2(0.0, -1.0), vec2(0.0, -1.0)),
            (vec2(1.0, 0.2), vec2(1.0, 0.0)),
            (vec2(-1.0, 0.2), vec2(-1.0, 0.0)),
        ] {
            let border = view().pixel(at).dot(vec2(outward.x, -outward.y));
            let kinds = [([true, true], false), ([outward.x != 0.0, outward.y != 0.0], false)];
            for (held, yields) in kinds.into_iter().chain([([false; 2], true)]) {
                let items = supports(
                    &view(),
                    1.0,
                    &[SupportMark { at, outward, held, axis: None, yields }],
                );
                let points = path_points(&items);
                assert!(points.len() > 4);
                for p in points {
                    assert!(p.dot(vec2(outward.x, -outward.y)) >= border - 1e-9, "{p:?} {at:?}");
                }
            }
        }
        let (at, outward) = (vec2(0.0, 1.0), vec2(0.0, 1.0));
        let free = SupportMark { at, outward, held: [false; 2], axis: None, yields: false };
        assert!(path_points(&supports(&view(), 1.0, &[free])).is_empty());
    }

    /// Tension points away from the body, pressure towards it; both are drawn outside.
    #[test]
    fn arrows_show_the_way_of_the_load() {
        let (at, outward) = (vec2(0.0, 1.0), vec2(0.0, 1.0));
        for (traction, tip_row) in [(2.0, view().pixel(at).y - ARROW), (-2.0, view().pixel(at).y)] {
            let load = LoadMark { at, outward, traction: vec2(0.0, traction) };
            let items = loads(&view(), 1.0, &[load]);
            let CanvasItem::Fill { outline, .. } = &items[1] else { panic!("heads") };
            assert!((outline.pieces[0][0].y - tip_row).abs() < 1e-9);
            assert!(path_points(&items).iter().all(|p| p.y <= view().pixel(at).y + 1e-9));
        }
    }

    #[test]
    fn lengths_go_with_the_loads() {
        let outward = vec2(0.0, 1.0);
        let load = |x: f64, t: f64| LoadMark { at: vec2(x, 1.0), outward, traction: vec2(0.0, t) };
        let items = loads(&view(), 1.0, &[load(-0.5, 1.0), load(0.5, 4.0), load(0.0, 0.0)]);
        let CanvasItem::Fill { outline, .. } = &items[1] else { panic!("heads") };
        let reach: Vec<_> =
            outline.pieces.iter().map(|head| view().pixel(vec2(0.0, 1.0)).y - head[0].y).collect();
        assert!((reach[1] - ARROW).abs() < 1e-9 && (reach[0] - 0.25 * ARROW).abs() < 1e-9);
        assert_eq!(reach.len(), 2);
        for nothing in [vec![], vec![load(0.0, 0.0)], vec![load(0.0, f64::NAN)]] {
            assert!(path_points(&loads(&view(), 1.0, &nothing)).is_empty());
        }
    }
}
