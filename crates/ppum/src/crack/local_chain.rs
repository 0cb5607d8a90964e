//! A crack with arcs seen from an anchor.
//!
//! A curve may be thousands of arcs, of which a point needs the nearest. So consecutive edges form
//! groups with a disc that holds each: a point passes over those farther from it than the nearest
//! centre of a disc, and the edges of a group are formed when the first point asks for them.

use super::local_edge::{LocalSegment, LocalVertex};
use super::{Crack, End};
use crate::vec2::Vec2;
use ppum_formula::real::Real;
use std::ops::Range;
use std::sync::OnceLock;

/// Edges of a group.
const GROUP: usize = 16;

/// Edges of a crack from which on it has more than one group.
const MANY: usize = 32;

/// Parts by which discs are larger than they need be, for what is rounded.
const MARGIN: f64 = 1e-2;

/// A crack with arcs seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct LocalChain<'c> {
    crack: &'c Crack,
    anchor: Vec2,
    /// The lines on which it goes on beyond its ends: its segments there, of arcs the tangents.
    pub(super) rays: [LocalSegment; 2],
    pub(super) groups: Vec<EdgeGroup>,
}

/// Consecutive edges of a crack with arcs.
#[derive(Clone, Debug)]
pub struct EdgeGroup {
    /// Their indices.
    pub edges: Range<usize>,
    /// A vertex of theirs minus the anchor.
    pub center: Vec2,
    /// The radius of a disc around it that holds them; infinite at the ends of the crack, beyond
    /// which it goes on.
    pub radius: f64,
    formed: OnceLock<(Vec<LocalSegment>, Vec<LocalVertex>)>,
}

impl<'c> LocalChain<'c> {
    pub(super) fn new(crack: &'c Crack, anchor: Vec2) -> Self {
        let rays = [End::Start, End::Last].map(|end| ray(crack, end, anchor));
        let count = crack.points.len() - 1;
        let inner = if count < MANY { 1..1 } else { 1..count - 1 };
        // the first and the last edge are looked at for every point
        let ends = if count < MANY { vec![count] } else { vec![count - 1, count] };
        let bounds: Vec<_> = std::iter::once(0).chain(inner.step_by(GROUP)).chain(ends).collect();
        let group = |pair: &[usize]| EdgeGroup::new(crack, pair[0]..pair[1], anchor);
        Self { crack, anchor, rays, groups: bounds.windows(2).map(group).collect() }
    }

    /// All edges, in order.
    pub(super) fn segments(&self) -> Vec<LocalSegment> {
        LocalSegment::all(self.crack, self.anchor)
    }

    /// All vertices, in order.
    pub(super) fn vertices(&self) -> Vec<LocalVertex> {
        (0..self.crack.points.len()).map(|k| self.vertex(k)).collect()
    }

    fn vertex(&self, k: usize) -> LocalVertex {
        let last = self.crack.points.len() - 1;
        let [before, after] =
            [k.max(1) - 1, k.min(last - 1)].map(|edge| self.crack.edge(edge).end_tangents());
        let tangents = [before[usize::from(k > 0)], after[usize::from(k == last)]];
        LocalVertex { at: self.crack.points[k] - self.anchor, tangents }
    }

    /// Returns the distance from the line or circle of the nearest edge, or the larger one from the
    /// tangents at a vertex. An arc is the nearest within the angle between the normals at its
    /// ends; elsewhere one of its vertices is, or the tangent beyond an end of the crack.
    #[inline(always)]
    pub(super) fn nearest_distance<R: Real>(&self, offset: [R; 2]) -> R {
        let far = offset[0].broadcast(f64::INFINITY);
        let (mut best, reach, mut g) = ([far.broadcast(0.0), far], self.reach(offset), 0);
        while g < self.groups.len() {
            let group = &self.groups[g];
            let limit = reach + reach.broadcast(group.radius);
            if R::any((limit * limit).ge(group.square(offset))) {
                let (segments, vertices) = group.formed.get().unwrap_or_else(|| self.form(group));
                let mut k = 0;
                while k < segments.len() {
                    let ends = [&vertices[k], &vertices[k + 1]];
                    best = self.nearer((group.edges.start + k, &segments[k]), ends, offset, best);
                    k += 1;
                }
            }
            g += 1;
        }
        best[0]
    }

    /// A distance within which the crack comes.
    #[inline(always)]
    fn reach<R: Real>(&self, offset: [R; 2]) -> R {
        let (mut least, mut g) = (offset[0].broadcast(f64::INFINITY), 0);
        while g < self.groups.len() {
            least = least.min(self.groups[g].square(offset));
            g += 1;
        }
        least.sqrt() * least.broadcast(1.0 + MARGIN)
    }

    #[cold]
    fn form<'g>(&self, group: &'g EdgeGroup) -> &'g (Vec<LocalSegment>, Vec<LocalVertex>) {
        group.formed.get_or_init(|| {
            let edges = group.edges.clone();
            let segment = |k| LocalSegment::new(self.crack.edge(k), self.anchor);
            let vertices = (edges.start..=edges.end).map(|k| self.vertex(k)).collect();
            (edges.map(segment).collect(), vertices)
        })
    }

    /// Takes an edge's distance, and the square of the way to the edge, where it is nearer.
    #[inline(always)]
    fn nearer<R: Real>(
        &self,
        (k, edge): (usize, &LocalSegment),
        [start, end]: [&LocalVertex; 2],
        offset: [R; 2],
        [nearest, least]: [R; 2],
    ) -> [R; 2] {
        let (is_first, is_last) = (k == 0, k + 2 == self.crack.points.len());
        let (zero, far) = (least.broadcast(0.0), least.broadcast(f64::INFINITY));
        let (after, _, mut before) = start.seen(offset, 1);
        let (beyond, _, mut behind) = end.seen(offset, 0);
        let rays = [self.rays[0].distance_of(offset), self.rays[1].distance_of(offset)];
        if is_first {
            before = R::select(zero.gt(after), rays[0] * rays[0], far);
        }
        if is_last {
            behind = R::select(beyond.gt(zero), rays[1] * rays[1], far);
        }
        let own = edge.curved_distance_of(offset);
        let depth = if edge.is_major { after.max(-beyond) } else { after.min(-beyond) };
        let is_beside = depth.ge(zero);
        let square = R::select(is_beside, own * own, before.min(behind));
        let is_nearer = least.gt(square);
        if !R::any(is_nearer) {
            return [nearest, least];
        }
        let start = if is_first { rays[0] } else { start.larger(offset) };
        let end = if is_last { rays[1] } else { end.larger(offset) };
        let decides = R::select(is_beside, own, R::select(before.gt(behind), end, start));
        [R::select(is_nearer, decides, nearest), least.min(square)]
    }
}

impl EdgeGroup {
    fn new(crack: &Crack, edges: Range<usize>, anchor: Vec2) -> Self {
        let middle = crack.points[(edges.start + edges.end) / 2];
        // the sum of magnitudes is longer than the vector, and takes no root
        let length = |way: Vec2| way.x.abs() + way.y.abs();
        let reach = |k: usize| {
            let edge = crack.edge(k);
            length(edge.from - middle) + length(edge.chord()) * edge.bulge.abs().max(1.0)
        };
        let is_at_end = edges.start == 0 || edges.end + 1 == crack.points.len();
        let least = if is_at_end { f64::INFINITY } else { 0.0 };
        let radius = edges.clone().map(reach).fold(least, f64::max) * (1.0 + MARGIN);
        Self { edges, center: middle - anchor, radius, formed: OnceLock::new() }
    }

    /// The square of the distance of a point from the centre.
    #[inline(always)]
    fn square<R: Real>(&self, [x, y]: [R; 2]) -> R {
        let (dx, dy) = (x - x.broadcast(self.center.x), y - y.broadcast(self.center.y));
        dx.mul_add(dx, dy * dy)
    }
}

/// The line of the edge at an end, or its tangent there.
fn ray(crack: &Crack, end: End, anchor: Vec2) -> LocalSegment {
    let (k, direction) = match end {
        End::Start => (0, -1.0),
        End::Last => (crack.points.len() - 2, 1.0),
    };
    let edge = crack.edge(k);
    if edge.is_arc() {
        let tangent = crack.growth_direction(end) * direction;
        return LocalSegment::at_tip(crack.end_point(end), tangent, anchor);
    }
    LocalSegment::new(edge, anchor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arc_spline::arc_spline;
    use crate::vec2::vec2;
    use ppum_formula::real::{LaneJob, LaneNumber};
    use ppum_testkit::random::Random;
    use std::f64::consts::TAU;

    /// A curve with random waves; its arcs are some hundreds to some thousands.
    fn random_curve(random: &mut Random) -> Crack {
        let waves: Vec<_> = (1..6)
            .map(|n| (f64::from(n), random.between(-0.4, 0.4), random.between(0.0, TAU)))
            .collect();
        let curve = |t: f64| {
            let height = waves.iter().map(|(n, a, phase)| a / n * (n * t + phase).sin());
            let slope = waves.iter().map(|(n, a, phase)| a * (n * t + phase).cos());
            [vec2(t, height.sum()), vec2(1.0, slope.sum()).unit()]
        };
        let range = [random.between(-3.0, -1.0), random.between(1.0, 3.0)];
        let tolerance = random.pick(&[1e-7, 1e-8, 1e-9]);
        Crack::along(&arc_spline(curve, range, tolerance, 10_000).expect("a smooth curve"))
    }

    fn direction(random: &mut Random) -> Vec2 {
        let angle = random.between(0.0, TAU);
        vec2(angle.cos(), angle.sin())
    }

    /// Distances from a chain in lanes.
    struct Distances<'a>(&'a LocalChain<'a>, &'a [[f64; 2]]);

    impl<T: LaneNumber> LaneJob<T> for Distances<'_> {
        type Output = Vec<u64>;

        #[inline(always)]
        fn run<R: Real<Scalar = T>>(self, zero: R) -> Vec<u64> {
            let Self(chain, offsets) = self;
            let mut bits = Vec::new();
            for points in offsets.chunks_exact(R::LANES) {
                let offset = [0, 1].map(|axis| zero.with_lanes(|lane| points[lane][axis]));
                let found = chain.nearest_distance(offset).lanes();
                bits.extend(found[..R::LANES].iter().map(|distance| distance.to_bits()));
            }
            bits
        }
    }

    /// From anchors on a curve, beside it and far away, for points from 10⁻¹² of it to far beyond
    /// its ends, close together and not.
    #[test]
    fn groups_take_no_bit_from_distances() {
        let mut random = Random(77);
        let (mut formed, mut all) = (0, 0);
        for _ in 0..8 {
            let crack = random_curve(&mut random);
            let count = crack.points.len() - 1;
            assert!(count > MANY);
            for _ in 0..24 {
                let on = crack.edge(random.below(count)).at(random.pick(&[0.0, 0.4]));
                let beside = direction(&mut random) * random.pick(&[0.0, 1e-9, 0.1, 5.0]);
                let (anchor, size) = (on + beside, random.pick(&[1e-12, 1e-3, 0.1, 1.0, 9.0]));
                let middle = direction(&mut random) * random.pick(&[0.0, size]);
                let near = random.pick(&[1.0, 0.01]) * size;
                let mut place = || (middle + direction(&mut random) * near).into();
                let offsets: Vec<[f64; 2]> = (0..64).map(|_| place()).collect();
                let chain = LocalChain::new(&crack, anchor);
                let whole = LocalChain {
                    groups: vec![EdgeGroup::new(&crack, 0..count, anchor)],
                    ..chain.clone()
                };
                let [own, full] = [&chain, &whole].map(|c| f64::dispatch(Distances(c, &offsets)));
                assert_eq!(own, full, "{anchor:?} {size}");
                let [own, full] = [&chain, &whole].map(|c| f32::dispatch(Distances(c, &offsets)));
                assert_eq!(own, full, "{anchor:?} {size} in single precision");
                let [own, full] = [&chain, &whole].map(|c| {
                    offsets.iter().map(|&p| c.nearest_distance(p).to_bits()).collect::<Vec<_>>()
                });
                assert_eq!(own, full, "{anchor:?} {size} one by one");
                let is_formed = |group: &&EdgeGroup| group.formed.get().is_some();
                formed += chain.groups.iter().filter(is_formed).count();
                all += chain.groups.len();
            }
        }
        assert!(formed < all / 4, "{formed} of {all}");
    }
}
