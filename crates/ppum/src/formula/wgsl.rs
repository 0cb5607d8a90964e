//! Programs as texts of WGSL, the shading language of WebGPU.
//!
//! One function a program, straight down: a `let` for each operation, with the constants in their places.
//! Operations that WGSL has not, or leaves open, are functions of [`wgsl_prelude`].
//!
//! Names cannot collide, whatever the names of a scope: inputs with names of our own keep them, others
//! begin with `in_`, which no word of WGSL does; results are `v0`, `v1`, …; tables are functions that
//! begin with `table_`, the prelude's begin with `ppum_`.

use std::sync::Arc;

use super::graph::{NodeId, Op};
use super::operation::{Binary, Comparison, Unary};
use super::program::Program;
use super::{Scope, Table, VARIABLES};

/// The functions that the texts of [`FormulaJets::wgsl`](super::FormulaJets::wgsl) call. A module needs
/// them once. Their names begin with `ppum_`.
#[must_use]
pub fn wgsl_prelude() -> &'static str {
    include_str!("wgsl_prelude.wgsl")
}

/// Most elements of an array that WGSL promises.
const MAX_ELEMENTS: usize = 2047;

/// Most parameters of a function that WGSL promises.
const MAX_PARAMETERS: usize = 255;

/// Formulas that are too large for WGSL.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WgslError {
    /// A table.
    #[error(
        "the table `{name}` makes an array of {elements} elements in WGSL, which has up to \
         {MAX_ELEMENTS}; give it fewer knots"
    )]
    Table {
        /// Its name.
        name: String,
        /// Elements of the longest array.
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
pub(super) fn check(program: &Program, count: usize) -> Result<(), WgslError> {
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

/// Elements of the longest array of a table: its knots, or its cubics.
fn elements(table: &Table) -> usize {
    table.x().len().max(table.y().len()).max(table.coefficients().len() / 4)
}

/// The function of a program and those of its tables. Its parameters are the inputs whose indices are
/// `kept`.
pub(super) fn function(
    name: &str,
    scope: &Scope,
    program: &Program,
    kept: impl Fn(usize) -> bool,
) -> String {
    let inputs: Vec<String> = scope.inputs().map(parameter).collect();
    let mut text = tables(name, program);
    let parameters = inputs.iter().enumerate().filter(|(index, _)| kept(*index));
    let parameters: Vec<String> = parameters.map(|(_, input)| format!("{input}: f32")).collect();
    let n = program.outputs().len();
    text += &format!("fn {name}({}) -> array<f32, {n}> {{\n", parameters.join(", "));
    let mut results = Results { function: name, inputs: &inputs, atoms: Vec::new(), lets: 0 };
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

/// A number in single precision, negative ones in parentheses. One that is not finite is made by a
/// function: as a constant expression it is an error.
fn number(value: f64) -> String {
    let value = value as f32;
    match (value.is_finite(), value.is_sign_negative()) {
        (true, false) => format!("{value:?}"),
        (true, true) => format!("({value:?})"),
        (false, _) => format!("ppum_from_bits({:#x}u)", value.to_bits()),
    }
}

/// The results so far.
struct Results<'a> {
    function: &'a str,
    inputs: &'a [String],
    /// What stands for each operation where it is used: a name, or a constant.
    atoms: Vec<String>,
    /// Number of `let`s.
    lets: usize,
}

impl Results<'_> {
    /// What stands for an earlier operation.
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
            _ => (String::new(), self.expression(op)),
        };
        let lines = before + &format!("    let {name} = {value};\n");
        (name, lines)
    }

    fn expression(&self, op: Op) -> String {
        let at = |id| self.at(id);
        match op {
            Op::Constant(_) | Op::Truth(_) | Op::Input(_) | Op::Power(..) => {
                unreachable!("written by the callers")
            }
            Op::Unary(op, a) => unary(op, at(a)),
            Op::Binary(op, a, b) => binary(op, at(a), at(b)),
            Op::Table { table, orders, x, y } => self.table(table, orders, x, y),
            Op::Select(c, a, b) => format!("select({}, {}, {})", at(b), at(a), at(c)),
            Op::Compare(op, a, b) => format!("{} {} {}", at(a), comparison(op), at(b)),
            Op::Not(c) => format!("!{}", at(c)),
            // without the branches of && and ||
            Op::And(a, b) => format!("{} & {}", at(a), at(b)),
            Op::Or(a, b) => format!("{} | {}", at(a), at(b)),
        }
    }

    fn table(&self, table: u32, [m, n]: [u8; 2], x: NodeId, y: Option<NodeId>) -> String {
        let (name, x) = (table_name(table, self.function), self.at(x));
        match y {
            None => format!("{name}({m}u, {x})"),
            Some(y) => format!("{name}({m}u, {n}u, {x}, {})", self.at(y)),
        }
    }
}

fn unary(op: Unary, a: &str) -> String {
    let function = match op {
        Unary::Neg => return format!("-{a}"),
        Unary::Sqrt => "sqrt",
        Unary::Cbrt => "ppum_cbrt",
        Unary::Exp => "exp",
        Unary::Log => "log",
        Unary::Log10 => "ppum_log10",
        Unary::Sin => "sin",
        Unary::Cos => "cos",
        Unary::Tan => "tan",
        Unary::Asin => "asin",
        Unary::Acos => "acos",
        Unary::Atan => "ppum_atan",
        Unary::Sinh => "sinh",
        Unary::Cosh => "cosh",
        Unary::Tanh => "ppum_tanh",
        Unary::Abs => "abs",
        Unary::Sign => "ppum_sign",
        Unary::Floor => "floor",
    };
    format!("{function}({a})")
}

fn binary(op: Binary, a: &str, b: &str) -> String {
    let function = match op {
        Binary::Add => return format!("{a} + {b}"),
        Binary::Sub => return format!("{a} - {b}"),
        Binary::Mul => return format!("{a} * {b}"),
        Binary::Div => return format!("{a} / {b}"),
        Binary::Pow => "ppum_pow",
        Binary::Atan2 => "ppum_atan2",
        Binary::Min => "ppum_min",
        Binary::Max => "ppum_max",
        Binary::Hypot => "ppum_hypot",
    };
    format!("{function}({a}, {b})")
}

fn comparison(op: Comparison) -> &'static str {
    match op {
        Comparison::Less => "<",
        Comparison::LessEqual => "<=",
        Comparison::Equal => "==",
    }
}

/// aⁿ by the products of [`power`](super::operation::power): the lines of the squares that are needed,
/// `v3_2` being the square of what `v3` is a power of, and the product.
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
fn tables(function: &str, program: &Program) -> String {
    let text =
        |(index, table): (u32, &Arc<Table>)| table_function(&table_name(index, function), table);
    used_tables(program).map(text).collect()
}

/// The tables that a program uses, with their indices.
fn used_tables(program: &Program) -> impl Iterator<Item = (u32, &Arc<Table>)> {
    let is_used = |index: u32| {
        program.ops().iter().any(|op| matches!(op, Op::Table { table, .. } if *table == index))
    };
    (0..).zip(program.tables().iter()).filter(move |(index, _)| is_used(*index))
}

/// The function of a table: what [`Table::derivative`] does.
fn table_function(name: &str, table: &Table) -> String {
    let cubics: Vec<String> = table.coefficients().chunks(4).map(cubic).collect();
    let declared = array("cubics", "vec4<f32>", &cubics) + &knots('x', table.x());
    let x = place('x', table.x().len());
    let about = format!("// Derivatives of the table `{}`.\n", table.name());
    if table.y().is_empty() {
        return format!(
            "{about}fn {name}(x_order: u32, x: f32) -> f32 {{\n{declared}{x}    return \
             ppum_cubic(cubics[x_cell], x_order, x_distance);\n}}\n"
        );
    }
    let (y_knots, y) = (knots('y', table.y()), place('y', table.y().len()));
    let row = |k| format!("ppum_cubic(cubics[first + {k}u], x_order, x_distance)");
    let rows: Vec<String> = (0..4).map(row).collect();
    format!(
        "{about}fn {name}(x_order: u32, y_order: u32, x: f32, y: f32) -> f32 {{\n{declared}{y_knots}{x}{y}    \
         let first = 4u * (y_cell * {}u + x_cell);\n    let in_y = vec4<f32>(\n        {}\n    );\n    \
         return ppum_cubic(in_y, y_order, y_distance);\n}}\n",
        table.x().len() - 1,
        rows.join(",\n        ")
    )
}

fn cubic(coefficients: &[f64]) -> String {
    let numbers: Vec<String> = coefficients.iter().map(|&c| number(c)).collect();
    format!("vec4<f32>({})", numbers.join(", "))
}

fn knots(axis: char, knots: &[f64]) -> String {
    let numbers: Vec<String> = knots.iter().map(|&knot| number(knot)).collect();
    array(&format!("{axis}_knots"), "f32", &numbers)
}

/// The declaration of an array, constant unless a number is beyond single precision.
fn array(name: &str, of: &str, items: &[String]) -> String {
    let finite = items.iter().all(|item| !item.contains("ppum_from_bits"));
    let kind = if finite { "const" } else { "let" };
    format!("    {kind} {name} = array<{of}, {}>({});\n", items.len(), items.join(", "))
}

/// The lines that find the cell of an argument and the distance from its first knot, and return where a
/// derivative is 0 because the argument is outside.
fn place(axis: char, n: usize) -> String {
    const LINES: &str = "    let X_inside = ppum_clamp(X, X_knots[0], X_knots[LAST]);
    if (X_order > 0u) & ((X < X_inside) | (X > X_inside)) {
        return 0.0;
    }
    var X_cell = 0u;
    var X_end = LASTu;
    while X_end - X_cell > 1u {
        let middle = (X_cell + X_end) / 2u;
        if X_knots[middle] <= X_inside {
            X_cell = middle;
        } else {
            X_end = middle;
        }
    }
    let X_distance = X_inside - X_knots[X_cell];
";
    LINES.replace('X', &axis.to_string()).replace("LAST", &(n - 1).to_string())
}
