//! Factors of loads by a weight function.

use super::error::{FIELDS, WeightError, material};
use crate::intensity::WEIGHT;
use crate::solve::{SolveError, solve};
use ppum::crack::{Crack, End, TipId};
use ppum::dataset::{Dataset, Step};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::progress::{Phase, Watcher};
use ppum::vec2::Vec2;
use ppum_problem::{BoundaryCondition, BoundaryPart, Problem};
use ppum_solve::assembly::{Influence, PrescribedData, WorkOnField};
use ppum_solve::equilibrium::{BodyEquilibrium, BodyPieces};
use ppum_solve::law::{Law, Temperature};
use ppum_solve::report::SolverReport;
use ppum_solve::space::TrialSpace;
use ppum_solve::watched::WorkPhase;
use std::f64::consts::PI;

/// The factor that the loads of a problem cause at the tip and in the mode of a weight function, a
/// step of a dataset of them. The problem is on the same body, held in the same way.
///
/// # Errors
/// See [`WeightError`]; loads of a body that nothing holds which do not balance.
pub fn factor(
    weights: &Dataset,
    step: usize,
    problem: &Problem,
    watcher: &dyn Watcher,
) -> Result<f64, WeightError> {
    check_body(weights, step, problem, true)?;
    factor_of(weights, step, problem, watcher)
}

/// The factor, whatever the material of the problem is.
pub(super) fn factor_of(
    weights: &Dataset,
    step: usize,
    problem: &Problem,
    watcher: &dyn Watcher,
) -> Result<f64, WeightError> {
    let field = weight_field(weights, step)?;
    let heat = temperature(problem, watcher)?;
    let law = Law::new(&problem.equation).heated(heat.as_ref().map(|(heat, _)| heat));
    let of_heat = heat.as_ref().map(|(_, step)| step);
    let space = TrialSpace::of_problem(problem, field.step.clone(), of_heat);
    let space = space.map_err(SolveError::from)?;
    let n = space.partition().len();
    let stage = WorkPhase::new(watcher, Phase::Intensity, n).map_err(SolveError::from)?;
    let given = PrescribedData::new(problem, &space, &stage).map_err(SolveError::of_data)?;
    let pieces = BodyPieces::new(problem.domain(), problem.cracks());
    let balances = given.balance(&space, &pieces, &stage).map_err(SolveError::of_data)?;
    BodyEquilibrium::new(pieces, balances, problem).map_err(SolveError::from)?;
    let work = WorkOnField { field: &field, space: &space, law: &law };
    Ok(work.of(problem, &given, &stage).map_err(SolveError::of_data)?)
}

/// The influence of tractions on a part of the boundary of a problem's body, or that of forces and
/// strains inside.
///
/// # Errors
/// See [`WeightError`].
pub fn influence(
    weights: &Dataset,
    step: usize,
    problem: &Problem,
    on: Option<BoundaryPart>,
) -> Result<Influence, WeightError> {
    let field = weight_field(weights, step)?;
    check_body(weights, step, problem, true)?;
    let law = Law::new(&problem.equation);
    let space = TrialSpace::of_problem(problem, field.step.clone(), None);
    let space = space.map_err(SolveError::from)?;
    let work = WorkOnField { field: &field, space: &space, law: &law };
    Ok(on.map_or_else(|| work.influence_inside(), |on| work.influence_on(problem, on)))
}

/// The influence coefficients G_j of pressures ξ^j, j < `count`, on both faces of the crack of a
/// weight function: K = √(πa) Σ σ_j G_j of the stress Σ σ_j ξ^j. ξ goes along a crack of the length
/// a from its other end, where it begins with 0, to 1 at the tip, and from −1 to 1 along one of two
/// tips, whose length is 2a.
///
/// # Errors
/// See [`WeightError`].
pub fn polynomials(weights: &Dataset, step: usize, count: usize) -> Result<Vec<f64>, WeightError> {
    let tip = tip_of(&weight_field(weights, step)?)?;
    let problem = problem_of(weights, step)?;
    let crack = &weights.steps[step].cracks[tip.crack as usize];
    let on = BoundaryPart::Crack { crack: tip.crack as usize, face: None };
    let influence = influence(weights, step, &problem, Some(on))?;
    let (length, has_two) = (crack.length(), crack.tips().count() == 2);
    let a = if has_two { 0.5 * length } else { length };
    let mut sums = vec![0.0; count];
    let ways = lengths(weights, step, &influence.at)?;
    for ((way, normal), force) in ways.iter().zip(&influence.normals).zip(&influence.forces) {
        let way = if tip.end == End::Last { *way } else { length - way };
        let xi = if has_two { way / a - 1.0 } else { way / a };
        let work = -normal.dot((*force).into()) / (PI * a).sqrt();
        sums.iter_mut().zip(0..).for_each(|(sum, j)| *sum += work * xi.powi(j));
    }
    Ok(sums)
}

/// The lengths of the crack of a weight function from its start to the places nearest to points.
///
/// # Errors
/// See [`WeightError`].
pub fn lengths(weights: &Dataset, step: usize, at: &[Vec2]) -> Result<Vec<f64>, WeightError> {
    let field = weight_field(weights, step)?;
    let crack = &field.step.cracks[tip_of(&field)?.crack as usize];
    Ok(at.iter().map(|x| along(crack, *x)).collect())
}

/// The length of a crack from its start to the place nearest to a point.
fn along(crack: &Crack, x: Vec2) -> f64 {
    let (mut before, mut best) = (0.0, (f64::INFINITY, 0.0));
    for edge in crack.edges() {
        let distance = edge.distance(x);
        if distance < best.0 {
            best = (distance, before + edge.length() * edge.closest_part(x));
        }
        before += edge.length();
    }
    best.1
}

/// The change ∂u/∂a of the displacement with the length of a crack that grows straight on at a
/// tip, from the steps of its weight functions and the factors there: a dataset of one step.
///
/// # Errors
/// See [`WeightError`].
pub fn rate(weights: &Dataset, parts: &[(usize, f64)]) -> Result<Dataset, WeightError> {
    let (mut dataset, mut sum) = (weights.clone(), None::<Step>);
    for &(number, k) in parts {
        let field = weight_field(weights, number)?;
        let mut part = field.step.clone();
        let factor = 2.0 * k / modulus_at_tip(weights, &field)?;
        let old = sum.as_ref().map(|sum| &sum.fields[0].coefficients);
        for (i, row) in part.fields[0].coefficients.iter_mut().enumerate() {
            for (k, coefficient) in row.iter_mut().enumerate() {
                *coefficient = factor * *coefficient + old.map_or(0.0, |old| old[i][k]);
            }
        }
        part.fields[0].name = format!("{WEIGHT}rate");
        sum = Some(part);
    }
    dataset.steps = sum.into_iter().collect();
    Ok(dataset)
}

/// E′ at the tip of a weight function.
fn modulus_at_tip(weights: &Dataset, field: &Field<'_>) -> Result<f64, WeightError> {
    let elastic = weights.equation.elastic().ok_or(WeightError::NotElastic)?;
    let tip = tip_of(field)?;
    Ok(elastic.at(field.step.cracks[tip.crack as usize].end_point(tip.end)).effective_young())
}

/// The tip of a weight function, whose singular functions are the last ones of its step.
pub fn tip_of(field: &Field<'_>) -> Result<TipId, WeightError> {
    match field.step.functions.last().map(|function| &function.kind) {
        Some(FunctionKind::Formula { frame: Frame::Tip(tip), .. }) => Ok(*tip),
        _ => Err(WeightError::NoWeight(field.data.name.clone())),
    }
}

/// The problem of the body of a weight function.
fn problem_of(weights: &Dataset, step: usize) -> Result<Problem, WeightError> {
    Problem::of_step(weights, step)?.ok_or(WeightError::NoProblem)
}

/// The mode of the weight function of a step, 0 or 1.
///
/// # Errors
/// See [`WeightError`].
pub fn mode(weights: &Dataset, step: usize) -> Result<usize, WeightError> {
    let field = weight_field(weights, step)?;
    Ok(usize::from(field.data.name.starts_with(FIELDS[1])))
}

/// The weight function of a step.
pub(super) fn weight_field(weights: &Dataset, step: usize) -> Result<Field<'_>, WeightError> {
    let field = Field::new(weights, step).map_err(SolveError::from)?;
    let is_weight = FIELDS.iter().any(|name| field.data.name.starts_with(name));
    if !is_weight || field.data.coefficients.len() != 2 {
        return Err(WeightError::NoWeight(field.data.name.clone()));
    }
    Ok(field)
}

/// True if a condition gives no tractions.
fn is_restraint(condition: &BoundaryCondition) -> bool {
    condition.held().contains(&true)
}

/// # Errors
/// Another body, restraints or, if that counts, material than those of the weight function.
pub(super) fn check_body(
    weights: &Dataset,
    step: usize,
    problem: &Problem,
    with_material: bool,
) -> Result<(), WeightError> {
    let own = problem_of(weights, step)?;
    let restraints = |of: &Problem| {
        let all = of.boundary.iter().filter(|condition| is_restraint(condition));
        all.map(|c| (c.on, c.held(), c.axis, c.exchange.clone())).collect::<Vec<_>>()
    };
    let differs = match () {
        () if own.domain() != problem.domain() => "domain is not",
        () if weights.steps[step].cracks != problem.cracks() => "cracks are not",
        () if with_material && material(&own) != material(problem) => "material is not",
        () if restraints(&own) != restraints(problem) => "restraints are not",
        () => return Ok(()),
    };
    Err(WeightError::OtherBody(differs))
}

/// The temperature that strains the body of a problem, solved for, and its step.
fn temperature(
    problem: &Problem,
    watcher: &dyn Watcher,
) -> Result<Option<(Temperature, Step)>, WeightError> {
    let Some(heat) = problem.heat() else { return Ok(None) };
    let heat = solve(heat, watcher).map_err(SolveError::of_heat)?;
    let (equation, step) = (problem.dataset_equation().into_owned(), heat.steps[0].clone());
    let temperature = Temperature::new(heat, equation, SolverReport::default());
    Ok(Some((temperature.map_err(SolveError::from)?, step)))
}
