//! One element of a mesh by its own coordinate, whoever owns its points.
//!
//! Code that follows a field on one element, up to its edges and to the lines that cut it, must not
//! search for the owner of each point: on an edge another element may own the point, and beside it
//! none does.

use std::borrow::Cow;

use super::evaluate::EvaluationPoint;
use super::local::{ElementView, LocalMesh, PatchLocation};
use super::map::PolynomialMap;
use crate::compensated::SumWithError;
use crate::crack::Side;
use crate::function::LocalFunctions;
use crate::jet::Jet;
use crate::vec2::{Vec2, vec2};

/// The field of one patch of a mesh, seen from an anchor.
///
/// Points are given by δ = ξ − ξ₀, where ξ₀ is the ξ of the anchor in elements beside it, so that
/// tiny offsets keep their digits, and 0 in all others. All is defined outside the reference shape
/// and beyond clips too, by the same polynomials.
#[derive(Debug)]
pub struct ElementField<'m, 'f> {
    mesh: &'m LocalMesh<'f>,
    functions: &'m LocalFunctions<'f>,
    seen: ElementView<'m>,
    map: Cow<'m, PolynomialMap>,
    /// M(δ) at the anchor.
    from: [SumWithError; 2],
}

/// A point of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementPoint {
    /// Offset from the anchor.
    pub offset: Vec2,
    /// The columns of DM: the derivatives of the offset by the two coordinates.
    pub columns: [Vec2; 2],
}

impl<'m, 'f> ElementField<'m, 'f> {
    /// The field on a patch.
    pub(crate) fn new(
        mesh: &'m LocalMesh<'f>,
        functions: &'m LocalFunctions<'f>,
        patch: usize,
    ) -> Option<Self> {
        if patch >= mesh.mesh.len() {
            return None;
        }
        let (near, from) = mesh.frame(patch);
        let seen = (patch, near);
        Some(Self { mesh, functions, seen, map: mesh.map_of(seen), from })
    }

    /// The index of the patch.
    #[must_use]
    pub fn patch(&self) -> usize {
        self.seen.0
    }

    /// δ of the corners of the reference shape, counter-clockwise.
    #[must_use]
    pub fn corners(&self) -> Vec<Vec2> {
        let [x, y] = self.reference();
        let corners = self.mesh.mesh.shape[self.seen.0].corners();
        corners.iter().map(|corner| vec2(corner[0] - x, corner[1] - y)).collect()
    }

    /// How far a point lies inside the reference shape, negative outside; see
    /// [`Shape::margin`](super::Shape::margin).
    #[must_use]
    pub fn margin(&self, delta: Vec2) -> f64 {
        self.mesh.mesh.shape[self.seen.0].margin(self.reference(), delta.into())
    }

    /// ξ₀
    fn reference(&self) -> [f64; 2] {
        self.seen.1.map_or([0.0; 2], |near| near.at)
    }

    /// The point of a coordinate.
    #[must_use]
    pub fn point(&self, delta: Vec2) -> ElementPoint {
        let [x, y] = self.map.at::<f64, 1>(delta.into());
        let part = |value: f64, from: SumWithError| (value - from.0) - from.1;
        let offset = vec2(part(x.v, self.from[0]), part(y.v, self.from[1]));
        ElementPoint { offset, columns: [vec2(x.x, y.x), vec2(x.y, y.y)] }
    }

    /// Evaluates all components with `D` derivatives in the world at a [point](Self::point). Where
    /// a level field or the distance from a crack is zero, those of the given side.
    ///
    /// # Panics
    /// If `out` is shorter than the number of components.
    pub fn evaluate<const D: usize>(&self, place: (Vec2, Vec2), side: Side, out: &mut [Jet<f64>]) {
        // entries that are not generic: kernels are compiled here, not where they are called
        match D {
            0 => self.values(place, side, out),
            1 => self.gradients(place, side, out),
            _ => self.hessians(place, side, out),
        }
    }

    #[inline(never)]
    fn values(&self, place: (Vec2, Vec2), side: Side, out: &mut [Jet<f64>]) {
        self.evaluated::<0>(place, side, out);
    }

    #[inline(never)]
    fn gradients(&self, place: (Vec2, Vec2), side: Side, out: &mut [Jet<f64>]) {
        self.evaluated::<1>(place, side, out);
    }

    #[inline(never)]
    fn hessians(&self, place: (Vec2, Vec2), side: Side, out: &mut [Jet<f64>]) {
        self.evaluated::<2>(place, side, out);
    }

    fn evaluated<const D: usize>(
        &self,
        (delta, offset): (Vec2, Vec2),
        side: Side,
        out: &mut [Jet<f64>],
    ) {
        let at = EvaluationPoint { delta: delta.into(), offset: offset.into(), side };
        let out = &mut out[..self.mesh.field.components()];
        self.mesh.evaluate_at::<f64, D>((self.seen, &self.map), self.functions, &at, out);
    }

    /// True if the clips of the patch hold at a coordinate; where a level field is zero, if they do
    /// on the given side.
    #[must_use]
    pub fn is_kept(&self, delta: Vec2, side: Side) -> bool {
        let (patch, near) = self.seen;
        self.mesh.is_kept(&PatchLocation { patch, delta: delta.into(), near }, side)
    }

    /// The value of a level field of the step, by its index.
    ///
    /// # Panics
    /// If clips and functions name no such level field.
    #[must_use]
    pub fn level(&self, field: usize, delta: Vec2) -> f64 {
        self.mesh.level::<f64, 0>(self.seen, field, delta.into()).v
    }
}
