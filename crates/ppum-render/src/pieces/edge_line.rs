//! Edges of cracks and rims: the lines that stand for them in a square.
//!
//! A segment of a polyline cuts by its whole line. Chords of an arc would cut slivers off each
//! other that are no thicker than they are from the arc; so each cuts only between the normals at
//! its ends, and so do the segments of cracks with arcs.

use std::f64::consts::{PI, TAU};

use ppum::edge::{Edge, EdgeFrame};
use ppum::vec2::{Rect, Vec2, vec2};

use super::contains;
use super::cut::{AnchoredPolygon, PolygonCut, SAGITTA};
use crate::anchored_edge::AnchoredEdge;

/// Fewest lines that stand for a whole circle.
const LEAST: f64 = 12.0;

/// Largest distance of a line from an arc that is no part of a round hole, in parts of the square's
/// side.
const OF_ARC: f64 = 3e-4;

/// An edge that cuts squares: a segment by its own line, an arc by chords or tangents of its parts.
#[derive(Debug)]
pub(super) struct EdgeLine {
    edge: AnchoredEdge,
    /// The side of a rim on which the body is, +1 on its left and −1 on its right; 0 of a crack.
    body: f64,
    /// True if lines end where their parts do.
    is_bounded: bool,
    /// True if the hole is the whole disc on the left.
    is_disc: bool,
}

/// A line that stands for a part of an edge in a square.
#[derive(Debug)]
pub(super) struct EdgeCut {
    line: PolygonCut,
    /// The normals at its ends, between which it cuts; none if it cuts everywhere.
    normals: Option<[PolygonCut; 2]>,
    /// True if between them the hole is on its left, or a sliver beside it.
    is_disc: bool,
}

impl EdgeLine {
    pub(super) fn of_crack(edge: Edge, is_curved: bool, anchor: Vec2) -> Self {
        let edge = AnchoredEdge::new(edge, anchor);
        Self { edge, body: 0.0, is_bounded: is_curved, is_disc: false }
    }

    pub(super) fn of_rim(edge: AnchoredEdge, body: f64, is_disc: bool) -> Self {
        Self { edge, body, is_bounded: edge.frame.curvature != 0.0, is_disc }
    }

    pub(super) fn is_arc(&self) -> bool {
        self.edge.frame.curvature != 0.0
    }

    /// The cuts in a square. They depend on its size, not on its place.
    pub(super) fn cuts(&self, square: &Rect) -> Vec<EdgeCut> {
        let cuts = self.parts(square).into_iter().map(|part| self.cut(part));
        // what an arc meets its line may miss
        let reach = if self.edge.frame.curvature == 0.0 { 0.0 } else { self.sagitta(square) };
        let near = Rect::new(square.min - vec2(reach, reach), square.max + vec2(reach, reach));
        cuts.filter(|cut| cut.line.meets(&near)).collect()
    }

    /// Largest distance of a line from its arc in a square.
    fn sagitta(&self, square: &Rect) -> f64 {
        let (part, size) = (if self.is_disc { SAGITTA } else { OF_ARC }, square.size());
        part * size.x.max(size.y)
    }

    /// The parts that lines stand for, beside a square.
    fn parts(&self, square: &Rect) -> Vec<[f64; 2]> {
        let kappa = self.edge.frame.curvature.abs();
        if kappa == 0.0 {
            return vec![self.edge.range];
        }
        // a chord of a turn ψ is r (1 − cos ψ/2) ≈ r ψ²/8 away from the arc
        let turn = (8.0 * self.sagitta(square) * kappa).sqrt().min(TAU / LEAST);
        let step = turn / kappa;
        let parts = self.near(square).into_iter().flat_map(|[low, high]| {
            let steps = (low / step).floor() as i64..(high / step).ceil() as i64;
            steps.map(move |k| [k as f64 * step, (k + 1) as f64 * step])
        });
        let [first, last] = self.edge.range;
        let parts = parts.map(|[low, high]| [low.max(first), high.min(last)]);
        parts.filter(|[low, high]| low < high).collect()
    }

    /// The places beside a square: between those of its corners, or all if the centre of the circle
    /// lies in it.
    fn near(&self, square: &Rect) -> Vec<[f64; 2]> {
        let (corners, curvature) = (square.corners(), self.edge.frame.curvature);
        let center = self.edge.frame.foot + self.edge.frame.tangent.left() / curvature;
        if contains(&corners, center) {
            return vec![self.edge.range];
        }
        let angles = corners.map(|corner| curvature * self.edge.frame.place(corner));
        let [low, high] = turns(&angles).map(|turn| (angles[0] + turn) / curvature);
        self.edge.common([low.min(high), low.max(high)])
    }

    /// The cut of a part: along the chord of a crack's, along a line that does not leave the body
    /// of a rim's, which is a tangent where the body is outside of the circle.
    fn cut(&self, [low, high]: [f64; 2]) -> EdgeCut {
        let EdgeFrame { tangent, curvature, .. } = self.edge.frame;
        let normal = |s: f64| {
            PolygonCut::through(self.edge.frame.at(s), self.edge.frame.tangent_at(s).left())
        };
        let normals = self.is_bounded.then(|| [low, high].map(normal));
        if curvature == 0.0 {
            let line = PolygonCut::along(tangent, self.edge.distance, [low, high]);
            return EdgeCut { line, normals, is_disc: false };
        }
        // half of the part's turn, and the height of the arc over its chord
        let (turn, middle) = (0.5 * curvature * (high - low), 0.5 * (low + high));
        let (tangent, sagitta) =
            (self.edge.frame.tangent_at(middle), turn.sin() * (0.5 * turn).tan() / curvature);
        let is_tangent = self.body * curvature < 0.0;
        let shift = if is_tangent { 0.0 } else { sagitta };
        let reach = (if is_tangent { turn.tan() } else { turn.sin() }) / curvature;
        let at = self.edge.frame.at(middle) + tangent.left() * shift;
        let along = tangent.dot(at);
        let line = PolygonCut::along(tangent, -tangent.cross(at), [along - reach, along + reach]);
        // tangents of round holes do not leave the body
        let line = line.with_sagitta(if self.is_disc { 0.0 } else { sagitta.abs() });
        EdgeCut { line, normals, is_disc: self.is_disc }
    }
}

/// The range of the turns, each by half a circle at most, that lead from the first of some angles
/// to the others.
fn turns(angles: &[f64]) -> [f64; 2] {
    let turn = |angle: &f64| match angle - angles[0] {
        turn if turn > PI => turn - TAU,
        turn if turn < -PI => turn + TAU,
        turn => turn,
    };
    angles.iter().map(turn).fold([0.0f64; 2], |[a, b], turn| [a.min(turn), b.max(turn)])
}

impl EdgeCut {
    /// The parts of a polygon; those thinner than `least` are left out.
    pub(super) fn split(&self, polygon: AnchoredPolygon, least: f64) -> Vec<AnchoredPolygon> {
        let Some([first, last]) = &self.normals else {
            return polygon.split(&self.line, least).into_iter().flatten().collect();
        };
        let [ahead, before] = polygon.split(first, least);
        let [beyond, beside] = ahead.map_or([None, None], |ahead| ahead.split(last, least));
        let [right, left] = beside.map_or([None, None], |part| part.split(&self.line, least));
        let left = left.filter(|_| !self.is_disc);
        [before, beyond, right, left].into_iter().flatten().collect()
    }
}
