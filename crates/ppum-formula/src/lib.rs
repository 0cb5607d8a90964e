//! Formulas: functions of the plane as text, differentiated exactly, evaluated at many points,
//! printed as functions of a shader.
//!
//! ```
//! use ppum_formula::{BlockScratch, Formula, FormulaJets, Scope};
//!
//! let f = Formula::parse("exp(-x^2)*cos(y)", &Scope::cartesian())?;
//! assert_eq!(f.evaluate(&[0.0, 0.0]), 1.0);
//! assert_eq!(f.derivative("y")?.text(), "-(exp(-x^2)*sin(y))");
//!
//! let jets = FormulaJets::new(&[&f], 1)?; // with both first derivatives, compiled together
//! let mut scratch = BlockScratch::<f64>::default();
//! let mut block = jets.block(&mut scratch); // many points at once, on the lanes of the processor
//! block.input(0)[..2].copy_from_slice(&[0.0, 0.5]); // x
//! block.input(1)[..2].copy_from_slice(&[0.0, 1.0]); // y
//! block.run();
//! assert_eq!(block.output(0)[..2], [1.0, (-0.25_f64).exp() * 1.0_f64.cos()]); // values
//! assert!(jets.wgsl("bump").contains("fn bump(x: f32, y: f32) -> array<f32, 3> {"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Every formula goes through the same stages, each a loop over what the one before has made:
//!
//! ```text
//! text ─▶ lexer ─▶ parser ─▶ tree ─▶ lower ─▶ graph ─▶ derivative ─▶ program ─┬▶ one point, f64: the reference
//!                                               │                            ├▶ tape, lanes: blocks of points
//!                                               └▶ kinks: where it is        └▶ wgsl: a function of a shader
//!                                                  not smooth
//! ```
//!
//! [`real`] is the number type of kernels, here and in what is built on this crate: f64, f32,
//! vectors of both. [`printable`](mod@printable) and [`spelling`] are for messages: texts that
//! nobody can trust, words that were mistyped. No files, no threads.
//!
//! # The language
//!
//! ```text
//! block       let name = expression; … expression     names hold to the end of the block
//! operators   or,  and,  not,  < <= > >= == !=,  + -,  * /,  unary -,  ^        weakest to tightest
//! functions   sqrt cbrt exp log log10 sin cos tan asin acos atan atan2 sinh cosh tanh
//!             abs sign min max floor hypot clamp(x, low, high) if(condition, a, b)
//! cracks      side(k): +1 on the left of crack k, -1 on its right
//! tables      table(name, x)  table(name, x, y)             see [`Table`]
//!             dtable(name, m, x)  dtable(name, m, n, x, y)  derivatives of orders m, n (whole numbers)
//! constants   pi e
//! comments    # to the end of the line
//! ```
//!
//! Further names are the matter of a [`Scope`]: x and y, polar coordinates r and theta,
//! parameters, tables, the sides of cracks.
//!
//! A block is a whole formula, the inside of parentheses, or an argument. `^` groups from the right
//! (2^3^2 = 2^9) and binds tighter than a sign (−x^2 = −(x^2)); everything else groups from the
//! left, comparisons do not chain. `log` is the natural logarithm, angles are radians. Numbers and
//! conditions are different types: `if` and `and` want conditions, `+` wants numbers. A name has
//! one meaning, so `let` cannot define it again.
//!
//! Arithmetic is that of IEEE doubles: 1/0 is +∞, √−1 and 0/0 are NaN, NaN spreads (through `min`
//! and `max` too) and makes every comparison but `!=` false. Both branches of `if` are computed,
//! only one is taken. Integer powers up to 16 are products.
//!
//! # Derivatives
//!
//! Derivatives are exact, symbolic, and of any order. Where a function has a kink or a jump, the
//! derivative is that of one piece, the right one, and where that is undecided, the upper one: |x|
//! has slope +1 at 0, and so has |1 − x| at 1; `max(1 - t, 0)` has slope 0 at 1. For `if`, the
//! branch that gives the value gives the derivatives. `sign` and `floor` have derivative 0
//! everywhere.
//!
//! A table is flat outside its range; on the ends of the range its derivatives are those of the
//! inside. `side` has derivative 0.
//!
//! The places where a formula may not be smooth are known without evaluating it: [`Formula::kinks`]
//! are the zero sets of what `abs`, `sign`, `min`, `max`, `floor`, inequalities and tables switch
//! on, with their equations where they are lines; [`Formula::singularities`] those of what stands
//! under roots, logarithms and fractions; [`Formula::breakpoints`] the places on an interval.
//! Angles jump on their cut ([`Formula::uses_branch`]), sides on their crack.
//!
//! # Half angles
//!
//! With r and theta, the sine, cosine and tangent of kθ/2 with a whole number k, 0 < |k| ≤ 64, are
//! products of x/r, y/r, cos(θ/2) and sin(θ/2): `sin(theta/2)`, `cos(1.5*theta)`,
//! `sin(lambda*theta)` with a parameter λ = ½, `cos(theta/2 + theta)`. There is no arc tangent, and
//! no cancellation near θ = ±π; the caller gives the two half angles on its branch, see
//! [`Scope::polar`]. Other uses of theta take θ itself.
//!
//! # Limits
//!
//! Texts up to [`MAX_LENGTH`] bytes, nested up to [`MAX_DEPTH`] levels, with derivatives up to
//! [`MAX_NODES`] operations; anything beyond is an error. No text makes the parser crash or recurse
//! without bound.

mod block;
mod derivative;
pub mod elementary;
mod error;
mod formula;
mod graph;
mod jets;
mod kinks;
mod lanes;
mod language;
mod library;
mod limits;
mod operation;
mod print;
pub mod printable;
mod program;
pub mod real;
mod reciprocal;
pub mod spelling;
mod substitute;
mod table;
#[cfg(test)]
mod tests;
mod wgsl;

pub use block::{Block, BlockScratch};
pub use derivative::DerivativeError;
pub use error::{ErrorKind, FormulaError};
pub use formula::{Formula, one_line};
pub use jets::FormulaJets;
pub use kinks::Kink;
pub use language::scope::{Scope, ScopeError, VARIABLES};
pub use library::function_names;
pub use limits::{MAX_DEPTH, MAX_LENGTH, MAX_NODES};
pub use table::{Table, TableError};
pub use wgsl::{WgslError, wgsl_prelude};
