//! The sums of a span of rows over its strips, in registers.
//!
//! ```text
//! S = Σ W     U = Σ W v     u = U / S     ∇u = (∇U − u ∇S) / S
//! ```

use std::ops::Range;

use ppum::function::GROUP;
use ppum::jet::Jet;
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, Factor, ROWS, evaluate, known, numbers, splat, table_len};
use super::strips::{DOWN, Strip, Term, weight_len};
use super::tile::{Batch, load_jet};

/// Rows that are summed together: they share what is read of an entry. Parts of tiles are made of so many, or some more.
pub(super) const TOGETHER: usize = 2;

/// Where the sums of some rows come from and go to.
pub(super) struct Span<'a, T> {
    pub(super) rows: Range<usize>,
    pub(super) strips: &'a [Strip],
    pub(super) here: &'a [usize],
    pub(super) terms: &'a [Term],
    pub(super) tables: &'a [T],
    pub(super) down: &'a [T],
    pub(super) basis: &'a [T],
    pub(super) sums: &'a mut [T],
    pub(super) batch: Batch,
}

/// The first of some rows, and the first of some components.
#[derive(Clone, Copy)]
struct From {
    row: usize,
    component: usize,
    components: usize,
}

impl From {
    /// The sums at the `k`-th row: the weight, then the components.
    #[inline(always)]
    fn cell<R: Real, const D: usize>(self, k: usize) -> Range<usize> {
        let stride = size::<R, D>() * (1 + self.components);
        (self.row + k) * stride..(self.row + k + 1) * stride
    }
}

impl<'a, T: Scalar> Span<'a, T> {
    /// The degree of all smooth blocks, [`ANY`] if they differ.
    pub(super) fn common_degree(&self) -> usize {
        let degree =
            |at: &usize| self.terms.get(self.strips[*at].terms.start).map_or(0, |term| term.degree);
        let Some(first) = self.here.first().map(degree) else { return ANY };
        if self.here.iter().all(|at| degree(at) == first) { first } else { ANY }
    }

    /// Sums over the entries, whose smooth blocks have the degree `P`, `C` components at a time.
    #[inline(always)]
    pub(super) fn sum<
        R: Real<Scalar = T>,
        const D: usize,
        const P: usize,
        const C: usize,
        const ALONE: bool,
    >(
        mut self,
        components: usize,
        zero: R,
    ) {
        let components = if C == 2 { 2 } else { components };
        let mut row = self.rows.start;
        while row < self.rows.end {
            let (mut component, mut weights) = (0, [Jet::constant(zero); TOGETHER]);
            while component < components.max(1) {
                let from = From { row, component, components };
                if ALONE {
                    self.one::<R, D, P, C>(from, zero);
                } else {
                    weights = self.many::<R, D, P, C>(from, zero);
                }
                component += C;
            }
            let mut k = 0;
            while k < TOGETHER && !ALONE && (C == 1 || !self.batch.is_last) {
                let stride = size::<R, D>() * (1 + components);
                store_jet::<R, D>(weights[k], &mut self.sums[(row + k) * stride..]);
                k += 1;
            }
            row += TOGETHER;
        }
    }

    /// A strip that is alone.
    #[inline(always)]
    fn one<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &mut self,
        from: From,
        zero: R,
    ) {
        let at = self.here[0];
        let mut k = 0;
        while k < TOGETHER {
            let (_, eta) = self.down(at, from.row + k, zero);
            let v = self.local_field::<R, D, P, C>(at, from, k, eta);
            self.store::<R, D, C>(from, k, v);
            k += 1;
        }
    }

    /// Adds all strips; returns the sums of the weights.
    #[inline(always)]
    fn many<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &mut self,
        from: From,
        zero: R,
    ) -> [Jet<R>; TOGETHER] {
        let mut sums = [[Jet::constant(zero); C]; TOGETHER];
        let mut weights = [Jet::constant(zero); TOGETHER];
        let mut k = 0;
        while k < TOGETHER && !self.batch.is_first {
            (weights[k], sums[k]) = self.load::<R, D, C>(from, k, zero);
            k += 1;
        }
        for &at in self.here {
            self.add::<R, D, P, C>(at, from, &mut weights, &mut sums);
        }
        k = 0;
        while k < TOGETHER {
            let mut c = 0;
            while c < C && self.batch.is_last {
                sums[k][c] = sums[k][c].over::<D>(weights[k]);
                c += 1;
            }
            self.store::<R, D, C>(from, k, sums[k]);
            k += 1;
        }
        weights
    }

    /// Adds a strip.
    #[inline(always)]
    fn add<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        at: usize,
        from: From,
        weights: &mut [Jet<R>; TOGETHER],
        sums: &mut [[Jet<R>; C]; TOGETHER],
    ) {
        let zero = weights[0].v;
        let table = &self.tables[self.strips[at].table..][..weight_len::<R, D>()];
        let mut k = 0;
        while k < TOGETHER {
            let (b, eta) = self.down(at, from.row + k, zero);
            let mut a = Jet::constant(zero.load(table));
            if D >= 1 {
                a.x = zero.load(&table[R::LANES..]);
            }
            weights[k].v = b.value.mul_add(a.v, weights[k].v);
            if D >= 1 {
                weights[k].x = b.value.mul_add(a.x, weights[k].x);
                weights[k].y = b.slope.mul_add(a.v, weights[k].y);
            }
            if from.components > 0 {
                let v = self.local_field::<R, D, P, C>(at, from, k, eta);
                let mut c = 0;
                while c < C {
                    sums[k][c] = plus_product::<R, D>(sums[k][c], b, v[c]);
                    c += 1;
                }
            }
            k += 1;
        }
    }

    /// The weight and the components at the `k`-th row.
    #[inline(always)]
    fn load<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &self,
        from: From,
        k: usize,
        zero: R,
    ) -> (Jet<R>, [Jet<R>; C]) {
        let cell = &self.sums[from.cell::<R, D>(k)];
        let mut sums = [Jet::constant(zero); C];
        let mut c = 0;
        while c < C && from.component + c < from.components {
            sums[c] = load_jet::<R, D>(&cell[(1 + from.component + c) * size::<R, D>()..], zero);
            c += 1;
        }
        (load_jet::<R, D>(cell, zero), sums)
    }

    /// Stores the components at the `k`-th row.
    #[inline(always)]
    fn store<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &mut self,
        from: From,
        k: usize,
        sums: [Jet<R>; C],
    ) {
        let cell = &mut self.sums[from.cell::<R, D>(k)];
        let mut c = 0;
        while c < C && from.component + c < from.components {
            store_jet::<R, D>(sums[c], &mut cell[(1 + from.component + c) * size::<R, D>()..]);
            c += 1;
        }
    }

    /// The tables of a strip's block of a degree from a place on, of the components from there on.
    #[inline(always)]
    fn tables_of<R: Real<Scalar = T>, const D: usize, const C: usize>(
        &self,
        strip: &Strip,
        start: usize,
        degree: usize,
    ) -> [&'a [T]; C] {
        let all: &'a [T] = self.tables;
        let first = &all[start..];
        let mut tables = [first; C];
        let mut c = 0;
        while c < C {
            tables[c] = &first[c * strip.len..][..table_len::<R, D>(degree)];
            c += 1;
        }
        tables
    }

    /// b(y) and η(y) of a strip at a row.
    #[inline(always)]
    fn down<R: Real<Scalar = T>>(&self, at: usize, row: usize, zero: R) -> (Factor<R>, R) {
        let down = &self.down[DOWN * at..][..DOWN];
        let b = Factor { value: splat(zero, down[row]), slope: splat(zero, down[ROWS + row]) };
        (b, splat(zero, down[2 * ROWS + row]))
    }

    /// What the tables of a strip hold at the `k`-th row.
    #[inline(always)]
    fn local_field<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        at: usize,
        from: From,
        k: usize,
        eta: R,
    ) -> [Jet<R>; C] {
        let strip = &self.strips[at];
        let scale = eta.lit(strip.scale);
        let terms = &self.terms[strip.terms.clone()];
        let degree = known(P, terms.first().map_or(0, |term| term.degree));
        let mut start = strip.table + weight_len::<R, D>() + from.component * strip.len;
        let tables = self.tables_of::<R, D, C>(strip, start, degree);
        let mut v = evaluate::<R, D, P, C>(tables, degree, eta, scale);
        start += table_len::<R, D>(degree);
        for term in &terms[1..] {
            let f = self.function::<R, D>(term, from.row + k, eta);
            let tables = self.tables_of::<R, D, C>(strip, start, term.degree);
            match term.degree {
                0 => add_constants::<R, D, C>(
                    &mut v,
                    &evaluate::<R, D, 0, C>(tables, 0, eta, scale),
                    f,
                ),
                degree => {
                    let p = evaluate::<R, D, ANY, C>(tables, degree, eta, scale);
                    add_products::<R, D, C>(&mut v, &p, f);
                }
            }
            start += term.len;
        }
        v
    }

    /// A function with derivatives.
    #[inline(always)]
    fn function<R: Real<Scalar = T>, const D: usize>(
        &self,
        term: &Term,
        row: usize,
        like: R,
    ) -> Jet<R> {
        match term.function {
            None => Jet::constant(like.lit(1.0)),
            Some(offset) => {
                let start = offset + row * basis_stride::<R, D>();
                load_jet::<R, D>(&self.basis[start..][..size::<R, D>()], like)
            }
        }
    }
}

/// v + f p with derivatives.
#[inline(always)]
fn add_products<R: Real, const D: usize, const C: usize>(
    v: &mut [Jet<R>; C],
    p: &[Jet<R>; C],
    f: Jet<R>,
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
    v: &mut [Jet<R>; C],
    p: &[Jet<R>; C],
    f: Jet<R>,
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
fn plus_product<R: Real, const D: usize>(sum: Jet<R>, b: Factor<R>, v: Jet<R>) -> Jet<R> {
    let mut out = sum;
    out.v = b.value.mul_add(v.v, sum.v);
    if D >= 1 {
        out.x = b.value.mul_add(v.x, sum.x);
        out.y = b.slope.mul_add(v.v, b.value.mul_add(v.y, sum.y));
    }
    out
}

#[inline(always)]
pub(super) fn store_jet<R: Real, const D: usize>(jet: Jet<R>, to: &mut [R::Scalar]) {
    let to = &mut to[..size::<R, D>()];
    jet.v.store(to);
    if D >= 1 {
        jet.x.store(&mut to[R::LANES..]);
        jet.y.store(&mut to[2 * R::LANES..]);
    }
}

/// Numbers a function has at a vector of points.
#[inline(always)]
pub(super) const fn size<R: Real, const D: usize>() -> usize {
    numbers::<D>() * R::LANES
}

/// Numbers a group has at a vector of points.
#[inline(always)]
pub(super) const fn basis_stride<R: Real, const D: usize>() -> usize {
    GROUP * size::<R, D>()
}

/// Numbers a group has in the basis.
#[inline(always)]
pub(super) const fn basis_len<R: Real, const D: usize>() -> usize {
    ROWS * basis_stride::<R, D>()
}
