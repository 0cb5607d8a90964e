//! The contribution of one leaf cell to the system: stiffness, load and the Gram matrices of the
//! patches.
//!
//! ```text
//! K = ∫_C ∇N·C·∇N        f = ∫_C N·b        M_i = ∫_C ∇(φ_i ψ)·∇(φ_i ψ′) + h_i⁻² φ_i² ψ ψ′
//! ```

use crate::border::{Border, BorderPiece};
use crate::eigen::EigenError;
use crate::law::Law;
use crate::quadrature::Rule;
use crate::rigid::{MOTIONS, PerMotion, RigidMotions};
use crate::shape::{ShapeEvaluator, Shapes};
use crate::space::Space;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use ppum::vec2::Vec2;

/// Data given at a point: position → values, one a component.
pub(crate) type Data<'a> = &'a (dyn Fn(Vec2) -> [f64; 2] + Sync);

/// The contribution of one cell. Unknown (function a, component i) is row a · components + i.
#[derive(Clone, Debug)]
pub(crate) struct CellSystem {
    /// The functions that live in the cell.
    pub(crate) functions: CellFunctions,
    /// Stiffness, square, all of it.
    pub(crate) matrix: Mat<f64>,
    /// Right-hand side.
    pub(crate) load: Vec<f64>,
    /// Per patch, the scalar Gram matrix M_i.
    pub(crate) gram: Vec<Mat<f64>>,
    /// Work of body forces and tractions on the rigid motions.
    pub(crate) resultant: PerMotion,
    /// ∫ of the loads' magnitude on the border and in the cell.
    pub(crate) magnitude: f64,
    /// ∫ m_k·m_l of the rigid motions over the border where values are given, held components only.
    pub(crate) held: [PerMotion; MOTIONS],
    pub(crate) motions: RigidMotions,
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
    pub(crate) fn new(space: &Space<'_>, cell: usize) -> Self {
        let patches = space.coverers[cell].clone();
        let mut first = vec![0];
        for &patch in &patches {
            first.push(first[first.len() - 1] + space.sizes[patch as usize]);
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

    fn position(&self, patch: u32) -> usize {
        self.patches.binary_search(&patch).expect("a rule's patches meet its cell")
    }
}

/// Works on the cells of a space.
pub(crate) struct CellAssembler<'s> {
    space: &'s Space<'s>,
    law: &'s Law,
    motions: RigidMotions,
    evaluator: ShapeEvaluator<'s>,
    shapes: Shapes,
}

impl<'s> CellAssembler<'s> {
    pub(crate) fn new(space: &'s Space<'s>, law: &'s Law, motions: RigidMotions) -> Self {
        let (evaluator, shapes) = (ShapeEvaluator::new(space), Shapes::default());
        Self { space, law, motions, evaluator, shapes }
    }

    /// The system of one cell, given its quadrature, body forces and the pieces of its border.
    ///
    /// # Errors
    /// Entries that are not finite, which data that are not finite cause.
    pub(crate) fn assemble(
        &mut self,
        cell: usize,
        rules: &[Rule],
        source: Option<Data<'_>>,
        border: &[BorderPiece<'_>],
    ) -> Result<CellSystem, EigenError> {
        let functions = CellFunctions::new(self.space, cell);
        let (n, components) = (functions.len(), self.law.components);
        let sizes = functions.patches.iter().map(|&p| self.space.sizes[p as usize]);
        let mut system = CellSystem {
            gram: sizes.map(square).collect(),
            matrix: square(n * components),
            load: vec![0.0; n * components],
            resultant: [0.0; MOTIONS],
            magnitude: 0.0,
            held: [[0.0; MOTIONS]; MOTIONS],
            motions: self.motions,
            functions,
        };
        let mut products = Products { xx: square(n), xy: square(n), yy: square(n) };
        for rule in rules {
            self.volume(rule, source, &mut products, &mut system);
        }
        products.add_to(&mut system.matrix, self.law);
        system.add_gradients_to_gram(&products);
        let mut on_border = Border::new(self.law, n * components);
        for piece in border {
            on_border.add(piece, &mut self.evaluator, &mut self.shapes, &mut system);
        }
        if border.iter().any(|piece| piece.held.contains(&true)) {
            on_border.finish(&mut system)?;
        }
        Ok(system)
    }

    fn volume(
        &mut self,
        rule: &Rule,
        source: Option<Data<'_>>,
        products: &mut Products,
        system: &mut CellSystem,
    ) {
        let shapes = &mut self.shapes;
        self.evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, shapes);
        let numbers = system.functions.numbers(&rule.patches);
        if let Some(source) = source {
            for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
                let x = rule.anchor + offset;
                let values = source(x);
                system.add_load(&numbers, shapes, q, x, &values[..self.law.components], weight);
            }
        }
        shapes.scale(&rule.weights);
        products.add(&numbers, shapes);
        system.add_mass(&rule.patches, shapes, self.space);
    }
}

impl CellSystem {
    /// The stiffness between the unknowns of patches `k` and `l`, in the order of the system.
    pub(crate) fn block(&self, k: usize, l: usize, components: usize) -> Mat<f64> {
        let rows = self.functions.unknowns(k, components);
        let columns = self.functions.unknowns(l, components);
        Mat::from_fn(rows.len(), columns.len(), |a, b| self.matrix[(rows[a], columns[b])])
    }

    /// Adds weight · N · values at point `q` to the load, and its resultant.
    pub(crate) fn add_load(
        &mut self,
        numbers: &[usize],
        shapes: &Shapes,
        q: usize,
        x: Vec2,
        values: &[f64],
        weight: f64,
    ) {
        for (k, &number) in numbers.iter().enumerate() {
            let n = shapes.value[k * shapes.points + q];
            for (i, value) in values.iter().enumerate() {
                self.load[number * values.len() + i] += weight * value * n;
            }
        }
        for (sum, motion) in self.resultant.iter_mut().zip(self.motions.at(x)) {
            *sum += weight * motion.iter().zip(values).map(|(m, v)| m * v).sum::<f64>();
        }
        self.magnitude += weight * values.iter().map(|v| v.abs()).sum::<f64>();
    }

    /// Adds h⁻² φ² ψ ψ′ to the Gram matrices; the shapes carry the roots of the weights.
    fn add_mass(&mut self, patches: &[u32], shapes: &Shapes, space: &Space<'_>) {
        let mut first = 0;
        for &patch in patches {
            let size = space.sizes[patch as usize];
            let h = space.partition.half[patch as usize];
            let values = shapes.rows(&shapes.value, first..first + size);
            let gram = &mut self.gram[self.functions.position(patch)];
            let factor = 1.0 / (h.x * h.y);
            matmul(gram.as_mut(), Accum::Add, values, values.transpose(), factor, Par::Seq);
            first += size;
        }
    }

    fn add_gradients_to_gram(&mut self, products: &Products) {
        for (k, gram) in self.gram.iter_mut().enumerate() {
            let (from, size) = (self.functions.first[k], gram.nrows());
            *gram += products.xx.submatrix(from, from, size, size);
            *gram += products.yy.submatrix(from, from, size, size);
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
    /// Adds the points of shapes that carry the roots of the weights.
    fn add(&mut self, numbers: &[usize], shapes: &Shapes) {
        let all = 0..shapes.functions;
        let dx = shapes.rows(&shapes.dx, all.clone());
        let dy = shapes.rows(&shapes.dy, all);
        for (sum, left, right) in
            [(&mut self.xx, dx, dx), (&mut self.xy, dx, dy), (&mut self.yy, dy, dy)]
        {
            let mut product = Mat::zeros(numbers.len(), numbers.len());
            matmul(product.as_mut(), Accum::Replace, left, right.transpose(), 1.0, Par::Seq);
            add_at(sum, numbers, &product);
        }
    }

    /// K = Σ_kl C_ikjl ∫ ∂_k N ∂_l Nᵀ.
    fn add_to(&self, matrix: &mut Mat<f64>, law: &Law) {
        let (n, c) = (self.xx.nrows(), law.components);
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
