//! A field as seen from an anchor: evaluation at one point, or at one vector of points.

use super::compiled::Field;
use super::functions::FunctionJets;
use crate::crack::{SegmentId, Side};
use crate::domain::{ALL_HEIGHTS, LocalDomain};
use crate::function::{LocalFunctions, Slot};
use crate::jet::Jet;
use crate::mesh::{ElementField, LocalMesh};
use crate::polynomial::polynomial;
use crate::vec2::{Rect, Vec2, vec2};
use ppum_formula::real::Real;
use std::sync::OnceLock;

/// A field seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalField<'f> {
    /// The field.
    pub field: &'f Field<'f>,
    /// The anchor.
    pub anchor: Vec2,
    /// The domain, formed when the first point asks for it: of rims with many sides that takes
    /// longer than an evaluation.
    domain: OnceLock<LocalDomain>,
    /// Heights above the anchor of the points that it is seen at.
    heights: [f64; 2],
    /// The hole whose rim it is seen on, which then belongs to the domain.
    touched_hole: Option<usize>,
    /// The segment that it is seen on.
    pub(crate) segment: Option<SegmentId>,
    /// The side of the segment that it is seen on that lies outside of the domain, if one does.
    pub(super) outer: Option<Side>,
    /// A way of a few roundings from the segment that it is seen on to the side above it; zero if
    /// on none. Where the segment runs along the boundary of a patch, on which the slope of its
    /// weight jumps, each face has the slopes on its side.
    above: Vec2,
    pub(super) functions: LocalFunctions<'f>,
    /// The elements, if the patches are those of a mesh.
    pub(super) mesh: Option<LocalMesh<'f>>,
    /// Memory for the patches around a point.
    pub(super) patches: Vec<u32>,
}

/// The partition of unity at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartitionOfUnity {
    /// S = Σ W_i with derivatives.
    pub weight_sum: Jet<f64>,
    /// Number of patches that cover the point.
    pub overlap: usize,
}

/// Way from a crack to its side, in parts of the domain's largest coordinate, at which slopes of
/// weights are taken there.
const ASIDE: f64 = 16.0 * f64::EPSILON;

/// Takes the values, not the derivatives, of other evaluations.
pub(super) fn take_values(out: &mut [Jet<f64>], others: &[Jet<f64>]) {
    out.iter_mut().zip(others).for_each(|(out, other)| out.v = other.v);
}

impl Field<'_> {
    /// The field as seen from an anchor.
    #[must_use]
    pub fn at(&self, anchor: Vec2) -> LocalField<'_> {
        LocalField::new(self, anchor, self.functions.at(&self.step.cracks, anchor))
    }

    /// The field as seen from the centre of a box, for points in the box.
    #[must_use]
    pub fn inside(&self, rect: &Rect) -> LocalField<'_> {
        let anchor = rect.center();
        let heights = [rect.min.y - anchor.y, rect.max.y - anchor.y];
        LocalField { heights, ..self.at(anchor) }
    }

    /// The field as seen from an anchor, for points on a segment of a crack: there an evaluation
    /// takes the requested side of this crack, wherever rounding has put the points. If a segment
    /// lies on the boundary of the domain, one side is outside, where there are no values.
    ///
    /// # Panics
    /// If there is no such segment.
    #[must_use]
    pub fn on(&self, segment: SegmentId, anchor: Vec2) -> LocalField<'_> {
        let functions = self.functions.on(&self.step.cracks, segment, anchor);
        let edge = self.step.cracks[segment.crack as usize].edge(segment.segment as usize);
        let line = self.domain.line_of(edge);
        let local = LocalField::new(self, anchor, functions);
        let touched_hole = line.and_then(|line| line.hole);
        let extent = self.domain.bounds.max_norm();
        let along = if edge.is_arc() { edge.tangent_towards(anchor) } else { edge.chord().unit() };
        let above = along.left() * (ASIDE * extent);
        let outer = line.map(|line| line.outer_side([edge.from, edge.to]));
        LocalField { segment: Some(segment), outer, above, touched_hole, ..local }
    }
}

impl<'f> LocalField<'f> {
    fn new(field: &'f Field<'f>, anchor: Vec2, functions: LocalFunctions<'f>) -> Self {
        let mesh = field.step.partition.mesh().map(|mesh| LocalMesh::new(field, mesh, anchor));
        let (domain, heights, patches) = (OnceLock::new(), ALL_HEIGHTS, Vec::new());
        let (touched_hole, outer, above) = (None, None, Vec2::ZERO);
        Self {
            field,
            anchor,
            domain,
            heights,
            touched_hole,
            segment: None,
            outer,
            above,
            functions,
            mesh,
            patches,
        }
    }

    fn domain(&self) -> &LocalDomain {
        let whole = || self.field.domain.between(self.anchor, self.heights);
        self.domain.get_or_init(|| whole().without_hole(self.touched_hole))
    }

    /// The functions as seen from the anchor.
    #[must_use]
    pub fn functions(&self) -> &LocalFunctions<'f> {
        &self.functions
    }

    /// True if `anchor + offset` lies in the closed domain; exact also where the sum would round.
    #[must_use]
    pub fn contains(&self, offset: Vec2) -> bool {
        match &self.mesh {
            Some(mesh) => mesh.owner(offset, Side::Above).is_some(),
            None => self.domain().contains(offset),
        }
    }

    /// Evaluates all components at `anchor + offset` with `D` derivatives (0, 1 or 2).
    ///
    /// On a crack the field of the given side is taken. Returns false, and leaves `out` alone,
    /// outside the domain. Cost: O(log N) to find the patches, then a few hundred operations
    /// a patch.
    ///
    /// # Panics
    /// If `out` is shorter than the number of components.
    pub fn evaluate<const D: usize>(
        &mut self,
        offset: Vec2,
        side: Side,
        out: &mut [Jet<f64>],
    ) -> bool {
        // entries that are not generic: kernels are compiled here, not where they are called
        match D {
            0 => self.values(offset, side, out),
            1 => self.gradients(offset, side, out),
            _ => self.hessians(offset, side, out),
        }
    }

    #[inline(never)]
    fn values(&mut self, offset: Vec2, side: Side, out: &mut [Jet<f64>]) -> bool {
        self.evaluated::<0>(offset, side, out)
    }

    #[inline(never)]
    fn gradients(&mut self, offset: Vec2, side: Side, out: &mut [Jet<f64>]) -> bool {
        self.evaluated::<1>(offset, side, out)
    }

    #[inline(never)]
    fn hessians(&mut self, offset: Vec2, side: Side, out: &mut [Jet<f64>]) -> bool {
        self.evaluated::<2>(offset, side, out)
    }

    fn evaluated<const D: usize>(
        &mut self,
        offset: Vec2,
        side: Side,
        out: &mut [Jet<f64>],
    ) -> bool {
        if self.mesh.is_some() {
            return self.on_mesh::<D>(offset, side, out).is_some();
        }
        if self.outer == Some(side) || !self.contains(offset) {
            return false;
        }
        let mut patches = std::mem::take(&mut self.patches);
        self.covering_any(&[offset], side, &mut patches);
        self.over_patches::<f64, D>([offset.x, offset.y], side, &patches, out);
        if self.is_sided::<D>() {
            let mut values = out.to_vec();
            self.over_patches::<f64, 0>([offset.x, offset.y], side, &patches, &mut values);
            take_values(out, &values);
        }
        self.patches = patches;
        true
    }

    /// The patch of the element that owns a point, or of boxes the one whose φ is largest there,
    /// the first of several; `None` outside.
    #[must_use]
    pub fn owner(&self, offset: Vec2, side: Side) -> Option<usize> {
        if let Some(mesh) = &self.mesh {
            return Some(mesh.owner(offset, side)?.patch);
        }
        if !self.domain().contains(offset) {
            return None;
        }
        let mut patches = Vec::new();
        self.field.tree.query_point(self.anchor + offset, &mut patches);
        patches.sort_unstable();
        let weight =
            |patch: u32| self.partition_weight::<f64, 0>(patch as usize, [offset.x, offset.y]).v;
        let all = patches.into_iter().map(|patch| (weight(patch), patch as usize));
        all.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, patch)| patch)
    }

    /// The field on one patch of a mesh; none of boxes, and of patches that there are not.
    #[must_use]
    pub fn element(&self, patch: usize) -> Option<ElementField<'_, 'f>> {
        ElementField::new(self.mesh.as_ref()?, &self.functions, patch)
    }

    /// True where the field was evaluated in the domain: on a mesh values say so, since finding the
    /// element is most of the work, and on a crack at the boundary, which has one face in the
    /// domain.
    #[must_use]
    pub(crate) fn has_values(&self, offset: Vec2, jets: &[Jet<f64>]) -> bool {
        let any = || jets.iter().any(|jet| !jet.v.is_nan());
        match &self.mesh {
            None => self.contains(offset) && (self.outer.is_none() || any()),
            Some(_) => any(),
        }
    }

    /// All components on the element that owns a point, and the number of its patch; `None`
    /// outside.
    pub(super) fn on_mesh<const D: usize>(
        &self,
        offset: Vec2,
        side: Side,
        out: &mut [Jet<f64>],
    ) -> Option<usize> {
        let mesh = self.mesh.as_ref()?;
        let place = mesh.owner(offset, side)?;
        let out = &mut out[..self.field.components()];
        mesh.evaluate::<D>(&place, &self.functions, (offset, side), out);
        Some(place.patch)
    }

    /// The partition of unity at `anchor + offset`; `None` outside the domain.
    pub fn covering<const D: usize>(&mut self, offset: Vec2) -> Option<PartitionOfUnity> {
        if !self.contains(offset) {
            return None;
        }
        if self.mesh.is_some() {
            return Some(PartitionOfUnity { weight_sum: Jet::constant(1.0), overlap: 1 });
        }
        let mut patches = std::mem::take(&mut self.patches);
        self.covering_any(&[offset], Side::Above, &mut patches);
        let weight = |&p: &u32| self.partition_weight::<f64, D>(p as usize, [offset.x, offset.y]);
        let zero = Jet::constant(0.0);
        let weight_sum = patches.iter().map(weight).fold(zero, Jet::plus::<D>);
        let overlap = patches.len();
        self.patches = patches;
        Some(PartitionOfUnity { weight_sum, overlap })
    }

    /// True if derivatives are those of a side, while values, which are continuous except for the
    /// functions, are those of the point itself.
    pub(super) fn is_sided<const D: usize>(&self) -> bool {
        D > 0 && self.above != Vec2::ZERO
    }

    /// The place at which weights are taken for `D` derivatives.
    #[inline(always)]
    fn aside<R: Real, const D: usize>(&self, [x, y]: [R; 2], side: Side) -> [R; 2] {
        if D == 0 {
            return [x, y];
        }
        let way = if side == Side::Above { self.above } else { -self.above };
        [x + x.broadcast(way.x), y + y.broadcast(way.y)]
    }

    /// The patches that cover at least one of the points, ascending.
    pub(super) fn covering_any(&self, offsets: &[Vec2], side: Side, patches: &mut Vec<u32>) {
        patches.clear();
        for &offset in offsets {
            let [x, y] = self.aside::<f64, 1>([offset.x, offset.y], side);
            self.field.tree.query_point(self.anchor + vec2(x, y), patches);
        }
        patches.sort_unstable();
        patches.dedup();
    }

    /// Evaluates over a given list of patches, which must hold all that cover the point.
    #[inline(always)]
    pub fn over_patches<R: Real, const D: usize>(
        &self,
        offset: [R; 2],
        side: Side,
        patches: &[u32],
        out: &mut [Jet<R>],
    ) {
        if self.mesh.is_some() {
            return self.over_elements::<R, D>(offset, side, patches, out);
        }
        let zero = Jet::constant(offset[0].broadcast(0.0));
        let mut functions = FunctionJets::new(&self.functions, offset, side);
        let aside = self.aside::<R, D>(offset, side);
        let components = self.field.components();
        out[..components].fill(zero);
        let mut weight_sum = zero;
        for &patch in patches {
            let patch = patch as usize;
            let weight = self.weight::<R, D>(patch, aside, patches.len() == 1);
            weight_sum = weight_sum.plus::<D>(weight);
            for (component, sum) in out[..components].iter_mut().enumerate() {
                let v = self.local_field::<R, D>(patch, component, offset, &mut functions);
                *sum = sum.plus::<D>(self.shared::<R, D>(patch, aside, weight.times::<D>(v)));
            }
        }
        for sum in &mut out[..components] {
            *sum = sum.over::<D>(weight_sum);
        }
    }

    /// As [`over_patches`](Self::over_patches), lane by lane: NaN where none of the patches holds a
    /// point.
    #[cold]
    fn over_elements<R: Real, const D: usize>(
        &self,
        offset: [R; 2],
        side: Side,
        patches: &[u32],
        out: &mut [Jet<R>],
    ) {
        let Some(mesh) = &self.mesh else { return };
        let (n, [x, y]) = (self.field.components(), offset.map(R::lanes));
        let mut jets = vec![Jet::NAN; R::LANES * n];
        for (lane, jets) in jets.chunks_mut(n).enumerate() {
            let offset = vec2(x[lane], y[lane]);
            if let Some(place) = mesh.owner_among(offset, side, patches) {
                mesh.evaluate::<D>(&place, &self.functions, (offset, side), jets);
            }
        }
        for (c, out) in out[..n].iter_mut().enumerate() {
            let number = |of: fn(&Jet<f64>) -> f64| offset[0].with_lanes(|k| of(&jets[k * n + c]));
            *out = Jet {
                v: number(|j| j.v),
                x: number(|j| j.x),
                y: number(|j| j.y),
                xx: number(|j| j.xx),
                xy: number(|j| j.xy),
                yy: number(|j| j.yy),
            };
        }
    }

    /// The part W_i v_i of a sum, zero on the lanes that the patch does not cover: there v_i need
    /// not have a value.
    #[inline(always)]
    fn shared<R: Real, const D: usize>(
        &self,
        patch: usize,
        offset: [R; 2],
        part: Jet<R>,
    ) -> Jet<R> {
        if R::LANES == 1 {
            return part;
        }
        let support = self.field.boxes.support(patch);
        let (lo, hi) = (support.min - self.anchor, support.max - self.anchor);
        let [x, y] = offset;
        let part = part.only::<D>(x.ge(x.broadcast(lo.x))).only::<D>(x.broadcast(hi.x).gt(x));
        part.only::<D>(y.ge(y.broadcast(lo.y))).only::<D>(y.broadcast(hi.y).gt(y))
    }

    /// W_i; constant 1 where the patch is alone, since φ_i = 1 there whatever W_i is.
    #[inline(always)]
    fn weight<R: Real, const D: usize>(&self, patch: usize, offset: [R; 2], alone: bool) -> Jet<R> {
        if alone {
            return Jet::constant(offset[0].broadcast(1.0));
        }
        self.partition_weight::<R, D>(patch, offset)
    }

    /// W_i at `anchor + offset` with derivatives.
    #[inline(always)]
    fn partition_weight<R: Real, const D: usize>(&self, patch: usize, offset: [R; 2]) -> Jet<R> {
        let partition = self.field.boxes;
        let half = partition.half[patch];
        let inverse = [1.0 / half.x, 1.0 / half.y];
        let xi = self.scaled(offset, partition.center[patch], inverse);
        partition.weight.tensor::<R, D>(xi, inverse)
    }

    /// The partition function φ_i = W_i / S of a patch, with derivatives: zero where the patch does
    /// not cover the point, `None` outside the domain.
    pub fn partition_function<const D: usize>(
        &mut self,
        patch: usize,
        offset: Vec2,
    ) -> Option<Jet<f64>> {
        if let Some(mesh) = &self.mesh {
            let owner = mesh.owner(offset, Side::Above)?.patch;
            return Some(Jet::constant(f64::from(u8::from(owner == patch))));
        }
        let PartitionOfUnity { weight_sum, .. } = self.covering::<D>(offset)?;
        let weight = self.partition_weight::<f64, D>(patch, [offset.x, offset.y]);
        Some(weight.over::<D>(weight_sum))
    }

    /// The local field v_i of one patch and component.
    #[inline(always)]
    fn local_field<R: Real, const D: usize>(
        &self,
        patch: usize,
        component: usize,
        offset: [R; 2],
        functions: &mut FunctionJets<'_, 'f, R>,
    ) -> Jet<R> {
        let (partition, data) = (self.field.boxes, self.field.data);
        let scale = partition.scale[patch];
        let inverse = [1.0 / scale.x, 1.0 / scale.y];
        let xi = self.scaled(offset, partition.origin[patch], inverse);
        let mut v = Jet::constant(offset[0].broadcast(0.0));
        for block in data.blocks(patch) {
            let coefficients = data.block_coefficients(block, component);
            let degree = data.block_degree[block] as usize;
            let p = polynomial::<R, D>(coefficients, degree, xi);
            let p = stretched::<R, D>(p, inverse);
            v = v.plus::<D>(match self.field.functions.of(data.block_function[block]) {
                Slot::One => p,
                slot => p.times::<D>(functions.jet::<D>(slot)),
            });
        }
        v
    }

    /// (anchor + offset − origin) · inverse; the difference of anchor and origin is formed in f64.
    #[inline(always)]
    fn scaled<R: Real>(&self, offset: [R; 2], origin: Vec2, inverse: [f64; 2]) -> [R; 2] {
        let d = self.anchor - origin;
        let one = offset[0].broadcast(1.0);
        [
            (offset[0] + one.broadcast(d.x)) * one.broadcast(inverse[0]),
            (offset[1] + one.broadcast(d.y)) * one.broadcast(inverse[1]),
        ]
    }
}

/// Chain rule for ξ = (x − origin) · inverse.
#[inline(always)]
fn stretched<R: Real, const D: usize>(p: Jet<R>, inverse: [f64; 2]) -> Jet<R> {
    let (ix, iy) = (p.v.broadcast(inverse[0]), p.v.broadcast(inverse[1]));
    let mut out = p;
    if D >= 1 {
        (out.x, out.y) = (p.x * ix, p.y * iy);
    }
    if D >= 2 {
        (out.xx, out.xy, out.yy) = (p.xx * ix * ix, p.xy * ix * iy, p.yy * iy * iy);
    }
    out
}
