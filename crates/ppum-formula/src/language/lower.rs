//! Syntax tree → expression graph: types are checked, functions become operations.

use crate::error::{ErrorKind, FormulaError};
use crate::graph::{Graph, NodeId};
use crate::language::ast::{Ast, Expr, ExprId, ExprKind, Infix, Prefix};
use crate::language::half_angle::{self, Multiple};
use crate::language::parser::parse;
use crate::language::scope::Scope;
use crate::library::LibraryFunction;
use crate::operation::{Binary, Comparison};

/// Parses a formula and checks that its type is a number.
pub(crate) fn checked(source: &str, scope: &Scope) -> Result<Ast, FormulaError> {
    let ast = parse(source, scope)?;
    match lower(&ast, scope, &mut Graph::new(scope.tables())) {
        Ok(_) => Ok(ast),
        Err(mistake) => Err(mistake.locate(source, &ast)),
    }
}

/// A node of the wrong type.
#[derive(Debug)]
pub(crate) struct TypeErrorAt {
    expr: ExprId,
    mistake: ErrorKind,
}

impl TypeErrorAt {
    /// Converts it to an error at a place in the text.
    pub(crate) fn locate(self, source: &str, ast: &Ast) -> FormulaError {
        FormulaError::new(source, ast.nodes[self.expr.index()].span, self.mistake)
    }
}

/// Adds a formula of a scope to a graph; gives the node of its value.
pub(crate) fn lower(ast: &Ast, scope: &Scope, graph: &mut Graph) -> Result<NodeId, TypeErrorAt> {
    Lowerer::new(ast, scope, graph)?.number(ast.root)
}

/// Adds a condition to a graph; gives the node of 1 where it holds, 0 elsewhere.
pub(crate) fn lower_condition(
    ast: &Ast,
    scope: &Scope,
    graph: &mut Graph,
) -> Result<NodeId, TypeErrorAt> {
    let condition = Lowerer::new(ast, scope, graph)?.condition(ast.root)?;
    let (one, zero) = (graph.constant(1.0), graph.constant(0.0));
    Ok(graph.select(condition, one, zero))
}

impl Scope {
    /// The nodes of the functions with derivative rules of their own, added to a graph: cos θ and
    /// sin θ in polar scopes, else none.
    pub(crate) fn definitions(&self, graph: &mut Graph) -> Vec<NodeId> {
        self.defined
            .iter()
            .map(|f| lower(&f.definition, self, graph).expect("checked when it was defined"))
            .collect()
    }
}

struct Lowerer<'a> {
    graph: &'a mut Graph,
    scope: &'a Scope,
    /// The input θ, if there are half angles.
    theta: Option<u32>,
    /// The graph's node of each node of the tree so far.
    nodes: Vec<NodeId>,
    /// Each expression as a multiple of θ.
    multiples: Vec<Multiple>,
}

impl<'a> Lowerer<'a> {
    fn new(ast: &Ast, scope: &'a Scope, graph: &'a mut Graph) -> Result<Self, TypeErrorAt> {
        let theta = scope.half_angles().and_then(|_| scope.input("theta"));
        let (nodes, multiples) = (Vec::with_capacity(ast.nodes.len()), Vec::new());
        let mut lowering = Self { graph, scope, theta, nodes, multiples };
        for expr in &ast.nodes {
            let node = lowering.expr(expr)?;
            let multiple = lowering.multiple(expr, node);
            lowering.nodes.push(node);
            lowering.multiples.push(multiple);
        }
        Ok(lowering)
    }

    fn expr(&mut self, expr: &Expr) -> Result<NodeId, TypeErrorAt> {
        match &expr.kind {
            ExprKind::Number(value) => Ok(self.graph.constant(*value)),
            ExprKind::Input(index) => Ok(self.graph.input(*index)),
            ExprKind::Prefix(prefix, a) => self.prefix(*prefix, *a),
            ExprKind::Infix(infix, a, b) => self.infix(*infix, *a, *b),
            ExprKind::Call(function, arguments) => self.call(*function, arguments),
            ExprKind::Table { table, orders, x, y } => {
                let y = y.map(|y| self.number(y)).transpose()?;
                let x = self.number(*x)?;
                Ok(self.graph.table(*table, *orders, x, y))
            }
        }
    }

    fn multiple(&self, expr: &Expr, node: NodeId) -> Multiple {
        match self.graph.value(node) {
            Some(value) => Multiple::Constant(value),
            None => half_angle::multiple(&expr.kind, self.theta, |of| self.multiples[of.index()]),
        }
    }

    fn number(&self, expr: ExprId) -> Result<NodeId, TypeErrorAt> {
        self.typed(expr, false, ErrorKind::ConditionForNumber)
    }

    fn condition(&self, expr: ExprId) -> Result<NodeId, TypeErrorAt> {
        self.typed(expr, true, ErrorKind::NumberForCondition)
    }

    fn typed(
        &self,
        expr: ExprId,
        condition: bool,
        mistake: ErrorKind,
    ) -> Result<NodeId, TypeErrorAt> {
        let node = self.nodes[expr.index()];
        if self.graph.op(node).is_condition() == condition {
            Ok(node)
        } else {
            Err(TypeErrorAt { expr, mistake })
        }
    }

    fn prefix(&mut self, prefix: Prefix, a: ExprId) -> Result<NodeId, TypeErrorAt> {
        match prefix {
            Prefix::Plus => self.number(a),
            Prefix::Minus => self.number(a).map(|a| self.graph.neg(a)),
            Prefix::Not => self.condition(a).map(|a| self.graph.not(a)),
        }
    }

    fn infix(&mut self, infix: Infix, a: ExprId, b: ExprId) -> Result<NodeId, TypeErrorAt> {
        if let Infix::And | Infix::Or = infix {
            let (a, b) = (self.condition(a)?, self.condition(b)?);
            let joined =
                if infix == Infix::And { self.graph.and(a, b) } else { self.graph.or(a, b) };
            return Ok(joined);
        }
        let (a, b) = (self.number(a)?, self.number(b)?);
        let g = &mut *self.graph;
        Ok(match infix {
            Infix::And | Infix::Or | Infix::Less => g.compare(Comparison::Less, a, b),
            Infix::LessEqual => g.compare(Comparison::LessEqual, a, b),
            Infix::Greater => g.compare(Comparison::Less, b, a),
            Infix::GreaterEqual => g.compare(Comparison::LessEqual, b, a),
            Infix::Equal => g.compare(Comparison::Equal, a, b),
            Infix::NotEqual => {
                let equal = g.compare(Comparison::Equal, a, b);
                g.not(equal)
            }
            Infix::Arithmetic(op) => g.binary(op, a, b),
        })
    }

    fn call(
        &mut self,
        function: LibraryFunction,
        arguments: &[ExprId],
    ) -> Result<NodeId, TypeErrorAt> {
        match (function, arguments) {
            (LibraryFunction::Unary(op), &[argument]) => {
                let a = self.number(argument)?;
                let of = self.multiples[argument.index()];
                let products = half_angle::expand(op, of, self.scope, self.graph);
                Ok(products.unwrap_or_else(|| self.graph.unary(op, a)))
            }
            (LibraryFunction::Binary(op), &[a, b]) => {
                let (a, b) = (self.number(a)?, self.number(b)?);
                Ok(self.graph.binary(op, a, b))
            }
            (LibraryFunction::If, &[c, a, b]) => {
                let (c, a, b) = (self.condition(c)?, self.number(a)?, self.number(b)?);
                Ok(self.graph.select(c, a, b))
            }
            (LibraryFunction::Clamp, &[x, low, high]) => {
                let (x, low, high) = (self.number(x)?, self.number(low)?, self.number(high)?);
                let raised = self.graph.binary(Binary::Max, x, low);
                Ok(self.graph.binary(Binary::Min, raised, high))
            }
            _ => unreachable!("the parser counts arguments and knows tables"),
        }
    }
}
