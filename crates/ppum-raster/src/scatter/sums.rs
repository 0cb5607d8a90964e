//! The sums of a span of rows over its strips, in registers.
//!
//! ```text
//! S = Σ W     U = Σ W v     u = U / S     ∇u = (∇U − u ∇S) / S
//! ```

use std::ops::Range;

use ppum::function::GROUP;
use ppum::jet::Jet;
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, Factor, ROWS, evaluate, known, polynomials, splat, table_len};
use super::strips::{Term, weight_len};
use super::tile::{Batch, load_jet};

/// Rows that are summed together: they share what is read of an entry. Parts of tiles are made of so many, or some more.
pub(super) const TOGETHER: usize = 2;

/// A strip at a column of vectors.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) strip: usize,
    pub(super) rows: Range<usize>,
    pub(super) table: usize,
    pub(super) len: usize,
    pub(super) terms: Range<usize>,
    pub(super) degree: usize,
    /// Its a(x), with derivative, and ξ(x).
    pub(super) across: usize,
    /// True if it covers the whole vector.
    pub(super) is_full: bool,
}

impl Entry {
    /// Where a component's tables begin.
    #[inline(always)]
    fn start<const D: usize>(&self, component: usize) -> usize {
        self.table + weight_len::<D>() + component * self.len
    }
}

/// Where the sums of some rows come from and go to.
pub(super) struct Span<'a, T> {
    pub(super) rows: Range<usize>,
    pub(super) entries: &'a [Entry],
    pub(super) here: &'a [usize],
    pub(super) terms: &'a [Term],
    pub(super) tables: &'a [T],
    pub(super) across: &'a [T],
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
        let degree = |at: &usize| self.entries[*at].degree;
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
        let entry = &self.entries[self.here[0]];
        let (_, xi) = self.across(entry, zero);
        let tables = self.smooth::<D, P, C>(entry, from);
        let mut k = 0;
        while k < TOGETHER {
            let v = self.local_field::<R, D, P, C>(entry, from, tables, k, xi);
            self.store::<R, D, C>(from, k, v);
            k += 1;
        }
    }

    /// Adds all entries; returns the sums of the weights.
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
            self.add::<R, D, P, C>(&self.entries[at], from, &mut weights, &mut sums);
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

    /// Adds an entry.
    #[inline(always)]
    fn add<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        entry: &Entry,
        from: From,
        weights: &mut [Jet<R>; TOGETHER],
        sums: &mut [[Jet<R>; C]; TOGETHER],
    ) {
        let (a, xi) = self.across(entry, weights[0].v);
        let table = &self.tables[entry.table + from.row..];
        let table = &table[..weight_len::<D>() - ROWS + TOGETHER];
        let mut k = 0;
        while k < TOGETHER {
            weights[k] = plus_weight::<R, D>(weights[k], a, &table[k..]);
            k += 1;
        }
        if from.components == 0 {
            return;
        }
        let tables = self.smooth::<D, P, C>(entry, from);
        k = 0;
        while k < TOGETHER {
            let v = self.local_field::<R, D, P, C>(entry, from, tables, k, xi);
            let mut c = 0;
            while c < C {
                sums[k][c] = plus_product::<R, D>(sums[k][c], a, v[c]);
                c += 1;
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

    /// The tables of an entry's smooth block.
    #[inline(always)]
    fn smooth<const D: usize, const P: usize, const C: usize>(
        &self,
        entry: &Entry,
        from: From,
    ) -> [&'a [T]; C] {
        let degree = known(P, entry.degree);
        self.tables_of::<D, C>(entry, entry.start::<D>(from.component) + from.row, degree, TOGETHER)
    }

    /// The tables of an entry's block of a degree from a place on, of the components from there on, at some rows.
    #[inline(always)]
    fn tables_of<const D: usize, const C: usize>(
        &self,
        entry: &Entry,
        start: usize,
        degree: usize,
        rows: usize,
    ) -> [&'a [T]; C] {
        let all: &'a [T] = self.tables;
        let first = &all[start..];
        let mut tables = [first; C];
        let mut c = 0;
        while c < C {
            tables[c] = &first[c * entry.len..][..table_len::<D>(degree) - ROWS + rows];
            c += 1;
        }
        tables
    }

    /// a(x) and ξ(x) of an entry.
    #[inline(always)]
    fn across<R: Real<Scalar = T>>(&self, entry: &Entry, zero: R) -> (Factor<R>, R) {
        let across = &self.across[entry.across..][..3 * R::LANES];
        let a = Factor { value: zero.load(across), slope: zero.load(&across[R::LANES..]) };
        (a, zero.load(&across[2 * R::LANES..]))
    }

    /// What the tables of an entry hold at the `k`-th row, where those of its smooth block begin with the first.
    #[inline(always)]
    fn local_field<R: Real<Scalar = T>, const D: usize, const P: usize, const C: usize>(
        &self,
        entry: &Entry,
        from: From,
        tables: [&[T]; C],
        k: usize,
        xi: R,
    ) -> [Jet<R>; C] {
        let degree = known(P, entry.degree);
        let mut v = evaluate::<R, D, P, C>(tables, k, degree, xi);
        let row = from.row + k;
        let mut start = entry.start::<D>(from.component) + table_len::<D>(degree) + row;
        for term in &self.terms[entry.terms.start + 1..entry.terms.end] {
            let f = self.function::<R, D>(term, row, xi);
            match term.degree {
                0 => {
                    let tables = self.tables_of::<D, C>(entry, start, 0, 1);
                    add_constants::<R, D, C>(&mut v, &evaluate::<R, D, 0, C>(tables, 0, 0, xi), f);
                }
                degree => {
                    let tables = self.tables_of::<D, C>(entry, start, degree, 1);
                    let p = evaluate::<R, D, ANY, C>(tables, 0, degree, xi);
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
        v[c].x = f.v.mul_add(p[c].x, v[c].x);
        c += 1;
    }
}

/// v + f p with derivatives, where p does not depend on x.
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
            v[c].x = f.x.mul_add(p[c].v, v[c].x);
            v[c].y = f.y.mul_add(p[c].v, f.v.mul_add(p[c].y, v[c].y));
        }
        c += 1;
    }
}

/// The sum and a(x) v with derivatives, where v holds b(y) and its derivatives.
#[inline(always)]
fn plus_product<R: Real, const D: usize>(sum: Jet<R>, a: Factor<R>, v: Jet<R>) -> Jet<R> {
    let mut out = sum;
    out.v = a.value.mul_add(v.v, sum.v);
    if D >= 1 {
        out.x = a.slope.mul_add(v.v, a.value.mul_add(v.x, sum.x));
        out.y = a.value.mul_add(v.y, sum.y);
    }
    out
}

/// The sum and a(x) b(y) with derivatives; the table begins with b at the row.
#[inline(always)]
fn plus_weight<R: Real, const D: usize>(sum: Jet<R>, a: Factor<R>, table: &[R::Scalar]) -> Jet<R> {
    let mut b = Jet::constant(splat(a.value, table[0]));
    if D >= 1 {
        b.y = splat(a.value, table[ROWS]);
    }
    plus_product::<R, D>(sum, a, b)
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
    polynomials::<D>() * R::LANES
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
