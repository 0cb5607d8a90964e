//! ppum-solve
pub mod problem;
pub mod quadrature;
