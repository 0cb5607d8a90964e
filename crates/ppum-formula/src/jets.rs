//! Several formulas with their derivatives, compiled together.
//!
//! [`FormulaJets`] joins formulas of one scope in one graph, differentiates it, and keeps the
//! straight-line program of all results: what they have in common is computed once. The program
//! runs at one point in double precision, the reference.
//!
//! For each formula the results are, by the order of derivatives and in this sequence,
//!
//! ```text
//! order   of two variables x, y      of one variable t     of any number
//! 0       v                          v                     v
//! 1       v, v_x, v_y                v, v_t
//! 2       v, v_x, v_y,               v, v_t, v_tt
//!         v_xx, v_xy, v_yy
//! ```
//!
//! whatever the names of the variables: they are the independent ones of the scope, in their order.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::derivative::{DerivativeError, gradients};
use crate::formula::{Formula, check_inputs};
use crate::graph::{Graph, NodeId, Op};
use crate::lanes::Tape;
use crate::language::scope::Scope;
use crate::program::FormulaProgram;
use crate::reciprocal::share_reciprocals;
use crate::wgsl::{self, WgslError};

/// Values and derivatives of formulas of one scope.
///
/// ```
/// use ppum_formula::{Formula, FormulaJets, Scope};
///
/// let formula = |text| Formula::parse(text, &Scope::cartesian()).expect("a formula");
/// let jets = FormulaJets::new(&[&formula("x^2*y"), &formula("x + y")], 1).expect("plane");
/// let mut out = [0.0; 6];
/// jets.evaluate(&[3.0, 2.0], &mut Vec::new(), &mut out);
/// assert_eq!(out, [18.0, 12.0, 9.0, 5.0, 1.0, 1.0]);
/// ```
#[derive(Clone, Debug)]
pub struct FormulaJets {
    scope: Arc<Scope>,
    program: FormulaProgram,
    tape: Tape,
}

impl FormulaJets {
    /// Compiles formulas with derivatives up to `order`, which is 0, 1 or 2.
    ///
    /// # Errors
    /// When derivatives are asked for and the scope has neither one nor two independent variables,
    /// or when they are too large.
    ///
    /// # Panics
    /// When there is no formula, when scopes differ in more than parameters, or `order` is above 2.
    pub fn new(formulas: &[&Formula], order: usize) -> Result<Self, DerivativeError> {
        let scope = &formulas.first().expect("at least one formula").scope;
        assert!(order <= 2, "derivatives of order {order} were asked for; there are up to 2");
        let mut graph = Graph::new(scope.tables());
        let roots: Vec<NodeId> =
            formulas.iter().map(|formula| root_in(&mut graph, formula, scope)).collect();
        let mut outputs = jets(&mut graph, scope, &roots, order)?;
        share_reciprocals(&mut graph, &roots, &mut outputs);
        Ok(Self::of_outputs(&graph, &outputs, scope))
    }

    /// Compiles a formula with its derivatives with respect to some independent variables of its
    /// scope, however many that has: the results are the value and a derivative for each of
    /// `variables`, in their order.
    ///
    /// ```
    /// use ppum_formula::{Formula, FormulaJets, Scope};
    ///
    /// let formula = Formula::parse("a*b + c", &Scope::new(&["a", "b", "c"])?)?;
    /// let jets = FormulaJets::partials(&formula, &["c", "a"])?;
    /// let mut out = [0.0; 3];
    /// jets.evaluate(&[2.0, 3.0, 4.0], &mut Vec::new(), &mut out);
    /// assert_eq!(out, [10.0, 1.0, 3.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When one is no independent variable, or the derivatives are too large.
    pub fn partials(formula: &Formula, variables: &[&str]) -> Result<Self, DerivativeError> {
        let indices: Result<Vec<_>, _> =
            variables.iter().map(|name| formula.independent(name)).collect();
        let (mut graph, root) = (formula.program.graph(), formula.root());
        let all = gradients(&mut graph, &formula.scope, &[root])?;
        let mut outputs = vec![root];
        outputs.extend(indices?.into_iter().map(|index| all[0][index]));
        share_reciprocals(&mut graph, &[root], &mut outputs);
        Ok(Self::of_outputs(&graph, &outputs, &formula.scope))
    }

    fn of_outputs(graph: &Graph, outputs: &[NodeId], scope: &Arc<Scope>) -> Self {
        let program = FormulaProgram::new(graph, outputs);
        let tape = Tape::new(&program, scope.n_inputs());
        Self { scope: Arc::clone(scope), program, tape }
    }

    /// The results at one point, all those of the first formula first. `inputs` has one number for
    /// each of [`Scope::inputs`]; `scratch` is working space, best reused from call to call.
    ///
    /// # Panics
    /// When `inputs` or `out` has the wrong length.
    pub fn evaluate(&self, inputs: &[f64], scratch: &mut Vec<f64>, out: &mut [f64]) {
        check_inputs(&self.scope, inputs);
        assert_eq!(out.len(), self.n_outputs(), "one number for each output");
        self.program.run(inputs, scratch);
        for (out, node) in out.iter_mut().zip(self.program.outputs()) {
            *out = scratch[node.index()];
        }
    }

    /// The function of WGSL that computes the results in single precision, to stand in a module
    /// together with [`wgsl_prelude`](crate::wgsl_prelude).
    ///
    /// ```wgsl
    /// fn name(x: f32, y: f32, r: f32, theta: f32, cos_half_theta: f32, sin_half_theta: f32) -> array<f32, 6>
    /// ```
    ///
    /// The parameters are all inputs of the scope in their order, used or not: `side(0)` is called
    /// `side_0`, and one called `a` by the makers of the scope `in_a`. The results are those of
    /// [`FormulaJets::evaluate`]. Tables come as functions `table_0_of_name`, …, before it.
    ///
    /// `name` has to be a name that WGSL has no meaning for (`f32` has one), beginning with neither
    /// `ppum_` nor `table_`. Numbers are rounded to single precision, those beyond it are infinite
    /// or 0. Functions are accurate to some units of the last place where WGSL promises less,
    /// except √, log and powers that are not whole, which are the device's; infinities and NaN are
    /// as well kept as the device does. A table makes a text as long as its cells are many.
    #[must_use]
    pub fn wgsl(&self, name: &str) -> String {
        wgsl::function(name, &self.scope, &self.program, |_| true)
    }

    /// Like [`FormulaJets::wgsl`], but the parameters are only the inputs that are
    /// [used](Self::used), in their order.
    ///
    /// # Errors
    /// When a table has more than 2047 knots or cubics (one per cell, four with two arguments), or
    /// WGSL does not promise to hold the number of inputs.
    pub fn wgsl_of_used(&self, name: &str) -> Result<String, WgslError> {
        wgsl::check(&self.program, self.used().count())?;
        let used: BTreeSet<_> = self.used().collect();
        Ok(wgsl::function(name, &self.scope, &self.program, |input| used.contains(&input)))
    }

    /// Indices of the inputs that are [used](Self::uses), in their order.
    pub fn used(&self) -> impl Iterator<Item = usize> {
        let input = |op: &Op| if let Op::Input(input) = op { Some(*input as usize) } else { None };
        let used: BTreeSet<_> = self.program.ops().iter().filter_map(input).collect();
        used.into_iter()
    }

    /// True if a result depends on this input, by its index among [`Scope::inputs`]. A dependent
    /// variable counts by itself only.
    #[must_use]
    pub fn uses(&self, input: usize) -> bool {
        self.program.ops().contains(&Op::Input(input as u32))
    }

    /// The program that every back end starts from.
    #[cfg(test)]
    pub(crate) fn program(&self) -> &FormulaProgram {
        &self.program
    }

    /// The tape that lanes run.
    pub(crate) fn tape(&self) -> &Tape {
        &self.tape
    }

    /// Number of results: of formulas times that of each.
    #[must_use]
    pub fn n_outputs(&self) -> usize {
        self.program.outputs().len()
    }

    /// Number of operations of one evaluation, constants and inputs included.
    #[must_use]
    pub fn n_operations(&self) -> usize {
        self.program.ops().len()
    }
}

/// The node of a formula's value.
fn root_in(graph: &mut Graph, formula: &Formula, scope: &Scope) -> NodeId {
    assert!(
        formula.scope.has_variables_of(scope),
        "formulas must have variables and tables in common"
    );
    graph.absorb(formula.program.ops())[formula.root().index()]
}

/// The nodes of the values and derivatives of the roots, root by root.
fn jets(
    graph: &mut Graph,
    scope: &Scope,
    roots: &[NodeId],
    order: usize,
) -> Result<Vec<NodeId>, DerivativeError> {
    let mut jets: Vec<Vec<NodeId>> = roots.iter().map(|&root| vec![root]).collect();
    let variables = scope.independent().len();
    if order > 0 && !(1..=2).contains(&variables) {
        return Err(DerivativeError::Variables { variables });
    }
    let mut last = roots.to_vec();
    for _ in 0..order {
        let partials = gradients(graph, scope, &last)?;
        last.clear();
        for (jet, partials) in jets.iter_mut().zip(partials.chunks(partials.len() / roots.len())) {
            // Each derivative by its own and later variables only: xy, but not yx.
            let new: Vec<NodeId> =
                partials.iter().enumerate().flat_map(|(v, of)| &of[v..]).copied().collect();
            last.extend(&new);
            jet.extend(new);
        }
    }
    Ok(jets.concat())
}
