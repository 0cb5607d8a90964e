//! Squares of a lattice cut into convex pieces, each on one side of every crack, interface and rim.
//!
//! Code that follows a field through a square, an isoline or the square's image in the deformed
//! body, must not cross a jump. A square that nothing crosses is its own only piece. Others are cut
//! by
//!
//! - the lines of the segments of cracks that meet it: their extensions too, which does no harm,
//! - the straight sides of holes,
//! - for arcs of cracks and rims chords, or tangents where these stay in the body, nearer to them
//!   than [`SAGITTA`] of the square,
//! - the border of the domain,
//! - the sets on which the material's formulas may jump, curved ones by chords;
//!
//! and what lies outside the domain is dropped. All points are offsets from the anchor, as
//! everywhere: pieces at a tip are as good in a view 10⁻¹² of the domain wide.
//!
//! A corner of a piece may lie on a crack. Its values are those *seen from inside*: at the corner
//! moved by [`INSET`] of its way to the piece's centroid, so that no side has to be named.

mod curve;
mod cut;
mod edge_line;
mod element;
mod piece;

use ppum::box_tree::BoxTree;
use ppum::domain::{Hole, LocalDomain};
use ppum::edge::Edge;
use ppum::equation::Equation;
use ppum::field::Field;
use ppum::formula::Kink;
use ppum::vec2::{Rect, Vec2, vec2};

use crate::anchored_edge::AnchoredEdge;
pub(crate) use curve::{FormulaLevel, LevelCurve};
pub(crate) use cut::PolygonCut;
pub use cut::SAGITTA;
use cut::{AnchoredPolygon, centroid};
use edge_line::{EdgeCut, EdgeLine};
pub use element::{ElementCuts, steepness};
use piece::SHORTEST;
pub(crate) use piece::contains;
pub use piece::{ConvexPiece, INSET};

/// Squares with more lines in them than this are divided into four, again and again, up to
/// [`DEPTH`] times: the lines of a corner with many sides do not all cut all pieces then.
const LINES: usize = 8;
const DEPTH: usize = 6;

/// Parts that a cut leaves thinner than this part of the square are dropped: nobody sees them, and
/// points could not be told to be inside them.
const SLIVER: f64 = 1e-5;

/// The lines that a field may jump on, relative to an anchor, ready to cut squares.
#[derive(Debug)]
pub struct Pieces<'f> {
    equation: &'f Equation,
    anchor: Vec2,
    domain: LocalDomain,
    /// The box of the domain, relative to the anchor.
    bounds: Rect,
    /// Edges of cracks and rims, found by their boxes.
    lines: Vec<EdgeLine>,
    tree: BoxTree,
    /// Straight interfaces, and the others.
    interfaces: Vec<PolygonCut>,
    curves: Vec<FormulaLevel>,
}

impl<'f> Pieces<'f> {
    /// For quantities of the gradient: pieces end at cracks, rims and interfaces of the material.
    /// O(n log n) for n edges.
    #[must_use]
    pub fn new(field: &Field<'f>, anchor: Vec2) -> Self {
        let mut pieces = Self::of_values(field, anchor);
        material_kinks(field).for_each(|kink| pieces.add_interface(kink));
        pieces
    }

    /// For the field's values, which are continuous across interfaces: pieces end at cracks and
    /// rims only.
    #[must_use]
    pub fn of_values(field: &Field<'f>, anchor: Vec2) -> Self {
        let domain = field.domain;
        let of_cracks = field.step.cracks.iter().flat_map(|crack| {
            let line = |edge: Edge| EdgeLine::of_crack(edge, crack.is_curved(), anchor);
            crack.edges().map(move |edge| (edge.bounds(), line(edge)))
        });
        let of_holes = domain.holes.iter().flat_map(|hole| {
            let (body, is_disc) = (-hole.orientation(), matches!(hole, Hole::Circle { .. }));
            let line = move |(bounds, edge)| (bounds, EdgeLine::of_rim(edge, body, is_disc));
            AnchoredEdge::rim(hole, anchor).map(line)
        });
        let (boxes, lines): (Vec<Rect>, Vec<_>) = of_cracks.chain(of_holes).unzip();
        Self {
            equation: field.equation,
            anchor,
            domain: domain.at(anchor),
            bounds: Rect::new(domain.bounds.min - anchor, domain.bounds.max - anchor),
            lines,
            tree: BoxTree::new(&boxes),
            interfaces: Vec::new(),
            curves: Vec::new(),
        }
    }

    fn add_interface(&mut self, kink: Kink) {
        match kink.line() {
            Some(line) => self.interfaces.extend(PolygonCut::interface(line, self.anchor)),
            None => self.curves.push(FormulaLevel { formula: kink.value, anchor: self.anchor }),
        }
    }

    /// False if nothing cuts any square of a rectangle of offsets from the anchor; all of it lies
    /// in the domain then, or all outside. Curved interfaces are tested by samples.
    #[must_use]
    pub(crate) fn may_cut(&self, rect: &Rect) -> bool {
        let near = self.bounds.intersection(rect);
        if near.min.x > near.max.x || near.min.y > near.max.y {
            return false;
        }
        let is_inside = self.bounds.contains(rect.min) && self.bounds.contains(rect.max);
        !is_inside
            || self.curves.iter().any(|curve| curve.may_meet(rect))
            || self.interfaces.iter().any(|cut| cut.meets(rect))
            || !self.lines_in(rect).is_empty()
    }

    /// The pieces of a square, or another rectangle, of offsets from the anchor; none if all of it
    /// lies outside the domain. O(log n) to find what cuts it.
    #[must_use]
    pub fn of(&self, square: &Rect) -> Vec<ConvexPiece> {
        let mut pieces = Vec::new();
        self.divide(square, DEPTH, &mut pieces);
        pieces
    }

    fn divide(&self, square: &Rect, depth: usize, pieces: &mut Vec<ConvexPiece>) {
        let lines = self.lines_in(square);
        if lines.len() > LINES && depth > 0 {
            quarters(square).iter().for_each(|quarter| self.divide(quarter, depth - 1, pieces));
            return;
        }
        let size = square.size();
        let size = size.x.min(size.y);
        let least = SLIVER * size;
        let mut all = vec![AnchoredPolygon::uncut(&square.corners())];
        for border in PolygonCut::borders(&self.bounds) {
            let inside = |polygon: AnchoredPolygon| {
                let [_, inside] = polygon.split(&border, least);
                inside
            };
            all = all.into_iter().filter_map(inside).collect();
        }
        let straight = self.interfaces.iter().filter(|cut| cut.meets(square));
        for cut in lines {
            all = all.into_iter().flat_map(|polygon| cut.split(polygon, least)).collect();
        }
        for cut in straight {
            all = all.into_iter().flat_map(|polygon| polygon.split(cut, least)).flatten().collect();
        }
        for curve in &self.curves {
            all = all.into_iter().flat_map(|polygon| curve.split(polygon, least)).collect();
        }
        let shortest = SHORTEST * size;
        pieces.extend(all.into_iter().filter_map(|polygon| self.finished(polygon, shortest)));
    }

    /// The piece of a polygon that nothing cuts any more; none outside the domain, or where it has
    /// no area.
    fn finished(&self, polygon: AnchoredPolygon, shortest: f64) -> Option<ConvexPiece> {
        let polygon = polygon.without_short_sides(shortest)?.with_ends();
        let center = centroid(&polygon.corners);
        if polygon.is_sliver(center) || !self.domain.contains(center) {
            return None;
        }
        let faces = (0..polygon.corners.len()).map(|k| self.is_face(&polygon, k, center)).collect();
        Some(ConvexPiece { faces, inset: polygon.inset(center, INSET), corners: polygon.corners })
    }

    /// True if the field may jump on a side, or ends there.
    fn is_face(&self, polygon: &AnchoredPolygon, side: usize, center: Vec2) -> bool {
        let middle = polygon.middle(side);
        polygon.sides[side].as_ref().is_some_and(|cut| {
            cut.holds(middle) && (!cut.is_interface || self.material_jumps(cut, middle, center))
        })
    }

    /// True if the material or given strains differ on the two sides of an interface, as seen from
    /// as far as chords of curves are from them.
    fn material_jumps(&self, cut: &PolygonCut, middle: Vec2, center: Vec2) -> bool {
        let inward = (center - middle) * (2.0 * INSET).max(cut.inset(center));
        let [a, b] = [inward, -inward].map(|step| {
            let at = middle + step;
            let moduli = self.equation.moduli(self.anchor, [at.x, at.y]);
            let [xx, yy, xy, zz] = moduli.eigenstrain;
            let [a, b, c, d] = moduli.anisotropy;
            let (first, second) = (moduli.lambda, moduli.mu);
            let isotropic = [moduli.young, moduli.poisson, moduli.conductivity];
            [isotropic, [xx, yy, xy], [zz, first, second], [a, b, c], [d, 0.0, 0.0]]
        });
        a.into_iter()
            .flatten()
            .zip(b.into_iter().flatten())
            .any(|(a, b)| (a - b).abs() > JUMP * (a.abs() + b.abs()))
    }

    /// True if an arc comes near a rectangle of offsets.
    pub(crate) fn may_bend(&self, rect: &Rect) -> bool {
        let (near, mut found) = (Rect::around(rect.center(), rect.size() * 0.51), Vec::new());
        self.tree.query_box(&self.in_world(&near), &mut found);
        let mut lines = found.iter().map(|&k| &self.lines[k as usize]);
        lines.any(|line| line.is_arc() && !line.cuts(&near).is_empty())
    }

    fn lines_in(&self, square: &Rect) -> Vec<EdgeCut> {
        let mut found = Vec::new();
        self.tree.query_box(&self.in_world(square), &mut found);
        found.iter().flat_map(|&k| self.lines[k as usize].cuts(square)).collect()
    }

    /// A box in world coordinates that holds a rectangle in spite of rounding.
    fn in_world(&self, rect: &Rect) -> Rect {
        let (min, max) = (self.anchor + rect.min, self.anchor + rect.max);
        let size = [min.x, min.y, max.x, max.y, self.anchor.x, self.anchor.y].into_iter();
        let reach = 8.0 * f64::EPSILON * size.fold(f64::MIN_POSITIVE, |a, b| a.max(b.abs()));
        Rect::new(min - vec2(reach, reach), max + vec2(reach, reach))
    }
}

/// Relative difference of the moduli on two sides above which a material jumps.
const JUMP: f64 = 1e-4;

/// The kinks of the material's constants.
pub(crate) fn material_kinks(field: &Field<'_>) -> impl Iterator<Item = Kink> {
    let formulas = field.equation.constants().filter(|(_, e)| e.constant().is_none());
    formulas.flat_map(|(_, expression)| expression.formula().kinks())
}

/// The four squares of half its side.
#[must_use]
pub fn quarters(square: &Rect) -> [Rect; 4] {
    let (min, middle, max) = (square.min, square.center(), square.max);
    [
        Rect::new(min, middle),
        Rect::new(vec2(middle.x, min.y), vec2(max.x, middle.y)),
        Rect::new(vec2(min.x, middle.y), vec2(middle.x, max.y)),
        Rect::new(middle, max),
    ]
}

#[cfg(test)]
mod tests;
