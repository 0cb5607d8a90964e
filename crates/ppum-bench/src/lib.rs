//! Programs for measuring, fuzzing and the validation page.
//!
//! None of this is part of the product, and this crate is no default member of the workspace. The
//! program `ppum-bench` measures the solver, the renderers and the window;
//! [performance](../../docs/performance.md) has its tables. Commands with `--workspace` build it,
//! `target/release/ppum-bench --help` lists its commands, and this library is what they do.
//!
//! `cargo run --release -p ppum-bench --example NAME -- ARGUMENTS` runs one of these programs:
//!
//! - `answers` solves problem files and prints energies, stress intensity factors and warnings as
//!   JSON.
//! - `costly_files` writes small datasets that take much time or memory to read or draw.
//! - `fixture` writes, extends, compares and evaluates datasets for the tests of the Python reader.
//! - `formulas` compares the time of frames of user-defined formulas with the time of frames of
//!   built-in kernels.
//! - `functions` compares elementary functions and tables on vectors with those of the standard
//!   library.
//! - `fuzz_files` searches for damaged files that the reader of datasets does not survive.
//! - `fuzz_formulas` searches for texts that the parser or an evaluator of formulas does not
//!   survive.
//! - `meshes` compares the time of frames of meshes with the time of frames of covers.
//! - `odd_figures` draws figures with unusual layouts for inspection by eye.
//! - `opening` measures opening datasets, reading their steps and appending steps.
//! - `solvers` compares the results and the time of the multilevel solver with those of the direct
//!   solver.
//! - `validation` computes `docs/validation.md` and its images.
//!
//! `cargo bench -p ppum-bench --bench evaluate` measures the reference evaluator at points.

mod calls;
mod cards;
mod chart;
mod frames;
pub mod guard;
mod machine;
pub mod page;
pub mod paper;
pub mod solver;
pub mod synthetic;
pub mod table;
pub mod window;

use table::ReportTable;

/// A report: words and tables for people, JSON for programs.
pub trait Report: serde::Serialize {
    /// Describes the measurement.
    fn words(&self) -> String;

    /// The measurements.
    fn tables(&self) -> Vec<ReportTable>;

    /// An error if the measurements mean that something is wrong.
    ///
    /// # Errors
    /// By default none.
    fn verdict(&self) -> anyhow::Result<()> {
        Ok(())
    }
}
