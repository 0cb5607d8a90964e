//! Parts of an element's reference shape cut into convex pieces, by its own coordinate δ.
//!
//! Edges of elements are straight there, however they are bent in the plane. So cuts alone have to
//! be followed: level fields that clip the patch or that its functions are made of, and the lines
//! of cracks. Linear ones are cut exactly, others by chords as curved interfaces are.

use ppum::crack::Crack;
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::mesh::{ElementField, Mesh};
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::Vec2;

use super::curve::LevelCurve;
use super::cut::{AnchoredPolygon, centroid};
use super::piece::{ConvexPiece, INSET, SHORTEST};
use crate::anchored_edge::AnchoredEdge;

/// The lines that cut one patch of a mesh.
#[derive(Debug, Default)]
pub struct ElementCuts(Vec<ElementCut>);

/// A line on which a function of a patch is zero.
#[derive(Clone, Copy, Debug)]
struct ElementCut {
    zero: Zero,
    /// The side that the patch has, if the line clips it: true for values ≥ 0.
    kept: Option<bool>,
    face: FaceLine,
    /// Bound of the change of the value for a change of ξ by 1.
    slope: f64,
    is_straight: bool,
}

/// A function of δ.
#[derive(Clone, Copy, Debug)]
enum Zero {
    /// A level field, by its index among the step's fields.
    Level(usize),
    /// The distance from the line or circle of a crack's edge.
    Edge(AnchoredEdge),
}

/// The part of a line that is drawn as a face.
#[derive(Clone, Copy, Debug)]
enum FaceLine {
    All,
    Nothing,
    /// Where another level field is negative: behind a tip.
    Behind(usize),
}

impl ElementCuts {
    /// The cuts of a patch: of its clips, of the functions of its blocks, and the cracks.
    #[must_use]
    pub fn new(
        field: &Field<'_>,
        mesh: &Mesh,
        element: &ElementField<'_, '_>,
        anchor: Vec2,
    ) -> Self {
        let mut cuts = Self::default();
        let patch = element.patch();
        for clip in mesh.clips(patch) {
            cuts.add_level(field, patch, clip.field, (Some(clip.is_above), FaceLine::All));
        }
        for block in field.data.blocks(patch) {
            match field.step.functions[field.data.block_function[block] as usize].kind {
                FunctionKind::Level { field: level } => {
                    cuts.add_level(field, patch, level, (None, FaceLine::All));
                }
                FunctionKind::Formula { frame: Frame::Levels([along, beside]), .. } => {
                    // the tip becomes a corner
                    cuts.add_level(field, patch, along, (None, FaceLine::Nothing));
                    cuts.add_level(field, patch, beside, (None, FaceLine::Behind(along as usize)));
                }
                _ => {}
            }
        }
        cuts.add_cracks(field, mesh, patch, anchor);
        cuts
    }

    /// True if nothing cuts the patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn add_level(
        &mut self,
        field: &Field<'_>,
        patch: usize,
        level: u32,
        (kept, face): (Option<bool>, FaceLine),
    ) {
        let index = level as usize;
        if self.0.iter().any(|cut| matches!(cut.zero, Zero::Level(known) if known == index)) {
            return;
        }
        let data = &field.step.fields[index];
        let (mut slope, mut is_straight) = (0.0, true);
        for block in data.blocks(patch) {
            let (space, degree) = (data.space(block), data.block_degree[block]);
            slope += steepness(space, degree.into(), data.block_coefficients(block, 0));
            is_straight &= degree == 0 || degree == 1 && space == PolynomialSpace::Total;
        }
        self.0.push(ElementCut { zero: Zero::Level(index), kept, face, slope, is_straight });
    }

    /// The lines and circles of the edges of cracks that come near the patch.
    fn add_cracks(&mut self, field: &Field<'_>, mesh: &Mesh, patch: usize, anchor: Vec2) {
        let bounds = mesh.bounds(patch);
        let is_near = |edge: &Edge| {
            let near = edge.bounds();
            let gap = (near.min - bounds.max).max(bounds.min - near.max);
            gap.x.max(gap.y) <= 0.0
        };
        let edges = field.step.cracks.iter().flat_map(Crack::edges).filter(is_near);
        let (space, degree) = (mesh.map_space[patch], mesh.map_degree[patch]);
        let maps = mesh.map_of(patch).map(|c| [&[0.0], c].concat());
        let slope = maps.iter().map(|c| steepness(space, degree.into(), c)).sum();
        let is_map_straight = degree == 1 && space == PolynomialSpace::Total;
        self.0.extend(edges.map(|edge| {
            let zero = Zero::Edge(AnchoredEdge::new(edge, anchor));
            let is_straight = is_map_straight && !edge.is_arc();
            ElementCut { zero, kept: None, face: FaceLine::Nothing, slope, is_straight }
        }));
    }

    /// The pieces of a convex part of the reference shape, given by its corners; none where clips
    /// leave nothing. Sides are faces where the patch ends or the field may jump, except for cracks
    /// of the step.
    #[must_use]
    pub fn pieces(&self, element: &ElementField<'_, '_>, corners: &[Vec2]) -> Vec<ConvexPiece> {
        let (center, size) = (centroid(corners), radius(corners));
        let mut all = vec![AnchoredPolygon::uncut(corners)];
        for cut in self.0.iter().filter(|cut| cut.may_meet(element, center, size)) {
            let curve = ElementLevel { element, cut };
            all = all.into_iter().flat_map(|polygon| curve.split(polygon, 0.0)).collect();
        }
        all.into_iter().filter_map(|polygon| self.finished(element, polygon, size)).collect()
    }

    fn finished(
        &self,
        element: &ElementField<'_, '_>,
        polygon: AnchoredPolygon,
        size: f64,
    ) -> Option<ConvexPiece> {
        let polygon = polygon.without_short_sides(SHORTEST * size)?;
        let center = centroid(&polygon.corners);
        if !self.keep(element, center) {
            return None;
        }
        let is_face =
            |k: usize| polygon.sides[k].as_ref().is_some_and(|side| side.holds(polygon.middle(k)));
        let faces = (0..polygon.corners.len()).map(is_face).collect();
        Some(ConvexPiece { faces, inset: polygon.inset(center, INSET), corners: polygon.corners })
    }

    /// True if the clips of the patch hold at a point, from above where a level is zero.
    #[must_use]
    pub fn keep(&self, element: &ElementField<'_, '_>, p: Vec2) -> bool {
        let holds = |cut: &ElementCut| {
            cut.kept.is_none_or(|is_above| (cut.value(element, p) >= 0.0) == is_above)
        };
        self.0.iter().all(holds)
    }

    /// True if a curved cut may meet a convex part of the reference shape.
    #[must_use]
    pub fn may_bend(&self, element: &ElementField<'_, '_>, corners: &[Vec2]) -> bool {
        let mut bent = self.0.iter().filter(|cut| !cut.is_straight).peekable();
        if bent.peek().is_none() {
            return false;
        }
        let (center, size) = (centroid(corners), radius(corners));
        bent.any(|cut| cut.may_meet(element, center, size))
    }

    /// True if a point of the patch lies on the same side of every cut as another.
    #[must_use]
    pub fn are_together(&self, element: &ElementField<'_, '_>, a: Vec2, b: Vec2) -> bool {
        let is_above = |cut: &ElementCut, p: Vec2| cut.value(element, p) >= 0.0;
        self.0.iter().all(|cut| is_above(cut, a) == is_above(cut, b))
    }
}

impl ElementCut {
    fn value(&self, element: &ElementField<'_, '_>, delta: Vec2) -> f64 {
        match self.zero {
            Zero::Level(field) => element.level(field, delta),
            Zero::Edge(edge) => edge.side(element.point(delta).offset),
        }
    }

    /// False if the value is far from zero in the square of a half-width around a point.
    fn may_meet(&self, element: &ElementField<'_, '_>, center: Vec2, half: f64) -> bool {
        self.value(element, center).abs() <= self.slope * half
    }
}

/// A cut on the patch that it cuts.
struct ElementLevel<'a, 'm, 'f> {
    element: &'a ElementField<'m, 'f>,
    cut: &'a ElementCut,
}

impl LevelCurve for ElementLevel<'_, '_, '_> {
    fn value(&self, p: Vec2) -> f64 {
        self.cut.value(self.element, p)
    }

    fn is_face(&self, middle: Vec2) -> bool {
        match self.cut.face {
            FaceLine::All => true,
            FaceLine::Nothing => false,
            FaceLine::Behind(level) => self.element.level(level, middle) < 0.0,
        }
    }
}

/// Σ (j + k) |c_jk|: |p(ξ) − p(a)| is at most this times the larger component of |ξ − a| in the
/// square [−1, 1]².
#[must_use]
pub fn steepness(space: PolynomialSpace, degree: usize, coefficients: &[f64]) -> f64 {
    let terms = space.exponents(degree).zip(coefficients);
    terms.map(|((j, k), c)| f64::from(j + k) * c.abs()).sum()
}

/// The half-width of a square around the centroid that holds all corners.
fn radius(corners: &[Vec2]) -> f64 {
    let center = centroid(corners);
    corners
        .iter()
        .map(|&corner| (corner - center).max(center - corner))
        .fold(0.0, |most, way| way.x.max(way.y).max(most))
}
