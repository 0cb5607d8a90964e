//! The problem as data: body, loads, discretisation, and what follows from them.

mod adaptivity;
mod axis;
mod body;
mod boundary;
mod discretization;
mod enrichment;
mod error;
pub(crate) mod expression;
mod force;
mod growth;
mod growth_law;
mod model;
pub mod quantities;
mod refinement;
mod restraint;
pub(crate) mod scopes;
mod series;
mod solver;
mod stations;
mod stiffness;
mod support;
mod symmetry;
mod temperature;
mod words;

pub use adaptivity::{AdaptKind, Adaptivity, StepsKept};
pub(crate) use body::HeatedBody;
pub use body::{Body, BodyText, ConditionPlace};
pub(crate) use boundary::OUTLINE;
pub use boundary::{
    BoundaryCondition, BoundaryPart, BoundaryPiece, BoundaryRange, Condition, DomainEdge,
    held_directions, in_plane,
};
pub(crate) use discretization::MAX_LEVEL;
pub use discretization::{
    BaseCells, Discretization, Enrichment, MOST_TERMS, OrderError, PolynomialOrder,
};
pub use enrichment::{EnrichmentRegion, LocalEnrichment, Site};
pub use error::{Diagnostic, ProblemError, ProblemLocation};
pub use force::ForcePlace;
pub(crate) use force::is_outside;
pub use growth::{Criterion, GrowthRule, LoadControl};
pub use growth_law::{
    Closure, GrowthLaw, LoadBlock, NAMED_LAWS, NamedLaw, RATE_INPUTS, TipState, Wheeler, WrongRate,
};
pub use model::{Problem, ProblemData, SolvedTemperature};
pub use refinement::{DEEPEST, LocalRefinement, RefinementRegion, nine};
pub use restraint::{restraint_center, restraint_words};
pub use solver::{SolverKind, SolverSettings};
pub use stations::BoundaryStation;
pub(crate) use stiffness::default_order;
pub use stiffness::{FREE_OF_LOCKING, STIFF, stiffness_ratio};
pub use support::{Force, Support};
pub use symmetry::Symmetry;
pub(crate) use words::{EquationKind, Keyword, word_table, words};
