//! A mesh as seen from an anchor: who owns a point.
//!
//! An element beside the anchor is seen from the ξ of the anchor: its map, its blocks and its level
//! fields are polynomials in δ = ξ − at, and M(at + δ) − M(at) has no constant, so offsets of any
//! size are solved without cancellation.

use std::collections::BTreeMap;

use super::elements::Mesh;
use super::map::{MapInverse, TOLERANCE};
use super::shape::ShapeEdge;
use super::taylor::DensePolynomial;
use crate::compensated::{SumWithError, difference, minus};
use crate::crack::Side;
use crate::dataset::FieldData;
use crate::field::Field;
use crate::vec2::{Rect, Vec2};
use ppum_formula::real::Real;

/// The elements of a field's step seen from an anchor.
#[derive(Clone, Debug)]
pub(crate) struct LocalMesh<'f> {
    pub(super) field: &'f Field<'f>,
    pub(super) mesh: &'f Mesh,
    pub(super) anchor: Vec2,
    near: BTreeMap<u32, NearElement>,
}

/// An element beside the anchor.
#[derive(Clone, Debug)]
pub(super) struct NearElement {
    /// The ξ of the anchor, except for rounding.
    pub(super) at: [f64; 2],
    /// The map in δ.
    pub(super) inverse: MapInverse,
    /// anchor − origin − M(at): what rounding leaves.
    pub(super) rest: [SumWithError; 2],
    /// The fields that are used, by their index: coefficients in δ of the patch's blocks, for each
    /// component one block after the other.
    fields: BTreeMap<usize, Vec<f64>>,
}

/// A place in a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PatchLocation<'m> {
    pub(crate) patch: usize,
    /// ξ = at + δ, at = 0 for elements that are not near.
    pub(super) delta: [f64; 2],
    pub(super) near: Option<&'m NearElement>,
}

/// A patch, ready to be asked for many points.
pub(super) struct Candidate<'m> {
    pub(super) patch: usize,
    pub(super) near: Option<&'m NearElement>,
    /// The inverse of the element's map; `None` if the map is singular at ξ = 0.
    pub(super) inverse: Option<MapInverse>,
    /// anchor − origin.
    pub(super) from_origin: [SumWithError; 2],
    /// A box around the patch and what lies beside it, from the anchor.
    reach: Rect,
}

impl<'f> LocalMesh<'f> {
    pub(crate) fn new(field: &'f Field<'f>, mesh: &'f Mesh, anchor: Vec2) -> Self {
        let (mut beside, mut near) = (Vec::new(), BTreeMap::new());
        field.tree.query_point(anchor, &mut beside);
        for patch in beside {
            if let Some(element) = NearElement::new(field, mesh, patch as usize, anchor) {
                near.insert(patch, element);
            }
        }
        Self { field, mesh, anchor, near }
    }

    /// The owner of `anchor + offset`; `None` outside.
    pub(crate) fn owner(&self, offset: Vec2, side: Side) -> Option<PatchLocation<'_>> {
        let mut patches = Vec::new();
        self.field.tree.query_point(self.anchor + offset, &mut patches);
        self.owner_among(offset, side, &patches)
    }

    /// The owner of a point among some patches, ascending.
    pub(crate) fn owner_among(
        &self,
        offset: Vec2,
        side: Side,
        patches: &[u32],
    ) -> Option<PatchLocation<'_>> {
        let all = patches.iter().map(|&patch| self.candidate(patch));
        self.first(side, all.map(|candidate| self.location(&candidate, offset, None)))
    }

    /// The first of some places that lies in its patch; if none does, the one that misses it by the
    /// least, by no more than rounding.
    #[inline]
    pub(super) fn first<'m>(
        &self,
        side: Side,
        places: impl Iterator<Item = Option<PatchLocation<'m>>>,
    ) -> Option<PatchLocation<'m>> {
        let mut best: Option<(f64, PatchLocation<'m>)> = None;
        for place in places.flatten() {
            let margin = self.margin(&place);
            let is_better = match best {
                Some((most, _)) => margin > most,
                None => margin >= -TOLERANCE,
            };
            if !is_better || !self.is_kept(&place, side) {
                continue;
            }
            if margin >= 0.0 {
                return Some(place);
            }
            best = Some((margin, place));
        }
        best.map(|(_, place)| place)
    }

    /// A patch as it is seen from the anchor, and M(δ) there.
    pub(super) fn frame(&self, patch: usize) -> (Option<&NearElement>, [SumWithError; 2]) {
        let near = self.near.get(&(patch as u32));
        let from = near.map_or_else(|| self.anchor_from_origin(patch), |near| near.rest);
        (near, from)
    }

    /// anchor − origin
    fn anchor_from_origin(&self, patch: usize) -> [SumWithError; 2] {
        let origin = self.mesh.origin[patch];
        [difference(self.anchor.x, origin.x), difference(self.anchor.y, origin.y)]
    }

    pub(super) fn candidate(&self, patch: u32) -> Candidate<'_> {
        let (k, near) = (patch as usize, self.near.get(&patch));
        let from_origin = self.anchor_from_origin(k);
        let (reach, inverse) = (self.mesh.reach(k), MapInverse::new(self.mesh.map(k)));
        let reach = Rect::new(reach.min - self.anchor, reach.max - self.anchor);
        Candidate { patch: k, near, inverse, from_origin, reach }
    }

    /// The place of a point in a patch's shape, or just beside it.
    #[inline]
    pub(super) fn location<'m>(
        &self,
        candidate: &Candidate<'m>,
        offset: Vec2,
        start: Option<[f64; 2]>,
    ) -> Option<PatchLocation<'m>> {
        let patch = candidate.patch;
        if !candidate.reach.contains(offset) {
            return None;
        }
        if let Some(near) = candidate.near
            && let Some(delta) = near.inverse.near(moved(&near.rest, offset.into()))
        {
            return Some(PatchLocation { patch, delta, near: Some(near) });
        }
        let t = moved(&candidate.from_origin, offset.into());
        let delta = candidate.inverse.as_ref()?.at(self.mesh.shape[patch], t, start)?;
        Some(PatchLocation { patch, delta, near: None })
    }

    #[inline]
    pub(super) fn margin(&self, place: &PatchLocation<'_>) -> f64 {
        let at = place.near.map_or([0.0; 2], |near| near.at);
        self.mesh.shape[place.patch].margin(at, place.delta)
    }

    /// True if the patch's clips hold at a place.
    #[inline]
    pub(super) fn is_kept(&self, place: &PatchLocation<'_>, side: Side) -> bool {
        self.clipped((place.patch, place.near), place.delta, (1.0, side)) > 0.0
    }

    /// The margins of places in a patch where its clips hold, else −1.
    #[inline(always)]
    pub(super) fn clipped<R: Real>(
        &self,
        seen: ElementView<'_>,
        delta: [R; 2],
        (mut margin, side): (R, Side),
    ) -> R {
        for clip in self.mesh.clips(seen.0) {
            let level = self.level::<R, 0>(seen, clip.field as usize, delta).v;
            let kept = sign(level, side) * level.broadcast(if clip.is_above { 1.0 } else { -1.0 });
            margin = R::select(kept.gt(level.broadcast(0.0)), margin, level.broadcast(-1.0));
        }
        margin
    }
}

/// A point that is moved by an offset.
#[inline(always)]
pub(super) fn moved<R: Real>(from: &[SumWithError; 2], offset: [R; 2]) -> [(R, R); 2] {
    let [x, y] = offset;
    let (p, q) = (difference(x.broadcast(from[0].0), -x), difference(y.broadcast(from[1].0), -y));
    [(p.0, p.1 + x.broadcast(from[0].1)), (q.0, q.1 + y.broadcast(from[1].1))]
}

impl Candidate<'_> {
    /// A box around the patch and what lies beside it, from the anchor.
    pub(super) fn reach(&self) -> Rect {
        self.reach
    }

    /// Half-planes a + b x + c y ≥ 0 of offsets, |b| = 1 or b = 0, that hold all of the patch, and
    /// what lies just beside it: those of the edges for the linear part of the map, farther out
    /// by κ. `far` is the farthest that offsets are looked at.
    #[inline]
    pub(super) fn half_planes(&self, mesh: &Mesh, far: Vec2) -> [Option<ShapeEdge>; 4] {
        let mut planes = [None; 4];
        let Some(inverse) = &self.inverse else { return planes };
        let [u, v] = self.from_origin.map(|t| t.0 + t.1);
        for (plane, &[a, x, y]) in planes.iter_mut().zip(mesh.shape[self.patch].edges()) {
            let [b, c] = inverse.slopes([x, y]);
            let rounding = 1e-14 * (b.abs() * (u.abs() + far.x) + c.abs() * (v.abs() + far.y));
            let size = if b == 0.0 { 1.0 } else { b.abs().recip() };
            let constant = a + b * u + c * v + inverse.beyond() + rounding;
            *plane = Some([constant * size, b * size, c * size]);
        }
        planes
    }
}

impl NearElement {
    fn new(field: &Field<'_>, mesh: &Mesh, patch: usize, anchor: Vec2) -> Option<Self> {
        let origin = mesh.origin[patch];
        let t = [difference(anchor.x, origin.x), difference(anchor.y, origin.y)];
        let map = mesh.map(patch);
        let at = MapInverse::new(map.clone())?.beside(mesh.shape[patch], t)?;
        let (map, constant) = map.shifted(at);
        let rest = [minus(t[0], constant[0]), minus(t[1], constant[1])];
        let used = field.levels.iter().copied().chain([field.index]);
        let fields = used.map(|k| (k, shifted(&field.step.fields[k], patch, at))).collect();
        Some(Self { at, inverse: MapInverse::new(map)?, rest, fields })
    }

    /// The coefficients in δ of the patch's `k`-th block.
    #[inline]
    pub(super) fn coefficients(
        &self,
        data: &FieldData,
        field: usize,
        (patch, k): (usize, usize),
        component: usize,
    ) -> &[f64] {
        let blocks = data.blocks(patch);
        let all: usize = blocks.clone().map(|block| data.block_size(block)).sum();
        let first: usize = blocks.take(k).map(|block| data.block_size(block)).sum();
        &self.fields[&field][component * all + first..]
    }
}

/// The coefficients of a patch's blocks as seen from `at`.
fn shifted(data: &FieldData, patch: usize, at: [f64; 2]) -> Vec<f64> {
    let mut out = Vec::new();
    for component in 0..data.coefficients.len() {
        for block in data.blocks(patch) {
            let (space, degree) = (data.space(block), data.block_degree[block].into());
            let mut dense =
                DensePolynomial::new(space, degree, data.block_coefficients(block, component));
            dense.shift(at);
            let start = out.len();
            out.resize(start + space.size(degree), 0.0);
            dense.store(space, degree, &mut out[start..]);
        }
    }
    out
}

/// A patch as it is, or as seen from a ξ beside the anchor.
pub(super) type ElementView<'m> = (usize, Option<&'m NearElement>);

/// +1 where a level field is positive, −1 where it is negative; where it is zero, that of the side.
#[inline(always)]
pub(super) fn sign<R: Real>(level: R, side: Side) -> R {
    let zero = level.broadcast(0.0);
    let is_above = match side {
        Side::Above => level.ge(zero),
        Side::Below => level.gt(zero),
    };
    R::sign(is_above, level.broadcast(1.0))
}
