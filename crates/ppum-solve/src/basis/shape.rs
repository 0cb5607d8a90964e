//! Shape functions φ_i ψ at quadrature points.
//!
//! Sides of cracks enter shifted, see [`Space::shifts`].

use crate::quadrature::{EdgeRule, Face};
use crate::space::Space;
use faer::MatRef;
use ppum::crack::Side;
use ppum::dataset::MAX_DEGREE;
use ppum::function::{GROUP, LocalFunctions, Slot};
use ppum::jet::Jet;
use ppum::polynomial::exponents;
use ppum::vec2::Vec2;
use std::ops::Range;

/// Values and gradients of shape functions at points. Arrays have shape \[functions, points\],
/// row-major; functions are those of the patches in order, in each patch in the order of the
/// dataset's coefficients.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// Number of functions.
    pub functions: usize,
    /// Number of points.
    pub points: usize,
    /// φ_i ψ
    pub value: Vec<f64>,
    /// ∂(φ_i ψ)/∂x
    pub dx: Vec<f64>,
    /// ∂(φ_i ψ)/∂y
    pub dy: Vec<f64>,
}

impl Shapes {
    /// Makes room for functions and points, all zero.
    pub(crate) fn resize(&mut self, functions: usize, points: usize) {
        (self.functions, self.points) = (functions, points);
        for array in [&mut self.value, &mut self.dx, &mut self.dy] {
            array.clear();
            array.resize(functions * points, 0.0);
        }
    }

    /// Multiplies the columns by the square roots of quadrature weights, so that products of rows
    /// are integrals of products.
    pub(crate) fn scale(&mut self, weights: &[f64]) {
        self.multiply(&weights.iter().map(|w| w.sqrt()).collect::<Vec<_>>());
    }

    /// Multiplies the columns by factors.
    pub(crate) fn multiply(&mut self, factors: &[f64]) {
        for array in [&mut self.value, &mut self.dx, &mut self.dy] {
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

    /// Adds weight · N · values at point `q` to a load over the functions of a cell, of which `numbers`
    /// are those of the rows; component i of function a is entry a · components + i.
    pub(crate) fn add_load(
        &self,
        q: usize,
        numbers: &[usize],
        values: &[f64],
        weight: f64,
        load: &mut [f64],
    ) {
        for (k, &number) in numbers.iter().enumerate() {
            let n = self.value[k * self.points + q];
            for (i, value) in values.iter().enumerate() {
                load[number * values.len() + i] += weight * value * n;
            }
        }
    }

    /// Adds G : ∇(N e_i) at point `q` to a load over the functions of a cell, of which `numbers` are those of the rows;
    /// component i of function a is entry 2 a + i.
    pub(crate) fn add_slopes(
        &self,
        q: usize,
        numbers: &[usize],
        kernel: &[Vec2; 2],
        load: &mut [f64],
    ) {
        for (k, &number) in numbers.iter().enumerate() {
            let at = k * self.points + q;
            for (i, g) in kernel.iter().enumerate() {
                load[number * 2 + i] += g.x * self.dx[at] + g.y * self.dy[at];
            }
        }
    }

    fn set(&mut self, function: usize, point: usize, jet: Jet<f64>) {
        let at = function * self.points + point;
        (self.value[at], self.dx[at], self.dy[at]) = (jet.v, jet.x, jet.y);
    }
}

/// Evaluates shape functions; keeps what belongs to the last anchor.
#[derive(Debug)]
pub(crate) struct ShapeEvaluator<'s> {
    space: &'s Space<'s>,
    seen: Option<(Seat, LocalFunctions<'s>)>,
}

/// The seat that functions are seen from: the anchor, and the face that points lie on.
type Seat = (Vec2, Option<Face>);

impl<'s> ShapeEvaluator<'s> {
    /// An evaluator for the functions of a space.
    #[must_use]
    pub(crate) fn new(space: &'s Space<'s>) -> Self {
        Self { space, seen: None }
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

    fn fill(&mut self, seat: Seat, offsets: &[Vec2], patches: &[u32], out: &mut Shapes) {
        let (space, (anchor, face)) = (self.space, seat);
        if self.seen.as_ref().is_none_or(|(known, _)| *known != seat) {
            self.seen = Some((seat, functions(space, seat)));
        }
        let Some((_, functions)) = &self.seen else { return };
        let side = face.map_or(Side::Above, |face| face.side);
        let n_functions = patches.iter().map(|&p| space.sizes[p as usize]).sum();
        out.resize(n_functions, offsets.len());
        let groups = groups_of(space, patches);
        let mut at = Point {
            space,
            anchor,
            offset: Vec2::ZERO,
            jets: vec![[ZERO; GROUP]; groups.len()],
            places: places_in(space, patches, &groups),
        };
        let mut weights = Vec::with_capacity(patches.len());
        for (point, &offset) in offsets.iter().enumerate() {
            at.offset = offset;
            for (&group, jets) in groups.iter().zip(&mut at.jets) {
                functions.evaluate::<f64, 1>(group, [offset.x, offset.y], side, jets);
            }
            at.partition(patches, &mut weights);
            let (mut function, mut places) = (0, at.places.as_slice());
            for (&patch, phi) in patches.iter().zip(&weights) {
                let (own, rest) = places.split_at(space.data().blocks(patch as usize).len());
                function = at.shapes((patch as usize, own), *phi, point, function, out);
                places = rest;
            }
        }
    }
}

const ZERO: Jet<f64> = Jet { v: 0.0, x: 0.0, y: 0.0, xx: 0.0, xy: 0.0, yy: 0.0 };

fn functions<'s>(space: &'s Space<'s>, (anchor, face): Seat) -> LocalFunctions<'s> {
    let cracks = &space.step().cracks;
    match face {
        Some(face) => space.functions.on(cracks, face.segment, anchor),
        None => space.functions.at(cracks, anchor),
    }
}

/// The function groups that the blocks of some patches use, ascending.
fn groups_of(space: &Space<'_>, patches: &[u32]) -> Vec<usize> {
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

/// A block's function: the place of its group among those that are evaluated, and its entry there; none for 1.
type Place = Option<[usize; 2]>;

/// The functions of all blocks of some patches, in order.
fn places_in(space: &Space<'_>, patches: &[u32], groups: &[usize]) -> Vec<Place> {
    let blocks = patches.iter().flat_map(|&p| space.data().blocks(p as usize));
    let place = |b: usize| match space.functions.of(space.data().block_function[b]) {
        Slot::One => None,
        Slot::Jet { group, entry } => {
            groups.binary_search(&(group as usize)).ok().map(|at| [at, entry as usize])
        }
    };
    blocks.map(place).collect()
}

/// One quadrature point.
struct Point<'s> {
    space: &'s Space<'s>,
    anchor: Vec2,
    offset: Vec2,
    /// The groups of functions, and where each block's is among them.
    jets: Vec<[Jet<f64>; GROUP]>,
    places: Vec<Place>,
}

impl Point<'_> {
    fn local(&self, origin: Vec2, inverse: Vec2) -> [f64; 2] {
        let d = (self.anchor - origin) + self.offset;
        [d.x * inverse.x, d.y * inverse.y]
    }

    /// The partition functions φ of the patches; exactly 1 where a patch is alone.
    fn partition(&self, patches: &[u32], out: &mut Vec<Jet<f64>>) {
        out.clear();
        if patches.len() == 1 {
            out.push(Jet { v: 1.0, ..ZERO });
            return;
        }
        let partition = self.space.partition();
        let mut sum = ZERO;
        for &patch in patches {
            let inverse = reciprocal(partition.half[patch as usize]);
            let xi = self.local(partition.center[patch as usize], inverse);
            let w = partition.weight.tensor::<f64, 1>(xi, [inverse.x, inverse.y]);
            sum = sum.plus::<1>(w);
            out.push(w);
        }
        for w in out {
            *w = w.over::<1>(sum);
        }
    }

    /// Writes the functions of one patch from index `function` on; returns the index after them.
    fn shapes(
        &self,
        (patch, places): (usize, &[Place]),
        phi: Jet<f64>,
        point: usize,
        function: usize,
        out: &mut Shapes,
    ) -> usize {
        let data = self.space.data();
        let inverse = reciprocal(self.space.partition().scale[patch]);
        let monomials =
            Monomials::new(self.local(self.space.partition().origin[patch], inverse), inverse);
        let mut next = function;
        for (block, place) in data.blocks(patch).zip(places) {
            let factor = match *place {
                None => phi,
                Some([group, entry]) => {
                    let mut function = self.jets[group][entry];
                    function.v -= self.space.shifts[block];
                    phi.times::<1>(function)
                }
            };
            for (a, b) in exponents(data.block_degree[block] as usize) {
                out.set(next, point, factor.times::<1>(monomials.jet(a as usize, b as usize)));
                next += 1;
            }
        }
        next
    }
}

fn reciprocal(v: Vec2) -> Vec2 {
    ppum::vec2::vec2(1.0 / v.x, 1.0 / v.y)
}

/// Powers of ξ and η at a point.
struct Monomials {
    x: [f64; MAX_DEGREE + 1],
    y: [f64; MAX_DEGREE + 1],
    inverse: Vec2,
}

impl Monomials {
    fn new([xi, eta]: [f64; 2], inverse: Vec2) -> Self {
        let (mut x, mut y) = ([1.0; MAX_DEGREE + 1], [1.0; MAX_DEGREE + 1]);
        for k in 1..=MAX_DEGREE {
            (x[k], y[k]) = (x[k - 1] * xi, y[k - 1] * eta);
        }
        Self { x, y, inverse }
    }

    /// ξ^a η^b with its gradient in the world.
    fn jet(&self, a: usize, b: usize) -> Jet<f64> {
        let dx = if a == 0 { 0.0 } else { a as f64 * self.x[a - 1] * self.inverse.x };
        let dy = if b == 0 { 0.0 } else { b as f64 * self.y[b - 1] * self.inverse.y };
        Jet { v: self.x[a] * self.y[b], x: dx * self.y[b], y: self.x[a] * dy, ..ZERO }
    }
}
