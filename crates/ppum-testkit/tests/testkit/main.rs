//! What holds for the project as a whole: its crates, its pages, and all back ends of formulas.

mod architecture;
mod formulas;
mod hostile_formulas;
mod pages;
mod wgsl;
