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
//! | module | what is in it |
//! |---|---|
//! | `data` | the problem: [`Body`], [`BoundaryCondition`], forces, discretisation, steps; what follows from them, such as symmetries and the points of drawings |
//! | [`geometry`] | edges, boxes, curves and cracks of bodies, whoever asks |
//! | `file` | the text: [`keys`], its values with their places, the tables and points that it names |
//! | `read` | from the text to the data, a table of the file a module |
//! | `check` | rules that the data must obey, whether read or built in code |
//!
//! A boundary condition is its rows in `file/keys.rs`, what `read/boundary.rs` makes of them, and
//! the values that `data/boundary.rs` gives to rules, loads and drawings alike.
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

mod check;
mod data;
mod file;
pub mod geometry;
mod read;
#[cfg(test)]
mod tests;

pub use check::features::Feature;
pub use data::*;
pub use file::{MAX_LENGTH, keys, read_table};
pub use geometry::{crack, cracks};
pub use ppum::expression::Expression;

/// A problem file with comments, to begin with: a plate with a slanted crack.
pub const TEMPLATE: &str = include_str!("template.toml");
