//! Rules for the shapes and places of holes.

use ppum::border::touch;
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};

use super::cracks::{bad_bulges, self_touch};
use crate::data::DomainEdge;
use crate::file::{Key, KeyError};
use crate::geometry::{TooDense, meets, shown, solid_part};

/// Most circles and corners of polygons together, as in a dataset.
const MAX_RIMS: usize = 1 << 14;

/// All rules broken by the holes of a domain whose box is in order.
pub(crate) fn check_holes(domain: &Domain) -> Vec<KeyError> {
    let touch = touch(&domain.bounds);
    let rims = domain.holes.iter().map(|hole| hole.sides().count().max(1));
    if rims.sum::<usize>() > MAX_RIMS {
        let message = format!(
            "the holes have more than {MAX_RIMS} circles and corners together; leave some out"
        );
        return vec![Key::new("hole").error(message)];
    }
    let check = |(index, hole): (usize, &Hole)| {
        let (key, message) = match hole {
            Hole::Circle { center, radius } => bad_circle(*center, *radius, &domain.bounds, touch)?,
            Hole::Polygon { points, bulges, .. } => match bad_bulges(bulges, points.len()) {
                Some(bad) => bad,
                None => ("points".to_owned(), bad_polygon(points, hole, &domain.bounds, touch)?),
            },
        };
        let key = match hole.is_outside() {
            true => Key::new("domain.outline"),
            false => Key::new("hole").index(index).name(&key),
        };
        Some(key.error(message))
    };
    let mut found: Vec<_> = domain.holes.iter().enumerate().filter_map(check).collect();
    if found.is_empty() {
        found.extend(holes_outside(domain));
    }
    found
}

/// Holes that lie outside of the outline.
fn holes_outside(domain: &Domain) -> Vec<KeyError> {
    let Some(outline) = domain.outline().map(|index| &domain.holes[index]) else {
        return Vec::new();
    };
    let is_side_out = |side: Edge| solid_part(side, [0.0, 1.0], std::iter::once(outline)) == 0.0;
    let is_out = |hole: &Hole| match hole {
        Hole::Circle { center, radius } => {
            outline.contains(*center) && outline.rim_distance(*center) >= *radius
        }
        Hole::Polygon { .. } => !hole.is_outside() && hole.edges().all(is_side_out),
    };
    let out = domain.holes.iter().enumerate().filter(|(_, hole)| is_out(hole));
    let message = "the hole lies outside of the outline; move it in, or leave it out";
    out.map(|(index, _)| Key::new("hole").index(index).error(message)).collect()
}

fn bad_circle(center: Vec2, radius: f64, bounds: &Rect, touch: f64) -> Option<(String, String)> {
    let message = if !center.is_finite() {
        return Some(("center".to_owned(), "the centre is not finite".to_owned()));
    } else if !(radius > 0.0 && radius.is_finite()) {
        format!("`radius` is {radius}, but must be positive and finite")
    } else if radius <= touch {
        format!("`radius` is {radius}, too small to be seen in this domain; leave the hole out")
    } else if bounds.distance(center) >= radius {
        MISSES.to_owned()
    } else if bounds.corners().iter().all(|&p| (p - center).length() <= radius) {
        SWALLOWS.to_owned()
    } else {
        return None;
    };
    Some(("radius".to_owned(), message))
}

const MISSES: &str = "the hole misses the domain; move it in, or leave it out";
const SWALLOWS: &str = "the hole swallows the whole domain; make it smaller";

fn bad_polygon(points: &[Vec2], hole: &Hole, bounds: &Rect, touch: f64) -> Option<String> {
    let is_lens = points.len() == 2 && hole.edges().any(|side| side.is_arc());
    if points.len() < 3 && !is_lens {
        return Some("a polygon needs at least three points; add `[x, y]`".to_owned());
    }
    if !points.iter().all(|p| p.is_finite()) {
        return Some("a point is not finite".to_owned());
    }
    let sides: Vec<_> = hole.edges().collect();
    if let Some(k) = sides.iter().position(|side| side.chord().length() <= touch) {
        return Some(format!("the points {k} and the next one are equal; remove one of them"));
    }
    let Ok(crossing) = self_touch(&sides, true, touch) else {
        return Some(TooDense::message("parts of the rim"));
    };
    if let Some((first, second)) = crossing {
        return Some(format!(
            "the rim crosses or touches itself around {}: its sides {first} and {second} meet; give its \
             corners in order, once each",
            shown(sides[first].meeting_point(&sides[second]))
        ));
    }
    if hole.is_outside() {
        return bad_outline(hole, bounds, touch).map(str::to_owned);
    }
    let met = sides.iter().any(|side| meets(*side, bounds));
    let swallows = hole.contains(bounds.center()) && !sides.iter().any(|s| crosses_box(*s, bounds));
    match (swallows, met) {
        (true, _) => Some(SWALLOWS.to_owned()),
        (false, false) => Some(MISSES.to_owned()),
        _ => None,
    }
}

fn bad_outline(outline: &Hole, bounds: &Rect, touch: f64) -> Option<&'static str> {
    let met = outline.edges().any(|side| crosses_box(side, bounds));
    let along = |side: Edge| {
        let is_on = |edge: &DomainEdge, p: Vec2| edge.depth(bounds, p).abs() <= touch;
        let mut edges = DomainEdge::ALL.iter();
        !side.is_arc() && edges.any(|edge| is_on(edge, side.from) && is_on(edge, side.to))
    };
    if !met && outline.contains(bounds.center()) {
        Some("the outline lies outside of the box; leave `min` and `max` out")
    } else if !met {
        Some("the outline encloses the whole box, which is the body then; leave one of them out")
    } else if outline.edges().any(along) {
        Some(
            "the outline runs along an edge of the box; leave `min` and `max` out, or make the box larger",
        )
    } else {
        None
    }
}

fn crosses_box(side: Edge, bounds: &Rect) -> bool {
    crate::geometry::edge_inside(side, bounds) > 0.0
}
