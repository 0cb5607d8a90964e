//! Programs for measuring, fuzzing and the validation page.
//!
//! Cargo builds the examples of a crate whenever it tests that crate. The examples of the whole workspace are therefore
//! in this crate, which `cargo test` leaves out because it is not a default member. This library is empty; each program
//! documents its arguments at the top of its file.
//!
//! `cargo run --release -p ppum-bench --example NAME -- ARGUMENTS` runs one of these programs:
//!
//! - `answers` solves problem files and prints energies, stress intensity factors and warnings as JSON.
//! - `costly_files` writes small datasets that take much time or memory to read or draw.
//! - `fixture` writes, extends, compares and evaluates datasets for the tests of the Python reader.
//! - `formulas` compares the time of frames of user-defined formulas with the time of frames of built-in kernels.
//! - `frames` measures upload, shader compilation and frames on a graphics device.
//! - `functions` compares elementary functions and tables on vectors with those of the standard library.
//! - `fuzz_files` searches for damaged files that the reader of datasets does not survive.
//! - `fuzz_formulas` searches for texts that the parser or an evaluator of formulas does not survive.
//! - `levels` measures the multilevel solver and the direct solver on a sequence of uniform covers.
//! - `odd_figures` draws figures with unusual layouts for inspection by eye.
//! - `opening` measures opening datasets, reading their steps and appending steps.
//! - `solvers` compares the results and the time of the multilevel solver with those of the direct solver.
//! - `validation` computes `docs/validation.md` and its images.
//!
//! `cargo bench -p ppum-bench --bench evaluate` measures the reference evaluator at points.
