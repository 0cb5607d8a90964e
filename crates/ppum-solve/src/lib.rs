//! Solves two-dimensional problems of elasticity and Poisson's equation with cracks by the
//! particle-partition of unity method.
//!
//! A [`Problem`](problem::Problem), from a file or built in code, is solved by [`solve()`](solve::solve);
//! the result is a [`Dataset`](ppum::dataset::Dataset). Results do not depend on the number of threads.
//!
//! ```
//! use std::path::Path;
//!
//! use ppum::progress::unwatched;
//! use ppum_solve::problem::Problem;
//! use ppum_solve::solve::solve;
//!
//! let text = r#"
//!     [domain]
//!     min = [-1.0, -1.0]
//!     max = [1.0, 1.0]
//!     [material]
//!     young = 1.0
//!     poisson = 0.3
//!     state = "plane-strain"
//!     [[crack]]
//!     points = [[-0.5, 0.0], [0.5, 0.0]]
//!     [[boundary]]
//!     on = "bottom"
//!     traction = [0.0, -1.0]
//!     [[boundary]]
//!     on = "top"
//!     traction = [0.0, 1.0]
//!     [discretization]
//!     level = 4
//! "#;
//! let problem = Problem::parse(text, "plate.toml", Path::new("."))?;
//! let dataset = solve(&problem, unwatched())?;
//! // K_I / (σ √(πa)) of a square plate with a/W = 1/2 is 1.333712
//! let factor = dataset.steps[0].intensities[0].k1 / (0.5 * std::f64::consts::PI).sqrt();
//! assert!((factor / 1.333712 - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assembly;
mod basis;
mod corner;
pub mod diagnostics;
mod equilibrium;
mod geometry;
pub mod intensity;
mod law;
mod linear;
pub mod norms;
pub mod problem;
mod quadrature;
mod refine;
pub mod report;
mod smoothness;
pub mod solve;
pub mod space;
mod watched;
