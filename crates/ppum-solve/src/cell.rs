//! The contribution of one leaf cell to the system, in the stable basis.
//!
//! ```text
//! K = ∫_C ∇N·C·∇N        f = ∫_C N·b
//! ```

use crate::basis::{BasisEvaluator, StableBasis};
use crate::block_matrix::BlockMatrix;
use crate::border::{Border, BorderPiece};
use crate::eigen::EigenError;
use crate::law::{Law, LawAt};
use crate::quadrature::Rule;
use crate::reaction::CellReaction;
use crate::shape::Shapes;
use crate::space::Space;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::vec2::Vec2;

/// Data given at a point: position → values, one a component.
pub(crate) type Data<'a> = &'a (dyn Fn(Vec2) -> [f64; 2] + Sync);

/// The source, and rules for it in a cell that take the place of the cell's.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) values: Data<'a>,
    pub(crate) rules: Option<&'a [Rule]>,
}

/// The contribution of one cell. Unknown (function a, component i) is row a · components + i.
#[derive(Clone, Debug)]
pub(crate) struct CellSystem {
    /// The functions that live in the cell.
    pub(crate) functions: CellFunctions,
    /// Stiffness, square, all of it.
    pub(crate) matrix: Mat<f64>,
    /// Right-hand side.
    pub(crate) load: Vec<f64>,
    /// Nitsche's β over λ + 2μ or the conductivity [1/L]; zero where no values are given.
    pub(crate) penalty: f64,
    /// What the supports in the cell exert, one a condition that gives values.
    pub(crate) reactions: Vec<CellReaction>,
}

/// The functions of a cell's patches, numbered patch after patch.
#[derive(Clone, Debug)]
pub(crate) struct CellFunctions {
    /// The patches that meet the cell, ascending.
    pub(crate) patches: Vec<u32>,
    /// First function of each patch, and the number of all at the end.
    pub(crate) first: Vec<usize>,
}

impl CellFunctions {
    pub(crate) fn new(space: &Space<'_>, basis: &StableBasis, cell: usize) -> Self {
        let patches = space.coverers[cell].clone();
        let mut first = vec![0];
        for &patch in &patches {
            first.push(first[first.len() - 1] + basis.sizes[patch as usize]);
        }
        Self { patches, first }
    }

    /// Number of functions.
    pub(crate) fn len(&self) -> usize {
        self.first[self.patches.len()]
    }

    /// For functions of some of the patches, in order, their numbers in the cell.
    pub(crate) fn numbers(&self, patches: &[u32]) -> Vec<usize> {
        let range = |patch: &u32| {
            let k = self.position(*patch);
            self.first[k]..self.first[k + 1]
        };
        patches.iter().flat_map(range).collect()
    }

    /// The cell's unknowns of patch `k` in the order of the system: component-major.
    pub(crate) fn unknowns(&self, k: usize, components: usize) -> Vec<usize> {
        let functions = self.first[k]..self.first[k + 1];
        (0..components).flat_map(|i| functions.clone().map(move |a| a * components + i)).collect()
    }

    /// Adds numbers of the cell's unknowns, component i of function a at a · components + i, to those
    /// of all unknowns.
    pub(crate) fn add_to(
        &self,
        matrix: &BlockMatrix,
        components: usize,
        part: &[f64],
        sum: &mut [f64],
    ) {
        for (k, &patch) in self.patches.iter().enumerate() {
            let range = matrix.unknowns(patch as usize);
            for (sum, &from) in sum[range].iter_mut().zip(&self.unknowns(k, components)) {
                *sum += part[from];
            }
        }
    }

    /// The cell's unknowns out of all: the way back of [`CellFunctions::add_to`].
    pub(crate) fn take_from(
        &self,
        matrix: &BlockMatrix,
        components: usize,
        all: &[f64],
    ) -> Vec<f64> {
        let mut part = vec![0.0; self.len() * components];
        for (k, &patch) in self.patches.iter().enumerate() {
            let range = matrix.unknowns(patch as usize);
            for (value, &to) in all[range].iter().zip(&self.unknowns(k, components)) {
                part[to] = *value;
            }
        }
        part
    }

    fn position(&self, patch: u32) -> usize {
        self.patches.binary_search(&patch).expect("a rule's patches meet its cell")
    }
}

/// Works on the cells of a space.
pub(crate) struct CellAssembler<'s> {
    space: &'s Space<'s>,
    basis: &'s StableBasis,
    law: &'s Law<'s>,
    evaluator: BasisEvaluator<'s>,
    shapes: Shapes,
}

impl<'s> CellAssembler<'s> {
    pub(crate) fn new(space: &'s Space<'s>, basis: &'s StableBasis, law: &'s Law<'s>) -> Self {
        let (evaluator, shapes) = (BasisEvaluator::new(space, basis), Shapes::default());
        Self { space, basis, law, evaluator, shapes }
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
        let functions = CellFunctions::new(self.space, self.basis, cell);
        let (n, components) = (functions.len(), self.law.components);
        let mut system = CellSystem {
            matrix: square(n * components),
            load: vec![0.0; n * components],
            penalty: 0.0,
            reactions: Vec::new(),
            functions,
        };
        let products = || Products { xx: square(n), xy: square(n), yy: square(n) };
        let mut products: Vec<_> = self.law.terms.iter().map(|_| products()).collect();
        let own = source.and_then(|source| Some((source.values, source.rules?)));
        let shared = source.filter(|source| source.rules.is_none()).map(|source| source.values);
        for rule in rules {
            self.volume(rule, shared, &mut products, &mut system);
        }
        if let Some((values, rules)) = own {
            for rule in rules {
                self.evaluate(rule);
                self.load(rule, values, &mut system);
            }
        }
        for (products, term) in products.iter().zip(&self.law.terms) {
            products.add_to(&mut system.matrix, term, components);
        }
        if !border.is_empty() {
            let mut on_border = Border::new(self.law, n * components);
            for piece in border {
                on_border.add(piece, &mut self.evaluator, &mut self.shapes, &mut system);
            }
            let size = self.space.partition.cell[cell].size();
            on_border.finish(size.x.max(size.y), &mut system)?;
        }
        Ok(system)
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
            let values = &values[..self.law.components];
            self.shapes.add_load(q, &numbers, values, weight, &mut system.load);
        }
    }

    fn volume(
        &mut self,
        rule: &Rule,
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
        if self.law.is_uniform() {
            shapes.scale(&rule.weights);
            products[0].add(&numbers, shapes, shapes);
            return;
        }
        let points = rule.offsets.iter().map(|&offset| rule.anchor + offset);
        let coefficients: Vec<_> = points.map(|x| self.law.coefficients(x)).collect();
        for (m, products) in products.iter_mut().enumerate() {
            let mut right = shapes.clone();
            let weights = rule.weights.iter().zip(&coefficients).map(|(w, a)| w * a[m]);
            let weights: Vec<_> = weights.collect();
            right.scale(&weights.iter().map(|w| w.abs()).collect::<Vec<_>>());
            // λ is negative where ν is: the sign goes to one side of the product.
            let mut left = right.clone();
            left.multiply(&weights.iter().map(|w| w.signum()).collect::<Vec<_>>());
            products.add(&numbers, &left, &right);
        }
    }
}

impl CellSystem {
    /// The stiffness between the unknowns of patches `k` and `l`, in the order of the system.
    pub(crate) fn block(&self, k: usize, l: usize, components: usize) -> Mat<f64> {
        let rows = self.functions.unknowns(k, components);
        let columns = self.functions.unknowns(l, components);
        Mat::from_fn(rows.len(), columns.len(), |a, b| self.matrix[(rows[a], columns[b])])
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
            add_at(sum, numbers, &product);
        }
    }

    /// K = Σ_kl C_ikjl ∫ ∂_k N ∂_l Nᵀ.
    fn add_to(&self, matrix: &mut Mat<f64>, law: &LawAt, c: usize) {
        let n = self.xx.nrows();
        for b in 0..n {
            for a in 0..n {
                let parts =
                    [[self.xx[(a, b)], self.xy[(a, b)]], [self.xy[(b, a)], self.yy[(a, b)]]];
                for j in 0..c {
                    for i in 0..c {
                        matrix[(a * c + i, b * c + j)] += law.contract(i, j, &parts);
                    }
                }
            }
        }
    }
}

fn add_at(sum: &mut Mat<f64>, numbers: &[usize], block: &Mat<f64>) {
    for (b, &column) in numbers.iter().enumerate() {
        for (a, &row) in numbers.iter().enumerate() {
            sum[(row, column)] += block[(a, b)];
        }
    }
}

pub(crate) fn square(n: usize) -> Mat<f64> {
    Mat::zeros(n, n)
}
