//! The names every formula knows: functions, constants, words of the language.

use crate::operation::{Binary, Unary};

/// A function as a formula calls it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LibraryFunction {
    /// One operation of one number.
    Unary(Unary),
    /// One operation of two numbers.
    Binary(Binary),
    /// `if(c, a, b)`.
    If,
    /// `clamp(x, low, high)` = min(max(x, low), high).
    Clamp,
    /// `table(name, x)` or `table(name, x, y)`.
    Table,
    /// `dtable(name, m, x)` or `dtable(name, m, n, x, y)`: a derivative of a table.
    TableDerivative,
    /// `side(k)`: +1 on the left of crack k, −1 on its right.
    Side,
}

impl LibraryFunction {
    /// The function of a name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        functions().find(|(known, _)| *known == name).map(|(_, function)| function)
    }

    /// Number of arguments; `None` of functions with arguments that are no values.
    pub(crate) fn arity(self) -> Option<usize> {
        match self {
            Self::Unary(_) => Some(1),
            Self::Binary(_) => Some(2),
            Self::If | Self::Clamp => Some(3),
            Self::Table | Self::TableDerivative | Self::Side => None,
        }
    }
}

/// Names of all functions, to be listed and completed.
pub fn function_names() -> impl Iterator<Item = &'static str> {
    functions().map(|(name, _)| name)
}

/// All functions with their names.
pub(crate) fn functions() -> impl Iterator<Item = (&'static str, LibraryFunction)> {
    let unary = Unary::ALL.iter().map(|op| (op.text(), LibraryFunction::Unary(*op)));
    let binary = Binary::ALL.iter().map(|op| (op.text(), LibraryFunction::Binary(*op)));
    let all = unary.chain(binary).chain(OTHERS);
    all.filter(|(text, _)| text.starts_with(|c: char| c.is_ascii_alphabetic()))
}

/// Functions that are no operation of numbers.
const OTHERS: [(&str, LibraryFunction); 5] = [
    ("if", LibraryFunction::If),
    ("clamp", LibraryFunction::Clamp),
    ("table", LibraryFunction::Table),
    ("dtable", LibraryFunction::TableDerivative),
    ("side", LibraryFunction::Side),
];

/// All constants.
pub(crate) const CONSTANTS: [(&str, f64); 2] =
    [("pi", std::f64::consts::PI), ("e", std::f64::consts::E)];

/// Functions of other languages and what stands for them here.
const FOREIGN: [(&str, &str); 14] = [
    ("ln", "log"),
    ("lg", "log10"),
    ("pow", "^"),
    ("power", "^"),
    ("fabs", "abs"),
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("arctan2", "atan2"),
    ("sgn", "sign"),
    ("ceil", "-floor(-…)"),
    ("where", "if"),
    ("select", "if"),
    ("interp", "table"),
];

/// The name that stands for a function of another language.
pub(crate) fn foreign(name: &str) -> Option<&'static str> {
    FOREIGN.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, here)| here)
}

/// Words of the language that are neither functions nor constants.
pub(crate) const KEYWORDS: [&str; 4] = ["let", "and", "or", "not"];

/// The constant of a name.
pub(crate) fn constant(name: &str) -> Option<f64> {
    CONSTANTS.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
}

/// Name of an operation that formulas write as a function.
pub(crate) fn name_of(function: LibraryFunction) -> &'static str {
    let mut all = functions().filter(|(_, known)| *known == function);
    all.next().expect("operators are written with their own signs").0
}

/// True if the language itself uses the name.
pub(crate) fn is_reserved(name: &str) -> bool {
    KEYWORDS.contains(&name) || constant(name).is_some() || LibraryFunction::named(name).is_some()
}
