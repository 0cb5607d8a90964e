//! Reports: facts of a dataset, values at points and along curves, plots and tables.

#[cfg(feature = "problem")]
pub mod facts;
pub mod location;
pub mod owner;
#[cfg(feature = "problem")]
pub mod plots;
pub mod probe;
pub mod profile;
pub mod range;
pub mod table;
