//! From a place in the deformed plane to the point of the body.

use ppum::segment::{closest_point, sides};
use ppum::vec2::{Rect, Vec2};

use super::leaf::DeformedLeaf;
use super::map::{DeformationChart, Preimage};
use super::{DeformedView, TOLERANCE};
use crate::pieces::contains;

/// Most steps of Newton's method, and most halvings of one.
const STEPS: usize = 40;
const HALVINGS: usize = 8;
/// Where det F is smaller than this part of |F|² the body may fold inside a leaf.
const THIN: f64 = 0.1;
/// Between leaves, as seen from inside, there is less than this part of a pixel.
const GAP: f64 = 1e-3;
/// Arcs, rims of round holes and curved cuts lie behind the sides of pieces by less than this part
/// of a pixel.
const BEHIND: f64 = 0.3;

/// The inverse of a deformation on one leaf.
pub(super) struct LeafInverse<'a, 'f> {
    pub(super) view: &'a DeformedView<'f>,
    pub(super) leaf: &'a DeformedLeaf,
}

impl LeafInverse<'_, '_> {
    /// The place, widened by what the image is bent, in which images of the leaf lie.
    pub(super) fn reach(&self) -> Rect {
        let margin = self.margin();
        let margin = Vec2 { x: margin, y: margin };
        Rect::new(self.leaf.bounds.min - margin, self.leaf.bounds.max + margin)
    }

    fn margin(&self) -> f64 {
        let behind = if self.leaf.at_rim { BEHIND } else { 0.0 };
        2.0 * self.leaf.bent + (0.05 + behind) * self.view.view.pixel_size()
    }

    /// False if a place lies too far from the leaf's image.
    pub(super) fn may_hold(&self, place: Vec2) -> bool {
        let (images, pixel) = (&self.leaf.images, self.view.view.pixel_size());
        if self.leaf.bent > 0.3 * pixel {
            return true;
        }
        let sign = self.leaf.image.determinant().signum();
        sides(images).all(|[a, b]| {
            let along = (b - a) * sign;
            let length = along.length();
            // sides of no length hold everything
            length <= 1e-3 * pixel || along.cross(place - a) >= -self.margin() * length
        })
    }

    /// The point that moves to a place, if it lies in the leaf. Where the body folds Newton's
    /// method is started at the corners too.
    pub(super) fn find<C: DeformationChart>(&self, map: &mut C, place: Vec2) -> Option<Preimage> {
        let DeformedLeaf { corners, center, image, .. } = self.leaf;
        let start = image.pulled_back(place - image.at);
        let start = if start.is_finite() { *center + start } else { *center };
        let more = corners.iter().filter(|_| self.is_thin());
        std::iter::once(&start).chain(more).find_map(|start| self.newton(map, *start, place))
    }

    /// True if the body may fold inside the leaf.
    fn is_thin(&self) -> bool {
        let [a, b] = self.leaf.image.gradient;
        self.leaf.image.determinant().abs() < THIN * (a.dot(a) + b.dot(b))
    }

    /// A part of a pixel, or what places are rounded by if that is more.
    fn within(&self, part: f64) -> f64 {
        (part * self.view.view.pixel_size()).max(self.view.rounding())
    }

    fn newton<C: DeformationChart>(
        &self,
        map: &mut C,
        start: Vec2,
        place: Vec2,
    ) -> Option<Preimage> {
        let mut here = self.image(map, nearest(&self.leaf.corners, start))?;
        for _ in 0..STEPS {
            let miss = place - here.image.at;
            let step = here.image.pulled_back(miss);
            if miss.length() <= self.within(TOLERANCE)
                && contains(&self.leaf.corners, here.offset + step)
            {
                // the step is known already, and far smaller than a pixel
                return Some(Preimage { offset: here.offset + step, ..here });
            }
            if miss.length() <= self.within(GAP) {
                return Some(here);
            }
            if !step.is_finite() {
                here = self.image(map, (here.offset + self.leaf.center) * 0.5)?;
                continue;
            }
            let Some(nearer) = self.step(map, here, step, place) else { break };
            here = nearer;
        }
        // at a cusp of a fold steps lead nowhere
        let is_near = self.is_thin() && (place - here.image.at).length() <= self.within(TOLERANCE);
        if is_near { Some(here) } else { self.behind_rim(map, here, place) }
    }

    /// A step of Newton's method inside the leaf, shortened until it leads nearer to the place;
    /// none if it cannot.
    fn step<C: DeformationChart>(
        &self,
        map: &mut C,
        here: Preimage,
        step: Vec2,
        place: Vec2,
    ) -> Option<Preimage> {
        let target = nearest(&self.leaf.corners, here.offset + step);
        let way = target - here.offset;
        let miss = (place - here.image.at).length();
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let next = self.image(map, here.offset + way * part)?;
            if (place - next.image.at).length() < miss {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }

    /// A point of the body between a piece's side and the arc, round rim, or curved cut, that it
    /// stands for.
    fn behind_rim<C: DeformationChart>(
        &self,
        map: &mut C,
        mut here: Preimage,
        place: Vec2,
    ) -> Option<Preimage> {
        let pixel = self.view.view.pixel_size();
        if !self.leaf.at_rim {
            return None;
        }
        for _ in 0..4 {
            let miss = place - here.image.at;
            if miss.length() > BEHIND * pixel {
                return None;
            }
            if miss.length() <= self.within(GAP) {
                return map.goes_on(self.leaf.center, here.offset).then_some(here);
            }
            here = self.image(map, here.offset + here.image.pulled_back(miss))?;
        }
        None
    }

    fn image<C: DeformationChart>(&self, map: &mut C, offset: Vec2) -> Option<Preimage> {
        Some(Preimage { offset, image: map.image(self.view, offset)? })
    }
}

/// The point of a convex polygon that is nearest to a point.
fn nearest(corners: &[Vec2], p: Vec2) -> Vec2 {
    if contains(corners, p) {
        return p;
    }
    let nearer = |a: &Vec2, b: &Vec2| (*a - p).length().total_cmp(&(*b - p).length());
    sides(corners).map(|side| closest_point(side, p)).min_by(nearer).unwrap_or(p)
}
