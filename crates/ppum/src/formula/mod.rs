//! Formulas: functions of the plane as text, differentiated symbolically.
//!
//! Enrichments, boundary data, exact fields and quantities are formulas: short texts such as
//! `sqrt(r)*sin(theta/2)`, parsed once, then evaluated at many points.
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
//! What names there are besides is the matter of a [`Scope`]: x and y, polar coordinates r and theta,
//! parameters, tables, the sides of cracks.
//!
//! A block is a whole formula, the inside of parentheses, or an argument. `^` groups from the right
//! (2^3^2 = 2^9) and binds tighter than a sign (−x^2 = −(x^2)); everything else groups from the left,
//! comparisons do not chain. `log` is the natural logarithm, angles are radians. Numbers and
//! conditions are different types: `if` and `and` want conditions, `+` wants numbers. A name has
//! one meaning, so `let` cannot define it again.
//!
//! Arithmetic is that of IEEE doubles: 1/0 is +∞, √−1 and 0/0 are NaN, NaN spreads (through `min`
//! and `max` too) and makes every comparison but `!=` false. Both branches of `if` are computed, only
//! one is taken. Integer powers up to 16 are products.
//!
//! # Derivatives
//!
//! Derivatives are exact, symbolic, and of any order. Where a function has a kink or a jump, the
//! derivative is that of one piece, the right one, and where that is undecided, the upper one: |x| has
//! slope +1 at 0, and so has |1 − x| at 1; `max(1 - t, 0)` has slope 0 at 1. Of `if` the branch
//! that gives the value gives the derivatives. `sign` and `floor` have derivative 0 everywhere.
//!
//! A table is flat outside its range; on the ends of the range its derivatives are those of the inside.
//! `side` has derivative 0.
//!
//! Where a formula may not be smooth is known without evaluating it: [`Formula::kinks`] are the zero
//! sets of what `abs`, `sign`, `min`, `max`, `floor`, inequalities and tables switch on, with
//! their equations where they are lines; [`Formula::singularities`] those of what stands under
//! roots, logarithms and fractions; [`Formula::breakpoints`] the places on an interval. Angles jump on
//! their cut ([`Formula::uses_branch`]), sides on their crack.
//!
//! # Half angles
//!
//! With r and theta, the sine, cosine and tangent of kθ/2 with a whole number k, 0 < |k| ≤ 64, are
//! products of x/r, y/r, cos(θ/2) and sin(θ/2): `sin(theta/2)`, `cos(1.5*theta)`, `sin(lambda*theta)`
//! with a parameter λ = ½, `cos(theta/2 + theta)`. There is no arc tangent, and no cancellation near
//! θ = ±π; the caller gives the two half angles on its branch, see [`Scope::polar`]. Other uses of
//! theta take θ itself.
//!
//! # Limits
//!
//! Texts up to [`MAX_LENGTH`] bytes, nested up to [`MAX_DEPTH`] levels, with derivatives up to
//! [`MAX_NODES`] operations; anything beyond is an error. No text makes the parser crash or recurse
//! without bound.

mod ast;
mod block;
mod derivative;
mod error;
mod graph;
mod half_angle;
mod jets;
mod kinks;
mod lanes;
mod lexer;
mod library;
mod lower;
mod operation;
mod parser;
mod print;
mod program;
mod reciprocal;
mod roots;
mod scope;
mod substitute;
mod table;
mod tape;
#[cfg(test)]
mod tests;
mod wgsl;
mod wgsl_table;

use std::fmt;
use std::sync::Arc;

pub use block::{Block, Scratch};
pub use error::{FormulaError, Problem};
pub use jets::FormulaJets;
pub use kinks::Kink;
pub(crate) use lanes::Interpret;
pub use scope::{Scope, ScopeError, VARIABLES};
pub use table::{Table, TableError};
pub use wgsl::{WgslError, wgsl_prelude};

use derivative::gradients;
use graph::{Graph, NodeId};
use program::Program;

/// Deepest nesting of parentheses, calls, signs and powers. Deeper ones are machine-made or
/// malicious; the parser needs up to 0.7 MiB of stack at this depth, a third of what a thread has.
pub const MAX_DEPTH: usize = 200;

/// Longest text of a formula, in bytes.
pub const MAX_LENGTH: usize = 1 << 16;

/// Most operations of a formula with its derivatives. Hand-written formulas have a hundred; this
/// many still fit in some tens of megabytes and are made within a second.
pub const MAX_NODES: usize = 1 << 18;

/// A formula of the variables of a [`Scope`], ready for evaluation.
///
/// ```
/// use ppum::formula::{Formula, Scope};
///
/// let f = Formula::parse("let d = x - y; d^2 / 2", &Scope::cartesian()).expect("a formula");
/// assert_eq!(f.evaluate(&[5.0, 1.0]), 8.0);
/// let fy = f.derivative("y").expect("a variable");
/// assert_eq!(fy.evaluate(&[5.0, 1.0]), -4.0);
/// ```
#[derive(Clone)]
pub struct Formula {
    text: String,
    scope: Arc<Scope>,
    program: Program,
}

/// A derivative that cannot be formed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DerivativeError {
    /// Derivatives are with respect to independent variables only.
    #[error("no derivative with respect to `{name}`; independent variables are {known}")]
    NotIndependent {
        /// The name asked for.
        name: String,
        /// The independent variables.
        known: String,
    },
    /// The derivatives have more than [`MAX_NODES`] operations.
    #[error("the derivatives have more than {MAX_NODES} operations; simplify the formula")]
    TooLarge,
    /// [`FormulaJets`] know derivatives with respect to one or two variables.
    #[error("derivatives of functions of one or two variables only; here are {variables}")]
    Variables {
        /// Number of independent variables.
        variables: usize,
    },
}

impl Formula {
    /// Parses a formula.
    ///
    /// # Errors
    /// When the text is no formula of the scope; the error points at the place.
    pub fn parse(text: &str, scope: &Scope) -> Result<Self, FormulaError> {
        let ast = parser::parse(text, scope)?;
        let mut graph = Graph::new(scope.tables());
        let root =
            lower::lower(&ast, scope, &mut graph).map_err(|mistake| mistake.locate(text, &ast))?;
        let program = Program::new(&graph, &[root]);
        Ok(Self { text: text.to_owned(), scope: Arc::new(scope.clone()), program })
    }

    /// Parses a condition, e.g. `x > 0 and y > 0`, as the formula that is 1 where it holds and 0
    /// elsewhere.
    ///
    /// # Errors
    /// When the text is no condition of the scope; the error points at the place.
    pub fn parse_condition(text: &str, scope: &Scope) -> Result<Self, FormulaError> {
        let ast = parser::parse(text, scope)?;
        let mut graph = Graph::new(scope.tables());
        let root = lower::lower_condition(&ast, scope, &mut graph);
        let root = root.map_err(|mistake| mistake.locate(text, &ast))?;
        let program = Program::new(&graph, &[root]);
        let text = print::print(&program, scope);
        Ok(Self { text, scope: Arc::new(scope.clone()), program })
    }

    /// The text: as it was parsed, or, of a derivative or a condition, as it can be parsed again in
    /// the same scope (if it is within [`MAX_LENGTH`]).
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The formula as it is computed, as a text that parses to the same operations in the same scope
    /// (if it is within [`MAX_LENGTH`]): parameters and constants folded, definitions put in their
    /// places, long and common parts named by `let`.
    ///
    /// ```
    /// use ppum::formula::{Formula, Scope};
    ///
    /// let f = Formula::parse("2^3*(x/1 + (y))", &Scope::cartesian()).expect("a formula");
    /// assert_eq!(f.normal_form(), "8*(x + y)");
    /// ```
    #[must_use]
    pub fn normal_form(&self) -> String {
        print::print(&self.program, &self.scope)
    }

    /// The variables it may use.
    #[must_use]
    pub fn scope(&self) -> &Scope {
        &self.scope
    }

    /// The value, if it is the same whatever the inputs.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        self.program.ops()[self.root().index()].value()
    }

    /// True if its value or the choice of a branch depends on the input of this name. A
    /// dependent variable counts by its own name only.
    #[must_use]
    pub fn uses(&self, input: &str) -> bool {
        let mut inputs = (0..).zip(self.scope.inputs());
        inputs
            .find(|(_, name)| *name == input)
            .is_some_and(|(index, _)| self.program.ops().contains(&graph::Op::Input(index)))
    }

    /// The value at one point. `inputs` has one number for each of [`Scope::inputs`].
    ///
    /// # Panics
    /// When `inputs` has the wrong length.
    #[must_use]
    pub fn evaluate(&self, inputs: &[f64]) -> f64 {
        self.evaluate_with(inputs, &mut Vec::new())
    }

    /// The value at one point, without allocating where `scratch` is reused.
    ///
    /// # Panics
    /// When `inputs` has the wrong length.
    pub fn evaluate_with(&self, inputs: &[f64], scratch: &mut Vec<f64>) -> f64 {
        check_inputs(&self.scope, inputs);
        self.program.run(inputs, scratch);
        scratch[self.root().index()]
    }

    /// The derivative with respect to an independent variable.
    ///
    /// # Errors
    /// When there is no such variable, or the derivative is too large.
    pub fn derivative(&self, variable: &str) -> Result<Self, DerivativeError> {
        let v = self.independent(variable)?;
        let mut graph = self.program.graph();
        let gradient = gradients(&mut graph, &self.scope, &[self.root()])?;
        let program = Program::new(&graph, &[gradient[0][v]]);
        let text = print::print(&program, &self.scope);
        Ok(Self { text, scope: Arc::clone(&self.scope), program })
    }

    fn root(&self) -> NodeId {
        self.program.outputs()[0]
    }

    /// Index of an independent variable.
    fn independent(&self, name: &str) -> Result<usize, DerivativeError> {
        let known = self.scope.independent();
        known.iter().position(|variable| variable == name).ok_or_else(|| {
            DerivativeError::NotIndependent { name: name.to_owned(), known: known.join(", ") }
        })
    }
}

/// Formulas are equal when their texts and scopes are.
impl PartialEq for Formula {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text && self.scope == other.scope
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Formula").field(&self.text).finish()
    }
}

/// A formula's text on one line, without comments: for labels.
///
/// ```
/// let text = "let d = x - y;   # distance\n d^2";
/// assert_eq!(ppum::formula::one_line(text), "let d = x - y; d^2");
/// ```
#[must_use]
pub fn one_line(text: &str) -> String {
    let code = text.lines().map(|line| line.split('#').next().unwrap_or_default());
    code.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
}

fn check_inputs(scope: &Scope, inputs: &[f64]) {
    assert_eq!(inputs.len(), scope.n_inputs(), "one number for each input of the scope");
}
