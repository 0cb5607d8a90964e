//! Quotients by the same number as products with its reciprocal.
//!
//! Derivatives have many of them: each partial derivative of √u is one by 2√u, of a/b one by b. A
//! division costs as much as ten multiplications, so where two or more have the denominator in
//! common, a/b becomes a · (1/b); a power of two in the denominator goes with the numerator. This
//! rounds once more, and 1/b is infinite where |b| < 2⁻¹⁰²⁴; infinities, zeros and NaN are
//! otherwise what they were. Quotients that *values* need stay, so that values are those of the
//! formula alone, to the last bit.

use std::collections::HashMap;

use crate::graph::{Graph, NodeId, Op};
use crate::operation::Binary;

/// Rewrites what `outputs` need, except for what `values`, some of them, need.
pub(crate) fn share_reciprocals(graph: &mut Graph, values: &[NodeId], outputs: &mut [NodeId]) {
    let (needed, kept) = (graph.needed(outputs), graph.needed(values));
    let is_kept = |node: usize| kept.get(node).copied().unwrap_or(false);
    let divisions = |graph: &Graph, node: usize| match graph.op(NodeId(node as u32)) {
        Op::Binary(Binary::Div, a, b) if !is_kept(node) => Some((a, Denominator::new(graph, b))),
        _ => None,
    };
    let mut uses: HashMap<NodeId, u32> = HashMap::new();
    for node in (0..needed.len()).filter(|&node| needed[node]) {
        if let Some((_, denominator)) = divisions(graph, node) {
            *uses.entry(denominator.base).or_default() += 1;
        }
    }
    let mut new: Vec<NodeId> = Vec::with_capacity(needed.len());
    for (node, &is_needed) in needed.iter().enumerate() {
        let id = NodeId(node as u32);
        let rewritten = if !is_needed || is_kept(node) {
            id
        } else {
            match divisions(graph, node) {
                Some((a, b)) if uses[&b.base] > 1 => {
                    b.under(graph, new[a.index()], new[b.base.index()])
                }
                _ => {
                    let op = graph.op(id);
                    graph.on_operands(op, |operand| new[operand.index()])
                }
            }
        };
        new.push(rewritten);
    }
    for output in outputs {
        *output = new[output.index()];
    }
}

/// A denominator `base` / `factor`, the factor a power of two.
struct Denominator {
    base: NodeId,
    factor: f64,
}

impl Denominator {
    fn new(graph: &Graph, b: NodeId) -> Self {
        if let Op::Binary(Binary::Mul, c, d) = graph.op(b) {
            for (constant, base) in [(c, d), (d, c)] {
                let factor = graph.value(constant).and_then(super::graph::exact_reciprocal);
                if let Some(factor) = factor {
                    return Self { base, factor };
                }
            }
        }
        Self { base: b, factor: 1.0 }
    }

    /// a / self as a product; `base` is the node that its own has become.
    fn under(&self, graph: &mut Graph, a: NodeId, base: NodeId) -> NodeId {
        let (one, factor) = (graph.constant(1.0), graph.constant(self.factor));
        let reciprocal = graph.binary(Binary::Div, one, base);
        let scaled = graph.binary(Binary::Mul, factor, reciprocal);
        graph.binary(Binary::Mul, a, scaled)
    }
}
