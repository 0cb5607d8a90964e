//! The field on one element: polynomials of ξ, functions of the world and of level fields, the
//! chain rule.

use std::borrow::Cow;

use super::local::{ElementView, LocalMesh, PatchLocation, sign};
use super::map::PolynomialMap;
use crate::crack::{Side, TipPoint};
use crate::function::{GROUP, LevelUse, LocalFunctions, Slot};
use crate::jet::Jet;
use crate::polynomial::polynomial_in;
use crate::vec2::Vec2;
use ppum_formula::real::Real;

impl LocalMesh<'_> {
    /// All components of the field at a place, with derivatives in the world.
    pub(crate) fn evaluate<const D: usize>(
        &self,
        place: &PatchLocation<'_>,
        functions: &LocalFunctions<'_>,
        (offset, side): (Vec2, Side),
        out: &mut [Jet<f64>],
    ) {
        let at = EvaluationPoint { delta: place.delta, offset: offset.into(), side };
        let seen = (place.patch, place.near);
        self.evaluate_at::<f64, D>((seen, &self.map_of(seen)), functions, &at, out);
    }

    /// The map of a patch in δ.
    pub(super) fn map_of<'m>(&self, (patch, near): ElementView<'m>) -> Cow<'m, PolynomialMap> {
        match near {
            Some(near) => Cow::Borrowed(&near.inverse.map),
            None => Cow::Owned(self.mesh.map(patch)),
        }
    }

    /// Evaluates at a vector of places in one patch, with its map in δ.
    #[inline(always)]
    pub(super) fn evaluate_at<R: Real, const D: usize>(
        &self,
        (seen, map): (ElementView<'_>, &PolynomialMap),
        functions: &LocalFunctions<'_>,
        at: &EvaluationPoint<R>,
        out: &mut [Jet<R>],
    ) {
        let world = ElementJacobian::new(map.at::<R, D>(at.delta));
        let (own, data) = (self.field.index, self.field.data);
        let zero = Jet::constant(at.delta[0].broadcast(0.0));
        let mut known: Vec<(u32, [Jet<R>; GROUP])> = Vec::new();
        let mut component = 0;
        while component < out.len() {
            let (mut smooth, mut others) = (zero, zero);
            let first = data.blocks(seen.0).start;
            for block in data.blocks(seen.0) {
                let p = self.block::<R, D>(seen, (own, block - first, block), component, at.delta);
                match self.field.functions.of(data.block_function[block]) {
                    Slot::One => smooth = smooth.plus::<D>(p),
                    Slot::Jet { group, entry } => {
                        let found = known.iter().position(|(other, _)| *other == group);
                        let index = found.unwrap_or(known.len());
                        if found.is_none() {
                            let jets =
                                self.group::<R, D>(seen, functions, at, &world, group as usize);
                            known.push((group, jets));
                        }
                        let f = known[index].1[entry as usize];
                        others = others.plus::<D>(world.jet::<D>(p).times::<D>(f));
                    }
                }
            }
            out[component] = world.jet::<D>(smooth).plus::<D>(others);
            component += 1;
        }
    }

    /// A level field in δ.
    #[inline(always)]
    pub(super) fn level<R: Real, const D: usize>(
        &self,
        seen: ElementView<'_>,
        field: usize,
        delta: [R; 2],
    ) -> Jet<R> {
        let blocks = self.field.step.fields[field].blocks(seen.0);
        let (first, mut sum) = (blocks.start, Jet::constant(delta[0].broadcast(0.0)));
        for block in blocks {
            let p = self.block::<R, D>(seen, (field, block - first, block), 0, delta);
            sum = sum.plus::<D>(p);
        }
        sum
    }

    /// The polynomial in δ of the patch's `k`-th block of a field, which has the number `block`.
    #[inline(always)]
    fn block<R: Real, const D: usize>(
        &self,
        (patch, near): ElementView<'_>,
        (field, k, block): (usize, usize, usize),
        component: usize,
        delta: [R; 2],
    ) -> Jet<R> {
        let data = &self.field.step.fields[field];
        let (space, degree) = (data.space(block), data.block_degree[block].into());
        let coefficients = match near {
            None => data.block_coefficients(block, component),
            Some(near) => near.coefficients(data, field, (patch, k), component),
        };
        polynomial_in::<R, D>(space, coefficients, degree, delta)
    }

    /// The functions of a group.
    #[inline(always)]
    fn group<R: Real, const D: usize>(
        &self,
        seen: ElementView<'_>,
        functions: &LocalFunctions<'_>,
        at: &EvaluationPoint<R>,
        world: &ElementJacobian<R>,
        group: usize,
    ) -> [Jet<R>; GROUP] {
        let mut jets = [Jet::constant(at.delta[0].broadcast(0.0)); GROUP];
        match functions.table().level_use(group) {
            None => functions.evaluate::<R, D>(group, at.offset, at.side, &mut jets),
            Some(LevelUse::Sign(field)) => {
                let level = self.level::<R, 0>(seen, field as usize, at.delta).v;
                jets[0].v = sign(level, at.side);
            }
            Some(LevelUse::Frame([x, y])) => {
                let x = world.jet::<D>(self.level::<R, D>(seen, x as usize, at.delta));
                let y = world.jet::<D>(self.level::<R, D>(seen, y as usize, at.delta));
                let (sign, branch) = (sign(y.v, at.side), y.v.broadcast(1.0));
                let point = TipPoint { x: x.v, y: y.v, sign, branch };
                functions.evaluate_in_frame::<R, D>(group, &point, (at.offset, at.side), &mut jets);
                let mut k = 0;
                while k < GROUP {
                    jets[k] = composed::<R, D>(jets[k], x, y);
                    k += 1;
                }
            }
        }
        jets
    }
}

/// Places in a patch, as δ and as offsets from the anchor.
pub(super) struct EvaluationPoint<R> {
    pub(super) delta: [R; 2],
    pub(super) offset: [R; 2],
    pub(super) side: Side,
}

/// The chain rule from ξ to the world: G = DM⁻¹, ∇v = Gᵀ ∇_ξ v, ∇²v = Gᵀ (∇²_ξ v − Σ_i ∂v/∂x_i ∇²_ξ
/// x_i) G.
struct ElementJacobian<R> {
    image: [Jet<R>; 2],
    /// Gᵀ in rows.
    transposed: [[R; 2]; 2],
}

impl<R: Real> ElementJacobian<R> {
    #[inline(always)]
    fn new(image: [Jet<R>; 2]) -> Self {
        let [x, y] = image;
        let inverse = x.v.broadcast(1.0) / (x.x * y.y - x.y * y.x);
        let transposed = [[y.y * inverse, -(y.x * inverse)], [-(x.y * inverse), x.x * inverse]];
        Self { image, transposed }
    }

    #[inline(always)]
    fn jet<const D: usize>(&self, v: Jet<R>) -> Jet<R> {
        let mut out = Jet::constant(v.v);
        let [[a, b], [c, d]] = self.transposed;
        if D >= 1 {
            (out.x, out.y) = (a * v.x + b * v.y, c * v.x + d * v.y);
        }
        if D >= 2 {
            let [x, y] = &self.image;
            let xx = v.xx - out.x * x.xx - out.y * y.xx;
            let xy = v.xy - out.x * x.xy - out.y * y.xy;
            let yy = v.yy - out.x * x.yy - out.y * y.yy;
            let (ab, cd) = (a * b * xy, c * d * xy);
            out.xx = a * a * xx + (ab + ab) + b * b * yy;
            out.xy = a * c * xx + (a * d + b * c) * xy + b * d * yy;
            out.yy = c * c * xx + (cd + cd) + d * d * yy;
        }
        out
    }
}

/// f(x(p), y(p)) by the chain rule, for f with derivatives by x and y.
#[inline(always)]
fn composed<R: Real, const D: usize>(f: Jet<R>, x: Jet<R>, y: Jet<R>) -> Jet<R> {
    let mut out = Jet::constant(f.v);
    if D >= 1 {
        (out.x, out.y) = (f.x * x.x + f.y * y.x, f.x * x.y + f.y * y.y);
    }
    if D >= 2 {
        out.xx = f.x * x.xx + f.y * y.xx + twice(&f, [x.x, y.x], [x.x, y.x]);
        out.xy = f.x * x.xy + f.y * y.xy + twice(&f, [x.x, y.x], [x.y, y.y]);
        out.yy = f.x * x.yy + f.y * y.yy + twice(&f, [x.y, y.y], [x.y, y.y]);
    }
    out
}

/// The second derivatives of f along two directions.
#[inline(always)]
fn twice<R: Real>(f: &Jet<R>, a: [R; 2], b: [R; 2]) -> R {
    f.xx * a[0] * b[0] + f.xy * (a[0] * b[1] + a[1] * b[0]) + f.yy * a[1] * b[1]
}
