//! A formula: parsed once, evaluated at points, differentiated.

use std::fmt;
use std::sync::Arc;

use crate::derivative::{DerivativeError, gradients};
use crate::error::FormulaError;
use crate::graph::{self, Graph, NodeId};
use crate::language::scope::Scope;
use crate::language::{lower, parser};
use crate::print;
use crate::program::FormulaProgram;

/// A formula of the variables of a [`Scope`], ready for evaluation.
///
/// ```
/// use ppum_formula::{Formula, Scope};
///
/// let f = Formula::parse("let d = x - y; d^2 / 2", &Scope::cartesian()).expect("a formula");
/// assert_eq!(f.evaluate(&[5.0, 1.0]), 8.0);
/// let fy = f.derivative("y").expect("a variable");
/// assert_eq!(fy.evaluate(&[5.0, 1.0]), -4.0);
/// ```
#[derive(Clone)]
pub struct Formula {
    pub(crate) text: String,
    pub(crate) scope: Arc<Scope>,
    pub(crate) program: FormulaProgram,
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
        let program = FormulaProgram::new(&graph, &[root]);
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
        let root = lower::lower_condition(&ast, scope, &mut graph)
            .map_err(|mistake| mistake.locate(text, &ast))?;
        let program = FormulaProgram::new(&graph, &[root]);
        let text = print::print(&program, scope);
        Ok(Self { text, scope: Arc::new(scope.clone()), program })
    }

    /// The text: as it was parsed, or, of a derivative or a condition, as it can be parsed again in
    /// the same scope (if it is within [`MAX_LENGTH`](crate::MAX_LENGTH)).
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The formula as it is computed, as a text that parses to the same operations in the same
    /// scope (if it is within [`MAX_LENGTH`](crate::MAX_LENGTH)): parameters and constants folded,
    /// definitions put in their places, long and common parts named by `let`.
    ///
    /// ```
    /// use ppum_formula::{Formula, Scope};
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
        let program = FormulaProgram::new(&graph, &[gradient[0][v]]);
        let text = print::print(&program, &self.scope);
        Ok(Self { text, scope: Arc::clone(&self.scope), program })
    }

    pub(crate) fn root(&self) -> NodeId {
        self.program.outputs()[0]
    }

    /// Index of an independent variable.
    pub(crate) fn independent(&self, name: &str) -> Result<usize, DerivativeError> {
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
/// assert_eq!(ppum_formula::one_line(text), "let d = x - y; d^2");
/// ```
#[must_use]
pub fn one_line(text: &str) -> String {
    let code = text.lines().map(|line| line.split('#').next().unwrap_or_default());
    code.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
}

pub(crate) fn check_inputs(scope: &Scope, inputs: &[f64]) {
    assert_eq!(inputs.len(), scope.n_inputs(), "one number for each input of the scope");
}
