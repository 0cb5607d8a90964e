//! Cutting of the body into pieces with nearly affine images: parts are halved again and again.

use ppum::domain::LocalDomain;
use ppum::function::FunctionKind;
use ppum::mesh::Mesh;
use ppum::progress::Watcher;
use ppum::vec2::{Rect, Vec2};
use ppum_raster::parts::Parts;
use rayon::prelude::*;

use super::chart::ElementChart;
use super::leaf::DeformedLeaf;
use super::map::{DeformationChart, DeformationMap};
use super::{DeformError, DeformedView};
use crate::pieces::{ConvexPiece, INSET, Pieces, quarters};

/// Squares are halved that often before it is asked what is seen of them: displacements vary little
/// enough from one to the next.
const LEVELS: usize = 5;
/// Halvings of elements: of those with only polynomials of a degree below this one, and of others.
const HIGH: u8 = 5;
const LEVELS_OF_ELEMENTS: [usize; 2] = [0, 2];
/// Most pieces in units of the image's pixels, and at least; and in units of elements.
const MOST: usize = 16;
const MOST_AT_LEAST: usize = 1 << 20;
const MOST_OF_ELEMENTS: usize = 4;

/// Parts that are looked at before the watcher is asked.
const BLOCK: usize = 32;

/// All pieces of the body that may be seen.
pub(super) fn leaves(
    view: &DeformedView<'_>,
    watcher: &dyn Watcher,
) -> Result<Vec<DeformedLeaf>, DeformError> {
    match view.field().step.partition.mesh() {
        Some(mesh) => halved(view, &ElementCutter { view, mesh, only_cut: false }, watcher),
        None => halved(view, &SquareCutter::new(view), watcher),
    }
}

/// The pieces of those elements that level fields or cracks cut.
pub(super) fn leaves_of_cuts(
    view: &DeformedView<'_>,
    mesh: &Mesh,
    watcher: &dyn Watcher,
) -> Result<Vec<DeformedLeaf>, DeformError> {
    halved(view, &ElementCutter { view, mesh, only_cut: true }, watcher)
}

/// A way to cut the body: first into parts, each of them into pieces, or into four smaller parts.
trait Cutter: Sync {
    type Part: Clone + PartialEq + Send + Sync;

    fn parts(&self) -> Vec<Self::Part>;

    /// The pieces of a part.
    fn cut(&self, map: &mut DeformationMap<'_>, part: &Self::Part) -> CutPart;

    fn quarters(part: &Self::Part) -> [Self::Part; 4];
}

/// The pieces that may be seen of all parts, halved as long as needed.
fn halved<C: Cutter>(
    view: &DeformedView<'_>,
    cutter: &C,
    watcher: &dyn Watcher,
) -> Result<Vec<DeformedLeaf>, DeformError> {
    let [columns, rows] = view.view.pixels.map(|n| n as usize);
    let (mut left, mut found) = (cutter.parts(), Vec::new());
    let most = MOST.saturating_mul(columns * rows).max(MOST_AT_LEAST);
    let most = most.max(MOST_OF_ELEMENTS * left.len());
    while !left.is_empty() {
        let parts = Parts::start(watcher, left.len().div_ceil(BLOCK))?;
        let blocks = left.par_chunks(BLOCK).map_init(
            || DeformationMap::new(view.field(), view.anchor),
            |map, block| {
                let seen: Vec<_> = block.iter().map(|part| look(cutter, view, map, part)).collect();
                parts.finish_one().map(|()| seen)
            },
        );
        let blocks: Vec<Vec<_>> = blocks.collect::<Result<_, _>>()?;
        left.clear();
        for seen in blocks.into_iter().flatten() {
            match seen {
                Ok(leaves) => found.extend(leaves),
                Err(quarters) => left.extend(quarters),
            }
        }
        if found.len() + left.len() > most {
            return Err(DeformError::TooFolded(view.factor()));
        }
    }
    Ok(found)
}

/// The pieces of a part of the body.
struct CutPart {
    leaves: Vec<DeformedLeaf>,
    /// True if a curve may cut the part in a way that its pieces do not show: it has to be halved,
    /// whatever they are.
    is_coarse: bool,
}

/// The pieces of a part that may be seen, or its quarters if it has to be halved.
fn look<C: Cutter>(
    cutter: &C,
    view: &DeformedView<'_>,
    map: &mut DeformationMap<'_>,
    part: &C::Part,
) -> Result<Vec<DeformedLeaf>, [C::Part; 4]> {
    let CutPart { mut leaves, is_coarse } = cutter.cut(map, part);
    leaves.retain(|leaf| leaf.may_be_seen(view));
    // a part that rounding no longer halves is as small as can be
    let quarters = C::quarters(part);
    let is_smallest = quarters.contains(part);
    let is_done = || !is_coarse && leaves.iter().all(|leaf| leaf.is_done(view));
    if is_smallest || is_done() { Ok(leaves) } else { Err(quarters) }
}

/// The cutter of squares of offsets from the anchor.
struct SquareCutter<'a, 'f> {
    view: &'a DeformedView<'f>,
    pieces: Pieces<'f>,
    domain: LocalDomain,
}

impl<'a, 'f> SquareCutter<'a, 'f> {
    fn new(view: &'a DeformedView<'f>) -> Self {
        let field = view.field();
        let pieces = Pieces::of_values(field, view.anchor);
        Self { view, pieces, domain: field.domain.at(view.anchor) }
    }

    /// A square that nothing cuts, unless it lies in a hole.
    fn whole(&self, square: &Rect) -> Option<ConvexPiece> {
        let is_inside = self.domain.contains(square.center());
        is_inside.then(|| ConvexPiece::uncut(square.corners(), INSET))
    }
}

impl Cutter for SquareCutter<'_, '_> {
    type Part = Rect;

    fn parts(&self) -> Vec<Rect> {
        let mut squares = vec![self.view.root()];
        for _ in 0..LEVELS {
            squares = squares.iter().flat_map(Self::quarters).collect();
        }
        squares
    }

    fn cut(&self, map: &mut DeformationMap<'_>, square: &Rect) -> CutPart {
        if !self.pieces.may_cut(square) {
            let leaf =
                self.whole(square).and_then(|piece| DeformedLeaf::new(self.view, map, &piece));
            return CutPart { leaves: leaf.into_iter().collect(), is_coarse: false };
        }
        let at_rim = self.pieces.may_bend(square);
        let leaf = |piece: &ConvexPiece| {
            let leaf = DeformedLeaf::new(self.view, map, piece)?;
            Some(DeformedLeaf { at_rim, ..leaf })
        };
        let leaves = self.pieces.of(square).iter().filter_map(leaf).collect();
        CutPart { leaves, is_coarse: false }
    }

    fn quarters(square: &Rect) -> [Rect; 4] {
        quarters(square)
    }
}

/// The images of the sides of a piece that are faces. Their ends lie on the curve, chords
/// beside it.
fn faces(
    view: &DeformedView<'_>,
    chart: &mut ElementChart<'_, '_>,
    piece: &ConvexPiece,
) -> Vec<[Vec2; 2]> {
    let (center, corners) = (piece.center(), &piece.corners);
    // as near to the curve as is on the piece's side of it
    let mut place = |k: usize| {
        let corner = corners[k % corners.len()];
        let inward = [INSET, piece.inset].map(|inset| corner + (center - corner) * inset);
        let p = inward.into_iter().find(|&p| chart.goes_on(center, p))?;
        chart.place(view, p)
    };
    let faces = (0..corners.len()).filter(|&k| piece.faces[k]);
    faces.filter_map(|k| Some([place(k)?, place(k + 1)?])).collect()
}

/// The cutter of the elements of a mesh in their own coordinates.
struct ElementCutter<'a, 'f> {
    view: &'a DeformedView<'f>,
    mesh: &'a Mesh,
    /// Only elements that are cut are looked at.
    only_cut: bool,
}

/// A part of an element's reference shape: a triangle or a square.
#[derive(Clone, Debug, PartialEq)]
struct ShapePart {
    patch: u32,
    /// Counter-clockwise.
    corners: Vec<Vec2>,
}

impl ElementCutter<'_, '_> {
    /// How often an element is halved before it is asked what is seen of it.
    fn levels(&self, patch: usize) -> usize {
        let data = self.view.field().data;
        let functions = &self.view.field().step.functions;
        let is_plain = |block: usize| {
            let function = &functions[data.block_function[block] as usize];
            data.block_degree[block] < HIGH && function.kind == FunctionKind::One
        };
        let is_plain = self.mesh.map_degree[patch] < HIGH && data.blocks(patch).all(is_plain);
        LEVELS_OF_ELEMENTS[usize::from(!is_plain)]
    }
}

impl Cutter for ElementCutter<'_, '_> {
    type Part = ShapePart;

    fn parts(&self) -> Vec<ShapePart> {
        let map = DeformationMap::new(self.view.field(), self.view.anchor);
        let of_patch = |patch: u32| {
            let chart = ElementChart::new(&map, patch);
            let chart = chart.filter(|chart| !self.only_cut || chart.is_cut());
            let whole = chart.map(|chart| ShapePart { patch, corners: chart.corners() });
            let mut parts: Vec<_> = whole.into_iter().collect();
            for _ in 0..self.levels(patch as usize) {
                parts = parts.iter().flat_map(Self::quarters).collect();
            }
            parts
        };
        (0..self.mesh.len() as u32).flat_map(of_patch).collect()
    }

    fn cut(&self, map: &mut DeformationMap<'_>, part: &ShapePart) -> CutPart {
        let ShapePart { patch, corners } = part;
        let Some(mut chart) = ElementChart::new(map, *patch) else {
            return CutPart { leaves: Vec::new(), is_coarse: false };
        };
        let may_bend = chart.may_bend(corners);
        let is_coarse = may_bend
            && DeformedLeaf::new(self.view, &mut chart, &ConvexPiece::uncut(&corners[..], INSET))
                .is_some_and(|whole| whole.may_be_seen(self.view) && whole.is_coarse(self.view));
        let pieces = chart.pieces(corners);
        let leaf = |piece: &ConvexPiece| {
            let leaf = DeformedLeaf::new(self.view, &mut chart, piece)?;
            let faces = faces(self.view, &mut chart, piece);
            let at_rim = may_bend || piece.inset > INSET;
            Some(DeformedLeaf { patch: *patch, at_rim, faces, ..leaf })
        };
        CutPart { leaves: pieces.iter().filter_map(leaf).collect(), is_coarse }
    }

    fn quarters(part: &ShapePart) -> [ShapePart; 4] {
        let corners = &part.corners;
        let middle = |k: usize| (corners[k] + corners[(k + 1) % corners.len()]) * 0.5;
        let quarters = match corners[..] {
            [a, b, c] => {
                let [p, q, r] = [0, 1, 2].map(middle);
                [vec![a, p, r], vec![p, b, q], vec![r, q, c], vec![p, q, r]]
            }
            _ => {
                let center = (middle(0) + middle(2)) * 0.5;
                [0, 1, 2, 3].map(|k| vec![corners[k], middle(k), center, middle((k + 3) % 4)])
            }
        };
        quarters.map(|corners| ShapePart { patch: part.patch, corners })
    }
}
