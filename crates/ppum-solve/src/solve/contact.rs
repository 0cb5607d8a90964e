//! Faces that touch: the states of their points by a semi-smooth Newton method.
//!
//! The system with the states that a field implies is the tangent there. Its solution is the next
//! field, or where the functional of [`FaceContacts`] is least on the way to it. That is convex and
//! quadratic piece by piece, so that without friction the states settle after finitely many steps,
//! from any start; it is the end as well if two fields differ by rounding alone. With friction this
//! is done with known bounds μ p, and then again with those of the field that was found, until that
//! stays: a fixed point by contraction, unless μ is large. All systems are symmetric.
//!
//! Pieces that only faces hold are loose in systems in which too few of these touch. So a soft
//! spring keeps them where the last field has them (Rockafellar's proximal point method, 1976),
//! which does nothing at the end.

use super::SolveError;
use crate::assembly::{FaceContacts, FaceState, FaceStress, Gauge, System};
use crate::watched::Stage;
use ppum_linear::{BlockMatrix, Cholesky, LinearError, LinearSolver as _};

/// Most factors that are made, and most fields that are looked at, before the states must have
/// settled.
const MOST_FACTORS: usize = 120;
const MOST_FIELDS: usize = 300;

/// Energy of the way to the next field, in parts of that of the field, up to which it is the same:
/// what is left of the field is the root.
const SMALL: f64 = 1e-14;

/// Halvings of the way to the next field.
const HALVINGS: usize = 40;

/// Slope of the functional at the next field, in parts of that at the last, that is none.
const FLAT: f64 = 1e-8;

/// Adds the terms of faces that touch to the system, which has its gauge, and returns the number of
/// factors that this took; zero where no faces overlap without, and the system stays as it is.
///
/// # Errors
/// A system that cannot be solved, states that do not settle; cancelled.
pub(super) fn close(
    contacts: &FaceContacts,
    gauge: &Gauge,
    System { matrix, load, .. }: &mut System,
    located: &dyn Fn(LinearError) -> SolveError,
    stage: &Stage<'_>,
) -> Result<usize, SolveError> {
    let factor = |matrix: BlockMatrix| {
        stage.advance(0)?;
        Cholesky::owned(matrix).map_err(located)
    };
    let spring = gauge.spring(matrix);
    if spring.is_empty() {
        let open = factor(matrix.clone())?.solve(load).map_err(located)?.unknowns;
        if contacts.is_open(&contacts.stresses(matrix, &open)) {
            return Ok(0);
        }
    }
    let system = |states: &[FaceState], matrix: &BlockMatrix, load: &[f64], field: &[f64]| {
        let (mut tangent, mut loads) = contacts.system(states, matrix, load);
        spring.add_to(&mut tangent);
        spring.add_load(matrix, field, &mut loads);
        (tangent, loads)
    };
    // faces that hold together have pressures of the size that they will have
    let mut states = contacts.tied();
    let (tangent, loads) = system(&states, matrix, load, &vec![0.0; load.len()]);
    let mut solver = factor(tangent)?;
    let mut field = solver.solve(&loads).map_err(located)?.unknowns;
    let mut intervals = contacts.intervals(&contacts.stresses(matrix, &field));
    let (mut factors, mut is_renewed) = (1, false);
    for _ in 0..MOST_FIELDS {
        let stresses = contacts.stresses(matrix, &field);
        let before = std::mem::replace(&mut states, FaceContacts::states(&stresses, &intervals));
        let (tangent, loads) = system(&states, matrix, load, &field);
        let is_known = before.iter().zip(&states).all(|(a, b)| a.is_tied() == b.is_tied());
        if !is_known && factors == MOST_FACTORS {
            break;
        }
        if !is_known {
            solver = factor(tangent.clone())?;
            factors += 1;
        }
        let next = solver.solve(&loads).map_err(located)?.unknowns;
        let way: Vec<f64> = next.iter().zip(&field).map(|(next, u)| next - u).collect();
        let line = DescentLine::new(contacts, (matrix, load), [&field, &way], &intervals);
        if line.is_short() {
            let renewed = contacts.intervals(&stresses);
            if is_renewed || renewed == intervals {
                (*matrix, *load) = contacts.system(&states, matrix, load);
                return Ok(factors);
            }
            (intervals, is_renewed) = (renewed, true);
            continue;
        }
        is_renewed = false;
        let part = line.part();
        field.iter_mut().zip(&way).for_each(|(u, d)| *u += part * d);
    }
    Err(SolveError::Contact { factors })
}

/// The functional along the way from a field to the next.
struct DescentLine<'a> {
    contacts: &'a FaceContacts,
    intervals: &'a [[f64; 2]],
    /// The stresses of the field, and of the way.
    stresses: [Vec<FaceStress>; 2],
    /// The slope without faces that touch, and its slope.
    slopes: [f64; 2],
    /// Twice the energy of the field without faces that touch.
    energy: f64,
}

impl<'a> DescentLine<'a> {
    fn new(
        contacts: &'a FaceContacts,
        (matrix, load): (&BlockMatrix, &[f64]),
        [field, way]: [&[f64]; 2],
        intervals: &'a [[f64; 2]],
    ) -> Self {
        let zero = contacts.stresses(matrix, &vec![0.0; way.len()]);
        let [at, along] = [field, way].map(|u| contacts.stresses(matrix, u));
        let along = along.iter().zip(&zero).map(|(at, zero)| at.less(*zero)).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let [of_field, of_way] = [field, way].map(|u| matrix.multiply(u));
        let slopes = [dot(&of_field, way) - dot(load, way), dot(&of_way, way)];
        let energy = dot(&of_field, field);
        Self { contacts, intervals, stresses: [at, along], slopes, energy }
    }

    /// The slope at a part of the way: at first minus twice the energy of the way.
    fn slope(&self, t: f64) -> f64 {
        let [at, along] = &self.stresses;
        let [start, bend] = self.slopes;
        start + t * bend + self.contacts.slope(self.intervals, [at, along], t)
    }

    /// True if the fields differ by nothing.
    fn is_short(&self) -> bool {
        self.slope(0.0).abs() <= SMALL * self.energy
    }

    /// The part of the way at which the functional is least; all of it if it still falls there.
    fn part(&self) -> f64 {
        if self.slope(1.0) <= FLAT * self.slope(0.0).abs() {
            return 1.0;
        }
        let halve = |[low, high]: [f64; 2], _| {
            let middle = 0.5 * (low + high);
            if self.slope(middle) < 0.0 { [middle, high] } else { [low, middle] }
        };
        (0..HALVINGS).fold([0.0, 1.0], halve)[1]
    }
}
