//! Discretises two-dimensional problems of elasticity and Poisson's equation with cracks by the
//! particle-partition of unity method: from a checked [`Problem`](ppum_problem::Problem) to a
//! system of equations, and from coefficients to fields, energies and estimates of the error.
//!
//! `ppum_fracture::solve` drives it; what depends on fracture alone (intensity factors, growth,
//! iterations of contact, warnings) is there.
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
//! adapt           hierarchy                        estimated error, cells to divide; coarser levels of a system
//! assembly        norms                            cells and boundary → K u = f; energies, errors
//! basis                                            stable basis
//! space                                            local spaces of a cover, enriched
//! refine          triangulation                    covers; triangles between segments
//! corner          equilibrium                      singular points; pieces of the body
//! smoothness      terms                            kinks of integrands; what features add
//! law                                              stresses
//! quadrature      report          watched          edges
//! ```

pub mod adapt;
pub mod assembly;
pub mod basis;
pub mod corner;
mod edges;
pub mod equilibrium;
pub mod hierarchy;
pub mod law;
pub mod norms;
pub mod quadrature;
pub mod refine;
pub mod report;
pub mod smoothness;
pub mod space;
pub mod terms;
pub mod triangulation;
pub mod watched;
