//! A tile of pixels: sums over its patches, and the quantity of them.

use std::ops::Range;

use ppum::crack::Side;
use ppum::function::{GROUP, Slot};
use ppum::jet::Jet;
use ppum::quantity::{Quantity, Source};
use ppum::real::{Job, Real, Scalar};

use super::Scene;
use super::collapse::{Factor, collapse, evaluate, polynomials, rows, splat, table_len};
use super::plan::{Affine, COLUMNS, Patch};

/// Buffers of one thread.
#[derive(Debug, Default)]
pub(super) struct Scratch<T> {
    /// Σ W, then Σ W v of each component, each with derivatives, for the points of a tile.
    sums: Vec<T>,
    /// Functions of the active groups with derivatives, for the points of a tile.
    basis: Vec<T>,
    /// The groups in `basis`.
    active: Vec<Active>,
    /// Collapsed weight and blocks of a patch.
    table: Vec<T>,
    /// The blocks in `table`.
    terms: Vec<Term>,
    /// Subtracted from each component.
    shift: Vec<f64>,
}

/// A rectangle of a tile: vectors of columns, and rows.
#[derive(Clone, Debug)]
struct Part {
    vectors: Range<usize>,
    rows: Range<usize>,
}

/// A group of functions needed on a part of a tile.
#[derive(Debug)]
struct Active {
    group: u32,
    part: Part,
}

/// A block of the patch at hand.
#[derive(Clone, Copy, Debug)]
struct Term {
    degree: usize,
    /// Length of its table.
    len: usize,
    /// Where its function begins in the basis; none for function 1.
    function: Option<usize>,
}

/// Draws a band: the tiles of some rows, with `D` derivatives.
pub(super) struct Band<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a Scene<'f, T>,
    pub(super) band: usize,
    pub(super) scratch: &'a mut Scratch<T>,
    /// The band's rows of the raster.
    pub(super) out: &'a mut [T],
}

impl<T: Scalar, const D: usize> Job<T> for Band<'_, '_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = T>>(self, zero: R) {
        let mut jets = vec![Jet::constant(zero); self.scene.plan.coefficients.len()];
        let mut exact = vec![zero; self.scene.plan.coefficients.len()];
        let mut column = 0;
        while column < self.scene.plan.tile_columns() {
            let tile = Tile::<T, D> { scene: self.scene, column, band: self.band };
            tile.sum(self.scratch, zero);
            tile.finish(self.scratch, &mut jets, &mut exact, self.out, zero);
            column += 1;
        }
    }
}

/// One tile.
struct Tile<'a, 'f, T, const D: usize> {
    scene: &'a Scene<'f, T>,
    column: usize,
    band: usize,
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Numbers a point has in the sums, times lanes.
    #[inline(always)]
    fn stride<R: Real<Scalar = T>>(&self) -> usize {
        polynomials::<D>() * (1 + self.scene.plan.coefficients.len()) * R::LANES
    }

    /// First column and row.
    #[inline(always)]
    fn corner(&self) -> [usize; 2] {
        [self.column * COLUMNS, self.band * rows::<T>()]
    }

    /// Sums over the patches.
    #[inline(always)]
    fn sum<R: Real<Scalar = T>>(&self, scratch: &mut Scratch<T>, zero: R) {
        let points = COLUMNS / R::LANES * rows::<T>();
        scratch.sums.clear();
        scratch.sums.resize(points * self.stride::<R>(), T::default());
        let list = self.scene.plan.tile(self.column, self.band);
        self.choose_shift(list, &mut scratch.shift);
        self.activate::<R>(list, &mut scratch.active);
        self.evaluate_functions(scratch, zero);
        let mut k = 0;
        while k < list.len() {
            let patch = &self.scene.plan.patches[list[k] as usize];
            let part = self.part::<R>(patch);
            self.collapse(patch, &part, scratch, zero);
            self.spread(patch, &part, scratch, zero);
            k += 1;
        }
    }

    /// Takes the constants to subtract: midway between those of the first and the last patch, which
    /// lie in opposite corners if the patches follow the Morton curve. The partition of unity
    /// reproduces constants, and ∇U − u ∇S loses the fewer digits the smaller u is.
    #[inline(always)]
    fn choose_shift(&self, list: &[u32], shift: &mut Vec<f64>) {
        let plan = &self.scene.plan;
        shift.clear();
        shift.resize(plan.coefficients.len(), 0.0);
        let (Some(&first), Some(&last)) = (list.first(), list.last()) else { return };
        for (component, shift) in shift.iter_mut().enumerate() {
            *shift = 0.5 * (plan.constant(first, component) + plan.constant(last, component));
        }
    }

    /// The part of the tile a patch may cover.
    #[inline(always)]
    fn part<R: Real<Scalar = T>>(&self, patch: &Patch) -> Part {
        let [column, row] = self.corner();
        let within = |range: &Range<usize>, start: usize, count: usize| {
            range.start.max(start) - start..range.end.min(start + count) - start
        };
        let columns = within(&patch.columns, column, COLUMNS);
        Part {
            vectors: columns.start / R::LANES..columns.end.div_ceil(R::LANES),
            rows: within(&patch.rows, row, rows::<T>()),
        }
    }

    /// Finds the groups of functions the patches need, and where.
    #[inline(always)]
    fn activate<R: Real<Scalar = T>>(&self, list: &[u32], active: &mut Vec<Active>) {
        let plan = &self.scene.plan;
        active.clear();
        for &index in list {
            let patch = &plan.patches[index as usize];
            if patch.blocks.len() < 2 {
                continue;
            }
            for block in &plan.blocks[patch.blocks.clone()] {
                if let Slot::Jet { group, .. } = block.function {
                    need(active, group, self.part::<R>(patch));
                }
            }
        }
    }

    /// Fills the basis.
    #[inline(always)]
    fn evaluate_functions<R: Real<Scalar = T>>(&self, scratch: &mut Scratch<T>, zero: R) {
        let stride = basis_stride::<R, D>();
        let group_len = COLUMNS / R::LANES * rows::<T>() * stride;
        let len = group_len * scratch.active.len();
        if scratch.basis.len() < len {
            scratch.basis.resize(len, T::default());
        }
        let [column, row] = self.corner();
        let mut jets = [Jet::constant(zero); GROUP];
        let functions = &self.scene.functions;
        for (index, active) in scratch.active.iter().enumerate() {
            let count = functions.table().group_len(active.group as usize);
            for vector in active.part.vectors.clone() {
                let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
                for k in active.part.rows.clone() {
                    let y = splat(zero, self.scene.ys[row + k]);
                    let group = active.group as usize;
                    functions.evaluate::<R, D>(group, [x, y], Side::Above, &mut jets);
                    let start = index * group_len + (vector * rows::<T>() + k) * stride;
                    let point = &mut scratch.basis[start..start + stride];
                    store_jets::<R, D>(&jets[..count], point);
                }
            }
        }
    }

    /// Fills the table and the terms of a patch.
    #[inline(always)]
    fn collapse<R: Real<Scalar = T>>(
        &self,
        patch: &Patch,
        part: &Part,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let plan = &self.scene.plan;
        let n = rows::<T>();
        let blocks = &plan.blocks[patch.blocks.clone()];
        scratch.terms.clear();
        let mut len = 0;
        for block in blocks {
            let term = self.term::<R>(block.function, block.degree, &scratch.active);
            len += term.len;
            scratch.terms.push(term);
        }
        let components = plan.coefficients.len();
        let needed = polynomials::<D>() * n + len * components;
        if scratch.table.len() < needed {
            scratch.table.resize(needed, T::default());
        }
        let row = self.corner()[1];
        let mut lane = part.rows.start / R::LANES * R::LANES;
        while lane < part.rows.end {
            let y = zero.load(&self.scene.ys[row + lane..]);
            let factor = self.factor(y, patch.support[1]);
            factor.value.store(&mut scratch.table[lane..]);
            if D >= 1 {
                factor.slope.store(&mut scratch.table[n + lane..]);
            }
            let eta = place(y, patch.frame[1]);
            let mut at = polynomials::<D>().min(2) * n + lane;
            for component in 0..components {
                let mut shift = scratch.shift[component];
                for (block, term) in blocks.iter().zip(&scratch.terms) {
                    let coefficients = plan.block_coefficients(block, component);
                    let table = &mut scratch.table[at..];
                    collapse::<R, D>(
                        coefficients,
                        block.degree,
                        shift,
                        patch.frame,
                        eta,
                        factor,
                        table,
                    );
                    at += term.len;
                    shift = 0.0;
                }
            }
            lane += R::LANES;
        }
    }

    #[inline(always)]
    fn term<R: Real<Scalar = T>>(&self, slot: Slot, degree: usize, active: &[Active]) -> Term {
        let len = table_len::<T, D>(degree);
        let function = match slot {
            Slot::One => None,
            Slot::Jet { group, entry } => {
                let mut index = 0;
                while active[index].group != group {
                    index += 1;
                }
                let point = index * (COLUMNS / R::LANES * rows::<T>()) * basis_stride::<R, D>();
                Some(point + entry as usize * polynomials::<D>() * R::LANES)
            }
        };
        Term { degree, len, function }
    }

    /// One factor of the weight with its derivative in the world.
    #[inline(always)]
    fn factor<R: Real<Scalar = T>>(&self, offset: R, support: Affine) -> Factor<R> {
        let xi = place(offset, support);
        let (zero, one) = (xi.lit(0.0), xi.lit(1.0));
        if self.scene.quantity == Quantity::Overlap {
            let inside = R::select(xi.ge(-one), R::select(one.gt(xi), one, zero), zero);
            return Factor { value: inside, slope: zero };
        }
        let [value, slope, _] = self.scene.weight.spline(xi);
        Factor { value, slope: slope * xi.lit(support.scale) }
    }

    /// Adds W and W v of a patch to the sums.
    #[inline(always)]
    fn spread<R: Real<Scalar = T>>(
        &self,
        patch: &Patch,
        part: &Part,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let n = rows::<T>();
        let stride = self.stride::<R>();
        let column = self.corner()[0];
        let Scratch { sums, basis, table, terms, .. } = scratch;
        let mut vector = part.vectors.start;
        while vector < part.vectors.end {
            let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
            let a = self.factor(x, patch.support[0]);
            let xi = place(x, patch.frame[0]);
            let mut row = part.rows.start;
            while row < part.rows.end {
                let point = vector * n + row;
                let cell = &mut sums[point * stride..(point + 1) * stride];
                let points = Point { basis, at: point * basis_stride::<R, D>() };
                add_patch::<R, D>(cell, &table[row..], terms, &points, a, xi);
                row += 1;
            }
            vector += 1;
        }
    }

    /// Divides, makes the quantity and writes it to the raster.
    #[inline(always)]
    fn finish<R: Real<Scalar = T>>(
        &self,
        scratch: &Scratch<T>,
        jets: &mut [Jet<R>],
        exact: &mut [R],
        out: &mut [T],
        zero: R,
    ) {
        let [width, n] = [self.scene.view.pixels[0] as usize, rows::<T>()];
        let stride = self.stride::<R>();
        let [start, first_row] = self.corner();
        for (row, line) in out.chunks_exact_mut(width).enumerate() {
            let line = &mut line[start..width.min(start + COLUMNS)];
            let mut column = 0;
            while column < line.len() {
                let point = column / R::LANES * n + row;
                let cell = &scratch.sums[point * stride..(point + 1) * stride];
                if self.scene.quantity.source() == Source::Exact {
                    let pixel = [start + column, first_row + row];
                    self.scene.load_exact(pixel, &scratch.shift, exact, zero);
                }
                let value = self.value(cell, &scratch.shift, jets, exact, zero);
                let to = &mut line[column..];
                if to.len() >= R::LANES {
                    value.store(to);
                } else {
                    store_part(value, to);
                }
                column += R::LANES;
            }
        }
    }

    /// The quantity at a point.
    #[inline(always)]
    fn value<R: Real<Scalar = T>>(
        &self,
        cell: &[T],
        shift: &[f64],
        jets: &mut [Jet<R>],
        exact: &[R],
        zero: R,
    ) -> R {
        let size = polynomials::<D>() * R::LANES;
        let weight = load_jet::<R, D>(cell, zero);
        let mut component = 0;
        while component < jets.len() {
            let sum = load_jet::<R, D>(&cell[(component + 1) * size..], zero);
            jets[component] = sum.over::<D>(weight);
            component += 1;
        }
        let quantity = self.scene.quantity;
        match quantity.source() {
            Source::Partition if jets.is_empty() => weight.v,
            Source::Partition => jets[0].v + zero.lit(shift[0]),
            Source::Values => {
                for (jet, &shift) in jets.iter_mut().zip(shift) {
                    jet.v = jet.v + zero.lit(shift);
                }
                quantity.of_field(&self.scene.equation, jets, exact)
            }
            Source::Gradient | Source::Exact => {
                quantity.of_field(&self.scene.equation, jets, exact)
            }
        }
    }
}

/// The basis at one point.
struct Point<'a, T> {
    basis: &'a [T],
    at: usize,
}

/// Adds a patch at one vector of points: `a` and `xi` are its factor and coordinate in x, `table`
/// begins at the row.
#[inline(always)]
fn add_patch<R: Real, const D: usize>(
    cell: &mut [R::Scalar],
    table: &[R::Scalar],
    terms: &[Term],
    point: &Point<'_, R::Scalar>,
    a: Factor<R>,
    xi: R,
) {
    let n = rows::<R::Scalar>();
    let size = polynomials::<D>() * R::LANES;
    let b = splat(xi, table[0]);
    let mut at = n;
    if D >= 1 {
        let db = splat(xi, table[n]);
        add::<R, D>(cell, a, [b, xi.lit(0.0), db]);
        at = 2 * n;
    } else {
        add::<R, D>(cell, a, [b, b, b]);
    }
    let mut start = size;
    while start < cell.len() {
        let mut v = evaluate::<R, D>(&table[at..], terms[0].degree, xi);
        at += terms[0].len;
        let mut k = 1;
        while k < terms.len() {
            let p = evaluate::<R, D>(&table[at..], terms[k].degree, xi);
            v = add_term::<R, D>(v, p, terms[k].function, point);
            at += terms[k].len;
            k += 1;
        }
        add::<R, D>(&mut cell[start..start + size], a, v);
        start += size;
    }
}

/// v + f p with derivatives.
#[inline(always)]
fn add_term<R: Real, const D: usize>(
    v: [R; 3],
    p: [R; 3],
    function: Option<usize>,
    point: &Point<'_, R::Scalar>,
) -> [R; 3] {
    let Some(offset) = function else {
        return [v[0] + p[0], v[1] + p[1], v[2] + p[2]];
    };
    let size = polynomials::<D>() * R::LANES;
    let start = point.at + offset;
    let f = load_jet::<R, D>(&point.basis[start..start + size], p[0]);
    let mut out = v;
    out[0] = f.v.mul_add(p[0], v[0]);
    if D >= 1 {
        out[1] = f.x.mul_add(p[0], f.v.mul_add(p[1], v[1]));
        out[2] = f.y.mul_add(p[0], f.v.mul_add(p[2], v[2]));
    }
    out
}

/// Adds a(x) v(x) with derivatives: v holds the value, the derivative by x and that by y.
#[inline(always)]
fn add<R: Real, const D: usize>(sum: &mut [R::Scalar], a: Factor<R>, v: [R; 3]) {
    let n = R::LANES;
    a.value.mul_add(v[0], a.value.load(sum)).store(sum);
    if D >= 1 {
        let x = a.value.load(&sum[n..]);
        a.slope.mul_add(v[0], a.value.mul_add(v[1], x)).store(&mut sum[n..]);
        let y = a.value.load(&sum[2 * n..]);
        a.value.mul_add(v[2], y).store(&mut sum[2 * n..]);
    }
}

/// Numbers a point has in the basis of one group, times lanes.
#[inline(always)]
fn basis_stride<R: Real, const D: usize>() -> usize {
    GROUP * polynomials::<D>() * R::LANES
}

/// ξ of an offset.
#[inline(always)]
fn place<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.lit(affine.scale), offset.lit(affine.shift))
}

#[inline(always)]
fn load_jet<R: Real, const D: usize>(from: &[R::Scalar], like: R) -> Jet<R> {
    let mut jet = Jet::constant(like.load(from));
    if D >= 1 {
        jet.x = like.load(&from[R::LANES..]);
        jet.y = like.load(&from[2 * R::LANES..]);
    }
    jet
}

#[inline(always)]
fn store_jets<R: Real, const D: usize>(jets: &[Jet<R>], to: &mut [R::Scalar]) {
    let (n, size) = (R::LANES, polynomials::<D>() * R::LANES);
    let mut k = 0;
    while k < jets.len() {
        let to = &mut to[k * size..(k + 1) * size];
        jets[k].v.store(to);
        if D >= 1 {
            jets[k].x.store(&mut to[n..]);
            jets[k].y.store(&mut to[2 * n..]);
        }
        k += 1;
    }
}

/// Stores the first lanes, as many as there is room for.
#[inline(always)]
fn store_part<R: Real>(value: R, to: &mut [R::Scalar]) {
    // 16 lanes are the widest vector there is.
    let mut lanes = [R::Scalar::default(); 16];
    value.store(&mut lanes);
    to.copy_from_slice(&lanes[..to.len()]);
}

/// Notes that a group is needed on a part.
fn need(active: &mut Vec<Active>, group: u32, part: Part) {
    match active.iter_mut().find(|known| known.group == group) {
        None => active.push(Active { group, part }),
        Some(known) => {
            known.part.vectors = union(&known.part.vectors, &part.vectors);
            known.part.rows = union(&known.part.rows, &part.rows);
        }
    }
}

fn union(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}
