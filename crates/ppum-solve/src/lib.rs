//! ppum-solve
pub mod quadrature;
