//! Marching through one square, or its pieces.

use ppum::crack::Side;
use ppum::field::LocalField;
use ppum::jet::Jet;
use ppum::quantity::{QuantityGradient, Source, ValueWithGradient};
use ppum::segment::sides;
use ppum::vec2::Vec2;

use super::lattice::{Cell, SampleLattice};
use super::root::root;
use crate::pieces::{ConvexPiece, INSET, Pieces, contains};

/// Distance of chords from the curve up to which no point is put between, pixels.
pub const CHORD: f64 = 0.02;

/// Part of a gradient's size by which it changes between two points that are this near only by
/// a jump.
const SAME: f64 = 1e-6;

/// Corners nearer to each other than this part of a side are one.
const SAME_CORNER: f64 = 1e-7;

/// Most halvings of a chord.
const HALVINGS: usize = 4;

/// Most steps of a point onto the curve.
const PULLS: usize = 6;

/// A part of a line in one square or piece.
pub(super) struct LineSegment {
    /// Index of the level.
    pub(super) level: usize,
    /// Larger values are on the left.
    pub(super) points: Vec<Vec2>,
    /// Its beginning and its end.
    pub(super) ends: [SegmentEnd; 2],
}

/// An end of a segment, on a side of a square or piece.
#[derive(Clone, Copy)]
pub(super) struct SegmentEnd {
    /// The two ends of the side, in an order that does not depend on the square.
    pub(super) side: [Vec2; 2],
    /// True if no line goes on there.
    pub(super) is_final: bool,
    /// The square beyond.
    pub(super) neighbour: Option<Cell>,
}

/// Marches through squares.
pub(super) struct Marcher<'a, 'f> {
    slope: &'a QuantityGradient,
    local: LocalField<'f>,
    pixel: f64,
    lattice: &'a SampleLattice,
}

/// A square or a piece of it.
struct MarchingTile {
    cell: Cell,
    piece: ConvexPiece,
    /// True if nothing cuts the square.
    is_whole: bool,
    /// The values at the two ends of each side. Where something cuts the square the two of a corner
    /// may differ: it may be a tip, or lie on a face.
    values: Vec<[f64; 2]>,
}

/// A place on the way around a tile where it passes a level.
#[derive(Clone, Copy)]
enum TileCrossing {
    Corner(usize),
    Side(usize),
}

/// A place on a side where a level is passed.
#[derive(Clone, Copy)]
struct SideCrossing {
    at: Vec2,
    end: SegmentEnd,
    /// True if the quantity jumps there though the field does not.
    jumps: bool,
}

impl<'a, 'f> Marcher<'a, 'f> {
    pub(super) fn new(
        slope: &'a QuantityGradient,
        local: LocalField<'f>,
        pixel: f64,
        lattice: &'a SampleLattice,
    ) -> Self {
        Self { slope, local, pixel, lattice }
    }

    /// The parts of all lines in a square.
    pub(super) fn segments(
        &mut self,
        cell: Cell,
        levels: &[f64],
        cuts: &Pieces<'_>,
    ) -> Vec<LineSegment> {
        let rect = self.lattice.rect(cell);
        let is_whole = !cuts.may_cut(&rect);
        let pieces =
            if is_whole { vec![ConvexPiece::uncut(rect.corners(), 0.0)] } else { cuts.of(&rect) };
        let beside = self.beside(cell, cuts);
        let mut segments = Vec::new();
        for piece in pieces.into_iter().map(|piece| with_corners(piece, &beside)) {
            let mut tile = MarchingTile { cell, piece, is_whole, values: Vec::new() };
            tile.values = self.values(&tile);
            for (index, &level) in levels.iter().enumerate() {
                self.of_level(&tile, index, level, &mut segments);
            }
        }
        segments
    }

    /// The corners of pieces of the squares around: on the sides that they have in common lines
    /// must find the same.
    fn beside(&self, cell: Cell, cuts: &Pieces<'_>) -> Vec<Vec2> {
        let around = self.lattice.around(cell).map(|cell| self.lattice.rect(cell));
        let cut = around.filter(|rect| cuts.may_cut(rect));
        cut.flat_map(|rect| cuts.of(&rect)).flat_map(|piece| piece.corners).collect()
    }

    fn of_level(
        &mut self,
        tile: &MarchingTile,
        index: usize,
        level: f64,
        out: &mut Vec<LineSegment>,
    ) {
        let passes = tile.passes(level);
        if passes.is_empty() {
            return;
        }
        let crossings: Vec<_> =
            passes.iter().map(|&(pass, _)| self.crossing(tile, pass, level)).collect();
        let inner = passes.len() > 2 && self.value(tile.piece.center()) > level;
        for (k, &(_, is_above)) in passes.iter().enumerate() {
            let next = (k + 1) % passes.len();
            // what lies between two crossings is cut off, on the right of the way from the first to
            // the second
            let (from, to) = if is_above { (next, k) } else { (k, next) };
            let is_apart = if passes.len() > 2 { is_above != inner } else { k == 0 };
            if is_apart && !(crossings[from].jumps && crossings[to].jumps) {
                let [from, to] = [crossings[from], crossings[to]];
                let mut points = vec![from.at];
                self.pull(tile, level, [from.at, to.at], HALVINGS, &mut points);
                points.push(to.at);
                out.push(LineSegment { level: index, points, ends: [from.end, to.end] });
            }
        }
    }

    fn value(&mut self, at: Vec2) -> f64 {
        self.slope.quantity().at(&mut self.local, at, Side::Above)
    }

    fn slope(&mut self, at: Vec2) -> ValueWithGradient {
        self.slope.at(&mut self.local, at, Side::Above)
    }

    /// The values at the ends of all sides; near the ends where something cuts the square.
    fn values(&mut self, tile: &MarchingTile) -> Vec<[f64; 2]> {
        let n = tile.piece.corners.len();
        if tile.is_whole {
            let corners: Vec<f64> = tile.piece.corners.iter().map(|&c| self.value(c)).collect();
            return (0..n).map(|k| [corners[k], corners[(k + 1) % n]]).collect();
        }
        (0..n).map(|k| [INSET, 1.0 - INSET].map(|t| self.value(tile.side_point(k, t)))).collect()
    }

    /// The place on a side where a level is passed, by Newton's method in a bracket; the same from
    /// both sides.
    fn crossing(&mut self, tile: &MarchingTile, pass: TileCrossing, level: f64) -> SideCrossing {
        let k = match pass {
            TileCrossing::Corner(k) => return tile.at_corner(k),
            TileCrossing::Side(k) => k,
        };
        let [a, b] = [tile.piece.corners[k], tile.next(k)];
        let values = tile.values[k].map(|value| value - level);
        let is_turned = (b.x, b.y) < (a.x, a.y);
        let ([a, b], values) =
            if is_turned { ([b, a], [values[1], values[0]]) } else { ([a, b], values) };
        let is_face = tile.piece.faces[k];
        let mut along = |t: f64| {
            let seen = tile.side_point(k, if is_turned { 1.0 - t } else { t });
            let ValueWithGradient { value, gradient } = self.slope(seen);
            (value - level, gradient.dot(b - a))
        };
        let root = root(values, &mut along);
        let end = SegmentEnd {
            side: [a, b],
            is_final: is_face || self.lattice.is_border([a, b]),
            neighbour: if is_face { None } else { self.lattice.neighbour(tile.cell, [a, b]) },
        };
        let sides = root.jump.map(|sides| sides.map(|t| a + (b - a) * t));
        let jumps = sides.is_some_and(|sides| !self.field_jumps(sides));
        SideCrossing { at: a + (b - a) * root.at, end, jumps }
    }

    /// True if derivatives of the field differ between two near points, as they may on borders of
    /// patches. Lines follow such a border from the one side's end to the other's; jumps that a
    /// quantity has by itself, as angles, are no lines.
    fn field_jumps(&mut self, sides: [Vec2; 2]) -> bool {
        if self.slope.quantity().source() == Source::Partition {
            return false;
        }
        let zero = vec![Jet::constant(0.0); self.local.field.components()];
        let [a, b] = sides.map(|at| {
            let mut jets = zero.clone();
            self.local.evaluate::<1>(at, Side::Above, &mut jets);
            jets
        });
        let size = |u: &Jet<f64>| u.x.hypot(u.y);
        let change = a.iter().zip(&b).map(|(a, b)| size(&a.minus::<1>(*b))).fold(0.0, f64::max);
        change > SAME * a.iter().chain(&b).map(size).fold(0.0, f64::max)
    }

    /// Puts points between two of a curve until chords are near it.
    fn pull(
        &mut self,
        tile: &MarchingTile,
        level: f64,
        [a, b]: [Vec2; 2],
        depth: usize,
        out: &mut Vec<Vec2>,
    ) {
        let middle = (a + b) * 0.5;
        if (b - a).length() <= CHORD * self.pixel {
            return;
        }
        let Some(on_curve) = self.pulled(tile, level, middle, 0.5 * (b - a).length()) else {
            return;
        };
        let is_bent = (on_curve - middle).length() > CHORD * self.pixel;
        let deeper = is_bent && depth > 0;
        if deeper {
            self.pull(tile, level, [a, on_curve], depth - 1, out);
        }
        out.push(on_curve);
        if deeper {
            self.pull(tile, level, [on_curve, b], depth - 1, out);
        }
    }

    /// The point of the curve near a point, along gradients; none if there is none near, or it is
    /// outside the piece.
    fn pulled(&mut self, tile: &MarchingTile, level: f64, from: Vec2, reach: f64) -> Option<Vec2> {
        let mut at = from;
        for _ in 0..PULLS {
            let seen = if tile.is_whole { at } else { tile.piece.seen_from_inside(at) };
            let ValueWithGradient { value, gradient } = self.slope(seen);
            let length = gradient.length();
            let step = (gradient / length) * ((level - value) / length);
            at = at + step;
            let is_near = (at - from).length() <= reach
                && (tile.is_whole || contains(&tile.piece.corners, at));
            if !is_near {
                return None;
            }
            if step.length() <= 1e-6 * self.pixel {
                return Some(at);
            }
        }
        None
    }
}

impl MarchingTile {
    /// Where a level is passed on the way around, and whether values are above it from there on;
    /// nothing where some are not defined.
    fn passes(&self, level: f64) -> Vec<(TileCrossing, bool)> {
        let mut passes = Vec::new();
        if self.values.as_flattened().iter().any(|value| value.is_nan()) {
            return passes;
        }
        let mut is_above = self.values[self.values.len() - 1][1] > level;
        for (k, ends) in self.values.iter().enumerate() {
            for (value, pass) in ends.iter().zip([TileCrossing::Corner(k), TileCrossing::Side(k)]) {
                if (*value > level) != is_above {
                    is_above = !is_above;
                    passes.push((pass, is_above));
                }
            }
        }
        passes
    }

    fn next(&self, k: usize) -> Vec2 {
        self.piece.corners[(k + 1) % self.piece.corners.len()]
    }

    /// A point of a side, on faces as it is seen from inside.
    fn side_point(&self, k: usize, t: f64) -> Vec2 {
        let (a, b) = (self.piece.corners[k], self.next(k));
        // the same from both sides
        let p = if (b.x, b.y) < (a.x, a.y) { b + (a - b) * (1.0 - t) } else { a + (b - a) * t };
        if self.piece.faces[k] { self.piece.seen_from_inside(p) } else { p }
    }

    /// A line that ends in a corner.
    fn at_corner(&self, k: usize) -> SideCrossing {
        let (at, n) = (self.piece.corners[k], self.piece.corners.len());
        let is_final = self.piece.faces[k] || self.piece.faces[(k + n - 1) % n];
        SideCrossing {
            at,
            end: SegmentEnd { side: [at, at], is_final, neighbour: None },
            jumps: false,
        }
    }
}

/// A square that nothing cuts.
/// The piece with those of some points as corners that lie on its sides along the lattice.
fn with_corners(piece: ConvexPiece, points: &[Vec2]) -> ConvexPiece {
    if points.is_empty() {
        return piece;
    }
    let (mut corners, mut faces) = (Vec::new(), Vec::new());
    for ([a, b], &face) in sides(&piece.corners).zip(&piece.faces) {
        let mut between: Vec<f64> = points.iter().filter_map(|&p| part(a, b, p)).collect();
        between.sort_by(f64::total_cmp);
        between.dedup_by(|b, a| *b - *a <= SAME_CORNER);
        let on_side = |t: f64| points.iter().copied().find(|&p| part(a, b, p) == Some(t));
        let inserted = between.into_iter().filter_map(on_side);
        corners.extend([a].into_iter().chain(inserted));
        faces.resize(corners.len(), face);
    }
    ConvexPiece { corners, faces, ..piece }
}

/// The part of the way along a side of the lattice at which a point lies; `None` if it does not, or
/// is an end.
fn part(a: Vec2, b: Vec2, p: Vec2) -> Option<f64> {
    let t = if a.x == b.x && p.x == a.x {
        (p.y - a.y) / (b.y - a.y)
    } else if a.y == b.y && p.y == a.y {
        (p.x - a.x) / (b.x - a.x)
    } else {
        return None;
    };
    (t > SAME_CORNER && t < 1.0 - SAME_CORNER).then_some(t)
}
