//! Rims of holes as polygons that cut the body as the holes do.

use ppum::domain::{Domain, Hole};
use ppum::line::{Line, circles_meet};
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::TAU;

/// Corners of a polygon in a circle that nothing crosses.
const CORNERS: u32 = 16;

/// The domain with polygons for holes. Those of circles lie inside, with corners wherever another
/// curve crosses the circle: so what touches the circle touches the polygon.
pub(super) fn with_polygons(domain: &Domain, cracks: &[Vec<Vec2>]) -> Domain {
    let mut segments = domain.bounds.sides().to_vec();
    segments.extend(cracks.iter().flat_map(|crack| crack.windows(2)).map(|s| [s[0], s[1]]));
    segments.extend(domain.holes.iter().flat_map(Hole::sides));
    let polygon = |hole: &Hole| match hole {
        Hole::Polygon { .. } => hole.clone(),
        Hole::Circle { center, radius } => {
            Hole::polygon(in_circle(*center, *radius, &segments, &domain.holes))
        }
    };
    Domain { bounds: domain.bounds, holes: domain.holes.iter().map(polygon).collect() }
}

fn in_circle(center: Vec2, radius: f64, segments: &[[Vec2; 2]], holes: &[Hole]) -> Vec<Vec2> {
    let mut angles: Vec<f64> =
        (0..CORNERS).map(|k| TAU * f64::from(k) / f64::from(CORNERS)).collect();
    let mut add = |d: Vec2| angles.push(d.y.atan2(d.x).rem_euclid(TAU));
    for &[a, b] in segments {
        crossings([a - center, b - center], radius).into_iter().for_each(&mut add);
    }
    for hole in holes {
        if let Hole::Circle { center: other, radius: reach } = hole {
            let meet = circles_meet((Vec2::ZERO, radius), (*other - center, *reach));
            meet.into_iter().flatten().for_each(&mut add);
        }
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles.into_iter().map(|angle| center + vec2(angle.cos(), angle.sin()) * radius).collect()
}

/// Crossings of a segment and the circle around the origin.
fn crossings(ends: [Vec2; 2], radius: f64) -> Vec<Vec2> {
    let line = Line::through(ends);
    let places = line.meets_circle(Vec2::ZERO, radius).into_iter().flatten();
    places.filter(|s| (0.0..=1.0).contains(s)).map(|s| line.at(s)).collect()
}
