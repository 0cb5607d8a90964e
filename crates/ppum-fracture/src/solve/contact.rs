//! Faces that touch: the states of their points by a semi-smooth Newton method.
//!
//! The system with the states that a field implies is the tangent there. Its solution is the next
//! field, or where the functional of [`FaceContacts`] is least on the way to it. That is convex and
//! quadratic piece by piece, so that the states settle after finitely many steps, from any start.
//! With friction this is done with known bounds μ p, and then again with those of the field that
//! was found, until that stays: a fixed point by contraction, unless μ is large. All systems are
//! symmetric.
//!
//! Tangents differ in the rows whose states differ, K_S = K_R + Σ ± p pᵀ/β. So one factor serves
//! many of them [Sherman, Morrison & Woodbury]: with the gradient g₀ at a field u₀ all that follow
//! it are
//!
//! ```text
//! u = u₀ − τ K_R⁻¹ g₀ + Σ λ_i K_R⁻¹ p_i
//! g(u) = (1 − τ) g₀ + Σ p_i (λ_i − ρ_i)      ρ_i = √w/β (Δ_R − Δ)
//! ```
//!
//! where Δ is what the traction at a row has changed by since u₀, and Δ_R what it would have
//! changed by in the state of K_R: λ belongs to the rows in other states alone, and P_d of all rows
//! is all that the steps need.
//!
//! Pieces that only faces hold are loose in systems in which too few of these touch. So a soft
//! spring keeps them where u₀ has them (Rockafellar's proximal point method, 1976), which does
//! nothing at the end.

use super::SolveError;
use faer::linalg::solvers::Solve as _;
use faer::{Col, Mat};
use ppum_linear::{BlockMatrix, Cholesky, LinearError, LinearSolver as _};
use ppum_solve::assembly::{FaceContacts, FaceState, NullSpaceConstraint, RowFactors, System};
use ppum_solve::watched::WorkPhase;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Most fields u₀, and steps from each, before the states must have settled.
const MOST_FIELDS: usize = 120;
const MOST_STEPS: usize = 200;

/// Rows for which a factor is used at once, and in all, that take less time than a new one.
const MOST_NEW: usize = 160;
const MOST_ROWS: usize = 400;

/// Rows that are solved for at once, so that their fields take little memory.
const AT_ONCE: usize = 64;

/// Energy of the way to the next field, in parts of that of the field, up to which it is the same;
/// and up to which the states from u₀ on are found: what is left of the field is the root.
const SMALL: f64 = 1e-14;
const EXACT: f64 = 1e-22;

/// Halvings of the way to the next field.
const HALVINGS: usize = 40;

/// Slope of the functional at the next field, in parts of that at the last, that is none.
const FLAT: f64 = 1e-8;

/// Adds the terms of faces that touch to the system, which has its constraint, and returns the
/// number of factors that this took; zero where no faces overlap without, and the system stays as
/// it is.
///
/// # Errors
/// A system that cannot be solved, states that do not settle; cancelled.
pub(super) fn solve_contact(
    contacts: &FaceContacts,
    constraint: &NullSpaceConstraint,
    System { matrix, load, .. }: &mut System,
    located: &dyn Fn(LinearError) -> SolveError,
    stage: &WorkPhase<'_>,
) -> Result<usize, SolveError> {
    let factor = |matrix: BlockMatrix| {
        stage.advance(0)?;
        Cholesky::of(Cow::Owned(matrix)).map_err(located)
    };
    let spring = constraint.spring(matrix);
    if spring.is_empty() {
        let open = factor(matrix.clone())?.solve(load).map_err(located)?.unknowns;
        if contacts.is_open(&contacts.stresses(matrix, &open)) {
            return Ok(0);
        }
    }
    let reference = |states: Vec<FaceState>| {
        let (mut tangent, load) = contacts.system(&states, matrix, load);
        spring.add_to(&mut tangent);
        let solver = factor(tangent)?;
        Ok::<_, SolveError>((Reference { solver, states, columns: BTreeMap::new() }, load))
    };
    let faces = ContactSystem::new(contacts, matrix, load);
    // faces that hold together have pressures of the size that they will have
    let (mut known, tied) = reference(vec![FaceState::Tied; faces.rows.len()])?;
    let mut field = known.solver.solve(&tied).map_err(located)?.unknowns;
    let (mut factors, mut is_far) = (1, false);
    // those of fields that overlap would be thousands of times too large
    let mut intervals = contacts.intervals(&contacts.projections(matrix, &field));
    let mut was_short = false;
    for _ in 0..MOST_FIELDS {
        stage.advance(0)?;
        let start = faces.at(&field, &intervals);
        if is_far {
            (known, _) = reference(start.states())?;
            factors += 1;
        }
        let mut descent = Descent::new(&faces, &start, &mut known).map_err(located)?;
        let fall;
        (fall, is_far) = descent.run().map_err(located)?;
        let is_short = fall.is_some_and(|fall| fall.abs() <= SMALL * start.energy);
        descent.add_to(&mut field).map_err(located)?;
        if is_far {
            continue;
        }
        let renewed = contacts.intervals(&contacts.projections(matrix, &field));
        if is_short && (was_short || renewed == intervals) {
            (*matrix, *load) = contacts.system(&start.states(), matrix, load);
            return Ok(factors);
        }
        (intervals, was_short) = (renewed, is_short);
    }
    Err(SolveError::Contact { steps: MOST_FIELDS })
}

/// The faces, and the system in which they have no tractions.
struct ContactSystem<'a> {
    contacts: &'a FaceContacts,
    rows: Vec<RowFactors>,
    matrix: BlockMatrix,
    load: Vec<f64>,
}

/// A field u₀ as faces see it.
struct FaceField<'i> {
    projections: Vec<f64>,
    /// The bounds that are known.
    intervals: &'i [[f64; 2]],
    /// g₀
    gradient: Vec<f64>,
    /// Twice its energy without tractions on faces.
    energy: f64,
}

/// The factor of K_R, and the changes of P_d at all rows by K_R⁻¹ p of some.
struct Reference {
    solver: Cholesky<'static>,
    states: Vec<FaceState>,
    columns: BTreeMap<usize, Vec<f64>>,
}

impl<'a> ContactSystem<'a> {
    fn new(contacts: &'a FaceContacts, matrix: &BlockMatrix, load: &[f64]) -> Self {
        let rows = contacts.factors();
        let (matrix, load) =
            contacts.system(&vec![FaceState::Loaded(0.0); rows.len()], matrix, load);
        Self { contacts, rows, matrix, load }
    }

    fn at<'i>(&self, field: &[f64], intervals: &'i [[f64; 2]]) -> FaceField<'i> {
        let projections = self.contacts.projections(&self.matrix, field);
        let product = self.matrix.multiply(field);
        let energy = dot(&product, field);
        let mut gradient: Vec<f64> = product.iter().zip(&self.load).map(|(ku, f)| ku - f).collect();
        let rows = self.rows.iter().zip(projections.iter().zip(intervals));
        let forces: Vec<f64> =
            rows.map(|(row, (p, [low, high]))| row.force * p.clamp(*low, *high)).collect();
        self.contacts.add_columns(&forces, &self.matrix, &mut gradient);
        FaceField { projections, intervals, gradient, energy }
    }

    /// Σ λ p
    fn load(&self, forces: &[f64]) -> Vec<f64> {
        let mut load = vec![0.0; self.load.len()];
        self.contacts.add_columns(forces, &self.matrix, &mut load);
        load
    }

    /// p of a row.
    fn column(&self, row: usize) -> Vec<f64> {
        let mut forces = vec![0.0; self.rows.len()];
        forces[row] = 1.0;
        self.load(&forces)
    }
}

impl FaceField<'_> {
    fn states(&self) -> Vec<FaceState> {
        let rows = self.projections.iter().zip(self.intervals);
        rows.map(|(projection, interval)| FaceState::new(*projection, *interval)).collect()
    }
}

impl Reference {
    fn solve(&self, load: Vec<f64>) -> Result<Vec<f64>, LinearError> {
        Ok(self.solver.solve_roughly(&[load])?.remove(0))
    }

    /// Finds the columns of rows; false if a new factor takes less time.
    fn extend(&mut self, rows: &[usize], faces: &ContactSystem<'_>) -> Result<bool, LinearError> {
        let is_new = |row: &usize| !self.columns.contains_key(row);
        let new: Vec<usize> = rows.iter().copied().filter(is_new).collect();
        if new.len() > MOST_NEW || self.columns.len() + new.len() > MOST_ROWS {
            return Ok(false);
        }
        for rows in new.chunks(AT_ONCE) {
            let loads: Vec<_> = rows.iter().map(|&row| faces.column(row)).collect();
            let fields = self.solver.solve_roughly(&loads)?;
            let changes = fields.iter().map(|field| faces.contacts.changes(&faces.matrix, field));
            self.columns.extend(rows.iter().copied().zip(changes));
        }
        Ok(true)
    }
}

/// The search for the states from a field u₀ on.
struct Descent<'a> {
    faces: &'a ContactSystem<'a>,
    start: &'a FaceField<'a>,
    known: &'a mut Reference,
    /// −K_R⁻¹ g₀, the changes of P_d by it, and the slope of the functional along it at u₀.
    direction: Vec<f64>,
    way: Vec<f64>,
    fall: f64,
    /// τ
    part: f64,
    /// λ
    forces: Vec<f64>,
    projections: Vec<f64>,
}

/// A way from a field to the next.
struct DescentStep {
    /// Changes of λ, and of P_d.
    forces: Vec<f64>,
    changes: Vec<f64>,
}

impl<'a> Descent<'a> {
    fn new(
        faces: &'a ContactSystem<'a>,
        start: &'a FaceField<'a>,
        known: &'a mut Reference,
    ) -> Result<Self, LinearError> {
        let direction = known.solve(start.gradient.iter().map(|g| -g).collect())?;
        let way = faces.contacts.changes(&faces.matrix, &direction);
        let fall = dot(&start.gradient, &direction);
        let (forces, projections) = (vec![0.0; faces.rows.len()], start.projections.clone());
        Ok(Self { faces, start, known, direction, way, fall, part: 0.0, forces, projections })
    }

    /// Goes on until the states have settled, or until a new factor takes less time: true then.
    /// With it the slope of the functional along the first step.
    fn run(&mut self) -> Result<(Option<f64>, bool), LinearError> {
        let mut first = None;
        for _ in 0..MOST_STEPS {
            let rows = self.rows();
            if !self.known.extend(&rows, self.faces)? {
                return Ok((first, true));
            }
            let step = self.step(&rows);
            let fall = self.slope(&step, 0.0);
            first = first.or(Some(fall));
            if fall.abs() <= EXACT * self.start.energy {
                break;
            }
            self.advance(&step);
        }
        Ok((first, false))
    }

    /// The rows that are, or have been, in other states than in K_R.
    fn rows(&self) -> Vec<usize> {
        let differs = |&k: &usize| {
            self.gain(k) != 0.0
                || self.forces[k] != 0.0
                || self.excess(k, self.projections[k]) != 0.0
        };
        (0..self.forces.len()).filter(differs).collect()
    }

    /// ρ of a row.
    fn excess(&self, k: usize, projection: f64) -> f64 {
        let ([low, high], before) = (self.start.intervals[k], self.start.projections[k]);
        let tied = if self.known.states[k].is_tied() { projection - before } else { 0.0 };
        let found = projection.clamp(low, high) - before.clamp(low, high);
        self.faces.rows[k].force * (tied - found)
    }

    /// The derivative of ρ by P_d.
    fn gain(&self, k: usize) -> f64 {
        let state = FaceState::new(self.projections[k], self.start.intervals[k]);
        let [before, now] = [self.known.states[k], state].map(|state| f64::from(state.is_tied()));
        self.faces.rows[k].force * (before - now)
    }

    /// Newton's step: λ + δλ = ρ + ρ′ δP.
    fn step(&self, rows: &[usize]) -> DescentStep {
        let rest = 1.0 - self.part;
        let columns: Vec<&[f64]> = rows.iter().map(|row| &self.known.columns[row][..]).collect();
        let matrix = Mat::from_fn(rows.len(), rows.len(), |a, b| {
            f64::from(a == b) - self.gain(rows[a]) * columns[b][rows[a]]
        });
        let right = Col::from_fn(rows.len(), |a| {
            let k = rows[a];
            let lacking = self.excess(k, self.projections[k]) - self.forces[k];
            lacking + self.gain(k) * rest * self.way[k]
        });
        let found = matrix.partial_piv_lu().solve(right);
        let mut forces = vec![0.0; self.forces.len()];
        let mut changes: Vec<f64> = self.way.iter().map(|change| rest * change).collect();
        for (a, (&k, column)) in rows.iter().zip(columns).enumerate() {
            forces[k] = found[a];
            changes.iter_mut().zip(column).for_each(|(sum, change)| *sum += found[a] * change);
        }
        DescentStep { forces, changes }
    }

    /// The slope of the functional at a part of a step.
    fn slope(&self, step: &DescentStep, t: f64) -> f64 {
        let rest = 1.0 - self.part;
        let (mut of_start, mut of_rows) = (rest * self.fall, 0.0);
        for (k, row) in self.faces.rows.iter().enumerate() {
            let (change, force) = (step.changes[k], step.forces[k]);
            of_start -= force * row.root * self.way[k];
            let excess = self.excess(k, self.projections[k] + t * change);
            of_rows += row.root * change * (self.forces[k] + t * force - excess);
        }
        rest * (1.0 - t) * of_start + of_rows
    }

    /// Goes to where the functional is least on the way; all of it if it still falls there.
    fn advance(&mut self, step: &DescentStep) {
        let halve = |[low, high]: [f64; 2], _| {
            let middle = 0.5 * (low + high);
            if self.slope(step, middle) < 0.0 { [middle, high] } else { [low, middle] }
        };
        let falls = self.slope(step, 1.0) <= FLAT * self.slope(step, 0.0).abs();
        let t = if falls { 1.0 } else { (0..HALVINGS).fold([0.0, 1.0], halve)[1] };
        self.part += t * (1.0 - self.part);
        let add = |sum: &mut [f64], change: &[f64]| {
            sum.iter_mut().zip(change).for_each(|(sum, change)| *sum += t * change);
        };
        add(&mut self.forces, &step.forces);
        add(&mut self.projections, &step.changes);
    }

    /// Adds the way that was gone to the field u₀.
    fn add_to(&self, field: &mut [f64]) -> Result<(), LinearError> {
        let by_forces = self.known.solve(self.faces.load(&self.forces))?;
        let ways = self.direction.iter().zip(&by_forces);
        field.iter_mut().zip(ways).for_each(|(u, (way, other))| *u += self.part * way + other);
        Ok(())
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
