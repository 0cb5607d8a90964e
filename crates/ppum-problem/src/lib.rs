//! Problems: what is to be solved, and how, from a problem file (TOML) or built in code.
//!
//! Find u on the box minus holes Ω with cracks Γ, faces and rims free unless loaded, such that
//!
//! ```text
//! elasticity:  −div σ(u) = f,  σ = 2μ ε(u) + λ tr ε(u) I        Poisson:  −div (κ ∇u) = f
//! ```
//!
//! with components of u (Dirichlet) or of the traction σ n, the flux κ ∂u/∂n (Neumann), given on
//! parts of the boundary. `docs/problem-file.md` describes the file for users.
//!
//! [`ProblemData`] are plain data, a [`Problem`] such as break no rule. Reading reports everything
//! that is wrong at once, with places; for data from code [`Problem::new`] applies the same rules:
//!
//! ```
//! use ppum::dataset::{Material, StressState};
//! use ppum::vec2::{Rect, vec2};
//! use ppum_problem::{BaseCells, Condition, Discretization, DomainEdge, Problem, ProblemData};
//!
//! let steel = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let pull = |t: f64| vec![Condition::Neumann(0.0.into()), Condition::Neumann(t.into())];
//! let plate = ProblemData::elasticity(domain, steel, Discretization::new(BaseCells::Level(4)))
//!     .with_crack(&[[-0.5, 0.0], [0.5, 0.0]])
//!     .with_boundary(DomainEdge::Bottom, pull(-1.0))
//!     .with_boundary(DomainEdge::Top, pull(1.0));
//! assert!(Problem::new(plate).is_ok());
//! ```

mod adaptivity;
mod body;
mod boundary;
mod check;
mod contacts;
mod cracks;
mod csv;
mod curve;
mod discretization;
mod document;
mod enrichment;
mod error;
mod expression;
mod force;
pub mod geometry;
mod growth;
mod holes;
mod key;
mod key_kinds;
pub mod keys;
mod model;
mod nearby;
mod points;
pub mod quantities;
mod read;
mod refinement;
mod report;
mod restraint;
mod scopes;
mod series;
mod solver;
mod stations;
mod stiffness;
mod straight;
mod support;
mod symmetry;
mod table_file;
mod temperature;
#[cfg(test)]
mod tests;
mod words;

pub use adaptivity::{AdaptKind, Adaptivity, StepsKept};
pub use body::Body;
pub use boundary::{
    BoundaryCondition, BoundaryPart, BoundaryPiece, BoundaryRange, Condition, DomainEdge,
    held_directions, in_plane,
};
pub use check::features::Feature;
pub use cracks::{crack, cracks};
pub use curve::arc_from;
pub use discretization::{
    BaseCells, Discretization, Enrichment, MOST_TERMS, OrderError, PolynomialOrder,
};
pub use document::MAX_LENGTH;
pub use enrichment::{EnrichmentRegion, LocalEnrichment, Site};
pub use error::{Diagnostic, ProblemError, ProblemLocation};
pub use force::ForcePlace;
pub use growth::{Criterion, GrowthRule, LoadControl, Paris};
pub use model::{Problem, ProblemData, SolvedTemperature};
pub use ppum::expression::Expression;
pub use refinement::{DEEPEST, LocalRefinement, RefinementRegion, nine};
pub use restraint::{restraint_center, restraint_words};
pub use solver::{SolverKind, SolverSettings};
pub use stations::BoundaryStation;
pub use stiffness::{FREE_OF_LOCKING, STIFF, stiffness_ratio};
pub use support::{Force, Support};
pub use symmetry::Symmetry;
pub use table_file::read_table;
