//! Lines of the body in the deformed plane.

use ppum::border::{is_mirrored_side, touch};
use ppum::crack::{Crack, CrackEnd, Side};
use ppum::domain::{Hole, LocalDomain};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};

use super::DeformedView;
use super::map::DeformationMap;
use crate::anchored_edge::AnchoredEdge;

/// Largest distance of a path from the curve that it stands for \[pixels\].
const CHORD: f64 = 0.1;
/// Parts of a curve that are looked at, however straight it seems; fewer of one that is short in
/// the image.
const PARTS: usize = 16;
/// Least length of such a part in pixels.
const PART: f64 = 8.0;
/// Most halvings of a part; f64 has no more numbers beside those that are not small.
const HALVINGS: usize = 200;
/// Most points of a part: no curve that a screen shows has as many, but one that jumps
/// everywhere would.
const MOST: usize = 1 << 14;
/// Way from a border into the body, in parts of the body's size, that decides whether the border
/// belongs to it.
const INWARD: f64 = 1e-9;

/// Polylines, as offsets from the view's centre. They end where the body does and where it has
/// come apart.
pub type Paths = Vec<Vec<Vec2>>;

impl DeformedView<'_> {
    /// The images of polylines of offsets from the anchor, to a tenth of a pixel, one after the
    /// other; what is far outside the image is coarser. They are interrupted outside the body and
    /// where they cross a crack that has opened.
    #[must_use]
    pub fn paths(&self, polylines: &[impl AsRef<[Vec2]>]) -> Paths {
        let domain = self.field().domain.at(self.anchor);
        let mut map = DeformationMap::new(self.field(), self.anchor);
        let mut all = Vec::new();
        for points in polylines {
            let mut paths = JoinedPaths::new(self);
            for line in points.as_ref().windows(2) {
                let mut place =
                    |o: Vec2| domain.contains(o).then(|| map.place(self, o, Side::Above)).flatten();
                paths.add(self.line([line[0], line[1]], &mut place));
            }
            all.extend(paths.all);
        }
        all
    }

    /// The images of the faces of all cracks, above and below.
    #[must_use]
    pub fn faces(&self) -> Vec<[Paths; 2]> {
        let (mut map, domain) =
            (DeformationMap::new(self.field(), self.anchor), self.field().domain.at(self.anchor));
        let mut face = |crack: &Crack, side: Side| {
            let mut paths = JoinedPaths::new(self);
            let body = self.field().domain;
            let is_inside = |edge: &Edge| body.outer_side(*edge) != Some(side);
            let faces = FacePath::on_side(crack, side, self.anchor);
            for face in faces.filter(|face| is_inside(&face.edge)) {
                paths.add(self.edge(face.edge, &mut |o, left| {
                    let is_plate = domain.contains(o);
                    is_plate.then(|| map.place(self, face.beside(o, left), side)).flatten()
                }));
            }
            paths.all
        };
        let cracks = self.field().step.cracks.iter();
        cracks.map(|crack| [Side::Above, Side::Below].map(|side| face(crack, side))).collect()
    }

    /// The image of the body's border: of the box and of the rims of holes, where they bound the
    /// body, without the sides on lines x = a and y = b, at which it is mirrored; of a mesh of all
    /// edges of elements without a neighbour, or that have come apart from it by half a pixel.
    #[must_use]
    pub fn outline(&self, mirrors: [Option<f64>; 2]) -> Paths {
        if self.field().step.partition.mesh().is_some() {
            return self.element_borders();
        }
        let (mut border, bounds) = (BoundaryPath::new(self), &self.field().domain.bounds);
        let is_drawn = |edge: &Edge| {
            edge.is_arc() || !is_mirrored_side([edge.from, edge.to], mirrors, touch(bounds))
        };
        let sides = bounds.sides().into_iter().map(Edge::segment);
        let mut all = border.sides(sides.filter(is_drawn), 1.0);
        for hole in &self.field().domain.holes {
            all.extend(border.sides(hole.edges().filter(is_drawn), -hole.orientation()));
            all.extend(border.circle(hole));
        }
        all
    }

    /// The image of an edge, whose points have places that depend on their offset from the anchor
    /// and the unit normal to the left there.
    fn edge(&self, edge: Edge, place: &mut dyn FnMut(Vec2, Vec2) -> Option<Vec2>) -> Paths {
        if !edge.is_arc() {
            let left = edge.chord().unit().left();
            let ends = [edge.from, edge.to].map(|end| end - self.anchor);
            return self.line(ends, &mut |o| place(o, left));
        }
        self.arc(&AnchoredEdge::new(edge, self.anchor), place)
    }

    fn arc(&self, arc: &AnchoredEdge, place: &mut dyn FnMut(Vec2, Vec2) -> Option<Vec2>) -> Paths {
        let length = arc.range[1] - arc.range[0];
        let turn = length * arc.frame.curvature.abs();
        let mut at = |s: f64| place(arc.frame.at(s), arc.frame.tangent_at(s).left());
        let parts = self.parts(length).max(turn.ceil() as usize);
        self.trace(arc.range, parts, |a, b| 0.5 * (a + b), &mut at)
    }

    /// The number of parts of a curve of a length that are looked at.
    fn parts(&self, length: f64) -> usize {
        let parts = (length / (PART * self.view.pixel_size())).min(PARTS as f64) as usize;
        parts.max(1)
    }

    /// The image of a segment.
    fn line(&self, [a, b]: [Vec2; 2], place: &mut dyn FnMut(Vec2) -> Option<Vec2>) -> Paths {
        self.trace([a, b], self.parts((b - a).length()), |a: Vec2, b: Vec2| (a + b) * 0.5, place)
    }

    /// The image of a curve between two parameters that can be halved, in so many parts at least.
    pub(super) fn trace<P: Copy + PartialEq>(
        &self,
        ends: [P; 2],
        least: usize,
        half: impl Fn(P, P) -> P,
        place: &mut dyn FnMut(P) -> Option<Vec2>,
    ) -> Paths {
        let mut parts = vec![ends];
        while parts.len() < least {
            parts = parts.iter().flat_map(|&[a, b]| [[a, half(a, b)], [half(a, b), b]]).collect();
        }
        let mut paths = JoinedPaths::new(self);
        for ends in parts {
            let places = ends.map(&mut *place);
            let (mut stack, mut looked_at) = (vec![(ends, places, 0)], 0);
            while let Some(([a, b], [from, to], depth)) = stack.pop() {
                looked_at += 1;
                let middle = half(a, b);
                let at = place(middle);
                match (from, at, to) {
                    (None, None, None) => continue,
                    (Some(from), Some(at), Some(to)) if self.is_straight(from, at, to) => {
                        paths.add(vec![vec![from, at, to]]);
                        continue;
                    }
                    _ => {}
                }
                if depth < HALVINGS && looked_at < MOST && middle != a && middle != b {
                    stack.push(([middle, b], [at, to], depth + 1));
                    stack.push(([a, middle], [from, at], depth + 1));
                }
            }
        }
        paths.all
    }

    /// True if a piece of a curve needs no more points, or is not seen.
    fn is_straight(&self, from: Vec2, at: Vec2, to: Vec2) -> bool {
        let pixel = self.view.pixel_size();
        let size = (at - from).length() + (to - at).length();
        let bent = (at - (from + to) * 0.5).length();
        let hull = Rect::new(from.min(at).min(to), from.max(at).max(to));
        let reach = vec2(size, size);
        let around = Rect::new(hull.min - reach, hull.max + reach);
        let is_seen = around.overlaps(&Rect::new(-self.view.half() * 1.1, self.view.half() * 1.1));
        bent <= CHORD * pixel && size <= LONGEST * pixel || !is_seen
    }
}

/// One side of one edge of a crack.
struct FacePath {
    edge: Edge,
    /// The ends' offsets from the anchor.
    ends: [Vec2; 2],
    /// True for ends that are tips.
    tips: [bool; 2],
    /// +1 if the side is on the left.
    sign: f64,
}

impl FacePath {
    /// The faces of a side of a crack, in order.
    fn on_side(crack: &Crack, side: Side, anchor: Vec2) -> impl Iterator<Item = Self> {
        let sign = if side == Side::Above { 1.0 } else { -1.0 };
        let last = crack.points.len() - 2;
        crack.edges().enumerate().map(move |(k, edge)| {
            let is_tip = |end: usize| crack.ends[end] == CrackEnd::Tip;
            let tips = [k == 0 && is_tip(0), k == last && is_tip(1)];
            let ends = [edge.from - anchor, edge.to - anchor];
            Self { edge, ends, tips, sign }
        })
    }

    /// A point of the face, where the unit normal is `left`, moved off the crack by [`BESIDE`] of
    /// its distance to a tip, or of the chord's length.
    fn beside(&self, offset: Vec2, left: Vec2) -> Vec2 {
        let [a, b] = self.ends;
        let of_tip = |(end, is_tip): (Vec2, bool)| {
            if is_tip { (offset - end).length() } else { f64::INFINITY }
        };
        let distance =
            self.ends.into_iter().zip(self.tips).map(of_tip).fold((b - a).length(), f64::min);
        offset + left * (self.sign * BESIDE * distance)
    }
}

/// Enough for rounding not to choose the side, and nothing to be seen.
const BESIDE: f64 = 1e-9;

/// Longest part of a path in the image \[pixels\]: what bends within it would be seen.
const LONGEST: f64 = 40.0;

/// Paths that are joined where one begins at the end of the other.
struct JoinedPaths {
    all: Paths,
    same: f64,
}

impl JoinedPaths {
    fn new(view: &DeformedView<'_>) -> Self {
        Self { all: Vec::new(), same: CHORD * view.view.pixel_size() }
    }

    fn add(&mut self, paths: Paths) {
        for path in paths {
            match self.all.last_mut() {
                Some(last) if is_near(last, &path, self.same) => last.extend_from_slice(&path[1..]),
                _ => self.all.push(path),
            }
        }
    }
}

/// True if a path begins where another ends.
fn is_near(last: &[Vec2], next: &[Vec2], same: f64) -> bool {
    matches!((last.last(), next.first()), (Some(a), Some(b)) if (*a - *b).length() <= same)
}

/// The border of the body.
struct BoundaryPath<'a, 'f> {
    view: &'a DeformedView<'f>,
    map: DeformationMap<'f>,
    domain: LocalDomain,
    /// Way into the body.
    inward: f64,
}

impl<'a, 'f> BoundaryPath<'a, 'f> {
    fn new(view: &'a DeformedView<'f>) -> Self {
        let (field, size) = (view.field(), view.field().domain.bounds.size());
        let (map, domain) = (DeformationMap::new(field, view.anchor), field.domain.at(view.anchor));
        Self { view, map, domain, inward: INWARD * size.x.min(size.y) }
    }

    /// The image of a point of the border, if the body lies in a direction from it.
    fn place(&mut self, offset: Vec2, inward: Vec2) -> Option<Vec2> {
        let is_border = self.domain.contains(offset + inward * self.inward);
        is_border.then(|| self.map.place(self.view, offset, Side::Above)).flatten()
    }

    /// Some edges of the border; the body lies on the left of them, or on the right if `left`
    /// is −1.
    fn sides(&mut self, edges: impl Iterator<Item = Edge>, left: f64) -> Paths {
        let (view, mut paths) = (self.view, JoinedPaths::new(self.view));
        for edge in edges {
            paths.add(view.edge(edge, &mut |o, normal| self.place(o, normal * left)));
        }
        paths.all
    }

    /// The rim of a round hole, with the body on its right; nothing of a polygon.
    fn circle(&mut self, hole: &Hole) -> Paths {
        let (view, mut paths) = (self.view, JoinedPaths::new(self.view));
        for half in AnchoredEdge::halves(hole, view.anchor) {
            paths.add(view.arc(&half, &mut |o, normal| self.place(o, -normal)));
        }
        paths.all
    }
}
