//! Adding one patch to the sums of a tile.

use ppum::function::Slot;
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, Factor, ROWS, Rows, collapse, evaluate, polynomials, splat, table_len};
use super::plan::{Affine, Patch};
use super::tile::{Part, Scratch, Tile, basis_len, basis_stride, load_jet};

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
    /// First number of its function in the basis; none for function 1.
    function: Option<usize>,
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
                factor.slope.store(&mut table[ROWS + lane..]);
            }
            let eta = place(y, patch.frame[1]);
            let rows = Rows { eta, factor, scale: patch.frame.map(|frame| frame.scale) };
            for (component, &shift) in shift.iter().enumerate() {
                let mut at = weight_len::<D>() + component * *len + lane;
                let mut shift = shift;
                for (block, term) in blocks.iter().zip(&*terms) {
                    let coefficients = self.scene.plan.block_coefficients(block, component);
                    let table = &mut table[at..];
                    collapse::<R, D>(coefficients, term.degree, shift, &rows, table);
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
        let Scratch { collapsed, places, shift, .. } = scratch;
        collapsed.terms.clear();
        collapsed.len = 0;
        for block in &self.scene.plan.blocks[patch.blocks()] {
            let degree = block.degree.into();
            let len = table_len::<D>(degree);
            let function = match block.function {
                Slot::One => None,
                Slot::Jet { group, entry } => {
                    let place = places[group as usize] as usize;
                    Some(place * basis_len::<R, D>() + entry as usize * size::<R, D>())
                }
            };
            collapsed.terms.push(Term { degree, len, function });
            collapsed.len += len;
        }
        let needed = weight_len::<D>() + collapsed.len * shift.len();
        if collapsed.table.len() < needed {
            collapsed.table.resize(needed, T::default());
        }
    }

    /// One factor of the weight with its derivative in the world.
    #[inline(always)]
    fn factor<R: Real<Scalar = T>>(&self, offset: R, support: Affine) -> Factor<R> {
        let xi = place(offset, support);
        if *self.scene.quantity == Quantity::Overlap {
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
        let mut vector = part.vectors.start;
        if C == 2 {
            // Two vectors share what is loaded of the table.
            while vector + 2 <= part.vectors.end {
                let vectors = self.vectors::<R, 2>(patch, vector, zero);
                self.spread_rows::<R, P, C, 2, SMOOTH>(vectors, part, scratch);
                vector += 2;
            }
        }
        while vector < part.vectors.end {
            let vectors = self.vectors::<R, 1>(patch, vector, zero);
            self.spread_rows::<R, P, C, 1, SMOOTH>(vectors, part, scratch);
            vector += 1;
        }
    }

    /// A patch in x on `V` vectors of columns.
    #[inline(always)]
    fn vectors<R: Real<Scalar = T>, const V: usize>(
        &self,
        patch: &Patch,
        first: usize,
        zero: R,
    ) -> Vectors<R, V> {
        let mut a = [Factor { value: zero, slope: zero }; V];
        let mut xi = [zero; V];
        let mut k = 0;
        while k < V {
            let column = self.corner()[0] + (first + k) * R::LANES;
            let x = zero.load(&self.scene.xs[column..]);
            a[k] = self.factor(x, patch.support[0]);
            xi[k] = place(x, patch.frame[0]);
            k += 1;
        }
        Vectors { first, a, xi }
    }

    #[inline(always)]
    fn spread_rows<
        R: Real<Scalar = T>,
        const P: usize,
        const C: usize,
        const V: usize,
        const SMOOTH: bool,
    >(
        &self,
        vectors: Vectors<R, V>,
        part: &Part,
        scratch: &mut Scratch<T>,
    ) {
        let components = if C == 2 { 2 } else { self.scene.plan.coefficients.len() };
        let stride = size::<R, D>() * (1 + components);
        let Scratch { sums, basis, collapsed, .. } = scratch;
        let mut row = part.rows.start;
        while row < part.rows.end {
            let point = vectors.first * ROWS + row;
            let cells = &mut sums[point * stride..((point + (V - 1) * ROWS) + 1) * stride];
            let basis = basis.get(point * basis_stride::<R, D>()..).unwrap_or_default();
            add_patch::<R, D, P, C, V, SMOOTH>(cells, collapsed, row, basis, &vectors);
            row += 1;
        }
    }
}

/// A patch in x: its factor and coordinate on `V` vectors of columns.
struct Vectors<R, const V: usize> {
    first: usize,
    a: [Factor<R>; V],
    xi: [R; V],
}

/// Adds a patch at the points of a row; `cells` begins with the first, and so does `basis`.
#[inline(always)]
fn add_patch<
    R: Real,
    const D: usize,
    const P: usize,
    const C: usize,
    const V: usize,
    const SMOOTH: bool,
>(
    cells: &mut [R::Scalar],
    collapsed: &Collapsed<R::Scalar>,
    row: usize,
    basis: &[R::Scalar],
    vectors: &Vectors<R, V>,
) {
    let size = size::<R, D>();
    // From the cell of one vector to that of the next.
    let step = if V == 1 { 0 } else { (cells.len() - (1 + C) * size) / (V - 1) };
    let zero = vectors.xi[0].lit(0.0);
    let b = splat(zero, collapsed.table[row]);
    let db = if D >= 1 { splat(zero, collapsed.table[ROWS + row]) } else { b };
    let len = if SMOOTH && P != ANY { table_len::<D>(P) } else { collapsed.len };
    let terms = collapsed.terms.as_slice();
    let mut at = weight_len::<D>() + row;
    let mut start = size;
    let end = if C == 2 { 3 * size } else { cells.len() };
    while start < end {
        let table = &collapsed.table[at..];
        let mut v = [[[zero; 3]; C]; V];
        let mut k = 0;
        while k < V {
            let basis = basis.get(k * ROWS * basis_stride::<R, D>()..).unwrap_or_default();
            v[k] = local_field::<R, D, P, C, SMOOTH>(table, len, terms, basis, vectors.xi[k]);
            k += 1;
        }
        k = 0;
        while k < V {
            let mut c = 0;
            while c < C {
                add::<R, D>(&mut cells[k * step + start + c * size..], vectors.a[k], v[k][c]);
                c += 1;
            }
            k += 1;
        }
        at += C * len;
        start += C * size;
    }
    let mut k = 0;
    while k < V {
        add_weight::<R, D>(&mut cells[k * step..], vectors.a[k], b, db);
        k += 1;
    }
}

/// The local field times b(y) of `G` components, with derivatives; their tables are `len` apart.
#[inline(always)]
fn local_field<R: Real, const D: usize, const P: usize, const G: usize, const SMOOTH: bool>(
    table: &[R::Scalar],
    len: usize,
    terms: &[Term],
    basis: &[R::Scalar],
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
    let mut at = table_len::<D>(degree);
    for term in &terms[1..] {
        let f = function::<R, D>(basis, term.function, xi);
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

/// A function with derivatives.
#[inline(always)]
fn function<R: Real, const D: usize>(
    basis: &[R::Scalar],
    offset: Option<usize>,
    like: R,
) -> Jet<R> {
    match offset {
        None => Jet::constant(like.lit(1.0)),
        Some(offset) => load_jet::<R, D>(&basis[offset..offset + size::<R, D>()], like),
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

/// Adds a(x) b(y) with derivatives; `db` is the slope of b.
#[inline(always)]
fn add_weight<R: Real, const D: usize>(sum: &mut [R::Scalar], a: Factor<R>, b: R, db: R) {
    let n = R::LANES;
    let sum = &mut sum[..size::<R, D>()];
    a.value.mul_add(b, b.load(sum)).store(sum);
    if D >= 1 {
        a.slope.mul_add(b, b.load(&sum[n..])).store(&mut sum[n..]);
        a.value.mul_add(db, b.load(&sum[2 * n..])).store(&mut sum[2 * n..]);
    }
}

/// Numbers a function has at a vector of points.
#[inline(always)]
pub(super) const fn size<R: Real, const D: usize>() -> usize {
    polynomials::<D>() * R::LANES
}

/// Length of the weight's part of a table.
#[inline(always)]
const fn weight_len<const D: usize>() -> usize {
    if D >= 1 { 2 * ROWS } else { ROWS }
}

/// ξ of an offset.
#[inline(always)]
fn place<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.lit(affine.scale), offset.lit(affine.shift))
}
