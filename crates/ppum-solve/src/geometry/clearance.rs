//! Clearance of crack tips: the largest disc around a tip in which nothing disturbs its field.

use super::material::jumps;
use ppum::crack::{Crack, TipId};
use ppum::dataset::Dataset;
use ppum::domain::Domain;
use ppum::segment;
use ppum::vec2::Vec2;

/// Distance from a tip, in cells, at which the material is compared with the tip's: more than rounding of the
/// coordinates, and nothing against the lengths over which a material varies smoothly.
const BESIDE: f64 = 1e-9;

/// Radius of the clearance, in cells at the tip, from which on stress intensity factors are off by less than 0.2 %
/// with tips beside another tip and beside the border (order 2; 0.05 % at order 3; docs/decisions/0004).
pub(crate) const AMPLE_CLEARANCE: f64 = 2.0;

/// The largest disc around a tip that holds no border, no hole and no part of a crack but the last segment of its
/// own. The material may vary and jump in it; a tip at which it jumps has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipClearance {
    /// Its radius.
    pub radius: f64,
    /// The obstacle that ends it.
    pub end: Obstacle,
}

/// The end of the [`TipClearance`] of a tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Obstacle {
    /// The border of the plate.
    Border,
    /// The rim of a hole, by its index.
    Hole(usize),
    /// A kink of its own crack, or the crack's other end.
    Kink,
    /// Another crack, by its index.
    Crack(usize),
    /// An interface of two materials, on which the tip itself lies.
    Interface,
}

impl Obstacle {
    /// In words, e.g. `crack 3`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Border => "the border".into(),
            Self::Hole(k) => format!("the rim of hole {k}"),
            Self::Kink => "a kink or the other end of its crack".into(),
            Self::Crack(k) => format!("crack {k}"),
            Self::Interface => "an interface of two materials".into(),
        }
    }
}

impl TipClearance {
    /// The clearance of a tip of a dataset's step with these cracks, in cells of the size `cell`.
    pub(crate) fn new(dataset: &Dataset, cracks: &[Crack], tip: TipId, cell: f64) -> Self {
        let p = cracks[tip.crack as usize].end_point(tip.end);
        let elastic = dataset.equation.elastic();
        let on_interface = elastic.is_some_and(|body| jumps(body, p, BESIDE * cell));
        let end = on_interface.then_some(Self { radius: 0.0, end: Obstacle::Interface });
        Self::among_cracks(cracks, &dataset.domain, tip).with(end.into_iter())
    }

    /// The clearance without regard of materials.
    pub(crate) fn among_cracks(cracks: &[Crack], domain: &Domain, tip: TipId) -> Self {
        Self::among(cracks.iter().enumerate(), domain, (&cracks[tip.crack as usize], tip))
    }

    /// The same among some of the cracks, with their numbers, of which the tip's own one is left out.
    pub(crate) fn among<'c>(
        cracks: impl Iterator<Item = (usize, &'c Crack)>,
        domain: &Domain,
        (own, tip): (&Crack, TipId),
    ) -> Self {
        let p = own.end_point(tip.end);
        let depth = (p - domain.bounds.min).min(domain.bounds.max - p);
        let border = Self { radius: depth.x.min(depth.y), end: Obstacle::Border };
        let holes = domain.holes.iter().enumerate();
        let rims =
            holes.map(|(k, hole)| Self { radius: hole.rim_distance(p), end: Obstacle::Hole(k) });
        let others = cracks.filter(|(k, _)| *k != tip.crack as usize).map(|(k, c)| Self {
            radius: segment::polyline_distance(&c.points, p),
            end: Obstacle::Crack(k),
        });
        border.with(rims).with(others.chain([Self { radius: behind(own, p), end: Obstacle::Kink }]))
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
    vertices
        .chain(segments.map(|s| segment::distance([s[0], s[1]], tip)))
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::{CrackEnd, End};
    use ppum::domain::Hole;
    use ppum::vec2::{Rect, vec2};

    fn clearance(cracks: &[Crack], crack: u32, end: End) -> (f64, Obstacle) {
        let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
        let holes = vec![Hole::Circle { center: vec2(0.0, 0.75), radius: 0.125 }];
        let domain = Domain { bounds, holes };
        let clearance = TipClearance::among_cracks(cracks, &domain, TipId { crack, end });
        (clearance.radius, clearance.end)
    }

    fn crack(points: &[[f64; 2]]) -> Crack {
        let points = points.iter().copied().map(Vec2::from).collect();
        Crack { points, ends: [CrackEnd::Tip; 2] }
    }

    #[test]
    fn the_nearest_thing_ends_the_room() {
        let alone = [crack(&[[-0.125, 0.0], [0.5, 0.0]])];
        assert_eq!(clearance(&alone, 0, End::Last), (0.5, Obstacle::Border));
        assert_eq!(clearance(&alone, 0, End::Start), (0.625, Obstacle::Kink));
        let kinked = [crack(&[[-0.25, 0.0], [0.25, 0.0], [0.25, 0.125]])];
        assert_eq!(clearance(&kinked, 0, End::Last), (0.125, Obstacle::Kink));
        assert_eq!(clearance(&kinked, 0, End::Start), (0.5, Obstacle::Kink));
        // back beside the tip without a vertex near it
        let hooked = [crack(&[[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [-0.5, 0.25]])];
        assert_eq!(clearance(&hooked, 0, End::Start), (0.25, Obstacle::Kink));
        let two = [crack(&[[-0.5, 0.0], [0.0, 0.0]]), crack(&[[0.125, -0.5], [0.125, 0.5]])];
        assert_eq!(clearance(&two, 0, End::Last), (0.125, Obstacle::Crack(1)));
        let up = [crack(&[[0.0, -0.5], [0.0, 0.5]])];
        assert_eq!(clearance(&up, 0, End::Last), (0.125, Obstacle::Hole(0)));
    }
}
