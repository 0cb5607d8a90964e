//! Arcs that are bent until the crack at their ends is loaded symmetrically: K_II = 0.
//!
//! Turning the end of an arc by δ changes K_II there by ½ δ K_I to first order (Cotterell & Rice
//! 1980), and so the angle θ ≈ −2 K_II / K_I that the criterion asks for by −δ: the curvature
//! changes by θ over the length of the arc.
//!
//! By the other criteria arcs stay as they are, and a path that kinks again behind its first kink
//! is told.

use super::criterion::kink;
use super::decision::{SHARP, grow_cracks, with_curvatures};
use super::step::{GrowthSeries, PreviousStep};
use crate::solve::{Plan, SolveError};
use ppum::crack::{Crack, TipId};
use ppum::dataset::{Dataset, Growth, TipIncrement, TipIntensity, TipStatus, Warning, WarningKind};
use ppum::progress::Watcher;
use ppum::text::trimmed;
use ppum_problem::Criterion;

/// Angle of the criterion at the end of an arc, in radians, that counts as none: K_II is 5e-5 of
/// K_I then. The remaining error has one sign along a path, and paths would drift by half of it.
const SYMMETRIC: f64 = 1e-4;

/// Most times that arcs are bent. The first leaves about a tenth of the angle, and each after it
/// the product of the two before; tips that shade each other need some more.
const ROUNDS: usize = 8;

/// The solution of a step, and its cracks, whose last arcs are bent if the criterion asks for it.
pub(super) fn solve_step(
    plan: Plan<'_>,
    before: Option<&PreviousStep>,
    series: &GrowthSeries<'_>,
    watcher: &dyn Watcher,
) -> Result<(Vec<Crack>, Dataset), SolveError> {
    let cracks = plan.problem.cracks().to_vec();
    let Some(PreviousStep { problem: base, growth }) = before else {
        return Ok((cracks, plan.solve(watcher)?));
    };
    let is_isotropic = plan.problem.equation.anisotropy().is_none() && !series.rule.is_directed();
    if !is_isotropic {
        // their paths have kinks where the weakest direction changes
        return Ok((cracks, plan.solve(watcher)?));
    }
    if series.rule.criterion != Criterion::LocalSymmetry {
        return Ok((cracks, with_warnings(plan.solve(watcher)?, growth, SHARP)));
    }
    let (mut growth, mut problem) = (growth.clone(), plan.problem.clone());
    let mut tried = plan.attempt(watcher, &|factors| is_settled(&growth, factors))?;
    let mut known = Vec::new();
    for round in 1.. {
        let factors = match tried {
            Ok(dataset) => {
                return Ok((problem.cracks().to_vec(), with_warnings(dataset, &growth, SYMMETRIC)));
            }
            Err(factors) => factors,
        };
        let found: Vec<_> = angles(&growth, &factors).map(CurvatureTrial::new).collect();
        let curvatures: Vec<_> = found.iter().map(|bend| (bend.tip, bend.next(&known))).collect();
        known = found;
        let next = with_curvatures(base, &growth, &curvatures);
        let bent = grow_cracks(base, &next).ok();
        let Some(plan) = bent.as_ref().and_then(|bent| series.plan(bent, watcher).ok()) else {
            // what it led to cannot be solved: the arcs stay as they were
            let dataset = Plan::new(&problem, series.memory, watcher)?.solve(watcher)?;
            return Ok((problem.cracks().to_vec(), with_warnings(dataset, &growth, SYMMETRIC)));
        };
        // arcs that turn as much as they may do not change any more
        let is_last = round == ROUNDS || next == growth;
        growth = next;
        tried = plan.attempt(watcher, &|factors| is_last || is_settled(&growth, factors))?;
        problem = bent.unwrap_or(problem);
    }
    unreachable!("the last round takes what it finds")
}

/// A step with a warning for each arc behind which the path would turn by more than a limit.
fn with_warnings(mut dataset: Dataset, growth: &Growth, limit: f64) -> Dataset {
    let step = &mut dataset.steps[0];
    let left = angles(growth, &step.intensities).filter(|(_, angle)| angle.abs() > limit);
    let told = |(row, _): (&TipIncrement, f64)| unsettled(row, &step.intensities, limit);
    let left: Vec<_> = left.filter_map(told).collect();
    step.warnings.extend(left);
    dataset
}

fn unsettled(row: &TipIncrement, factors: &[TipIntensity], limit: f64) -> Option<Warning> {
    let (factors, &at) = (factors.iter().find(|found| found.tip == row.tip)?, row.path.last()?);
    let ratio = (factors.k2 / factors.k1).abs();
    let problem = if limit == SYMMETRIC {
        "the last arc could not be bent until K_II = 0 at its tip"
    } else {
        "the increments do not resolve the path, which should not kink again at its tip"
    };
    let message = format!(
        "{problem} ({}, {}): K_II is {ratio:.1e} of K_I; with smaller increments paths turn less in each",
        trimmed(at.x),
        trimmed(at.y),
    );
    Some(Warning::new(WarningKind::Growth, Some(at), [ratio, 0.5 * limit], message))
}

/// A curvature and the angle that was found with it.
struct CurvatureTrial {
    tip: TipId,
    curvature: f64,
    angle: f64,
    length: f64,
}

impl CurvatureTrial {
    fn new((row, angle): (&TipIncrement, f64)) -> Self {
        Self { tip: row.tip, curvature: row.curvature, angle, length: row.length }
    }

    /// The curvature at which the angle vanishes, on the line through this and what was found
    /// before, or else by what theory says of its slope.
    fn next(&self, known: &[Self]) -> f64 {
        let before = known.iter().find(|bend| bend.tip == self.tip);
        let measured = before.map(|b| (self.angle - b.angle) / (self.curvature - b.curvature));
        let expected = -self.length;
        let is_like = |slope: &f64| (0.25..4.0).contains(&(slope / expected));
        self.curvature - self.angle / measured.filter(is_like).unwrap_or(expected)
    }
}

fn is_settled(growth: &Growth, factors: &[TipIntensity]) -> bool {
    angles(growth, factors).all(|(_, angle)| angle.abs() <= SYMMETRIC)
}

/// Returns the angles that the criterion demands at the ends of the arcs that are tips.
fn angles<'a>(
    growth: &'a Growth,
    factors: &'a [TipIntensity],
) -> impl Iterator<Item = (&'a TipIncrement, f64)> {
    let free = growth.tips.iter().filter(|row| row.fate == TipStatus::Grows);
    free.filter_map(|row| {
        let found = factors.iter().find(|found| found.tip == row.tip)?;
        Some((row, kink(Criterion::LocalSymmetry, found)?.angle))
    })
}
