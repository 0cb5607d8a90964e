//! ppum-solve
