//! Problems whose answers are known. The tests hold the solver to them; the example `validation` of
//! ppum-bench prints what they give.

pub(crate) mod adapted;
pub(crate) mod exact_fields;
pub(crate) mod factors;
pub(crate) mod plates;
pub(crate) mod release;
pub(crate) mod support;
