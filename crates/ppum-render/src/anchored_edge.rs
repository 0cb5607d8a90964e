//! Edges of cracks and rims seen from an anchor.

use ppum::domain::{Hole, LocalRim};
use ppum::edge::{Edge, EdgeFrame};
use ppum::vec2::{Rect, Vec2, vec2};
use std::f64::consts::{PI, TAU};

/// A segment or an arc seen from an anchor, in the frame of the point Q of its line or circle that
/// is nearest to the anchor.
#[derive(Clone, Copy, Debug)]
pub struct AnchoredEdge {
    /// Its line or circle.
    pub frame: EdgeFrame,
    /// Distance of the anchor from that, positive on its left.
    pub distance: f64,
    /// The places of its ends.
    pub range: [f64; 2],
}

impl AnchoredEdge {
    /// The edge seen from `anchor`.
    #[must_use]
    pub fn new(edge: Edge, anchor: Vec2) -> Self {
        let (frame, distance) = (EdgeFrame::nearest(&edge, anchor), edge.side(anchor));
        let mut local = Self { frame, distance, range: [0.0; 2] };
        let [low, high] = [edge.from, edge.to].map(|end| local.frame.place(end - anchor));
        let turn = local.turn();
        // places are known up to whole turns: the one of the end nearer to Q keeps its digits
        local.range = if high - low >= edge.length() - 0.5 * turn || !edge.is_arc() {
            [low, high]
        } else if high.abs() < low.abs() {
            [low - turn, high]
        } else {
            [low, high + turn]
        };
        local
    }

    /// The halves of a round hole's rim before and behind Q, with the hole on their left; nothing
    /// of a polygon.
    #[must_use]
    pub fn halves(hole: &Hole, anchor: Vec2) -> Vec<Self> {
        let local = hole.at(anchor);
        let (Hole::Circle { radius, .. }, LocalRim::Circle { d, excess }) = (hole, local.rim())
        else {
            return Vec::new();
        };
        let far = d.length();
        let outward = if far > 0.0 { *d / far } else { vec2(1.0, 0.0) };
        let distance = -excess / (far + radius);
        let (foot, tangent) = (outward * distance, outward.left());
        let frame = EdgeFrame { foot, tangent, curvature: 1.0 / radius };
        let half = |range| Self { frame, distance, range };
        vec![half([-PI * radius, 0.0]), half([0.0, PI * radius])]
    }

    /// The parts of a rim that have a length, each in a box; both halves of a circle in its own.
    pub(crate) fn rim(hole: &Hole, anchor: Vec2) -> impl Iterator<Item = (Rect, Self)> + '_ {
        let halves = Self::halves(hole, anchor).into_iter().map(|half| (hole.bounds(), half));
        let edges = hole.edges().filter(|edge| edge.chord().length() > 0.0);
        halves.chain(edges.map(move |edge| (edge.bounds(), Self::new(edge, anchor))))
    }

    /// The length of the whole circle; infinite of a segment.
    fn turn(&self) -> f64 {
        TAU / self.frame.curvature.abs()
    }

    /// The place of the edge that is nearest to an offset's point.
    #[must_use]
    pub fn closest(&self, offset: Vec2) -> f64 {
        let (place, [low, high]) = (self.frame.place(offset), self.range);
        if self.frame.curvature == 0.0 {
            return place.clamp(low, high);
        }
        let turned = [place, place - self.turn(), place + self.turn()];
        let far = |s: f64| (self.frame.at(s) - offset).length();
        let nearer = if far(low) <= far(high) { low } else { high };
        turned.into_iter().find(|s| low <= *s && *s <= high).unwrap_or(nearer)
    }

    /// Distance of an offset's point from the line or circle, positive on its left.
    #[must_use]
    pub fn side(&self, offset: Vec2) -> f64 {
        if self.frame.curvature == 0.0 {
            return self.distance + self.frame.tangent.cross(offset);
        }
        self.frame.side(offset)
    }

    /// The part between two places as an edge of offsets from the anchor.
    #[must_use]
    pub fn part(&self, [low, high]: [f64; 2]) -> Edge {
        let bulge = (0.25 * self.frame.curvature * (high - low)).tan();
        Edge { from: self.frame.at(low), to: self.frame.at(high), bulge }
    }

    /// The places of the edge among a range of places on the line or circle, turned by whole turns.
    #[must_use]
    pub fn common(&self, [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
        let turns = if self.frame.curvature == 0.0 { vec![0.0] } else { vec![-1.0, 0.0, 1.0] };
        let moved = |k: f64| {
            let by = if k == 0.0 { 0.0 } else { k * self.turn() };
            [(low + by).max(self.range[0]), (high + by).min(self.range[1])]
        };
        turns.into_iter().map(moved).filter(|[low, high]| low < high).collect()
    }

    /// The parts that may come nearer to the anchor than a reach: all that do, and some more.
    #[must_use]
    pub fn near(&self, reach: f64) -> Vec<[f64; 2]> {
        if self.distance.abs() > reach {
            return Vec::new();
        }
        let half = 0.5 * self.frame.curvature.abs() * reach;
        if half >= 1.0 {
            return vec![self.range];
        }
        let most = if half > 0.0 { reach * half.asin() / half } else { reach };
        self.common([-most, most])
    }

    /// The parts in an open box of offsets.
    #[must_use]
    pub fn within(&self, rect: &Rect) -> Vec<[f64; 2]> {
        let reach = rect.corners().iter().fold(0.0, |a: f64, p| a.max(p.length()));
        // a chord of the part that is near to the corners is twice as long at most
        let near = self.near(2.0 * reach);
        let inside = |[low, high]: [f64; 2]| {
            let parts = self.part([low, high]).within(rect);
            let place = move |part: f64| low + (high - low) * part;
            parts.into_iter().map(move |ends| ends.map(place))
        };
        near.into_iter().flat_map(inside).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    fn random_arc(random: &mut Random) -> Edge {
        let mut end = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        let (from, to) = (end(), end());
        Edge { from, to, bulge: random.between(-4.0, 4.0) }
    }

    /// Places, points, tangents and sides are those of the edge, from any anchor and for arcs of up
    /// to 340°, straight edges among them.
    #[test]
    fn places_are_those_of_the_edge() {
        let mut random = Random(7);
        for k in 0..400 {
            let mut edge = random_arc(&mut random);
            edge.bulge *= f64::from(u8::from(k % 5 > 0));
            let anchor = vec2(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
            let (local, size) = (AnchoredEdge::new(edge, anchor), edge.length().max(1.0));
            let [low, high] = local.range;
            assert!((high - low - edge.length()).abs() < 1e-12 * size, "{edge:?} {anchor:?}");
            for t in [0.0, 0.1, 0.4, 0.7, 1.0] {
                let s = low + (high - low) * t;
                let far = (local.frame.at(s) + anchor - edge.at(t)).length();
                assert!(far < 1e-12 * size, "{edge:?} {anchor:?} {t} {far}");
                assert!((local.frame.tangent_at(s) - edge.tangent(t)).length() < 1e-11, "{edge:?}");
            }
            let p = vec2(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
            assert!((local.side(p - anchor) - edge.side(p)).abs() < 1e-11 * size, "{edge:?} {p:?}");
            let closest = (local.frame.at(local.closest(p - anchor)) + anchor - p).length();
            assert!((closest - edge.distance(p)).abs() < 1e-11 * size, "{edge:?} {p:?}");
        }
    }

    /// Parts in a box are those of the edge, also where the anchor lies in the gap of a long arc.
    #[test]
    fn parts_in_boxes_are_those_of_the_edge() {
        let mut random = Random(8);
        for _ in 0..300 {
            let edge = random_arc(&mut random);
            let middle = edge.from + (edge.to - edge.from) * random.between(0.0, 1.0);
            let half = vec2(random.between(0.01, 1.0), random.between(0.01, 1.0));
            let rect = Rect::around(Vec2::ZERO, half);
            let lengths = |parts: Vec<[f64; 2]>, all: f64| {
                parts.iter().map(|[low, high]| high - low).sum::<f64>() * all
            };
            let local = lengths(AnchoredEdge::new(edge, middle).within(&rect), 1.0);
            let known = lengths(edge.within(&Rect::around(middle, half)), edge.length());
            assert!((local - known).abs() < 1e-11 * (1.0 + known), "{edge:?} {local} {known}");
        }
    }

    /// Beside an end and a middle of an arc points at 10⁻¹² have all their digits: distances to the
    /// anchor are those of the parabola that the arc is there.
    #[test]
    fn a_deep_view_has_no_noise() {
        let edge = Edge { from: vec2(0.3, -0.7), to: vec2(0.9, 0.4), bulge: 0.45 };
        let local = AnchoredEdge::new(edge, edge.from);
        assert!(local.distance.abs() < 1e-30 && local.range[0].abs() < 1e-30);
        let tangent = edge.end_tangents()[0];
        for s in [1e-15, 3e-14, 1e-12] {
            let parabola = tangent * s + tangent.left() * (0.5 * edge.curvature() * s * s);
            assert!((local.frame.at(s) - parabola).length() < 1e-14 * s, "{s}");
        }
        let middle = AnchoredEdge::new(edge, edge.middle());
        let bend = middle.frame.at(1e-6) + middle.frame.at(-1e-6) - middle.frame.at(0.0) * 2.0;
        assert!((bend.length() / (edge.curvature() * 1e-12) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_round_rim_has_the_hole_on_its_left() {
        let (center, radius) = (vec2(0.2, 0.1), 0.7);
        let halves = AnchoredEdge::halves(&Hole::Circle { center, radius }, vec2(1.0, 1.0));
        for s in [-1.0, 0.0, 2.0] {
            let at = halves[usize::from(s > 0.0)].frame.at(s) + vec2(1.0, 1.0);
            assert!(((at - center).length() - radius).abs() < 1e-15);
        }
        for half in &halves {
            let inner = center + vec2(0.2, 0.1) - vec2(1.0, 1.0);
            assert!((half.side(inner) - (radius - vec2(0.2, 0.1).length())).abs() < 1e-15);
        }
        assert!(
            (halves[0].frame.at(halves[0].range[0]) - halves[1].frame.at(halves[1].range[1]))
                .length()
                < 1e-15
        );
    }
}
