//! From a problem to a dataset: elasticity and Poisson problems with cracks, solved by the
//! particle-partition of unity method.
pub mod problem;
//! ppum-solve
pub mod quadrature;
