//! The reasons why there is no weight function, and the names and the material of those there are.

use crate::solve::SolveError;
use ppum::dataset::{Elasticity, Equation};
use ppum::vec2::Vec2;
use ppum_problem::Problem;
use ppum_solve::assembly::FACTORS;

/// Names of the fields of weight functions of both modes.
pub const FIELDS: [&str; FACTORS] = ["weight-I", "weight-II"];

/// The reason why there is no weight function, or no factor by one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WeightError {
    /// A Poisson problem.
    #[error("only elastic bodies have weight functions")]
    NotElastic,
    /// An anisotropic body, or one of revolution.
    #[error("weight functions are known of isotropic bodies in plane strain or plane stress alone")]
    OtherLaw,
    /// Faces that may touch.
    #[error(
        "faces that may touch make K no linear function of the loads, so that there is no weight function; leave \
         `contact` out"
    )]
    Contact,
    /// No such tip.
    #[error("there is no tip {number}; the body has {count} (numbered from 0)")]
    NoTip {
        /// The number of the tip that was asked for.
        number: usize,
        /// Number of tips.
        count: usize,
    },
    /// No functions of the tip in the space, or no jumps.
    #[error(
        "weight functions need the singular functions of tips, and jumps across cracks; write `enrichment = \"williams\"`"
    )]
    NoTipFunctions,
    /// The disc of a tip is too small.
    #[error(
        "tip {number}: the circle around it in which the crack is straight, or one arc, and nothing else lies is \
         smaller than the cells resolve; use smaller cells there, by [[refine]] or a higher level"
    )]
    NoRoom {
        /// The number of the tip.
        number: usize,
    },
    /// The dataset holds no weight function.
    #[error("the step holds no weight function, but the field `{0}`; `ppum weight` makes them")]
    NoWeight(String),
    /// The dataset does not hold the problem of its body.
    #[error(
        "the dataset holds no problem, so that nothing is known of its body's boundary; `ppum weight` makes one that does"
    )]
    NoProblem,
    /// Loads on another body.
    #[error("the loads are those of another problem: its {0} those of the weight function")]
    OtherBody(&'static str),
    /// Another material at the tip.
    #[error(
        "the parameter changes the material at the tip, and with it the singular field; take the difference of two \
         solutions"
    )]
    MaterialAtTip,
    /// Another material of a body with given displacements or strains.
    #[error(
        "the parameter changes the material of a body with given displacements or strains, whose stresses follow it; \
         take the difference of two solutions"
    )]
    MaterialUnderStrains,
    /// The loads of a problem that cannot be read.
    #[error(transparent)]
    Problem(#[from] ppum_problem::ProblemError),
    /// The system cannot be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// The equation of an elastic body without given strains.
pub(super) fn material(problem: &Problem) -> Option<Equation> {
    let elastic = problem.equation.elastic()?;
    let (young, poisson) = (elastic.young.clone(), elastic.poisson.clone());
    Some(Equation::Elasticity(Elasticity { young, poisson, ..elastic.at(Vec2::ZERO).into() }))
}
