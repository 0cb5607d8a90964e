//! Straight-line programs: what a graph's roots need, in order of execution.

use std::sync::Arc;

use crate::graph::{Graph, NodeId, Op};
use crate::table::Table;

/// A list of operations, each the operand of later ones only, and the operations whose results
/// are wanted. It is the common form from which every back end starts; here is the scalar one.
#[derive(Clone, Debug)]
pub(crate) struct FormulaProgram {
    tables: Arc<[Arc<Table>]>,
    ops: Vec<Op>,
    outputs: Vec<NodeId>,
}

impl FormulaProgram {
    /// The program for some nodes of a graph.
    pub(crate) fn new(graph: &Graph, outputs: &[NodeId]) -> Self {
        let (ops, outputs) = graph.extract(outputs);
        Self { tables: Arc::clone(graph.tables()), ops, outputs }
    }

    /// A graph of the same operations with the same numbers, to grow further.
    pub(crate) fn graph(&self) -> Graph {
        Graph::from_ops(&self.ops, Arc::clone(&self.tables))
    }

    /// The tables its operations refer to.
    pub(crate) fn tables(&self) -> &Arc<[Arc<Table>]> {
        &self.tables
    }

    /// The operations.
    pub(crate) fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// The operations that give the results, in order.
    pub(crate) fn outputs(&self) -> &[NodeId] {
        &self.outputs
    }

    /// Computes all operations in double precision; `values` holds their results afterwards,
    /// conditions as 1 and 0.
    pub(crate) fn run(&self, inputs: &[f64], values: &mut Vec<f64>) {
        values.clear();
        values.reserve(self.ops.len());
        for &op in &self.ops {
            let value = self.execute(op, inputs, values);
            values.push(value);
        }
    }

    /// The result of one operation; `values` are those of the earlier ones.
    #[inline]
    pub(crate) fn execute(&self, op: Op, inputs: &[f64], values: &[f64]) -> f64 {
        let at = |id: NodeId| values[id.index()];
        let holds = |id: NodeId| values[id.index()] > 0.0;
        match op {
            Op::Constant(bits) => f64::from_bits(bits),
            Op::Input(index) => inputs[index as usize],
            Op::Unary(op, a) => op.apply(at(a)),
            Op::Power(a, n) => super::operation::power(at(a), n),
            Op::Binary(op, a, b) => op.apply(at(a), at(b)),
            Op::Table { table, orders, x, y } => {
                self.tables[table as usize].derivative(orders, at(x), y.map_or(0.0, at))
            }
            Op::Select(c, a, b) => at(if holds(c) { a } else { b }),
            Op::Truth(known) => truth(known),
            Op::Compare(op, a, b) => truth(op.holds(at(a), at(b))),
            Op::Not(c) => truth(!holds(c)),
            Op::And(a, b) => truth(holds(a) && holds(b)),
            Op::Or(a, b) => truth(holds(a) || holds(b)),
        }
    }
}

fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}
