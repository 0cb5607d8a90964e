//! How much room a tip has: the largest disc around it in which nothing disturbs the integral.

use crate::quadrature::Kink;
use crate::space::Space;
use ppum::crack::{Crack, TipId};
use ppum::domain::Domain;
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::TAU;

/// Rays around a tip and steps along each on which curved interfaces are looked for.
const RAYS: u32 = 64;
const STEPS: u32 = 64;

/// The largest disc around a tip that holds no border, no part of a crack but the last segment of its
/// own, and no interface of two materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Its radius.
    pub radius: f64,
    /// What ends it.
    pub end: Obstacle,
}

/// What ends the [`Room`] of a tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Obstacle {
    /// The border of the plate.
    Border,
    /// A kink of its own crack, or the crack's other end.
    Kink,
    /// Another crack, by its index.
    Crack(usize),
    /// An interface of two materials.
    Interface,
}

impl Obstacle {
    /// In words, e.g. `crack 3`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Border => "the border".into(),
            Self::Kink => "a kink or the other end of its crack".into(),
            Self::Crack(k) => format!("crack {k}"),
            Self::Interface => "an interface of two materials".into(),
        }
    }
}

impl Room {
    /// The room of a tip of a space's step on a domain.
    pub(super) fn new(space: &Space<'_>, domain: &Domain, tip: TipId) -> Self {
        let cracks = &space.step.cracks;
        let p = cracks[tip.crack as usize].end_point(tip.end);
        let free = Self::among_cracks(cracks, domain, tip);
        let apart = space.interfaces().map(|kink| interface_distance(kink, p, free.radius));
        free.with(apart.map(|radius| Self { radius, end: Obstacle::Interface }))
    }

    /// The room without regard of materials.
    pub(crate) fn among_cracks(cracks: &[Crack], domain: &Domain, tip: TipId) -> Self {
        let own = &cracks[tip.crack as usize];
        let p = own.end_point(tip.end);
        let edges = (p - domain.bounds.min).min(domain.bounds.max - p);
        let rims = domain.holes.iter().map(|hole| hole.rim_distance(p));
        let border = rims.fold(edges.x.min(edges.y), f64::min);
        let border = Self { radius: border, end: Obstacle::Border };
        let others = cracks.iter().enumerate().filter(|(k, _)| *k != tip.crack as usize);
        let others =
            others.map(|(k, c)| Self { radius: nearest(&c.points, p), end: Obstacle::Crack(k) });
        border.with(others.chain([Self { radius: behind(own, p), end: Obstacle::Kink }]))
    }

    /// The smallest of several.
    fn with(self, others: impl Iterator<Item = Self>) -> Self {
        others.fold(self, |a, b| if b.radius < a.radius { b } else { a })
    }
}

/// Distance of a tip to what is not the last segment of its crack.
fn behind(own: &Crack, tip: Vec2) -> f64 {
    let vertices = own.points.iter().filter(|&&v| v != tip).map(|&v| (v - tip).length());
    let segments = own.points.windows(2).filter(|s| !s.contains(&tip));
    vertices.chain(segments.map(|s| segment_distance(s, tip))).fold(f64::INFINITY, f64::min)
}

/// Distance of a point to a polyline.
fn nearest(points: &[Vec2], p: Vec2) -> f64 {
    points.windows(2).map(|s| segment_distance(s, p)).fold(f64::INFINITY, f64::min)
}
/// Distance of a point to an interface, as far as it is below `reach`; of a curve a lower bound, by the
/// sides of points on rays.
fn interface_distance(kink: &Kink, p: Vec2, reach: f64) -> f64 {
    match kink {
        Kink::Line([a, b]) => ((*b - *a).unit().cross(p - *a)).abs(),
        Kink::Segment(ends) => segment_distance(ends, p),
        Kink::Curve(level) => {
            let own = level(p);
            let crosses = |step: &u32| {
                let radius = reach * f64::from(*step) / f64::from(STEPS);
                let ray = |k: u32| TAU * f64::from(k) / f64::from(RAYS);
                let point = |k: u32| p + vec2(ray(k).cos(), ray(k).sin()) * radius;
                (0..RAYS).any(|k| level(point(k)) * own <= 0.0)
            };
            let first = (1..=STEPS).find(crosses).unwrap_or(STEPS + 1);
            reach * f64::from(first - 1) / f64::from(STEPS)
        }
    }
}

fn segment_distance(s: &[Vec2], p: Vec2) -> f64 {
    let (d, e) = (s[1] - s[0], p - s[0]);
    let t = (e.dot(d) / d.dot(d)).clamp(0.0, 1.0);
    (e - d * t).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::{CrackEnd, End};
    use ppum::vec2::Rect;
    use std::sync::Arc;

    fn room(cracks: &[Crack], crack: u32, end: End) -> (f64, Obstacle) {
        let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)).into();
        let room = Room::among_cracks(cracks, &domain, TipId { crack, end });
        (room.radius, room.end)
    }

    fn crack(points: &[[f64; 2]]) -> Crack {
        let points = points.iter().copied().map(Vec2::from).collect();
        Crack { points, ends: [CrackEnd::Tip; 2] }
    }

    #[test]
    fn the_nearest_thing_ends_the_room() {
        let alone = [crack(&[[-0.125, 0.0], [0.5, 0.0]])];
        assert_eq!(room(&alone, 0, End::Last), (0.5, Obstacle::Border));
        assert_eq!(room(&alone, 0, End::Start), (0.625, Obstacle::Kink));
        let kinked = [crack(&[[-0.25, 0.0], [0.25, 0.0], [0.25, 0.125]])];
        assert_eq!(room(&kinked, 0, End::Last), (0.125, Obstacle::Kink));
        assert_eq!(room(&kinked, 0, End::Start), (0.5, Obstacle::Kink));
        // back beside the tip without a vertex near it
        let hooked = [crack(&[[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [-0.5, 0.25]])];
        assert_eq!(room(&hooked, 0, End::Start), (0.25, Obstacle::Kink));
        let two = [crack(&[[-0.5, 0.0], [0.0, 0.0]]), crack(&[[0.125, -0.5], [0.125, 0.5]])];
        assert_eq!(room(&two, 0, End::Last), (0.125, Obstacle::Crack(1)));
        assert_eq!(room(&two, 1, End::Last), (0.5, Obstacle::Border));
    }

    #[test]
    fn interfaces_end_the_disc() {
        let p = vec2(0.1, 0.2);
        let line = Kink::Line([vec2(0.0, 0.5), vec2(1.0, 0.5)]);
        assert!((interface_distance(&line, p, 1.0) - 0.3).abs() < 1e-15);
        let segment = Kink::Segment([vec2(0.5, 0.5), vec2(1.0, 0.5)]);
        assert!((interface_distance(&segment, p, 1.0) - 0.5).abs() < 1e-15);
        let circle = Kink::Curve(Arc::new(|x: Vec2| x.dot(x) - 0.25));
        let found = interface_distance(&circle, p, 1.0);
        let exact = 0.5 - p.length();
        assert!(found <= exact && found > exact - 0.02, "{found} instead of {exact}");
        assert_eq!(interface_distance(&circle, vec2(3.0, 0.0), 1.0), 1.0);
    }
}
