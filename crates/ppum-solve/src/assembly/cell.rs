//! The contribution of one leaf cell to the system, in the stable basis.
//!
//! ```text
//! K = ∫_C ∇N·C·∇N        f = ∫_C N·b
//! ```

use super::Assembly;
use super::border::{Border, BorderPiece};
use super::cell_system::CellSystem;
use super::dual::Duals;
use super::functions::CellFunctions;
use super::gauge::FreeModes;
use crate::basis::{BasisEvaluator, Shapes};
use crate::law::LawAt;
use crate::linear::{EigenError, add_at};
use crate::quadrature::Rule;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::vec2::Vec2;

/// Data given at a point: position → values, one per component.
pub(crate) type Data<'a> = &'a (dyn Fn(Vec2) -> [f64; 2] + Sync);

/// The source, and rules for it in a cell that take the place of the cell's.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) values: Data<'a>,
    pub(crate) rules: Option<&'a [Rule]>,
}

/// Functionals whose values for all functions are integrated with the system.
#[derive(Clone, Copy)]
pub(crate) struct Functionals<'a> {
    pub(crate) free: &'a FreeModes<'a>,
    pub(crate) duals: &'a Duals<'a>,
}

/// Assembles the systems of cells; keeps what belongs to the last one.
pub(crate) struct CellAssembler<'s> {
    assembly: Assembly<'s>,
    /// The functionals that are wanted, if any are.
    functionals: Option<Functionals<'s>>,
    evaluator: BasisEvaluator<'s>,
    shapes: Shapes,
}

impl<'s> CellAssembler<'s> {
    pub(crate) fn new(assembly: Assembly<'s>, functionals: Option<Functionals<'s>>) -> Self {
        let evaluator = BasisEvaluator::new(assembly.space, assembly.basis);
        Self { assembly, functionals, evaluator, shapes: Shapes::default() }
    }

    /// The system of one cell, given its quadrature, body forces and the pieces of its border.
    ///
    /// # Errors
    /// Entries that are not finite, which data that are not finite cause.
    pub(crate) fn assemble(
        &mut self,
        cell: usize,
        rules: &[Rule],
        source: Option<Source<'_>>,
        border: &[BorderPiece<'_>],
    ) -> Result<CellSystem, EigenError> {
        let functions = CellFunctions::new(&self.assembly, cell);
        let (n, components) = (functions.len(), self.assembly.law.components);
        let matrix = Mat::zeros(n * components, n * components);
        let mut system = self.zero(functions, matrix);
        let zero = || Mat::zeros(n, n);
        let products = || Products { xx: zero(), xy: zero(), yy: zero() };
        let mut products: Vec<_> = self.assembly.law.terms.iter().map(|_| products()).collect();
        let own = source.and_then(|source| Some((source.values, source.rules?)));
        let shared = source.filter(|source| source.rules.is_none()).map(|source| source.values);
        for rule in rules {
            self.volume((cell, rule), shared, &mut products, &mut system);
        }
        if let Some((values, rules)) = own {
            for rule in rules {
                self.evaluate(rule);
                self.load(rule, values, &mut system);
            }
        }
        for (products, term) in products.iter().zip(&self.assembly.law.terms) {
            products.add_to(&mut system.matrix, term, components);
        }
        if !border.is_empty() {
            let mut on_border = Border::new(self.assembly, n * components);
            for piece in border {
                on_border.add(piece, &mut self.evaluator, &mut self.shapes, &mut system);
            }
            let size = self.assembly.space.partition().cell[cell].size();
            on_border.finish(size.x.max(size.y), &mut system)?;
        }
        Ok(system)
    }

    /// The part of one cell in the factors of tips, in a system without matrix.
    pub(crate) fn duals(&mut self, cell: usize, rules: &[Rule]) -> CellSystem {
        let mut system = self.zero(CellFunctions::new(&self.assembly, cell), Mat::new());
        if let Some(Functionals { duals, .. }) = self.functionals {
            for rule in rules {
                self.evaluate(rule);
                let numbers = system.functions.numbers(&rule.patches);
                duals.add((cell, rule), &self.shapes, &numbers, &mut system.duals);
            }
        }
        system
    }

    /// A system of a cell of which nothing but the size is known.
    fn zero(&self, functions: CellFunctions, matrix: Mat<f64>) -> CellSystem {
        let unknowns = functions.len() * self.assembly.law.components;
        let zeros = |count: usize| vec![vec![0.0; unknowns]; count];
        CellSystem {
            matrix,
            load: vec![0.0; unknowns],
            moments: zeros(self.functionals.map_or(0, |all| all.free.len())),
            duals: zeros(self.functionals.map_or(0, |all| all.duals.len())),
            penalty: 0.0,
            reactions: Vec::new(),
            functions,
        }
    }

    /// The functions at the points of a rule.
    fn evaluate(&mut self, rule: &Rule) {
        self.evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, &mut self.shapes);
    }

    /// Adds the source at the points of the rule that was evaluated last.
    fn load(&self, rule: &Rule, source: Data<'_>, system: &mut CellSystem) {
        let numbers = system.functions.numbers(&rule.patches);
        for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
            let x = rule.anchor + offset;
            let values = source(x);
            let values = &values[..self.assembly.law.components];
            self.shapes.add_load(q, &numbers, values, weight, &mut system.load);
        }
    }

    fn volume(
        &mut self,
        (cell, rule): (usize, &Rule),
        source: Option<Data<'_>>,
        products: &mut [Products],
        system: &mut CellSystem,
    ) {
        self.evaluate(rule);
        if let Some(source) = source {
            self.load(rule, source, system);
        }
        let shapes = &mut self.shapes;
        let numbers = system.functions.numbers(&rule.patches);
        if let Some(Functionals { free, duals }) = self.functionals {
            free.add(rule, shapes, &numbers, self.assembly.law.components, &mut system.moments);
            duals.add((cell, rule), shapes, &numbers, &mut system.duals);
        }
        if self.assembly.law.is_uniform() {
            shapes.scale(&rule.weights);
            products[0].add(&numbers, shapes, shapes);
            return;
        }
        let points = rule.offsets.iter().map(|&offset| rule.anchor + offset);
        let coefficients: Vec<_> = points.map(|x| self.assembly.law.coefficients(x)).collect();
        for (m, products) in products.iter_mut().enumerate() {
            let mut right = shapes.clone();
            let weights: Vec<_> =
                rule.weights.iter().zip(&coefficients).map(|(w, a)| w * a[m]).collect();
            right.scale(&weights.iter().map(|w| w.abs()).collect::<Vec<_>>());
            // λ is negative where ν is: the sign goes to one side of the product.
            let mut left = right.clone();
            left.multiply(&weights.iter().map(|w| w.signum()).collect::<Vec<_>>());
            products.add(&numbers, &left, &right);
        }
    }
}

/// The products ∫ ∂_k N ∂_l Nᵀ over the cell's functions; yx is the transpose of xy.
struct Products {
    xx: Mat<f64>,
    xy: Mat<f64>,
    yy: Mat<f64>,
}

impl Products {
    /// Adds the points of shapes that carry the roots of the weights, the left ones with their signs.
    fn add(&mut self, numbers: &[usize], left: &Shapes, right: &Shapes) {
        let all = 0..left.functions;
        let (dx, dy) = (left.rows(&left.dx, all.clone()), left.rows(&left.dy, all.clone()));
        let (ex, ey) = (right.rows(&right.dx, all.clone()), right.rows(&right.dy, all));
        for (sum, left, right) in
            [(&mut self.xx, dx, ex), (&mut self.xy, dx, ey), (&mut self.yy, dy, ey)]
        {
            let mut product = Mat::zeros(numbers.len(), numbers.len());
            matmul(product.as_mut(), Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
            add_at(sum, numbers, numbers, &product);
        }
    }

    /// K = Σ_kl C_ikjl ∫ ∂_k N ∂_l Nᵀ.
    fn add_to(&self, matrix: &mut Mat<f64>, law: &LawAt, c: usize) {
        let yx = self.xy.transpose().to_owned();
        for b in 0..self.xx.ncols() {
            let [xx, xy, yx, yy] =
                [&self.xx, &self.xy, &yx, &self.yy].map(|product| product.col_as_slice(b));
            for j in 0..c {
                let column = matrix.col_as_slice_mut(b * c + j).chunks_exact_mut(c);
                for (a, entries) in column.enumerate() {
                    let parts = [[xx[a], xy[a]], [yx[a], yy[a]]];
                    for (i, entry) in entries.iter_mut().enumerate() {
                        *entry += law.contract(i, j, &parts);
                    }
                }
            }
        }
    }
}
