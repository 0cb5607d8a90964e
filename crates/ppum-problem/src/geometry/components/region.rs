//! Parts of a box, and the pieces of cracks in them.

use ppum::crack::SegmentId;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::line::Line;
use ppum::segment::Segment;
use ppum::vec2::{Rect, Vec2};

use super::curve::CutCurve;
use crate::geometry::clipped;

/// A piece of an edge, and the line or circle of the whole edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct SegmentPiece {
    pub(super) id: SegmentId,
    pub(super) curve: CutCurve,
    pub(super) edge: Edge,
}

impl SegmentPiece {
    /// The parts of an edge in a box that are longer than rounding.
    pub(super) fn inside(
        id: SegmentId,
        whole: Edge,
        open: &Rect,
        thinnest: f64,
    ) -> impl Iterator<Item = Self> {
        let pieces = clipped(whole, open).into_iter().map(move |range| whole.part(range));
        let piece = move |edge| Self { id, curve: CutCurve::new(whole, edge), edge };
        pieces.map(piece).filter(move |piece| piece.edge.length() > thinnest)
    }

    /// Returns the parts on the left, which come with `true`, and on the right of a curve; one that
    /// lies on it has none.
    pub(super) fn split(&self, curve: &CutCurve, thinnest: f64) -> [Option<(bool, Self)>; 3] {
        let part = |edge: Edge| {
            let d = farthest(&edge, curve);
            (d.abs() > thinnest).then_some((d > 0.0, Self { edge, ..*self }))
        };
        if curve.is_arc() || self.edge.is_arc() {
            let mut parts = [None; 3];
            let pieces = broken(self.edge, curve, thinnest, &|_| None);
            parts.iter_mut().zip(pieces).for_each(|(found, edge)| *found = part(edge));
            return parts;
        }
        let (a, b) = (self.edge.from, self.edge.to);
        let (da, db) = (curve.side(a), curve.side(b));
        let on = |d: f64| d.abs() <= thinnest;
        if !on(da) && !on(db) && (da > 0.0) != (db > 0.0) {
            let middle = a + (b - a) * (da / (da - db));
            let piece = |ends| Self { edge: Edge::segment(ends), ..*self };
            let [first, second] = [piece([a, middle]), piece([middle, b])];
            return [Some((da > 0.0, first)), Some((db > 0.0, second)), None];
        }
        let whole = (!on(da) || !on(db)).then_some((da.max(db) > thinnest, *self));
        [whole, None, None]
    }

    /// True if a curve divides it.
    pub(super) fn is_split_by(&self, curve: &CutCurve, thinnest: f64) -> bool {
        let parts = self.split(curve, thinnest);
        let has = |side: bool| parts.iter().flatten().any(|(is_left, _)| *is_left == side);
        has(true) && has(false)
    }
}

/// The distance of an edge's ends or middle from a curve, of that which is the farthest.
fn farthest(edge: &Edge, curve: &CutCurve) -> f64 {
    let distances = [edge.from, edge.middle(), edge.to].map(|p| curve.side(p));
    distances.into_iter().fold(0.0, |far: f64, d| if d.abs() > far.abs() { d } else { far })
}

/// The parts of an edge between the points in which it meets a curve, one of them an arc. Points
/// are moved to a known one near them.
fn broken(
    edge: Edge,
    curve: &CutCurve,
    thinnest: f64,
    known: &dyn Fn(Vec2) -> Option<Vec2>,
) -> Vec<Edge> {
    let least = thinnest / edge.length();
    let met = edge.meets_curve(&curve.edge).into_iter();
    let mut breaks: Vec<(f64, Vec2)> = met
        .filter(|part| *part > least && *part < 1.0 - least)
        .map(|part| (part, known(edge.at(part)).unwrap_or(edge.at(part))))
        .collect();
    breaks.insert(0, (0.0, edge.from));
    breaks.push((1.0, edge.to));
    let part = |pair: &[(f64, Vec2)]| {
        let [(low, from), (high, to)] = [pair[0], pair[1]];
        Edge { from, to, bulge: edge.part([low, high]).bulge }
    };
    breaks.windows(2).map(part).collect()
}

/// A side of a region, which lies on its left, and the cut that made it; none on the boundary of
/// the box.
type RegionSide = (Edge, Option<usize>);

/// A part of a box: its boundary, counter-clockwise. It is convex if no arcs cut it.
#[derive(Clone, Debug)]
pub(super) struct Region(Vec<RegionSide>);

/// A side of a region, or a part of it, on the left (`true`) or on the right of a curve.
type DividedSide = (RegionSide, bool);

impl Region {
    pub(super) fn of_box(open: &Rect) -> Self {
        Self(open.sides().map(|ends| (Edge::segment(ends), None)).to_vec())
    }

    /// True if the curve of a piece leaves something on both of its sides.
    pub(super) fn is_split_by(&self, piece: &SegmentPiece, thinnest: f64) -> bool {
        let curve = &piece.curve;
        let straight = !curve.is_arc() && !self.0.iter().any(|(side, _)| side.is_arc());
        let distances: Vec<f64> = match straight {
            true => self.0.iter().map(|(side, _)| curve.side(side.from)).collect(),
            false => {
                let parts = self.0.iter().flat_map(|(side, _)| {
                    let curved = curve.is_arc() || side.is_arc();
                    if curved { broken(*side, curve, thinnest, &|_| None) } else { vec![*side] }
                });
                parts.map(|part| farthest(&part, curve)).collect()
            }
        };
        let [left, right] = [1.0, -1.0].map(|sign| distances.iter().any(|d| sign * d > thinnest));
        (left && right) || self.surrounds(piece, thinnest)
    }

    /// True if the whole circle of a piece lies in the region.
    fn surrounds(&self, piece: &SegmentPiece, thinnest: f64) -> bool {
        let curve = &piece.curve;
        let is_apart = |side: &Edge| {
            broken(*side, curve, thinnest, &|_| None).len() == 1
                && farthest(side, curve) * curve.edge.bulge < 0.0
                && side.gap(&piece.edge) > thinnest
        };
        curve.is_arc() && self.0.iter().all(|(side, _)| is_apart(side))
    }

    /// The parts on the left and on the right of the curve of a piece.
    ///
    /// A side that the piece ends on is divided there: the crossing of lines at a small angle is
    /// lost in rounding, and cracks that meet at a point would leave a way between them.
    pub(super) fn split(&self, piece: &SegmentPiece, cut: usize, thinnest: f64) -> [Self; 2] {
        let surrounds = self.surrounds(piece, thinnest);
        let divided: Vec<DividedSide> =
            self.0.iter().flat_map(|side| divide(*side, piece, thinnest)).collect();
        [(piece.curve, true), (piece.curve.reversed(), false)].map(|(curve, is_left)| {
            let own = divided.iter().filter(|(_, side)| *side == is_left).map(|(side, _)| *side);
            let mut region = closed(&own.collect::<Vec<_>>(), &curve, cut, thinnest);
            if surrounds {
                region.extend(curve.whole().map(|edge| (edge, Some(cut))));
            }
            Self(region)
        })
    }

    /// The cuts along which a piece runs on the boundary of the region.
    pub(super) fn cuts_along(
        &self,
        piece: &SegmentPiece,
        thinnest: f64,
    ) -> impl Iterator<Item = usize> + '_ {
        let piece = *piece;
        let is_near = move |curve: &CutCurve, edge: &Edge| {
            let points = [edge.from, edge.middle(), edge.to];
            points.iter().all(|p| curve.side(*p).abs() <= 2.0 * thinnest)
        };
        let runs = move |side: &Edge| {
            is_near(&CutCurve::new(*side, *side), &piece.edge) || is_near(&piece.curve, side)
        };
        self.0.iter().filter_map(move |(side, cut)| cut.filter(|_| runs(side)))
    }

    /// The sides along cuts.
    pub(super) fn sides(&self) -> impl Iterator<Item = (usize, Edge)> + '_ {
        self.0.iter().filter_map(|(side, cut)| cut.map(|cut| (cut, *side)))
    }

    /// The part in a box.
    pub(super) fn within(&self, part: &Rect, thinnest: f64) -> Self {
        part.sides().into_iter().fold(self.clone(), |region, ends| {
            let (edge, id) = (Edge::segment(ends), SegmentId { crack: 0, segment: 0 });
            let side = SegmentPiece { id, curve: CutCurve::new(edge, edge), edge };
            let [inside, _] = region.split(&side, 0, thinnest);
            inside
        })
    }

    /// The mean of the corners.
    fn center(&self) -> Vec2 {
        let sum = self.0.iter().fold(Vec2::ZERO, |sum, (side, _)| sum + side.from);
        sum * (1.0 / self.0.len() as f64)
    }

    /// The area, about, of what holes leave.
    pub(super) fn area(&self, holes: &[&Hole]) -> f64 {
        let center = self.center();
        let beside =
            |edge: &Edge| edge.area_from(center) * solid_part([center, edge.from, edge.to], holes);
        self.0.iter().map(|(side, _)| beside(side)).sum()
    }
}

/// The parts of a side on the left and on the right of the curve of a piece. A side along the curve
/// is on the left where it has the same direction.
fn divide(
    (side, tag): RegionSide,
    piece: &SegmentPiece,
    thinnest: f64,
) -> impl Iterator<Item = DividedSide> {
    let curve = piece.curve;
    let parts = if side.is_arc() || curve.is_arc() {
        let known = |p: Vec2| {
            let is_at = |end: &Vec2| (*end - p).length() <= 4.0 * thinnest;
            [piece.edge.from, piece.edge.to].into_iter().find(is_at)
        };
        broken(side, &curve, thinnest, &known)
    } else {
        let ends = straight_parts(&[side.from, side.to], piece, thinnest);
        ends.windows(2).map(|ends| Edge::segment([ends[0], ends[1]])).collect()
    };
    parts.into_iter().map(move |edge| {
        let d = farthest(&edge, &curve);
        ((edge, tag), if d.abs() <= thinnest { curve.is_along(&edge) } else { d > 0.0 })
    })
}

/// The ends of a segment, and between them the point in which it crosses the line of a piece.
fn straight_parts(&[p, next]: &Segment, piece: &SegmentPiece, thinnest: f64) -> Vec<Vec2> {
    let [d, dn] = [p, next].map(|p| piece.curve.side(p));
    if d.abs() <= thinnest || dn.abs() <= thinnest || d * dn > 0.0 {
        return vec![p, next];
    }
    let along = Line::through([p, next]).unit();
    let is_on = |end: &Vec2| {
        let length = 0.0..=(next - p).length();
        along.side(*end).abs() <= thinnest && length.contains(&along.foot(*end))
    };
    let crossing = || p + (next - p) * (d / (d - dn));
    let middle = [piece.edge.from, piece.edge.to].into_iter().find(is_on);
    vec![p, middle.unwrap_or_else(crossing), next]
}

/// The boundary of a region of which these sides are left: where they end on the curve, which has
/// the region on its left, the boundary goes on along it to the next side.
fn closed(own: &[RegionSide], curve: &CutCurve, cut: usize, thinnest: f64) -> Vec<RegionSide> {
    let starts = own.iter().map(|(side, _)| side.from);
    let is_start = |p: Vec2| !own.iter().any(|(side, _)| side.to == p);
    let starts: Vec<Vec2> = starts.filter(|p| is_start(*p)).collect();
    let mut all = Vec::with_capacity(own.len() + 2);
    for side in own {
        all.push(*side);
        let end = side.0.to;
        if own.iter().any(|(next, _)| next.from == end) {
            continue;
        }
        let ahead = |start: &&Vec2| curve.way(end, **start, thinnest);
        let next = starts.iter().min_by(|a, b| ahead(a).total_cmp(&ahead(b)));
        all.extend(next.map(|start| (curve.between(end, *start, thinnest), Some(cut))));
    }
    all
}

/// Places in each direction of a triangle that are looked at.
const LOOKS: u32 = 4;

/// The part of a triangle outside of holes, about.
fn solid_part([a, b, c]: [Vec2; 3], holes: &[&Hole]) -> f64 {
    if holes.is_empty() {
        return 1.0;
    }
    let at = |k: u32| (f64::from(k) + 1.0 / 3.0) / f64::from(LOOKS);
    let places = (0..LOOKS).flat_map(|i| (0..LOOKS - i).map(move |j| (at(i), at(j))));
    let solid = |&(s, t): &(f64, f64)| {
        let p = a + (b - a) * s + (c - a) * t;
        !holes.iter().any(|hole| hole.contains(p))
    };
    let all = places.clone().count();
    places.filter(solid).count() as f64 / all as f64
}
