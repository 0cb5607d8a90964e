//! Many points: each one's owner first, beginning with the place of its neighbour, then those of
//! one patch on lanes.

use super::evaluate::{At, LanePoint, Seen};
use super::local::{Candidate, LocalMesh, Location};
use super::map::Map;
use crate::crack::Side;
use crate::function::LocalFunctions;
use crate::jet::Jet;
use crate::vec2::{Rect, Vec2};
use ppum_formula::real::{Job, Lanes, Real, Scalar};

/// Points that are looked at together, and the most elements that are asked for all of them.
const POINTS: usize = 256;
const CANDIDATES: usize = 64;

impl LocalMesh<'_> {
    /// The field at many points, components of one after those of the other; NaN outside. Fastest
    /// for points near each other.
    pub(crate) fn evaluate_many<const D: usize>(
        &self,
        functions: &LocalFunctions<'_>,
        (offsets, side): (&[Vec2], Side),
        out: &mut [Jet<f64>],
    ) {
        let components = self.field.components();
        for (offsets, out) in offsets.chunks(POINTS).zip(out.chunks_mut(POINTS * components)) {
            let owners = self.owners(offsets, side);
            f64::dispatch(Many::<D> { mesh: self, functions, offsets, side, owners, out });
        }
    }

    fn owners(&self, offsets: &[Vec2], side: Side) -> Vec<Option<Location<'_>>> {
        let corner = |of: fn(Vec2, Vec2) -> Vec2| offsets.iter().copied().reduce(of);
        let (Some(min), Some(max)) = (corner(Vec2::min), corner(Vec2::max)) else {
            return Vec::new();
        };
        let mut patches = Vec::new();
        self.field.tree.query_box(&Rect::new(self.anchor + min, self.anchor + max), &mut patches);
        if patches.len() > CANDIDATES || offsets.len() == 1 {
            return offsets.iter().map(|&offset| self.owner(offset, side)).collect();
        }
        let candidates: Vec<_> = patches.iter().map(|&patch| self.candidate(patch)).collect();
        let mut starts = vec![None; candidates.len()];
        let owner = |&offset: &Vec2| self.next_owner(&candidates, &mut starts, offset, side);
        offsets.iter().map(owner).collect()
    }

    /// The owner of a point; `starts` are the places of the last points in the elements.
    fn next_owner<'m>(
        &self,
        candidates: &[Candidate<'m>],
        starts: &mut [Option<[f64; 2]>],
        offset: Vec2,
        side: Side,
    ) -> Option<Location<'m>> {
        let places = candidates.iter().zip(starts).map(|(candidate, start)| {
            let place = self.location(candidate, offset, *start);
            *start = place.as_ref().filter(|place| place.near.is_none()).map(|place| place.delta);
            place
        });
        self.first(side, places)
    }
}

struct Many<'a, 'f, 't, 'm, const D: usize> {
    mesh: &'a LocalMesh<'f>,
    functions: &'a LocalFunctions<'t>,
    offsets: &'a [Vec2],
    side: Side,
    owners: Vec<Option<Location<'m>>>,
    out: &'a mut [Jet<f64>],
}

impl<const D: usize> Job<f64> for Many<'_, '_, '_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        let components = self.mesh.field.components();
        self.out.fill(Jet::NAN);
        let key = |k: usize| self.owners[k].map(|at| (at.patch, at.near.is_some()));
        let mut order: Vec<usize> = (0..self.offsets.len()).filter(|&k| key(k).is_some()).collect();
        order.sort_by_key(|&k| key(k));
        let mut lanes = vec![Jet::constant(zero); components];
        for run in order.chunk_by(|&a, &b| key(a) == key(b)) {
            let Some(first) = self.owners[run[0]] else { continue };
            let (mesh, functions, seen) = (self.mesh, self.functions, (first.patch, first.near));
            let one = OnePatch { mesh, functions, side: self.side, seen, map: &mesh.map_of(seen) };
            for points in run.chunks(R::LANES) {
                let place = |k: usize| {
                    let (index, owner) = (points[k], self.owners[points[k]]);
                    let delta = owner.map_or([0.0; 2], |place| place.delta);
                    LanePoint { index, offset: self.offsets[index], delta }
                };
                one.evaluate::<R, D>((points.len(), place), &mut lanes, self.out);
            }
        }
    }
}

/// What evaluates the field in one patch.
pub(super) struct OnePatch<'a, 'f, 't, 'm> {
    pub(super) mesh: &'a LocalMesh<'f>,
    pub(super) functions: &'a LocalFunctions<'t>,
    pub(super) side: Side,
    pub(super) seen: Seen<'m>,
    pub(super) map: &'a Map,
}

impl OnePatch<'_, '_, '_, '_> {
    /// Evaluates some places, no more than there are lanes, and writes the components of each to
    /// the rows of its number; `lanes` is for as many components.
    #[inline(always)]
    pub(super) fn evaluate<R: Real<Scalar = f64>, const D: usize>(
        &self,
        (count, place): (usize, impl Fn(usize) -> LanePoint),
        lanes: &mut [Jet<R>],
        out: &mut [Jet<f64>],
    ) {
        // the last point stands in for those that are missing
        let (mut delta, mut offset) = ([Lanes::default(); 2], [Lanes::default(); 2]);
        let mut rows = Lanes::default().map(|_| 0);
        for lane in 0..R::LANES {
            let place = place(lane.min(count - 1));
            (delta[0][lane], delta[1][lane]) = (place.delta[0], place.delta[1]);
            (offset[0][lane], offset[1][lane]) = (place.offset.x, place.offset.y);
            rows[lane] = place.index * lanes.len();
        }
        let zero = lanes[0].v.lit(0.0);
        let at = At {
            delta: [zero.load(&delta[0]), zero.load(&delta[1])],
            offset: [zero.load(&offset[0]), zero.load(&offset[1])],
            side: self.side,
        };
        self.mesh.evaluate_at::<R, D>((self.seen, self.map), self.functions, &at, lanes);
        for (c, jet) in lanes.iter().enumerate() {
            jet.store::<D>(rows[..count].iter().map(|row| row + c), out);
        }
    }
}
