//! Lines of cracks and rims: their colours and widths, and the parts of them that are seen.

use std::f64::consts::PI;

use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::Vec2;
use ppum_render::anchored_edge::AnchoredEdge;
use ppum_render::image::Rgba;
use ppum_render::view::View;

/// Dark line of a crack, and the light seam that parts it from dark colours.
pub(super) const CRACK: Rgba = [16, 16, 20, 255];
pub(super) const SEAM: Rgba = [255, 255, 255, 150];
/// Widths and radii in pixels of a bare image of at most 1024 × 768.
pub(super) const CRACK_WIDTH: f64 = 1.8;
pub(super) const TIP_RADIUS: f64 = 3.0;
pub(super) const RIM_WIDTH: f64 = 1.0;
pub(super) const SEAM_WIDTH: f64 = 1.0;

/// The parts of an edge in or near the view, in continuous pixel coordinates, each of half a turn
/// at most.
pub(super) fn visible_edges(view: &View, edge: Edge) -> Vec<Edge> {
    if edge.is_arc() {
        arcs(view, &AnchoredEdge::new(edge, view.center))
    } else {
        visible_part(view, edge.from, edge.to).map(Edge::segment).into_iter().collect()
    }
}

/// The parts of a circle, as [`visible_edges`] gives them.
pub(super) fn circle(view: &View, center: Vec2, radius: f64) -> Vec<Edge> {
    let halves = AnchoredEdge::halves(&Hole::Circle { center, radius }, view.center);
    halves.iter().flat_map(|half| arcs(view, half)).collect()
}

fn arcs(view: &View, edge: &AnchoredEdge) -> Vec<Edge> {
    let halved = |[low, high]: [f64; 2]| {
        let count = (edge.frame.curvature.abs() * (high - low) / PI).ceil().max(1.0);
        let place = move |k: f64| low + (high - low) * (k / count);
        (0..count as u32).map(f64::from).map(move |k| [place(k), place(k + 1.0)])
    };
    let drawn = |part: [f64; 2]| {
        let Edge { from, to, bulge } = edge.part(part);
        let [from, to] = [from, to].map(|offset| view.pixel_of_offset(offset));
        // rows run down
        Edge { from, to, bulge: -bulge }
    };
    edge.near(reach(view)).into_iter().flat_map(halved).map(drawn).collect()
}

/// Twice the half diagonal: line ends and widths beyond the border do not show.
fn reach(view: &View) -> f64 {
    2.0 * view.half().length()
}

/// The part of a segment in or near the view, in continuous pixel coordinates.
pub(super) fn visible_part(view: &View, a: Vec2, b: Vec2) -> Option<[Vec2; 2]> {
    let (from, to) = (a - view.center, b - view.center);
    let along = (b - a).unit();
    if !along.is_finite() {
        return None;
    }
    let nearer = if from.length() < to.length() { from } else { to };
    let normal = along.left();
    let (distance, reach) = (nearer.dot(normal), reach(view));
    let [start, end] = [from, to].map(|p| p.dot(along).clamp(-reach, reach));
    if distance.abs() > reach || start >= end {
        return None;
    }
    let at = |s: f64| view.pixel_of_offset(normal * distance + along * s);
    Some([at(start), at(end)])
}
