//! Development tools of `ppum`: exact solutions, synthetic datasets and an evaluation in extended
//! precision to compare with.

pub mod exact;
pub mod extended;
pub mod random;
pub mod synthetic;
