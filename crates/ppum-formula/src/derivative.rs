//! Symbolic derivatives on the expression graph, forward through all nodes in order.
//!
//! At a tie of `abs`, `min` or `max` the derivative is that of the piece to the right of the
//! point, and if that is undecided, of the piece above it (for further variables likewise): u = 0
//! counts as positive if u grows with x, or does not change with x and grows with y.

use crate::graph::{Graph, NodeId, Op};
use crate::language::ast::Ast;
use crate::language::lower::lower;
use crate::language::scope::Scope;
use crate::limits::MAX_NODES;
use crate::operation::{Binary, Comparison, Unary};

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
    /// [`FormulaJets`](crate::FormulaJets) know derivatives with respect to one or two variables.
    #[error("derivatives of functions of one or two variables only; here are {variables}")]
    Variables {
        /// Number of independent variables.
        variables: usize,
    },
}

/// For each root its partial derivatives with respect to the independent variables, in order.
pub(crate) fn gradients(
    graph: &mut Graph,
    scope: &Scope,
    roots: &[NodeId],
) -> Result<Vec<Vec<NodeId>>, DerivativeError> {
    let needed = graph.needed(roots);
    let zero = graph.constant(0.0);
    let defined = scope.definitions(graph);
    let mut pass =
        DerivativePass { graph, scope, zero, defined, partials: vec![Vec::new(); needed.len()] };
    for node in (0u32..).zip(needed).filter(|&(_, needed)| needed).map(|(id, _)| NodeId(id)) {
        if pass.graph.len() > MAX_NODES {
            return Err(DerivativeError::TooLarge);
        }
        if !pass.graph.op(node).is_condition() {
            pass.partials[node.index()] =
                (0..scope.independent().len()).map(|v| pass.partial(node, v)).collect();
        }
    }
    Ok(roots.iter().map(|root| pass.partials[root.index()].clone()).collect())
}

/// One sweep over the nodes. `v` is the index of the variable of a derivative throughout.
struct DerivativePass<'a> {
    graph: &'a mut Graph,
    scope: &'a Scope,
    zero: NodeId,
    /// Functions with derivative rules of their own.
    defined: Vec<NodeId>,
    /// Derivatives of the nodes so far, one per variable.
    partials: Vec<Vec<NodeId>>,
}

impl DerivativePass<'_> {
    fn partial(&mut self, node: NodeId, v: usize) -> NodeId {
        if let Some(defined) = self.defined.iter().position(|&defined| defined == node) {
            return self.rule(&self.scope.defined_rules(defined)[v]);
        }
        match self.graph.op(node) {
            Op::Input(input) => self.input(input as usize, v),
            Op::Unary(op, a) => self.unary(op, node, a, v),
            Op::Power(a, n) => {
                let (factor, lower) =
                    (self.graph.constant(f64::from(n)), self.graph.power(a, n - 1));
                let slope = self.times(factor, lower);
                self.times(slope, self.d(a, v))
            }
            Op::Binary(op, a, b) => self.binary(op, node, a, b, v),
            Op::Table { table, orders: [m, n], x, y } => {
                let mut raised = |orders| self.graph.table(table, orders, x, y);
                let (in_x, in_y) = (raised([m + 1, n]), y.map(|_| raised([m, n + 1])));
                let along_x = self.times(in_x, self.d(x, v));
                match (in_y, y) {
                    (Some(in_y), Some(y)) => {
                        let along_y = self.times(in_y, self.d(y, v));
                        self.plus(along_x, along_y)
                    }
                    _ => along_x,
                }
            }
            Op::Select(c, a, b) => self.graph.select(c, self.d(a, v), self.d(b, v)),
            Op::Constant(_)
            | Op::Truth(_)
            | Op::Compare(..)
            | Op::Not(_)
            | Op::And(..)
            | Op::Or(..) => self.zero,
        }
    }

    /// The derivative of an earlier node.
    fn d(&self, node: NodeId, v: usize) -> NodeId {
        self.partials[node.index()][v]
    }

    fn input(&mut self, input: usize, v: usize) -> NodeId {
        match self.scope.rules(input) {
            Some(rules) => self.rule(&rules[v]),
            None if input == v => self.graph.constant(1.0),
            None => self.zero,
        }
    }

    fn rule(&mut self, rule: &Ast) -> NodeId {
        lower(rule, self.scope, self.graph).expect("rules were checked by the scope")
    }

    /// `node` = op(a).
    fn unary(&mut self, op: Unary, node: NodeId, a: NodeId, v: usize) -> NodeId {
        let da = self.d(a, v);
        match op {
            Unary::Neg => self.opposite(da),
            Unary::Exp => self.times(node, da),
            Unary::Sign | Unary::Floor => self.zero,
            Unary::Abs => {
                let (minus, slopes) = (self.opposite(da), self.partials[a.index()].clone());
                let positive = self.is_upper(a, self.zero, &slopes);
                self.graph.select(positive, da, minus)
            }
            Unary::Sin => self.slope_times(Unary::Cos, a, da),
            Unary::Tanh => {
                // not 1 − tanh², which loses its digits far out
                let (one, cosh) = (self.graph.constant(1.0), self.graph.unary(Unary::Cosh, a));
                let sech = self.graph.binary(Binary::Div, one, cosh);
                let slope = self.graph.power(sech, 2);
                self.times(slope, da)
            }
            Unary::Sinh => self.slope_times(Unary::Cosh, a, da),
            Unary::Cosh => self.slope_times(Unary::Sinh, a, da),
            Unary::Cos => {
                let minus = self.opposite(da);
                self.slope_times(Unary::Sin, a, minus)
            }
            Unary::Acos => {
                let (minus, denominator) = (self.opposite(da), self.inverse_slope(op, node, a));
                self.over(minus, denominator)
            }
            _ => {
                let denominator = self.inverse_slope(op, node, a);
                self.over(da, denominator)
            }
        }
    }

    /// op(a) · d.
    fn slope_times(&mut self, op: Unary, a: NodeId, d: NodeId) -> NodeId {
        let slope = self.graph.unary(op, a);
        self.times(slope, d)
    }

    /// |1 / op′(a)|, for functions whose derivative is best written as a quotient; `node` = op(a).
    fn inverse_slope(&mut self, op: Unary, node: NodeId, a: NodeId) -> NodeId {
        let g = &mut *self.graph;
        let one = g.constant(1.0);
        match op {
            Unary::Sqrt => self.scaled(2.0, node),
            Unary::Cbrt => {
                let square = g.power(node, 2);
                self.scaled(3.0, square)
            }
            Unary::Log => a,
            Unary::Log10 => self.scaled(std::f64::consts::LN_10, a),
            Unary::Tan => {
                let cos = g.unary(Unary::Cos, a);
                g.power(cos, 2)
            }
            Unary::Atan => {
                let square = g.power(a, 2);
                g.binary(Binary::Add, one, square)
            }
            Unary::Asin | Unary::Acos => {
                // (1 − a)(1 + a) is exact near ±1 where 1 − a² is not
                let (below, above) = (g.binary(Binary::Sub, one, a), g.binary(Binary::Add, one, a));
                let product = g.binary(Binary::Mul, below, above);
                g.unary(Unary::Sqrt, product)
            }
            _ => unreachable!("the other functions have slopes without quotient"),
        }
    }

    /// `node` = op(a, b).
    fn binary(&mut self, op: Binary, node: NodeId, a: NodeId, b: NodeId, v: usize) -> NodeId {
        let (da, db) = (self.d(a, v), self.d(b, v));
        match op {
            Binary::Add => self.plus(da, db),
            Binary::Sub => self.minus(da, db),
            Binary::Mul => {
                let (left, right) = (self.times(da, b), self.times(a, db));
                self.plus(left, right)
            }
            Binary::Div => self.div(node, da, b, v),
            Binary::Pow => self.pow(node, a, b, da, db),
            Binary::Hypot => {
                let (cos, sin) = (self.over(a, node), self.over(b, node));
                let (left, right) = (self.times(cos, da), self.times(sin, db));
                self.plus(left, right)
            }
            Binary::Atan2 => {
                // divided twice by the radius: its square would underflow where it does not
                let radius = self.graph.binary(Binary::Hypot, a, b);
                let (sin, cos) = (self.over(a, radius), self.over(b, radius));
                let (left, right) = (self.times(cos, da), self.times(sin, db));
                let turn = self.minus(left, right);
                self.over(turn, radius)
            }
            Binary::Min | Binary::Max => {
                let upper = self.exceeds(a, b);
                let (high, low) = if op == Binary::Max { (da, db) } else { (db, da) };
                self.graph.select(upper, high, low)
            }
        }
    }

    /// (a/b)′ = (a′ − (a/b) b′) / b; `node` = a/b.
    fn div(&mut self, node: NodeId, da: NodeId, b: NodeId, v: usize) -> NodeId {
        if let Some(growth) = self.relative_growth(b, v) {
            let (change, decay) = (self.over(da, b), self.times(node, growth));
            return self.minus(change, decay);
        }
        let change = self.times(node, self.d(b, v));
        let numerator = self.minus(da, change);
        self.over(numerator, b)
    }

    /// b′/b in closed form where b may overflow: then 1/b has the slope 0, not 0 · ∞.
    fn relative_growth(&mut self, b: NodeId, v: usize) -> Option<NodeId> {
        match self.graph.op(b) {
            Op::Unary(Unary::Exp, u) => Some(self.d(u, v)),
            Op::Unary(Unary::Cosh, u) => Some(self.slope_times(Unary::Tanh, u, self.d(u, v))),
            _ => None,
        }
    }

    /// (aᵇ)′ = b aᵇ⁻¹ a′ + aᵇ log(a) b′, without the terms that vanish.
    fn pow(&mut self, node: NodeId, a: NodeId, b: NodeId, da: NodeId, db: NodeId) -> NodeId {
        let one = self.graph.constant(1.0);
        let exponent = self.graph.binary(Binary::Sub, b, one);
        let lower = self.graph.binary(Binary::Pow, a, exponent);
        let slope = self.graph.binary(Binary::Mul, b, lower);
        let of_base = self.times(slope, da);
        let log = self.graph.unary(Unary::Log, a);
        let growth = self.times(node, log);
        let of_exponent = self.times(growth, db);
        self.plus(of_base, of_exponent)
    }

    /// Whether a > b, ties decided by the slopes of a − b.
    fn exceeds(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let slopes: Vec<NodeId> = (0..self.scope.independent().len())
            .map(|v| self.minus(self.d(a, v), self.d(b, v)))
            .collect();
        self.is_upper(a, b, &slopes)
    }

    /// a > b, or a = b and the first slope that is not zero is positive, or all are zero.
    fn is_upper(&mut self, a: NodeId, b: NodeId, slopes: &[NodeId]) -> NodeId {
        let upper = self.graph.truth(true);
        let tie = slopes.iter().rfold(upper, |rest, &slope| {
            let rises = self.graph.compare(Comparison::Less, self.zero, slope);
            let level = self.graph.compare(Comparison::Equal, self.zero, slope);
            let undecided = self.graph.and(level, rest);
            self.graph.or(rises, undecided)
        });
        if tie == upper {
            return self.graph.compare(Comparison::LessEqual, b, a);
        }
        let above = self.graph.compare(Comparison::Less, b, a);
        let equal = self.graph.compare(Comparison::Equal, b, a);
        let tied = self.graph.and(equal, tie);
        self.graph.or(above, tied)
    }

    fn is_zero(&self, a: NodeId) -> bool {
        self.graph.value(a) == Some(0.0)
    }

    fn scaled(&mut self, factor: f64, a: NodeId) -> NodeId {
        let factor = self.graph.constant(factor);
        self.graph.binary(Binary::Mul, factor, a)
    }

    fn plus(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_zero(a) {
            return b;
        }
        if self.is_zero(b) { a } else { self.graph.binary(Binary::Add, a, b) }
    }

    fn minus(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_zero(a) {
            return self.opposite(b);
        }
        if self.is_zero(b) { a } else { self.graph.binary(Binary::Sub, a, b) }
    }

    fn opposite(&mut self, a: NodeId) -> NodeId {
        if self.is_zero(a) { self.zero } else { self.graph.neg(a) }
    }

    /// A product of the chain rule: exactly zero where a factor is the constant zero, in a branch
    /// too, whatever the other factor. So √(max(x, 0)) has slope 0 where x < 0, not 0 · ∞.
    fn times(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some((c, x, y)) = self.vanishing_branch(a) {
            return self.by_branch(c, x, y, |pass, branch| pass.product(branch, b));
        }
        if let Some((c, x, y)) = self.vanishing_branch(b) {
            return self.by_branch(c, x, y, |pass, branch| pass.product(a, branch));
        }
        self.product(a, b)
    }

    fn product(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero;
        }
        self.graph.binary(Binary::Mul, a, b)
    }

    /// A quotient of the chain rule: exactly zero where the numerator is the constant zero.
    fn over(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.vanishing_branch(a) {
            Some((c, x, y)) => self.by_branch(c, x, y, |pass, branch| pass.quotient(branch, b)),
            None => self.quotient(a, b),
        }
    }

    fn quotient(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is_zero(a) { self.zero } else { self.graph.binary(Binary::Div, a, b) }
    }

    /// The parts of a selection with a branch that is the constant zero.
    fn vanishing_branch(&self, node: NodeId) -> Option<(NodeId, NodeId, NodeId)> {
        match self.graph.op(node) {
            // the derivatives of sin θ do not exist where it has its own branch
            _ if self.defined.contains(&node) => None,
            Op::Select(c, a, b) if self.is_zero(a) || self.is_zero(b) => Some((c, a, b)),
            _ => None,
        }
    }

    fn by_branch(
        &mut self,
        c: NodeId,
        a: NodeId,
        b: NodeId,
        mut f: impl FnMut(&mut Self, NodeId) -> NodeId,
    ) -> NodeId {
        let (a, b) = (f(self, a), f(self, b));
        self.graph.select(c, a, b)
    }
}
