//! The points of a grid, such as the centres of pixels: elements are looked at one after the other,
//! each on the part of the rows that its edges leave. So no point looks for its owner.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use super::evaluate::LanePoint;
use super::local::{Candidate, LocalMesh, Location};
use super::many::OnePatch;
use super::map::TOLERANCE;
use crate::crack::Side;
use crate::function::LocalFunctions;
use crate::jet::Jet;
use crate::vec2::{Rect, Vec2, vec2};
use ppum_formula::real::{Job, Lanes, Real, Scalar};

/// Rounding of the place of a column, in columns.
const ROUNDING: f64 = 1e-6;

/// Points `anchor + (x_i, y_j)`, row by row; the x are evenly spaced and rise.
#[derive(Clone, Copy, Debug)]
pub struct PointGrid<'a> {
    /// Offsets of the columns.
    pub x: &'a [f64],
    /// Offsets of the rows.
    pub y: &'a [f64],
}

impl PointGrid<'_> {
    /// The offsets of all points, row by row.
    pub fn offsets(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.y.iter().flat_map(|&y| self.x.iter().map(move |&x| vec2(x, y)))
    }

    fn offset(&self, point: usize) -> Vec2 {
        vec2(self.x[point % self.x.len()], self.y[point / self.x.len()])
    }

    fn bounds(&self) -> Option<Rect> {
        let [first, last] = [self.x.first().zip(self.y.first()), self.x.last().zip(self.y.last())]
            .map(|corner| corner.map(|(&x, &y)| vec2(x, y)));
        first.zip(last).map(|(a, b)| Rect::new(a.min(b), a.max(b)))
    }

    /// The columns between two offsets, and some that rounding adds.
    fn columns(&self, from: f64, to: f64) -> Range<usize> {
        let n = self.x.len();
        let pitch = if n > 1 { (self.x[n - 1] - self.x[0]) / (n - 1) as f64 } else { 1.0 };
        let column = |x: f64| (x - self.x[0]) / pitch;
        let first = (column(from) - ROUNDING).ceil().max(0.0) as usize;
        let end = (column(to) + ROUNDING).floor() + 1.0;
        first..(end.max(0.0) as usize).min(n)
    }
}

impl LocalMesh<'_> {
    /// The field at the points of a grid, components of one after those of the other; NaN outside.
    pub(crate) fn evaluate_grid<const D: usize>(
        &self,
        functions: &LocalFunctions<'_>,
        (grid, side): (&PointGrid<'_>, Side),
        out: &mut [Jet<f64>],
    ) {
        f64::dispatch(OnGrid::<D> { mesh: self, functions, grid, side, out });
    }

    /// The patches that may hold points of a grid, ascending.
    fn patches_of(&self, grid: &PointGrid<'_>) -> Vec<u32> {
        let mut patches = Vec::new();
        if let Some(bounds) = grid.bounds() {
            let bounds = Rect::new(self.anchor + bounds.min, self.anchor + bounds.max);
            self.field.tree.query_box(&bounds, &mut patches);
        }
        patches
    }
}

struct OnGrid<'a, 'f, 't, const D: usize> {
    mesh: &'a LocalMesh<'f>,
    functions: &'a LocalFunctions<'t>,
    grid: &'a PointGrid<'a>,
    side: Side,
    out: &'a mut [Jet<f64>],
}

/// What is known of the points while elements are looked at.
struct Found<'m> {
    /// True of points that have no owner so far.
    is_free: Vec<bool>,
    /// The places of free points in elements that miss them by rounding, with their margins.
    beside: BTreeMap<usize, (f64, Location<'m>)>,
    /// The points of one element, and their places in it.
    inside: Vec<(usize, Location<'m>)>,
}

impl<const D: usize> Job<f64> for OnGrid<'_, '_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(mut self, zero: R) {
        self.out.fill(Jet::NAN);
        let (mesh, count) = (self.mesh, self.grid.x.len() * self.grid.y.len());
        let (beside, inside) = (BTreeMap::new(), Vec::new());
        let mut found = Found { is_free: vec![true; count], beside, inside };
        let mut lanes = vec![Jet::constant(zero); mesh.field.components()];
        let mut points = Vec::new();
        for patch in mesh.patches_of(self.grid) {
            let candidate = mesh.candidate(patch);
            points.clear();
            self.add_points(&candidate, &found.is_free, &mut points);
            found.inside.clear();
            self.locate::<R>(zero, &candidate, &points, &mut found);
            self.evaluate::<R>(&found.inside, Some(&candidate), &mut lanes);
        }
        let Found { beside, is_free, .. } = found;
        let left = beside.into_iter().filter(|(point, _)| is_free[*point]);
        for (point, (_, place)) in left {
            self.evaluate::<R>(&[(point, place)], None, &mut lanes);
        }
    }
}

impl<const D: usize> OnGrid<'_, '_, '_, D> {
    /// The free points that an element may hold.
    #[inline(always)]
    fn add_points(&self, candidate: &Candidate<'_>, is_free: &[bool], points: &mut Vec<usize>) {
        let (grid, reach) = (self.grid, candidate.reach());
        let far = reach.max.max(-reach.min);
        let planes = candidate.half_planes(self.mesh.mesh, far);
        for (row, &y) in grid.y.iter().enumerate() {
            if y < reach.min.y || y > reach.max.y {
                continue;
            }
            let (mut from, mut to) = (reach.min.x, reach.max.x);
            for [a, b, c] in planes.iter().flatten() {
                let rest = a + c * y;
                if *b > 0.0 {
                    from = from.max(-rest / b);
                } else if *b < 0.0 {
                    to = to.min(-rest / b);
                } else if rest < 0.0 {
                    to = f64::NEG_INFINITY;
                }
            }
            let first = row * grid.x.len();
            let columns = grid.columns(from, to).map(|column| first + column);
            points.extend(columns.filter(|&point| is_free[point]));
        }
    }

    /// The places of points in an element, as far as they lie in it.
    #[inline(always)]
    fn locate<'m, R: Real<Scalar = f64>>(
        &self,
        zero: R,
        candidate: &Candidate<'m>,
        points: &[usize],
        found: &mut Found<'m>,
    ) {
        let offset = |point: usize| self.grid.offset(point);
        let Some(inverse) = candidate.bent() else {
            for &point in points {
                let place = self.mesh.location(candidate, offset(point), None);
                found.add(self.mesh, (point, place), self.side);
            }
            return;
        };
        for points in points.chunks(R::LANES) {
            let mut targets = [Lanes::default(); 2];
            for lane in 0..R::LANES {
                let target = candidate.target(offset(points[lane.min(points.len() - 1)]));
                (targets[0][lane], targets[1][lane]) = (target[0], target[1]);
            }
            let target = [zero.load(&targets[0]), zero.load(&targets[1])];
            let [x, y, step] = inverse.newton_on::<R>(target);
            let (x, y, step) = (x.lanes(), y.lanes(), step.lanes());
            for (lane, &point) in points.iter().enumerate() {
                let xi = [x[lane], y[lane]];
                let place = match candidate.decided(self.mesh.mesh, xi, step[lane]) {
                    true => Some(Location { patch: candidate.patch, delta: xi, near: None }),
                    false => self.mesh.location(candidate, offset(point), None),
                };
                found.add(self.mesh, (point, place), self.side);
            }
        }
    }

    #[inline(always)]
    fn evaluate<R: Real<Scalar = f64>>(
        &mut self,
        inside: &[(usize, Location<'_>)],
        candidate: Option<&Candidate<'_>>,
        lanes: &mut [Jet<R>],
    ) {
        let (grid, mesh) = (self.grid, self.mesh);
        for run in inside.chunk_by(|a, b| a.1.near.is_some() == b.1.near.is_some()) {
            let seen = (run[0].1.patch, run[0].1.near);
            let map = match (seen.1, candidate.and_then(Candidate::map)) {
                (None, Some(map)) => Cow::Borrowed(map),
                _ => mesh.map_of(seen),
            };
            let one =
                OnePatch { mesh, functions: self.functions, side: self.side, seen, map: &map };
            for points in run.chunks(R::LANES) {
                let place = |k: usize| {
                    let (index, location) = &points[k];
                    LanePoint { index: *index, offset: grid.offset(*index), delta: location.delta }
                };
                one.evaluate::<R, D>((points.len(), place), lanes, self.out);
            }
        }
    }
}

impl<'m> Found<'m> {
    /// Adds the place of a point, if it lies in its patch or misses it by rounding.
    #[inline(always)]
    fn add(
        &mut self,
        mesh: &LocalMesh<'_>,
        (point, place): (usize, Option<Location<'m>>),
        side: Side,
    ) {
        let Some(place) = place else { return };
        let margin = mesh.margin(&place);
        if margin < -TOLERANCE || !mesh.is_kept(&place, side) {
            return;
        }
        if margin >= 0.0 {
            self.is_free[point] = false;
            self.inside.push((point, place));
        } else if self.beside.get(&point).is_none_or(|(most, _)| margin > *most) {
            self.beside.insert(point, (margin, place));
        }
    }
}
