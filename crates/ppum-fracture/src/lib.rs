//! Solves two-dimensional problems of elasticity and Poisson's equation with cracks by the
//! particle-partition of unity method.
//!
//! A [`Problem`](ppum_problem::Problem), from a file or built in code, is solved by
//! [`solve()`](solve::solve); the result is a [`Dataset`](ppum::dataset::Dataset) with the field,
//! its stress intensity factors, the [report](ppum_solve::report::SolverReport) of the solver
//! and [warnings](diagnostics).
//!
//! ```
//! use std::path::Path;
//!
//! use ppum::progress::unwatched;
//! use ppum_fracture::solve::solve;
//! use ppum_problem::Problem;
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
//!
//! # Tour
//!
//! - [`ppum_problem`]: what is to be solved, read from TOML or built in code, every error at its
//!   place.
//! - [`solve`]: [`Plan`](solve::Plan) tells what a solution takes before it is made;
//!   [`solve()`](solve::solve) does both; [`spectrum`](solve::spectrum) measures the condition of a
//!   discretisation.
//! - [`weight`]: weight functions, which give the stress intensity factors of any load.
//! - [`intensity`]: stress intensity factors of any field. [`diagnostics`]: they and all warnings
//!   once more, from a dataset.
//! - [`ppum_solve`]: the discretisation, with [`norms`](ppum_solve::norms) of energies and errors.
//!
//! # Threads
//!
//! Work is spread over the pool of threads that a call is made from, and no pool is made here: what
//! is called inside `ThreadPool::install` stays on that pool. Results have the same bits on any
//! number of threads. Long calls take a [`Watcher`](ppum::progress::Watcher), which hears of their
//! progress and can stop them.
//!
//! # Modules, from below
//!
//! ```text
//! growth                          weight           cracks that grow, step by step; K of any load
//! solve                                            plan, system, solution, dataset
//! diagnostics                                      warnings
//! intensity                                        K_I, K_II, J, T
//! error, estimate                                  what cannot be solved, and the memory it takes
//! ```

pub mod diagnostics;
mod error;
mod estimate;
pub mod growth;
pub mod intensity;
pub mod solve;
pub mod weight;
