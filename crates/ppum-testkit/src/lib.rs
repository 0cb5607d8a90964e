//! Development tools of `ppum`: exact solutions, synthetic datasets, the corpus of formulas and an evaluation in extended
//! precision to compare with.

pub mod corpus;
pub mod exact;
pub mod extended;
pub mod random;
pub mod synthetic;
