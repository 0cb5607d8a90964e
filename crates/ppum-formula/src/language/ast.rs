//! The syntax tree of a formula, names resolved.

use crate::error::TextSpan;
use crate::library::LibraryFunction;
use crate::operation::Binary;

/// A parsed formula. Nodes stand in an arena, operands before what uses them; so a pass is a loop,
/// and neither a pass nor a drop can exhaust the stack.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ast {
    /// All nodes, also those of a `let` that nothing uses.
    pub(crate) nodes: Vec<Expr>,
    /// The whole formula.
    pub(crate) root: ExprId,
}

/// Index of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ExprId(pub(crate) u32);

impl ExprId {
    /// As an index of arrays with one entry a node.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A node and its place in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Expr {
    /// Its kind.
    pub(crate) kind: ExprKind,
    /// Its place.
    pub(crate) span: TextSpan,
}

/// The kinds of nodes. A name bound by `let` is no node: it stands for the node of its value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ExprKind {
    /// A number, a constant or a parameter.
    Number(f64),
    /// A variable: its index among the scope's inputs.
    Input(u32),
    /// A sign before an operand.
    Prefix(Prefix, ExprId),
    /// An operator between operands.
    Infix(Infix, ExprId, ExprId),
    /// A function of its arguments; their number is right.
    Call(LibraryFunction, Vec<ExprId>),
    /// A derivative of a table: its index in the scope, the orders, the arguments.
    Table { table: u32, orders: [u8; 2], x: ExprId, y: Option<ExprId> },
}

/// Operators before their operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Prefix {
    Plus,
    Minus,
    Not,
}

/// Operators between their operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Infix {
    Or,
    And,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    /// An operation of two numbers that has a sign.
    Arithmetic(Binary),
}

impl Infix {
    /// True for `<` and its like.
    pub(crate) fn is_comparison(self) -> bool {
        precedence::of(self) == precedence::COMPARISON
    }
}

/// Precedence of the operators; shared by the parser and the printer.
pub(crate) mod precedence {
    use super::{Binary, Infix};

    pub(crate) const OR: u8 = 1;
    pub(crate) const AND: u8 = 2;
    pub(crate) const NOT: u8 = 3;
    pub(crate) const COMPARISON: u8 = 4;
    pub(crate) const SUM: u8 = 5;
    pub(crate) const PRODUCT: u8 = 6;
    /// Weaker than a power: −x^2 = −(x^2).
    pub(crate) const MINUS: u8 = 7;
    pub(crate) const POWER: u8 = 8;
    /// Numbers, names, calls, parentheses.
    pub(crate) const ATOM: u8 = 9;

    /// The precedence of an operator between operands.
    pub(crate) fn of(infix: Infix) -> u8 {
        match infix {
            Infix::Or => OR,
            Infix::And => AND,
            Infix::Arithmetic(Binary::Add | Binary::Sub) => SUM,
            Infix::Arithmetic(Binary::Mul | Binary::Div) => PRODUCT,
            Infix::Arithmetic(_) => POWER,
            _ => COMPARISON,
        }
    }
}
