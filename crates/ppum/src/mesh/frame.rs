//! An element as seen from a point, and the places of many points in it.

use super::elements::Mesh;
use super::local::{Candidate, ElementView, moved};
use super::map::{MapInverse, NEAR, TOLERANCE, largest};
use super::shape::Shape;
use crate::compensated::SumWithError;
use ppum_formula::real::Real;

/// An element as it is, or as seen from a ξ beside the anchor.
pub(super) struct SeenElement<'a, 'm> {
    pub(super) seen: ElementView<'m>,
    pub(super) inverse: &'a MapInverse,
    shape: Shape,
    /// ξ = at + δ
    at: [f64; 2],
    /// The value of M(δ) at the anchor.
    from: &'a [SumWithError; 2],
}

/// The places of points on lanes.
pub(super) struct LanePlaces<R> {
    pub(super) delta: [R; 2],
    pub(super) margin: R,
    /// Negative where δ is not sure to be the place in the shape, or to be the only one.
    pub(super) certainty: R,
}

impl<'m> Candidate<'m> {
    /// The element as seen from the anchor if that is near, then as it is; none of singular maps.
    pub(super) fn frames(&self, mesh: &Mesh) -> impl Iterator<Item = SeenElement<'_, 'm>> {
        let (patch, shape) = (self.patch, mesh.shape[self.patch]);
        let near = self.near.map(|near| {
            let (at, inverse, from) = (near.at, &near.inverse, &near.rest);
            SeenElement { seen: (patch, Some(near)), inverse, shape, at, from }
        });
        let own = self.inverse.as_ref().map(|inverse| {
            let (at, from) = ([0.0; 2], &self.from_origin);
            SeenElement { seen: (patch, None), inverse, shape, at, from }
        });
        near.into_iter().chain(own)
    }
}

impl SeenElement<'_, '_> {
    /// The places of offsets from the anchor.
    #[inline(always)]
    pub(super) fn places<R: Real>(&self, offset: [R; 2]) -> LanePlaces<R> {
        let (delta, certainty) = self.inverse.solve(moved(self.from, offset));
        let margin = self.shape.margin(self.at, delta);
        let (zero, one) = (margin.broadcast(0.0), margin.broadcast(1.0));
        let decided = match self.seen.1 {
            Some(_) => one.broadcast(NEAR) - largest(delta),
            None => {
                let is_only = self.inverse.uniqueness(delta).gt(zero);
                R::select(margin.ge(one.broadcast(-TOLERANCE)), one, R::sign(is_only, one))
            }
        };
        let certainty = R::select(certainty.ge(zero), decided, -one);
        LanePlaces { delta, margin, certainty }
    }
}
