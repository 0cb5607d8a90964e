//! Programs as texts of WGSL, the shading language of WebGPU.
//!
//! One function a program, straight down: a `let` for each operation, with the constants in their
//! places. Operations that WGSL has not, or leaves open, are functions of [`wgsl_prelude`].
//!
//! Names cannot collide, whatever the names of a scope: inputs with names of our own keep them,
//! others begin with `in_`, which no word of WGSL does; results are `v0`, `v1`, …, all derivatives
//! of a table at some arguments `place_0`, …; tables are functions that begin with `table_`, the
//! prelude's begin with `ppum_`.

mod number;
mod table;

use std::sync::Arc;

use crate::graph::{NodeId, Op};
use crate::language::scope::{Scope, VARIABLES};
use crate::operation::{Binary, Unary};
use crate::program::FormulaProgram;
use crate::table::Table;
use crate::wgsl::number::number;
use crate::wgsl::table::{MAX_ELEMENTS, elements};

/// The functions that the texts of [`FormulaJets::wgsl`](crate::FormulaJets::wgsl) call. A module
/// needs them once. Their names begin with `ppum_`.
#[must_use]
pub fn wgsl_prelude() -> &'static str {
    include_str!("prelude.wgsl")
}

/// Most parameters of a function that WGSL promises.
const MAX_PARAMETERS: usize = 255;

/// Formulas that are too large for WGSL.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WgslError {
    /// A table.
    #[error(
        "the table `{name}` has {elements} knots or cubics, too many to compile in WGSL; give it up to \
         {MAX_ELEMENTS}"
    )]
    Table {
        /// Its name.
        name: String,
        /// Its knots or cubics, whichever are more.
        elements: usize,
    },
    /// The inputs.
    #[error(
        "the formulas use {count} inputs together; a function of WGSL has up to {MAX_PARAMETERS}"
    )]
    Inputs {
        /// Number of inputs that are used.
        count: usize,
    },
}

/// Checks that a program with this number of parameters is within the limits of WGSL.
pub(crate) fn check(program: &FormulaProgram, count: usize) -> Result<(), WgslError> {
    if count > MAX_PARAMETERS {
        return Err(WgslError::Inputs { count });
    }
    let mut used = used_tables(program).map(|(_, table)| (table, elements(table)));
    match used.find(|(_, elements)| *elements > MAX_ELEMENTS) {
        Some((table, elements)) => {
            Err(WgslError::Table { name: table.name().to_owned(), elements })
        }
        None => Ok(()),
    }
}

/// The function of a program and those of its tables. Its parameters are the inputs whose indices
/// are `kept`.
pub(crate) fn function(
    name: &str,
    scope: &Scope,
    program: &FormulaProgram,
    kept: impl Fn(usize) -> bool,
) -> String {
    let inputs: Vec<String> = scope.inputs().map(parameter).collect();
    let mut text = tables(name, program);
    let parameters = inputs.iter().enumerate().filter(|(index, _)| kept(*index));
    let parameters: Vec<_> = parameters.map(|(_, input)| format!("{input}: f32")).collect();
    let n = program.outputs().len();
    text += &format!("fn {name}({}) -> array<f32, {n}> {{\n", parameters.join(", "));
    let (atoms, places) = (Vec::new(), Vec::new());
    let mut results = WgslResults { function: name, inputs: &inputs, atoms, lets: 0, places };
    for &op in program.ops() {
        text += &results.add(op);
    }
    let outputs: Vec<&str> = program.outputs().iter().map(|&id| results.at(id)).collect();
    text + &format!("    return array<f32, {n}>({});\n}}\n", outputs.join(", "))
}

/// The name of an input as a parameter.
fn parameter(input: &str) -> String {
    match input {
        "cos(theta/2)" => "cos_half_theta".to_owned(),
        "sin(theta/2)" => "sin_half_theta".to_owned(),
        known if VARIABLES.contains(&known) => known.to_owned(),
        other => match other.strip_prefix("side(").and_then(|rest| rest.strip_suffix(')')) {
            Some(crack) => format!("side_{crack}"),
            None => format!("in_{other}"),
        },
    }
}

/// The results so far.
struct WgslResults<'a> {
    function: &'a str,
    inputs: &'a [String],
    /// The text of each operation where it is used: a name, or a constant.
    atoms: Vec<String>,
    /// Number of `let`s.
    lets: usize,
    /// The tables and arguments whose derivatives are there: `place_0`, `place_1`, …
    places: Vec<(u32, NodeId, Option<NodeId>)>,
}

impl WgslResults<'_> {
    /// The text of an earlier operation.
    fn at(&self, id: NodeId) -> &str {
        &self.atoms[id.index()]
    }

    /// Adds an operation; gives the lines that compute it.
    fn add(&mut self, op: Op) -> String {
        let (atom, lines) = match op {
            Op::Constant(bits) => (number(f64::from_bits(bits)), String::new()),
            Op::Truth(holds) => (holds.to_string(), String::new()),
            Op::Input(index) => (self.inputs[index as usize].clone(), String::new()),
            _ => self.computed(op),
        };
        self.atoms.push(atom);
        lines
    }

    /// The name of a new result and the lines that compute it.
    fn computed(&mut self, op: Op) -> (String, String) {
        let name = format!("v{}", self.lets);
        self.lets += 1;
        let (before, value) = match op {
            Op::Power(a, n) => power(&name, self.at(a), n),
            Op::Table { table, orders, x, y } => self.table(table, orders, x, y),
            _ => (String::new(), self.expression(op)),
        };
        let lines = before + &format!("    let {name} = {value};\n");
        (name, lines)
    }

    fn expression(&self, op: Op) -> String {
        let at = |id| self.at(id);
        match op {
            Op::Constant(_) | Op::Truth(_) | Op::Input(_) | Op::Power(..) | Op::Table { .. } => {
                unreachable!("written by the callers")
            }
            Op::Unary(op, a) => unary(op, at(a)),
            Op::Binary(op, a, b) => binary(op, at(a), at(b)),
            Op::Select(c, a, b) => format!("select({}, {}, {})", at(b), at(a), at(c)),
            Op::Compare(op, a, b) => format!("{} {} {}", at(a), op.symbol(), at(b)),
            Op::Not(c) => format!("!{}", at(c)),
            // without the branches of && and ||
            Op::And(a, b) => format!("{} & {}", at(a), at(b)),
            Op::Or(a, b) => format!("{} | {}", at(a), at(b)),
        }
    }

    /// A derivative of a table, and the line that finds all of them if they are not there.
    fn table(
        &mut self,
        table: u32,
        [m, n]: [u8; 2],
        x: NodeId,
        y: Option<NodeId>,
    ) -> (String, String) {
        let known = self.places.iter().position(|&place| place == (table, x, y));
        let place = known.unwrap_or(self.places.len());
        let order = if y.is_some() { format!("[{n}][{m}]") } else { format!("[{m}]") };
        let value = format!("place_{place}{order}");
        if known.is_some() {
            return (String::new(), value);
        }
        self.places.push((table, x, y));
        let arguments: Vec<&str> = [x].into_iter().chain(y).map(|id| self.at(id)).collect();
        let (name, arguments) = (table_name(table, self.function), arguments.join(", "));
        (format!("    let place_{place} = {name}({arguments});\n"), value)
    }
}

fn unary(op: Unary, a: &str) -> String {
    if op == Unary::Neg { format!("-{a}") } else { call(op.text(), a) }
}

fn binary(op: Binary, a: &str, b: &str) -> String {
    match op {
        Binary::Add | Binary::Sub | Binary::Mul | Binary::Div => format!("{a} {} {b}", op.text()),
        Binary::Pow => call("pow", &format!("{a}, {b}")),
        _ => call(op.text(), &format!("{a}, {b}")),
    }
}

/// A function of the prelude, or of the few that WGSL has as formulas mean them.
fn call(name: &str, arguments: &str) -> String {
    let prefix = if ["sqrt", "abs", "floor"].contains(&name) { "" } else { "ppum_" };
    format!("{prefix}{name}({arguments})")
}

/// aⁿ by the products of [`power`](crate::operation::power): the lines of the squares that are
/// needed, `v3_2` being the square of what `v3` is a power of, and the product.
fn power(name: &str, a: &str, n: i32) -> (String, String) {
    let (mut lines, mut factors) = (String::new(), Vec::new());
    let (mut square, mut exponent) = (a.to_owned(), 1);
    while exponent <= n.unsigned_abs() {
        if exponent > 1 {
            let next = format!("{name}_{exponent}");
            lines += &format!("    let {next} = {square} * {square};\n");
            square = next;
        }
        if n.unsigned_abs() & exponent != 0 {
            factors.push(square.clone());
        }
        exponent *= 2;
    }
    let product = factors.join(" * ");
    (lines, if n < 0 { format!("1.0 / ({product})") } else { product })
}

fn table_name(index: u32, function: &str) -> String {
    format!("table_{index}_of_{function}")
}

/// The functions of the tables that a program uses.
fn tables(function: &str, program: &FormulaProgram) -> String {
    let text =
        |(index, table): (u32, &Arc<Table>)| table::function(&table_name(index, function), table);
    used_tables(program).map(text).collect()
}

/// The tables that a program uses, with their indices.
fn used_tables(program: &FormulaProgram) -> impl Iterator<Item = (u32, &Arc<Table>)> {
    let is_used = |index: u32| {
        program.ops().iter().any(|op| matches!(op, Op::Table { table, .. } if *table == index))
    };
    (0..).zip(program.tables().iter()).filter(move |(index, _)| is_used(*index))
}
