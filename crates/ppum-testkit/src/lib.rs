//! Development tools of `ppum`: exact solutions to compare with.

pub mod exact;
