//! Pieces of the body with nearly affine images.

use ppum::vec2::{Rect, Vec2, vec2};

use super::DeformedView;
use super::map::{DeformationChart, DeformedPoint};
use crate::pieces::ConvexPiece;

/// Largest image of a piece \[pixels\].
const LARGEST: f64 = 16.0;
/// The limit for pieces beside an arc, a round rim or a curved cut, which they follow to a
/// hundredth.
const LARGEST_AT_RIM: f64 = 2.0;
/// Largest deviation of a piece's image from an affine one \[pixels\] …
const BENT: f64 = 0.25;
/// … unless the whole image is smaller than this: at a tip F grows without bound.
const TINY: f64 = 0.5;

/// A convex piece of the body on one side of every crack, and its image.
#[derive(Debug)]
pub(super) struct DeformedLeaf {
    /// The patch of a mesh whose coordinate the points are given by; 0 of boxes, where they are
    /// offsets from the anchor.
    pub(super) patch: u32,
    /// Corners as seen from inside, counter-clockwise.
    pub(super) corners: Vec<Vec2>,
    /// The mean of the corners, and its image.
    pub(super) center: Vec2,
    pub(super) image: DeformedPoint,
    /// Images of the corners.
    pub(super) images: Vec<Vec2>,
    /// The box of the images of corners and middles of sides.
    pub(super) bounds: Rect,
    /// Deviation of these images from affine ones, a length.
    pub(super) bent: f64,
    /// True beside an arc, a round rim or a curved cut: the body goes on behind the piece's side,
    /// a little.
    pub(super) at_rim: bool,
    /// Images of the sides that are faces of cuts of elements.
    pub(super) faces: Vec<[Vec2; 2]>,
}

impl DeformedLeaf {
    /// A piece that is neither of an element nor beside a rim; nothing where the field has no
    /// values.
    pub(super) fn new<C: DeformationChart>(
        view: &DeformedView<'_>,
        map: &mut C,
        piece: &ConvexPiece,
    ) -> Option<Self> {
        let center = piece.center();
        let corners: Vec<Vec2> = piece.corners.iter().map(|&c| piece.seen_from_inside(c)).collect();
        let image = map.image(view, center)?;
        let n = corners.len();
        let middles = (0..n).map(|k| (corners[k] + corners[(k + 1) % n]) * 0.5);
        let samples: Vec<Vec2> = corners.iter().copied().chain(middles).collect();
        let place = |&p: &Vec2| map.place(view, p);
        let images: Vec<Vec2> = samples.iter().map(place).collect::<Option<_>>()?;
        let deviation =
            |(p, at): (&Vec2, &Vec2)| (*at - image.at - image.carried(*p - center)).length();
        let bent = samples.iter().zip(&images).map(deviation).fold(0.0, largest);
        let start = Rect::new(image.at, image.at);
        let bounds = images.iter().fold(start, |all, &p| all.union(&Rect::new(p, p)));
        let images = images[..n].to_vec();
        bounds.size().is_finite().then_some(Self {
            patch: 0,
            corners,
            center,
            image,
            images,
            bounds,
            bent,
            at_rim: false,
            faces: Vec::new(),
        })
    }

    /// True if the image is small, and nearly affine.
    pub(super) fn is_done(&self, view: &DeformedView<'_>) -> bool {
        let size = self.bounds.size() / view.view.pixel_size();
        let size = size.x.max(size.y);
        let largest = if self.at_rim { LARGEST_AT_RIM } else { LARGEST };
        size <= TINY || (size <= largest && self.bent <= BENT * view.view.pixel_size())
    }

    /// True if the image is too large for a part that a curve may cut, by the gradient: corners may
    /// lie on both sides of a jump.
    pub(super) fn is_coarse(&self, view: &DeformedView<'_>) -> bool {
        let reach = |&corner: &Vec2| self.image.carried(corner - self.center).length();
        let size = 2.0 * self.corners.iter().map(reach).fold(0.0, f64::max);
        size > LARGEST_AT_RIM * view.view.pixel_size()
    }

    /// False if the image lies far from the image.
    pub(super) fn may_be_seen(&self, view: &DeformedView<'_>) -> bool {
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
