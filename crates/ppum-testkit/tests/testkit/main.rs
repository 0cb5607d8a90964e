//! The project as a whole: its crates, its pages, and all back ends of formulas.

mod architecture;
mod circles;
mod features;
mod formulas;
mod hostile_formulas;
mod names;
mod pages;
mod sources;
mod wgsl;
