//! Development tools of `ppum`: exact solutions, synthetic datasets, the corpora of formulas and fields, an
//! evaluation in extended precision to compare with, and an interpreter of WGSL.

pub mod corpus;
pub mod costly;
pub mod exact;
pub mod extended;
pub mod fields;
pub mod random;
pub mod rooms;
pub mod skipped;
pub mod synthetic;
pub mod wgsl;
