//! Plates and pieces of plates that nothing holds: of all solutions, which differ by rigid-body
//! modes, the one without any on average.
//!
//! ```text
//! ∫ u·m_k dA = 0 over the piece, for each of its free modes m_k
//! ```
//!
//! Where points are held, u_i(x₀) = g_i takes the place of as many of these conditions, and those
//! that stay are for the motions that the points leave.
//!
//! The conditions couple all unknowns of a piece. So the system first gets a penalty on the
//! unknowns of one patch, which is exact for balanced loads whatever its size. Solutions for the
//! same functionals as loads are the rigid-body modes themselves, in whatever functions, and they
//! are subtracted.

use super::point::PointValues;
use crate::basis::Shapes;
use crate::equilibrium::{BodyPieces, PerMode, PieceConditions, Plate, RigidModes};
use crate::linear::{BlockMatrix, LinearError, LinearSolver};
use crate::problem::Support;
use crate::quadrature::Rule;
use faer::Mat;
use faer::linalg::solvers::{DenseSolveCore, Solve};
use ppum::vec2::Vec2;

/// A free mode of a piece.
#[derive(Clone, PartialEq)]
struct Mode {
    piece: usize,
    modes: RigidModes,
    mode: PerMode,
    /// Index in [`Gauge::patches`].
    group: usize,
}

/// The free modes of all pieces.
pub(crate) struct FreeModes<'p> {
    pieces: &'p BodyPieces,
    modes: Vec<Mode>,
    /// Number of pieces that are free.
    groups: usize,
}

impl<'p> FreeModes<'p> {
    /// The free modes of a plate.
    pub(crate) fn new(plate: &'p Plate) -> Self {
        let (mut modes, mut groups) = (Vec::new(), 0);
        for (piece, (balance, free)) in plate.balances.iter().zip(&plate.free).enumerate() {
            let of_piece =
                |&mode: &PerMode| Mode { piece, modes: balance.modes, mode, group: groups };
            modes.extend(free.iter().map(of_piece));
            groups += usize::from(!free.is_empty());
        }
        Self { pieces: &plate.pieces, modes, groups }
    }

    /// No free modes, on the same pieces: their functionals are not wanted.
    pub(crate) fn none(plate: &'p Plate) -> Self {
        Self { pieces: &plate.pieces, modes: Vec::new(), groups: 0 }
    }

    /// Number of free modes.
    pub(crate) fn len(&self) -> usize {
        self.modes.len()
    }

    /// Adds ∫ N·m over the points of a rule in its piece for each mode m; shapes are those of the
    /// rule's patches, `numbers` their places in a part.
    pub(super) fn add(
        &self,
        rule: &Rule,
        shapes: &Shapes,
        numbers: &[usize],
        components: usize,
        parts: &mut [Vec<f64>],
    ) {
        if self.modes.is_empty() {
            return;
        }
        let place = |&offset: &Vec2| (rule.anchor + offset, self.pieces.of(rule.anchor + offset));
        let places: Vec<(Vec2, usize)> = rule.offsets.iter().map(place).collect();
        for (part, mode) in parts.iter_mut().zip(&self.modes) {
            let load = |(&(x, piece), weight): (&(Vec2, usize), &f64)| {
                let weight = if piece == mode.piece { *weight } else { 0.0 };
                mode.modes.combined(&mode.mode, x).map(|m| weight * m)
            };
            let loads: Vec<[f64; 2]> = places.iter().zip(&rule.weights).map(load).collect();
            shapes.add_loads(&loads, numbers, components, part);
        }
    }
}

/// A condition on fields: a functional of the unknowns and its value.
struct Condition {
    functional: Vec<f64>,
    value: f64,
}

/// The free modes of all pieces and the functionals that fix them.
pub(crate) struct Gauge {
    modes: Vec<Mode>,
    /// Of each mode, ∫ N·m over its piece, in the order of the system.
    moments: Vec<Vec<f64>>,
    /// Of each mode, ∫ u_s·m over its piece, of the known part of the field.
    known: Vec<f64>,
    /// Of each piece that is free, the patch whose unknowns get the penalty.
    patches: Vec<usize>,
    /// Conditions that take the place of moments that vanish; none where no point is held.
    conditions: Vec<Condition>,
}

impl Gauge {
    /// The gauge of free modes with these moments, ∫ N·m over their pieces in the order of
    /// the matrix, and those of the known part of the field.
    pub(crate) fn new(
        FreeModes { modes, groups, .. }: FreeModes<'_>,
        (moments, known): (Vec<Vec<f64>>, Vec<f64>),
        matrix: &BlockMatrix,
    ) -> Self {
        let mut gauge = Self { moments, known, modes, patches: Vec::new(), conditions: Vec::new() };
        gauge.patches = (0..groups).map(|group| gauge.firmest(group, matrix)).collect();
        gauge
    }

    /// The gauge of a plate with supports.
    pub(crate) fn with_supports(
        mut self,
        supports: &[Support],
        pieces: &[PieceConditions],
        values: &dyn Fn(Vec2) -> PointValues,
    ) -> Self {
        if supports.is_empty() {
            return self;
        }
        let rows: Vec<_> = supports.iter().map(|support| values(support.at)).collect();
        for (piece, conditions) in pieces.iter().enumerate() {
            let held = conditions.held.iter().map(|&(number, component)| Condition {
                functional: rows[number].functionals[component].clone(),
                value: supports[number].displacement[component].unwrap_or(0.0)
                    - rows[number].known[component],
            });
            self.conditions.extend(held);
            let left = conditions.left.iter().map(|factors| self.moment(piece, factors));
            let left: Vec<_> = left.collect();
            self.conditions.extend(left);
        }
        self
    }

    /// A combination of the moments of a piece, which vanishes for the whole field.
    fn moment(&self, piece: usize, factors: &[f64]) -> Condition {
        let own = (0..self.modes.len()).filter(|&k| self.modes[k].piece == piece);
        let functional = vec![0.0; self.moments.first().map_or(0, Vec::len)];
        let mut condition = Condition { functional, value: 0.0 };
        for (k, factor) in own.zip(factors) {
            let sums = condition.functional.iter_mut().zip(&self.moments[k]);
            sums.for_each(|(sum, m)| *sum += factor * m);
            condition.value -= factor * self.known[k];
        }
        condition
    }

    /// Number of free modes.
    pub(crate) fn len(&self) -> usize {
        self.modes.len()
    }

    /// Adds γ Σ_k r_k r_kᵀ, r_k the part of a functional on the unknowns of one patch.
    pub(crate) fn add_penalty(&self, matrix: &mut BlockMatrix) {
        for (group, &patch) in self.patches.iter().enumerate() {
            let rows: Vec<_> = self.parts(group, patch, matrix).collect();
            let length = rows.iter().copied().flatten().fold(0.0f64, |m, v| m.max(v * v));
            let stiffness = matrix.block(patch, patch).expect("a patch is coupled to itself");
            let n = stiffness.nrows();
            let gamma = (0..n).map(|k| stiffness[(k, k)]).fold(0.0, f64::max) / length;
            let entry = |a, b| gamma * rows.iter().map(|r| r[a] * r[b]).sum::<f64>();
            let block = Mat::from_fn(n, n, entry);
            matrix.add_block(patch, patch, block.as_ref());
        }
    }

    /// Replaces the rigid-body modes that the penalty has left in a solution by those of the
    /// conditions.
    ///
    /// # Errors
    /// Those of the linear solver.
    pub(crate) fn center(
        &self,
        solver: &dyn LinearSolver,
        matrix: &BlockMatrix,
        solution: &mut [f64],
    ) -> Result<(), LinearError> {
        if self.modes.is_empty() {
            return Ok(());
        }
        let rigid = match solver.kernel() {
            Some(modes) => modes,
            None => self.rigid(solver, matrix)?,
        };
        let (functionals, excess) = match self.conditions.is_empty() {
            true => (self.means(&rigid), self.means(&[&*solution]) + self.known_means()),
            false => (self.values(&rigid), self.excess(solution)),
        };
        let parts = functionals.partial_piv_lu().solve(excess);
        for (k, rigid) in rigid.iter().enumerate() {
            solution.iter_mut().zip(rigid).for_each(|(u, r)| *u -= parts[(k, 0)] * r);
        }
        Ok(())
    }

    /// The rigid-body modes, as solutions for the functionals of the penalty.
    fn rigid(
        &self,
        solver: &dyn LinearSolver,
        matrix: &BlockMatrix,
    ) -> Result<Vec<Vec<f64>>, LinearError> {
        let loads = self.loads(matrix);
        let rough = solver.solve_roughly(&loads)?;
        // Loads of modes that have one mean each: those of one patch look much alike, and the
        // rounding of their differences would be seen in strains.
        let loads = combined(&loads, &self.means(&rough).partial_piv_lu().inverse());
        Ok(solver.solve_all(&loads)?.into_iter().map(|solution| solution.unknowns).collect())
    }

    /// The functionals of the penalty as right-hand sides: their solutions are rigid-body modes.
    pub(crate) fn loads(&self, matrix: &BlockMatrix) -> Vec<Vec<f64>> {
        let load = |(mode, moments): (&Mode, &Vec<f64>)| {
            let mut load = vec![0.0; moments.len()];
            let range = matrix.unknowns(self.patches[mode.group]);
            load[range.clone()].copy_from_slice(&moments[range]);
            load
        };
        self.modes.iter().zip(&self.moments).map(load).collect()
    }

    /// ∫ u·m_l of some u: a row for each mode, a column for each u.
    fn means<U: AsRef<[f64]>>(&self, all: &[U]) -> Mat<f64> {
        let (rows, columns) = (self.moments.len(), all.len());
        Mat::from_fn(rows, columns, |l, k| dot(&self.moments[l], all[k].as_ref()))
    }

    /// ∫ u_s·m_l, in a column.
    fn known_means(&self) -> Mat<f64> {
        Mat::from_fn(self.known.len(), 1, |l, _| self.known[l])
    }

    /// The functionals of the conditions of some u, as [`Gauge::means`].
    fn values(&self, all: &[Vec<f64>]) -> Mat<f64> {
        let functional = |l: usize| &self.conditions[l].functional;
        Mat::from_fn(self.conditions.len(), all.len(), |l, k| dot(functional(l), &all[k]))
    }

    /// What the functionals of a solution exceed their values by.
    fn excess(&self, solution: &[f64]) -> Mat<f64> {
        let excess =
            |Condition { functional, value }: &Condition| dot(functional, solution) - value;
        Mat::from_fn(self.conditions.len(), 1, |l, _| excess(&self.conditions[l]))
    }

    /// The functionals of one group on the unknowns of a patch.
    fn parts<'g>(
        &'g self,
        group: usize,
        patch: usize,
        matrix: &BlockMatrix,
    ) -> impl Iterator<Item = &'g [f64]> {
        let range = matrix.unknowns(patch);
        let all = self.modes.iter().zip(&self.moments);
        all.filter(move |(mode, _)| mode.group == group)
            .map(move |(_, moments)| &moments[range.clone()])
    }

    /// The patch on which the modes of a group are largest and least alike.
    fn firmest(&self, group: usize, matrix: &BlockMatrix) -> usize {
        let volume = |patch: usize| {
            let rows: Vec<_> = self.parts(group, patch, matrix).collect();
            Mat::from_fn(rows.len(), rows.len(), |k, l| dot(rows[k], rows[l])).determinant()
        };
        let all = (0..matrix.n_blocks()).map(|patch| (patch, volume(patch)));
        all.fold((0, 0.0), |best, new| if new.1 > best.1 { new } else { best }).0
    }
}

/// Combinations of vectors, with the factors of each in a column.
fn combined(vectors: &[Vec<f64>], factors: &Mat<f64>) -> Vec<Vec<f64>> {
    let entry = |k: usize, row: usize| {
        vectors.iter().enumerate().map(|(j, vector)| factors[(j, k)] * vector[row]).sum()
    };
    let rows = vectors.first().map_or(0, Vec::len);
    (0..vectors.len()).map(|k| (0..rows).map(|row| entry(k, row)).collect()).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
