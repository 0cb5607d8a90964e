//! Datasets with all the parts of a solution, made without solving.
//!
//! A [`Recipe`] says what a dataset looks like: its cover, cracks, functions and coefficients. The
//! blocks are those of a solver: every patch has a smooth block; a patch that a crack cuts through
//! has its side function, one in which cracks meet functions of the components that they leave of
//! it; a patch near a tip has the tip's Westergaard functions. So every recipe jumps on its cracks
//! and nowhere else.

mod coefficients;
mod components;
mod dataset;
mod meeting;
mod recipe;
mod series;

pub use coefficients::{amplitude, cut_off, level, smooth};
pub use components::SyntheticComponents;
pub use dataset::{opening, polynomial};
pub use recipe::{Coefficients, Junction, Recipe, crack, kinked};
pub use series::{growing, series};
