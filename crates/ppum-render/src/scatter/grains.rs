//! Grains: patches of so few pixels of a tile that each pair of a grain and one of its pixels is a lane.
//!
//! Where cells are smaller than a few pixels a strip is not worth its tables. The pairs of a tile are taken some at a time, in the
//! order of the patches; what the evaluation needs of each, its coordinates and coefficients, is laid side by side, W and
//! W v are evaluated on lanes of pairs,
//!
//! ```text
//! W = a(ξ) b(η)     v = Σ_e f_e p_e(ξ, η)
//! ```
//!
//! and added to the sums of the pixels in memory, one pair after the other. The blocks of function 1 come first, for all grains of the tile;
//! a round for each group of functions follows, of the grains that have it. So a pixel is added to in an order that does not depend on
//! the number of lanes. What the grains leave is what a batch of strips leaves, and the last batch finishes it.

#[cfg(test)]
mod tests;

use std::ops::Range;

use ppum::crack::Side;
use ppum::dataset::{MAX_DEGREE, monomials};
use ppum::function::{GROUP, Slot};
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::real::{Real, Scalar};
use ppum::weight::WeightFunction;

use super::collapse::ROWS;
use super::lists::Seen;
use super::plan::{Block, COLUMNS, Plan};
use super::sums::{size, store_jet};
use super::tile::{Scratch, Tile};

/// Pairs that are evaluated together: their numbers fill half of the nearest cache, and grains of [`MOST_PIXELS`](super::lists::MOST_PIXELS)
/// pixels leave few of them free.
const PAIRS: usize = 64;

/// Vectors of pairs at which functions are evaluated at a time.
const VECTORS: usize = 4;

/// Components that are summed in a round.
const PASS: usize = 2;

/// A number that is the same at all pairs of a grain is written for so many at a time, also where there are fewer.
const STEP: usize = 4;

/// A number of each pair.
type Row<T> = [T; PAIRS + STEP];

/// Rows of a pair's numbers: the offset from the centre of the support, the half-extents, the offset from the origin of the
/// polynomials, their scale, the offset from the view's centre, then coefficients. Where no kernel has the weight, its factors and
/// their slopes are in place of the first four.
const SUPPORT: usize = 0;
const HALF: usize = 2;
const FRAME: usize = 4;
const SCALE: usize = 6;
const OFFSET: usize = 8;
const COEFFICIENTS: usize = 10;

/// Pairs at hand, and the memory for them.
#[derive(Debug, Default)]
pub(super) struct Grains<T> {
    rows: Vec<Row<T>>,
    /// Of each pair the first of its numbers in the sums.
    cells: Vec<u32>,
    /// The first pair of each grain.
    firsts: Vec<u32>,
    /// Highest degree of their polynomials.
    degree: usize,
    /// Grains with what is to be added of them, see [`Need`].
    list: Vec<Need>,
    more: Vec<Need>,
    /// W and W v at a vector of pairs.
    products: Vec<T>,
}

/// 0 for function 1 and 1 + g for the group g, and the place of a grain that has it.
type Need = [u32; 2];

/// What is added in a round.
#[derive(Clone, Copy, Debug)]
struct Round {
    /// The functions; none for function 1.
    group: Option<u32>,
    /// Their number.
    functions: usize,
    /// The first of the components, and how many.
    component: usize,
    components: usize,
}

impl Round {
    /// True if the weights are summed too.
    fn has_weights(self) -> bool {
        self.group.is_none() && self.component == 0
    }

    /// What is subtracted from the constant of a component in this round.
    #[inline(always)]
    fn shift(self, shift: &[f64], component: usize) -> f64 {
        if self.group.is_none() { shift[self.component + component] } else { 0.0 }
    }

    /// The row of the first coefficient of a function and a component.
    #[inline(always)]
    fn row(self, function: usize, component: usize) -> usize {
        COEFFICIENTS + (function * PASS + component) * monomials(MAX_DEGREE)
    }

    /// The function of a block, if it is of this round.
    #[inline(always)]
    fn function(self, block: &Block) -> Option<usize> {
        match (block.function, self.group) {
            (Slot::One, None) => Some(0),
            (Slot::Jet { group, entry }, Some(of)) if group == of => Some(entry as usize),
            _ => None,
        }
    }
}

/// Where sums lie: numbers of a column of vectors and of a vector of points, and the binary logarithm of the lanes.
#[derive(Clone, Copy, Debug)]
struct Layout {
    corner: [usize; 2],
    column: usize,
    stride: usize,
    lanes: u32,
}

impl Layout {
    /// Where the sums of a pixel begin.
    #[inline(always)]
    fn cell(self, column: usize, row: usize) -> usize {
        let [x, y] = [column - self.corner[0], row - self.corner[1]];
        (x >> self.lanes) * self.column + y * self.stride + (x & ((1 << self.lanes) - 1))
    }
}

impl<T: Scalar> Grains<T> {
    /// Takes grains from a list, as many as there is room for; returns how many.
    fn take(
        &mut self,
        plan: &Plan<'_>,
        seen: &[Seen],
        list: &[Need],
        (round, shift): (Round, &[f64]),
        layout: Layout,
    ) -> usize {
        self.cells.clear();
        self.degree = 0;
        if self.rows.len() < round.row(round.functions, 0) {
            self.rows.resize(round.row(round.functions, 0), [T::default(); PAIRS + STEP]);
        }
        self.firsts.clear();
        for &[_, place] in list {
            let first = self.cells.len();
            if !self.add_pixels(plan, &seen[place as usize], layout) {
                break;
            }
            self.firsts.push(first as u32);
        }
        for (k, &[_, place]) in list.iter().enumerate().take(self.firsts.len()) {
            let end = self.firsts.get(k + 1).map_or(self.cells.len(), |&next| next as usize);
            let pairs = self.firsts[k] as usize..end;
            self.add_polynomials(plan, [seen[place as usize].patch, place], (round, shift), &pairs);
        }
        self.firsts.len()
    }

    /// Writes the coefficients of a grain for its pairs, and notes the groups of functions that it has.
    #[inline(always)]
    fn add_polynomials(
        &mut self,
        plan: &Plan<'_>,
        [patch, place]: [u32; 2],
        (round, shift): (Round, &[f64]),
        pairs: &Range<usize>,
    ) {
        let mut has = [false; GROUP];
        for block in plan.of_field(patch) {
            let block = plan.block(block);
            if let Some(function) = round.function(&block) {
                self.add_block(plan, &block, (round, shift), has[function], pairs);
                has[function] = true;
            } else if let Slot::Jet { group, .. } = block.function
                && round.has_weights()
            {
                self.more.push([1 + group, place]);
            }
        }
        if let Some(block) = plan.of_partition(patch) {
            self.add_block(plan, &block, (round, shift), false, pairs);
            has[0] = true;
        }
        self.clear_missing((round, shift), has, pairs);
    }

    /// Adds the pixels of a grain in the tile; false if there is no room. Differences are rounded when they have been formed.
    #[inline(always)]
    fn add_pixels(&mut self, plan: &Plan<'_>, seen: &Seen, layout: Layout) -> bool {
        let [columns, lines] = seen.within(layout.corner);
        if self.cells.len() + columns.len() * lines.len() > PAIRS {
            return false;
        }
        let (partition, anchor) = (&plan.field.step.partition, plan.view.center);
        let k = seen.patch as usize;
        let (center, half) = (partition.center[k] - anchor, partition.half[k]);
        let (mut origin, mut scale) = (center, half);
        if seen.has_frame {
            (origin, scale) = (partition.origin[k] - anchor, partition.scale[k]);
        }
        let [xs, ys] = &plan.offsets;
        let rows: &mut [Row<T>; COEFFICIENTS] =
            self.rows.first_chunk_mut().expect("rows for coordinates");
        for row in lines {
            let y = ys[row];
            for column in columns.clone() {
                let (x, pair) = (xs[column], self.cells.len() % PAIRS);
                let from_center = [x - center.x, y - center.y, half.x, half.y];
                let from_origin = [x - origin.x, y - origin.y, scale.x, scale.y];
                for at in 0..4 {
                    rows[SUPPORT + at][pair] = T::from_f64(from_center[at]);
                    rows[FRAME + at][pair] = T::from_f64(from_origin[at]);
                }
                rows[OFFSET][pair] = T::from_f64(x);
                rows[OFFSET + 1][pair] = T::from_f64(y);
                self.cells.push(layout.cell(column, row) as u32);
            }
        }
        true
    }

    /// Writes the coefficients of a block for the pairs of a grain, or adds them if there is one of its function before.
    #[inline(always)]
    fn add_block(
        &mut self,
        plan: &Plan<'_>,
        block: &Block,
        (round, shift): (Round, &[f64]),
        has_one: bool,
        pairs: &Range<usize>,
    ) {
        let (degree, function) = (block.degree.into(), round.function(block).unwrap_or(0));
        if degree > self.degree {
            self.raise(round, degree);
        }
        for c in 0..round.components {
            let all = plan.block_coefficients(block, round.component + c);
            let (all, first) = (&all[..monomials(degree)], round.row(function, c));
            if has_one {
                self.add(first, all, pairs);
            } else {
                self.write(first, all, round.shift(shift, c), pairs);
            }
        }
    }

    /// Writes zeros, less the shift, where a grain has no block of a function.
    #[inline(always)]
    fn clear_missing(
        &mut self,
        (round, shift): (Round, &[f64]),
        has: [bool; GROUP],
        pairs: &Range<usize>,
    ) {
        for (function, has_one) in has.into_iter().enumerate().take(round.functions) {
            for c in 0..if has_one { 0 } else { round.components } {
                self.write(round.row(function, c), &[0.0], round.shift(shift, c), pairs);
            }
        }
    }

    /// Raises the degree of the polynomials: of those that are there the new coefficients are zero.
    #[cold]
    fn raise(&mut self, round: Round, degree: usize) {
        let new = monomials(self.degree)..monomials(degree);
        for slot in 0..round.functions * PASS {
            let first = round.row(0, slot);
            self.rows[first..][new.clone()].fill([T::default(); PAIRS + STEP]);
        }
        self.degree = degree;
    }

    /// Writes the coefficients of a polynomial, and zeros behind them, for the pairs of a grain and perhaps for some that are still
    /// to come; `shift` is subtracted from the first.
    #[inline(always)]
    fn write(&mut self, first: usize, all: &[f64], shift: f64, pairs: &Range<usize>) {
        let rows = &mut self.rows[first..][..monomials(self.degree)];
        let mut pair = pairs.start;
        while pair < pairs.end {
            let (own, others) = rows.split_at_mut(all.len());
            for (row, &coefficient) in own.iter_mut().zip(all) {
                put(row, pair, T::from_f64(coefficient));
            }
            put(&mut own[0], pair, T::from_f64(all[0] - shift));
            for row in others {
                put(row, pair, T::default());
            }
            pair += STEP;
        }
    }

    /// Adds the coefficients of a polynomial: a patch may have several of one function.
    #[cold]
    fn add(&mut self, first: usize, all: &[f64], pairs: &Range<usize>) {
        for (row, coefficient) in self.rows[first..].iter_mut().zip(all) {
            for number in &mut row[pairs.clone()] {
                *number = T::from_f64(number.to_f64() + coefficient);
            }
        }
    }

    /// Finds the factors of weights where no kernel has them.
    fn find_factors(&mut self, weight: &WeightFunction, is_overlap: bool) {
        let pairs = 0..self.cells.len();
        for axis in 0..2 {
            let halves: Vec<_> =
                self.rows[HALF + axis][pairs.clone()].iter().map(|h| h.to_f64()).collect();
            let offsets = self.rows[SUPPORT + axis][pairs.clone()].iter().zip(&halves);
            let xis: Vec<_> = offsets.map(|(x, half)| x.to_f64() / half).collect();
            let inside = |xi: &f64| [f64::from((-1.0..1.0).contains(xi)), 0.0];
            let factors =
                if is_overlap { xis.iter().map(inside).collect() } else { weight.at_many(&xis) };
            for (pair, [value, slope]) in factors.into_iter().enumerate() {
                self.rows[SUPPORT + axis][pair] = T::from_f64(value);
                self.rows[HALF + axis][pair] = T::from_f64(slope / halves[pair]);
            }
        }
    }

    /// A number of a vector of pairs.
    #[inline(always)]
    fn load<R: Real<Scalar = T>>(&self, row: usize, pair: usize, like: R) -> R {
        like.load(&self.rows[row][pair..])
    }

    /// The polynomial whose coefficients begin at a row, with derivatives in the world.
    #[inline(always)]
    fn polynomial<R: Real<Scalar = T>, const D: usize>(
        &self,
        first: usize,
        pair: usize,
        [xi, eta]: [R; 2],
        scale: [R; 2],
    ) -> Jet<R> {
        let rows = &self.rows[first..][..monomials(self.degree)];
        let mut v = Jet::constant(xi.lit(0.0));
        let mut k = self.degree + 1;
        while k > 0 {
            k -= 1;
            // Σ_j c_kj η^j and its derivative by η
            let (mut a, mut b) = (xi.lit(0.0), xi.lit(0.0));
            let mut j = self.degree - k + 1;
            while j > 0 {
                j -= 1;
                let c = xi.load(&rows[monomials(j + k) - 1 - k][pair..]);
                if D >= 1 {
                    b = b.mul_add(eta, a);
                }
                a = a.mul_add(eta, c);
            }
            if D >= 1 {
                v.x = v.x.mul_add(xi, v.v);
                v.y = v.y.mul_add(xi, b);
            }
            v.v = v.v.mul_add(xi, a);
        }
        if D >= 1 {
            (v.x, v.y) = (v.x * scale[0], v.y * scale[1]);
        }
        v
    }
}

/// Writes a number for the pairs of a step.
#[inline(always)]
fn put<T: Scalar>(row: &mut Row<T>, pair: usize, number: T) {
    row[pair..][..STEP].copy_from_slice(&[number; STEP]);
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Sums over the grains: function 1 of all, then the groups of functions, each of those that have it.
    #[inline(always)]
    pub(super) fn add_grains<R: Real<Scalar = T>>(
        &self,
        grains: &[u32],
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        scratch.sums.clear();
        scratch.sums.resize(COLUMNS / R::LANES * self.layout::<R>().column, T::default());
        let mut list = std::mem::take(&mut scratch.grains.list);
        list.clear();
        list.extend(grains.iter().map(|&place| [0, place]));
        let mut start = 0;
        while start < list.len() {
            let of = list[start][0];
            let end = start + list[start..].partition_point(|&[other, _]| other == of);
            self.add_rounds(of, &list[start..end], scratch, zero);
            if of == 0 {
                let more = &mut scratch.grains.more;
                more.sort_unstable();
                more.dedup();
                list.append(more);
            }
            start = end;
        }
        scratch.grains.list = list;
    }

    /// Adds grains, some components at a time.
    #[inline(always)]
    fn add_rounds<R: Real<Scalar = T>>(
        &self,
        of: u32,
        list: &[Need],
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let all = self.scene.plan.coefficients.len();
        let group = of.checked_sub(1);
        let table = self.scene.functions.table();
        let functions = group.map_or(1, |group| table.group_len(group as usize));
        let mut component = 0;
        while component == 0 || component < all {
            let components = PASS.min(all - component);
            let round = Round { group, functions, component, components };
            let mut rest = list;
            while !rest.is_empty() {
                let Scratch { grains, shift, .. } = &mut *scratch;
                let (seen, layout) = (&self.lists.seen, self.layout::<R>());
                let taken = grains.take(&self.scene.plan, seen, rest, (round, shift), layout);
                rest = &rest[taken..];
                self.add_pairs(round, scratch, zero);
            }
            component += PASS;
        }
    }

    fn layout<R: Real<Scalar = T>>(&self) -> Layout {
        let stride = self.stride::<R>();
        let lanes = R::LANES.trailing_zeros();
        Layout { corner: self.corner(), column: ROWS * stride, stride, lanes }
    }

    /// Adds the pairs at hand.
    #[inline(always)]
    fn add_pairs<R: Real<Scalar = T>>(&self, round: Round, scratch: &mut Scratch<T>, zero: R) {
        let is_overlap = *self.scene.quantity == Quantity::Overlap;
        let is_given = is_overlap || matches!(self.scene.weight, WeightFunction::Formula(_));
        if is_given {
            scratch.grains.find_factors(self.scene.weight, is_overlap);
        }
        let mut jets = [[Jet::constant(zero); GROUP]; VECTORS];
        let count = scratch.grains.cells.len();
        let mut first = 0;
        while first < count {
            if let Some(group) = round.group {
                self.evaluate_at_pairs(group, first, &mut jets, scratch, zero);
            }
            let mut k = 0;
            while k < VECTORS && first + k * R::LANES < count {
                let pair = first + k * R::LANES;
                self.multiply(round, pair, is_given, &jets[k], &mut scratch.grains, zero);
                self.add_products::<R>(round, pair, scratch);
                k += 1;
            }
            first += VECTORS * R::LANES;
        }
    }

    /// Evaluates the functions of a group at some vectors of pairs.
    #[inline(always)]
    fn evaluate_at_pairs<R: Real<Scalar = T>>(
        &self,
        group: u32,
        first: usize,
        jets: &mut [[Jet<R>; GROUP]; VECTORS],
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let Scratch { grains, formulas, .. } = scratch;
        let count = (grains.cells.len() - first).div_ceil(R::LANES).min(VECTORS);
        let mut offsets = [[zero; 2]; VECTORS];
        let mut k = 0;
        while k < count {
            let pair = first + k * R::LANES;
            offsets[k] = [grains.load(OFFSET, pair, zero), grains.load(OFFSET + 1, pair, zero)];
            k += 1;
        }
        let functions = &self.scene.functions;
        functions.fill::<R, D>(group as usize, &offsets[..count], Side::Above, formulas, jets);
    }

    /// W and W v at a vector of pairs.
    #[inline(always)]
    fn multiply<R: Real<Scalar = T>>(
        &self,
        round: Round,
        pair: usize,
        is_given: bool,
        jets: &[Jet<R>; GROUP],
        grains: &mut Grains<T>,
        zero: R,
    ) {
        let weight = self.pair_weight(pair, is_given, grains, zero);
        let size = size::<R, D>();
        if grains.products.len() < size * (1 + PASS) {
            grains.products.resize(size * (1 + PASS), T::default());
        }
        store_jet::<R, D>(weight, &mut grains.products);
        let (mut xi, mut scale, mut axis) = ([zero; 2], [zero; 2], 0);
        while axis < 2 {
            scale[axis] = zero.lit(1.0) / grains.load(SCALE + axis, pair, zero);
            xi[axis] = grains.load(FRAME + axis, pair, zero) * scale[axis];
            axis += 1;
        }
        let mut c = 0;
        while c < round.components {
            let mut v = Jet::constant(zero);
            let mut f = 0;
            while f < round.functions {
                let p = grains.polynomial::<R, D>(round.row(f, c), pair, xi, scale);
                v = if round.group.is_none() { p } else { v.plus::<D>(p.times::<D>(jets[f])) };
                f += 1;
            }
            store_jet::<R, D>(weight.times::<D>(v), &mut grains.products[(1 + c) * size..]);
            c += 1;
        }
    }

    /// W at a vector of pairs.
    #[inline(always)]
    fn pair_weight<R: Real<Scalar = T>>(
        &self,
        pair: usize,
        is_given: bool,
        grains: &Grains<T>,
        zero: R,
    ) -> Jet<R> {
        let mut factors = [[zero; 2]; 2];
        let mut axis = 0;
        while axis < 2 {
            let at = grains.load(SUPPORT + axis, pair, zero);
            let half = grains.load(HALF + axis, pair, zero);
            factors[axis] = [at, half];
            if !is_given {
                let scale = zero.lit(1.0) / half;
                let [value, slope, _] = self.scene.weight.spline(at * scale);
                factors[axis] = [value, slope * scale];
            }
            axis += 1;
        }
        let [[a, ax], [b, by]] = factors;
        let mut weight = Jet::constant(a * b);
        if D >= 1 {
            (weight.x, weight.y) = (ax * b, a * by);
        }
        weight
    }

    /// Adds W and W v to the sums, pair by pair.
    #[inline(always)]
    fn add_products<R: Real<Scalar = T>>(
        &self,
        round: Round,
        pair: usize,
        scratch: &mut Scratch<T>,
    ) {
        let Scratch { grains, sums, .. } = scratch;
        let size = size::<R, D>();
        let cells = &grains.cells[pair..grains.cells.len().min(pair + R::LANES)];
        let products = &grains.products[..(1 + round.components) * size];
        let (weight, others) = products.split_at(size);
        for (lane, &cell) in cells.iter().enumerate() {
            if round.has_weights() {
                add_lane(&mut sums[cell as usize..], weight, lane, R::LANES);
            }
            let first = cell as usize + (1 + round.component) * size;
            if !others.is_empty() {
                add_lane(&mut sums[first..], others, lane, R::LANES);
            }
        }
    }
}

/// Adds a lane of some vectors to the first lane of others.
#[inline(always)]
fn add_lane<T: Scalar>(sums: &mut [T], vectors: &[T], lane: usize, lanes: usize) {
    let vectors = vectors[lane..].iter().step_by(lanes);
    for (sum, &number) in sums.iter_mut().step_by(lanes).zip(vectors) {
        *sum = *sum + number;
    }
}
