//! Many points: each one's owner first, beginning with the place of its neighbour, then those of
//! one patch on lanes.

use super::evaluate::EvaluationPoint;
use super::local::{Candidate, LocalMesh, PatchLocation};
use crate::crack::Side;
use crate::function::LocalFunctions;
use crate::jet::Jet;
use crate::vec2::{Rect, Vec2};
use ppum_formula::real::{LaneJob, LaneNumber, Lanes, Real};

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
            f64::dispatch(MeshEvaluation::<D> {
                mesh: self,
                functions,
                offsets,
                side,
                owners,
                out,
            });
        }
    }

    fn owners(&self, offsets: &[Vec2], side: Side) -> Vec<Option<PatchLocation<'_>>> {
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
    ) -> Option<PatchLocation<'m>> {
        let places = candidates.iter().zip(starts).map(|(candidate, start)| {
            let place = self.location(candidate, offset, *start);
            *start = place.as_ref().filter(|place| place.near.is_none()).map(|place| place.delta);
            place
        });
        self.first(side, places)
    }
}

struct MeshEvaluation<'a, 'f, 't, 'm, const D: usize> {
    mesh: &'a LocalMesh<'f>,
    functions: &'a LocalFunctions<'t>,
    offsets: &'a [Vec2],
    side: Side,
    owners: Vec<Option<PatchLocation<'m>>>,
    out: &'a mut [Jet<f64>],
}

impl<const D: usize> LaneJob<f64> for MeshEvaluation<'_, '_, '_, '_, D> {
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
            let map = mesh.map_of(seen);
            for points in run.chunks(R::LANES) {
                let at = self.places(points, zero);
                mesh.evaluate_at::<R, D>((seen, &map), functions, &at, &mut lanes);
                for (c, jet) in lanes.iter().enumerate() {
                    let rows = points.iter().map(|point| point * components + c);
                    jet.store::<D>(rows.enumerate(), self.out);
                }
            }
        }
    }
}

impl<const D: usize> MeshEvaluation<'_, '_, '_, '_, D> {
    /// The places of no more points than there are lanes; the last stands in for those missing.
    #[inline(always)]
    fn places<R: Real<Scalar = f64>>(&self, points: &[usize], zero: R) -> EvaluationPoint<R> {
        let (mut delta, mut offset) = ([Lanes::default(); 2], [Lanes::default(); 2]);
        for lane in 0..R::LANES {
            let index = points[lane.min(points.len() - 1)];
            let xi = self.owners[index].map_or([0.0; 2], |place| place.delta);
            (delta[0][lane], delta[1][lane]) = (xi[0], xi[1]);
            (offset[0][lane], offset[1][lane]) = (self.offsets[index].x, self.offsets[index].y);
        }
        EvaluationPoint {
            delta: [zero.load(&delta[0]), zero.load(&delta[1])],
            offset: [zero.load(&offset[0]), zero.load(&offset[1])],
            side: self.side,
        }
    }
}
