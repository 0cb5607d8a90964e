//! Meshes with fields that are known: polynomials, and what becomes of them under polynomial maps.

use std::collections::BTreeMap;

use crate::extended::DoubleDouble;
use crate::random::Random;
use ppum::dataset::{Dataset, Equation, FieldData, Step};
use ppum::function::FunctionKind;
use ppum::mesh::{Mesh, Shape};
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::{Rect, Vec2, vec2};

/// A polynomial in two variables: the coefficients of x^a y^b.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BivariatePolynomial(pub BTreeMap<(i32, i32), f64>);

impl BivariatePolynomial {
    /// The polynomial of coefficients in the order of a space.
    #[must_use]
    pub fn new(space: PolynomialSpace, degree: usize, coefficients: &[f64]) -> Self {
        Self(space.exponents(degree).zip(coefficients.iter().copied()).collect())
    }

    /// x or y times a factor, plus a constant.
    #[must_use]
    pub fn linear(constant: f64, x: f64, y: f64) -> Self {
        Self([((0, 0), constant), ((1, 0), x), ((0, 1), y)].into())
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.0.iter().for_each(|(k, c)| *sum.0.entry(*k).or_default() += c);
        sum
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::default();
        for ((a, b), c) in &self.0 {
            for ((d, e), f) in &other.0 {
                *product.0.entry((a + d, b + e)).or_default() += c * f;
            }
        }
        product
    }

    /// The polynomial of two others: p(x(ξ, η), y(ξ, η)).
    #[must_use]
    pub fn of(&self, x: &Self, y: &Self) -> Self {
        let power =
            |p: &Self, n: i32| (0..n).fold(Self::linear(1.0, 0.0, 0.0), |all, _| all.times(p));
        let mut sum = Self::default();
        for ((a, b), c) in &self.0 {
            let term = power(x, *a).times(&power(y, *b)).times(&Self::linear(*c, 0.0, 0.0));
            sum = sum.plus(&term);
        }
        sum
    }

    /// The derivative of an order in both directions.
    #[must_use]
    pub fn derivative(&self, [m, n]: [i32; 2]) -> Self {
        let falling = |a: i32, m: i32| (0..m).map(|k| f64::from(a - k)).product::<f64>();
        let term = |((a, b), c): (&(i32, i32), &f64)| {
            (*a >= m && *b >= n).then(|| ((a - m, b - n), c * falling(*a, m) * falling(*b, n)))
        };
        Self(self.0.iter().filter_map(term).collect())
    }

    /// The value, with 31 digits.
    #[must_use]
    pub fn at(&self, [x, y]: [DoubleDouble; 2]) -> DoubleDouble {
        let power =
            |z: DoubleDouble, n: i32| (0..n).fold(DoubleDouble::from(1.0), |all, _| all * z);
        let terms =
            self.0.iter().map(|((a, b), c)| DoubleDouble::from(*c) * power(x, *a) * power(y, *b));
        terms.fold(DoubleDouble::from(0.0), |sum, term| sum + term)
    }

    /// Σ |c x^a y^b|: what rounding is relative to.
    #[must_use]
    pub fn magnitude(&self, [x, y]: [f64; 2]) -> f64 {
        self.0.iter().map(|((a, b), c)| (c * x.powi(*a) * y.powi(*b)).abs()).sum()
    }

    /// The coefficients in the order of a space that holds the polynomial.
    #[must_use]
    pub fn coefficients(&self, space: PolynomialSpace, degree: usize) -> Vec<f64> {
        let own = |k: (i32, i32)| self.0.get(&k).copied().unwrap_or_default();
        space.exponents(degree).map(own).collect()
    }
}

/// A square or a triangle of the plane: (s, t) = origin + scale ξ, component by component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineElement {
    /// The reference shape.
    pub shape: Shape,
    /// The point of ξ = 0.
    pub origin: Vec2,
    /// Negative of a triangle that is turned.
    pub scale: Vec2,
}

impl AffineElement {
    /// A cell as a whole, or cut into two triangles.
    fn of_cell(cell: &Rect, is_cut: bool) -> Vec<Self> {
        let (middle, half) = (cell.center(), cell.size() * 0.5);
        if !is_cut {
            return vec![Self { shape: Shape::Square, origin: middle, scale: half }];
        }
        // corners (−½, −½), (1, −½), (−½, 1) at three corners of the cell
        let turned = |turn: f64| Self {
            shape: Shape::Triangle,
            origin: middle - half * (turn / 3.0),
            scale: half * (turn * 4.0 / 3.0),
        };
        vec![turned(1.0), turned(-1.0)]
    }

    /// ξ of a point (s, t), with 31 digits.
    #[must_use]
    pub fn xi(&self, [s, t]: [DoubleDouble; 2]) -> [DoubleDouble; 2] {
        [(s - self.origin.x) / self.scale.x, (t - self.origin.y) / self.scale.y]
    }

    /// The monomials of polynomials of ξ: a tensor product on a square.
    #[must_use]
    pub fn space(&self) -> PolynomialSpace {
        match self.shape {
            Shape::Square => PolynomialSpace::Tensor,
            Shape::Triangle => PolynomialSpace::Total,
        }
    }
}

/// A mesh in the making, with a field of polynomials.
#[derive(Clone, Debug, Default)]
pub struct MeshBuilder {
    /// The elements.
    pub mesh: Mesh,
    /// Each patch's map with its constant, for x and for y.
    pub maps: Vec<[BivariatePolynomial; 2]>,
}

impl MeshBuilder {
    /// Adds an element with a map.
    pub fn push(
        &mut self,
        shape: Shape,
        space: PolynomialSpace,
        degree: u8,
        map: [BivariatePolynomial; 2],
    ) {
        let mesh = &mut self.mesh;
        mesh.element.push(mesh.shape.len() as u32);
        mesh.shape.push(shape);
        mesh.origin
            .push(map.each_ref().map(|p| p.0.get(&(0, 0)).copied().unwrap_or_default()).into());
        mesh.map_degree.push(degree);
        mesh.map_space.push(space);
        mesh.map_offset.push(mesh.map[0].len() as u64);
        for (out, p) in mesh.map.iter_mut().zip(&map) {
            out.extend(&p.coefficients(space, degree.into())[1..]);
        }
        self.maps.push(map);
    }

    /// A grid of squares over the unit square, every other one cut into two triangles, under a
    /// polynomial map of the plane.
    #[must_use]
    pub fn grid(cells: [i32; 2], degree: u8, plane: &[BivariatePolynomial; 2]) -> Self {
        Self::tiles(cells, degree, plane, |i, j| (i + j) % 2 != 0)
    }

    /// Makes them with some squares cut into two triangles.
    #[must_use]
    pub fn tiles(
        [nx, ny]: [i32; 2],
        degree: u8,
        plane: &[BivariatePolynomial; 2],
        is_cut: impl Fn(i32, i32) -> bool,
    ) -> Self {
        let mut all = Self::default();
        let (hx, hy) = (0.5 / f64::from(nx), 0.5 / f64::from(ny));
        for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
            let (x, y) = (f64::from(2 * i + 1) * hx, f64::from(2 * j + 1) * hy);
            let half = vec2(hx, hy);
            for part in AffineElement::of_cell(&Rect::around(vec2(x, y), half), is_cut(i, j)) {
                all.push_part(&part, degree, plane);
            }
        }
        all
    }

    /// The leaves of a random quadtree over the unit square, with hanging nodes: each a square or
    /// two triangles, under a polynomial map of the plane; and what they are of the unit square.
    #[must_use]
    pub fn quadtree(
        random: &mut Random,
        levels: u32,
        degree: u8,
        plane: &[BivariatePolynomial; 2],
    ) -> (Self, Vec<AffineElement>) {
        let (mut all, mut parts) = (Self::default(), Vec::new());
        let mut work = vec![(Rect::new(Vec2::ZERO, vec2(1.0, 1.0)), 0)];
        while let Some((cell, level)) = work.pop() {
            if level < 2 || (level < levels && random.unit() < 0.5) {
                let (center, quarter) = (cell.center(), cell.size() * 0.25);
                let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
                let child = |[i, j]: [f64; 2]| center + vec2(i * quarter.x, j * quarter.y);
                work.extend(corners.map(|at| (Rect::around(child(at), quarter), level + 1)));
                continue;
            }
            parts.extend(AffineElement::of_cell(&cell, random.unit() < 0.5));
        }
        parts.iter().for_each(|part| all.push_part(part, degree, plane));
        (all, parts)
    }

    fn push_part(&mut self, part: &AffineElement, degree: u8, plane: &[BivariatePolynomial; 2]) {
        let s = BivariatePolynomial::linear(part.origin.x, part.scale.x, 0.0);
        let t = BivariatePolynomial::linear(part.origin.y, 0.0, part.scale.y);
        self.push(part.shape, part.space(), degree, plane.each_ref().map(|p| p.of(&s, &t)));
    }

    /// The box of all elements.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let all = (0..self.mesh.len()).map(|k| self.mesh.bounds(k));
        all.reduce(|a, b| a.union(&b)).unwrap_or(Rect::new(Vec2::ZERO, vec2(1.0, 1.0)))
    }

    /// The point of a patch at ξ, as the nearest one and what is missing.
    #[must_use]
    pub fn point(&self, patch: usize, xi: [f64; 2]) -> [Vec2; 2] {
        let exact = self.maps[patch].each_ref().map(|p| p.at(xi.map(DoubleDouble::from)));
        let near = exact.map(DoubleDouble::to_f64);
        let rest = [0, 1].map(|k| (exact[k] - DoubleDouble::from(near[k])).to_f64());
        [near.into(), rest.into()]
    }

    /// A dataset of this mesh with a field of one component, a polynomial on each patch; more
    /// fields after it.
    #[must_use]
    pub fn dataset(&self, fields: Vec<FieldData>) -> Dataset {
        let mut step = Step::new(self.mesh.clone()).with_function("one", FunctionKind::One);
        step.fields = fields;
        Dataset::new(self.bounds(), Equation::None).with_step(step)
    }
}

/// A field that is a polynomial on each patch.
#[must_use]
pub fn field(name: &str, parts: &[(PolynomialSpace, u8, BivariatePolynomial)]) -> FieldData {
    let mut data = FieldData::new(name, &["v"]);
    for (space, degree, polynomial) in parts {
        data.block_function.push(0);
        data.block_degree.push(*degree);
        data.block_space.push(*space);
        data.block_offset.push(data.coefficients[0].len() as u64);
        data.coefficients[0].extend(polynomial.coefficients(*space, (*degree).into()));
        data.patch_blocks.push(data.block_function.len() as u32);
    }
    if data.block_space.iter().all(|space| *space == PolynomialSpace::Total) {
        data.block_space.clear();
    }
    data
}

/// A polynomial with coefficients between −1 and 1.
pub fn random_polynomial(
    random: &mut Random,
    space: PolynomialSpace,
    degree: usize,
) -> BivariatePolynomial {
    let coefficients: Vec<f64> =
        (0..space.size(degree)).map(|_| random.between(-1.0, 1.0)).collect();
    BivariatePolynomial::new(space, degree, &coefficients)
}

/// A point of a shape.
pub fn random_place(random: &mut Random, shape: Shape) -> [f64; 2] {
    loop {
        let xi = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        if shape.margin(xi, [0.0; 2]) >= 0.0 {
            return xi;
        }
    }
}

/// A map with a random linear part of this aspect ratio, whose determinant's smallest value is this
/// part of its largest one on the shape.
pub fn random_map(
    random: &mut Random,
    (shape, space, degree): (Shape, PolynomialSpace, usize),
    aspect: f64,
    ratio: f64,
) -> [BivariatePolynomial; 2] {
    let (u, v) = (random.direction(), random.direction());
    let (u, v) = if u.cross(v) > 0.3 { (u, v) } else { (u, u.left()) };
    let base = [
        BivariatePolynomial::linear(random.between(-1.0, 1.0), u.x, v.x * aspect),
        BivariatePolynomial::linear(random.between(-1.0, 1.0), u.y, v.y * aspect),
    ];
    let bend = [(), ()].map(|()| {
        let mut p = random_polynomial(random, space, degree);
        p.0.retain(|(a, b), _| a + b > 1);
        p
    });
    let with = |s: f64| {
        let part = |k: usize| {
            let scaled = |p: &BivariatePolynomial, s: f64| {
                p.times(&BivariatePolynomial::linear(s, 0.0, 0.0))
            };
            let (x, y) = (scaled(&bend[0], s), scaled(&bend[1], s * aspect));
            // bent in the directions of the linear part, so that thin elements stay thin
            let (a, b) = if k == 0 { (u.x, v.x) } else { (u.y, v.y) };
            base[k].plus(&scaled(&x, a)).plus(&scaled(&y, b))
        };
        [part(0), part(1)]
    };
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..50 {
        let s = 0.5 * (low + high);
        if det_ratio(shape, &with(s)) > ratio { low = s } else { high = s }
    }
    with(low)
}

/// Smallest determinant of a map over the largest one, on a fine lattice.
fn det_ratio(shape: Shape, map: &[BivariatePolynomial; 2]) -> f64 {
    let partials = map.each_ref().map(|p| [p.derivative([1, 0]), p.derivative([0, 1])]);
    let det = |xi: [f64; 2]| {
        let [[a, b], [c, d]] = partials
            .each_ref()
            .map(|row| row.each_ref().map(|p| p.at(xi.map(DoubleDouble::from)).to_f64()));
        a * d - b * c
    };
    let dets = shape.samples(20).map(det);
    let (least, most) = dets.fold((f64::INFINITY, 0.0f64), |(a, b), d| (a.min(d), b.max(d)));
    least / most
}
