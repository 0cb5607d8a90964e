//! The boundary of a mesh around a tip.

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::mesh::ElementField;
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};

/// Distance from a side at which it is looked what lies behind, in parts of its length.
const BESIDE: f64 = 1e-6;

/// Distance from a point to the nearest boundary of a mesh that is not a slit, within a radius.
pub(super) fn boundary_distance(field: &Field<'_>, center: Vec2, radius: f64) -> f64 {
    let local = field.at(center);
    let mut patches = Vec::new();
    field.tree.query_box(&Rect::around(center, vec2(radius, radius)), &mut patches);
    let elements = patches.iter().filter_map(|&patch| local.element(patch as usize));
    let of_element = |element: ElementField<'_, '_>| {
        let corners = element.corners();
        let distances = segment::sides(&corners).map(|side| side_distance(&local, &element, side));
        distances.fold(radius, f64::min)
    };
    elements.map(of_element).fold(radius, f64::min)
}

/// Places on a side at which it is looked what lies behind.
const LOOKS: [f64; 3] = [0.21, 0.5, 0.83];

/// Segments of a side.
const SEGMENTS: u32 = 8;

/// Distance of the anchor to a side of an element, if no other element lies behind it.
fn side_distance(local: &LocalField<'_>, element: &ElementField<'_, '_>, [a, b]: [Vec2; 2]) -> f64 {
    let at = |t: f64| element.point(a + (b - a) * t).offset;
    let is_boundary = LOOKS.iter().any(|&t| {
        let point = element.point(a + (b - a) * t);
        let [x, y] = point.columns;
        let delta = b - a;
        let along = x * delta.x + y * delta.y;
        let out = -along.left() * (x.cross(y).signum() * BESIDE);
        local.owner(point.offset + out, Side::Above).is_none()
    });
    if !is_boundary {
        return f64::INFINITY;
    }
    let places = (0..SEGMENTS).map(|k| [k, k + 1].map(|k| at(f64::from(k) / f64::from(SEGMENTS))));
    let distances = places.map(|ends| segment::distance(ends, Vec2::ZERO));
    distances.fold(f64::INFINITY, f64::min)
}
