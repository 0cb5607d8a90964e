//! Program → text of the language, from which the same program can be parsed again.

use std::collections::HashSet;

use crate::graph::{NodeId, Op};
use crate::language::ast::precedence;
use crate::language::scope::Scope;
use crate::library::{LibraryFunction, name_of};
use crate::operation::{Binary, Unary};
use crate::program::FormulaProgram;

/// Longer or deeper pieces of text get a name by `let`, as shared ones do: it keeps the text
/// readable, and within the parser's limit of nesting.
const MAX_PIECE: usize = 100;
const MAX_PIECE_DEPTH: usize = 20;

/// The text of a program with one output.
pub(crate) fn print(program: &FormulaProgram, scope: &Scope) -> String {
    let root = program.outputs()[0];
    let mut printer = Printer::new(program, scope);
    for (index, &op) in program.ops().iter().enumerate() {
        let piece = match printer.defined[index] {
            Some(name) => atom(name.to_owned(), 1),
            None => printer.piece(op),
        };
        let large = piece.text.len() > MAX_PIECE || piece.depth > MAX_PIECE_DEPTH;
        let shared = printer.uses[index] > 1 && !printer.is_leaf(index, op);
        let part = index != root.index() && printer.uses[index] > 0;
        let piece = if part && (shared || large) { printer.name(&piece) } else { piece };
        printer.pieces.push(piece);
    }
    let value = &printer.pieces[root.index()].text;
    format!("{}{value}", printer.bindings)
}

/// Text of a subexpression.
#[derive(Clone)]
struct PrintedTerm {
    text: String,
    /// Precedence of its outermost operator.
    strength: u8,
    depth: usize,
}

struct Printer<'a> {
    inputs: Vec<&'a str>,
    tables: Vec<&'a str>,
    taken: HashSet<&'a str>,
    /// The scope's text of each operation, if it is a function that the scope defines.
    defined: Vec<Option<&'static str>>,
    /// True for operations that are numbers.
    numbers: Vec<bool>,
    /// Number of texts that the text of each operation is part of.
    uses: Vec<u32>,
    pieces: Vec<PrintedTerm>,
    bindings: String,
    n_names: usize,
}

impl<'a> Printer<'a> {
    fn new(program: &FormulaProgram, scope: &'a Scope) -> Self {
        let defined = defined(program, scope);
        let uses = uses(program, &defined);
        Self {
            inputs: scope.inputs().collect(),
            tables: scope.table_names().collect(),
            taken: scope.names().chain(scope.table_names()).collect(),
            defined,
            numbers: program.ops().iter().map(|op| op.value().is_some()).collect(),
            uses,
            pieces: Vec::new(),
            bindings: String::new(),
            n_names: 0,
        }
    }

    /// True if the text is as short as a name.
    fn is_leaf(&self, index: usize, op: Op) -> bool {
        matches!(op, Op::Constant(_) | Op::Input(_)) || self.defined[index].is_some()
    }

    /// Binds a piece to a new name.
    fn name(&mut self, piece: &PrintedTerm) -> PrintedTerm {
        let name = loop {
            self.n_names += 1;
            let name = format!("s{}", self.n_names);
            if !self.taken.contains(name.as_str()) {
                break name;
            }
        };
        self.bindings.push_str(&format!("let {name} = {};\n", piece.text));
        atom(name, 0)
    }

    fn piece(&mut self, op: Op) -> PrintedTerm {
        match op {
            Op::Constant(bits) => number(f64::from_bits(bits)),
            Op::Input(index) => atom(self.inputs[index as usize].to_owned(), 0),
            Op::Unary(Unary::Neg, a) => self.prefix("-", a, precedence::POWER, precedence::MINUS),
            Op::Unary(op, a) => self.call(LibraryFunction::Unary(op), &[a]),
            Op::Power(a, n) => {
                let (a, n) = (self.operand(a, precedence::ATOM), number(f64::from(n)));
                let power = joined(&a, "^", &enclosed(n, precedence::ATOM), precedence::POWER);
                PrintedTerm { depth: a.depth, ..power }
            }
            Op::Binary(op, a, b) => self.binary(op, a, b),
            Op::Table { table, orders, x, y } => self.table(table as usize, orders, x, y),
            Op::Select(c, a, b) => self.call(LibraryFunction::If, &[c, a, b]),
            Op::Truth(holds) => PrintedTerm {
                text: if holds { "0 == 0" } else { "0 == 1" }.to_owned(),
                strength: precedence::COMPARISON,
                depth: 0,
            },
            Op::Compare(op, a, b) => {
                self.infix(a, &format!(" {} ", op.symbol()), b, precedence::COMPARISON)
            }
            Op::Not(a) => self.prefix("not ", a, precedence::COMPARISON, precedence::NOT),
            Op::And(a, b) => self.infix(a, " and ", b, precedence::AND),
            Op::Or(a, b) => self.infix(a, " or ", b, precedence::OR),
        }
    }

    fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> PrintedTerm {
        match op {
            Binary::Add => self.infix(a, " + ", b, precedence::SUM),
            Binary::Sub => self.infix(a, " - ", b, precedence::SUM),
            // a number goes first; the graph keeps the factors in any order
            Binary::Mul if self.numbers[b.index()] => self.infix(b, "*", a, precedence::PRODUCT),
            Binary::Mul => self.infix(a, "*", b, precedence::PRODUCT),
            Binary::Div => self.infix(a, "/", b, precedence::PRODUCT),
            Binary::Pow => {
                let [a, b] = [a, b].map(|part| self.operand(part, precedence::ATOM));
                joined(&a, "^", &b, precedence::POWER)
            }
            Binary::Atan2 | Binary::Min | Binary::Max | Binary::Hypot => {
                self.call(LibraryFunction::Binary(op), &[a, b])
            }
        }
    }

    /// `a sign b`, grouped from the left; comparisons group neither way.
    fn infix(&mut self, a: NodeId, sign: &str, b: NodeId, strength: u8) -> PrintedTerm {
        let left = strength + u8::from(strength == precedence::COMPARISON);
        let (a, b) = (self.operand(a, left), self.operand(b, strength + 1));
        joined(&a, sign, &b, strength)
    }

    fn prefix(&mut self, sign: &str, a: NodeId, weakest: u8, strength: u8) -> PrintedTerm {
        let a = self.operand(a, weakest);
        PrintedTerm { text: format!("{sign}{}", a.text), strength, depth: a.depth + 1 }
    }

    fn call(&self, function: LibraryFunction, arguments: &[NodeId]) -> PrintedTerm {
        self.call_with(function, Vec::new(), arguments)
    }

    /// A call with some texts before its arguments.
    fn call_with(
        &self,
        function: LibraryFunction,
        mut texts: Vec<String>,
        arguments: &[NodeId],
    ) -> PrintedTerm {
        let pieces = || arguments.iter().map(|&a| &self.pieces[a.index()]);
        let depth = pieces().map(|piece| piece.depth).max().unwrap_or(0);
        texts.extend(pieces().map(|piece| piece.text.clone()));
        atom(format!("{}({})", name_of(function), texts.join(", ")), depth + 1)
    }

    /// `table(name, x, y)` or `dtable(name, m, n, x, y)`.
    fn table(&self, table: usize, orders: [u8; 2], x: NodeId, y: Option<NodeId>) -> PrintedTerm {
        let arguments: Vec<NodeId> = [x].into_iter().chain(y).collect();
        let mut texts = vec![self.tables[table].to_owned()];
        if orders == [0, 0] {
            return self.call_with(LibraryFunction::Table, texts, &arguments);
        }
        texts.extend(orders[..arguments.len()].iter().map(u8::to_string));
        self.call_with(LibraryFunction::TableDerivative, texts, &arguments)
    }

    /// The text of an operand, in parentheses if it binds less tightly than `weakest`.
    fn operand(&self, id: NodeId, weakest: u8) -> PrintedTerm {
        enclosed(self.pieces[id.index()].clone(), weakest)
    }
}

/// The names of the operations that are functions which the scope defines.
fn defined(program: &FormulaProgram, scope: &Scope) -> Vec<Option<&'static str>> {
    let mut names = vec![None; program.ops().len()];
    let definitions = scope.definitions(&mut program.graph());
    for (index, node) in definitions.into_iter().enumerate() {
        // a node beyond the program is not part of it
        if let Some(name) = names.get_mut(node.index()) {
            *name = Some(scope.defined_name(index));
        }
    }
    names
}

/// Number of needed texts that show each operation as an operand.
fn uses(program: &FormulaProgram, defined: &[Option<&str>]) -> Vec<u32> {
    let mut uses = vec![0; program.ops().len()];
    let root = program.outputs()[0].index();
    for (index, op) in program.ops().iter().enumerate().rev() {
        if (index == root || uses[index] > 0) && defined[index].is_none() {
            op.operands().for_each(|operand| uses[operand.index()] += 1);
        }
    }
    uses
}

/// A text, in parentheses if it binds less tightly than `weakest`.
fn enclosed(piece: PrintedTerm, weakest: u8) -> PrintedTerm {
    if piece.strength >= weakest {
        return piece;
    }
    atom(format!("({})", piece.text), piece.depth + 1)
}

fn joined(a: &PrintedTerm, sign: &str, b: &PrintedTerm, strength: u8) -> PrintedTerm {
    let depth = a.depth.max(b.depth);
    PrintedTerm { text: format!("{}{sign}{}", a.text, b.text), strength, depth }
}

fn atom(text: String, depth: usize) -> PrintedTerm {
    PrintedTerm { text, strength: precedence::ATOM, depth }
}

/// The shortest text that gives the same number; infinities and NaN as quotients.
fn number(value: f64) -> PrintedTerm {
    let quotient =
        |text: &str| PrintedTerm { text: text.to_owned(), strength: precedence::PRODUCT, depth: 0 };
    if value.is_nan() {
        return quotient("0/0");
    }
    if value.is_infinite() {
        return quotient(if value > 0.0 { "1/0" } else { "-1/0" });
    }
    let text = format!("{value:?}");
    let text = text.strip_suffix(".0").unwrap_or(&text).to_owned();
    let strength = if text.starts_with('-') { precedence::MINUS } else { precedence::ATOM };
    PrintedTerm { text, strength, depth: 0 }
}
