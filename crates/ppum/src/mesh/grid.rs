//! The points of a grid, such as the centres of pixels: elements are looked at one after the other,
//! each on the part of the rows that its edges leave. So no point looks for its owner.

use std::collections::BTreeMap;
use std::ops::Range;

use super::evaluate::EvaluationPoint;
use super::frame::{LanePlaces, SeenElement};
use super::local::{Candidate, LocalMesh, PatchLocation};
use super::map::TOLERANCE;
use crate::crack::Side;
use crate::function::LocalFunctions;
use crate::jet::Jet;
use crate::vec2::{Rect, Vec2, vec2};
use ppum_formula::real::{LaneJob, LaneNumber, Lanes, Real};

/// Rounding of the place of a row or column, in rows or columns.
const ROUNDING: f64 = 1e-6;

/// Points `anchor + (x_i, y_j)`, row by row; x and y are evenly spaced, and the x rise.
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

    fn bounds(&self) -> Option<Rect> {
        let [first, last] = [self.x.first().zip(self.y.first()), self.x.last().zip(self.y.last())]
            .map(|corner| corner.map(|(&x, &y)| vec2(x, y)));
        first.zip(last).map(|(a, b)| Rect::new(a.min(b), a.max(b)))
    }
}

/// Evenly spaced numbers.
#[derive(Clone, Copy)]
struct EvenSpacing {
    first: f64,
    /// How many fit in a unit; negative if they fall.
    density: f64,
    count: usize,
}

impl EvenSpacing {
    fn new(values: &[f64]) -> Self {
        let (first, last) = (values.first().copied(), values.last().copied());
        let size = last.zip(first).map_or(0.0, |(last, first)| last - first);
        let density = if size == 0.0 { 1.0 } else { (values.len() - 1) as f64 / size };
        Self { first: first.unwrap_or(0.0), density, count: values.len() }
    }

    /// The numbers from one to another that is larger, and some that rounding adds.
    #[inline(always)]
    fn between(&self, from: f64, to: f64) -> Range<usize> {
        let [a, b] = [from, to].map(|value| (value - self.first) * self.density);
        let (a, b) = if self.density < 0.0 { (b, a) } else { (a, b) };
        let first = (a - ROUNDING).ceil().max(0.0) as usize;
        let end = (b + ROUNDING).floor() + 1.0;
        first..(end.max(0.0) as usize).min(self.count)
    }
}

/// Points of a grid that an element may hold.
#[derive(Default)]
struct GridPoints {
    index: Vec<usize>,
    /// x and y, some more than points.
    offset: [Vec<f64>; 2],
}

impl GridPoints {
    fn clear(&mut self) {
        self.index.clear();
        self.offset.iter_mut().for_each(Vec::clear);
    }

    #[inline(always)]
    fn push(&mut self, index: usize, [x, y]: [f64; 2]) {
        self.index.push(index);
        self.offset[0].push(x);
        self.offset[1].push(y);
    }

    /// Makes all vectors of lanes whole.
    fn pad(&mut self, lanes: usize) {
        let size = self.index.len().next_multiple_of(lanes);
        for offset in &mut self.offset {
            offset.truncate(self.index.len());
            offset.resize(size, offset.last().copied().unwrap_or(0.0));
        }
    }

    /// Moves a point to the front, where others are that stay.
    #[inline(always)]
    fn keep(&mut self, point: usize, place: usize) {
        self.index[place] = self.index[point];
        self.offset[0][place] = self.offset[0][point];
        self.offset[1][place] = self.offset[1][point];
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
        f64::dispatch(GridEvaluation::<D> { mesh: self, functions, grid, side, out });
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

struct GridEvaluation<'a, 'f, 't, const D: usize> {
    mesh: &'a LocalMesh<'f>,
    functions: &'a LocalFunctions<'t>,
    grid: &'a PointGrid<'a>,
    side: Side,
    out: &'a mut [Jet<f64>],
}

/// The state of a search for the owners of points, while elements are visited.
struct GridSearch<'m> {
    /// True of points that have no owner so far.
    is_free: Vec<bool>,
    /// The places of free points in elements that miss them by rounding, with their margins.
    beside: BTreeMap<usize, (f64, PatchLocation<'m>)>,
}

impl<const D: usize> LaneJob<f64> for GridEvaluation<'_, '_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(mut self, zero: R) {
        self.out.fill(Jet::NAN);
        let (mesh, count) = (self.mesh, self.grid.x.len() * self.grid.y.len());
        let mut found = GridSearch { is_free: vec![true; count], beside: BTreeMap::new() };
        let mut lanes = vec![Jet::constant(zero); mesh.field.components()];
        let axes = [self.grid.x, self.grid.y].map(EvenSpacing::new);
        let mut points = GridPoints::default();
        for patch in mesh.patches_of(self.grid) {
            let candidate = mesh.candidate(patch);
            points.clear();
            self.add_points(axes, &candidate, &found.is_free, &mut points);
            for frame in candidate.frames(mesh.mesh) {
                self.on_lanes::<R>(&frame, &mut points, &mut found, &mut lanes);
            }
            self.one_by_one(&candidate, &points, &mut found);
        }
        let GridSearch { beside, is_free, .. } = found;
        let left = beside.into_iter().filter(|(point, _)| is_free[*point]);
        left.for_each(|(point, (_, place))| self.evaluate(point, &place));
    }
}

impl<const D: usize> GridEvaluation<'_, '_, '_, D> {
    /// The free points that an element may hold.
    #[inline(always)]
    fn add_points(
        &self,
        [columns, rows]: [EvenSpacing; 2],
        candidate: &Candidate<'_>,
        is_free: &[bool],
        points: &mut GridPoints,
    ) {
        let (grid, reach) = (self.grid, candidate.reach());
        let far = reach.max.max(-reach.min);
        let planes = candidate.half_planes(self.mesh.mesh, far);
        for row in rows.between(reach.min.y, reach.max.y) {
            let y = grid.y[row];
            let (mut from, mut to) = (reach.min.x, reach.max.x);
            for [a, b, c] in planes.iter().flatten() {
                let rest = a + c * y;
                if *b > 0.0 {
                    from = from.max(-rest);
                } else if *b < 0.0 {
                    to = to.min(rest);
                } else if rest < 0.0 {
                    to = f64::NEG_INFINITY;
                }
            }
            for column in columns.between(from, to) {
                let point = row * grid.x.len() + column;
                if is_free[point] {
                    points.push(point, [grid.x[column], y]);
                }
            }
        }
    }

    /// Evaluates the points that lie in an element, on lanes, and leaves those that are not sure.
    #[inline(always)]
    fn on_lanes<'m, R: Real<Scalar = f64>>(
        &mut self,
        frame: &SeenElement<'_, 'm>,
        points: &mut GridPoints,
        found: &mut GridSearch<'m>,
        lanes: &mut [Jet<R>],
    ) {
        let (count, mut left, zero) = (points.index.len(), 0, lanes[0].v.broadcast(0.0));
        points.pad(R::LANES);
        for start in (0..count).step_by(R::LANES) {
            let [x, y] = &points.offset;
            let offset = [zero.load(&x[start..]), zero.load(&y[start..])];
            let LanePlaces { delta, margin, certainty } = frame.places(offset);
            let margin = self.mesh.clipped(frame.seen, delta, (margin, self.side));
            let (margins, certainties) = (margin.lanes(), certainty.lanes());
            let mut inside = Lanes::default().map(|_| (0, 0));
            let mut hits = 0;
            for (lane, point) in (start..count.min(start + R::LANES)).enumerate() {
                let (index, margin) = (points.index[point], margins[lane]);
                if certainties[lane] < 0.0 {
                    points.keep(point, left);
                    left += 1;
                } else if margin >= 0.0 {
                    found.is_free[index] = false;
                    inside[hits] = (lane, index);
                    hits += 1;
                } else if margin >= -TOLERANCE {
                    let delta = [delta[0].lanes()[lane], delta[1].lanes()[lane]];
                    let (patch, near) = frame.seen;
                    found.add_beside(index, margin, PatchLocation { patch, delta, near });
                }
            }
            if hits > 0 {
                let at = EvaluationPoint { delta, offset, side: self.side };
                self.store(frame, &at, &inside[..hits], lanes);
            }
        }
        points.index.truncate(left);
    }

    /// Evaluates the field on lanes, and writes those that have points.
    #[inline(always)]
    fn store<R: Real<Scalar = f64>>(
        &mut self,
        frame: &SeenElement<'_, '_>,
        at: &EvaluationPoint<R>,
        points: &[(usize, usize)],
        lanes: &mut [Jet<R>],
    ) {
        let seen = (frame.seen, &frame.inverse.map);
        self.mesh.evaluate_at::<R, D>(seen, self.functions, at, lanes);
        let components = lanes.len();
        for (c, jet) in lanes.iter().enumerate() {
            let rows = points.iter().map(|(lane, point)| (*lane, point * components + c));
            jet.store::<D>(rows, self.out);
        }
    }

    /// Evaluates the points that lie in an element.
    fn one_by_one<'m>(
        &mut self,
        candidate: &Candidate<'m>,
        points: &GridPoints,
        found: &mut GridSearch<'m>,
    ) {
        for (k, &point) in points.index.iter().enumerate() {
            let offset = vec2(points.offset[0][k], points.offset[1][k]);
            let Some(place) = self.mesh.location(candidate, offset, None) else { continue };
            let margin = self.mesh.margin(&place);
            if margin < -TOLERANCE || !self.mesh.is_kept(&place, self.side) {
                continue;
            }
            if margin >= 0.0 {
                found.is_free[point] = false;
                self.evaluate(point, &place);
            } else {
                found.add_beside(point, margin, place);
            }
        }
    }

    fn evaluate(&mut self, point: usize, place: &PatchLocation<'_>) {
        let (columns, components) = (self.grid.x.len(), self.mesh.field.components());
        let offset = vec2(self.grid.x[point % columns], self.grid.y[point / columns]);
        let out = &mut self.out[point * components..][..components];
        self.mesh.evaluate::<D>(place, self.functions, (offset, self.side), out);
    }
}

impl<'m> GridSearch<'m> {
    /// Adds the place of a point in an element that misses it by rounding.
    #[cold]
    fn add_beside(&mut self, point: usize, margin: f64, place: PatchLocation<'m>) {
        if self.beside.get(&point).is_none_or(|(most, _)| margin > *most) {
            self.beside.insert(point, (margin, place));
        }
    }
}
