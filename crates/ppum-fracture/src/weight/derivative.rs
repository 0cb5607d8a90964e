//! The change of a factor with a parameter of formulas, without a second solution.
//!
//! If the loads change by δt, … and the law by δC, K changes by
//!
//! ```text
//! δK = K(δt, …) − ∫ ε(u) : (δC − ρ C) : ε(w) dA
//! ```
//!
//! since δC ε(u) acts like a given stress: with the solution u and the weight function w. At the
//! tip δC must be a multiple ρ of C: another change of the tip's own material changes the auxiliary
//! fields, too. The law may change where tractions alone load the body: then ρ C changes no K.

use super::error::WeightError;
use super::factor::{check_body, factor_of, tip_of, weight_field};
use crate::solve::SolveError;
use ppum::dataset::{Dataset, Elasticity, Equation};
use ppum::expression::Expression;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::vec2::Vec2;
use ppum_problem::{Condition, Feature, Problem};
use ppum_solve::assembly::WorkOnField;
use ppum_solve::law::Law;
use ppum_solve::space::TrialSpace;

/// Difference of materials at the tip that is rounding.
const SAME: f64 = 1e-12;

/// The derivative of a factor by a parameter, from the problems with two values of it, which are
/// so far apart, and the solution with the value between them.
///
/// # Errors
/// See [`WeightError`]; other changes than those of loads and of the law beyond the tip.
pub fn derivative(
    (weights, step): (&Dataset, usize),
    solution: (&Dataset, usize),
    problems: [&Problem; 2],
    between: f64,
    watcher: &dyn Watcher,
) -> Result<f64, WeightError> {
    let field = weight_field(weights, step)?;
    let u = Field::new(solution.0, solution.1).map_err(SolveError::from)?;
    problems.iter().try_for_each(|problem| check_body(weights, step, problem, false))?;
    let [first, last] = problems.map(|problem| factor_of(weights, step, problem, watcher));
    let laws = problems.map(|problem| &problem.equation);
    let ratio = ratio_at_tip(laws, place_of_tip(&field)?)?;
    let is_other = laws[0].elastic().map(constants) != laws[1].elastic().map(constants);
    if is_other && !problems.iter().all(|problem| has_tractions_alone(problem)) {
        return Err(WeightError::MaterialUnderStrains);
    }
    let space = TrialSpace::of_problem(problems[1], field.step.clone(), None);
    let (space, [before, after]) = (space.map_err(SolveError::from)?, laws.map(Law::new));
    let work = WorkOnField { field: &field, space: &space, law: &after };
    let of_law = if is_other { work.of_change(&u, &before, ratio) } else { 0.0 };
    Ok((last? - first? - of_law) / between)
}

fn constants(body: &Elasticity) -> [&Expression; 2] {
    [&body.young, &body.poisson]
}

/// The place of the tip of a weight function.
fn place_of_tip(field: &Field<'_>) -> Result<Vec2, WeightError> {
    let tip = tip_of(field)?;
    Ok(field.step.cracks[tip.crack as usize].end_point(tip.end))
}

/// True if tractions, body forces and forces alone load a body.
fn has_tractions_alone(problem: &Problem) -> bool {
    let is_given = |component: &Condition| match component {
        Condition::Dirichlet(given) => given.constant() != Some(0.0),
        _ => false,
    };
    let mut components = problem.boundary.iter().flat_map(|condition| &condition.components);
    !components.any(is_given) && !problem.features().contains(&Feature::GivenStrains)
}

/// ρ of δC = ρ C at the tip.
fn ratio_at_tip(laws: [&Equation; 2], tip: Vec2) -> Result<f64, WeightError> {
    let [Some(first), Some(last)] = laws.map(|law| law.elastic().map(|body| body.at(tip))) else {
        return Err(WeightError::NotElastic);
    };
    if (last.poisson - first.poisson).abs() > SAME {
        return Err(WeightError::MaterialAtTip);
    }
    Ok(2.0 * (last.young - first.young) / (last.young + first.young))
}
