//! Adding one patch to the sums of a tile.

use ppum::function::Slot;
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::real::{Real, Scalar};

use super::collapse::{
    ANY, Factor, Rows, collapse, evaluate, height, polynomials, splat, table_len,
};
use super::plan::{Affine, Patch};
use super::tile::{Active, Part, Scratch, Tile, basis_len, basis_stride, load_jet};

/// A patch collapsed on the rows of a tile: the weight's factor and slope in y, then for each
/// component the tables of its blocks.
#[derive(Debug, Default)]
pub(super) struct Collapsed<T> {
    table: Vec<T>,
    terms: Vec<Term>,
    /// Length of a component's tables.
    len: usize,
}

/// A block.
#[derive(Clone, Copy, Debug)]
struct Term {
    degree: usize,
    /// Length of its table.
    len: usize,
    /// Where its function begins in the basis; none for function 1.
    function: Option<usize>,
}

/// The basis at one point.
struct Point<'a, T> {
    basis: &'a [T],
    at: usize,
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Collapses a patch on the rows of its part of the tile.
    #[inline(always)]
    pub(super) fn collapse<R: Real<Scalar = T>>(
        &self,
        patch: &Patch,
        part: &Part,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let n = height::<T>();
        self.list_terms::<R>(patch, scratch);
        let Scratch { collapsed: Collapsed { table, terms, len }, shift, .. } = scratch;
        let blocks = &self.scene.plan.blocks[patch.blocks()];
        let first_row = self.corner()[1];
        let mut lane = part.rows.start / R::LANES * R::LANES;
        while lane < part.rows.end {
            let y = zero.load(&self.scene.ys[first_row + lane..]);
            let factor = self.factor(y, patch.support[1]);
            factor.value.store(&mut table[lane..]);
            if D >= 1 {
                factor.slope.store(&mut table[n + lane..]);
            }
            let eta = place(y, patch.frame[1]);
            let rows = Rows { eta, factor, scale: patch.frame.map(|frame| frame.scale) };
            for (component, &shift) in shift.iter().enumerate() {
                let mut at = weight_len::<T, D>() + component * *len + lane;
                let mut shift = shift;
                for (block, term) in blocks.iter().zip(&*terms) {
                    let coefficients = self.scene.plan.block_coefficients(block, component);
                    let table = &mut table[at..];
                    collapse::<R, D>(coefficients, block.degree, shift, &rows, table);
                    at += term.len;
                    shift = 0.0;
                }
            }
            lane += R::LANES;
        }
    }

    /// Lists the blocks of a patch and makes room for their tables.
    #[inline(always)]
    fn list_terms<R: Real<Scalar = T>>(&self, patch: &Patch, scratch: &mut Scratch<T>) {
        let Scratch { collapsed, active, shift, .. } = scratch;
        collapsed.terms.clear();
        collapsed.len = 0;
        for block in &self.scene.plan.blocks[patch.blocks()] {
            let len = table_len::<T, D>(block.degree);
            let function = match block.function {
                Slot::One => None,
                Slot::Jet { group, entry } => {
                    Some(basis_offset::<R, D>(active, group) + entry as usize * size::<R, D>())
                }
            };
            collapsed.terms.push(Term { degree: block.degree, len, function });
            collapsed.len += len;
        }
        let needed = weight_len::<T, D>() + collapsed.len * shift.len();
        if collapsed.table.len() < needed {
            collapsed.table.resize(needed, T::default());
        }
    }

    /// One factor of the weight with its derivative in the world.
    #[inline(always)]
    fn factor<R: Real<Scalar = T>>(&self, offset: R, support: Affine) -> Factor<R> {
        let xi = place(offset, support);
        if self.scene.quantity == Quantity::Overlap {
            let (zero, one) = (xi.lit(0.0), xi.lit(1.0));
            let inside = R::select(xi.ge(-one), R::select(one.gt(xi), one, zero), zero);
            return Factor { value: inside, slope: zero };
        }
        let [value, slope, _] = self.scene.weight.spline(xi);
        Factor { value, slope: slope * xi.lit(support.scale) }
    }

    /// Adds W and W v of a collapsed patch to the sums. The common cases, two components and degrees
    /// 1 to 3, are compiled with these numbers as constants.
    #[inline(always)]
    pub(super) fn spread<R: Real<Scalar = T>>(
        &self,
        patch: &Patch,
        part: &Part,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let components = self.scene.plan.coefficients.len();
        let smooth = scratch.collapsed.terms.len() == 1;
        let degree = scratch.collapsed.terms.first().map_or(ANY, |term| term.degree);
        match (degree, components, D, smooth) {
            (1, 2, 1, true) => self.spread_as::<R, 1, 2, true>(patch, part, scratch, zero),
            (2, 2, 1, true) => self.spread_as::<R, 2, 2, true>(patch, part, scratch, zero),
            (3, 2, 1, true) => self.spread_as::<R, 3, 2, true>(patch, part, scratch, zero),
            (1, 2, 1, false) => self.spread_as::<R, 1, 2, false>(patch, part, scratch, zero),
            (2, 2, 1, false) => self.spread_as::<R, 2, 2, false>(patch, part, scratch, zero),
            (3, 2, 1, false) => self.spread_as::<R, 3, 2, false>(patch, part, scratch, zero),
            _ => self.spread_as::<R, ANY, 1, false>(patch, part, scratch, zero),
        }
    }

    /// [`spread`](Self::spread) for degree `P` of the first block, for two components if `C` is 2 and
    /// any number, taken one by one, if `C` is 1, and for no block but the first if `SMOOTH`.
    #[inline(always)]
    fn spread_as<R: Real<Scalar = T>, const P: usize, const C: usize, const SMOOTH: bool>(
        &self,
        patch: &Patch,
        part: &Part,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let n = height::<T>();
        let components = if C == 2 { 2 } else { self.scene.plan.coefficients.len() };
        let stride = size::<R, D>() * (1 + components);
        let first_column = self.corner()[0];
        let Scratch { sums, basis, collapsed, .. } = scratch;
        let mut vector = part.vectors.start;
        while vector < part.vectors.end {
            let x = zero.load(&self.scene.xs[first_column + vector * R::LANES..]);
            let a = self.factor(x, patch.support[0]);
            let xi = place(x, patch.frame[0]);
            let points = vector * n + part.rows.start..vector * n + part.rows.end;
            let cells = &mut sums[points.start * stride..points.end * stride];
            let mut row = part.rows.start;
            for cell in cells.chunks_exact_mut(stride) {
                let point = Point { basis, at: (vector * n + row) * basis_stride::<R, D>() };
                add_patch::<R, D, P, C, SMOOTH>(cell, collapsed, row, &point, a, xi);
                row += 1;
            }
            vector += 1;
        }
    }
}

/// Adds a patch at one vector of points: `a` and `xi` are its factor and coordinate in x.
#[inline(always)]
fn add_patch<R: Real, const D: usize, const P: usize, const C: usize, const SMOOTH: bool>(
    cell: &mut [R::Scalar],
    collapsed: &Collapsed<R::Scalar>,
    row: usize,
    point: &Point<'_, R::Scalar>,
    a: Factor<R>,
    xi: R,
) {
    let n = height::<R::Scalar>();
    let size = size::<R, D>();
    let table = &collapsed.table[row..];
    let b = splat(xi, table[0]);
    let db = if D >= 1 { splat(xi, table[n]) } else { b };
    add::<R, D>(cell, a, [b, xi.lit(0.0), db]);
    let table = &table[weight_len::<R::Scalar, D>()..];
    let len = if SMOOTH && P != ANY { table_len::<R::Scalar, D>(P) } else { collapsed.len };
    let terms = collapsed.terms.as_slice();
    let mut at = 0;
    for sums in cell[size..].chunks_exact_mut(C * size) {
        let table = &table[at..];
        let v = local_field::<R, D, P, C, SMOOTH>(table, len, terms, point, xi);
        let mut c = 0;
        while c < C {
            add::<R, D>(&mut sums[c * size..], a, v[c]);
            c += 1;
        }
        at += C * len;
    }
}

/// The local field times b(y) of `G` components, with derivatives; their tables are `len` apart.
#[inline(always)]
fn local_field<R: Real, const D: usize, const P: usize, const G: usize, const SMOOTH: bool>(
    table: &[R::Scalar],
    len: usize,
    terms: &[Term],
    point: &Point<'_, R::Scalar>,
    xi: R,
) -> [[R; 3]; G] {
    let degree = if P == ANY { terms[0].degree } else { P };
    let mut v = [[xi; 3]; G];
    let mut g = 0;
    while g < G {
        v[g] = evaluate::<R, D, P>(&table[g * len..], degree, xi);
        g += 1;
    }
    if SMOOTH {
        return v;
    }
    let mut at = table_len::<R::Scalar, D>(degree);
    for term in &terms[1..] {
        let f = point.function::<R, D>(term.function, xi);
        let mut g = 0;
        while g < G {
            let table = &table[g * len + at..];
            v[g] = match term.degree {
                0 => add_constant::<R, D>(v[g], evaluate::<R, D, 0>(table, 0, xi), f),
                degree => add_product::<R, D>(v[g], evaluate::<R, D, ANY>(table, degree, xi), f),
            };
            g += 1;
        }
        at += term.len;
    }
    v
}

impl<T: Scalar> Point<'_, T> {
    /// A function with derivatives.
    #[inline(always)]
    fn function<R: Real<Scalar = T>, const D: usize>(
        &self,
        offset: Option<usize>,
        like: R,
    ) -> Jet<R> {
        match offset {
            None => Jet::constant(like.lit(1.0)),
            Some(offset) => {
                let start = self.at + offset;
                let jet = &self.basis[start..start + polynomials::<D>() * R::LANES];
                load_jet::<R, D>(jet, like)
            }
        }
    }
}

/// v + f p with derivatives.
#[inline(always)]
fn add_product<R: Real, const D: usize>(v: [R; 3], p: [R; 3], f: Jet<R>) -> [R; 3] {
    let mut out = add_constant::<R, D>(v, p, f);
    if D >= 1 {
        out[1] = f.v.mul_add(p[1], out[1]);
    }
    out
}

/// v + f p with derivatives, where p does not depend on x.
#[inline(always)]
fn add_constant<R: Real, const D: usize>(v: [R; 3], p: [R; 3], f: Jet<R>) -> [R; 3] {
    let mut out = v;
    out[0] = f.v.mul_add(p[0], v[0]);
    if D >= 1 {
        out[1] = f.x.mul_add(p[0], v[1]);
        out[2] = f.y.mul_add(p[0], f.v.mul_add(p[2], v[2]));
    }
    out
}

/// Adds a(x) v(x) with derivatives: v holds the value, the derivative by x and that by y.
#[inline(always)]
fn add<R: Real, const D: usize>(sum: &mut [R::Scalar], a: Factor<R>, v: [R; 3]) {
    let n = R::LANES;
    let sum = &mut sum[..polynomials::<D>() * n];
    a.value.mul_add(v[0], a.value.load(sum)).store(sum);
    if D >= 1 {
        let x = a.value.load(&sum[n..]);
        a.slope.mul_add(v[0], a.value.mul_add(v[1], x)).store(&mut sum[n..]);
        let y = a.value.load(&sum[2 * n..]);
        a.value.mul_add(v[2], y).store(&mut sum[2 * n..]);
    }
}

/// Where a group begins in the basis.
#[inline(always)]
fn basis_offset<R: Real, const D: usize>(active: &[Active], group: u32) -> usize {
    let mut index = 0;
    while active[index].group != group {
        index += 1;
    }
    index * basis_len::<R, D>()
}

/// Numbers a function has at a vector of points.
#[inline(always)]
pub(super) const fn size<R: Real, const D: usize>() -> usize {
    polynomials::<D>() * R::LANES
}

/// Length of the weight's part of a table.
#[inline(always)]
const fn weight_len<T: Scalar, const D: usize>() -> usize {
    if D >= 1 { 2 * height::<T>() } else { height::<T>() }
}

/// ξ of an offset.
#[inline(always)]
fn place<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.lit(affine.scale), offset.lit(affine.shift))
}
