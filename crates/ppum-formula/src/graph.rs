//! The expression graph: static single assignment with shared subexpressions.
//!
//! Nodes are hash-consed, so equal expressions are one node, and are folded as they are made.
//! Folding never changes a value, NaN included: `0*x` stays, `1*x` does not. Operands always come
//! before what uses them, so every pass is a loop.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use crate::operation::{Binary, Comparison, Unary, power};
use crate::table::Table;

/// Index of a node; an operand's is smaller than that of its user.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct NodeId(pub(crate) u32);

impl NodeId {
    /// As an index of arrays with one entry a node.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A node: an operation on earlier nodes. It gives a number, or a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Op {
    /// A number, as its bits.
    Constant(u64),
    /// A variable: its index among the scope's inputs.
    Input(u32),
    /// A function of a number.
    Unary(Unary, NodeId),
    /// An integer power.
    Power(NodeId, i32),
    /// A function of two numbers.
    Binary(Binary, NodeId, NodeId),
    /// A derivative of a table: its index in the scope, the orders in x and y, its arguments.
    Table { table: u32, orders: [u8; 2], x: NodeId, y: Option<NodeId> },
    /// `Select(c, a, b)`: a where c holds, else b.
    Select(NodeId, NodeId, NodeId),
    /// A condition that is known.
    Truth(bool),
    /// A condition on numbers.
    Compare(Comparison, NodeId, NodeId),
    /// A condition on a condition.
    Not(NodeId),
    /// Both.
    And(NodeId, NodeId),
    /// At least one.
    Or(NodeId, NodeId),
}

impl Op {
    /// True if it gives a condition, not a number.
    pub(crate) fn is_condition(&self) -> bool {
        matches!(
            self,
            Self::Truth(_) | Self::Compare(..) | Self::Not(_) | Self::And(..) | Self::Or(..)
        )
    }

    /// The number it is, if it is one whatever the inputs.
    pub(crate) fn value(&self) -> Option<f64> {
        match self {
            Self::Constant(bits) => Some(f64::from_bits(*bits)),
            _ => None,
        }
    }

    /// The operands, in order.
    fn operands_mut(&mut self) -> impl Iterator<Item = &mut NodeId> {
        let array = match self {
            Self::Constant(_) | Self::Input(_) | Self::Truth(_) => [None, None, None],
            Self::Unary(_, a) | Self::Power(a, _) | Self::Not(a) => [Some(a), None, None],
            Self::Binary(_, a, b) | Self::Compare(_, a, b) | Self::And(a, b) | Self::Or(a, b) => {
                [Some(a), Some(b), None]
            }
            Self::Table { x, y, .. } => [Some(x), y.as_mut(), None],
            Self::Select(c, a, b) => [Some(c), Some(a), Some(b)],
        };
        array.into_iter().flatten()
    }

    /// The operands, in order.
    pub(crate) fn operands(mut self) -> impl Iterator<Item = NodeId> {
        let mut array = [None; 3];
        array.iter_mut().zip(self.operands_mut()).for_each(|(to, operand)| *to = Some(*operand));
        array.into_iter().flatten()
    }

    /// Returns the operation on other operands.
    fn renumbered(mut self, new: impl Fn(NodeId) -> NodeId) -> Self {
        self.operands_mut().for_each(|operand| *operand = new(*operand));
        self
    }
}

/// Integer exponents up to this become products. Their error grows with the exponent; beyond this
/// one `powf` is both quicker and more accurate.
const MAX_INTEGER_POWER: f64 = 16.0;

/// A growing set of distinct nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    tables: Arc<[Arc<Table>]>,
    ops: Vec<Op>,
    known: HashMap<Op, NodeId>,
}

impl Graph {
    /// No nodes; the tables that later ones may use.
    pub(crate) fn new(tables: Arc<[Arc<Table>]>) -> Self {
        Self { tables, ops: Vec::new(), known: HashMap::new() }
    }

    /// The tables, in the order of the scope.
    pub(crate) fn tables(&self) -> &Arc<[Arc<Table>]> {
        &self.tables
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.ops.len()
    }

    /// The operation of a node.
    pub(crate) fn op(&self, id: NodeId) -> Op {
        self.ops[id.index()]
    }

    /// The number a node is, if it is one whatever the inputs.
    pub(crate) fn value(&self, id: NodeId) -> Option<f64> {
        self.op(id).value()
    }

    fn node(&mut self, op: Op) -> NodeId {
        *self.known.entry(op).or_insert_with(|| {
            let id = u32::try_from(self.ops.len()).expect("MAX_NODES is far below 2³²");
            self.ops.push(op);
            NodeId(id)
        })
    }

    /// A number.
    pub(crate) fn constant(&mut self, value: f64) -> NodeId {
        // one NaN for all, so that equal constants are one node
        let value = if value.is_nan() { f64::NAN } else { value };
        self.node(Op::Constant(value.to_bits()))
    }

    /// A variable.
    pub(crate) fn input(&mut self, index: u32) -> NodeId {
        self.node(Op::Input(index))
    }

    /// A function of a number.
    pub(crate) fn unary(&mut self, op: Unary, a: NodeId) -> NodeId {
        if let Some(value) = self.value(a) {
            return self.constant(op.apply(value));
        }
        match (op, self.op(a)) {
            (Unary::Neg, Op::Unary(Unary::Neg, inner)) => inner,
            _ => self.node(Op::Unary(op, a)),
        }
    }

    /// −a.
    pub(crate) fn neg(&mut self, a: NodeId) -> NodeId {
        self.unary(Unary::Neg, a)
    }

    /// A function of two numbers.
    pub(crate) fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        if let (Some(a), Some(b)) = (self.value(a), self.value(b)) {
            return self.constant(op.apply(a, b));
        }
        match op {
            Binary::Add => self.add(a, b),
            Binary::Sub => self.sub(a, b),
            Binary::Mul => self.mul(a, b),
            Binary::Div => self.div(a, b),
            Binary::Pow => self.pow(a, b),
            Binary::Atan2 | Binary::Min | Binary::Max | Binary::Hypot => {
                self.node(Op::Binary(op, a, b))
            }
        }
    }

    fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.negated(a), self.negated(b)) {
            (_, Some(b)) => self.binary(Binary::Sub, a, b),
            (Some(a), None) => self.binary(Binary::Sub, b, a),
            (None, None) => self.node(Op::Binary(Binary::Add, a.min(b), a.max(b))),
        }
    }

    fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.negated(b) {
            Some(b) => self.binary(Binary::Add, a, b),
            None if self.is(b, 0.0) => a,
            None => self.node(Op::Binary(Binary::Sub, a, b)),
        }
    }

    fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        for (a, b) in [(a, b), (b, a)] {
            if self.is(a, 1.0) {
                return b;
            }
            if self.is(a, -1.0) {
                return self.neg(b);
            }
            if let Some(a) = self.negated(a) {
                let product = self.binary(Binary::Mul, a, b);
                return self.neg(product);
            }
        }
        if a == b {
            return self.power(a, 2);
        }
        self.node(Op::Binary(Binary::Mul, a.min(b), a.max(b)))
    }

    fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(reciprocal) = self.value(b).and_then(exact_reciprocal) {
            let reciprocal = self.constant(reciprocal);
            return self.binary(Binary::Mul, a, reciprocal);
        }
        let (numerator, denominator) = (self.negated(a), self.negated(b));
        if numerator.is_none() && denominator.is_none() {
            return self.node(Op::Binary(Binary::Div, a, b));
        }
        let quotient = self.binary(Binary::Div, numerator.unwrap_or(a), denominator.unwrap_or(b));
        if numerator.is_some() && denominator.is_some() { quotient } else { self.neg(quotient) }
    }

    fn pow(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.value(b) {
            Some(0.5) => self.unary(Unary::Sqrt, a),
            Some(n) if n.fract() == 0.0 && n.abs() <= MAX_INTEGER_POWER => self.power(a, n as i32),
            _ => self.node(Op::Binary(Binary::Pow, a, b)),
        }
    }

    /// aⁿ.
    pub(crate) fn power(&mut self, a: NodeId, n: i32) -> NodeId {
        match (n, self.value(a)) {
            (0, _) => self.constant(1.0),
            (1, _) => a,
            (_, Some(value)) => self.constant(power(value, n)),
            (_, None) => self.node(Op::Power(a, n)),
        }
    }

    /// A derivative of a table; `y` if it has two arguments.
    pub(crate) fn table(
        &mut self,
        table: u32,
        orders: [u8; 2],
        x: NodeId,
        y: Option<NodeId>,
    ) -> NodeId {
        // cubics: beyond the third derivative there is nothing
        if orders[0] > 3 || orders[1] > 3 {
            return self.constant(0.0);
        }
        if let (Some(x), Some(y)) = (self.value(x), y.map_or(Some(0.0), |y| self.value(y))) {
            let value = self.tables[table as usize].derivative(orders, x, y);
            return self.constant(value);
        }
        self.node(Op::Table { table, orders, x, y })
    }

    /// The node whose negative `a` is, if it is made so.
    fn negated(&self, a: NodeId) -> Option<NodeId> {
        match self.op(a) {
            Op::Unary(Unary::Neg, inner) => Some(inner),
            _ => None,
        }
    }

    fn is(&self, a: NodeId, value: f64) -> bool {
        self.op(a) == Op::Constant(value.to_bits())
    }

    /// A condition that is known.
    pub(crate) fn truth(&mut self, holds: bool) -> NodeId {
        self.node(Op::Truth(holds))
    }

    fn known_truth(&self, c: NodeId) -> Option<bool> {
        match self.op(c) {
            Op::Truth(holds) => Some(holds),
            _ => None,
        }
    }

    /// A comparison.
    pub(crate) fn compare(&mut self, op: Comparison, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(a), Some(b)) => self.truth(op.holds(a, b)),
            _ => self.node(Op::Compare(op, a, b)),
        }
    }

    /// The opposite condition.
    pub(crate) fn not(&mut self, c: NodeId) -> NodeId {
        match self.op(c) {
            Op::Truth(holds) => self.truth(!holds),
            Op::Not(inner) => inner,
            _ => self.node(Op::Not(c)),
        }
    }

    /// Both conditions.
    pub(crate) fn and(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.joined(true, a, b, Op::And)
    }

    /// At least one condition.
    pub(crate) fn or(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.joined(false, a, b, Op::Or)
    }

    /// Two conditions joined by an operation that `neutral` does not change.
    fn joined(
        &mut self,
        neutral: bool,
        a: NodeId,
        b: NodeId,
        op: fn(NodeId, NodeId) -> Op,
    ) -> NodeId {
        match (self.known_truth(a), self.known_truth(b)) {
            (Some(known), _) if known == neutral => b,
            (_, Some(known)) if known == neutral => a,
            (None, None) if a == b => a,
            (None, None) => self.node(op(a.min(b), a.max(b))),
            _ => self.truth(!neutral),
        }
    }

    /// a where c holds, else b.
    pub(crate) fn select(&mut self, c: NodeId, a: NodeId, b: NodeId) -> NodeId {
        match self.op(c) {
            _ if a == b => a,
            Op::Truth(true) => a,
            Op::Truth(false) => b,
            Op::Not(c) => self.node(Op::Select(c, b, a)),
            _ => self.node(Op::Select(c, a, b)),
        }
    }

    /// For each node up to the last root, whether a root needs it.
    pub(crate) fn needed(&self, roots: &[NodeId]) -> Vec<bool> {
        let end = roots.iter().max().map_or(0, |last| last.index() + 1);
        let mut needed = vec![false; end];
        for root in roots {
            needed[root.index()] = true;
        }
        for node in (0..end).rev() {
            if needed[node] {
                self.ops[node].operands().for_each(|operand| needed[operand.index()] = true);
            }
        }
        needed
    }

    /// The part of the graph that the roots need, numbered again without gaps, and the roots in it.
    pub(crate) fn extract(&self, roots: &[NodeId]) -> (Vec<Op>, Vec<NodeId>) {
        let mut number = vec![NodeId(0); self.len()];
        let mut ops = Vec::new();
        for (old, _) in self.needed(roots).into_iter().enumerate().filter(|&(_, needed)| needed) {
            number[old] = NodeId(u32::try_from(ops.len()).expect("not more than in the graph"));
            ops.push(self.ops[old].renumbered(|operand| number[operand.index()]));
        }
        (ops, roots.iter().map(|root| number[root.index()]).collect())
    }

    /// Adds extracted operations; gives the node of each.
    pub(crate) fn absorb(&mut self, ops: &[Op]) -> Vec<NodeId> {
        self.absorb_with(ops, &BTreeMap::new())
    }

    /// [`Graph::absorb`] with nodes in place of some inputs.
    pub(crate) fn absorb_with(
        &mut self,
        ops: &[Op],
        inputs: &BTreeMap<u32, NodeId>,
    ) -> Vec<NodeId> {
        let mut nodes = Vec::with_capacity(ops.len());
        for op in ops {
            let given = if let Op::Input(index) = op { inputs.get(index) } else { None };
            let node = given.copied();
            nodes.push(node.unwrap_or_else(|| self.on_operands(*op, |old| nodes[old.index()])));
        }
        nodes
    }

    /// The node of an operation on other operands, folded and with these in order.
    pub(crate) fn on_operands(&mut self, op: Op, new: impl Fn(NodeId) -> NodeId) -> NodeId {
        match op.renumbered(new) {
            op @ (Op::Constant(_) | Op::Input(_) | Op::Truth(_)) => self.node(op),
            Op::Unary(op, a) => self.unary(op, a),
            Op::Power(a, n) => self.power(a, n),
            Op::Binary(op, a, b) => self.binary(op, a, b),
            Op::Table { table, orders, x, y } => self.table(table, orders, x, y),
            Op::Select(c, a, b) => self.select(c, a, b),
            Op::Compare(op, a, b) => self.compare(op, a, b),
            Op::Not(c) => self.not(c),
            Op::And(a, b) => self.and(a, b),
            Op::Or(a, b) => self.or(a, b),
        }
    }

    /// The graph of extracted operations, with the same numbers.
    pub(crate) fn from_ops(ops: &[Op], tables: Arc<[Arc<Table>]>) -> Self {
        let known = (0..).zip(ops).map(|(id, &op)| (op, NodeId(id))).collect();
        Self { tables, ops: ops.to_vec(), known }
    }
}

/// 1/b if multiplying with it is the same as dividing by b: for powers of two.
pub(crate) fn exact_reciprocal(b: f64) -> Option<f64> {
    const MANTISSA: u64 = (1 << 52) - 1;
    let reciprocal = 1.0 / b;
    let is_power_of_two = b.is_normal() && reciprocal.is_normal() && b.to_bits() & MANTISSA == 0;
    is_power_of_two.then_some(reciprocal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_expressions_are_one_node() {
        let mut g = Graph::default();
        let (x, y) = (g.input(0), g.input(1));
        let a = g.binary(Binary::Mul, x, y);
        let b = g.binary(Binary::Mul, y, x);
        assert_eq!(a, b);
        let (sa, sb) = (g.unary(Unary::Sin, a), g.unary(Unary::Sin, b));
        assert_eq!(sa, sb);
        assert_eq!(g.len(), 4);
    }

    #[test]
    fn constants_fold_and_zero_times_x_stays() {
        let mut g = Graph::default();
        let x = g.input(0);
        let (zero, one, two) = (g.constant(0.0), g.constant(1.0), g.constant(2.0));
        let four = g.binary(Binary::Mul, two, two);
        assert_eq!(g.value(four), Some(4.0));
        assert_eq!(g.binary(Binary::Mul, one, x), x);
        let product = g.binary(Binary::Mul, zero, x);
        assert!(matches!(g.op(product), Op::Binary(Binary::Mul, ..)));
        let half = g.binary(Binary::Div, x, two);
        assert!(matches!(g.op(half), Op::Binary(Binary::Mul, ..)));
        let third = {
            let c = g.constant(3.0);
            g.binary(Binary::Div, x, c)
        };
        assert!(matches!(g.op(third), Op::Binary(Binary::Div, ..)));
    }

    #[test]
    fn extraction_drops_what_no_root_needs() {
        let mut g = Graph::default();
        let (x, y) = (g.input(0), g.input(1));
        let _unused = g.unary(Unary::Exp, y);
        let root = g.unary(Unary::Sin, x);
        let (ops, roots) = g.extract(&[root]);
        assert_eq!(ops, [Op::Input(0), Op::Unary(Unary::Sin, NodeId(0))]);
        assert_eq!(roots, [NodeId(1)]);
        let again = Graph::from_ops(&ops, Arc::default());
        assert_eq!(again.extract(&roots), (ops, roots));
    }
}
