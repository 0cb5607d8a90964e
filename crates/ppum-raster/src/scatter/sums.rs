//! The sums of a span of rows over its spans, in registers.
//!
//! ```text
//! S = Σ W     U = Σ W v     u = U / S     ∇u = (∇U − u ∇S) / S
//! ```

use std::ops::Range;

use ppum::real::{LaneNumber, Real};

use super::collapse::{
    ANY, ROWS, Slopes, WeightFactor, constant_or, evaluate, fill_lanes, table_len,
};
use super::layout::{basis_stride, load_slopes, size, store_slopes, weight_len};
use super::spans::{BlockTerm, ColumnSpan, DOWN};
use super::tile::PatchBatch;

/// Where the sums of some rows come from and go to.
pub(super) struct RowSums<'a, T> {
    pub(super) rows: Range<usize>,
    pub(super) spans: &'a [ColumnSpan],
    pub(super) here: &'a [usize],
    pub(super) terms: &'a [BlockTerm],
    pub(super) tables: &'a [T],
    pub(super) down: &'a [T],
    pub(super) basis: &'a [T],
    pub(super) sums: &'a mut [T],
    pub(super) batch: PatchBatch,
}

/// A row, and the first of some components.
#[derive(Clone, Copy)]
struct From {
    row: usize,
    component: usize,
    components: usize,
}

impl From {
    /// The sums: the weight, then the components.
    #[inline(always)]
    fn cell<R: Real, const D: usize>(self) -> Range<usize> {
        let stride = size::<R, D>() * (1 + self.components);
        self.row * stride..(self.row + 1) * stride
    }
}

/// Some components of a span.
struct SpanComponents<'a, T, const C: usize> {
    span: &'a ColumnSpan,
    /// The degree of the smooth block, and its tables.
    degree: usize,
    smooth: [&'a [T]; C],
    /// The other blocks, and where their tables begin.
    others: &'a [BlockTerm],
    start: usize,
}

impl<'a, T: LaneNumber> RowSums<'a, T> {
    /// The degree of all smooth blocks, [`ANY`] if they differ.
    #[inline]
    pub(super) fn common_degree(&self) -> usize {
        let degree =
            |at: &usize| self.terms.get(self.spans[*at].terms.start).map_or(0, |term| term.degree);
        let Some(first) = self.here.first().map(degree) else { return ANY };
        if self.here.iter().all(|at| degree(at) == first) { first } else { ANY }
    }

    /// Sums over the spans, whose smooth blocks have the degree `P`, `C` components at a time;
    /// nothing is to be summed where one of them is `ALONE`.
    #[inline(always)]
    pub(super) fn sum<
        R: Real<Scalar = T>,
        const D: usize,
        const P: usize,
        const C: usize,
        const ALONE: bool,
    >(
        self,
        components: usize,
        zero: R,
    ) {
        let components = if C == 2 { 2 } else { components };
        if ALONE {
            self.take_span::<R, D, P, C>(components, zero);
        } else {
            self.add_spans::<R, D, P, C>(components, zero);
        }
    }

    /// The rows of a span that is alone.
    #[inline(always)]
    fn take_span<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        mut self,
        components: usize,
        zero: R,
    ) {
        let at = self.here[0];
        let mut component = 0;
        while component < components {
            let local = self.local::<R, D, P, C>(at, component);
            let mut row = self.rows.start;
            while row < self.rows.end {
                let (_, eta) = self.down(at, row, zero);
                let v = self.local_field::<R, D, P, C>(&local, row, eta);
                self.store::<R, D, C>(From { row, component, components }, v);
                row += 1;
            }
            component += C;
        }
    }

    /// Sums over the spans row by row.
    #[inline(always)]
    fn add_spans<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        mut self,
        components: usize,
        zero: R,
    ) {
        let mut row = self.rows.start;
        while row < self.rows.end {
            let (mut component, mut weight) = (0, Slopes::constant(zero));
            while component < components.max(1) {
                weight = self.many::<R, D, P, C>(From { row, component, components }, zero);
                component += C;
            }
            if C == 1 || !self.batch.is_last {
                let stride = size::<R, D>() * (1 + components);
                store_slopes::<R, D>(weight, &mut self.sums[row * stride..]);
            }
            row += 1;
        }
    }

    /// Adds all spans; returns the sum of the weights.
    #[inline(always)]
    fn many<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &mut self,
        from: From,
        zero: R,
    ) -> Slopes<R> {
        let mut sums = [Slopes::constant(zero); C];
        let mut weight = Slopes::constant(zero);
        if !self.batch.is_first {
            (weight, sums) = self.load::<R, D, C>(from, zero);
        }
        for &at in self.here {
            self.add::<R, D, P, C>(at, from, &mut weight, &mut sums);
        }
        let mut c = 0;
        while c < C && self.batch.is_last {
            sums[c] = sums[c].over::<D>(weight);
            c += 1;
        }
        self.store::<R, D, C>(from, sums);
        weight
    }

    /// Adds a span.
    #[inline(always)]
    fn add<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        at: usize,
        from: From,
        weight: &mut Slopes<R>,
        sums: &mut [Slopes<R>; C],
    ) {
        let zero = weight.v;
        let (b, eta) = self.down(at, from.row, zero);
        let table = &self.tables[self.spans[at].table..][..weight_len::<R, D>()];
        let a = zero.load(table);
        weight.v = b.value.mul_add(a, weight.v);
        if D >= 1 {
            weight.x = b.value.mul_add(zero.load(&table[R::LANES..]), weight.x);
            weight.y = b.slope.mul_add(a, weight.y);
        }
        if from.components > 0 {
            let local = self.local::<R, D, P, C>(at, from.component);
            let v = self.local_field::<R, D, P, C>(&local, from.row, eta);
            let mut c = 0;
            while c < C {
                sums[c] = plus_product::<R, D>(sums[c], b, v[c]);
                c += 1;
            }
        }
    }

    /// The weight and the components.
    #[inline(always)]
    fn load<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &self,
        from: From,
        zero: R,
    ) -> (Slopes<R>, [Slopes<R>; C]) {
        let cell = &self.sums[from.cell::<R, D>()];
        let mut sums = [Slopes::constant(zero); C];
        let mut c = 0;
        while c < C && from.component + c < from.components {
            sums[c] = load_slopes::<R, D>(&cell[(1 + from.component + c) * size::<R, D>()..], zero);
            c += 1;
        }
        (load_slopes::<R, D>(cell, zero), sums)
    }

    /// Stores the components.
    #[inline(always)]
    fn store<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &mut self,
        from: From,
        sums: [Slopes<R>; C],
    ) {
        let cell = &mut self.sums[from.cell::<R, D>()];
        let mut c = 0;
        while c < C && from.component + c < from.components {
            store_slopes::<R, D>(sums[c], &mut cell[(1 + from.component + c) * size::<R, D>()..]);
            c += 1;
        }
    }

    /// The components of a span from one on.
    #[inline(always)]
    fn local<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        at: usize,
        component: usize,
    ) -> SpanComponents<'a, T, C> {
        let all: &'a [ColumnSpan] = self.spans;
        let span = &all[at];
        let terms: &'a [BlockTerm] = &self.terms[span.terms.clone()];
        let degree = constant_or(P, terms[0].degree);
        let start = span.table + weight_len::<R, D>() + component * span.len;
        let smooth = self.tables_of::<R, D, C>(span, start, degree);
        let start = start + table_len::<R, D>(degree);
        SpanComponents { span, degree, smooth, others: &terms[1..], start }
    }

    /// The tables of a span's block of a degree from a place on, of the components from there on.
    #[inline(always)]
    fn tables_of<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &self,
        span: &ColumnSpan,
        start: usize,
        degree: usize,
    ) -> [&'a [T]; C] {
        let all: &'a [T] = self.tables;
        let first = &all[start..];
        let mut tables = [first; C];
        let mut c = 0;
        while c < C {
            tables[c] = &first[c * span.len..][..table_len::<R, D>(degree)];
            c += 1;
        }
        tables
    }

    /// b(y) and η(y) of a span at a row.
    #[inline(always)]
    fn down<R: Real<Scalar = T>>(&self, at: usize, row: usize, zero: R) -> (WeightFactor<R>, R) {
        let down = &self.down[DOWN * at..][..DOWN];
        let b = WeightFactor {
            value: fill_lanes(zero, down[row]),
            slope: fill_lanes(zero, down[ROWS + row]),
        };
        (b, fill_lanes(zero, down[2 * ROWS + row]))
    }

    /// Evaluates the tables of a span at a row.
    #[inline(always)]
    fn local_field<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        local: &SpanComponents<'_, T, C>,
        row: usize,
        eta: R,
    ) -> [Slopes<R>; C] {
        let scale = eta.broadcast(local.span.frame.scale);
        let degree = constant_or(P, local.degree);
        let mut v = evaluate::<R, D, P, C>(local.smooth, degree, eta, scale);
        let mut start = local.start;
        for term in local.others {
            let f = self.function::<R, D>(term, row, eta);
            let tables = self.tables_of::<R, D, C>(local.span, start, term.degree);
            if term.degree == 0 {
                let p = evaluate::<R, D, 0, C>(tables, 0, eta, scale);
                add_constants::<R, D, C>(&mut v, &p, f);
            } else {
                let p = evaluate::<R, D, ANY, C>(tables, term.degree, eta, scale);
                add_products::<R, D, C>(&mut v, &p, f);
            }
            start += term.len;
        }
        v
    }

    /// A function with derivatives.
    #[inline(always)]
    fn function<R: Real<Scalar = T>, const D: usize>(
        &self,
        term: &BlockTerm,
        row: usize,
        like: R,
    ) -> Slopes<R> {
        match term.function {
            None => Slopes::constant(like.broadcast(1.0)),
            Some(offset) => {
                let start = offset + row * basis_stride::<R, D>();
                load_slopes::<R, D>(&self.basis[start..][..size::<R, D>()], like)
            }
        }
    }
}

/// v + f p with derivatives.
#[inline(always)]
fn add_products<R: Real, const D: usize, const C: usize>(
    v: &mut [Slopes<R>; C],
    p: &[Slopes<R>; C],
    f: Slopes<R>,
) {
    add_constants::<R, D, C>(v, p, f);
    let mut c = 0;
    while D >= 1 && c < C {
        v[c].y = f.v.mul_add(p[c].y, v[c].y);
        c += 1;
    }
}

/// v + f p with derivatives, where p does not depend on y.
#[inline(always)]
fn add_constants<R: Real, const D: usize, const C: usize>(
    v: &mut [Slopes<R>; C],
    p: &[Slopes<R>; C],
    f: Slopes<R>,
) {
    let mut c = 0;
    while c < C {
        v[c].v = f.v.mul_add(p[c].v, v[c].v);
        if D >= 1 {
            v[c].x = f.x.mul_add(p[c].v, f.v.mul_add(p[c].x, v[c].x));
            v[c].y = f.y.mul_add(p[c].v, v[c].y);
        }
        c += 1;
    }
}

/// The sum and b(y) v with derivatives, where v holds a(x) and its derivative.
#[inline(always)]
fn plus_product<R: Real, const D: usize>(
    sum: Slopes<R>,
    b: WeightFactor<R>,
    v: Slopes<R>,
) -> Slopes<R> {
    let mut out = sum;
    out.v = b.value.mul_add(v.v, sum.v);
    if D >= 1 {
        out.x = b.value.mul_add(v.x, sum.x);
        out.y = b.slope.mul_add(v.v, b.value.mul_add(v.y, sum.y));
    }
    out
}
