//! A mesh as seen from an anchor: who owns a point, and what the field is there.
//!
//! An element beside the anchor is seen from the ξ of the anchor: its map, its blocks and its level fields are polynomials in
//! δ = ξ − at, and M(at + δ) − M(at) has no constant, so offsets of any size are solved without cancellation.

use std::collections::BTreeMap;

use super::Mesh;
use super::map::{Image, Map, Matrix, TOLERANCE};
use super::taylor::Dense;
use crate::compensated::{difference, minus, plus};
use crate::crack::{Side, TipPoint};
use crate::dataset::FieldData;
use crate::field::Field;
use crate::function::{GROUP, LevelUse, LocalFunctions, Slot};
use crate::jet::Jet;
use crate::polynomial::polynomial_in;
use crate::vec2::{Rect, Vec2};

/// Part of its own size by which the box of an element is larger than what holds it: who looks for the elements at an
/// anchor finds those beside it, too.
const BESIDE: f64 = 1.0 / 32.0;

/// A box that holds a patch and what lies beside it.
pub(crate) fn reach(mesh: &Mesh, patch: usize) -> Rect {
    let bounds = mesh.bounds(patch);
    let margin = bounds.size() * BESIDE;
    Rect::new(bounds.min - margin, bounds.max + margin)
}

/// The elements of a field's step seen from an anchor.
#[derive(Clone, Debug)]
pub(crate) struct LocalMesh<'f> {
    field: &'f Field<'f>,
    mesh: &'f Mesh,
    anchor: Vec2,
    near: BTreeMap<u32, Near>,
}

/// An element beside the anchor.
#[derive(Clone, Debug)]
struct Near {
    /// The ξ of the anchor, but for rounding.
    at: [f64; 2],
    map: Map,
    /// anchor − origin − M(at): what rounding leaves.
    rest: [(f64, f64); 2],
    /// The fields that are used, by their index: coefficients in δ of the patch's blocks, for each component one block after
    /// the other.
    fields: BTreeMap<usize, Vec<f64>>,
}

/// A place in a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Location<'m> {
    pub(crate) patch: usize,
    /// ξ = at + δ, at = 0 for elements that are not near.
    delta: [f64; 2],
    near: Option<&'m Near>,
}

impl<'f> LocalMesh<'f> {
    pub(crate) fn new(field: &'f Field<'f>, mesh: &'f Mesh, anchor: Vec2) -> Self {
        let (mut beside, mut near) = (Vec::new(), BTreeMap::new());
        field.tree.query_point(anchor, &mut beside);
        for patch in beside {
            if let Some(element) = Near::new(field, mesh, patch as usize, anchor) {
                near.insert(patch, element);
            }
        }
        Self { field, mesh, anchor, near }
    }

    /// The patches whose boxes hold a point.
    fn candidates(&self, offset: Vec2) -> Vec<u32> {
        let mut patches = Vec::new();
        self.field.tree.query_point(self.anchor + offset, &mut patches);
        patches
    }

    /// The owner of `anchor + offset`; `None` outside.
    pub(crate) fn owner(&self, offset: Vec2, side: Side) -> Option<Location<'_>> {
        self.owner_among(offset, side, &self.candidates(offset))
    }

    /// The first of some patches, ascending, that holds a point; if none does, the one that misses it by the least, by no more
    /// than rounding.
    pub(crate) fn owner_among(
        &self,
        offset: Vec2,
        side: Side,
        patches: &[u32],
    ) -> Option<Location<'_>> {
        let mut best: Option<(f64, Location<'_>)> = None;
        for &patch in patches {
            let Some(place) = self.place(patch as usize, offset) else { continue };
            let margin = self.margin(&place);
            let is_better = margin >= best.as_ref().map_or(-TOLERANCE, |(most, _)| *most);
            if !is_better || !self.is_kept(&place, side) {
                continue;
            }
            if margin >= 0.0 {
                return Some(place);
            }
            if best.as_ref().is_none_or(|(most, _)| margin > *most) {
                best = Some((margin, place));
            }
        }
        best.map(|(_, place)| place)
    }

    /// The place of a point in a patch's shape, or just beside it.
    fn place(&self, patch: usize, offset: Vec2) -> Option<Location<'_>> {
        if let Some(near) = self.near.get(&(patch as u32)) {
            let t = [plus((offset.x, 0.0), near.rest[0]), plus((offset.y, 0.0), near.rest[1])];
            if let Some(delta) = near.map.near(t) {
                return Some(Location { patch, delta, near: Some(near) });
            }
        }
        let origin = self.mesh.origin[patch];
        let from = |anchor, origin, offset| plus(difference(anchor, origin), (offset, 0.0));
        let t = [from(self.anchor.x, origin.x, offset.x), from(self.anchor.y, origin.y, offset.y)];
        let delta = self.mesh.map(patch).inverse(self.mesh.shape[patch], t)?;
        Some(Location { patch, delta, near: None })
    }

    fn margin(&self, place: &Location<'_>) -> f64 {
        let at = place.near.map_or([0.0; 2], |near| near.at);
        self.mesh.shape[place.patch].margin(at, place.delta)
    }

    /// True if the patch's clips hold at a place.
    fn is_kept(&self, place: &Location<'_>, side: Side) -> bool {
        self.mesh.clips(place.patch).iter().all(|clip| {
            let level = self.level::<0>(place, clip.field as usize).v;
            is_above(level, side) == clip.is_above
        })
    }

    /// A level field in δ.
    fn level<const D: usize>(&self, place: &Location<'_>, field: usize) -> Jet<f64> {
        let blocks = self.field.step.fields[field].blocks(place.patch);
        let mut sum = Jet::constant(0.0);
        for (k, block) in blocks.enumerate() {
            sum = sum.plus::<D>(self.block::<D>(place, field, (k, block), 0));
        }
        sum
    }

    /// The polynomial in δ of the patch's `k`-th block, which has the number `block`.
    fn block<const D: usize>(
        &self,
        place: &Location<'_>,
        field: usize,
        (k, block): (usize, usize),
        component: usize,
    ) -> Jet<f64> {
        let data = &self.field.step.fields[field];
        let (space, degree) = (data.space(block), data.block_degree[block].into());
        let coefficients = match place.near {
            None => data.block_coefficients(block, component),
            Some(near) => near.coefficients(data, field, (place.patch, k), component),
        };
        polynomial_in::<f64, D>(space, coefficients, degree, place.delta)
    }

    /// All components of the field at a place, with derivatives in the world.
    pub(crate) fn evaluate<const D: usize>(
        &self,
        place: &Location<'_>,
        functions: &LocalFunctions<'_>,
        (offset, side): (Vec2, Side),
        out: &mut [Jet<f64>],
    ) {
        let map = place.near.map_or_else(|| self.mesh.map(place.patch), |near| near.map.clone());
        let world = World::new(&map.at::<D>(place.delta));
        let mut known = Functions {
            mesh: self,
            place,
            functions,
            world: &world,
            offset,
            side,
            groups: Vec::new(),
        };
        let (own, data) = (self.field.index, self.field.data);
        for (component, out) in out.iter_mut().enumerate() {
            let (mut smooth, mut others) = (Jet::constant(0.0), Jet::constant(0.0));
            for (k, block) in data.blocks(place.patch).enumerate() {
                let p = self.block::<D>(place, own, (k, block), component);
                match self.field.functions.of(data.block_function[block]) {
                    Slot::One => smooth = smooth.plus::<D>(p),
                    Slot::Jet { group, entry } => {
                        let f = known.jet::<D>(group, entry as usize);
                        others = others.plus::<D>(world.jet::<D>(p).times::<D>(f));
                    }
                }
            }
            *out = world.jet::<D>(smooth).plus::<D>(others);
        }
    }
}

/// True on the side where a level field is positive; where it is zero, on that which is asked for.
fn is_above(level: f64, side: Side) -> bool {
    level > 0.0 || (level == 0.0 && side == Side::Above)
}

impl Near {
    fn new(field: &Field<'_>, mesh: &Mesh, patch: usize, anchor: Vec2) -> Option<Self> {
        let origin = mesh.origin[patch];
        let t = [difference(anchor.x, origin.x), difference(anchor.y, origin.y)];
        let map = mesh.map(patch);
        let at = map.beside(mesh.shape[patch], t)?;
        let (map, constant) = map.shifted(at);
        let rest = [minus(t[0], constant[0]), minus(t[1], constant[1])];
        let used = field.levels.iter().copied().chain([field.index]);
        let fields = used.map(|k| (k, shifted(&field.step.fields[k], patch, at))).collect();
        Some(Self { at, map, rest, fields })
    }

    fn coefficients(
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
            let mut dense = Dense::new(space, degree, data.block_coefficients(block, component));
            dense.shift(at);
            let start = out.len();
            out.resize(start + space.size(degree), 0.0);
            dense.store(space, degree, &mut out[start..]);
        }
    }
    out
}

/// The chain rule from ξ to the world: G = DM⁻¹, ∇v = Gᵀ ∇_ξ v, ∇²v = Gᵀ (∇²_ξ v − Σ_i ∂v/∂x_i ∇²_ξ x_i) G.
struct World {
    image: Image,
    /// Gᵀ.
    transposed: Matrix,
}

impl World {
    fn new(image: &Image) -> Self {
        let [x, y] = image;
        // the inverse of the transposed is the transposed of the inverse
        let none = Matrix([[f64::NAN; 2]; 2]);
        let transposed = Matrix([[x.x, y.x], [x.y, y.y]]).inverse().unwrap_or(none);
        Self { image: *image, transposed }
    }

    fn jet<const D: usize>(&self, v: Jet<f64>) -> Jet<f64> {
        let mut out = Jet::constant(v.v);
        if D >= 1 {
            [out.x, out.y] = self.transposed.times([v.x, v.y]);
        }
        if D >= 2 {
            let [x, y] = &self.image;
            let less = |v: f64, x: f64, y: f64| v - out.x * x - out.y * y;
            let (xx, xy, yy) =
                (less(v.xx, x.xx, y.xx), less(v.xy, x.xy, y.xy), less(v.yy, x.yy, y.yy));
            let Matrix([[a, b], [c, d]]) = self.transposed;
            out.xx = a * a * xx + 2.0 * a * b * xy + b * b * yy;
            out.xy = a * c * xx + (a * d + b * c) * xy + b * d * yy;
            out.yy = c * c * xx + 2.0 * c * d * xy + d * d * yy;
        }
        out
    }
}

/// The functions at one place, each group evaluated once.
struct Functions<'a, 'f, 't> {
    mesh: &'a LocalMesh<'f>,
    place: &'a Location<'a>,
    functions: &'a LocalFunctions<'t>,
    world: &'a World,
    offset: Vec2,
    side: Side,
    groups: Vec<(u32, [Jet<f64>; GROUP])>,
}

impl Functions<'_, '_, '_> {
    fn jet<const D: usize>(&mut self, group: u32, entry: usize) -> Jet<f64> {
        if let Some((_, jets)) = self.groups.iter().find(|(known, _)| *known == group) {
            return jets[entry];
        }
        let jets = self.evaluate::<D>(group as usize);
        self.groups.push((group, jets));
        jets[entry]
    }

    fn evaluate<const D: usize>(&self, group: usize) -> [Jet<f64>; GROUP] {
        let mut jets = [Jet::constant(0.0); GROUP];
        match self.functions.table().level_use(group) {
            None => {
                let offset = [self.offset.x, self.offset.y];
                self.functions.evaluate::<f64, D>(group, offset, self.side, &mut jets);
            }
            Some(LevelUse::Sign(field)) => {
                let level = self.mesh.level::<0>(self.place, field as usize).v;
                jets[0].v = if is_above(level, self.side) { 1.0 } else { -1.0 };
            }
            Some(LevelUse::Frame(fields)) => {
                let [x, y] = fields.map(|field| {
                    self.world.jet::<D>(self.mesh.level::<D>(self.place, field as usize))
                });
                let sign = if is_above(y.v, self.side) { 1.0 } else { -1.0 };
                let point = TipPoint { x: x.v, y: y.v, sign, branch: 1.0 };
                let at = (self.offset, self.side);
                self.functions.evaluate_in_frame::<D>(group, &point, at, &mut jets);
                jets = jets.map(|f| composed::<D>(f, x, y));
            }
        }
        jets
    }
}

/// f(x(p), y(p)) by the chain rule, for f with derivatives by x and y.
fn composed<const D: usize>(f: Jet<f64>, x: Jet<f64>, y: Jet<f64>) -> Jet<f64> {
    let mut out = Jet::constant(f.v);
    if D >= 1 {
        (out.x, out.y) = (f.x * x.x + f.y * y.x, f.x * x.y + f.y * y.y);
    }
    if D >= 2 {
        let curved = |x: f64, y: f64| f.x * x + f.y * y;
        let twice = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            f.xx * a * b + f.xy * (a * d + b * c) + f.yy * c * d
        };
        out.xx = curved(x.xx, y.xx) + twice([x.x, x.x], [y.x, y.x]);
        out.xy = curved(x.xy, y.xy) + twice([x.x, x.y], [y.x, y.y]);
        out.yy = curved(x.yy, y.yy) + twice([x.y, x.y], [y.y, y.y]);
    }
    out
}
