//! Kinks, jumps and singularities of a formula.
//!
//! The places follow from the operations of the value: |u| has a kink where u = 0, `if(a < b, …)`
//! may jump where a = b, `floor(u)` where u is whole, a table is bent at the ends of its range.
//! Zero sets are taken apart: those of products are the factors', those of powers and roots the
//! bases', positive functions have none, |u| = c where u = ±c, and max(a, b) = c only where a = c
//! or b = c. So sets may be larger than the kinks, but most are lines.

mod roots;

use std::collections::HashSet;
use std::f64::consts::PI;
use std::sync::Arc;

use crate::formula::Formula;
use crate::graph::{Graph, NodeId, Op};
use crate::operation::{Binary, Comparison, Unary};
use crate::print;
use crate::program::FormulaProgram;
use roots::Scan;

/// Most kinks of a formula that are looked for, and most operations of all together. A formula with
/// more is not drawn by hand, and no quadrature could follow it.
const MAX_KINKS: usize = 1024;
const MAX_OPERATIONS: usize = 1 << 16;

/// Most sets that are collected, with those that turn out to be equal.
const MAX_SETS: usize = 4 * MAX_KINKS;

/// A set on which a formula may have a kink or a jump.
#[derive(Clone, Debug)]
pub struct Kink {
    /// A formula of the same scope; the set is where it vanishes.
    pub value: Formula,
    /// The u of `floor(u)`: the set is where it is a whole number.
    steps: Option<Formula>,
}

impl Kink {
    /// \[a, b, c\] if the set is the line a x + b y + c = 0 of the independent variables x and y.
    #[must_use]
    pub fn line(&self) -> Option<[f64; 3]> {
        let [x, y] = ["x", "y"].map(|name| self.value.independent(name).ok());
        let affine = affine(&self.value)?;
        Some([affine[x?], affine[y?], affine[affine.len() - 1]])
    }

    /// The places in \[lo, hi\] at which a formula of one variable meets the set.
    fn places(&self, lo: f64, hi: f64) -> Vec<f64> {
        let formula = self.steps.as_ref().unwrap_or(&self.value);
        let scan = Scan { formula, range: [lo, hi], steps: self.steps.is_some() };
        match affine(formula).as_deref() {
            Some(&[slope, constant]) => scan.of_line(slope, constant),
            _ => scan.of_curve(),
        }
    }
}

impl Formula {
    /// The sets where the value may have a kink or a jump, from its operations: zeros of the
    /// arguments of `abs` and `sign`, of a − b in `min`, `max` and inequalities, of y in
    /// `atan2(y, x)`; whole numbers under `floor`; ends of the ranges of tables. Constants are left
    /// out, equal sets given once. Conditions with `==` and `!=` are taken for exceptions that make
    /// no kink.
    ///
    /// A jump across the cut of theta, see [`Formula::uses_branch`], or across a crack, where
    /// `side` is used, is not among them: these sets are the frame's and the crack's. Beyond 1024
    /// kinks the rest is left out.
    ///
    /// ```
    /// use ppum_formula::{Formula, Scope};
    ///
    /// let f = Formula::parse("abs(2*x - y)*max(1 - r^2, 0)", &Scope::polar()).expect("a formula");
    /// let kinks = f.kinks();
    /// assert_eq!(kinks[0].line(), Some([2.0, -1.0, 0.0]));
    /// assert_eq!(kinks[1].value.text(), "1 - r^2");
    /// ```
    #[must_use]
    pub fn kinks(&self) -> Vec<Kink> {
        self.sets(Sets::kinks)
    }

    /// The sets where the value or one of its derivatives may be infinite or undefined, from its
    /// operations: zeros of the arguments of roots, logarithms, `hypot` and powers that are not
    /// whole and positive, of denominators, of 1 − u² under `asin` and `acos`. They are found as
    /// those of [`Formula::kinks`].
    #[must_use]
    pub fn singularities(&self) -> Vec<Kink> {
        self.sets(Sets::singularities)
    }

    /// The sets in which a spike, a ridge or a layer may sit that is too narrow for samples to show
    /// it, from the operations: zeros of what is raised to an even power, and of the arguments of
    /// `exp`, `cosh`, `tanh` and `atan`. They are found as those of [`Formula::kinks`]; the value
    /// is smooth there.
    ///
    /// ```
    /// use ppum_formula::{Formula, Scope};
    ///
    /// let bump = Formula::parse("exp(-((x - 0.3)/1e-4)^2)", &Scope::cartesian()).expect("a formula");
    /// assert_eq!(bump.crests()[0].line(), Some([1.0, 0.0, -0.3]));
    /// ```
    #[must_use]
    pub fn crests(&self) -> Vec<Kink> {
        self.sets(Sets::crests)
    }

    /// The places in \[lo, hi\] where a formula of one variable may not be smooth, increasing:
    /// where it meets its [`kinks`](Self::kinks) and [`singularities`](Self::singularities). Those
    /// of linear functions are exact, the others are searched among 4096 intervals and refined to
    /// rounding; the search for those of one function ends after some thousand.
    ///
    /// # Panics
    /// When the scope has more than one input.
    #[must_use]
    pub fn breakpoints(&self, lo: f64, hi: f64) -> Vec<f64> {
        assert_eq!(self.scope.n_inputs(), 1, "breakpoints are places of one variable");
        if !(lo <= hi && (hi - lo).is_finite()) {
            return Vec::new();
        }
        let sets = self.kinks().into_iter().chain(self.singularities());
        let mut places: Vec<f64> = sets.flat_map(|set| set.places(lo, hi)).collect();
        places.sort_by(f64::total_cmp);
        // the same place, found in two ways
        let rounding = 8.0 * f64::EPSILON * lo.abs().max(hi.abs());
        places.dedup_by(|b, a| *b - *a <= rounding);
        places
    }

    /// True if it uses the polar coordinates: then the origin of the frame may be a singular point.
    #[must_use]
    pub fn singular_at_origin(&self) -> bool {
        self.uses("r") || self.uses_branch()
    }

    /// True if it uses θ itself or an odd multiple of θ/2: then it may jump on the cut of θ, in a
    /// fixed frame the negative x axis.
    #[must_use]
    pub fn uses_branch(&self) -> bool {
        ["theta", "cos(theta/2)", "sin(theta/2)"].into_iter().any(|name| self.uses(name))
    }

    fn sets(&self, find: impl Fn(&mut Sets, Op)) -> Vec<Kink> {
        let mut sets = Sets::new(self.program.graph());
        for &op in self.program.ops() {
            find(&mut sets, op);
        }
        let mut kinks = Sieve::default();
        for set in sets.found {
            let kink = self.kink(&mut sets.graph, set);
            if !kinks.take(kink) {
                break;
            }
        }
        kinks.found
    }

    fn kink(&self, graph: &mut Graph, set: NodeSet) -> Kink {
        match set {
            NodeSet::Zero(node) => Kink { value: self.part(graph, node), steps: None },
            NodeSet::Whole(node) => {
                let pi = graph.constant(PI);
                let turn = graph.binary(Binary::Mul, pi, node);
                let wave = graph.unary(Unary::Sin, turn);
                Kink { value: self.part(graph, wave), steps: Some(self.part(graph, node)) }
            }
        }
    }

    /// The formula of a node.
    fn part(&self, graph: &Graph, node: NodeId) -> Self {
        let program = FormulaProgram::new(graph, &[node]);
        let text = print::print(&program, &self.scope);
        Self { text, scope: Arc::clone(&self.scope), program }
    }
}

/// A set given by a node.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum NodeSet {
    Zero(NodeId),
    /// The set on which it is a whole number.
    Whole(NodeId),
}

/// The sets found so far, in order.
struct Sets {
    graph: Graph,
    found: Vec<NodeSet>,
    known: HashSet<NodeSet>,
}

impl Sets {
    fn new(graph: Graph) -> Self {
        Self { graph, found: Vec::new(), known: HashSet::new() }
    }

    fn kinks(&mut self, op: Op) {
        match op {
            Op::Unary(Unary::Abs | Unary::Sign, a) | Op::Binary(Binary::Atan2, a, _) => {
                self.zero(a)
            }
            Op::Unary(Unary::Floor, a) => self.whole(a),
            Op::Binary(Binary::Min | Binary::Max, a, b)
            | Op::Compare(Comparison::Less | Comparison::LessEqual, a, b) => self.equal(a, b),
            Op::Table { table, orders, x, y } => {
                let table = Arc::clone(&self.graph.tables()[table as usize]);
                self.knots(table.x(), orders[0], x);
                if let Some(y) = y {
                    self.knots(table.y(), orders[1], y);
                }
            }
            _ => {}
        }
    }

    fn singularities(&mut self, op: Op) {
        match op {
            Op::Unary(Unary::Sqrt | Unary::Cbrt | Unary::Log | Unary::Log10, a)
            | Op::Binary(Binary::Pow, a, _)
            | Op::Binary(Binary::Div, _, a) => self.zero(a),
            Op::Power(a, n) if n < 0 => self.zero(a),
            Op::Unary(Unary::Asin | Unary::Acos, a) => {
                for end in [1.0, -1.0] {
                    let end = self.graph.constant(end);
                    self.equal(a, end);
                }
            }
            Op::Binary(Binary::Hypot, a, b) => {
                let node = self.graph.binary(Binary::Hypot, a, b);
                self.zero(node);
            }
            _ => {}
        }
    }

    fn crests(&mut self, op: Op) {
        match op {
            Op::Unary(Unary::Exp | Unary::Cosh | Unary::Tanh | Unary::Atan, a) => self.zero(a),
            Op::Power(a, n) if n % 2 == 0 => self.zero(a),
            _ => {}
        }
    }

    /// The ends of a table's range; all knots if the spline's derivative has kinks there.
    fn knots(&mut self, knots: &[f64], order: u8, argument: NodeId) {
        let smooth = order < 2;
        let places = knots.iter().enumerate();
        let bent = places.filter(|&(k, _)| !smooth || k == 0 || k == knots.len() - 1);
        for (_, &knot) in bent {
            let knot = self.graph.constant(knot);
            self.equal(argument, knot);
        }
    }

    fn is_full(&self) -> bool {
        self.found.len() > MAX_SETS
    }

    fn equal(&mut self, a: NodeId, b: NodeId) {
        if self.is_full() {
            return;
        }
        let difference = self.graph.binary(Binary::Sub, a, b);
        self.zero(difference);
    }

    fn whole(&mut self, node: NodeId) {
        if !self.is_full()
            && self.graph.value(node).is_none()
            && self.known.insert(NodeSet::Whole(node))
        {
            self.found.push(NodeSet::Whole(node));
        }
    }

    /// w and c if the node vanishes where w = c and w is an `abs`, `min` or `max`.
    fn levelled(&mut self, node: NodeId) -> Option<(Op, NodeId)> {
        let (a, b, sign) = sum(self.graph.op(node))?;
        for (w, c) in [(a, b), (b, a)] {
            let (factor, bent) = self.bent(w);
            if let Some(bent) = bent {
                // factor · w + sign · c = 0, whichever of the two has the sign
                let factor = self.graph.constant(-sign * factor);
                return Some((bent, self.graph.binary(Binary::Div, c, factor)));
            }
        }
        None
    }

    /// A node as a multiple of an `abs`, `min` or `max`.
    fn bent(&self, node: NodeId) -> (f64, Option<Op>) {
        let is_bent = |op: &Op| {
            matches!(op, Op::Unary(Unary::Abs, _) | Op::Binary(Binary::Min | Binary::Max, ..))
        };
        let op = self.graph.op(node);
        if let Op::Binary(Binary::Mul, a, b) = op {
            for (a, b) in [(a, b), (b, a)] {
                if let Some(factor) = self.graph.value(a).filter(|&factor| factor != 0.0) {
                    return (factor, Some(self.graph.op(b)).filter(is_bent));
                }
            }
        }
        (1.0, Some(op).filter(is_bent))
    }

    /// The nodes that vanish where an `abs`, `min` or `max` has the value c.
    fn meets(&mut self, bent: Op, c: NodeId, parts: &mut Vec<NodeId>) {
        match bent {
            // |u| is nowhere negative
            Op::Unary(_, _) if self.graph.value(c).is_some_and(|c| c < 0.0) => {}
            Op::Unary(_, u) => {
                parts.push(self.graph.binary(Binary::Add, u, c));
                parts.push(self.graph.binary(Binary::Sub, u, c));
            }
            Op::Binary(_, a, b) => {
                parts.push(self.graph.binary(Binary::Sub, b, c));
                parts.push(self.graph.binary(Binary::Sub, a, c));
            }
            _ => unreachable!("no other operation is bent"),
        }
    }

    /// The zeros of a node, by those of its parts where they have the same.
    fn zero(&mut self, node: NodeId) {
        let mut parts = vec![node];
        while let Some(node) = parts.pop() {
            if self.is_full() || !self.known.insert(NodeSet::Zero(node)) {
                continue;
            }
            if let Some((bent, level)) = self.levelled(node) {
                self.meets(bent, level, &mut parts);
                continue;
            }
            match self.graph.op(node) {
                Op::Constant(_) | Op::Unary(Unary::Exp | Unary::Cosh, _) => {}
                Op::Unary(
                    Unary::Neg
                    | Unary::Abs
                    | Unary::Sign
                    | Unary::Sqrt
                    | Unary::Cbrt
                    | Unary::Sinh
                    | Unary::Tanh
                    | Unary::Asin
                    | Unary::Atan,
                    a,
                )
                | Op::Power(a, _) => parts.push(a),
                Op::Binary(Binary::Mul | Binary::Div, a, b) => parts.extend([b, a]),
                Op::Binary(Binary::Pow, a, _) => parts.push(a),
                Op::Binary(Binary::Sub, a, b) if self.graph.value(a) == Some(0.0) => parts.push(b),
                _ => self.found.push(NodeSet::Zero(node)),
            }
        }
    }
}

/// The two operands of the sum or difference that a node is, the second with its sign.
fn sum(op: Op) -> Option<(NodeId, NodeId, f64)> {
    match op {
        Op::Binary(Binary::Add, a, b) => Some((a, b, 1.0)),
        Op::Binary(Binary::Sub, a, b) => Some((a, b, -1.0)),
        _ => None,
    }
}

/// Keeps what is no constant and not there yet.
#[derive(Default)]
struct Sieve {
    found: Vec<Kink>,
    lines: HashSet<Vec<u64>>,
    operations: usize,
}

impl Sieve {
    /// False if it is full.
    fn take(&mut self, kink: Kink) -> bool {
        let steps = kink.steps.is_some();
        if let Some(affine) = affine(kink.steps.as_ref().unwrap_or(&kink.value)) {
            let variable = affine.split_last().is_some_and(|(_, c)| c.iter().any(|&c| c != 0.0));
            if !variable || !self.lines.insert(direction(&affine, steps)) {
                return true;
            }
        }
        self.operations += kink.value.program.ops().len();
        if self.found.len() == MAX_KINKS || self.operations > MAX_OPERATIONS {
            return false;
        }
        self.found.push(kink);
        true
    }
}

/// The coefficients as a key, the same for all multiples of a function if only its zeros count.
fn direction(affine: &[f64], steps: bool) -> Vec<u64> {
    let first = affine.iter().copied().find(|&c| c != 0.0).unwrap_or(1.0);
    let scale = if steps { 1.0 } else { first };
    // + 0.0 makes −0 to 0
    affine.iter().map(|c| (c / scale + 0.0).to_bits()).chain([u64::from(steps)]).collect()
}

/// The coefficients of the independent variables and the constant, if the formula is made of sums
/// and multiples of them alone.
fn affine(formula: &Formula) -> Option<Vec<f64>> {
    let n = formula.scope.independent().len();
    let mut parts: Vec<Vec<f64>> = Vec::with_capacity(formula.program.ops().len());
    for &op in formula.program.ops() {
        let constant = |v: &[f64]| v[..n].iter().all(|&c| c == 0.0).then_some(v[n]);
        let scaled = |v: &[f64], s: f64| v.iter().map(|c| c * s).collect::<Vec<f64>>();
        let joined = |a: NodeId, b: NodeId, sign: f64| {
            parts[a.index()].iter().zip(&parts[b.index()]).map(|(a, b)| a + sign * b).collect()
        };
        let mut part = vec![0.0; n + 1];
        let part = match op {
            Op::Constant(_) => {
                part[n] = op.value()?;
                part
            }
            Op::Input(input) if (input as usize) < n => {
                part[input as usize] = 1.0;
                part
            }
            Op::Unary(Unary::Neg, a) => scaled(&parts[a.index()], -1.0),
            Op::Binary(Binary::Add, a, b) => joined(a, b, 1.0),
            Op::Binary(Binary::Sub, a, b) => joined(a, b, -1.0),
            Op::Binary(Binary::Mul, a, b) => {
                let (a, b) = (&parts[a.index()], &parts[b.index()]);
                match (constant(a), constant(b)) {
                    (Some(a), _) => scaled(b, a),
                    (_, Some(b)) => scaled(a, b),
                    _ => return None,
                }
            }
            Op::Binary(Binary::Div, a, b) => {
                let divisor = constant(&parts[b.index()])?;
                parts[a.index()].iter().map(|c| c / divisor).collect()
            }
            _ => return None,
        };
        parts.push(part);
    }
    parts.pop().filter(|affine| affine.iter().all(|c| c.is_finite()))
}
