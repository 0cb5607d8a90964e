//! Pieces of the plate with nearly affine images.

use ppum::crack::Side;
use ppum::domain::{Hole, LocalDomain};
use ppum::progress::Watcher;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::parts::Parts;
use rayon::prelude::*;

use super::map::{DeformationMap, Image};
use super::{DeformError, DeformedView};
use crate::pieces::{INSET, Piece, Pieces};

/// Squares are halved that often before it is asked what is seen of them: displacements vary little
/// enough from one to the next.
const LEVELS: usize = 5;
/// Largest image of a piece \[pixels\].
const LARGEST: f64 = 16.0;
/// The same of one beside a round rim, which pieces follow to a hundredth.
const LARGEST_AT_RIM: f64 = 2.0;
/// Largest deviation of a piece's image from an affine one \[pixels\] …
const BENT: f64 = 0.25;
/// … unless the whole image is smaller than this: at a tip F grows without bound.
const TINY: f64 = 0.5;
/// Most pieces in units of the picture's pixels, and at least.
const MOST: usize = 16;
const MOST_AT_LEAST: usize = 1 << 20;

/// A convex piece of the plate on one side of every crack, and its image.
#[derive(Debug)]
pub(super) struct Leaf {
    /// Corners as seen from inside, offsets from the anchor, counter-clockwise.
    pub(super) corners: Vec<Vec2>,
    /// The mean of the corners, and its image.
    pub(super) center: Vec2,
    pub(super) image: Image,
    /// Images of the corners.
    pub(super) images: Vec<Vec2>,
    /// The box of the images of corners and middles of sides.
    pub(super) bounds: Rect,
    /// Deviation of these images from affine ones, a length.
    pub(super) bent: f64,
    /// True beside a round rim: the plate goes on behind the piece's side, a little.
    pub(super) at_rim: bool,
}

/// Squares that are looked at before the watcher is asked.
const BLOCK: usize = 32;

/// All pieces of the plate that may be seen.
pub(super) fn leaves(
    view: &DeformedView<'_>,
    watcher: &dyn Watcher,
) -> Result<Vec<Leaf>, DeformError> {
    let field = view.field();
    let cutter = Cutter::new(view);
    let [columns, rows] = view.view.pixels.map(|n| n as usize);
    let most = MOST.saturating_mul(columns * rows).max(MOST_AT_LEAST);
    let (mut squares, mut found) = (vec![view.root()], Vec::new());
    for _ in 0..LEVELS {
        squares = squares.iter().flat_map(quarters).collect();
    }
    while !squares.is_empty() {
        let parts = Parts::start(watcher, squares.len().div_ceil(BLOCK))?;
        let blocks = squares.par_chunks(BLOCK).map_init(
            || DeformationMap::new(field, view.anchor),
            |map, block| {
                let seen: Vec<_> = block.iter().map(|square| cutter.look(map, square)).collect();
                parts.finish_one().map(|()| seen)
            },
        );
        let blocks: Vec<Vec<Looked>> = blocks.collect::<Result<_, _>>()?;
        squares.clear();
        for seen in blocks.into_iter().flatten() {
            match seen {
                Looked::Leaves(leaves) => found.extend(leaves),
                Looked::Quarters(quarters) => squares.extend(quarters),
            }
        }
        if found.len() + squares.len() > most {
            return Err(DeformError::TooFolded(view.factor()));
        }
    }
    Ok(found)
}

/// What became of a square.
enum Looked {
    /// All its pieces that may be seen, if any.
    Leaves(Vec<Leaf>),
    /// It has to be halved.
    Quarters([Rect; 4]),
}

/// What cuts squares into leaves.
struct Cutter<'a, 'f> {
    view: &'a DeformedView<'f>,
    pieces: Pieces<'f>,
    domain: LocalDomain,
}

impl<'a, 'f> Cutter<'a, 'f> {
    fn new(view: &'a DeformedView<'f>) -> Self {
        let field = view.field();
        let pieces = Pieces::of_values(field, view.anchor);
        Self { view, pieces, domain: field.domain.at(view.anchor) }
    }

    fn look(&self, map: &mut DeformationMap<'_>, square: &Rect) -> Looked {
        let view = self.view;
        let leaves: Vec<Leaf> = match self.pieces.may_cut(square) {
            true => self
                .pieces
                .of(square)
                .iter()
                .filter_map(|p| Leaf::new(view, map, p, true))
                .collect(),
            false => self
                .whole(square)
                .and_then(|p| Leaf::new(view, map, &p, false))
                .into_iter()
                .collect(),
        };
        let leaves: Vec<Leaf> = leaves.into_iter().filter(|leaf| leaf.may_be_seen(view)).collect();
        // a square that rounding no longer halves is as small as can be
        let quarters = quarters(square);
        let is_smallest = quarters.contains(square);
        if is_smallest || leaves.iter().all(|leaf| leaf.is_done(view)) {
            return Looked::Leaves(leaves);
        }
        Looked::Quarters(quarters)
    }

    /// A square that nothing cuts, unless it lies in a hole.
    fn whole(&self, square: &Rect) -> Option<Piece> {
        let (min, max) = (square.min, square.max);
        let corners = vec![min, vec2(max.x, min.y), max, vec2(min.x, max.y)];
        let is_inside = self.domain.contains(square.center());
        is_inside.then(|| Piece { corners, faces: vec![false; 4], inset: INSET })
    }
}

fn quarters(square: &Rect) -> [Rect; 4] {
    let (min, middle, max) = (square.min, square.center(), square.max);
    [
        Rect::new(min, middle),
        Rect::new(vec2(middle.x, min.y), vec2(max.x, middle.y)),
        Rect::new(vec2(min.x, middle.y), vec2(middle.x, max.y)),
        Rect::new(middle, max),
    ]
}

impl Leaf {
    /// Nothing where the field has no values.
    fn new(
        view: &DeformedView<'_>,
        map: &mut DeformationMap<'_>,
        piece: &Piece,
        is_cut: bool,
    ) -> Option<Self> {
        let center = piece.center();
        let corners: Vec<Vec2> = piece.corners.iter().map(|&c| piece.seen_from_inside(c)).collect();
        let image = map.image(view, center)?;
        let n = corners.len();
        let middles = (0..n).map(|k| (corners[k] + corners[(k + 1) % n]) * 0.5);
        let samples: Vec<Vec2> = corners.iter().copied().chain(middles).collect();
        let place = |&p: &Vec2| map.place(view, p, Side::Above);
        let images: Vec<Vec2> = samples.iter().map(place).collect::<Option<_>>()?;
        let deviation =
            |(p, at): (&Vec2, &Vec2)| (*at - image.at - image.carried(*p - center)).length();
        let bent = samples.iter().zip(&images).map(deviation).fold(0.0, largest);
        let start = Rect::new(image.at, image.at);
        let bounds = images.iter().fold(start, |all, &p| all.union(&Rect::new(p, p)));
        let at_rim = is_cut && beside_round_rim(view, piece);
        let images = images[..n].to_vec();
        bounds.size().is_finite().then_some(Self {
            corners,
            center,
            image,
            images,
            bounds,
            bent,
            at_rim,
        })
    }

    /// True if the image is small, and nearly affine.
    fn is_done(&self, view: &DeformedView<'_>) -> bool {
        let size = self.bounds.size() / view.view.pixel_size();
        let size = size.x.max(size.y);
        let largest = if self.at_rim { LARGEST_AT_RIM } else { LARGEST };
        size <= TINY || (size <= largest && self.bent <= BENT * view.view.pixel_size())
    }

    /// False if the image lies far from the picture.
    fn may_be_seen(&self, view: &DeformedView<'_>) -> bool {
        let size = self.bounds.size();
        let reach = size.x.max(size.y) + 2.0 * view.view.pixel_size();
        let around =
            Rect::new(self.bounds.min - vec2(reach, reach), self.bounds.max + vec2(reach, reach));
        around.overlaps(&Rect::new(-view.view.half(), view.view.half()))
    }
}

/// The larger number; infinite if one is none.
fn largest(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// True if a corner of a piece comes near the rim of a round hole.
fn beside_round_rim(view: &DeformedView<'_>, piece: &Piece) -> bool {
    let size = (piece.corners[0] - piece.center()).length();
    let center = view.anchor + piece.center();
    view.field()
        .domain
        .holes
        .iter()
        .any(|hole| matches!(hole, Hole::Circle { .. }) && hole.rim_distance(center) < 2.0 * size)
}
