//! Shape functions φ_i ψ at quadrature points.
//!
//! Sides of cracks enter shifted, see [`TrialSpace::shifts`].

use super::williams::PatchTipFrame;
use crate::law::{HOOP, OPERATORS, Stress, hoop, operators};
use crate::quadrature::{CrackFace, EdgeRule};
use crate::space::{ANGULAR, Origin, SeriesFunctions, TrialSpace};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use ppum::complex::Complex;
use ppum::crack::Side;
use ppum::dataset::{MAX_DEGREE, monomials as monomials_of};
use ppum::formula::BlockScratch;
use ppum::function::{GROUP, LocalFunctions, Slot};
use ppum::jet::Jet;
use ppum::real::{LaneJob, LaneNumber, Real};
use ppum::vec2::Vec2;
use std::ops::Range;

/// Values of shape functions at points, and all that strains are made of. Arrays have shape
/// \[functions, points\], row-major; functions are those of the patches in order, in each patch in
/// the order of the dataset's coefficients.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// Number of functions.
    pub functions: usize,
    /// Number of points.
    pub points: usize,
    /// φ_i ψ
    pub value: Vec<f64>,
    /// D_k (φ_i ψ) with the operators of [`Strain`](crate::law::Strain): ∂/∂x and ∂/∂y, and 1/x in
    /// bodies of revolution.
    pub slopes: Vec<Vec<f64>>,
}

impl Shapes {
    /// Makes room for functions, points and operators, whose values are to be written.
    pub(crate) fn resize(&mut self, functions: usize, points: usize, operators: usize) {
        self.slopes.resize_with(operators, Vec::new);
        (self.functions, self.points) = (functions, points);
        self.arrays_mut().for_each(|array| array.resize(functions * points, 0.0));
    }

    /// The values, then the slopes.
    pub(crate) fn arrays(&self) -> impl Iterator<Item = &Vec<f64>> {
        [&self.value].into_iter().chain(&self.slopes)
    }

    /// The arrays, to be written, in the order of [`Shapes::arrays`].
    pub(crate) fn arrays_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        [&mut self.value].into_iter().chain(&mut self.slopes)
    }

    /// The terms of ∇(φψ)·∇(φψ′) + f φ² ψ ψ′ for a factor f: arrays whose products they are, with
    /// their factors.
    pub(crate) fn gram_terms(&self, factor: f64) -> impl Iterator<Item = (&Vec<f64>, f64)> {
        let gradient = self.slopes.iter().take(HOOP).map(|array| (array, 1.0));
        gradient.chain([(&self.value, factor)])
    }

    /// D_k of a function at a point; zero where there is no third operator.
    pub(crate) fn slopes_at(&self, function: usize, point: usize) -> [f64; OPERATORS] {
        let mut slopes = [0.0; OPERATORS];
        let arrays = slopes.iter_mut().zip(&self.slopes);
        arrays.for_each(|(slope, array)| *slope = array[function * self.points + point]);
        slopes
    }

    /// A row of one of the arrays.
    pub(crate) fn row<'a>(&self, array: &'a [f64], function: usize) -> &'a [f64] {
        &array[function * self.points..][..self.points]
    }

    /// ∂_k φ of a partition function in the product rule D_k (φ u) = φ D_k u + u ∂_k φ, without the
    /// operator that is no derivative.
    pub(crate) fn factor_slopes(&self, phi: usize) -> impl Iterator<Item = Option<&[f64]>> {
        let slopes = self.slopes.iter().enumerate();
        slopes.map(move |(k, array)| (k < HOOP).then(|| self.row(array, phi)))
    }

    /// The products of all functions with the partition function in row `phi` of `other`.
    pub(crate) fn times_row(&self, other: &Self, phi: usize) -> Self {
        let factor = other.row(&other.value, phi);
        let slopes: Vec<_> = other.factor_slopes(phi).collect();
        let mut out = self.clone();
        for at in 0..out.value.len() {
            let q = at % self.points;
            for (own, slope) in out.slopes.iter_mut().zip(&slopes) {
                own[at] = match slope {
                    Some(slope) => factor[q] * own[at] + slope[q] * self.value[at],
                    None => factor[q] * own[at],
                };
            }
            out.value[at] *= factor[q];
        }
        out
    }

    /// Multiplies the columns by the square roots of quadrature weights, so that products of rows
    /// are integrals of products.
    pub(crate) fn scale(&mut self, weights: &[f64]) {
        self.multiply(&weights.iter().map(|w| w.sqrt()).collect::<Vec<_>>());
    }

    /// Makes a function zero at all points.
    pub(crate) fn clear(&mut self, function: usize) {
        let range = function * self.points..(function + 1) * self.points;
        self.arrays_mut().for_each(|array| array[range.clone()].fill(0.0));
    }

    /// Multiplies the columns by factors.
    pub(crate) fn multiply(&mut self, factors: &[f64]) {
        for array in self.arrays_mut() {
            for row in array.chunks_exact_mut(factors.len().max(1)) {
                row.iter_mut().zip(factors).for_each(|(v, factor)| *v *= factor);
            }
        }
    }

    /// Some rows of one of the arrays as a matrix.
    #[must_use]
    pub(crate) fn rows<'a>(&self, array: &'a [f64], functions: Range<usize>) -> MatRef<'a, f64> {
        let part = &array[functions.start * self.points..functions.end * self.points];
        MatRef::from_row_major_slice(part, functions.len(), self.points)
    }

    /// Adds Σ N · load over the points, loads times weights, to a load over the functions of a
    /// cell, of which `numbers` are those of the rows; component i of function a is entry a ·
    /// components + i.
    pub(crate) fn add_loads(
        &self,
        loads: &[[f64; 2]],
        numbers: &[usize],
        components: usize,
        sum: &mut [f64],
    ) {
        let loads = Mat::from_fn(self.points, components, |q, i| loads[q][i]);
        let sums = self.rows(&self.value, 0..self.functions) * loads;
        for (k, &number) in numbers.iter().enumerate() {
            (0..components).for_each(|i| sum[number * components + i] += sums[(k, i)]);
        }
    }

    /// Adds the work Σ σ_ik D_k N of several stresses at each point, times weights, on the
    /// functions to loads as [`Shapes::add_loads`] has them, one for each stress.
    pub(crate) fn add_stresses<const M: usize>(
        &self,
        stresses: &[[Stress; M]],
        numbers: &[usize],
        sums: [&mut [f64]; M],
    ) {
        let mut work = Mat::zeros(self.functions, 2 * M);
        for (k, slopes) in self.slopes.iter().enumerate() {
            let entry = |q: usize, column: usize| stresses[q][column / 2].0[column % 2][k];
            let stresses = Mat::from_fn(self.points, 2 * M, entry);
            let slopes = self.rows(slopes, 0..self.functions);
            matmul(work.as_mut(), Accum::Add, slopes, &stresses, 1.0, Par::Seq);
        }
        for (m, sum) in sums.into_iter().enumerate() {
            for (k, &number) in numbers.iter().enumerate() {
                (0..2).for_each(|i| sum[number * 2 + i] += work[(k, 2 * m + i)]);
            }
        }
    }

    /// Writes the value and the slopes of a function at as many points from `point` on as there are
    /// lanes.
    #[inline(always)]
    fn set<R: Real<Scalar = f64>>(&mut self, function: usize, point: usize, [v, x, y]: [R; 3]) {
        let (at, lanes) = (function * self.points + point, R::LANES.min(self.points - point));
        v.store_some(&mut self.value[at..at + lanes]);
        // one by one: lanes in an array would go through memory
        let [along_x, along_y, ..] = self.slopes.as_mut_slice() else { return };
        x.store_some(&mut along_x[at..at + lanes]);
        y.store_some(&mut along_y[at..at + lanes]);
    }

    /// Writes what the third operator makes of the functions, at points x.
    fn set_hoop(&mut self, x: impl Iterator<Item = f64> + Clone) {
        let [along_x, _, around] = self.slopes.as_mut_slice() else { return };
        let rows = self.value.iter().zip(along_x).zip(around);
        rows.zip(x.cycle()).for_each(|(((v, slope), to), x)| *to = hoop(*v, *slope, x));
    }

    /// Writes a factor times all monomials to functions from `function` on, at as many points from
    /// `point` on as there are lanes.
    #[inline(always)]
    fn set_products<R: Real<Scalar = f64>>(
        &mut self,
        function: usize,
        point: usize,
        f: Jet<R>,
        m: &Monomials<R>,
    ) {
        let (mut at, mut total) = (function, 0);
        while total <= m.degree {
            let mut b = 0;
            while b <= total {
                let a = total - b;
                let value = m.x[a] * m.y[b];
                let dx = f.x.mul_add(value, f.v * (m.dx[a] * m.y[b]));
                let dy = f.y.mul_add(value, f.v * (m.x[a] * m.dy[b]));
                self.set(at, point, [f.v * value, dx, dy]);
                at += 1;
                b += 1;
            }
            total += 1;
        }
    }
}

/// Evaluates shape functions; keeps what belongs to the last anchor.
#[derive(Debug)]
pub(crate) struct ShapeEvaluator<'s> {
    space: &'s TrialSpace<'s>,
    seen: Option<(EvaluationOrigin, LocalFunctions<'s>)>,
    scratch: BlockScratch<f64>,
    /// True if series of tips are evaluated as such, not as the functions that they are stored as.
    series: bool,
}

/// The origin from which functions are evaluated: the anchor, and the face that points lie on.
type EvaluationOrigin = (Vec2, Option<CrackFace>);

impl<'s> ShapeEvaluator<'s> {
    /// An evaluator for the functions of a space as they are stored.
    #[must_use]
    pub(crate) fn new(space: &'s TrialSpace<'s>) -> Self {
        Self { space, seen: None, scratch: BlockScratch::default(), series: false }
    }

    /// An evaluator for the functions that the solver takes: of the series of a tip those of their
    /// terms, 4N in place of 2N(N + 1).
    #[must_use]
    pub(crate) fn of_series(space: &'s TrialSpace<'s>) -> Self {
        Self { series: true, ..Self::new(space) }
    }

    /// The shape functions of `patches`, which must be all that cover the points.
    pub(crate) fn evaluate(
        &mut self,
        anchor: Vec2,
        offsets: &[Vec2],
        patches: &[u32],
        out: &mut Shapes,
    ) {
        self.fill((anchor, None), offsets, patches, out);
    }

    /// The shape functions at the points of a rule along an edge; on a face of a crack its side.
    pub(crate) fn evaluate_edge(&mut self, rule: &EdgeRule, out: &mut Shapes) {
        self.fill((rule.anchor, rule.face), &rule.offsets, &rule.patches, out);
    }

    fn fill(
        &mut self,
        seat: EvaluationOrigin,
        offsets: &[Vec2],
        patches: &[u32],
        out: &mut Shapes,
    ) {
        let (space, (anchor, face)) = (self.space, seat);
        if self.seen.as_ref().is_none_or(|(known, _)| *known != seat) {
            self.seen = Some((seat, functions(space, seat)));
        }
        let Some((_, functions)) = &self.seen else { return };
        let size = |&p: &u32| match self.series {
            true => space.evaluated(p as usize),
            false => space.sizes[p as usize],
        };
        let operators = operators(space.equation());
        out.resize(patches.iter().map(size).sum(), offsets.len(), operators);
        let groups = groups_of(space, patches);
        let blocks = self.blocks(anchor, patches, &groups);
        f64::dispatch(PointFill {
            space,
            functions,
            anchor,
            side: face.map_or(Side::Above, |face| face.side),
            offsets,
            patches,
            blocks: &blocks,
            groups: &groups,
            scratch: &mut self.scratch,
            out: &mut *out,
        });
        out.set_hoop(offsets.iter().map(|offset| anchor.x + offset.x));
    }
}

fn functions<'s>(
    space: &'s TrialSpace<'s>,
    (anchor, face): EvaluationOrigin,
) -> LocalFunctions<'s> {
    let cracks = &space.step().cracks;
    match face {
        Some(face) => space.functions.on(cracks, face.segment, anchor),
        None => space.functions.at(cracks, anchor),
    }
}

/// The function groups that the blocks of some patches use, ascending.
fn groups_of(space: &TrialSpace<'_>, patches: &[u32]) -> Vec<usize> {
    let blocks = patches.iter().flat_map(|&p| space.data().blocks(p as usize));
    let mut groups: Vec<_> = blocks
        .filter_map(|b| match space.functions.of(space.data().block_function[b]) {
            Slot::One => None,
            Slot::Jet { group, .. } => Some(group as usize),
        })
        .collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// Functions of a patch that are evaluated together.
struct FunctionBatch {
    /// The place of the patch among those of the points.
    patch: usize,
    degree: usize,
    /// The constant that its function is shifted by.
    shift: f64,
    /// Its function, and of a series those after it; in place of the function 1 there is none.
    functions: [Option<GroupEntry>; GROUP],
    series: Option<TipTerms>,
}

/// A function: the place of its group among those that are evaluated, and its entry there.
type GroupEntry = [usize; 2];

/// The terms of a series of a tip.
#[derive(Clone, Copy)]
struct TipTerms {
    count: usize,
    frame: PatchTipFrame,
    /// From the tip to the anchor.
    from_tip: Vec2,
    /// The roots of an anisotropic body.
    roots: Option<[Complex<f64>; 2]>,
}

impl ShapeEvaluator<'_> {
    /// The functions of some patches seen from an anchor, in order.
    fn blocks(&self, anchor: Vec2, patches: &[u32], groups: &[usize]) -> Vec<FunctionBatch> {
        let data = self.space.data();
        let of_patch = |(place, &patch): (usize, &u32)| {
            let all = self.space.series(patch as usize).iter();
            let series: Vec<_> =
                all.filter_map(|series| self.terms(anchor, patch, series)).collect();
            let block = move |b: usize| {
                let own = series.iter().find(|(blocks, _)| blocks.contains(&b));
                let functions = own.map_or(b..b + 1, |(blocks, _)| blocks.clone());
                let mut entries = [None; GROUP];
                functions
                    .clone()
                    .zip(&mut entries)
                    .for_each(|(b, entry)| *entry = self.entry(b, groups));
                (functions.start == b).then(|| FunctionBatch {
                    patch: place,
                    degree: data.block_degree[b].into(),
                    shift: self.space.shifts[b],
                    functions: entries,
                    series: own.map(|(_, terms)| *terms),
                })
            };
            data.blocks(patch as usize).filter_map(block)
        };
        patches.iter().enumerate().flat_map(of_patch).collect()
    }

    /// The terms of a tip's series if these are evaluated as such, and the blocks that they take
    /// the place of.
    fn terms(
        &self,
        anchor: Vec2,
        patch: u32,
        series: &SeriesFunctions,
    ) -> Option<(Range<usize>, TipTerms)> {
        let Origin::Tip(tip, _) = series.origin else { return None };
        let frame = PatchTipFrame::new(self.space.step(), patch as usize, tip);
        let roots = frame.roots(self.space.equation());
        let terms = TipTerms { count: series.terms(), frame, from_tip: anchor - frame.at, roots };
        self.series.then(|| (series.blocks.clone(), terms))
    }

    /// The function of a block.
    fn entry(&self, block: usize, groups: &[usize]) -> Option<GroupEntry> {
        match self.space.functions.of(self.space.data().block_function[block]) {
            Slot::One => None,
            Slot::Jet { group, entry } => {
                groups.binary_search(&(group as usize)).ok().map(|at| [at, entry as usize])
            }
        }
    }
}

/// Work on all points of an evaluation origin, one vector of points after the other.
struct PointFill<'a, 's> {
    space: &'a TrialSpace<'s>,
    functions: &'a LocalFunctions<'s>,
    anchor: Vec2,
    side: Side,
    offsets: &'a [Vec2],
    patches: &'a [u32],
    groups: &'a [usize],
    blocks: &'a [FunctionBatch],
    scratch: &'a mut BlockScratch<f64>,
    out: &'a mut Shapes,
}

impl LaneJob<f64> for PointFill<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(mut self, zero: R) {
        let points = in_vectors(self.offsets, zero);
        let jets = self.jets(&points, zero);
        let partition = self.partition(&points, zero);
        let (n, mut b, mut next) = (points.len(), 0, 0);
        while b < self.blocks.len() {
            let block = &self.blocks[b];
            let phi = &partition[block.patch * n..(block.patch + 1) * n];
            next += match &block.series {
                None => self.products(block, next, &points, phi, &jets),
                Some(terms) => self.terms(block, terms, next, &points, phi, &jets),
            };
            b += 1;
        }
    }
}

/// Points in vectors; the last point stands in for those that are missing in the last vector.
#[inline(always)]
fn in_vectors<R: Real<Scalar = f64>>(points: &[Vec2], zero: R) -> Vec<[R; 2]> {
    let mut vectors = Vec::with_capacity(points.len().div_ceil(R::LANES));
    let mut first = 0;
    while first < points.len() {
        let at = |lane: usize| points[(first + lane).min(points.len() - 1)];
        vectors.push([zero.with_lanes(|lane| at(lane).x), zero.with_lanes(|lane| at(lane).y)]);
        first += R::LANES;
    }
    vectors
}

impl PointFill<'_, '_> {
    /// The functions of all groups: those of the first group at all points, then those of the next.
    #[inline(always)]
    fn jets<R: Real<Scalar = f64>>(&mut self, points: &[[R; 2]], zero: R) -> Vec<[Jet<R>; GROUP]> {
        let n = points.len();
        let mut jets = vec![[Jet::constant(zero); GROUP]; self.groups.len() * n];
        let mut k = 0;
        while k < self.groups.len() {
            let out = &mut jets[k * n..(k + 1) * n];
            self.functions.fill::<R, 1>(self.groups[k], points, self.side, self.scratch, out);
            k += 1;
        }
        jets
    }

    /// The partition functions φ of the patches, in the same order; exactly 1 where a patch
    /// is alone.
    #[inline(always)]
    fn partition<R: Real<Scalar = f64>>(&self, points: &[[R; 2]], zero: R) -> Vec<Jet<R>> {
        let (n, one) = (points.len(), zero.broadcast(1.0));
        let mut all = vec![Jet::constant(one); self.patches.len() * n];
        if self.patches.len() == 1 {
            return all;
        }
        let partition = self.space.partition();
        let mut sums = vec![Jet::constant(zero); n];
        let mut at = 0;
        while at < self.patches.len() {
            let patch = self.patches[at] as usize;
            let inverse = reciprocal(partition.half[patch]);
            let mut k = 0;
            while k < n {
                let xi = self.local(points[k], partition.center[patch], inverse);
                let w = partition.weight.tensor::<R, 1>(xi, [inverse.x, inverse.y]);
                sums[k] = sums[k].plus::<1>(w);
                all[at * n + k] = w;
                k += 1;
            }
            at += 1;
        }
        let mut k = 0;
        while k < all.len() {
            all[k] = all[k].over::<1>(sums[k % n]);
            k += 1;
        }
        all
    }

    #[inline(always)]
    fn local<R: Real<Scalar = f64>>(&self, point: [R; 2], origin: Vec2, inverse: Vec2) -> [R; 2] {
        let d = self.anchor - origin;
        let [x, y] = point;
        [
            (x.broadcast(d.x) + x) * x.broadcast(inverse.x),
            (y.broadcast(d.y) + y) * y.broadcast(inverse.y),
        ]
    }

    /// Writes a block's function times monomials, from a function on; returns their number.
    #[inline(always)]
    fn products<R: Real<Scalar = f64>>(
        &mut self,
        block: &FunctionBatch,
        first: usize,
        points: &[[R; 2]],
        phi: &[Jet<R>],
        jets: &[[Jet<R>; GROUP]],
    ) -> usize {
        let (patch, partition) = (self.patches[block.patch] as usize, self.space.partition());
        let (inverse, n) = (reciprocal(partition.scale[patch]), points.len());
        let mut k = 0;
        while k < n {
            let factor = match block.functions[0] {
                None => phi[k],
                Some([group, entry]) => {
                    let mut function = jets[group * n + k][entry];
                    function.v = function.v - phi[k].v.broadcast(block.shift);
                    phi[k].times::<1>(function)
                }
            };
            let xi = self.local(points[k], partition.origin[patch], inverse);
            let monomials = Monomials::new(xi, inverse, block.degree);
            self.out.set_products(first, k * R::LANES, factor, &monomials);
            k += 1;
        }
        monomials_of(block.degree)
    }

    /// Writes c, s, C and S of all terms of a tip, from a function on; returns their number. With z
    /// in the frame of the tip they are zⁿ √r e^{iθ/2} and zⁿ √r e^{−3iθ/2}, made of the functions
    /// of the tip as [`Origin::Tip`] has it; of an anisotropic body w₁ z₁ⁿ and the divided
    /// differences of w_k z_kⁿ.
    #[inline(always)]
    fn terms<R: Real<Scalar = f64>>(
        &mut self,
        block: &FunctionBatch,
        terms: &TipTerms,
        first: usize,
        points: &[[R; 2]],
        phi: &[Jet<R>],
        jets: &[[Jet<R>; GROUP]],
    ) -> usize {
        let (n, mut k) = (points.len(), 0);
        while k < n {
            let mut f = [phi[k]; GROUP];
            let mut j = 0;
            while j < GROUP {
                if let Some([group, entry]) = block.functions[j] {
                    f[j] = phi[k].times::<1>(jets[group * n + k][entry]);
                }
                j += 1;
            }
            let two = phi[k].v.broadcast(2.0);
            if terms.roots.is_none() {
                f[2] = f[0].minus::<1>(f[2].scaled::<1>(two));
                f[3] = f[1].minus::<1>(f[3].scaled::<1>(two));
            }
            let z = terms.z(points[k]);
            let mut function = first;
            while function < first + ANGULAR * terms.count {
                j = 0;
                while j < ANGULAR {
                    self.out.set(function + j, k * R::LANES, [f[j].v, f[j].x, f[j].y]);
                    j += 1;
                }
                f = match &terms.roots {
                    Some(roots) => next_divided(z, roots, f),
                    None => {
                        let [c, s] = complex(z, [f[0], f[1]]);
                        let [c2, s2] = complex(z, [f[2], f[3]]);
                        [c, s, c2, s2]
                    }
                };
                function += ANGULAR;
            }
            k += 1;
        }
        ANGULAR * terms.count
    }
}

impl TipTerms {
    /// z = x + iy in the frame of the tip, in its unit.
    #[inline(always)]
    fn z<R: Real<Scalar = f64>>(&self, [x, y]: [R; 2]) -> [Jet<R>; 2] {
        let PatchTipFrame { axis, unit, .. } = self.frame;
        let (c, s) = (x.broadcast(axis.x * unit), x.broadcast(axis.y * unit));
        let (x, y) = (x + x.broadcast(self.from_tip.x), y + y.broadcast(self.from_tip.y));
        let zero = Jet::constant(x.broadcast(0.0));
        let re = Jet { v: c * x + s * y, x: c, y: s, ..zero };
        [re, Jet { v: c * y - s * x, x: x.broadcast(0.0) - s, y: c, ..zero }]
    }
}

/// w₁ z₁ and z₂ D + y w₁ from w₁ and D.
#[inline(always)]
fn next_divided<R: Real>(
    [x, y]: [Jet<R>; 2],
    [s1, s2]: &[Complex<f64>; 2],
    [w, v, d, e]: [Jet<R>; GROUP],
) -> [Jet<R>; GROUP] {
    let (z1, z2) = (from_root(x, y, s1), from_root(x, y, s2));
    let ([re, im], [d, e]) = (complex(z1, [w, v]), complex(z2, [d, e]));
    [re, im, d.plus::<1>(y.times::<1>(w)), e.plus::<1>(y.times::<1>(v))]
}

/// x + s y.
#[inline(always)]
fn from_root<R: Real>(x: Jet<R>, y: Jet<R>, s: &Complex<f64>) -> [Jet<R>; 2] {
    let (a, b) = (y.v.broadcast(s.0), y.v.broadcast(s.1));
    [x.plus::<1>(y.scaled::<1>(a)), y.scaled::<1>(b)]
}

/// The product of two complex functions.
#[inline(always)]
fn complex<R: Real>([a, b]: [Jet<R>; 2], [c, d]: [Jet<R>; 2]) -> [Jet<R>; 2] {
    let re = a.times::<1>(c).minus::<1>(b.times::<1>(d));
    [re, a.times::<1>(d).plus::<1>(b.times::<1>(c))]
}

fn reciprocal(v: Vec2) -> Vec2 {
    ppum::vec2::vec2(1.0 / v.x, 1.0 / v.y)
}

/// Powers of ξ and η up to a degree, and their derivatives in the world.
struct Monomials<R> {
    degree: usize,
    x: [R; MAX_DEGREE + 1],
    y: [R; MAX_DEGREE + 1],
    dx: [R; MAX_DEGREE + 1],
    dy: [R; MAX_DEGREE + 1],
}

impl<R: Real<Scalar = f64>> Monomials<R> {
    #[inline(always)]
    fn new([xi, eta]: [R; 2], inverse: Vec2, degree: usize) -> Self {
        let (zero, one) = (xi.broadcast(0.0), xi.broadcast(1.0));
        let (mut x, mut y) = ([one; MAX_DEGREE + 1], [one; MAX_DEGREE + 1]);
        let (mut dx, mut dy) = ([zero; MAX_DEGREE + 1], [zero; MAX_DEGREE + 1]);
        let mut k = 1;
        while k <= degree {
            dx[k] = x[k - 1] * xi.broadcast(k as f64 * inverse.x);
            dy[k] = y[k - 1] * xi.broadcast(k as f64 * inverse.y);
            (x[k], y[k]) = (x[k - 1] * xi, y[k - 1] * eta);
            k += 1;
        }
        Self { degree, x, y, dx, dy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::field::Field;
    use ppum_testkit::fields::{DrawingCase, coverings, functions, junctions};
    use ppum_testkit::random::Random;

    /// Points near each other in a dataset's domain, with the patches that cover any of them.
    fn points(
        random: &mut Random,
        space: &TrialSpace<'_>,
        n: usize,
    ) -> (Vec2, Vec<Vec2>, Vec<u32>) {
        let partition = space.partition();
        let cell = random.below(partition.len());
        let rect = partition.cell[cell];
        let offset = |p: Vec2| p - rect.center();
        let offsets = (0..n).map(|_| offset(random.point(&rect))).collect();
        (rect.center(), offsets, space.covering_patches[cell].clone())
    }

    /// Combined with coefficients, all functions at all points are what the field is there, point
    /// by point: any number of points, weights and orders, jumps, tips and formulas.
    #[test]
    fn shapes_are_those_of_the_field() {
        let mut random = Random(5);
        let cases = coverings().into_iter().chain(functions()).chain(junctions());
        for DrawingCase { name, dataset, .. } in cases {
            let step = &dataset.steps[0];
            let space = TrialSpace::new(step, &dataset.domain, &dataset.equation, &dataset.tables)
                .expect("the corpus compiles");
            let field = Field::new(&dataset, 0).expect("the corpus is in order");
            let (mut evaluator, mut shapes) = (ShapeEvaluator::new(&space), Shapes::default());
            for n in [1, 7, 8, 21] {
                let (anchor, offsets, patches) = points(&mut random, &space, n);
                evaluator.evaluate(anchor, &offsets, &patches, &mut shapes);
                let local = field.at(anchor);
                for (q, offset) in offsets.iter().enumerate() {
                    let mut expected = vec![ZERO; field.components()];
                    let at = [offset.x, offset.y];
                    local.over_patches::<f64, 1>(at, Side::Above, &patches, &mut expected);
                    for (component, expected) in expected.iter().enumerate() {
                        let (found, size) = combined(&space, &shapes, &patches, component, q);
                        let expected = [expected.v, expected.x, expected.y];
                        // slopes of φ are differences of terms as large as 1 over the size of
                        // a patch
                        let halves =
                            patches.iter().map(|&k| step.partition.boxes().half[k as usize]);
                        let least = halves.fold(f64::INFINITY, |h, half| h.min(half.x.min(half.y)));
                        for k in 0..3 {
                            let apart = (found[k] - expected[k]).abs();
                            let size = size[k].max(if k > 0 { size[0] / least } else { 0.0 });
                            assert!(apart <= 1e-12 * size, "{name}: {found:?} {expected:?}");
                        }
                    }
                }
            }
        }
    }

    const ZERO: Jet<f64> = Jet { v: 0.0, x: 0.0, y: 0.0, xx: 0.0, xy: 0.0, yy: 0.0 };

    /// A component and its slopes at a point, and the sums of the sizes of all terms.
    fn combined(
        space: &TrialSpace<'_>,
        shapes: &Shapes,
        patches: &[u32],
        component: usize,
        q: usize,
    ) -> ([f64; 3], [f64; 3]) {
        let (mut sum, mut size, mut at) = ([0.0; 3], [0.0; 3], q);
        for &patch in patches {
            let data = space.data();
            let blocks = data.blocks(patch as usize);
            let plain = blocks.flat_map(|block| data.block_coefficients(block, component));
            for c in shifted(space, patch as usize, &plain.copied().collect::<Vec<_>>()) {
                for (k, array) in shapes.arrays().enumerate() {
                    sum[k] += c * array[at];
                    size[k] += (c * array[at]).abs();
                }
                at += shapes.points;
            }
        }
        (sum, size)
    }
    /// The coefficients of a patch's functions as they are evaluated, from those of the dataset:
    /// Σ c f = Σ c (f − σ) + σ c.
    fn shifted(space: &TrialSpace<'_>, patch: usize, plain: &[f64]) -> Vec<f64> {
        let (mut coefficients, mut first) = (plain.to_vec(), 0);
        for block in space.data().blocks(patch) {
            let size = monomials_of(space.data().block_degree[block].into());
            for k in 0..size {
                coefficients[k] += space.shifts[block] * plain[first + k];
            }
            first += size;
        }
        coefficients
    }
}
