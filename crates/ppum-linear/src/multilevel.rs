//! Solution of K u = f by conjugate gradients, preconditioned by one cycle through coarser and
//! coarser levels.
//!
//! ```text
//! x = (D + L)⁻¹ f                      sweep forward, then the clusters
//! x ← x + P y,  K_c y = Pᵀ (f − K x)   correction: the same on the next level, or by Cholesky on the coarsest
//! x ← x + (D + Lᵀ)⁻¹ (f − K x)         the clusters, then sweep backward
//! ```
//!
//! The coarse matrices K_c are what the caller gives: Pᵀ K P need not be among them. The cycle is
//! symmetric and positive definite whatever they are, as long as they are.

use super::block_matrix::BlockMatrix;
use super::cholesky::Cholesky;
use super::conjugate::{conjugate_gradients, dot, norm, relative};
use super::null_space::NullSpace;
use super::rows::SymmetricRows;
use super::smoother::Smoother;
use super::solver::{ConvergenceHistory, LinearError, LinearSolution, LinearSolver, check_load};
use super::transfer::Transfer;
use faer::Mat;
use std::borrow::Cow;

/// Times that the iteration starts again from the true residual, which rounding takes away from the
/// one that it keeps.
const RESTARTS: usize = 2;

/// How much larger than asked the true residual may be in the end.
const SLACK: f64 = 3.0;

/// Force on a motion of size one that counts as none, in units of the largest stiffness: rounding
/// leaves about 1e-14.
const RIGID: f64 = 1e-10;

/// The tolerance of dual solutions, which only weigh estimated errors.
const ROUGH: f64 = 1e-7;

/// Rounding of K x, in units of the stiffest unknown times x: about fifty products in a row, of
/// which each has 1e-16.
const ROUNDING: f64 = 2e-14;

/// A coarse level: its matrix, and the way from it to the next finer one.
#[derive(Debug)]
pub struct CoarseLevel {
    /// The matrix of this level.
    pub matrix: BlockMatrix,
    /// The prolongation to the next finer level.
    pub transfer: Transfer,
}

/// A level that is smoothed, with the way to the next coarser one.
#[derive(Debug)]
struct SmoothedLevel<'a> {
    smoother: Smoother<'a>,
    transfer: Transfer,
}

/// A system with its levels.
pub struct Multilevel<'a> {
    /// The system, by rows.
    levels: Vec<SmoothedLevel<'a>>,
    /// The coarsest level: its rows, in whose order vectors are, and its factor.
    coarsest: (SymmetricRows<'a>, Cholesky<'a>),
    kernel: NullSpace,
    /// The largest entry of the diagonal.
    largest_diagonal: f64,
    goes_on: &'a (dyn Fn() -> bool + Sync),
    tolerance: f64,
}

impl<'a> Multilevel<'a> {
    /// The solver of a system with coarser levels of it, the finest of them first. The matrix is
    /// singular with as many modes as there are functionals `free`, each on the unknowns of one
    /// block. The number is the part of the error in the energy norm that may be left; who stands
    /// beside it is asked before each step whether to go on.
    ///
    /// # Errors
    /// Those of the factorisation of the coarsest level; modes that the levels do not show.
    pub fn new(
        matrix: &'a BlockMatrix,
        coarser: Vec<CoarseLevel>,
        free: &[Vec<f64>],
        (tolerance, goes_on): (f64, &'a (dyn Fn() -> bool + Sync)),
    ) -> Result<Self, LinearError> {
        let mut levels = Vec::new();
        let mut finer = Cow::Borrowed(matrix);
        for CoarseLevel { matrix, transfer } in coarser {
            let smoother = Smoother::new(SymmetricRows::new(finer));
            levels.push(SmoothedLevel { smoother, transfer });
            finer = Cow::Owned(matrix);
        }
        let rows = SymmetricRows::new(finer);
        let on_coarsest = restricted(&levels, &rows, free);
        let mut held = rows.matrix.clone().into_owned();
        on_coarsest.iter().for_each(|functional| hold(&mut held, functional));
        let coarsest = (rows, Cholesky::of(Cow::Owned(held))?);
        let kernel = NullSpace::default();
        let mut solver =
            Self { levels, coarsest, kernel, largest_diagonal: 0.0, goes_on, tolerance };
        solver.largest_diagonal = solver.rows(0).largest_diagonal();
        solver.kernel = solver.modes(free, &on_coarsest)?;
        Ok(solver)
    }

    /// The modes of a singular matrix: those of the coarsest level, prolonged.
    fn modes(&self, free: &[Vec<f64>], on_coarsest: &[Vec<f64>]) -> Result<NullSpace, LinearError> {
        let mode = |functional: &Vec<f64>| {
            let mut z = self.coarsest.0.coloured(&self.coarsest.1.apply_inverse(functional));
            for (k, SmoothedLevel { smoother, transfer }) in self.levels.iter().enumerate().rev() {
                let mut finer = vec![0.0; smoother.rows.n_unknowns()];
                transfer.add_prolonged((self.rows(k + 1), &z), &smoother.rows, &mut finer);
                z = finer;
            }
            z
        };
        let rows = self.rows(0);
        let functionals = free.iter().map(|functional| rows.coloured(functional)).collect();
        let kernel = NullSpace::new(on_coarsest.iter().map(mode).collect(), functionals);
        let force = kernel.force(rows, self.largest_diagonal);
        if force <= RIGID { Ok(kernel) } else { Err(LinearError::NoModes { force }) }
    }

    /// Number of levels.
    fn n_levels(&self) -> usize {
        self.levels.len() + 1
    }

    fn bytes_of(&self, level: usize) -> usize {
        match self.levels.get(level) {
            Some(level) => level.smoother.bytes() + level.transfer.bytes(),
            None => self.coarsest.0.bytes() + self.coarsest.1.bytes(),
        }
    }

    fn rows(&self, level: usize) -> &SymmetricRows<'a> {
        self.levels.get(level).map_or(&self.coarsest.0, |level| &level.smoother.rows)
    }

    /// One cycle from some level on: an approximation of K⁻¹ f. The norms of the right-hand sides
    /// are appended.
    fn cycle(&self, level: usize, f: &[f64], norms: &mut Vec<f64>) -> Vec<f64> {
        norms.push(norm(f));
        let Some(SmoothedLevel { smoother, transfer }) = self.levels.get(level) else {
            let (rows, factor) = &self.coarsest;
            return rows.coloured(&factor.apply_inverse(&rows.plain(f)));
        };
        let (mut x, rest) = smoother.before(f);
        let (fine, coarse) = (&smoother.rows, self.rows(level + 1));
        let correction = self.cycle(level + 1, &transfer.restricted((fine, &rest), coarse), norms);
        transfer.add_prolonged((coarse, &correction), fine, &mut x);
        smoother.after(f, &mut x, rest);
        x
    }

    /// One cycle, beside the modes of a singular matrix.
    fn precondition(&self, r: &[f64], norms: &mut Vec<f64>) -> Vec<f64> {
        if self.kernel.modes.is_empty() {
            return self.cycle(0, r, norms);
        }
        let mut r = r.to_vec();
        self.kernel.project(&mut r);
        let mut z = self.cycle(0, &r, norms);
        self.kernel.project(&mut z);
        z
    }

    /// x with K x = f in the order of the rows, and how it was found.
    fn iterate(
        &self,
        wanted: f64,
        f: &[f64],
    ) -> Result<(Vec<f64>, ConvergenceHistory), LinearError> {
        let (mut x, mut rest) = (vec![0.0; f.len()], f.to_vec());
        let (mut all, mut left) = (ConvergenceHistory::default(), 1.0);
        for _ in 0..=RESTARTS {
            let (part, history, is_reached) = conjugate_gradients(
                &mut rest,
                wanted / left,
                |x, out| self.rows(0).multiply(x, out),
                |r, norms| self.precondition(r, norms),
                self.goes_on,
            )?;
            x.iter_mut().zip(&part).for_each(|(x, part)| *x += part);
            all.append(history, left);
            rest = self.remainder(f, &x);
            // no method does better than rounding
            if is_reached && norm(&rest) <= ROUNDING * self.largest_diagonal * norm(&x) {
                return Ok((x, all));
            }
            let z = self.precondition(&rest, &mut Vec::new());
            left = dot(&rest, &z).max(0.0).sqrt() / all.size;
            if left <= SLACK * wanted {
                return Ok((x, all));
            }
        }
        Err(LinearError::NotConverged { steps: all.residuals.len() - 1, left })
    }

    /// f − K x
    fn remainder(&self, f: &[f64], x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; f.len()];
        self.rows(0).multiply(x, &mut product);
        f.iter().zip(&product).map(|(f, product)| f - product).collect()
    }
}

impl LinearSolver for Multilevel<'_> {
    fn solve(&self, load: &[f64]) -> Result<LinearSolution, LinearError> {
        self.solve_to(self.tolerance, load)
    }

    fn solve_roughly(&self, loads: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, LinearError> {
        let roughly = |load: &Vec<f64>| self.solve_to(self.tolerance.max(ROUGH), load);
        loads.iter().map(|load| Ok(roughly(load)?.unknowns)).collect()
    }

    fn kernel(&self) -> Option<Vec<Vec<f64>>> {
        Some(self.kernel.modes.iter().map(|mode| self.rows(0).plain(mode)).collect())
    }

    fn bytes(&self) -> usize {
        (0..self.n_levels()).map(|level| self.bytes_of(level)).sum()
    }

    fn level_sizes(&self) -> Vec<[usize; 4]> {
        let size = |level| {
            let matrix = &self.rows(level).matrix;
            [matrix.n_blocks(), matrix.n_unknowns(), matrix.n_values(), self.bytes_of(level)]
        };
        (0..self.n_levels()).map(size).collect()
    }
}

impl Multilevel<'_> {
    fn solve_to(&self, tolerance: f64, load: &[f64]) -> Result<LinearSolution, LinearError> {
        let rows = self.rows(0);
        check_load(&rows.matrix, load)?;
        let mut f = rows.coloured(load);
        self.kernel.balance(&mut f);
        let (x, history) = self.iterate(tolerance, &f)?;
        let relative_residual = relative(&self.remainder(&f, &x), &f);
        Ok(LinearSolution { unknowns: rows.plain(&x), relative_residual, history: Some(history) })
    }
}

/// Functionals on the finest level as ones on the coarsest, in the order of its matrix.
fn restricted(
    levels: &[SmoothedLevel<'_>],
    coarsest: &SymmetricRows<'_>,
    free: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let of = |functional: &Vec<f64>| {
        let Some(finest) = levels.first() else { return functional.clone() };
        let mut r = finest.smoother.rows.coloured(functional);
        for (k, SmoothedLevel { smoother, transfer }) in levels.iter().enumerate() {
            let coarser = levels.get(k + 1).map_or(coarsest, |level| &level.smoother.rows);
            r = transfer.restricted((&smoother.rows, &r), coarser);
        }
        coarsest.plain(&r)
    };
    free.iter().map(of).collect()
}

/// Adds γ r rᵀ, r a functional on the unknowns of one block.
fn hold(matrix: &mut BlockMatrix, functional: &[f64]) {
    let Some(u) = functional.iter().position(|r| *r != 0.0) else { return };
    let block = matrix.patch_of(u);
    let r = &functional[matrix.unknowns(block)];
    let stiffness = matrix.block(block, block).expect("a block is coupled to itself");
    let size = (0..r.len()).map(|k| stiffness[(k, k)]).fold(0.0, f64::max);
    let gamma = size / r.iter().fold(0.0f64, |most, r| most.max(r * r));
    let penalty = Mat::from_fn(r.len(), r.len(), |a, b| gamma * r[a] * r[b]);
    matrix.add_block(block, block, penalty.as_ref());
}

impl ConvergenceHistory {
    /// Adds what came after a start from a residual of this size.
    fn append(&mut self, next: Self, size: f64) {
        let skip = usize::from(!self.residuals.is_empty());
        if skip == 0 {
            self.size = next.size;
        }
        self.residuals.extend(next.residuals.iter().skip(skip).map(|part| part * size));
        let first = self.levels.first().or(next.levels.first()).cloned().unwrap_or_default();
        let parts = |norms: Vec<f64>| -> Vec<f64> {
            let pairs = norms.into_iter().zip(&first);
            pairs.map(|(norm, first)| if *first > 0.0 { norm / first } else { 0.0 }).collect()
        };
        self.levels.extend(next.levels.into_iter().skip(skip).map(parts));
        self.condition = self.condition.max(next.condition);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BlockPattern;
    use crate::test_matrices::grid_matrix;
    use ppum_testkit::random::Random;

    /// Second differences on n points, with ends that are free or held.
    fn line(n: usize, is_held: bool) -> BlockMatrix {
        let columns = (0..n as u32).flat_map(|i| i..(i + 2).min(n as u32)).collect();
        let starts = (0..=n).map(|i| (2 * i).min(2 * n - 1)).collect();
        let mut matrix = BlockMatrix::new(&vec![1; n], BlockPattern::new(starts, columns));
        let mut add = |i, j, value| matrix.add_block(i, j, Mat::full(1, 1, value).as_ref());
        for i in 0..n {
            let ends = f64::from(u8::from(i == 0)) + f64::from(u8::from(i + 1 == n));
            add(i, i, 2.0 - if is_held { 0.0 } else { ends });
            if i + 1 < n {
                add(i, i + 1, -1.0);
            }
        }
        matrix
    }

    /// Two points take the value of one; a coarse cell is twice as long, so that differences have
    /// half the stiffness.
    fn levels(n: usize, is_held: bool, factor: f64) -> Vec<CoarseLevel> {
        let halves = std::iter::successors(Some(n / 2), |n| Some(n / 2)).take_while(|n| *n > 10);
        let level = |(k, n): (usize, usize)| {
            let mut matrix = line(n, is_held);
            let scale = factor * 0.5f64.powi(k as i32 + 1) - 1.0;
            for (i, j) in line(n, is_held).pattern().pairs() {
                let entry = matrix.block(i, j).expect("a stored block")[(0, 0)];
                matrix.add_block(i, j, Mat::full(1, 1, scale * entry).as_ref());
            }
            let mut transfer = Transfer::from_blocks(n);
            (0..2 * n).for_each(|i| transfer.push(Some((i as u32 / 2, &Mat::full(1, 1, 1.0), 1))));
            CoarseLevel { matrix, transfer }
        };
        halves.enumerate().map(level).collect()
    }

    fn solver<'a>(
        matrix: &'a BlockMatrix,
        coarser: Vec<CoarseLevel>,
        free: &[Vec<f64>],
    ) -> Multilevel<'a> {
        Multilevel::new(matrix, coarser, free, (1e-12, &|| true)).expect("levels that fit")
    }

    fn random_vector(n: usize) -> Vec<f64> {
        let mut random = Random(3);
        (0..n).map(|_| random.between(-1.0, 1.0)).collect()
    }

    /// xᵀ M y = yᵀ M x, and what any of them makes of itself is positive: M is what conjugate
    /// gradients ask for.
    #[test]
    fn a_cycle_is_symmetric_and_positive() {
        let matrix = line(640, true);
        let solver = solver(&matrix, levels(640, true, 0.7), &[]);
        assert_eq!(solver.n_levels(), 6);
        let (x, y) = (random_vector(640), line(640, true).multiply(&random_vector(640)));
        let m = |x: &[f64]| solver.cycle(0, x, &mut Vec::new());
        assert!((dot(&x, &m(&y)) - dot(&y, &m(&x))).abs() < 1e-12 * dot(&x, &m(&x)));
        assert!(dot(&y, &m(&y)) > 0.0);
    }

    /// Against the factor: any matrix on one level, second differences on many, in steps that do
    /// not grow.
    #[test]
    fn solutions_are_those_of_the_factor() {
        let mut steps = Vec::new();
        let grid = grid_matrix(9, 7, &mut Random(1));
        let mut agree = |matrix: &BlockMatrix, coarser| {
            let f = random_vector(matrix.n_unknowns());
            let found = solver(matrix, coarser, &[]).solve(&f).expect("a solution");
            let exact = Cholesky::new(matrix).and_then(|c| c.solve(&f)).expect("a solution");
            let largest = exact.unknowns.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            for (x, y) in found.unknowns.iter().zip(&exact.unknowns) {
                assert!((x - y).abs() < 1e-10 * largest, "{x}, not {y}");
            }
            steps.push(found.history.expect("steps").residuals.len() - 1);
        };
        agree(&grid, Vec::new());
        [320, 1280, 5120].into_iter().for_each(|n| agree(&line(n, true), levels(n, true, 1.0)));
        assert_eq!(steps[0], 1, "one level is solved by its factor");
        assert!(steps[3] <= 2 * steps[1] && steps[3] < 60, "{steps:?}");
    }

    /// Nothing holds the line: constants are its modes, loads without resultant have solutions, and
    /// what is left of others is taken by the functional.
    #[test]
    fn a_singular_matrix_with_its_mode() {
        let n = 640;
        let matrix = line(n, false);
        let mut hold = vec![0.0; n];
        hold[100] = 1.0;
        let solver = solver(&matrix, levels(n, false, 1.0), &[hold.clone()]);
        let modes = solver.kernel().expect("a kernel");
        let size = (1.0 / n as f64).sqrt();
        assert!(modes.len() == 1 && modes[0].iter().all(|z| (z.abs() - size).abs() < 1e-12));
        let f = random_vector(n);
        let found = solver.solve(&f).expect("a solution").unknowns;
        let resultant: f64 = f.iter().sum();
        for ((f, product), hold) in f.iter().zip(matrix.multiply(&found)).zip(&hold) {
            // second differences of u of the size of 1e4
            assert!((f - resultant * hold - product).abs() < 1e-9);
        }
    }

    /// Levels that do not fit: constants cost energy on the coarse ones.
    #[test]
    fn modes_that_the_levels_do_not_show_are_an_error() {
        let matrix = line(640, false);
        let mut hold = vec![0.0; 640];
        hold[100] = 1.0;
        let coarser = levels(640, true, 1.0);
        let found = Multilevel::new(&matrix, coarser, &[hold], (1e-12, &|| true)).err();
        assert!(matches!(found, Some(LinearError::NoModes { .. })), "{found:?}");
    }

    /// Corrections a million times too small leave smoothing alone to solve the system.
    #[test]
    fn what_does_not_converge_is_told() {
        let matrix = line(5120, true);
        let solver = solver(&matrix, levels(5120, true, 1e6), &[]);
        let found = solver.solve(&random_vector(5120)).err();
        assert!(matches!(found, Some(LinearError::NotConverged { .. })), "{found:?}");
    }

    #[test]
    fn it_stops_when_asked() {
        let matrix = line(640, true);
        let coarser = levels(640, true, 1.0);
        let solver = Multilevel::new(&matrix, coarser, &[], (1e-12, &|| false)).expect("levels");
        assert_eq!(solver.solve(&random_vector(640)).err(), Some(LinearError::Stopped));
    }
}
