//! Faces of cracks that may touch: no overlap, no tension, Coulomb's law.
//!
//! On a crack with the normal m to its left and the tangent s, the jump \[u\] = u(above) − u(below)
//! and the stresses σ_m = m·σ m, σ_s = s·σ m on its faces
//!
//! ```text
//! [u]·m ≥ 0     σ_m ≤ 0     σ_m [u]·m = 0
//! |σ_s| ≤ −μ σ_m, and where they slide σ_s = −μ σ_m sign([u]·s)
//! ```
//!
//! With any β > 0 these are one equation for each direction d of m and s (Alart & Curnier 1991):
//!
//! ```text
//! σ_d = clamp(P_d)     P_d = σ_d + β [u]·d
//! onto (−∞, 0] across, onto [−μ p, μ p] along, p = −clamp(P_m)
//! ```
//!
//! Nitsche's method puts it into the weak form without new unknowns (Chouly, Hild & Renard 2015).
//! In its symmetric form, and for known μ p, u is where
//!
//! ```text
//! ½ a(u, u) − f(u) + Σ_d ∫ (H(P_d) − σ_d²)/(2β) ds     H′ = 2 clamp
//! ```
//!
//! is least. That function has a continuous slope; it is convex if ∫ σ_d² ≤ λ a(u, u) with λ < β,
//! and λ is known cell by cell, as on held boundaries (`boundary`). So there is one solution, and β
//! does not matter: with that of the body, all terms with β vanish. At points where P_d is inside
//! of its interval the term is that of Nitsche for a tie, at others that of a known traction c:
//!
//! ```text
//! tied      K += (p pᵀ − σ σᵀ)/β     f += (σ⁰ σ − σ⁰ p)/β
//! loaded    K −= σ σᵀ/β              f += (σ⁰ σ − c p)/β
//! ```
//!
//! with the functions' σ_d and P_d as columns σ and p, and σ_d where the body does not deform, σ⁰.
//! The stress is that of the side on which more of the cell lies: a sliver on the other one makes λ
//! no larger.

use super::Assembly;
use super::cell::CellAssembler;
use super::cell_matrix::CellMatrix;
use super::functions::CellFunctions;
use crate::basis::{BasisEvaluator, Shapes};
use crate::law::{OPERATORS, Strain};
use crate::quadrature::{CrackFace, EdgeRule, Quadrature};
use crate::report::SolverReport;
use crate::terms::face_law;
use crate::watched::{Halt, WorkPhase, in_batches};
use faer::{Mat, MatRef};
use ppum::crack::Side;
use ppum_linear::{BlockMatrix, EigenError, largest_eigenvalue, product, taken};

/// β in units of λ: what is left of the energy is a half beside a boundary that is held with its
/// own terms, and three quarters elsewhere.
const FACTOR: f64 = 4.0;

/// All faces that may touch.
#[derive(Default)]
pub struct FaceContacts {
    cells: Vec<ContactCell>,
}

/// The faces in one cell. Columns belong to a direction at a point, and carry the root of its
/// weight.
struct ContactCell {
    cell: usize,
    patches: Vec<u32>,
    /// The pairs of patches that overlap, by their places.
    pairs: Vec<(usize, usize)>,
    /// First unknown of each patch, and the number of all at the end.
    first: Vec<usize>,
    beta: f64,
    /// σ_d of the cell's unknowns.
    stresses: Mat<f64>,
    /// P_d of the cell's unknowns.
    projections: Mat<f64>,
    rows: Vec<FaceRow>,
}

/// A direction at a point of a face.
#[derive(Clone, Copy, Debug)]
struct FaceRow {
    weight: f64,
    /// σ_d where the body does not deform.
    initial: f64,
    /// μ of the tangent, whose row follows that of the normal.
    friction: Option<f64>,
}

/// A cell in which contact ends: faces touch in a part of it.
pub struct CellErrors {
    /// Its number.
    pub cell: usize,
    /// ∫ |σ_m − min(P_m, 0)| |P_m(z)|/β of each dual solution z.
    pub errors: Vec<f64>,
}

/// σ_d and P_d of a field at a row.
#[derive(Clone, Copy, Debug)]
pub struct FaceStress {
    stress: f64,
    projection: f64,
}

/// √w and √w/β of a row: a traction t adds t √w/β p to the forces.
#[derive(Clone, Copy, Debug)]
pub struct RowFactors {
    /// √w of the row's point.
    pub root: f64,
    /// √w/β, the factor of a traction in the forces.
    pub force: f64,
}

/// The state of the faces in the direction of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaceState {
    /// The faces are tied in this direction.
    Tied,
    /// The traction is known.
    Loaded(f64),
}

impl FaceContacts {
    /// The faces of a problem that may touch.
    ///
    /// # Errors
    /// Data that are not finite, with their place; cancelled.
    pub fn new(assembly: Assembly<'_>, stage: &WorkPhase<'_>) -> Result<Self, Halt> {
        let (mut cells, space) = (Vec::new(), assembly.space);
        let quadrature = space.quadrature(0);
        let mut cracks = 0..assembly.problem.cracks().len() as u32;
        let is_wanted = cracks.any(|crack| face_law(assembly.problem, crack).is_some());
        in_batches(
            stage,
            if is_wanted { assembly.n_cells() } else { 0 },
            || CellAssembler::new(assembly, None),
            |assembler, cell| {
                let faces = faces(assembly, &quadrature, cell);
                if faces.is_empty() {
                    return Ok(None);
                }
                let rules = space.rules(&quadrature, cell);
                let stiffness = assembler.stiffness(cell, &rules);
                let part = ContactCell::new(assembly, cell, &faces, &stiffness);
                part.map(Some).map_err(|_| Halt::at(space.partition().cell[cell]))
            },
            |_, cell| cells.extend(cell),
        )?;
        Ok(Self { cells })
    }

    /// True if no faces may touch.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The cells with their parts of numbers or states of all rows.
    fn with_rows<'a, T>(
        &'a self,
        all: &'a [T],
    ) -> impl Iterator<Item = (&'a ContactCell, &'a [T])> {
        let mut rest = all;
        self.cells.iter().map(move |cell| {
            let (own, tail) = rest.split_at(cell.rows.len());
            rest = tail;
            (cell, own)
        })
    }

    /// The rows of all cells with their β.
    fn rows(&self) -> impl Iterator<Item = (&FaceRow, f64)> {
        self.cells.iter().flat_map(|cell| cell.rows.iter().map(|row| (row, cell.beta)))
    }

    /// The rows of normals, with their β and stresses.
    fn normal<'a>(
        &'a self,
        stresses: &'a [FaceStress],
    ) -> impl Iterator<Item = ((&'a FaceRow, f64), &'a FaceStress)> {
        self.rows().zip(stresses).filter(|((row, _), _)| row.friction.is_none())
    }

    /// The stresses of a solution in the order of the matrix, row by row.
    pub fn stresses(&self, matrix: &BlockMatrix, solution: &[f64]) -> Vec<FaceStress> {
        self.cells.iter().flat_map(|cell| cell.stresses(matrix, solution)).collect()
    }

    /// True if no faces overlap by more than rounding leaves of a jump.
    pub fn is_open(&self, stresses: &[FaceStress]) -> bool {
        let openings = || self.normal(stresses).map(|((_, beta), at)| at.jump(beta));
        let largest = openings().fold(0.0, |most: f64, g| most.max(g.abs()));
        openings().all(|g| g >= -ROUNDING * largest)
    }

    /// The factors of each row.
    pub fn factors(&self) -> Vec<RowFactors> {
        let of_row = |(row, beta): (&FaceRow, f64)| {
            let root = row.weight.sqrt();
            RowFactors { root, force: root / beta }
        };
        self.rows().map(of_row).collect()
    }

    /// P_d of a field at each row.
    pub fn projections(&self, matrix: &BlockMatrix, field: &[f64]) -> Vec<f64> {
        let changes = self.changes(matrix, field);
        self.rows().zip(changes).map(|((row, _), change)| change + row.initial).collect()
    }

    /// How much P_d changes at each row where a field is added.
    pub fn changes(&self, matrix: &BlockMatrix, field: &[f64]) -> Vec<f64> {
        let of_cell = |cell: &ContactCell| cell.values(&cell.projections, matrix, field);
        self.cells.iter().flat_map(of_cell).collect()
    }

    /// Adds Σ p of the rows' columns p, each times a factor.
    pub fn add_columns(&self, factors: &[f64], matrix: &BlockMatrix, load: &mut [f64]) {
        for (cell, own) in self.with_rows(factors) {
            for (k, factor) in own.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
                let places = cell.patches.iter().flat_map(|&p| matrix.unknowns(p as usize));
                let column = cell.projections.col_as_slice(k);
                places.zip(column).for_each(|(place, p)| load[place] += factor * p);
            }
        }
    }

    /// The intervals onto which P_d is clamped at each row, by the pressures of a field.
    pub fn intervals(&self, projections: &[f64]) -> Vec<[f64; 2]> {
        let mut pressure = 0.0;
        let interval = |((row, _), at): ((&FaceRow, f64), &f64)| match row.friction {
            None => {
                pressure = (-at).max(0.0);
                [f64::NEG_INFINITY, 0.0]
            }
            Some(friction) => [-friction * pressure, friction * pressure],
        };
        self.rows().zip(projections).map(interval).collect()
    }

    /// The system of states, from that without faces that touch.
    pub fn system(
        &self,
        states: &[FaceState],
        matrix: &BlockMatrix,
        load: &[f64],
    ) -> (BlockMatrix, Vec<f64>) {
        let (mut matrix, mut load) = (matrix.clone(), load.to_vec());
        for (cell, own) in self.with_rows(states) {
            cell.add(own, &mut matrix, &mut load);
        }
        (matrix, load)
    }

    /// The cells in which contact ends, by the solution and the dual solutions of a system.
    pub fn errors(&self, matrix: &BlockMatrix, fields: &[Vec<f64>]) -> Vec<CellErrors> {
        let of_cell = |cell: &ContactCell| cell.errors(matrix, fields);
        self.cells.iter().filter_map(of_cell).collect()
    }

    /// Writes into a report what a solution with these stresses makes of the faces.
    pub fn report(&self, stresses: &[FaceStress], report: &mut SolverReport) {
        let (mut length, mut closed, mut overlap, mut tension) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for ((row, beta), at) in self.normal(stresses) {
            length += row.weight;
            overlap = overlap.max(-at.jump(beta));
            if at.projection < 0.0 {
                closed += row.weight;
                tension = tension.max(at.stress);
            }
        }
        report.closed = Some(closed / length);
        report.overlap = Some(overlap);
        report.tension = Some(tension);
    }
}

/// Part of the largest jump by which faces overlap where rounding decides.
const ROUNDING: f64 = 1e-12;

impl FaceStress {
    /// \[u\]·d
    fn jump(&self, beta: f64) -> f64 {
        (self.projection - self.stress) / beta
    }
}

impl FaceState {
    /// Returns the state for a projection P_d: tied inside of the interval, else loaded with the
    /// end of the interval that it is clamped to.
    pub fn new(projection: f64, [low, high]: [f64; 2]) -> Self {
        match projection {
            p if p < low => Self::Loaded(low),
            p if p >= high => Self::Loaded(high),
            _ => Self::Tied,
        }
    }

    /// True if the faces are tied.
    pub fn is_tied(self) -> bool {
        self == Self::Tied
    }

    /// The known part of the traction: that of a body that does not deform, or all.
    fn constant(self, initial: f64) -> f64 {
        match self {
            Self::Tied => initial,
            Self::Loaded(traction) => traction,
        }
    }
}

impl ContactCell {
    fn new(
        assembly: Assembly<'_>,
        cell: usize,
        faces: &[EdgeRule],
        stiffness: &CellMatrix,
    ) -> Result<Self, EigenError> {
        let functions = CellFunctions::new(&assembly, cell);
        let trace = FaceTrace::new(assembly, cell, &functions, faces);
        let pairs: Vec<_> = functions.pairs(&assembly).collect();
        let [stresses, jumps] = [&trace.stresses, &trace.jumps].map(|columns| {
            let n = functions.len() * assembly.components();
            tied(
                &assembly,
                &functions,
                MatRef::from_column_major_slice(columns, n, trace.rows.len()),
            )
        });
        let (first, whole) = dense(&pairs, functions.patches.len(), stiffness);
        let size = assembly.space.partition().cell[cell].size();
        let least = trace.modulus / size.x.max(size.y);
        let beta = least.max(FACTOR * largest_eigenvalue(whole.as_ref(), stresses.as_ref())?);
        let projections = &stresses + faer::Scale(beta) * jumps;
        let (patches, rows) = (functions.patches, trace.rows);
        Ok(Self { cell, patches, pairs, first, beta, stresses, projections, rows })
    }

    /// Values of columns, p·u/√w, at each row.
    fn values(&self, columns: &Mat<f64>, matrix: &BlockMatrix, field: &[f64]) -> Vec<f64> {
        let own = self.patches.iter().flat_map(|&p| &field[matrix.unknowns(p as usize)]);
        let own: Vec<f64> = own.copied().collect();
        let of_row = |(k, row): (usize, &FaceRow)| {
            let sum: f64 = columns.col_as_slice(k).iter().zip(&own).map(|(p, u)| p * u).sum();
            sum / row.weight.sqrt()
        };
        self.rows.iter().enumerate().map(of_row).collect()
    }

    fn stresses(&self, matrix: &BlockMatrix, solution: &[f64]) -> Vec<FaceStress> {
        let of = |columns| self.values(columns, matrix, solution);
        let both = of(&self.stresses).into_iter().zip(of(&self.projections));
        let less = |((stress, projection), row): (_, &FaceRow)| FaceStress {
            stress: stress + row.initial,
            projection: projection + row.initial,
        };
        both.zip(&self.rows).map(less).collect()
    }

    /// None where all faces touch, or none.
    fn errors(&self, matrix: &BlockMatrix, fields: &[Vec<f64>]) -> Option<CellErrors> {
        let (at, rows) = (self.stresses(matrix, &fields[0]), 0..self.rows.len());
        let normal: Vec<_> = rows.filter(|&k| self.rows[k].friction.is_none()).collect();
        let is_closed = |k: &usize| at[*k].projection < 0.0;
        let ends = normal.iter().any(is_closed) && !normal.iter().all(is_closed);
        let of_dual = |dual: &Vec<f64>| {
            let dual = self.values(&self.projections, matrix, dual);
            let part = |&k: &usize| {
                let missed = at[k].stress - at[k].projection.min(0.0);
                self.rows[k].weight / self.beta * (missed * dual[k]).abs()
            };
            normal.iter().map(part).sum()
        };
        let errors = || fields[1..].iter().map(of_dual).collect();
        ends.then(|| CellErrors { cell: self.cell, errors: errors() })
    }

    fn add(&self, states: &[FaceState], matrix: &mut BlockMatrix, load: &mut [f64]) {
        let is_tied: Vec<usize> = (0..states.len()).filter(|&k| states[k].is_tied()).collect();
        for &(k, l) in &self.pairs {
            let [rows, columns] = [k, l].map(|k| (self.first[k]..self.first[k + 1]).collect());
            let [rows, columns]: [Vec<usize>; 2] = [rows, columns];
            let product = |all: &Mat<f64>, points: &[usize]| {
                let [left, right] = [&rows, &columns].map(|rows| taken(all, rows, points));
                product(left.as_ref(), right.transpose())
            };
            let every: Vec<usize> = (0..states.len()).collect();
            let block = product(&self.projections, &is_tied) - product(&self.stresses, &every);
            let block = faer::Scale(1.0 / self.beta) * block;
            let [p, q] = [k, l].map(|k| self.patches[k] as usize);
            matrix.add_block(p, q, block.as_ref());
        }
        for (k, (row, state)) in self.rows.iter().zip(states).enumerate() {
            let root = row.weight.sqrt() / self.beta;
            let [stress, projection] = [root * row.initial, root * state.constant(row.initial)];
            let own = self.stresses.col_as_slice(k).iter().zip(self.projections.col_as_slice(k));
            let places = self.patches.iter().flat_map(|&p| matrix.unknowns(p as usize));
            for (place, (s, p)) in places.zip(own) {
                load[place] -= projection * p - stress * s;
            }
        }
    }
}

/// σ_d and \[u\]·d of the functions of a cell, all components free, a column for each row.
struct FaceTrace {
    stresses: Vec<f64>,
    jumps: Vec<f64>,
    rows: Vec<FaceRow>,
    /// The largest modulus.
    modulus: f64,
}

impl FaceTrace {
    fn new(
        assembly: Assembly<'_>,
        cell: usize,
        functions: &CellFunctions,
        faces: &[EdgeRule],
    ) -> Self {
        let mut trace =
            Self { stresses: Vec::new(), jumps: Vec::new(), rows: Vec::new(), modulus: 0.0 };
        let mut evaluator = BasisEvaluator::new(assembly.space, assembly.basis);
        let center = assembly.space.partition().cell[cell].center();
        for rule in faces {
            let [mut above, mut below] = [Shapes::default(), Shapes::default()];
            evaluator.evaluate_edge(rule, &mut above);
            evaluator.evaluate_edge(&other_side(rule), &mut below);
            let numbers = functions.numbers(&rule.patches);
            let n = functions.len() * assembly.components();
            for q in 0..rule.offsets.len() {
                let is_above = (center - rule.anchor - rule.offsets[q]).dot(rule.normals[q]) <= 0.0;
                let stressed = if is_above { &above } else { &below };
                let point =
                    FacePoint { rule, q, numbers: &numbers, shapes: [&above, &below, stressed] };
                trace.add(&assembly, &point, n);
            }
        }
        trace
    }

    fn add(&mut self, assembly: &Assembly<'_>, point: &FacePoint<'_>, n: usize) {
        let FacePoint { rule, q, .. } = *point;
        let (law, normal) = (assembly.law.at(rule.anchor + rule.offsets[q]), -rule.normals[q]);
        let law_of_faces =
            rule.face.and_then(|face| face_law(assembly.problem, face.segment.crack));
        let along = law_of_faces.map(|law| law.friction).filter(|mu| *mu > 0.0);
        let along = along.map(|mu| (-normal.left(), Some(mu)));
        self.modulus = self.modulus.max(law.modulus(0));
        let weight = rule.weights[q];
        for (d, friction) in [(normal, None)].into_iter().chain(along) {
            let initial = d.dot(law.stress(&Strain::default()).traction(normal));
            self.rows.push(FaceRow { weight, initial, friction });
            let first = self.stresses.len();
            self.stresses.resize(first + n, 0.0);
            self.jumps.resize(first + n, 0.0);
            point.visit(|place, j, jump, slopes| {
                let traction = |i: usize| law.traction(i, j, slopes, normal);
                self.stresses[first + place] =
                    weight.sqrt() * (d.x * traction(0) + d.y * traction(1));
                self.jumps[first + place] = weight.sqrt() * jump * [d.x, d.y][j];
            });
        }
    }
}

/// A point of a face with the functions there: above, below, and on the side of the stress.
struct FacePoint<'a> {
    rule: &'a EdgeRule,
    q: usize,
    numbers: &'a [usize],
    shapes: [&'a Shapes; 3],
}

impl FacePoint<'_> {
    /// Calls `visit` with the place of each unknown (a, j) of the cell, j, the jump of N_a and its
    /// slopes on the side of the stress.
    fn visit(&self, mut visit: impl FnMut(usize, usize, f64, [f64; OPERATORS])) {
        let [above, below, stressed] = self.shapes;
        for (a, &number) in self.numbers.iter().enumerate() {
            let at = a * above.points + self.q;
            let slopes = stressed.slopes_at(a, self.q);
            for j in 0..2 {
                visit(2 * number + j, j, above.value[at] - below.value[at], slopes);
            }
        }
    }
}

/// Returns the rule with its points on the other face.
fn other_side(rule: &EdgeRule) -> EdgeRule {
    let mut other = rule.clone();
    other.face = rule.face.map(|face| CrackFace { side: Side::Below, ..face });
    other
}

/// The rules on the faces above in a cell, of the cracks that may touch. A crack along the boundary
/// of two cells belongs to the cell above.
fn faces(assembly: Assembly<'_>, quadrature: &Quadrature<'_>, cell: usize) -> Vec<EdgeRule> {
    let Assembly { problem, space, .. } = assembly;
    let touching = (0..problem.cracks().len()).filter(|&k| face_law(problem, k as u32).is_some());
    let all = touching.flat_map(|k| CrackFace::of(&problem.cracks()[k], k, Side::Above));
    all.flat_map(|face| quadrature.face(space.cell(cell), face)).collect()
}

/// Columns over the cell's functions in each component as columns over its unknowns.
fn tied(assembly: &Assembly<'_>, functions: &CellFunctions, free: MatRef<'_, f64>) -> Mat<f64> {
    let (free, columns) = (free.to_owned(), (0..free.ncols()).collect::<Vec<_>>());
    let parts: Vec<Mat<f64>> = (0..functions.patches.len())
        .map(|k| {
            let own = taken(&free, &functions.free(k, assembly.components()), &columns);
            let tie = assembly.basis.tie(functions.patches[k]);
            tie.map(|tie| product(tie.as_ref(), own.as_ref())).unwrap_or(own)
        })
        .collect();
    let mut all = Mat::zeros(parts.iter().map(Mat::nrows).sum(), free.ncols());
    let mut first = 0;
    for part in &parts {
        all.subrows_mut(first, part.nrows()).copy_from(part);
        first += part.nrows();
    }
    all
}

/// The first unknown of each of some patches, and a cell's matrix in full.
fn dense(
    pairs: &[(usize, usize)],
    patches: usize,
    stiffness: &CellMatrix,
) -> (Vec<usize>, Mat<f64>) {
    let mut first = vec![0];
    (0..patches).for_each(|k| first.push(first[k] + stiffness.block(k, k).nrows()));
    let mut whole = Mat::zeros(first[patches], first[patches]);
    for &(k, l) in pairs {
        let block = stiffness.block(k, l);
        let (rows, columns) = (block.nrows(), block.ncols());
        whole.submatrix_mut(first[k], first[l], rows, columns).copy_from(block);
        whole.submatrix_mut(first[l], first[k], columns, rows).copy_from(block.transpose());
    }
    (first, whole)
}
